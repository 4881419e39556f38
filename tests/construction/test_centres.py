"""Finding all instant centres: permanent ones, Kennedy's theorem, what it cannot find, infinity."""

from __future__ import annotations

import cmath
import math
import random
from functools import partial
from itertools import combinations, pairwise
from types import SimpleNamespace
from typing import Any

import pytest

from graphkin.api.centred import centres as checked_centres
from graphkin.construction.centres import Centres, CircleDiagram, find_centres
from graphkin.scene import library, mechanism_of, read
from graphkin.scene.symbol import Symbol


def xy(z: complex) -> list[float]:
    return [z.real, z.imag]


def off_line(centres: Centres) -> float:
    """How far the three centres of any three links are from one line, on the unit sphere."""
    worst = 0.0
    for a, b, c in combinations(centres.names, 3):
        p, q, r = (centres.of(*pair).place for pair in ((a, b), (b, c), (c, a)))
        if p and q and r:
            cross = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
            worst = max(worst, abs(sum(x * y for x, y in zip(cross, r, strict=True))))
    return worst


@pytest.mark.parametrize("name", library())
def test_centres_of_scenes_that_come_along_agree_with_the_solver(name: str) -> None:
    assert checked_centres(name).ok


@pytest.mark.parametrize("name", library())
def test_every_three_centres_of_three_links_lie_on_one_line(name: str) -> None:
    assert off_line(find_centres(mechanism_of(name))) <= 1e-12


def test_links_at_one_hinge_share_a_permanent_centre_two_by_two() -> None:
    centres = find_centres(mechanism_of("toggle-press"))
    assert {"permanent"} == {centres.of(*pair).kind for pair in combinations(("2", "3", "4"), 2)}


def test_a_sliding_pair_has_its_centre_at_infinity_square_to_the_guide() -> None:
    assert 1j == find_centres(mechanism_of("slider-crank-offset")).of("3", "4").direction


def test_a_contact_gives_its_common_normal_as_one_line() -> None:
    found = find_centres(mechanism_of("cam-eccentric-flat-rocker")).of("1", "2")
    assert [("K",), (("1", "3"), ("2", "3"))] == [line.through for line in found.lines]


def test_found_centres_are_numbered_in_the_order_in_which_they_are_found() -> None:
    found = [c for c in find_centres(mechanism_of("sixbar-420rpm")).found if c.kind == "found"]
    assert [1, 2, 3, 4, 5, 6, 7, 8] == [c.number for c in found]


def test_each_line_goes_through_centres_found_before() -> None:
    centres = find_centres(mechanism_of("shaper-scheme-2"))
    for centre in centres.found:
        for line in centre.lines:
            assert all(centres.of(*pair).number < centre.number for pair in line.through if not isinstance(pair, str))


@pytest.mark.parametrize(("name", "known"), [("double-butterfly", 10), ("single-flier", 12)])
def test_indeterminate_eight_bars_stop_kennedys_theorem_where_the_literature_says(name: str, known: int) -> None:
    centres = find_centres(mechanism_of(name))
    other = min(c.number for c in centres.found if c.way)
    assert known == sum(c.number < other for c in centres.found)


def _two_fliers() -> dict[str, Any]:
    """Two single fliers on one frame, each with a driver of its own."""
    points = {"B": [18, 24], "E": [-7, 11], "C": [113, 86], "F": [155, 42], "H": [-10, 108], "J": [137, 108],
              "K": [84, 173], "A": [0, 0], "D": [113, 0], "G": [11, 94]}
    bars = {"2": "ABE", "3": "BC", "4": "DCF", "5": "HJK", "6": "EH", "7": "FJ", "8": "GK"}
    frame: dict[str, Any] = {"name": "1", "points": {}}
    scene: dict[str, Any] = {"frame": frame, "links": {}, "driver": [], "drawn": {}}
    for number, right in (("", 0), ("9", 400)):
        places = {p + number: [x + right, y] for p, (x, y) in points.items()}
        fixed = [p + number for p in "ADG"]
        frame["points"] |= {p: places[p] for p in fixed}
        scene["drawn"] |= {p: z for p, z in places.items() if p not in fixed}
        scene["driver"].append({"link": number + "2", "omega": 10})
        for name, (a, b, *more) in bars.items():
            further = {p + number: "drawn" for p in more}
            scene["links"][number + name] = {"points": [a + number, b + number], "at": further}
    return scene


def test_the_centre_that_gives_most_others_is_measured_first() -> None:
    measured = [c.pair for c in find_centres(mechanism_of(_two_fliers())).found if c.way]
    assert 2 == len(measured)


