"""Groups larger than a dyad on the drawing board: how they are drawn, that all of it agrees, that a slip shows."""

from __future__ import annotations

import cmath
import math
from itertools import product
from typing import Any

import pytest

import graphkin
from graphkin import solver
from graphkin.checking.readings import read_off
from graphkin.construction import OwnValues, Room, draft, execute, plan
from graphkin.construction.board.instruments import pencil
from graphkin.construction.board.steps import Curve, TrialPositions
from graphkin.construction.polygons import elements
from graphkin.errors import Unsolvable
from graphkin.plane import dot
from graphkin.scene import mechanism_of
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import Symbol
from tests import EVERYTHING
from tests.bench.digits import random_driven, worst

LIBRARY = {
    "sixbar-1A-last-link": "special points",
    "triad-slider": "special points",
    "loader-cylinder": "special points",
    "single-flier": "special points",
    "contour-four-bars": "superposition",
    "scissor-lift": "special points",
    "double-butterfly": "superposition",
}

CRANK = {
    "1": {"points": ["A", "B"], "length": 50},
    "2": {"points": ["B", "C"], "length": 130},
}
PLATE = {"points": ["C", "D"], "length": 90, "at": {"E": [40, 75]}}
LEGS: dict[str, dict[str, Any]] = {
    "pin in a slot of the frame": {"pins": {"E": {"of": "3", "in": "0.g"}}},
    "block on a turned guide": {"links": {"5": {"points": ["E"], "on": "0.g"}}},
    "guide of the plate in a swivelling block": {
        "plate": {"guides": {"s": {"through": [40, 75], "angle": 70}}},
        "links": {"5": {"points": ["H"], "on": "3.s"}},
    },
    "cylinder": {
        "links": {"5": {"points": ["H"]}, "6": {"points": ["E"], "on": "5"}},
        "driver": {"slide": "6", "travel": 140, "velocity": 30, "acceleration": -20},
    },
}


def triad(leg: str) -> dict[str, Any]:
    """A plate on a rod, a rocker and a leg of a kind."""
    more = LEGS[leg]
    drivers = [{"link": "1", "angle": 75, "omega": 8, "alpha": -15}]
    return {
        "frame": {"points": {"A": [0, 0], "G": [250, -20], "H": [190, 260]},
                  "guides": {"g": {"through": [175, 130], "angle": 20}}},
        "links": {**CRANK, "3": PLATE | more.get("plate", {}), "4": {"points": ["G", "D"], "length": 95},
                  **more.get("links", {})},
        "pins": more.get("pins", {}),
        "driver": [*drivers, more["driver"]] if "driver" in more else drivers[0],
        "sketch": {"B": [13, 48], "C": [140, 70], "D": [228, 72], "E": [180, 140]},
    }


def driven_inside(leg: str) -> dict[str, Any]:
    """The same, driven by the plate's turning from the rod: the crank is in the group too."""
    scene = triad(leg)
    here = graphkin.solve(scene).data["positions"][0]["links"]
    angle = math.degrees(here["3"]["angle"] - here["2"]["angle"])
    first = {"link": "3", "relative_to": "2", "angle": angle, "omega": 2, "alpha": 3}
    drivers = scene["driver"]
    return {**scene, "driver": [first, *drivers[1:]] if isinstance(drivers, list) else first}


def everything(scene: Any) -> set[str]:
    """The readings that a mechanism has for every link and every moving point."""
    mechanism = mechanism_of(scene)
    points = {p for link in mechanism.links for p in link.points} - set(mechanism.frame.points)
    return {f"{kind}_{link.name}" for link in mechanism.links for kind in ("omega", "alpha")} | {
        f"{kind}_{p}" for p in points for kind in "va"
    }


@pytest.mark.parametrize("name", LIBRARY)
def test_how_a_group_is_drawn_is_named_and_every_reading_agrees(name: str) -> None:
    data = graphkin.check(name).data
    rows = {row["symbol"]: row for row in data["readings"]}
    assert LIBRARY[name] == data["construction"]
    assert set() == everything(name) - set(rows)
    assert [] == [symbol for symbol, row in rows.items() if not row["ok"]]


@pytest.mark.parametrize("leg", LEGS)
def test_a_triad_with_any_leg_is_drawn_by_special_points(leg: str) -> None:
    result = graphkin.check(triad(leg))
    assert "special points" == result.data["construction"]
    assert set() == everything(triad(leg)) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


