"""Larger groups on the drawing board: position by trial drawings, velocity by superposition."""

from __future__ import annotations

import cmath
import math
from itertools import combinations
from types import SimpleNamespace
from typing import Any

import pytest

import graphkin
from graphkin import solver
from graphkin.construction.board.instruments import nudged
from graphkin.construction.board.steps import TrialPositions
from graphkin.construction.centres import find_centres
from graphkin.construction.plan import draft
from graphkin.construction.position import group_position
from graphkin.construction.position.group_position import place_by_trial
from graphkin.construction.position.links_on_paper import start_board
from graphkin.construction.position.position import own_position
from graphkin.construction.position.reduced_mechanism import PlacedElements, reduced_mechanisms
from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import Tools
from graphkin.structure import analyse
from tests.construction.test_groups import BARE, HELD

COUPLER_DRIVEN = {
    "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 150},
        "2": {"points": ["B", "C"], "length": 500},
        "3": {"points": ["C", "D"], "length": 300},
    },
    "driver": {"link": "2", "angle": 20, "omega": 2},
    "sketch": {"B": [75, 130], "C": [550, 260]},
}
TRAMMEL = {
    "frame": {"guides": {"x": {"through": [0, 0], "angle": 0}, "y": {"through": [0, 0], "angle": 90}}},
    "links": {"1": {"points": ["P", "Q"], "length": 100}},
    "pins": {"P": {"of": "1", "in": "0.x"}, "Q": {"of": "1", "in": "0.y"}},
    "driver": {"link": "1", "angle": 130, "omega": 3},
    "sketch": {"P": [60, 0], "Q": [0, 70]},
}
SCENES: dict[str, Any] = {
    "single flier": "single-flier",
    "double butterfly": "double-butterfly",
    "coupler driven": COUPLER_DRIVEN,
    "trammel": TRAMMEL,
}


def far_from_solver(scene: Mechanism, turned: float) -> tuple[float, float]:
    """Largest error of a place (in the mechanism's size) and of an angular velocity (in the driver's)."""
    driver = scene.drivers[0]
    at = {driver.key: driver.values[0] + math.radians(turned)}
    sheet, motion = draft(scene, at), solver.solve(scene, at)
    mm = 1.0 / sheet.scales.length
    names = [link.name for link in scene.links]
    place = max(abs(sheet.poses[n].origin / mm - complex(motion.poses[n].z[0])) for n in names) / scene.size
    rate = max(abs(sheet.rates["omega"][n].value - float(motion.omega(n)[0])) for n in names) / abs(driver.values[1])
    return place, rate


@pytest.mark.parametrize("turned", [0, 25, -4])
@pytest.mark.parametrize("name", SCENES)
def test_position_and_velocity_by_trial_agree_with_the_solver(name: str, turned: float) -> None:
    assert max(far_from_solver(mechanism_of(SCENES[name]), turned)) <= 1e-12


@pytest.mark.parametrize("turned", [120, 200, 330])
@pytest.mark.parametrize("name", ["single-flier", "double-butterfly"])
def test_eight_bars_are_drawn_all_the_way_round(name: str, turned: float) -> None:
    assert max(far_from_solver(mechanism_of(name), turned)) <= 1e-12


def test_a_mechanism_of_dyads_is_drawn_by_its_polygons() -> None:
    assert () == find_centres(mechanism_of("shaper-scheme-2")).kept


def test_what_the_superposition_keeps_is_named() -> None:
    (kept,) = find_centres(mechanism_of("double-butterfly")).kept
    assert kept in {"3", "4", "5", "6", "7", "8"}


def test_no_trial_driver_bears_the_name_of_a_real_one() -> None:
    scene = mechanism_of(COUPLER_DRIVEN)
    structure = analyse(scene)
    (group,) = structure.larger_groups
    assert "2" not in {driver.key for reduced in reduced_mechanisms(structure, group) for driver in reduced.trial}


@pytest.mark.parametrize(("name", "count"), [("triad-slider", 2), ("double-butterfly", 8)])
def test_a_group_is_found_in_each_assembly_of_its_trial_dyads(name: str, count: int) -> None:
    structure = analyse(mechanism_of(name))
    (group,) = structure.larger_groups
    known = own_position(PlacedElements(structure, structure.elements[: structure.elements.index(group)]))
    reduced = next(reduced for reduced in reduced_mechanisms(structure, group) if len(reduced.trial) == 1)
    fits = list(group_position.all_fits(reduced, known))
    apart = [max(abs(a[n].origin - b[n].origin) for n in group.links) for a, b in combinations(fits, 2)]
    assert (count, True) == (len(fits), min(apart) > 0.01)
    for fit in fits:
        poses = {**known.poses, **fit}
        for point, names in structure.hinges.items():
            places = [poses[n].place(structure.links[n].points[point] * known.mm) for n in names if n in poses]
            assert places == pytest.approx(places[:1] * len(places), abs=1e-8)


