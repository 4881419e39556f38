"""The steps of forces: verbs and reasons, what each finds, the letters at the ends of vectors, numbers."""

from __future__ import annotations

from typing import Any

import pytest

import graphkin
from graphkin.account.forces import force_stages
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.construction import draft, pencil
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.forces import ForceGroup, with_forces
from graphkin.construction.forces.position import DrawnPosition
from graphkin.construction.forces.steps import ForceStep, MomentStep
from graphkin.plane import cross
from graphkin.scene import mechanism_of
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import Symbol
from tests.construction.test_forces import (
    BLOCK_ON_A_COMPOUND_HINGE,
    CHAIN,
    DRIVEN_AGAINST_A_BLOCK,
    ROD_TO_A_CROSSING_OF_CIRCLES,
)
from tests.mechanisms import random_scene
from tests.scenes import four_bar, slider_crank
from tests.solver.test_forces import loaded

TOOLS = Tools()
SCENES = ["shaper-forces", "engine-gas-force", "rocker-return-spring", "boom-lifted", BLOCK_ON_A_COMPOUND_HINGE, CHAIN,
          DRIVEN_AGAINST_A_BLOCK, loaded(graphkin.read("double-butterfly").to_dict(), 5)]


def drawn(scene: Any) -> Sheet:
    return with_forces(draft(mechanism_of(scene)))


def steps_of(sheet: Sheet) -> list[ForceStep]:
    groups = [step for state in sheet.forces for group in state.groups for step in group.steps]
    levers = [step for state in sheet.forces for lever in state.levers for step in lever.steps]
    return [*sheet.inertias.values(), *sheet.springs, *groups, *levers]


def group_of(scene: Any, *links: str) -> ForceGroup:
    return next(group for group in drawn(scene).forces[0].groups if group.links == links)


@pytest.mark.parametrize("scene", SCENES)
def test_steps_of_forces_are_numbered_in_order_after_those_of_the_motion(scene: Any) -> None:
    sheet = drawn(scene)
    first = sheet.steps[-1].number + 1
    assert [*range(first, first + len(steps_of(sheet)))] == [step.number for step in steps_of(sheet)]


def test_a_force_between_two_groups_has_the_scale_of_the_polygon_that_gave_it() -> None:
    scene = four_bar(70, 140, 110, 180, loads={
        "P": {"on": "2", "at": [30, 5], "force": 20, "angle": 30},
        "Q": {"on": "1", "at": [30, 9], "force": 1e7, "angle": 80}})
    (state,) = drawn(scene | {"links": dict(reversed(scene["links"].items()))}).forces
    first, last = (group.per_mm for group in state.groups)
    between, of_frame = (state.per_mm[Symbol("F", link=link, other="1")] for link in "24")
    assert first == between < last == of_frame


GUIDE_DRIVEN_FROM_ITS_BLOCK = {
    "frame": {"points": {"A": [0, 0]}},
    "links": {
        "1": {"points": ["A"], "on": "2.g"},
        "2": {"points": ["E", "F"], "length": 60, "guides": {"g": {"through": [10, -10], "angle": 20}}},
    },
    "driver": [{"link": "1", "angle": 40, "omega": 2}, {"slide": "1/2", "travel": 30, "velocity": 50}],
    "loads": {"P": {"on": "2", "at": "F", "force": 20, "angle": 70},
              "Q": {"on": "1", "at": [30, 9], "force": 1e7, "angle": 80}},
}


def test_a_balance_found_on_the_guide_of_a_block_is_read_at_the_scale_of_the_guide() -> None:
    checked = graphkin.check(GUIDE_DRIVEN_FROM_ITS_BLOCK)
    (state,) = checked.sheet.forces
    of_guide, of_block = state.groups
    push = Symbol("F", link="1")
    on_paper = {row["symbol"]: row["on_paper_mm"] for row in checked.data["readings"]}
    assert (("2",), ("1",)) == (of_guide.links, of_block.links)
    assert of_guide.per_mm == state.per_mm[push] < of_block.per_mm
    assert of_guide.read[push] == pytest.approx(on_paper["F_1"])


def test_in_a_larger_group_the_host_of_a_guest_bears_its_force_on_a_pin_that_others_hold() -> None:
    checked = graphkin.check({**ROD_TO_A_CROSSING_OF_CIRCLES, "balance": {"on": "7"}})
    (state,) = checked.sheet.forces
    assert (True, "drawn system") == (checked.ok, state.groups[-1].way)


def test_in_a_larger_group_the_force_of_a_guide_stands_where_it_turns_as_its_couple_does() -> None:
    sheet = drawn(loaded(graphkin.read("triad-slider").to_dict(), 1))
    (state,), force = sheet.forces, Symbol("F", link="1", other="6")
    shift = state.groups[0].lines[force] - DrawnPosition(sheet).foot(sheet.structure.slide("6/1"))
    couple = cross(shift, state.vectors[force]) * sheet.scales.length
    assert state.moments[Symbol("M", link="1", other="6")] == pytest.approx(couple, rel=1e-9)