STEEP_SLOT: dict[str, Any] = {  # the plate's arm stands nearly square to the slot: trials by the rocker are uncertain
    "frame": {"points": {"A": [0, 0], "G": [150, -10]}, "guides": {"s": {"through": [96, 96], "angle": 30}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 34.986}, "2": {"points": ["B", "C"], "length": 61.057},
        "3": {"points": ["C", "D"], "length": 59.666,
              "at": {"E": {"from": ["C", "D"], "r": [42.802, 57.689], "side": "left"}}},
        "4": {"points": ["G", "D"], "length": 62.032},
    },
    "pins": {"E": {"of": "3", "in": "0.s"}},
    "driver": {"link": "1", "angle": 59, "omega": 12, "alpha": -8},
    "sketch": {"B": [18, 30], "C": [70, 62], "D": [128, 48], "E": [96, 96]},
}


@pytest.mark.parametrize("seed", [3, 5, 7])
def test_a_group_is_placed_by_hand_where_the_first_trial_does_not_close(seed: int) -> None:
    planned = plan(mechanism_of(STEEP_SLOT))
    exact, drawn = (
        {r.symbol: complex(r.value) for r in read_off(sheet) if r.symbol.kind == "v"}
        for sheet in (execute(planned), execute(planned, pencil(Tools(), seed)))
    )
    largest = max(map(abs, exact.values()))
    assert [] == [str(symbol) for symbol, v in exact.items() if abs(drawn[symbol] - v) > 0.3 * largest]


def test_a_value_that_a_group_does_not_reach_is_refused_with_its_limits() -> None:
    scene = mechanism_of(STEEP_SLOT)
    with pytest.raises(Unsolvable, match=r"driver 1 moves between -13\.01895\d deg and 99\.52797\d deg"):
        draft(scene, {"1": math.radians(140)})


@pytest.mark.parametrize("leg", LEGS)
def test_a_group_with_a_driver_inside_agrees_too(leg: str) -> None:
    result = graphkin.check(driven_inside(leg))
    assert set() == everything(triad(leg)) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]


def wrong(name: Any, own_values: OwnValues) -> set[str]:
    """Readings that a drawing with a slip gets wrong by more than 1e-9."""
    scene = mechanism_of(name)
    motion = solver.solve(scene)
    largest: dict[str, float] = {}
    found: dict[str, float] = {}
    for reading in read_off(execute(plan(scene), own_values=own_values)):
        exact = complex(motion.value(reading.symbol)[0])
        kind = reading.symbol.kind[0]
        largest[kind] = max(largest.get(kind, 0.0), abs(exact))
        found[str(reading.symbol)] = abs(reading.value - exact)
    return {symbol for symbol, error in found.items() if error > 1e-9 * largest[symbol[0]]}