def test_a_sheet_found_by_trial_shows_the_link_that_was_left_out() -> None:
    sheet = draft(mechanism_of("single-flier"))
    assert {n for s in sheet.steps if isinstance(s, TrialPositions) for n in s.left_out} <= set(sheet.poses)


@pytest.mark.parametrize("name", ["triad-slider", "loader-cylinder", "scissor-lift"])
def test_each_division_is_made_between_the_nearest_trials_on_either_side(name: str) -> None:
    (table,) = (s for s in draft(mechanism_of(name)).steps if isinstance(s, TrialPositions))
    (((a,), (one,)), ((b,), (two,))) = table.trials[table.before - 1 : table.before + 1]
    assert len(table.divided) > 1
    for (value,), (missed,) in table.divided:
        assert one * two < 0.0
        assert (a * two - b * one) / (two - one) == pytest.approx(value, rel=1e-9)
        a, one, b, two = (value, missed, b, two) if missed * two < 0.0 else (a, one, value, missed)


def test_why_another_link_is_driven_for_a_driven_block_left_out_is_told() -> None:
    sheet = graphkin.check(HELD).sheet
    (act,) = (step for step in sheet.steps if isinstance(step, TrialPositions))
    driven = [d for d in sheet.scene.drivers if d.turns]
    assert act.instead
    for block, link, turned in act.instead:
        assert block in act.left_out
        assert any(block in (d.link, d.relative_to) for d in driven)
        assert sheet.poses[block].axis / sheet.poses[link].axis == pytest.approx(cmath.rect(1.0, turned), abs=1e-9)


def test_what_a_hand_misreads_of_two_gaps_is_what_stays_open_of_each() -> None:
    scene = mechanism_of(BARE)
    structure, sheet = analyse(scene), draft(scene)
    (group,) = structure.larger_groups
    reduced, mm, fine = reduced_mechanisms(structure, group)[0], 1.0 / sheet.scales.length, 1e-3
    poses = {name: pose.scaled(1.0 / (mm * scene.size)) for name, pose in sheet.poses.items()}
    ruler = Tools(ruler=fine, compass=0, set_square=0, protractor=0, line_width=0)
    left = set()
    for act in range(15, 19):  # the two gaps are read in the middle of these
        hand = nudged("pencil", ruler, {act: 1.0})
        paper = start_board(structure, mm, {d.key: d.values[0] for d in scene.drivers}, hand)
        place_by_trial(paper, reduced, poses)
        left.add(tuple(round(gap * scene.size * mm / fine, 3) + 0.0 for gap in reduced.gaps(paper)))
    misread = -round(1 / math.sqrt(12), 3)  # the width of a mark over sqrt(12)
    assert {(0.0, 0.0), (misread, 0.0), (0.0, misread)} == left


def test_of_the_grid_of_two_trial_drivers_the_places_that_miss_least_are_improved(monkeypatch) -> None:
    monkeypatch.setattr(group_position, "MOST_IMPROVED", 14)  # of 54 places of the grid
    scene = mechanism_of(BARE)
    structure, motion = analyse(scene), solver.solve(scene)
    (group,) = structure.larger_groups
    known = start_board(structure, 1.0, {d.key: d.values[0] for d in scene.drivers})
    fits = list(group_position.all_fits(reduced_mechanisms(structure, group)[1], known))
    exact = {name: (complex(motion.poses[name].z[0]), complex(motion.poses[name].u[0])) for name in group.members}
    off = [
        max(abs(fit[name].origin - z) / scene.size + abs(fit[name].axis - u) for name, (z, u) in exact.items())
        for fit in fits
    ]
    assert 0 == pytest.approx(min(off, default=math.inf), abs=1e-9)


@pytest.mark.parametrize("sense", [1.0, -1.0], ids=["up to it", "from it on"])
@pytest.mark.parametrize("last", [0.0032, 0.0031 + 1e-13], ids=["beside it", "at it"])
def test_a_fit_next_to_the_last_value_that_can_be_drawn_is_found(last, sense, monkeypatch):
    fit = 0.0031  # both between two values of the grid

    def drawn(reduced, known, values, branches):
        return values[0] if sense * values[0] <= last else None

    monkeypatch.setattr(group_position, "_drawn", drawn)
    monkeypatch.setattr(group_position, "_gaps", lambda reduced, known, values: (
        {} if drawn(reduced, known, values, ()) is None else {(): reduced.gaps(values[0])}
    ))
    reduced = SimpleNamespace(
        elements=(), trial=(SimpleNamespace(turns=True),), gaps=lambda at: [sense * at - fit], put_back=lambda at: at
    )
    assert [pytest.approx(sense * fit, rel=1e-12)] == list(group_position.fits_between(reduced, None, -0.1, 0.1))
