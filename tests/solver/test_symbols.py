"""Quantities by their symbols: the parts of an acceleration add up and point the right way."""

from __future__ import annotations

from dataclasses import replace
from itertools import permutations
from typing import Any

import pytest

from graphkin.errors import CallError
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from graphkin.solver import Motion, solve
from graphkin.solver.forces import value_of
from tests import scenes

pytestmark = pytest.mark.quick


@pytest.fixture(scope="module")
def sixbar() -> Motion:
    return solve(mechanism_of("sixbar-guide-40deg"))


@pytest.fixture(scope="module")
def fourbar() -> Motion:
    return solve(mechanism_of_text(scenes.FOUR_BAR, "scene"))


def value(motion: Motion, symbol: str) -> complex:
    return complex(motion.value(Symbol.parse(symbol))[0])


EXACT = {"v_B": 1220, "v_B@3": 1075.78, "v_B@3/B@2": 575.41,
         "an_B@3": 3032.76, "at_B@3": 2509.78, "a_B@3": 3936.58,
         "ak_B@3/B@2": 3244.28, "ar_B@3/B@2": 7725.06, "v_D@3": 472.42, "v_D": 482.722,
         "a_D@3": 1728.71, "a_D": 554.668,
         "ak_D/D@3": 559.32, "ar_D/D@3": 1217.82, "v_D/D@3": 99.20}


@pytest.mark.parametrize("symbol", EXACT)
def test_the_worked_example_gives(sixbar: Motion, symbol: str) -> None:
    assert 1000 * abs(value(sixbar, symbol)) == pytest.approx(EXACT[symbol], rel=1e-5)


def test_the_bar_of_the_worked_example_turns_clockwise(sixbar: Motion) -> None:
    assert value(sixbar, "omega_3") == pytest.approx(-2.81912, abs=5e-6)


def test_coriolis_and_sliding_part_make_the_relative_acceleration(sixbar: Motion) -> None:
    parts = value(sixbar, "ak_B@3/B@2") + value(sixbar, "ar_B@3/B@2")
    assert parts == pytest.approx(value(sixbar, "a_B@3/B@2"), rel=1e-14)


def test_the_sliding_part_lies_along_the_guide(sixbar: Motion) -> None:
    u = sixbar.poses["3"].u[0]
    assert (value(sixbar, "ar_B@3/B@2") * u.conjugate()).imag == pytest.approx(0, abs=1e-14)


def test_coriolis_changes_its_sign_with_the_order_of_the_points(sixbar: Motion) -> None:
    assert value(sixbar, "ak_B@3/B@2") == pytest.approx(-value(sixbar, "ak_B@2/B@3"), rel=1e-15)


def test_coriolis_is_the_relative_velocity_turned_with_the_guide(sixbar: Motion) -> None:
    # the guide turns clockwise: the relative velocity turned by 90 deg clockwise
    ratio = value(sixbar, "ak_B@3/B@2") / value(sixbar, "v_B@3/B@2")
    assert ratio == pytest.approx(-2j * 2.81912, rel=1e-5)


def test_the_name_of_the_pin_means_any_link_that_has_it(sixbar: Motion) -> None:
    assert value(sixbar, "ak_B@3/B@1") == value(sixbar, "ak_B@3/B")


def test_normal_and_tangential_part_make_the_relative_acceleration(fourbar: Motion) -> None:
    parts = value(fourbar, "an_C/B") + value(fourbar, "at_C/B")
    assert parts == pytest.approx(value(fourbar, "a_C/B"), rel=1e-13)


def test_the_normal_part_points_from_the_point_to_the_other(fourbar: Motion) -> None:
    arm = fourbar.position("B")[0] - fourbar.position("C")[0]
    ratio = value(fourbar, "an_C/B") / arm
    assert ratio == pytest.approx(fourbar.omega("2")[0] ** 2, rel=1e-13)


def test_the_tangential_part_is_turned_with_alpha(fourbar: Motion) -> None:
    arm = fourbar.position("C")[0] - fourbar.position("B")[0]
    assert value(fourbar, "at_C/B") / arm == pytest.approx(1j * fourbar.alpha("2")[0], rel=1e-13)


def test_parts_of_one_point_are_about_the_fixed_pivot_of_its_link(fourbar: Motion) -> None:
    assert value(fourbar, "an_C") + value(fourbar, "at_C") == pytest.approx(value(fourbar, "a_C"), rel=1e-13)


def test_parts_of_a_coincident_point_are_about_the_pivot_of_that_link(sixbar: Motion) -> None:
    assert value(sixbar, "an_B@3") == value(sixbar, "an_B@3/C")


IMPOSSIBLE = {"v_Q": "point", "omega_9": "link", "an_E/D": "one link", "an_E": "fixed point", "ak_C/B": "coincident",
              "v_B@8": "link"}