CONTOUR: dict[str, Any] = {  # two plates joined by two bars whose lines cross on the sheet
    "frame": {"points": {"A": [0, 0], "G": [190, -10]}},
    "links": {
        "2": {"points": ["A", "B"], "length": 40},
        "3": {"points": ["B", "C"], "length": 60, "at": {"D": [35, 85]}},
        "4": {"points": ["C", "E"], "length": 75},
        "5": {"points": ["D", "F"], "length": 70},
        "6": {"points": ["G", "E"], "length": 80, "at": {"F": [90, -75]}},
    },
    "driver": {"link": "2", "angle": 70, "omega": 10, "alpha": -20},
    "sketch": {"C": [60, 75], "D": [0, 120], "E": [130, 60], "F": [60, 90]},
}
SLIDING: dict[str, Any] = {  # nothing of the group turns but with the crank
    "frame": {"points": {"A": [0, 0], "B": [-11, 179], "C": [166, 285], "F": [315, 83]}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["B"], "on": "3.g"},
        "3": {"guides": {"g": {"through": [-118, 119], "angle": 168}, "h": {"through": [18, 239], "angle": 137}},
              "on": "4.k"},
        "4": {"guides": {"k": {"through": [-80, 29], "angle": -9}}, "on": "1"},
        "5": {"points": ["C", "D"], "length": 123, "on": "3.h", "angle_on": -150},
        "6": {"points": ["D", "E"], "length": 75},
        "7": {"points": ["E", "F"], "length": 148},
    },
    "driver": {"link": "1", "angle": 6, "omega": 5.5, "alpha": -14},
    "sketch": {"D": [284, 251], "E": [354, 226]},
}
STEEP: dict[str, Any] = {  # between two trial angles 1 degree apart G runs to infinity and back through the fit
    "frame": {"points": {"A": [0, 0], "H": [-11, 232.3]}},
    "links": {
        "1": {"points": ["A", "J"], "length": 72.978},
        "4": {"points": ["E", "H"], "length": 187.338, "on": "9.k", "angle_on": 220.3},
        "5": {"points": ["G"], "guides": {"g": {"through": [148.356, -21.644], "angle": -188.67}}},
        "6": {"points": ["E"], "on": "5"},
        "7": {"points": ["G"]},
        "8": {"points": ["F", "J"], "length": 123.007, "on": "5.g", "angle_on": -5.02},
        "9": {"points": ["F"], "guides": {"k": {"through": [-26.312, -7.69], "angle": -127.72}}, "on": "7"},
    },
    "driver": {"link": "1", "angle": 25, "omega": 8, "alpha": -30},
    "sketch": {"E": [137.5, 118], "F": [154.2, 116.7], "G": [86.5, 36.6]},
}
BARE: dict[str, Any] = {  # what a trial leaves open lies where a link without points slides on another
    "frame": {"points": {"A": [0, 0], "F": [273.786, 129.737]}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["B"], "on": "5.g", "angle_on": 5.2},
        "3": {"guides": {"h": {"through": [-163.6, -49.939], "angle": -219.89},
                         "k": {"through": [-150.307, -212.216], "angle": 28.41}}, "on": "1"},
        "4": {"points": ["E"], "on": "3.h"},
        "5": {"points": ["C"], "guides": {"g": {"through": [88.605, 156.396], "angle": -215.1}}, "on": "3.k",
              "angle_on": -25.2},
        "6": {"points": ["C", "D"], "length": 67.121, "at": {"E": [-51.368, 56.945]}},
        "7": {"points": ["B", "D"], "length": 181.707, "at": {"F": [55.829, 72.85]}},
    },
    "driver": {"link": "7", "relative_to": "1", "angle": -103.78, "omega": 3.44, "alpha": 38.5},
    "sketch": {"B": [182.6, 140.2], "C": [212.1, -36.5], "D": [275.9, -15.7], "E": [145.6, 1.6]},
}
UNBARRED: dict[str, Any] = {  # only the driven angle and guides that miss the points tell how links are turned
    "frame": {"points": {"A": [0, 0], "C": [107.632, 196.258]},
              "guides": {"g": {"through": [432.677, 113.137], "angle": 125.2}}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["C"], "guides": {"h": {"through": [58.18, 93.084], "angle": 202}}, "on": "5.j"},
        "3": {"points": ["B"], "guides": {"k": {"through": [121.635, -267.306], "angle": -189.52}}, "on": "1",
              "angle_on": 30},
        "4": {"points": ["B"], "on": "2.h", "angle_on": 30},
        "5": {"points": ["D"], "guides": {"j": {"through": [70.024, -252.679], "angle": -51.6}}, "on": "3.k"},
        "6": {"points": ["D", "E"], "length": 96.797},
        "7": {"points": ["E"], "on": "0.g"},
    },
    "driver": {"link": "4", "relative_to": "6", "angle": 100.69, "omega": 12.36, "alpha": 0.7},
    "sketch": {"B": [43.1, 52.7], "D": [340.6, 170.9], "E": [425.2, 123.8]},
}
HELD: dict[str, Any] = {  # only dyads remain where the driven block is left out, and what it slides on is driven
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": [250.829, -2.869], "angle": 142.7}}},
    "links": {
        "1": {"points": ["A", "E"], "length": 75.156},
        "2": {"points": ["B", "D"], "length": 145.221, "on": "0.g", "angle_on": -71.46},
        "3": {"points": ["C"], "guides": {"h": {"through": [52.852, -11.765], "angle": 44.4}}},
        "4": {"guides": {"j": {"through": [22.205, 167.414], "angle": 3.6},
                         "k": {"through": [-140.782, 131.808], "angle": 78.1}}, "on": "6.m"},
        "5": {"points": ["B", "C"], "length": 105.093, "on": "4.j", "angle_on": -65.08},
        "6": {"points": ["E"], "guides": {"m": {"through": [-13.009, 21.165], "angle": -113.2}}, "on": "3.h",
              "angle_on": 92.1},
        "7": {"points": ["D"], "on": "4.k"},
    },
    "driver": {"link": "3", "relative_to": "1", "angle": -193.22, "omega": -11.17, "alpha": 37.6},
    "sketch": {"B": [188.7, 44.4], "C": [84.5, 31.4], "D": [235.5, 181.9], "E": [39.2, 64.1]},
}

