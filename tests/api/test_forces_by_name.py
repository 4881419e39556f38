"""Forces and moments are asked for by name like every other quantity: of solve, sweep, prepare, judged tables."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

import graphkin
from graphkin.account.forces import force_stages
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.api.report_text import report_text

SHAPER = Path(__file__).parent.parent / "validation" / "forces" / "shaper-scheme-2.toml"
R34, BALANCE = 12766.4256127, -539.785613917  # public values at position 7
POSITIONS = {"4": 104.90059668782988, "10": -75.09940331217012}


def shaper(**tables):
    return {**graphkin.read(SHAPER).to_dict(), **tables}


def test_a_force_is_told_from_either_of_its_links():
    solved = graphkin.solve(SHAPER, find=["F_4/3", "F_3/4"])
    assert R34 == pytest.approx(abs(solved["F_4/3"][0]), rel=1e-10)
    assert solved["F_4/3"][0] == -solved["F_3/4"][0]


def test_a_sweep_shows_forces_with_their_units():
    turn = graphkin.sweep(SHAPER, positions=4, find=["M_2", "F_4/3", "v_C"])
    assert BALANCE == pytest.approx(turn["M_2"][0], rel=1e-10)
    assert R34 == pytest.approx(abs(turn["F_4/3"][0]), rel=1e-10)
    assert {"M_2 (N m)", "F_4/3 (N)", "F_4/3.x (N)", "F_4/3.y (N)"} <= set(turn.table.heads)


def test_a_sweep_without_wishes_shows_the_forces_too():
    turn = graphkin.sweep(shaper(find=[]), positions=3)
    assert BALANCE == pytest.approx(turn.table["M_2"][0], rel=1e-10)


def test_prepared_forces_are_those_of_solve():
    ready = graphkin.prepare(SHAPER, find=["F_4/3", "v_C", "M_2"], bounds=True)
    assert ("v_C.x", "v_C.y", "F_4/3.x", "F_4/3.y", "M_2") == ready.names
    assert {"v_C": "mm/s", "F_4/3": "N", "M_2": "N m"} == ready.units
    turn, solved = ready.sweep(24), graphkin.solve(SHAPER, sweep=24)
    for name in ("F_4/3", "v_C", "M_2"):
        assert (np.abs(turn[name] - solved[name]) <= 2 * turn.bound(name) + 1e-12).all()
        assert 1e-18 < (turn.bound(name) / np.abs(turn[name]).max()).min()
        assert 1e-9 > (turn.bound(name) / np.abs(turn[name]).max()).max()
    assert BALANCE == pytest.approx(ready.at(14.900596687829875)[-1], rel=1e-10)
    with pytest.raises(graphkin.CallError, match="not given over designs"):
        ready.over({"links.2.length": [80, 90]})


def test_prepared_forces_alone_are_given_where_the_motion_comes_and_where_not():
    ready = graphkin.prepare(shaper(balance={"on": "4"}), find="M_4")
    turn = ready.sweep(12)
    assert np.isfinite(turn["M_4"]).sum() >= 10
    assert ready.at(194.90059668782988) is None


def test_tables_of_forces_over_a_turn_are_judged():
    rows = [{"at": POSITIONS["4"], "M_2": -1059.8, "F_4/3": 12033, "by": "computation"},
            {"at": POSITIONS["10"], "M_2": -88.70, "F_4/3": 1408.4, "by": "computation"}]
    judged = graphkin.audit(shaper(printed_rows=rows)).data
    verdicts = [value["verdict"] for value in judged["values"]]
    assert ["right", "right", "right", "wrong"] == verdicts


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("F_6/2", 'did you mean "F_1/2"'),
        ("P_Q", 'did you mean "P_P"'),
        ("G_2", "there is no G_2 here"),
        ("M_5/6", "there is no M_5/6 here"),
        ("Fi_9", 'there is no link "9"'),
    ],
)
def test_forces_that_there_are_not_are_refused_by_name(name, said):
    for call in (graphkin.solve, graphkin.sweep, graphkin.check):
        with pytest.raises(graphkin.CallError, match=said):
            call(SHAPER, find=[name])
    with pytest.raises(graphkin.SceneError, match=said):
        graphkin.read(shaper(find=[name]))


def test_where_nothing_makes_forces_that_is_said():
    with pytest.raises(graphkin.CallError, match=r"give \[masses.LINK\] or \[loads.NAME\]"):
        graphkin.solve("shaper-scheme-2", find="F_5/6")


def test_both_values_of_a_load_that_begins_here_have_names():
    scene = shaper(loads={"P": {"on": "6", "at": "C", "force": 90, "angle": 0, "when": {"driver": [40, 60]}}})
    solved = graphkin.solve(scene, at=40, find=["P_P", "P_P+", "M_2", "M_2+", "Fi_6", "Fi_6+"])
    here = solved.data["positions"][0]["values"]
    assert [0.0, 0.0] == here["P_P"]
    assert [90.0, 0.0] == pytest.approx(here["P_P+"])
    assert here["M_2"] != here["M_2+"]
    assert here["Fi_6"] == here["Fi_6+"]
    assert json.dumps(here)


def idle(**tables):
    """A slider-crank in its outer dead position, whose load on the crank a force on the slider shall balance."""
    return {
        "frame": {"name": "4", "points": {"A": [0, 0]}, "guides": {"h": {"through": "A", "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["C"], "on": "4.h"},
        },
        "driver": {"link": "1", "angle": 0, "omega": 10},
        "loads": {"P": {"on": "1", "moment": 4}},
        "balance": {"on": "3", "at": "C", "angle": 180},
        **tables,
    }


def test_what_moves_is_known_where_the_balance_does_no_work():
    solved = graphkin.solve(idle(), find=["v_B", "omega_2"])
    assert "ok" == solved.data["positions"][0]["status"]
    assert 300 == pytest.approx(abs(solved["v_B"][0]), rel=1e-12)
    assert ["ok"] * 4 == graphkin.solve(idle(), find="v_C", sweep=4).table["status"].tolist()
    assert ["ok"] * 4 == graphkin.sweep(idle(), find=["v_C"], positions=4).table["status"].tolist()


@pytest.mark.parametrize("find", [None, ["v_C", "F_1/2"]])
def test_forces_that_are_asked_make_it_a_dead_point(find):
    assert "dead point" == graphkin.solve(idle(), find=find).data["positions"][0]["status"]
    with pytest.raises(graphkin.Unsolvable, match="dead point: the balance does no work") as stop:
        graphkin.check(idle(), find=find)
    assert "dead point" == stop.value.status


def test_the_motion_is_drawn_without_the_figures_of_forces_that_there_are_not(tmp_path):
    drawn = graphkin.draw(idle(), find=["v_B"], out=tmp_path)
    assert drawn.ok
    assert {"mechanism", "velocity", "sheet", "centres"} == set(drawn.figures)
    assert ["forces", "lever"] == list(drawn.not_drawn)
    with pytest.raises(graphkin.Unsolvable):
        graphkin.draw(idle(), find=["v_B"], figures=["forces"], out=tmp_path)


def test_a_force_goes_away_without_bound_where_the_balance_does_no_work():
    swept = graphkin.sweep(idle(), positions=4)
    forces = {name: force["extremes"] for name, force in swept.data["forces"].items()}
    assert [None, None, pytest.approx(4000 / 30)] == [e["value"] for e in forces["F_1/2"]]
    assert "it grows without bound there" == forces["F_1/2"][0]["why"]
    assert [pytest.approx(4000 / 50), pytest.approx(4000 / 110)] == [e["value"] for e in forces["F_4/3"]]
    assert [pytest.approx(np.pi), 0] == [e["driver"] for e in forces["F_4/3"]]
    assert "F_1/2 (N): grows without bound at 0°, 180°; minimum 133.333 @ " in swept.text


def test_the_balance_by_the_lever_is_told_in_the_units_of_the_scene():
    checked = graphkin.check(graphkin.read("shaper-forces").replace("units", {"force": "kN"}))
    moment = f"{checked['M_2'].measured:.2f}"
    assert f"M_2 = {moment} kN m by the lever, {moment} kN m by the polygons" in report_text(checked, "en")


def test_two_cylinders_on_one_link_have_a_force_each():
    plate = {
        "frame": {"points": {"D": [0, 0], "E": [-60, -80], "G": [160, -60]}},
        "links": {
            "5": {"points": ["D", "H"], "length": 60},
            "1": {"points": ["H", "B"], "length": 70, "at": {"C": [40, 30]}},
            "3": {"points": ["E"]},
            "4": {"points": ["G"]},
        },
        "pins": {"B": {"of": "1", "in": "3"}, "C": {"of": "1", "in": "4"}},
        "masses": {"1": {"at": "B", "mass": 3}},
        "gravity": {"g": 10},
        "driver": [{"slide": "B/3", "travel": 170, "velocity": 0}, {"slide": "C/4", "travel": 130, "velocity": 0}],
        "sketch": {"H": [30, 50], "B": [90, 20], "C": [60, 80]},
    }
    solved = graphkin.solve(plate, find=["F_1@B", "F_1@C", "H", "B", "C"])
    h, b, c = (complex(solved[f"{p}@1"][0]) for p in "HBC")
    # three forces along the rod and both cylinders carry 30 N at B
    lines = [(h, h), (b, b - (-60 - 80j)), (c, c - (160 - 60j))]
    units = [along / abs(along) for _, along in lines]
    arms = [((at - b).conjugate() * u).imag for (at, _), u in zip(lines, units, strict=True)]
    _, at_b, at_c = np.linalg.solve([[u.real for u in units], [u.imag for u in units], arms], [0, 30, 0])
    assert [at_b * units[1], at_c * units[2]] == pytest.approx([solved["F_1@B"][0], solved["F_1@C"][0]])
    checked = graphkin.check(plate, find=["F_1@B", "F_1@C"])
    assert checked.ok
    # each stood in the polygon of accelerations too, and the handout ended in a traceback
    assert {"v", "a", "an", "at", "ak", "ar"} >= {s.kind for drawn in checked.sheet.vectors.values() for s in drawn}


def test_two_cylinders_on_one_pin_have_a_force_each():
    # both were F_1@B: solve gave their sum, check was not ok
    plate = {
        "frame": {"points": {"E": [-60, -80], "G": [160, -60], "D": [0, 60]}},
        "links": {"1": {"points": ["B", "H"], "length": 40}, "5": {"points": ["D", "H"], "length": 60},
                  "3": {"points": ["E"]}, "4": {"points": ["G"]}},
        "pins": {"B": {"of": "1", "in": ["3", "4"]}},
        "masses": {"1": {"at": "B", "mass": 3}},
        "gravity": {"g": 10},
        "driver": [{"slide": "B/3", "travel": 150, "velocity": 0}, {"slide": "B/4", "travel": 180, "velocity": 0}],
        "sketch": {"B": [60, 50], "H": [50, 85]},
    }
    solved = graphkin.solve(plate, find=["F_1@B@3", "F_1@B@4", "B"])
    b = complex(solved["B@1"][0])
    units = [along / abs(along) for along in (b - (-60 - 80j), b - (160 - 60j))]
    sizes = np.linalg.solve([[u.real for u in units], [u.imag for u in units]], [0, 30])
    assert [*(sizes * units)] == pytest.approx([solved["F_1@B@3"][0], solved["F_1@B@4"][0]])
    assert graphkin.check(plate).ok


def test_the_inertia_force_is_shifted_by_one_number_in_its_sum_and_in_the_table():
    # 183.8 in the sum, −183.8 in the table
    checked = graphkin.check("shaper-forces")
    account = Account(checked.sheet, notation_of(checked.sheet, "us"))
    sums = [repr(line) for stage in force_stages(account) for told in stage.steps for line in told.sums]
    assert f"$h_{{4}}$ = −{abs(checked['h_4'].exact):.1f}" in " ".join(sums)
    assert checked["h_4"].exact < 0.0
