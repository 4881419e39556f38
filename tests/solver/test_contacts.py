"""Outlines that touch, and wheels: the solver beside another one in 50 digits, and beside what figures must keep."""

import cmath
import math

import numpy as np
import pytest

from graphkin import check, read, solve, solver, sweep
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver.touching import contact_normal
from graphkin.structure import analyse


def frame_of(data):
    return data["positions"][0]


def test_the_flat_rocker_moves_as_the_exercise_says():
    here = frame_of(solve("cam-eccentric-flat-rocker").data)
    assert here["links"]["2"]["omega"] == pytest.approx(2.633742889782669, rel=1e-13)
    assert here["links"]["2"]["alpha"] == pytest.approx(4.348559188361159, rel=1e-12)
    assert here["points"]["K@2"]["acceleration"] == pytest.approx([51.78362191245033, -539.5945080649294], rel=1e-12)
    contact = here["contacts"]["K"]
    assert "sliding" == contact["kind"]
    assert contact["position"] == pytest.approx([39.63291103600903, 52.48331285821464], rel=1e-13)
    assert contact["normal"] == pytest.approx([0.7926582207201806, 0.6096662571642928], rel=1e-13)
    assert contact["slip"] == pytest.approx([-386.60557650958424, 502.64564390022593], rel=1e-12)
    assert contact["pressure"] == pytest.approx({"1": 1.3024301158889897, "2": 0.0}, abs=1e-12)


def test_two_discs_move_as_the_four_bar_of_their_centres():
    here = frame_of(solve("disc-on-disc").data)
    assert here["links"]["2"]["alpha"] == pytest.approx(55.609990265700986, rel=1e-12)
    assert here["contacts"]["K"]["pressure"]["2"] == pytest.approx(0.1991395448398155, rel=1e-12)


@pytest.mark.parametrize("scene", ["disc-on-disc", "cam-eccentric-flat-rocker"])
def test_at_a_contact_the_relative_acceleration_has_a_part_along_the_normal_one_along_the_tangent_and_that_of_coriolis(
    scene,
):
    motion = solver.solve(mechanism_of(scene))
    normal = contact_normal(motion, motion.scene.contacts[0])[0]
    an, ar, ak = (motion.value(Symbol.parse(f"{kind}_K@1/K@2"))[0] / normal for kind in ("an", "ar", "ak"))
    whole = (motion.acceleration("K", "1") - motion.acceleration("K", "2"))[0] / normal
    assert (0.0, 0.0) == pytest.approx((an.imag, ar.real), abs=1e-14 * abs(whole))
    assert whole == pytest.approx(an + ar + ak, rel=1e-13)
    assert min(abs(an), abs(ar), abs(ak)) > 0.05 * abs(whole)


def test_the_outlines_touch_all_the_turn_and_slide_along_the_tangent():
    turn = solve("disc-on-disc", sweep=24)
    for here in turn.data["positions"]:
        contact = here["contacts"]["K"]
        normal, slip = complex(*contact["normal"]), complex(*contact["slip"])
        at = complex(*contact["position"])
        assert 40 == pytest.approx(abs(at - complex(*here["points"]["O@1"]["position"])), rel=1e-12)
        assert 15 == pytest.approx(abs(at - complex(*here["points"]["B@2"]["position"])), rel=1e-12)
        assert 0 == pytest.approx((normal.conjugate() * slip).real, abs=1e-10 * abs(slip))


def test_a_flat_face_that_slides_moves_as_a_scotch_yoke():
    turn = sweep("cam-eccentric-flat-slider", positions=36, find=["B", "pressure_2"])
    angle = np.radians(40 + np.arange(36) * 10)
    assert 40 + 15 * np.sin(angle) == pytest.approx(turn["B"].imag, rel=1e-13)
    assert np.zeros(36) == pytest.approx(turn["pressure_2"], abs=1e-9)


def test_the_normal_of_a_contact_points_out_of_the_body_that_the_file_names_first() -> None:
    disc_first = read("cam-eccentric-flat-slider")
    face_first = disc_first.replace("contacts.K.between", ["2.f", "1.k"])
    out_of_disc, out_of_face = (
        complex(*solve(scene).data["positions"][0]["contacts"]["K"]["normal"]) for scene in (disc_first, face_first)
    )
    assert -out_of_disc == pytest.approx(out_of_face, rel=1e-12)