WELDED: dict[str, Any] = {  # a driven hinge in the group, and one place of both its links
    "frame": {"points": {"A": [0, 0], "E": [76.669, 34.436]}},
    "links": {
        "1": {"points": ["A", "D"], "length": 27.041},
        "2": {"points": ["C"], "guides": {"h": {"through": [-66.393, 49.62], "angle": 165.8}}},
        "3": {"points": ["B", "D"], "length": 212.559, "on": "2.h", "angle_on": -274.53},
        "4": {"points": ["C", "E"], "length": 90.046, "guides": {"g": {"through": [-67.782, 5.291], "angle": -29.8}}},
        "5": {"points": ["B"], "on": "4.g"},
    },
    "driver": {"link": "4", "relative_to": "2", "angle": -97.4, "omega": -12.36, "alpha": -12.8},
    "sketch": {"B": [154.5, 131.7], "C": [140.6, 97.9], "D": [-22.8, 14.5]},
}


@pytest.mark.parametrize("at", [70, 55, 95])
def test_plates_joined_by_two_bars_are_drawn_by_the_special_point_of_both(at: float) -> None:
    result = graphkin.check(CONTOUR, at=at)
    assert "special points" == result.data["construction"]
    assert set() == everything(CONTOUR) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


def test_a_cylinder_that_joins_two_plates_moves_their_special_points_apart() -> None:
    links = {**CONTOUR["links"], "5": {"points": ["D"]}, "7": {"points": ["F"], "on": "5"}}
    pushed = {"slide": "7", "travel": 70, "velocity": 30, "acceleration": -50}
    scene = {**CONTOUR, "links": links, "driver": [CONTOUR["driver"], pushed]}
    result = graphkin.check(scene)
    assert "special points" == result.data["construction"]
    assert [True] == [step.kind == "driven" for step in result.sheet.steps if step.reason == "special point"]
    assert set() == everything(scene) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


@pytest.mark.parametrize("at", [-193.22, -190, -195])
def test_a_group_of_which_only_driven_blocks_can_be_left_out_is_drawn(at: float) -> None:
    result = graphkin.check(HELD, at=at)
    assert set() == everything(HELD) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if row.error > 1e-9 * max(abs(row.exact), 1e-3)]


SLOTTED: dict[str, Any] = {  # links of later groups have their pins in slots of what is left out for a trial
    "frame": {"points": {"A": [34, 65], "C": [63, 100], "E": [-58, 120]}},
    "links": {
        "1": {"points": ["B", "A"], "length": 65.5, "guides": {"s": {"through": [20, 15], "angle": 20}}},
        "2": {"points": ["E", "F"], "length": 260, "at": {"G": [187, -29]}},
        "3": {"points": ["B", "H"], "length": 282.4, "at": {"I": [-40, 32]}},
        "4": {"points": ["F", "H"], "length": 300},
        "5": {"points": ["G", "I"], "length": 155.5, "guides": {"s": {"through": [0, 20], "angle": 0}}},
        "6": {"points": ["C", "K"], "length": 75}, "7": {"points": ["C", "J"], "length": 26},
    },
    "pins": {"J": {"of": "7", "in": "1.s"}, "K": {"of": "6", "in": "5.s"}},
    "driver": {"link": "4", "angle": -161, "omega": 10},
    "sketch": {"B": [-16, 107], "F": [140, -48], "G": [66, -23], "H": [-143, -145], "I": [30, 128], "J": [37, 95],
               "K": [33, 31]},
}


TOUCHED: dict[str, Any] = {  # the same with discs on what is left out
    **{key: part for key, part in SLOTTED.items() if key != "pins"},
    "links": SLOTTED["links"] | {
        "6": SLOTTED["links"]["6"] | {"discs": {"k": {"centre": "K", "r": 4}}},
        "7": SLOTTED["links"]["7"] | {"discs": {"k": {"centre": "J", "r": 4}}},
    },
    "contacts": {"T": {"between": ["6.k", "5.s"]}, "U": {"between": ["7.k", "1.s"]}},
}


def test_a_group_is_drawn_by_the_assumed_speed_of_a_sliding_pair(monkeypatch: pytest.MonkeyPatch) -> None:
    plans = elements._plans
    monkeypatch.setattr(elements, "_plans", lambda *args, **more: (
        plan for plan in plans(*args, **more) if all(kind == "travel" for kind, _ in plan.tried)
    ))
    result = graphkin.check(STEEP)
    assumed = [symbol.kind for s in result.sheet.steps if s.reason == "polygon" for symbol, _ in s.rates]
    assert ["v", "v", "ar", "ar"] == assumed
    velocity = next(step for step in result.sheet.steps if step.reason == "open ends")
    ((symbol, speed),) = velocity.rates
    assert "v_E@4/E@9" == str(symbol)
    assert 1e3 * float(graphkin.solve(STEEP).motion.slide("4/9")[1][0]) == pytest.approx(speed)  # along the guide
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]