def test_of_centres_that_give_as_many_that_of_measured_links_comes_first_then_that_of_the_frame() -> None:
    pairs = [("2", "3"), ("3", "4"), ("2", "1"), ("3", "1"), ("4", "1")]
    links = SimpleNamespace(pairs=pairs, scene=SimpleNamespace(frame=SimpleNamespace(name="1")))
    diagram = SimpleNamespace(links=links, table={}, reached=set(pairs), joined={})
    to_measure = partial(CircleDiagram.to_measure, diagram)
    assert ("3", "4") == to_measure(["3", "4"])
    assert ("2", "1") == to_measure([])
    assert ("3", "1") == to_measure(["1", "3", "4"])


def test_what_kennedys_theorem_cannot_find_says_why_and_how_it_was_found() -> None:
    (centre,) = find_centres(mechanism_of("double-butterfly")).indeterminate
    assert centre.why is not None
    assert ("superposition", "centre few lines") == (centre.way, centre.why.key)


def test_lines_that_fall_together_at_a_special_position_are_recognised() -> None:
    centres = find_centres(mechanism_of("hit-two-RPR"), {"1": 0.0})
    assert ["centre lines together"] == [c.why.key for c in centres.indeterminate if c.why]


def test_links_that_do_not_move_relative_to_each_other_have_no_centre() -> None:
    centre = find_centres(mechanism_of(_three_parallelograms())).of("2", "7")
    assert centre.why is not None
    assert ("undetermined", "centre no motion") == (centre.kind, centre.why.key)


