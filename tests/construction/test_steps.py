"""Steps of a construction: their arguments, what a scale changes of them, and that each is told."""

from __future__ import annotations

import math
import re
from dataclasses import fields, replace
from typing import get_args, get_type_hints

import pytest

from graphkin.account.arithmetic import _bars_of
from graphkin.construction import draft
from graphkin.construction.board.instruments import EXACT
from graphkin.construction.board.sheet import Board
from graphkin.construction.board.steps import (
    LENGTHS,
    SENTENCES,
    CompassArc,
    Curve,
    Direction,
    Mark,
    OnPaper,
    Ray,
    Reason,
    Size,
    Step,
    Term,
    TrialPositions,
    Vector,
)
from graphkin.construction.tasks import TaskStep
from graphkin.plane import Pose
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import area, say

pytestmark = pytest.mark.quick
NO_LENGTHS = {"value", "other", "plan", "per_mm", "number", "equation", "angles", "K", "trial", "rates"}


def in_turn(value: object) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)  # type: ignore[return-value]


def reasons() -> set[str]:
    return {reason for group in get_args(Reason) for reason in get_args(group) or (group,)}


@pytest.mark.parametrize(("kind", "lengths"), [
    (Step, {"mm", "radii", "apart", "less"}), (TaskStep, {"mm", "radii", "apart", "less"}),
])
def test_a_number_of_a_step_is_a_length_on_paper_that_a_scale_changes_or_is_known_to_be_none(
    kind: type[Step], lengths: set[str]
) -> None:
    numbers = {f.name: f.type for f in fields(kind) if "float" in str(f.type) or "int" in str(f.type).split()}
    filled = {name: (1.5, 2.5) if "tuple" in str(of) else 1.5 for name, of in numbers.items()}
    step = kind("cross", "arcs", **{**filled, "plan": 0})
    larger = step.scaled(2.0)
    assert lengths == numbers.keys() - NO_LENGTHS
    assert {name: [2 * mm for mm in in_turn(getattr(step, name))] for name in lengths} == {
        name: [*in_turn(getattr(larger, name))] for name in numbers if getattr(larger, name) != getattr(step, name)
    }


def test_strokes_grow_with_their_step_and_a_plan_of_its_own_scale_stays() -> None:
    arc = CompassArc(1j, 2.0, 3j)
    assert [CompassArc(2j, 4.0, 6j)] == [*Step("cross", "arcs", strokes=(arc,)).scaled(2.0).strokes]
    assert 7.0 == Step("read", "plan", "velocity", mm=7.0, per_mm=0.25, plan=1).scaled(2.0).mm


TAKEN_OFF = Term(Symbol("v"), True, True)
DIVIDED = Step("divide", "open ends", "velocity", apart=((2.0,),), less=(((TAKEN_OFF, 3.0),),))


def test_gaps_of_trial_polygons_and_what_is_taken_off_them_grow_with_the_polygon() -> None:
    larger = DIVIDED.scaled(2.0)
    assert (((4.0,),), 6.0) == (larger.apart, larger.less[0][0][1])


def test_gaps_of_plans_of_a_train_stay_as_the_plan_has_a_scale_of_its_own() -> None:
    assert ((2.0,),) == replace(DIVIDED, plan=1).scaled(2.0).apart


def test_places_of_a_stroke_grow_and_its_direction_stays() -> None:
    ray = Ray(1 + 2j, 1j, 3j, Direction("along", ("h",)), Symbol("v"))
    assert Ray(2 + 4j, 1j, 6j, ray.direction, ray.symbol) == ray.scaled(2.0)
    assert replace(ray, through=3 + 6j, to=None) == replace(ray, to=None).scaled(3.0)
    assert Curve((2j, 4j), (6j,), "B") == Curve((1j, 2j), (3j,), "B").scaled(2.0)


def every(kind: type) -> list[type]:
    return [kind, *(deeper for made in kind.__subclasses__() for deeper in every(made))]


SAME_AT_ALL_SCALES = {
    "Term.along", "Ray.along", "Angle.value", "Step.value", "Step.other", "Step.per_mm", "Step.rates",
    "TaskStep.angles", "TaskStep.K", "TrialPositions.instead", "TrialPositions.trials", "TrialPositions.divided",
    "TrialPositions.parts", "Remark.size", "Rate.value", "Rate.arm",
    "LimitPosition.value", "LimitPosition.angle", "LimitPosition.rest", "CamStation.degree", "CamStation.way",
    "CamStation.normal", "CamStation.lift",
}
DRAWN_ANEW = "Force", "Inertia", "MomentStep"  # at other scales


@pytest.mark.parametrize("kind", [k for k in every(OnPaper) if not k.__name__.startswith(DRAWN_ANEW)])
def test_whatever_stands_on_paper_has_no_number_or_place_of_which_a_scale_does_not_know(kind: type) -> None:
    on_paper = "|".join(["float", "complex", *(f"[.]{of.__name__}\\b" for of in (*every(OnPaper), Pose))])
    kinds = get_type_hints(kind)
    own = {name for name in vars(kind).get("__annotations__", {}) if re.search(on_paper, str(kinds[name]))}
    assert set() == {f"{kind.__name__}.{name}" for name in own - LENGTHS} - SAME_AT_ALL_SCALES