@pytest.mark.parametrize("scene", [SLIDING, STEEP, BARE, UNBARRED, WELDED, SLOTTED, TOUCHED])
def test_groups_far_from_points_and_fits_are_drawn_where_they_are_sketched(scene: dict[str, Any]) -> None:
    result = graphkin.check(scene)
    assert set() == everything(scene) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]


def test_a_trial_rate_divided_wrongly_shows() -> None:
    def rate(symbol: Symbol, value: float) -> float | None:
        return value * 1.001 if str(symbol) == "omega_6" else None

    assert {"omega_6"} <= wrong("contour-four-bars", OwnValues(rate=rate))


def test_the_special_point_lies_on_the_lines_of_both_legs() -> None:
    sheet = draft(mechanism_of("sixbar-1A-last-link"))
    acts = [step for step in sheet.steps if step.reason == "special point"]
    points = {str(ref): z for ref, z in sheet.points.items()}
    (step,) = acts
    at = points[step.point]
    legs = {"C": "D", "B": "A", "E": "F"}
    for joint in step.points:
        leg = points[legs[joint]] - points[joint]
        assert 0 == pytest.approx(((at - points[joint]) / leg).imag * abs(leg), abs=1e-9)


def test_trial_polygons_are_drawn_and_divided() -> None:
    sheet = draft(mechanism_of("contour-four-bars"))
    trials = {aid.trial for step in sheet.steps for aid in step.auxiliary if aid.trial}
    assert {1, 2} == trials
    (velocity, _) = (step for step in sheet.steps if step.reason == "open ends")
    one, two = (row[0] for row in velocity.apart)
    assert one * two < 0


FOUR_BARS = ("contour-four-bars", "double-butterfly")


@pytest.mark.parametrize(("name", "at"), [*product(FOUR_BARS, (60, 80, 100)), *product(FOUR_BARS[1:], (20, 200, 300))])
def test_trial_polygons_are_whole_in_their_room_and_hardly_larger_than_the_true_one(name: str, at: float) -> None:
    sheet = draft(mechanism_of(name), {"2": math.radians(at)}, room=Room(polygon=(80.0, 70.0)))
    for diagram in ("velocity", "acceleration"):
        true = [0j, *(z for v in sheet.vectors[diagram].values() for z in (v.tail, v.tip))]
        every = [*true, *(z for aid in sheet.trials(diagram) for z in (aid.tail, aid.tip))]
        assert sheet.trials(diagram)
        for ends, most in ((every, (88.0, 77.0)), (every, [1.25 * max(_reach(true))] * 2)):
            assert all(size <= room for size, room in zip(_reach(ends), most, strict=True))


def _reach(ends: list[complex]) -> tuple[float, float]:
    across, upright = ([part(z) for z in ends] for part in (lambda z: z.real, lambda z: z.imag))
    return max(across) - min(across), max(upright) - min(upright)


def test_trial_rates_lie_on_either_side_of_the_true_one_in_few_figures() -> None:
    sheet = draft(mechanism_of("double-butterfly"))
    for act in (step for step in sheet.steps if step.reason == "open ends"):
        ((_, true),) = act.rates
        assumed = [s.rates[0] for s in sheet.steps if s.reason == "polygon"]
        low, high = (value for symbol, value in assumed if symbol == act.rates[0][0])
        assert 0.0 > (low - true) * (high - true)
        assert [float(f"{value:.2g}") for value in (low, high)] == [low, high]


def test_the_sheet_says_along_which_direction_a_trial_is_left_open() -> None:
    result = graphkin.check("double-butterfly")
    at = {str(ref): z for ref, z in result.sheet.points.items()}
    divided = next(step for step in result.sheet.steps if step.reason == "open ends")
    assert ("8",) == divided.closing
    assert ["∥KD"] == [str(way) for way in divided.ways]
    steps = [step for step in result.sheet.steps if step.diagram == "velocity"]
    drawn = [aid for step in steps for aid in step.auxiliary]
    first = next(aid.tip for aid in drawn if aid.trial == 1 and str(aid.symbol) == "v_K")
    bar = at["K"] - at["D"]
    assert abs((first / bar).real) * abs(bar) == pytest.approx(abs(divided.apart[0][0]), abs=1e-9)