@pytest.mark.parametrize("scene", ["cam-eccentric-flat-rocker", "cam-eccentric-flat-slider", "disc-on-disc"])
def test_a_contact_is_a_higher_pair_and_its_replacement_leaves_the_mobility(scene):
    structure = analyse(mechanism_of(scene))
    assert (2, 2, 1, 1) == (*vars(structure.mobility).values(), structure.mobility.value)


@pytest.mark.parametrize("at", [0, 75, 200, 310])
@pytest.mark.parametrize("scene", ["cam-eccentric-flat-rocker", "cam-eccentric-flat-slider", "disc-on-disc"])
def test_the_drawing_agrees_with_the_solver_on_the_points_at_the_contact(scene, at):
    asked = ["v_K@1", "v_K@2", "a_K@1", "a_K@2", "v_K@1/K@2", "pressure_2", "x_K"]
    result = check(scene, at=at, find=asked)
    for name in asked:
        row = result[name]
        assert row.exact == pytest.approx(row.measured, rel=1e-9, abs=1e-9)


def test_a_hollow_outline_holds_a_smaller_disc():
    ring = {
        "frame": {"points": {"A": [0, 0], "C": [70, 0]}},
        "links": {
            "1": {"points": ["A", "O"], "length": 20, "discs": {"k": {"centre": "O", "r": -75}}},
            "2": {"points": ["C", "B"], "length": 55, "discs": {"w": {"centre": "B", "r": 15}}},
        },
        "contacts": {"K": {"between": ["1.k", "2.w"]}},
        "sketch": {"B": [40, 45]},
        "driver": {"link": "1", "angle": 30, "omega": 3},
    }
    here = frame_of(solve(ring).data)
    o, b, k = (complex(*here["points"][p]["position"]) for p in ("O@1", "B@2", "K@1"))
    assert [60, 75, 15] == pytest.approx([abs(b - o), abs(k - o), abs(k - b)], rel=1e-12)
    assert 1.0 == pytest.approx((complex(*here["contacts"]["K"]["normal"]) / ((o - k) / abs(o - k))).real, rel=1e-12)


def test_willis_formula_holds_in_an_epicyclic_train():
    here = frame_of(solve("gears-epicyclic").data)
    assert 3 == pytest.approx(here["links"]["2"]["omega"], rel=1e-14)
    assert -7.5 == pytest.approx(here["links"]["3"]["omega"], rel=1e-14)
    assert [70, 0] == pytest.approx(here["gears"]["ring"]["pitch_point"])
    assert [20, -70] == pytest.approx(here["gears"]["ring"]["radii"])


def test_wheels_go_the_direct_way_over_more_than_one_turn():
    train = {
        "frame": {"points": {"A": [0, 0], "B": [50, 0], "C": [120, 0]}},
        "links": {
            "1": {"points": ["A"]},
            "2": {"points": ["B"]},
            "3": {"points": ["C", "P"], "length": 35, "start": 90},
        },
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, 30]}, "h": {"between": ["2", "3"], "teeth": [30, 40]}},
        "driver": {"link": "1", "angle": 0, "omega": 12, "alpha": 3},
    }
    here = frame_of(solve(train, at=450).data)
    turned = np.exp(1j * np.radians(90 + 450 / 2))
    assert [35 * turned.real + 120, 35 * turned.imag] == pytest.approx(here["points"]["P@3"]["position"])
    assert 1.5 == pytest.approx(here["links"]["3"]["alpha"], rel=1e-14)


def test_a_wheel_on_a_rail_touches_it_rolling():
    assert "rolling" == frame_of(solve("wheel-on-rail").data)["contacts"]["K"]["kind"]


@pytest.mark.parametrize(("name", "slides"), [("wheel-on-rail", []), ("cam-eccentric-flat-rocker", ["O/2"])])
def test_a_disc_slides_along_a_face_but_where_it_rolls(name: str, slides: list[str]) -> None:
    assert slides == list(frame_of(solve(name).data)["slides"])