def test_where_a_load_ends_groups_that_it_does_not_change_keep_the_numbers_of_their_steps() -> None:
    scene = graphkin.read("shaper-forces").to_dict()
    begins = {"driver": [scene["driver"]["angle"], 300]}
    scene["loads"]["E"] = {"on": "2", "at": [10, 0], "force": 50, "angle": 30, "when": begins}
    without, with_load = drawn(scene).forces
    assert without.groups[:2] == with_load.groups[:2]
    assert with_load.groups[2].steps[0].number == without.groups[2].steps[-1].number + 1


def test_a_reason_of_a_step_of_forces_belongs_to_one_verb() -> None:
    verbs: dict[str, set[str]] = {}
    for step in (step for scene in SCENES for step in steps_of(drawn(scene))):
        verbs.setdefault(step.reason, set()).add(step.verb)
    assert [] == [reason for reason, of in verbs.items() if len(of) > 1]


@pytest.mark.parametrize("scene", SCENES)
def test_every_step_of_forces_is_told(scene: Any) -> None:
    sheet = drawn(scene)
    told = [told for stage in force_stages(Account(sheet, notation_of(sheet, "us"))) for told in stage.steps]
    assert [step.number for step in steps_of(sheet)] == [each.step.number for each in told]
    assert all(each.sentence("en").plain() and each.sentence("zh").plain() for each in told)


@pytest.mark.parametrize(("scene", "links", "steps"), [
    ("shaper-forces", "56", [("mark", "cut free", ""), ("read", "two-force member", "F_4/5"),
                             ("lay off", "known forces", ""), ("cross", "closed by lines", "F_4/5 F_1/6"),
                             ("join", "inside", "F_6/5"), ("read", "no couple", "M_1/6")]),
    ("shaper-forces", "34", [("mark", "cut free", ""), ("read", "about guide", "F_2/3"),
                             ("lay off", "known forces", ""), ("join", "closed", "F_2/3 F_1/4"),
                             ("join", "inside", "F_4/3"), ("read", "no couple", "M_4/3")]),
    ("rocker-return-spring", "23", [("mark", "cut free", ""), ("read", "two-force member", "F_1/2"),
                                    ("read", "about pin", "F_4/3"), ("lay off", "known forces", ""),
                                    ("cross", "closed by lines", "F_1/2 F_4/3"), ("join", "inside", "F_3/2")]),
    ("rocker-return-spring", "1", [("mark", "cut free", ""), ("lay off", "known forces", ""),
                                   ("join", "closed", "F_4/1"), ("read", "balance", "M_1")]),
])
def test_a_group_is_drawn_verb_by_verb_and_each_step_finds_its_forces(
    scene: str, links: str, steps: list[tuple[str, str, str]]
) -> None:
    found = [(s.verb, s.reason, " ".join(map(str, s.finds))) for s in group_of(scene, *links).steps]
    assert steps == found


@pytest.mark.parametrize(("links", "ends"), [
    (("3", "4"), {"F_2/3 t": "ab", "Fi_3": "bc", "Fi_4": "cd", "P_gas": "de", "F_1/4": "ef", "F_2/3 n": "fa"}),
    (("2",), {"F_3/2": "ab", "F_1/2": "ba"}),
])
def test_vectors_of_a_polygon_bear_letters_at_their_ends_in_the_order_of_laying_off(
    links: tuple[str, ...], ends: dict[str, str]
) -> None:
    vectors = [v for step in group_of("engine-gas-force", *links).by("known forces", "closed", "closed by lines")
               for v in step.forces]
    assert list(ends.items()) == [(f"{v.symbol} {v.part}".strip(), "".join(v.ends)) for v in vectors]


@pytest.mark.parametrize("scene", SCENES)
def test_a_letter_of_a_polygon_is_one_place(scene: Any) -> None:
    for group in drawn(scene).forces[0].groups:
        places = {letter: place for letter, (place, _) in group.corners.items()}
        inside = [v for chain in group.inner.values() if chain[0] in group.polygon for v in chain]
        ends = [end for v in (*group.polygon, *inside) for end in zip(v.ends, (v.tail, v.tip), strict=True)]
        assert [] == [letter for letter, z in ends if abs(places[letter] - z) > 0.3]
        assert "".join(places) == "abcdefghijklmnop"[: len(places)]


@pytest.mark.parametrize("scene", SCENES)
def test_moments_of_a_step_are_in_balance(scene: Any) -> None:
    steps = [step for step in steps_of(drawn(scene)) if isinstance(step, MomentStep) and step.value]
    for step in steps:
        known = [term.moment for term in step.terms]
        most = max(map(abs, known))
        assert -sum(known) == pytest.approx(step.unknown.moment * step.value, abs=1e-9 * most)