def test_the_trial_curve_passes_the_place_found_between_its_trials() -> None:
    sheet = draft(mechanism_of("triad-slider"))
    (curve,) = (s for step in sheet.steps for s in step.strokes if isinstance(s, Curve))
    place = {str(ref): z for ref, z in sheet.points.items()}[curve.point]
    assert 7 == len(curve.at)
    step = max(abs(b - a) for a, b in zip(curve.at, curve.at[1:], strict=False))
    assert min(abs(z - place) for z in curve.at) < step
    assert min(abs(z - place) for z in curve.at) > 0


@pytest.mark.parametrize("name", ["triad-slider", "double-butterfly", "single-flier"])
def test_the_arc_that_the_trial_curve_meets_has_the_bar_for_radius_about_its_other_end(name: str) -> None:
    sheet = draft(mechanism_of(name))
    ((curve, arc, table),) = (
        (*step.strokes, step) for step in sheet.steps if isinstance(step, TrialPositions)
    )
    at = {str(ref): z for ref, z in sheet.points.items()}
    (missed,) = table.missed
    (other,) = set(missed.names) - {curve.point}
    assert [at[other], at[curve.point]] == pytest.approx([arc.centre, arc.at], abs=1e-9)
    assert arc.radius * sheet.scales.length == pytest.approx(missed.length, abs=1e-12)


@pytest.mark.parametrize(("name", "bar"), [("triad-slider", "BC"), ("double-butterfly", "DK")])
def test_what_is_missed_in_trial_positions_is_divided_to_the_place_where_nothing_is(name: str, bar: str) -> None:
    sheet = draft(mechanism_of(name))
    (table,) = (step for step in sheet.steps if isinstance(step, TrialPositions))
    (missed,), (moved,) = table.missed, table.moved
    assert ("bar", set(bar)) == (missed.kind, set(missed.names))
    at = {str(ref): z for ref, z in sheet.points.items()}
    length = abs(at[bar[0]] - at[bar[1]]) * sheet.scales.length
    assert length == pytest.approx(missed.length, abs=1e-12)
    ((a,), (one,)), ((b,), (two,)) = table.trials[table.before - 1 : table.before + 1]
    assert one * two < 0
    assert table.divided[0][0][0] == pytest.approx((a * two - b * one) / (two - one), abs=1e-9)
    p, q = mechanism_of(name).by_name[moved.link].bar
    turned = math.degrees(cmath.phase((at[q] - at[p]) * cmath.rect(1, -table.divided[-1][0][0])))
    assert 0 == pytest.approx(turned, abs=0.1)


@pytest.mark.parametrize("scene", [BARE, UNBARRED], ids=["BARE", "UNBARRED"])
def test_what_two_trial_drivers_miss_is_divided_to_the_place_where_nothing_is(scene: dict[str, Any]) -> None:
    sheet = draft(mechanism_of(scene))
    (table,) = (step for step in sheet.steps if isinstance(step, TrialPositions))
    (a, one), (b, two), (c, three) = table.trials
    assert [0, 0] == [b[1] - a[1], c[0] - a[0]]
    p, q = table.parts
    left = [x + p * (y - x) + q * (z - x) for x, y, z in zip(one, two, three, strict=True)]
    assert [0, 0] == pytest.approx(left, abs=1e-9)
    first, last = table.divided
    assert first[0] == pytest.approx((a[0] + p * (b[0] - a[0]), a[1] + q * (c[1] - a[1])))
    unseen = 0.02 * sheet.scales.length
    assert max(map(abs, first[1])) > unseen > max(map(abs, last[1]))
    misses = [max(map(abs, row)) for _, row in table.trials]
    assert table.replaced[0] == 1 + misses.index(max(misses))  # what misses most gives way
    assert "" == table.moved[0].other
    laid = next(s for s in sheet.steps if s.reason == "angle" and s.link == table.moved[0].link)
    assert laid.value == pytest.approx(last[0][0], abs=1e-4)


def test_why_trial_polygons_are_drawn_is_known() -> None:
    def why(name: str) -> list[tuple[str, ...] | None]:
        trials = [step for step in draft(mechanism_of(name)).steps if step.reason == "polygon"]
        return [trial.far and trial.far.links for trial in trials if trial.trial == 1]

    assert [("4", "5")] * 2 == why("contour-four-bars")
    assert [None] * 2 == why("double-butterfly")