def test_a_rim_point_of_a_rolling_wheel_runs_on_a_cycloid():
    turn = sweep("wheel-on-rail", positions=24, find=["P", "v_K@1"])
    rolled = 2 * np.pi * np.arange(24) / 24
    assert 30 * (rolled + np.sin(rolled)) == pytest.approx(turn["P"].real, abs=1e-10)
    assert 30 * (1 + np.cos(rolled)) == pytest.approx(turn["P"].imag, abs=1e-10)
    assert np.zeros(24) == pytest.approx(np.abs(turn["v_K@1"]), abs=1e-10)


def test_a_point_of_a_wheel_in_a_ring_twice_as_large_runs_on_a_straight_line():
    turn = sweep("hypocycloid-straight-line", positions=36, find=["P"])
    assert np.zeros(36) == pytest.approx(turn["P"].imag, abs=1e-11)


@pytest.mark.parametrize("scene", ["gears-epicyclic", "wheel-on-rail", "geared-five-bar", "hypocycloid-straight-line"])
@pytest.mark.parametrize("turned", [0, 130, 500])
def test_the_drawing_agrees_with_the_solver_on_what_rolls(scene, turned):
    driver = mechanism_of(scene).drivers[0]
    result = check(scene, at=np.degrees(driver.values[0]) + turned)
    assert result.ok
    for row in result.report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-9, abs=1e-9)


def test_a_rack_goes_as_far_as_the_pitch_circle_rolls():
    rack = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 40], "angle": 0}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.h", "start": 10}},
        "gears": {"g": {"between": ["1", "2"], "teeth": [20, "rack"]}},
        "driver": {"link": "1", "angle": 0, "omega": 4},
    }
    here = frame_of(solve(rack, at=90).data)
    assert 10 - 40 * np.pi / 2 == pytest.approx(here["slides"]["2/0"]["travel"], rel=1e-13)
    assert {"pitch_point": [0, 40], "radii": [40, None]} == here["gears"]["g"]


def test_a_wheel_on_a_carriage_turns_clockwise_as_it_goes_along_a_rack_below_it():
    carriage = {
        "frame": {"guides": {"h": {"through": [0, 0], "angle": 0}, "r": {"through": [0, -40], "angle": 0}}},
        "links": {"1": {"points": ["A", "P"], "length": 15}, "2": {"points": ["A"], "on": "0.h"}},
        "gears": {"g": {"between": ["1", "0.r"], "teeth": [20, "rack"], "carrier": "2"}},
        "driver": {"slide": "2", "travel": 5, "velocity": 80},
    }
    assert [-2.0] == pytest.approx(solve(carriage)["omega_1"], rel=1e-13)


def test_prepared_wheels_move_as_solved_ones():
    from graphkin import prepare

    asked = ["C", "a_C"]
    ready, turn = prepare("geared-five-bar", find=asked), sweep("geared-five-bar", positions=36, find=asked)
    prepared = ready.sweep(36)
    assert turn["C"] == pytest.approx(prepared["C"], rel=1e-12)
    assert turn["a_C"] == pytest.approx(prepared["a_C"], rel=1e-11)


