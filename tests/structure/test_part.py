"""No more than the scene needs: the part that leads to what is asked, and what is drawn and solved of it."""

from __future__ import annotations

import pytest

import graphkin
from graphkin.construction import draft
from graphkin.errors import GraphkinError
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver import solve, structure_of
from graphkin.structure import analyse, part_of

SIXBAR = "sixbar-guide-40deg"


def asked(*names: str) -> tuple[Symbol, ...]:
    return tuple(map(Symbol.parse, names))


@pytest.mark.parametrize("name", library())
def test_every_point_moves_in_its_part_as_in_the_whole(name: str) -> None:
    scene = mechanism_of(name)
    structure, whole = structure_of(scene), solve(scene)
    for point in scene.holders:
        part = part_of(structure, (Symbol("v", PointRef(point)), Symbol("a", PointRef(point))))
        if point in scene.frame.points:
            continue
        alone = solve(part)
        size = abs(whole.acceleration(point)[0]) + abs(whole.velocity(point)[0])
        assert alone.velocity(point)[0] == pytest.approx(whole.velocity(point)[0], abs=1e-9 * size), point
        assert alone.acceleration(point)[0] == pytest.approx(whole.acceleration(point)[0], abs=1e-9 * size), point


def test_a_part_has_only_the_links_on_the_way() -> None:
    part = part_of(structure_of(mechanism_of(SIXBAR)), asked("omega_3"))
    assert ["1", "2", "3"] == [link.name for link in part.links]


def test_a_part_of_what_needs_everything_is_the_scene_itself() -> None:
    scene = mechanism_of(SIXBAR)
    assert part_of(structure_of(scene), asked("v_D")) is scene


@pytest.mark.parametrize("between", [["3.w", "0.rail"], ["0.rail", "3.w"]])
def test_a_rod_on_a_wheel_needs_the_wheel_whichever_body_the_file_names_first(between: list[str]) -> None:
    mapping = {
        "frame": {"points": {"A": [0, 60]}, "guides": {"rail": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["B", "C"], "length": 150},
            "3": {"points": ["C"], "start": 60, "discs": {"w": {"centre": "C", "r": 40}}},
        },
        "contacts": {"K": {"between": between, "rolling": True}},
        "driver": {"link": "1", "angle": 50, "omega": 10},
    }
    part = part_of(structure_of(mechanism_of(mapping)), asked("v_C"))
    assert ["1", "2", "3"] == [link.name for link in part.links]


def test_a_part_has_the_mobility_of_its_drivers() -> None:
    assert 1 == analyse(part_of(structure_of(mechanism_of(SIXBAR)), asked("omega_3"))).mobility.value


def test_a_redundant_link_asked_for_keeps_all() -> None:
    mapping = {
        "frame": {"points": {"A": [0, 0], "D": [300, 0], "F": [150, 20]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 300, "at": {"E": [150, 20]}},
            "3": {"points": ["D", "C"], "length": 100},
            "4": {"points": ["F", "E"], "length": 100, "redundant": True},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
        "sketch": {"C": [350, 87]},
    }
    scene = mechanism_of(mapping)
    assert part_of(structure_of(scene), asked("omega_4")) is scene


def counted(*names: str) -> dict[str, int]:
    """Steps of each diagram, and equations, of the worked example limited to what is asked."""
    sheet = draft(mechanism_of(SIXBAR), find=asked(*names))
    found = {d: sum(s.diagram == d for s in sheet.steps) for d in ("mechanism", "velocity", "acceleration")}
    return {**found, "equations": len(sheet.equations)}


def test_all_of_the_worked_example_takes_six_equations() -> None:
    assert 6 == counted()["equations"]


def test_the_velocity_of_the_first_bar_takes_two_equations() -> None:
    assert 2 == counted("omega_3")["equations"]


def test_a_velocity_at_the_end_takes_three_equations() -> None:
    assert 3 == counted("v_D")["equations"]


def test_a_velocity_at_the_end_and_an_acceleration_on_the_way_take_five_equations() -> None:
    assert 5 == counted("v_D", "alpha_3")["equations"]


def test_nothing_is_drawn_in_the_acceleration_polygon_for_velocities() -> None:
    assert 0 == counted("v_D")["acceleration"]


def test_what_is_asked_on_the_way_takes_fewer_steps_in_every_diagram() -> None:
    whole, part = counted(), counted("omega_3", "alpha_3")
    assert all(part[d] < whole[d] for d in whole)


def test_the_solver_of_a_check_solves_only_what_is_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    from graphkin import solver

    solved = []
    right = solver.solved_here
    monkeypatch.setattr(solver, "solved_here", lambda *given: solved.append(right(*given)) or solved[-1])
    graphkin.check(SIXBAR, find=["omega_3"])
    assert [["1", "2", "3"]] == [[link.name for link in motion.scene.links] for motion in solved]


def test_a_check_finds_only_the_centres_on_the_way() -> None:
    centres = graphkin.check(SIXBAR, find=["omega_3"]).centres
    assert 6 == len(centres.pairs)


def test_a_check_of_everything_finds_all_centres() -> None:
    assert 15 == len(graphkin.check(SIXBAR).centres.pairs)


def test_a_group_that_is_not_asked_for_may_stand_in_a_dead_point() -> None:
    mapping = {
        "frame": {"points": {"A": [0, 0], "D": [400, 0], "G": [500, 290]}, "guides": {}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B", "C"], "length": 500},
            "3": {"points": ["D", "C"], "length": 300},
            "4": {"points": ["C", "E"], "length": 1},
            "5": {"points": ["G", "E"], "length": 1},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
        "sketch": {"C": [500, 290]},
    }
    with pytest.raises(GraphkinError):
        graphkin.check(mapping)
    assert graphkin.check(mapping, find=["omega_3"]).ok


def test_the_report_says_what_was_left_out(tmp_path) -> None:
    graphkin.draw(SIXBAR, out=tmp_path, find=["v_D", "alpha_3"])
    text = (tmp_path / "report.txt").read_text()
    assert "Left out, since nothing asked for needs it: the accelerations of links 4, 5" in text


def test_the_report_names_links_left_out(tmp_path) -> None:
    graphkin.draw(SIXBAR, out=tmp_path, find=["omega_3"])
    assert "needs it: links 4, 5" in (tmp_path / "report.txt").read_text()


def test_the_report_of_everything_leaves_nothing_out(tmp_path) -> None:
    graphkin.draw(SIXBAR, out=tmp_path)
    assert "Left out" not in (tmp_path / "report.txt").read_text()