def test_what_is_known_of_the_end_left_open_is_taken_off_in_the_sense_in_which_it_is_measured() -> None:
    sheet = draft(mechanism_of("double-butterfly"))
    act = [step for step in sheet.steps if step.reason == "open ends"][1]
    (((taken, mm),),) = act.less
    at = {str(ref): z for ref, z in sheet.points.items()}
    scales, omega = sheet.scales, sheet.rates["omega"]["8"].value
    normal = -(omega**2) * (at["D"] - at["K"]) * scales.length / scales.acceleration
    along = (at["D"] - at["K"]) / abs(at["D"] - at["K"])
    assert "an_D/K" == str(taken.symbol)
    assert mm == pytest.approx((normal * along.conjugate()).real, abs=1e-9)


def test_a_pencil_keeps_what_it_promises() -> None:
    report = graphkin.check("triad-slider", instrument="pencil", seed=3).report
    assert report.ok
    assert all(row.uncertainty is not None for row in report.rows)


def parallel_legs(moving: bool) -> dict[str, Any]:
    """A plate on three legs of which two are parallel; with the upper end of one on the frame, or on the crank."""
    b, h = 13 + 48j, 180 + 240j
    own = h * abs(b) / b
    crank = {"points": ["A", "B"], "length": abs(b), **({"at": {"H": [own.real, own.imag]}} if moving else {})}
    return {
        "frame": {"points": {"A": [0, 0], "G": [230, -25], **({} if moving else {"H": [180, 240]})}},
        "links": {
            "1": crank, "2": {"points": ["B", "C"], "length": abs(140 + 70j - b)},
            "3": {"points": ["C", "D"], "length": 90, "at": {"E": [40, 70], "K": [30, -40]}},
            "4": {"points": ["G", "D"], "length": 95}, "5": {"points": ["H", "E"], "length": 100},
        },
        "driver": {"link": "1", "angle": math.degrees(cmath.phase(b)), "omega": 8, "alpha": -15},
        "sketch": {"B": [13, 48], "C": [140, 70], "D": [230, 70], "E": [180, 140]},
    }


@pytest.mark.parametrize("moving", [False, True])
def test_between_parallel_legs_the_direction_gives_the_rate_and_all_points_follow_by_image(moving: bool) -> None:
    result = graphkin.check(parallel_legs(moving))
    assert ["parallel legs"] == [r.key for r in result.sheet.noticed if r.key == "parallel legs"]
    assert {"v_E", "v_K", "a_E", "a_K", "omega_3", "alpha_3"} <= {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]
    assert moving == (abs(result["omega_3"].exact) > 1)


def two_plates(moving: bool) -> dict[str, Any]:
    """Two plates hinged to each other, each on two parallel legs; those of the first from the crank and the frame, or
    both from the crank, so that the plate turns otherwise."""
    at = {"B": 13 + 48j, "C": 110 + 90j, "D": 90 + 190j, "E": 200 + 140j, "F": 300 + 190j, "G": 290 + 90j,
          "K": 330 + 280j, "L": 265 + 15j}
    at["H"] = at["D"] - 0.9 * (at["C"] - at["B"])

    def link(p: str, q: str, third: str = "") -> dict[str, Any]:
        bar = at[q] - at.get(p, 0j)
        made: dict[str, Any] = {"points": [p, q], "length": abs(bar)}
        if third:
            own = (at[third] - at.get(p, 0j)) * abs(bar) / bar
            made["at"] = {third: [own.real, own.imag]}
        return made

    fixed = {p: [at[p].real, at[p].imag] for p in ("KL" if moving else "HKL")}
    return {
        "frame": {"points": {"A": [0, 0], **fixed}},
        "links": {
            "1": link("A", "B", "H" if moving else ""), "2": link("B", "C"), "3": link("C", "E", "D"),
            "4": link("H", "D"), "5": link("E", "F", "G"), "6": link("K", "F"), "7": link("L", "G"),
        },
        "driver": {"link": "1", "angle": math.degrees(cmath.phase(at["B"])), "omega": 8, "alpha": -15},
        "sketch": {p: [at[p].real, at[p].imag] for p in "BCDEFG"},
    }


@pytest.mark.parametrize("moving", [False, True])
def test_where_a_plate_has_no_legs_but_parallel_ones_these_give_its_rate(moving: bool) -> None:
    result = graphkin.check(two_plates(moving))
    assert ("C", "D") in {tuple(r.of.values()) for r in result.sheet.noticed if r.key == "parallel legs"}
    assert set() == everything(two_plates(moving)) - {str(row.symbol) for row in result.report.rows}
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]
    # along the legs both joints have what the legs' other ends have
    b, c, d = 13 + 48j, 110 + 90j, 90 + 190j
    leg, h = c - b, d - 0.9 * (c - b) if moving else 0j
    rate = dot(8j * (h - b), leg) / dot(1j * (d - c), leg)
    assert rate == pytest.approx(float(result["omega_3"].measured), rel=1e-9)


