"""A scene written out reads as the same scene."""

from __future__ import annotations

import tomllib
from dataclasses import replace

import numpy as np
import pytest

import graphkin
from graphkin.scene import library, library_text, mechanism_of, mechanism_of_text
from graphkin.scene.laws import FollowerLaw, LiftPiece, MotionLaw
from graphkin.scene.scene import as_mapping, toml_text
from graphkin.scene.scene_tables import SCENE
from graphkin.scene.tables import in_si, in_units, plain
from graphkin.solver import solve


@pytest.mark.parametrize("name", library())
def test_the_text_of_a_scene_file_gives_its_mapping_again(name):
    raw = tomllib.loads(library_text(name))
    assert raw == tomllib.loads(toml_text(raw))


@pytest.mark.parametrize("name", library())
def test_a_resolved_scene_written_out_moves_alike(name):
    scene = mechanism_of(name)
    again = mechanism_of_text(toml_text(as_mapping(scene)), name)
    one, two = solve(scene), solve(again)
    for link in scene.links:
        np.testing.assert_allclose(one.alpha(link.name), two.alpha(link.name), rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("title", ['a "quote"', "back\\slash", "[links]", "李 \u202e x", "'''", "\x7f"])
def test_no_text_breaks_out_of_its_string(title):
    assert {"title": title} == tomllib.loads(toml_text({"title": title}))


def numbers(place: object, path: str = "") -> dict[str, object]:
    """What stands in a mapping, by its key with dots."""
    if isinstance(place, dict):
        return {k: v for name, item in place.items() for k, v in numbers(item, f"{path}.{name}").items()}
    if isinstance(place, list):
        return {k: v for i, item in enumerate(place) for k, v in numbers(item, f"{path}.{i}").items()}
    return {path: place}


@pytest.mark.parametrize("name", library())
def test_what_the_keys_say_of_units_leads_to_si_and_back(name: str) -> None:
    scene = graphkin.read(name)
    back = in_units(in_si(SCENE.checked(scene.to_dict())[0], scene.units), scene.units)
    there, here = numbers(scene.to_dict()), numbers(plain(back))
    assert {k: pytest.approx(v, rel=1e-12) if isinstance(v, float) else v for k, v in there.items()} == here


def pieces(law: FollowerLaw | MotionLaw) -> list[object]:
    """The pieces of a law, to be compared."""
    return [(pytest.approx((p.start, p.end, p.low, p.high)), p.by) for p in law.pieces if isinstance(p, LiftPiece)]


@pytest.mark.parametrize("name", ["cam-flat-face", "cam-offset-roller", "cam-swinging-roller"])
def test_the_law_of_a_cam_is_written_out(name: str) -> None:
    scene = mechanism_of(name)
    again = mechanism_of_text(toml_text(as_mapping(scene)), name)
    assert pieces(scene.cams[0].law) == [((p.start, p.end, p.low, p.high), p.by) for p in again.cams[0].law.pieces]


def test_the_law_of_a_driver_is_written_out() -> None:
    rise, fall = {"to": 1, "rise": 30, "by": "cycloidal"}, {"to": 3, "fall": 9, "by": "345"}
    law = {"from": 60, "pieces": [rise, {"to": 2}, fall]}
    made = graphkin.read("fourbar-150-500-300-400").to_dict() | {"driver": {"link": "1", "law": law, "time": 0.5}}
    stated = as_mapping(graphkin.Scene.of(made).mechanism)["driver"][0]
    assert {"link": "1", "law": law, "time": 0.5} == stated


def test_a_sliding_pair_driven_under_the_name_of_its_link_alone_keeps_its_table() -> None:
    law = {"from": 520, "to": 560, "duration": 1.0, "by": "cycloidal"}
    made = {
        "frame": {"points": {"A": [0, 0], "C": [200, -300]}}, "driver": {"slide": "2", "law": law, "time": 0.5},
        "links": {"1": {"points": ["A", "B"], "length": 400}, "2": {"points": ["B"], "on": "3"},
                  "3": {"points": ["C"]}},
    }  # fmt: skip
    (stated,) = as_mapping(mechanism_of(made))["driver"]
    assert {"slide": "2", "law": law, "time": 0.5} == stated


TOLD = [graphkin.Scene.saying, lambda mechanism: graphkin.Scene.of(as_mapping(mechanism))]


@pytest.mark.parametrize("told", TOLD, ids=["saying", "mapping"])
@pytest.mark.parametrize("kept", [slice(None, None, -1), slice(1, None), slice(0)], ids=["turned", "last", "none"])
def test_drivers_in_another_order_or_fewer_are_written_as_they_are(told, kept) -> None:
    mechanism = mechanism_of("loader-cylinder")
    fewer = replace(mechanism, drivers=mechanism.drivers[kept])
    assert fewer.drivers == told(fewer).mechanism.drivers


@pytest.mark.parametrize("told", TOLD, ids=["saying", "mapping"])
@pytest.mark.parametrize("driver", [{"link": "3", "from": "dead point", "angle": -0.5, "omega": 1, "near": 120},
                                    {"link": "3", "angle": 86, "omega": 1}])
def test_another_driver_is_written_with_its_dead_point(told, driver) -> None:
    scene = graphkin.read("fourbar-150-500-300-400").replace("driver", driver)
    slower = replace(scene.mechanism, drivers=(scene.mechanism.drivers[0].at_rate(0.5),))
    assert driver | {"omega": 0.5} == told(slower).to_dict()["driver"][0]
    moved = replace(mechanism_of("fourbar-150-500-300-400"), drivers=slower.drivers)
    assert ("3", 0.5) == (moved.drivers[0].link, told(moved).mechanism.drivers[0].rate)


def test_a_sliding_pair_turned_in_python_is_written_so() -> None:
    mechanism = mechanism_of("sixbar-guide-40deg")
    turned = replace(mechanism, slides=tuple(replace(pair, turn=1j) for pair in mechanism.slides))
    assert turned.slides == graphkin.Scene.saying(turned).mechanism.slides


def test_masses_have_tables_of_their_own_and_what_is_no_table_is_written_as_it_stands() -> None:
    assert "\n[masses.4]\n" in toml_text(graphkin.read("shaper-forces").to_dict())
    assert {"links": {"1": 5}} == tomllib.loads(toml_text({"links": {"1": 5}}))