@pytest.mark.parametrize("symbol", IMPOSSIBLE)
def test_a_symbol_that_names_nothing_is_refused(fourbar: Motion, symbol: str) -> None:
    with pytest.raises(CallError, match=IMPOSSIBLE[symbol]):
        value(fourbar, symbol)


def test_the_rates_of_a_sliding_pair_are_along_its_guide_with_their_sign(sixbar: Motion) -> None:
    along = sixbar.poses["3"].u
    relative = value(sixbar, "v_B@2/B@3"), value(sixbar, "ar_B@2/B@3")
    assert [value(sixbar, "v_2/3"), value(sixbar, "a_2/3")] == pytest.approx(
        [(vector * along.conjugate())[0].real for vector in relative], rel=1e-12)


RELATIVE = """
frame.points = { A = [0, 0], D = [200, 0] }
links.1 = { points = ["A", "B"], length = 100 }
links.2 = { points = ["B", "C"], length = 150 }
links.3 = { points = ["D", "C"], length = 120 }
driver = { link = "2", relative_to = "1", angle = -50, omega = 2, alpha = 0.5 }
sketch = { B = [60, 80], C = [190, 120] }
"""


def test_a_link_seen_from_the_link_it_is_hinged_to_turns_about_the_hinge_and_has_a_coriolis_term() -> None:
    motion = solve(mechanism_of_text(RELATIVE, "scene"))
    an, at, ak = (value(motion, f"{kind}_C@2/C@1") for kind in ("an", "at", "ak"))
    assert abs(an) == pytest.approx(2.0**2 * 0.150, rel=1e-12)
    assert abs(at) == pytest.approx(0.5 * 0.150, rel=1e-12)
    assert an + at + ak == pytest.approx(value(motion, "a_C@2/C@1"), rel=1e-12)


@pytest.mark.parametrize(
    "name",
    [
     "F_5/6", "F_5/6@C", "F_5/6+", "F_1@B@3", "F_2", "Fi_6", "G_6", "P_cut", "P_cut+", "M_2", "M_6/1+", "Mi_4", "h_4",
     "arm_G_6"],
)
def test_names_of_forces_are_written_as_they_are_read(name: str) -> None:
    assert name == str(Symbol.parse(name))


def test_forces_are_in_the_units_of_the_scene() -> None:
    units = Units(force="kN")
    assert [("kN", 1e3), ("kN m", 1e3)] == [Symbol.parse(name).unit(units) for name in ("F_5/6", "M_2")]


@pytest.mark.parametrize(("mass", "written"), [("kg", "kg·m²"), ("lb", "lb·ft²")])
def test_a_unit_that_is_a_product_is_written_with_a_dot(mass: Any, written: str) -> None:
    assert (written, "N·m") == tuple(Symbol.parse(name).unit(Units(mass=mass)).written for name in ("J_F", "M_2"))


def slot_in_the_frame() -> dict[str, Any]:
    """A pin of the rod runs in a slot of the frame that passes the crank's pivot."""
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": [0, 0], "angle": 0}}},
        "links": {"1": {"points": ["A", "B"], "length": 20}, "2": {"points": ["B", "C"], "length": 60}},
        "pins": {"C": {"of": "2", "in": "0.g"}},
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }


@pytest.mark.parametrize("source", [*library(), slot_in_the_frame()],
                         ids=lambda source: source if isinstance(source, str) else "slot")
def test_coriolis_and_the_rest_make_the_acceleration_between_any_two_links(source: str | dict[str, Any]) -> None:
    motion = solve(mechanism_of(source))
    links = [link for link in (motion.scene.frame, *motion.scene.links) if not link.redundant]
    told = 0
    for one, other in permutations(links, 2):
        for point in {**one.points, **other.points}:
            name = f"{point}@{one.name}/{point}@{other.name}"
            try:
                ak, ar = value(motion, f"ak_{name}"), value(motion, f"ar_{name}")
            except CallError:
                continue
            told += 1
            scale = abs(ak) + abs(ar)
            assert value(motion, f"a_{name}") == pytest.approx(ak + ar, rel=1e-9, abs=1e-9 * scale)
    assert told


@pytest.mark.parametrize("kind", ["v", "a"])
def test_a_vector_along_an_inclined_guide_has_the_sign_and_size_of_the_rate_of_its_pair(kind: str) -> None:
    motion = solve(mechanism_of({
        "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 150}}},
        "links": {"1": {"points": ["A", "B"], "length": 20}, "2": {"points": ["B", "C"], "length": 60},
                  "3": {"points": ["C"], "on": "4.h"}},
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }))
    rate = Symbol.parse(f"{kind}_3/4")
    assert value_of(motion, rate) == pytest.approx(value_of(motion, replace(Symbol.parse(f"{kind}_C"), along=True)))