@pytest.mark.parametrize("seed", range(200 if EVERYTHING else 6))
def test_drawing_and_solver_of_a_random_larger_group_are_right_to_nine_digits(seed: int) -> None:
    drawn, solved, readings = worst(random_driven(seed))
    assert readings >= 6
    assert max(drawn, solved) < 1e-9


def test_a_group_of_two_trial_drivers_is_found_where_one_point_of_it_is_sketched() -> None:
    found = graphkin.check({**BARE, "sketch": {"B": BARE["sketch"]["B"]}})
    assert found.ok
    sketched = {str(row.symbol): row.exact for row in graphkin.check(BARE).report.rows}
    assert sketched == pytest.approx({str(row.symbol): row.reading.value for row in found.report.rows}, abs=1e-9)


def test_trial_polygons_of_a_mechanism_that_nothing_but_a_slide_drives_are_divided() -> None:
    scene = graphkin.read("contour-four-bars").to_dict()
    frame = {**scene["frame"], "guides": {"g": {"through": [0, 30], "angle": 10}}}
    links = {**scene["links"], "2": {"points": ["B"], "on": "1.g"}}
    driver = {"slide": "2", "travel": -5, "velocity": 300, "acceleration": 100}
    result = graphkin.check({**scene, "frame": frame, "links": links, "driver": driver})
    assert {"velocity", "acceleration"} == {step.diagram for step in result.sheet.steps if step.reason == "polygon"}
    assert result.ok


VAGUE: dict[str, Any] = {  # two assemblies lie a few per cent of the size off the sketch
    "frame": {"points": {"P": [60, 0], "Q": [240, -10], "R": [330, 220]}},
    "links": {
        "2": {"points": ["A", "B"], "length": 100, "at": {"C": [60, 70], "H": [-10, -40], "K": [110, -50]}},
        "3": {"points": ["D", "E"], "length": 110, "at": {"F": [60, 50], "L": [130, 60]}},
        "4": {"points": ["A", "D"], "length": 112}, "5": {"points": ["B", "E"], "length": 114},
        "7": {"points": ["C", "G"], "length": 76}, "8": {"points": ["G", "F"], "length": 54},
        "9": {"points": ["P", "H"], "length": 67}, "10": {"points": ["Q", "K"], "length": 67},
        "11": {"points": ["R", "L"], "length": 94},
    },
    "driver": {"link": "8", "relative_to": "7", "angle": -91, "omega": 2, "alpha": -3},
    "sketch": {"A": [100, 100], "B": [200, 90], "C": [160, 170], "D": [120, 210], "E": [230, 200], "F": [180, 260],
               "G": [130, 240], "H": [90, 60], "K": [210, 50], "L": [250, 270]},
}


def test_of_assemblies_about_a_vague_sketch_the_nearest_is_drawn() -> None:
    sheet, motion = draft(mechanism_of(VAGUE)), solver.solve(mechanism_of(VAGUE))
    drawn = {str(ref): z * sheet.scales.length for ref, z in sheet.points.items()}
    assert {p: complex(motion.position(p)[0]) for p in VAGUE["sketch"]} == pytest.approx(
        {p: drawn[p] for p in VAGUE["sketch"]}, abs=1e-9)


@pytest.mark.parametrize(("own", "at"), [(180, 100), (0, -20), (0, 200)])
def test_where_the_own_position_is_a_dead_point_others_are_drawn_all_the_same(own: int, at: int) -> None:
    parallel = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 60}, "2": {"points": ["B", "C"], "length": 100},
                  "3": {"points": ["C", "D"], "length": 60}},
        "driver": {"link": "1", "angle": own, "omega": 1},
        "sketch": {"C": [100 + 60 * math.cos(math.radians(own)), -20]},  # tells nothing there
    }
    assert graphkin.check(parallel, at=at).ok


def test_beside_a_dead_point_others_are_drawn_on_the_side_from_which_the_motion_comes() -> None:
    kite = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 100}, "2": {"points": ["B", "C"], "length": 60},
                  "3": {"points": ["C", "D"], "length": 60}},
        "driver": {"link": "1", "angle": 0, "omega": 1},
    }
    assert graphkin.check(kite, at=350).ok  # ahead the motion ends at 73.7 degrees