@pytest.mark.parametrize("name", library()[::6])
def test_a_reason_belongs_to_one_verb_and_every_step_of_the_library_is_told(name: str) -> None:
    steps = draft(mechanism_of(name)).steps
    verbs: dict[str, set[str]] = {}
    for step in steps:
        verbs.setdefault(step.reason, set()).add(step.verb)
        assert str(step.phrase)
    assert [] == [reason for reason, of in verbs.items() if len(of) > 1]
    assert [*range(1, len(steps) + 1)] == [step.number for step in steps]


def test_the_table_of_sentences_tells_reasons_of_steps_with_words_of_the_table() -> None:
    assert set() == SENTENCES.keys() - reasons()
    plain = {key for key in SENTENCES.values() if "{" not in key}
    assert set() == plain - {word for name in ("position", "polygons", "centres", "forces") for word in area(name)}


def test_a_gap_of_a_sentence_is_filled_with_an_argument_of_the_step_by_its_name() -> None:
    step = Step("cross", "arcs", points=("A", "D"), point="C", radii=(12.5, 3.0))
    gaps = ("points.1", "point", "radii.0", "points")
    assert ["D", "C", "12.50", "A, D"] == [str(step.gap(name)) for name in gaps]
    assert "an arc about A of 12.50 mm and one about D of 3.00 mm meet in C" == str(step.phrase)


@pytest.mark.parametrize("base", ["", "3"])
def test_an_angle_below_zero_is_laid_off_with_the_minus_of_print(base: str) -> None:
    step = Step("lay off", "angle", link="6", point="G", value=math.radians(-30), base=base)
    assert "at −30 degrees" in str(step.phrase)
    assert "−30" == Step("carry over", "held still", kind="angle", value=math.radians(-30)).gap("amount")
    tried = TrialPositions("trial", "positions", instead=(("5", "6", math.radians(-30)),))
    assert "−30" == tried.phrase.gaps["angle"]


@pytest.mark.parametrize(("name", "sentence"), [
    ("elliptic-trammel", "mark the guides of frame 4"), ("four-bar-coupler-point", "and guides of frame 4: A, D"),
])
def test_of_a_frame_without_points_only_its_guides_are_marked(name: str, sentence: str) -> None:
    first = draft(mechanism_of(name)).steps[0]
    assert say(first.phrase).endswith(sentence)


def test_rates_that_trials_assume_and_find_are_told_with_their_units() -> None:
    steps = draft(mechanism_of("contour-four-bars")).steps
    told = [say(step.phrase, "en") for step in steps if step.rates]
    assert "trial polygon 1: omega_3 = −6 rad/s is assumed" in told[0]
    assert told[2].endswith("omega_3 = −6.6584 rad/s")
    assert "trial polygon 1: alpha_3 = −250 rad/s² is assumed" in told[3]
    assert told[5].endswith("alpha_3 = −289.26 rad/s²")


def test_each_pin_in_a_slot_of_a_crank_begins_with_the_crank_s_own_point_there() -> None:
    sheet = draft(mechanism_of({
        "frame": {"points": {"A": [0, 0], "D": [100, 0], "E": [0, 100]}},
        "links": {
            "1": {"points": ["A"],
                  "guides": {"g": {"through": [0, 0], "angle": 0}, "h": {"through": [0, 0], "angle": 90}}},
            "2": {"points": ["D", "P"], "length": 60}, "3": {"points": ["E", "Q"], "length": 60},
        },
        "pins": {"P": {"of": "2", "in": "1.g"}, "Q": {"of": "3", "in": "1.h"}},
        "driver": {"link": "1", "angle": 20, "omega": 3},
        "sketch": {"P": [60, 22], "Q": [-20, 60]},
    }))
    laid = [str(step.symbol) for step in sheet.steps if step.diagram == "velocity" and step.verb == "lay off"]
    assert ["v_P@1", "v_Q@1"] == laid


@pytest.mark.parametrize(("reason", "links"), [("travel", ("3", "2")), ("rolling", ())])
def test_a_travel_places_the_links_of_its_pair_a_start_of_rolling_none(reason: Reason, links: tuple[str, ...]) -> None:
    assert links == Step("lay off", reason, pairs=("3/2",)).links_drawn


@pytest.mark.parametrize(("kind", "sentence"), [("v", "by rate seen"), ("a", "by rates seen")])
def test_a_velocity_seen_from_a_held_link_is_given_by_one_rate_an_acceleration_by_two(kind: str, sentence: str) -> None:
    assert sentence == Step("image", "rates", symbol=Symbol(kind), held="2").sentence


def test_a_vector_ends_in_a_point_of_its_own_polygon_only() -> None:
    board = Board(EXACT)
    board.do(Step("lay off", "relative", "velocity", (Vector(Symbol("v"), 0j, 2 + 1j),)))
    mark = Mark(PointRef("B"), 2 + 1j)
    assert [False, True] == [board.pricked("acceleration", mark), board.pricked("velocity", mark)]


def test_the_lengths_by_which_rates_give_a_vector_are_measured() -> None:
    part = Term(Symbol("v"), True, True, Size("rate", ("3",), ("C", "B")))
    assert [("C", "B")] == [*_bars_of(Step("image", "rates", by_rates=(part,)), False)]