ROD_WITH_WHEEL = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -20], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B", "C"], "length": 110},
        "3": {"points": ["C", "P"], "length": 15, "start": 30, "discs": {"w": {"centre": "C", "r": 20}}},
    },
    "contacts": {"K": {"between": ["3.w", "0.h"], "rolling": True}},
    "sketch": {"C": [110, 0]},
    "driver": {"link": "1", "angle": 40, "omega": 5, "alpha": 2},
}
SUN_AND_PLANET = {
    "frame": {"points": {"A": [0, 0], "D": [120, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 40},
        "2": {"points": ["B", "C"], "length": 110},
        "3": {"points": ["D", "C"], "length": 90},
        "4": {"points": ["A", "P"], "length": 20, "start": 10},
    },
    "gears": {"g": {"between": ["2", "4"], "teeth": [20, 20], "carrier": "1"}},
    "driver": {"link": "1", "angle": 40, "omega": 5, "alpha": 2},
}
WHEEL_ON_DISC = {
    "frame": {"points": {"A": [0, 0], "D": [120, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 40, "discs": {"k": {"centre": "B", "r": 50}}},
        "2": {"points": ["D", "C"], "length": 95},
        "3": {"points": ["C", "P"], "length": 15, "start": 30, "discs": {"w": {"centre": "C", "r": 20}}},
    },
    "contacts": {"K": {"between": ["1.k", "3.w"], "rolling": True}},
    "sketch": {"C": [70, 80]},
    "driver": {"link": "1", "angle": 40, "omega": 5, "alpha": 2},
}


@pytest.mark.parametrize("order", ["3421", "1243"])
def test_a_wheel_starts_at_its_start_wherever_the_block_that_turns_with_it_stands_in_the_file(order):
    links = {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["D", "C"], "length": 60},
        "3": {"points": ["C"], "on": "4"},
        "4": {"points": ["E"], "start": 60},
    }
    scene = {
        "frame": {"points": {"A": [0, 0], "E": [75, 0], "D": [70, 90]}},
        "links": {name: links[name] for name in order},
        "gears": {"g": {"between": ["1", "4"], "teeth": [20, 40], "carrier": "0"}},
        "driver": {"link": "1", "angle": 40, "omega": 6},
    }
    assert 60 == pytest.approx(np.degrees(frame_of(solve(scene).data)["links"]["4"]["angle"]), rel=1e-12)


def test_a_wheel_at_the_end_of_a_rod_turns_as_far_as_it_rolls():
    own, there = (frame_of(solve(ROD_WITH_WHEEL, at=at).data) for at in (40, 140))
    rolled = (there["points"]["C@3"]["position"][0] - own["points"]["C@3"]["position"][0]) / 20
    assert np.radians(30) - rolled == pytest.approx(there["links"]["3"]["angle"], abs=1e-12)
    assert [0, 0] == pytest.approx(there["points"]["K@3"]["velocity"], abs=1e-12)


def test_where_no_link_holds_both_centres_a_wheel_rolls_on_a_disc_by_the_turn_of_the_line_between_them():
    own, there = (frame_of(solve(WHEEL_ON_DISC, at=at).data) for at in (40, 70))
    assert [0, 0] == pytest.approx(own["contacts"]["K"]["slip"], abs=1e-11)
    between = [np.subtract(at["points"]["C@3"]["position"], at["points"]["B@1"]["position"]) for at in (own, there)]
    line = np.angle(between[1] @ [1, 1j] / (between[0] @ [1, 1j]))
    disc, wheel = (there["links"][name]["angle"] - own["links"][name]["angle"] for name in ("1", "3"))
    assert 50 * (line - disc) + 20 * (line - wheel) == pytest.approx(0, abs=1e-10)


def test_the_sun_turns_twice_as_the_crank_less_the_planet_that_the_rod_holds():
    turns = solve(SUN_AND_PLANET, sweep=36).motion
    assert 2 * turns.omega("1") - turns.omega("2") == pytest.approx(turns.omega("4"), rel=1e-12)
    assert 2 * turns.alpha("1") - turns.alpha("2") == pytest.approx(turns.alpha("4"), rel=1e-11, abs=1e-11)


def test_the_sun_goes_on_over_the_turns_of_the_crank():
    own, later = (frame_of(solve(SUN_AND_PLANET, at=40 + turned).data)["links"]["4"]["angle"] for turned in (0, 360))
    assert np.exp(1j * own) == pytest.approx(np.exp(1j * later), abs=1e-12)


@pytest.mark.parametrize(
    "scene", [ROD_WITH_WHEEL, SUN_AND_PLANET, WHEEL_ON_DISC], ids=["rod with wheel", "sun and planet", "wheel on disc"]
)
@pytest.mark.parametrize("at", [40, 150, 500])
def test_the_drawing_agrees_with_the_solver_where_rods_turn_wheels(scene, at):
    for row in check(scene, at=at).report.rows:
        assert row.exact == pytest.approx(row.reading.value, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("scene", ["disc-on-disc", "cam-eccentric-flat-rocker", "geared-five-bar", "gears-epicyclic"])
def test_the_forces_at_contacts_and_teeth_do_no_work(scene):
    made = read(scene).to_dict()
    made |= {"masses": {"2": {"at": [5, 3], "mass": 2, "inertia": 0.01}}, "gravity": {}}
    solved = solve(made, sweep=12)
    assert solved.ok
    left, largest = solved.forces.power
    assert np.zeros(12) == pytest.approx(left / largest, abs=1e-9)


def test_a_wheel_on_a_rail_of_the_frame_stands_where_it_is_sketched():
    scene = {
        "frame": {"guides": {"rail": {"through": [0, 0], "angle": 0}}},
        "links": {"1": {"points": ["C", "P"], "length": 20, "discs": {"w": {"centre": "C", "r": 30}}}},
        "contacts": {"K": {"between": ["1.w", "0.rail"], "rolling": True}},
        "driver": {"link": "1", "angle": 90, "omega": -2},
        "sketch": {"C": [75, 28]},
    }
    [position] = solve(scene).data["positions"]
    assert [75, 30] == pytest.approx(position["points"]["C@1"]["position"])


@pytest.mark.parametrize("seen", [{"angle": 110, "omega": -1}, {"relative_to": "2", "angle": 90, "omega": -2}])
def test_a_wheel_on_a_rail_of_a_moving_link_stands_where_it_is_sketched(seen):
    scene = {
        "frame": {"points": {"O": [0, 0]}},
        "links": {
            "2": {"points": ["O"], "guides": {"rail": {"through": [10, 0], "angle": 0}}},
            "1": {"points": ["C", "P"], "length": 20, "discs": {"w": {"centre": "C", "r": 30}}},
        },
        "contacts": {"K": {"between": ["1.w", "2.rail"], "rolling": True}},
        "driver": [{"link": "2", "angle": 20, "omega": 1}, {"link": "1", **seen}],
        "sketch": {"C": [60, 50]},
    }
    rail = cmath.rect(1, math.radians(20))
    centre = rail * complex((complex(60, 50) / rail).real, 30)
    [position] = solve(scene).data["positions"]
    assert [centre.real, centre.imag] == pytest.approx(position["points"]["C@1"]["position"])
    # it turns by -2 rad/s on the rail, and with this by 1 rad/s
    velocity = 60 * rail + 1j * centre
    assert [velocity.real, velocity.imag] == pytest.approx(position["points"]["C@1"]["velocity"])


RAIL = {"rail": {"through": [10, 0], "angle": 0}}


@pytest.mark.parametrize(("base", "turn", "known", "scene"), [
    (complex(5, 7) - cmath.rect(17, math.radians(20) + math.atan2(-8, 15)), 20, "C", {  # it turns about another point
        "frame": {"points": {"O": [5, 7]}},
        "links": {"2": {"points": ["Q"], "at": {"O": [15, -8]}, "guides": RAIL}},
        "driver": [{"link": "2", "angle": 20, "omega": 1}],
    }),
    (cmath.rect(50, math.radians(30)), 30, "QC", {  # it slides on the frame
        "frame": {"guides": {"g": {"through": [0, 0], "angle": 30}}},
        "links": {"2": {"points": ["Q"], "on": "0.g", "guides": RAIL}},
        "driver": [{"slide": "2", "travel": 50, "velocity": 1}],
    }),
    (cmath.rect(60, math.radians(30)), 70, "BQC", {  # it is turned from another moving link; its bar is sketched
        "frame": {"points": {"O": [0, 0]}},
        "links": {"5": {"points": ["O", "B"], "length": 60}, "2": {"points": ["B", "Q"], "length": 50, "guides": RAIL}},
        "driver": [{"link": "5", "angle": 30, "omega": 1}, {"link": "2", "relative_to": "5", "angle": 40, "omega": 1}],
    }),
])
def test_a_wheel_stands_where_it_is_sketched_however_the_direction_of_its_rail_is_known(base, turn, known, scene):
    along = cmath.rect(1, math.radians(turn))
    sketched = {"B": base, "Q": base + 50 * along if turn == 70 else base, "C": base + complex(48, 33) * along}
    wheel = {"1": {"points": ["C", "P"], "length": 20, "discs": {"w": {"centre": "C", "r": 30}}}}
    scene = scene | {
        "links": scene["links"] | wheel,
        "contacts": {"K": {"between": ["1.w", "2.rail"], "rolling": True}},
        "driver": [*scene["driver"], {"link": "1", "angle": 110, "omega": -1}],
        "sketch": {p: [z.real, z.imag] for p, z in sketched.items() if p in known},
    }
    assert base + complex(48, 30) * along == pytest.approx(solve(scene)["C"][0])
