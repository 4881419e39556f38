"""A mechanism does the same in a turned frame, with other senses in a mirrored one, and goes back in reversed time."""

from __future__ import annotations

import cmath
import math
import re
from copy import deepcopy
from typing import Any

import pytest

import graphkin
from graphkin.api.report_text import report_text
from tests import scenes
from tests.mechanisms import random_scene

Scene = dict[str, Any]

TOGGLE: Scene = {
    "frame": {"points": {"A": [0, 0], "D": [11, 9]}, "guides": {"v": {"through": [11, 0], "angle": -90}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 3}, "2": {"points": ["B", "C"], "length": 12},
        "3": {"points": ["D", "C"], "length": 8}, "4": {"points": ["C", "E"], "length": 8},
        "5": {"points": ["E"], "on": "0.v"},
    },
    "driver": {"link": "1", "angle": 35, "omega": -12, "alpha": 5},
    "sketch": {"C": [11, 1], "E": [11, -7]},
}
"""It passes its straight position twice a turn."""

SCENES = {
    "toggle": TOGGLE, "four-bar": scenes.four_bar(150, 500, 300, 400, sketch={"C": [500, 290]}),
    **{f"random {seed}": random_scene(seed, kinds, drive) for seed, kinds, drive in (
        (1, ("RRR", "RRP"), "crank"), (2, ("RPR", "pin"), "crank"), (4, ("PRP", "slotted"), "slider"),
        (6, ("RPP", "RRR"), "cylinder"),
    )},
}


def moved(scene: Scene, degrees: float, mirrored: bool) -> Scene:
    """The scene in a frame turned by an angle, before that mirrored at the x axis."""
    scene, side = deepcopy(scene), -1 if mirrored else 1
    turn = cmath.rect(1.0, math.radians(degrees))

    def place(at: list[float]) -> list[float]:
        z = complex(at[0], side * at[1]) * turn
        return [z.real, z.imag]

    def in_link(at: Any) -> Any:
        if isinstance(at, list):
            return [at[0], side * at[1]]
        return {**at, "angle": side * at["angle"]}

    frame = scene["frame"]
    frame["points"] = {name: place(at) for name, at in frame.get("points", {}).items()}
    for guide in frame.get("guides", {}).values():
        guide |= {"through": place(guide["through"]), "angle": side * guide["angle"] + degrees}
    for link in scene["links"].values():
        link |= {"at": {name: in_link(at) for name, at in link.get("at", {}).items()}}
        link |= {"angle_on": side * link["angle_on"]} if "angle_on" in link else {}
        for guide in link.get("guides", {}).values():
            guide |= {"through": in_link(guide["through"]), "angle": side * guide["angle"]}
    driver = scene["driver"]
    if "link" in driver:
        driver |= {"angle": side * driver["angle"] + degrees}
        driver |= {rate: side * driver[rate] for rate in ("omega", "alpha") if rate in driver}
    scene["sketch"] = {name: place(at) for name, at in scene["sketch"].items()}
    return scene


def rates(scene: Scene, kind: str) -> dict[str, float]:
    """A rate of each link in the scene's own position."""
    (position,) = graphkin.solve(scene).data["positions"]
    return {name: link[kind] for name, link in position["links"].items()}


def strokes(scene: Scene) -> dict[str, dict[str, float | None]]:
    """Stroke or swing, K and theta of each output."""
    outputs = graphkin.sweep(scene, positions=2).data["outputs"]
    told = ("stroke", "swing", "K", "theta")
    return {output.get("slide") or output["link"]: {key: output[key] for key in told if key in output}
            for output in outputs}


def like(told: dict[str, Any], side: float = 1.0) -> dict[str, Any]:
    """The numbers of a result as expected ones, with a sign."""
    return {key: like(value, side) if isinstance(value, dict) else value if value is None else
            pytest.approx(side * value, rel=1e-8, abs=1e-9) for key, value in told.items()}


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
@pytest.mark.parametrize(("degrees", "mirrored"), [(100, False), (-37, True)])
def test_in_another_frame_rates_change_their_sense_alone_and_strokes_and_k_stay(scene, degrees, mirrored):
    other, side = moved(scene, degrees, mirrored), -1 if mirrored else 1
    assert like(rates(scene, "omega"), side) == rates(other, "omega")
    assert like(rates(scene, "alpha"), side) == rates(other, "alpha")
    assert like(strokes(scene)) == strokes(other)


@pytest.mark.parametrize("scene", SCENES.values(), ids=SCENES)
def test_in_reversed_time_rates_change_their_sense_and_second_rates_and_k_stay(scene):
    driver = scene["driver"]
    back = {**scene, "driver": {**driver, **{r: -driver[r] for r in ("omega", "velocity") if r in driver}}}
    assert like(rates(scene, "omega"), -1) == rates(back, "omega")
    assert like(rates(scene, "alpha")) == rates(back, "alpha")
    assert like(strokes(scene)) == strokes(back)


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", ["toggle", "random 1", "random 2"])
def test_the_report_of_a_mirrored_mechanism_has_its_sides_and_senses_exchanged(name, language):
    scene = SCENES[name]
    here, other = (report_text(graphkin.check(one), language) for one in (scene, moved(scene, 0, True)))
    assert words(exchanged(here)) == words(other)


@pytest.mark.parametrize(("kinds", "drive"), [(("slotted",), "slot"), (("PRP", "RPP"), "cylinder")])
@pytest.mark.parametrize(("degrees", "mirrored"), [(100, False), (13, False), (-37, True)])
def test_a_zero_by_cancelling_terms_is_judged_in_every_frame_as_one_that_comes_out_exactly(
    kinds, drive, degrees, mirrored,
):
    scene = random_scene(51, kinds, drive)
    here, other = (graphkin.check(one).report for one in (scene, moved(scene, degrees, mirrored)))
    verdicts = {str(row.symbol): row.ok for row in here.rows}
    assert set(verdicts.values()) == {True}
    assert verdicts == {str(row.symbol): row.ok for row in other.rows}


PAIRS = (("counter-clockwise", "clockwise"), (" left", " right"), (" upper", " lower"),
         ("逆时针", "顺时针"), ("左", "右"), ("上方", "下方"))


def exchanged(text: str) -> str:
    both = {**dict(PAIRS), **{b: a for a, b in PAIRS}}
    return re.sub("|".join(sorted(both, key=len, reverse=True)), lambda found: both[found[0]], text)


def words(text: str) -> list[str]:
    """Lines without numbers, signs and spaces: what is said of them."""
    return [re.sub(r"[-−+\d.\s]", "", line) for line in text.splitlines()]