@pytest.mark.parametrize("kind", ["RRP", "RPR", "PRP", "RPP"])
def test_a_couple_shifts_the_line_of_the_force_of_its_pair_by_the_couple_over_the_force(kind: str) -> None:
    sheet = drawn(loaded(random_scene(7, (kind,)), 3))
    couples = [(s, group) for group in sheet.forces[0].groups for s in group.moments("couple")]
    assert couples
    for step, group in couples:
        force = abs(sheet.forces[0].vectors[step.shifted])
        assert step.value / force == pytest.approx(step.shift, rel=1e-9)
        assert (step.symbol.link, step.symbol.other) == (step.shifted.link, step.shifted.other)
        assert step.shifted in group.lines


def test_the_point_of_moments_is_the_inner_pin_and_arms_are_measured_from_it() -> None:
    group, sheet = group_of("rocker-return-spring", "2", "3"), drawn("rocker-return-spring")
    _, step = group.moments("two-force member", "about pin")
    pin = next(z for ref, z in sheet.points.items() if ref.point == "C")
    assert ("C", ("3",)) == (step.about, step.links)
    forces = [term for term in step.terms if term.arm is not None]
    assert [pin] * 3 == [term.about for term in forces]
    for term in forces:
        along = term.acting.force / abs(term.acting.force)
        arm = ((term.acting.at - pin).conjugate() * along).imag
        assert arm == pytest.approx(term.arm, abs=1e-9)


@pytest.mark.parametrize(("scene", "links", "wholes"), [
    ("shaper-forces", "34", [True]), ("rocker-return-spring", "23", [True, False]), ("engine-gas-force", "34", [False]),
])
def test_a_part_by_moments_is_the_whole_force_where_no_other_part_stands_in_the_polygon(
    scene: str, links: str, wholes: list[bool]
) -> None:
    group = group_of(scene, *links)
    parts = group.moments("two-force member", "about pin", "about guide")
    assert wholes == [not step.part for step in parts]
    assert wholes == [len({v.part for v in group.polygon if v.symbol == step.symbol}) < 2 for step in parts]


@pytest.mark.parametrize(("scene", "links", "symbol", "reason"), [
    ("shaper-forces", "34", "F_2/3", "about guide"), ("rocker-return-spring", "23", "F_1/2", "closed by lines"),
])
def test_a_whole_force_appears_on_the_links_with_the_step_that_finds_its_size(
    scene: str, links: str, symbol: str, reason: str
) -> None:
    group = group_of(scene, *links)
    (force,) = (v for v in group.polygon if str(v.symbol) == symbol)
    assert [reason] == [step.reason for step in group.steps if step.number == group.on_links(force)]


def test_the_force_of_a_pin_of_several_links_is_read_off_with_all_its_parts() -> None:
    sheet = drawn(BLOCK_ON_A_COMPOUND_HINGE)
    group = sheet.forces[0].groups[0]
    pin = Symbol.parse("F_2/3")
    parts = [v for v in group.polygon if str(v.symbol) == "F_E/3"]
    assert ["n", "t"] == sorted(v.part for v in parts)
    whole = abs(sum(v.span for v in parts))
    assert whole == pytest.approx(group.read[parts[0].symbol])
    assert pin not in group.read
    lines = [repr(line) for stage in force_stages(Account(sheet, notation_of(sheet, "chinese")))
             for told in stage.steps for line in told.work_in("en")]
    assert f"$F_{{RE3}}$ = {whole:.2f} mm × " in " ".join(lines)


def test_a_spring_is_told_with_the_length_that_the_hand_has_read() -> None:
    sheet = with_forces(draft(mechanism_of("rocker-return-spring")), pencil(TOOLS, 5))
    (step,), (spring,) = sheet.springs, sheet.scene.loading.springs
    pull, opposite = step.acting
    on_paper = abs(opposite.at - pull.at) * sheet.scales.length
    assert abs(step.length - on_paper) > 1e-6
    assert spring.pull(step.length) == pytest.approx(abs(pull.force), rel=1e-12)
    told = next(t for stage in force_stages(Account(sheet, notation_of(sheet, "us"))) for t in stage.steps
                if t.step.reason == "spring")
    assert f"= {abs(pull.force):.2f} N" in repr(told.sentence("en"))


@pytest.mark.parametrize(("force", "mass", "told"), [
    ("N", "kg", "3 kg × 1 m/s² = 3 N"),
    ("lbf", "lb", "3 lb × 1 m/s² ÷ 9.80665 (lb·m/s²)/lbf = 0.30591 lbf"),
    ("kN", "kg", "3 kg × 1 m/s² ÷ 1000 (kg·m/s²)/kN = 0.003 kN"),
])
def test_an_inertia_force_is_the_quotient_of_what_is_printed(force: str, mass: str, told: str) -> None:
    units = {"length": "mm", "force": force, "mass": mass}
    sheet = drawn(slider_crank(50, 180, units=units, masses={"1": {"at": [10, 0], "mass": 3}}))
    stage = next(iter(force_stages(Account(sheet, notation_of(sheet, "chinese")))))
    assert repr(stage.steps[0].sums[0]).endswith(f"= {told}")