def _three_parallelograms() -> dict[str, Any]:
    """Three rods one after the other that translate alike."""
    return {
        "frame": {"name": "0", "points": {"A": [0, 0], "D": [300, 0], "G": [500, 0], "K": [650, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B", "C"], "length": 300},
            "3": {"points": ["D", "C"], "length": 150},
            "5": {"points": ["C", "F"], "length": 200},
            "6": {"points": ["G", "F"], "length": 150},
            "7": {"points": ["F", "H"], "length": 150},
            "8": {"points": ["K", "H"], "length": 150},
        },
        "driver": {"link": "1", "angle": 60, "omega": 3},
        "sketch": {"C": [375, 130], "F": [575, 130], "H": [725, 130]},
    }


def test_centres_do_not_need_the_driver_to_move() -> None:
    still, moving = (find_centres(mechanism_of(_four_bar(1.0, omega))).of("1", "3").point for omega in (0.0, 10.0))
    assert moving == still


def test_a_redundant_link_has_centres_too() -> None:
    scene = _parallelogram()
    assert "4" in find_centres(mechanism_of(scene)).names


def test_links_of_a_parallelogram_that_turn_alike_have_their_centre_at_infinity() -> None:
    found = find_centres(mechanism_of(_parallelogram())).of("1", "3")
    assert found.direction is not None
    assert abs(found.direction.imag) <= 1e-12


def _parallelogram() -> dict[str, Any]:
    return {
        "frame": {"name": "0", "points": {"A": [0, 0], "D": [400, 0], "G": [200, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B", "C"], "length": 400, "at": {"F": [200, 0]}},
            "3": {"points": ["D", "C"], "length": 150},
            "4": {"points": ["G", "F"], "length": 150, "redundant": True},
        },
        "driver": {"link": "1", "angle": 60, "omega": 3},
        "sketch": {"C": [475, 130]},
    }


def _four_bar(apart: float, omega: float = 10.0) -> dict[str, Any]:
    """A four-bar whose rocker is turned by an angle from the direction of its crank."""
    crank, rocker = cmath.rect(150, 1.1), cmath.rect(300, 1.1 + apart)
    return {
        "frame": {"name": "4", "points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B", "C"], "length": abs(400 + rocker - crank)},
            "3": {"points": ["D", "C"], "length": 300},
        },
        "driver": {"link": "1", "angle": math.degrees(1.1), "omega": omega},
        "sketch": {"C": xy(400 + rocker)},
    }


@pytest.mark.parametrize("power", range(3, 13))
def test_velocities_by_centres_hold_where_rocker_and_crank_become_parallel(power: int) -> None:
    found = checked_centres(_four_bar(10.0**-power))
    worst = max(abs(v.by_centres - v.exact) / max(abs(v.exact), 1e-3) for v in found.velocities if v.symbol.is_vector)
    assert worst <= 1e-9


@pytest.mark.parametrize("power", range(3, 13))
def test_a_far_centre_keeps_its_direction(power: int) -> None:
    apart = 10.0**-power
    centre = find_centres(mechanism_of(_four_bar(apart))).of("2", "4")
    way = centre.direction if centre.point is None else centre.point
    assert way is not None
    assert abs(math.remainder(cmath.phase(way) - 1.1, math.pi)) <= 2 * apart + 1e-9


def sixbar(seed: int) -> dict[str, Any]:
    """A six-bar of a seed: a four-bar with a dyad at its coupler or its rocker, ending in the frame or on a slider."""
    rng = random.Random(seed)
    near = lambda x, y, s: complex(x + rng.uniform(-s, s), y + rng.uniform(-s, s))  # noqa: E731
    a, d = 0j, near(220, 0, 40)
    b, c = near(30, 60, 25), near(230, 130, 40)
    e, f, g = near(150, 190, 40), near(330, 220, 40), near(420, 60, 50)
    drawn = {"B": xy(b), "C": xy(c), "E": xy(e), "F": xy(f)}
    links: dict[str, Any] = {
        "1": {"points": ["A", "B"]},
        "2": {"points": ["B", "C"]},
        "3": {"points": ["D", "C"]},
        "5": {"points": ["E", "F"]},
    }
    links["2" if seed % 2 else "3"]["at"] = {"E": "drawn"}
    frame: dict[str, Any] = {"name": "4", "points": {"A": xy(a), "D": xy(d)}}
    if seed % 3:
        frame["points"]["G"] = xy(g)
        links["6"] = {"points": ["G", "F"]}
    else:
        frame["guides"] = {"h": {"through": xy(f), "angle": rng.uniform(-80, 80)}}
        links["6"] = {"points": ["F"], "on": "4.h"}
    return {"frame": frame, "links": links, "drawn": drawn, "driver": {"link": "1", "omega": 7}}


@pytest.mark.parametrize("seed", range(24))
def test_all_15_centres_of_any_six_bar_agree_with_the_solver(seed: int) -> None:
    found = checked_centres(sixbar(seed))
    assert 15 == sum(error is not None and error <= 1e-9 for error in found.errors.values())


@pytest.mark.parametrize("name", ["sixbar-420rpm", "shaper-scheme-2", "oldham-coupling", "hydraulic-cylinder"])
def test_the_shortest_chain_leads_from_the_driver_in_one_step(name: str) -> None:
    assert 2 >= max(len(t.chain) for t in find_centres(mechanism_of(name)).turning.values())


def test_a_slider_has_the_velocity_of_the_crank_at_their_centre() -> None:
    centres = find_centres(mechanism_of("slider-crank-offset"))
    common = centres.of("1", "3").point
    pivot = centres.of("1", "4").point
    assert common is not None
    assert pivot is not None
    omega = mechanism_of("slider-crank-offset").drivers[0].values[1]
    value = centres.velocity(Symbol.parse("v_C"))
    assert isinstance(value, complex)
    assert abs(common - pivot) * centres.sheet.scales.length * abs(omega) == pytest.approx(abs(value), rel=1e-12)


def test_a_relative_velocity_by_centres_is_that_of_the_one_point_less_that_of_the_other() -> None:
    centres = find_centres(mechanism_of("slider-crank-offset"))
    c, b = (centres.velocity(Symbol.parse(name)) for name in ("v_C", "v_B"))
    assert c is not None
    assert b is not None
    assert c - b == pytest.approx(centres.velocity(Symbol.parse("v_C/B")), rel=1e-12)


def test_a_velocity_by_centres_relative_to_a_point_of_the_frame_is_that_of_the_point() -> None:
    centres = find_centres(mechanism_of("slider-crank-offset"))
    alone, relative = (centres.velocity(Symbol.parse(name)) for name in ("v_C@3", "v_C@3/C@4"))
    assert alone is not None
    assert alone == relative


def test_a_velocity_by_centres_may_be_off_by_the_more_the_nearer_two_of_its_centres_lie_to_each_other() -> None:
    scene, of_slider = read("slider-crank-offset"), Symbol.parse("v_C")
    errors = []
    for crank in (1.0, 1e-3, 1e-6):
        centres = find_centres(mechanism_of(scene.replace("links.1.length", crank)))
        velocity = centres.velocity(of_slider)
        assert velocity is not None
        errors.append(centres.velocity_error(of_slider) / abs(velocity))
    assert [True, True] == [0.0 < less < more for less, more in pairwise(errors)]
