"""Drivers that move by a law over the time."""

import math
import re

import mpmath
import numpy as np
import pytest

import graphkin
from graphkin.account.given import given_drivers
from graphkin.account.notation import notation_of
from graphkin.errors import CallError, SceneError
from tests.scenes import slider_crank

CRANK = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, -16], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 24},
        "2": {"points": ["B", "C"], "length": 58},
        "3": {"points": ["C"], "on": "0.h"},
    },
}
FIVE_BAR = {
    "frame": {"points": {"A": [0, 0], "E": [120, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 60},
        "2": {"points": ["B", "C"], "length": 100},
        "3": {"points": ["E", "D"], "length": 60},
        "4": {"points": ["D", "C"], "length": 100},
    },
    "sketch": {"C": [60, 130]},
}


def crank(**driver):
    return {**CRANK, "driver": {"link": "1", **driver}}


def five_bar():
    pieces = [{"to": 0.3, "rise": 40, "by": "3-4-5"}, {"to": 0.5, "fall": 30, "by": "cycloidal"}, {"to": 1.0}]
    table = [[0, 80], [0.25, 60], [0.5, 70], [1, 40]]
    one = {"link": "1", "time": 0.4, "law": {"from": 100, "pieces": pieces}}
    return {**FIVE_BAR, "driver": [one, {"link": "3", "time": 0.4, "law": {"table": table}}]}


LAW = {"from": 20, "to": 110, "duration": 0.5, "by": "cycloidal"}


@pytest.mark.parametrize(
    ("by", "value", "rate", "second"),
    [
        ("uniform", 0.25, 1.0, 0.0),
        ("parabolic", 2 / 16, 1.0, 4.0),
        ("harmonic", (1 - math.sqrt(0.5)) / 2, math.pi / 2 * math.sqrt(0.5), math.pi**2 / 2 * math.sqrt(0.5)),
        ("cycloidal", 0.25 - 1 / (2 * math.pi), 1.0, 2 * math.pi),
        ("3-4-5", 0.103515625, 1.0546875, 5.625),
        ("4567", 0.070556640625, 0.9228515625, 7.3828125),
    ],
)
def test_the_rates_at_a_quarter_of_the_time_are_those_of_the_law(by, value, rate, second):
    law = {"from": 10, "to": 100, "duration": 2.0, "by": by}
    solved = graphkin.solve(crank(time=0.5, law=law))
    way = math.pi / 2
    assert math.radians(10) + way * value == pytest.approx(solved.motion.values[0, 0], rel=1e-14)
    assert way * rate / 2 == pytest.approx(solved["omega_1"][0], rel=1e-13)
    assert way * second / 4 == pytest.approx(solved["alpha_1"][0], rel=1e-12, abs=1e-14)


def test_the_angle_asked_says_the_moment_at_which_the_law_first_comes_there():
    solved = graphkin.solve(crank(angle=65, law=LAW))
    assert 0.25 == pytest.approx(solved.times[0], rel=1e-13)
    assert math.pi * 2 == pytest.approx(solved["omega_1"][0], rel=1e-13)


def test_every_reading_of_the_drawing_agrees_at_any_moment():
    for time in (0.07, 0.2, 0.31):
        assert graphkin.check(crank(angle=50, law=LAW), at={"time": time}).ok


def test_velocities_and_accelerations_over_the_time_are_differences_of_places():
    turn = graphkin.solve(crank(angle=50, law=LAW), sweep=2001)
    step = turn.times[1] - turn.times[0]
    place, speed = turn["C"], turn["v_C"]
    assert np.gradient(place, step)[1:-1] == pytest.approx(speed[1:-1], abs=1e-5 * abs(speed).max())
    push = turn["a_C"]
    assert np.gradient(speed, step)[1:-1] == pytest.approx(push[1:-1], abs=1e-5 * abs(push).max())


def test_two_drivers_with_laws_of_their_own_move_together_as_one_position_after_the_other():
    turn = graphkin.solve(five_bar(), sweep=11)
    for k, time in enumerate(turn.times):
        alone = graphkin.solve(five_bar(), at={"time": time})
        for name in ("C", "v_C", "a_C", "omega_2", "alpha_4"):
            size = np.abs(turn[name]).max()
            assert alone[name][0] == pytest.approx(turn[name][k], abs=1e-12 * size), (time, name)


@pytest.mark.parametrize(("time", "angle"), [(0.1, 80), (0.9, 70)])
def test_before_its_law_begins_and_after_it_ends_a_driver_stands_still(time, angle):
    scene = five_bar()
    scene["driver"][1]["law"] = {"table": [[0.2, 80], [0.4, 60], [0.7, 70]]}
    solved = graphkin.solve(scene, at={"time": time})
    assert [angle, 0, 0] == pytest.approx([solved[name][0] for name in ("theta_3", "omega_3", "alpha_3")])


def test_a_driver_without_a_law_goes_on_at_its_own_rate():
    scene = five_bar()
    scene["driver"][1] = {"link": "3", "angle": 70, "omega": -0.5, "alpha": 0.25}
    solved = graphkin.solve(scene, at={"time": 0.6})
    assert math.radians(70) - 0.5 * 0.2 + 0.25 * 0.02 == pytest.approx(solved.motion.values[0, 1])
    assert -0.45 == pytest.approx(solved["omega_3"][0])


def test_a_spline_goes_through_its_table_and_has_no_acceleration_at_its_ends():
    turn = graphkin.solve(five_bar(), sweep=21)
    assert [80, 60, 70, 40] == pytest.approx(turn["theta_3"][[0, 5, 10, 20]])
    assert [0, 0] == pytest.approx(turn["alpha_3"][[0, -1]], abs=1e-9)


def test_whole_turns_of_a_law_are_counted():
    law = {"from": 0, "rise": 1440, "duration": 2, "by": "345"}
    assert 1440 == pytest.approx(graphkin.solve(crank(time=0.5, law=law), sweep=9)["theta_1"][-1])


def test_a_sweep_goes_over_the_time_and_names_the_extremes():
    swept = graphkin.sweep(crank(angle=50, law=LAW), positions=5)
    assert [0, 0.125, 0.25, 0.375, 0.5] == pytest.approx(swept.table["time"].tolist())
    assert {"value": pytest.approx(2 * math.pi), "time": pytest.approx(0.25)} == swept.data["outputs"]["omega_1"][
        "greatest"
    ]
    assert {"motion-link-1", "motion-slide-3-0"} == set(swept.figures)
    assert "greatest 6.28319 rad/s at 0.25 s" in swept.text


def test_the_file_of_a_diagram_over_the_time_is_called_by_the_quantity_not_by_its_markup():
    swept = graphkin.sweep(crank(angle=50, law=LAW), positions=5, find=["v_B"])
    assert "v_B: " == swept.figures["diagram-v_B"].title[:5]


def test_the_angle_between_two_links_counts_its_whole_turns_over_the_time():
    turning = crank(angle=50, law={"from": 20, "to": 800, "duration": 0.5, "by": "cycloidal"})
    ends = graphkin.sweep(turning, positions=5, find=["theta_1/2"]).data["outputs"]["theta_1/2"]
    angles = [graphkin.solve(crank(angle=angle, omega=0))["theta_1/2"][0] for angle in (20, 800)]
    assert {"least": angles[0], "greatest": angles[1] + 720} == {
        end: pytest.approx(math.degrees(extreme["value"])) for end, extreme in ends.items()
    }


def test_a_size_that_is_least_where_the_law_begins_is_told_there():
    law = {"table": [[0, 20], [0.1, 60], [0.2, 130], [0.3, 220]]}
    speed = graphkin.sweep(crank(time=0.1, law=law), find=["v_B"], positions=5).data["outputs"]["v_B"]
    assert [0, 0.3] == [speed["least"]["time"], speed["greatest"]["time"]]


def test_a_scene_with_a_law_is_written_and_read_again(tmp_path):
    for name, given in (("crank", crank(angle=50, law=LAW)), ("five-bar", five_bar())):
        scene = graphkin.read(given)
        again = graphkin.solve(graphkin.read(scene.save(tmp_path / f"{name}.toml")))
        assert graphkin.solve(given)["a_C"][0] == pytest.approx(again["a_C"][0], rel=1e-12)


@pytest.mark.parametrize(
    ("driver", "said"),
    [
        ({"angle": 50, "omega": 3, "law": LAW}, "driver.omega: stands beside law"),
        ({"angle": 5, "law": LAW}, "driver.angle: found 5; the law goes from 20 to 110 deg"),
        ({"time": 0.6, "law": LAW}, "driver.time: found 0.6; the law goes from 0 to 0.5 s"),
        ({"angle": 50, "time": 0.1, "law": LAW}, "driver.time: stands beside angle"),
        ({"law": LAW}, "driver.angle: is missing; write time = ... in s, or the angle"),
        ({"time": 0.2}, "driver.time: tells the moment of a law"),
        ({"time": 0, "law": {"from": 0, "by": "345"}}, "driver.law.duration: is missing"),
        ({"time": 0, "law": {"table": [[0, 1], [0, 2]]}}, "driver.law.table.2: is at 0 s, after one at 0 s"),
        ({"time": 0, "law": {"from": 0, "pieces": [{"to": 1, "rise": 3}]}}, "law.pieces.1: does not say its law"),
    ],
)
def test_what_is_wrong_with_a_law_is_said_by_name(driver, said):
    with pytest.raises(SceneError) as stop:
        graphkin.read(crank(**driver))
    assert said in str(stop.value)


def test_a_value_that_the_law_never_takes_is_refused():
    with pytest.raises(CallError, match=r"at 1: 200° is not on its way; its law goes from 20° to 110°"):
        graphkin.check(crank(angle=50, law=LAW), at=200)


def lawful(name):
    """A scene that comes along, its driver moved by a law about where it stands."""
    scene = graphkin.read(name).to_dict()
    driver = scene["driver"]
    value = "angle" if "angle" in driver else "travel"
    way = 10 if value == "angle" else 5
    kept = {key: driver[key] for key in ("link", "slide", "relative_to", value) if key in driver}
    law = {"from": driver[value] - way, "rise": 2 * way, "duration": 0.5, "by": "345"}
    return {**scene, "driver": {**kept, "law": law}}


@pytest.mark.parametrize(
    "name", ["sixbar-guide-40deg", "engine-gas-force", "hydraulic-cylinder", "gears-epicyclic", "cam-offset-roller"]
)
def test_mechanisms_of_every_kind_move_by_a_law_and_are_drawn_so(name):
    scene = lawful(name)
    turn, alone = graphkin.solve(scene, sweep=5), graphkin.solve(scene, at={"time": 0.375})
    for link in turn.mechanism.links:
        rates, own = turn[f"alpha_{link.name}"], alone[f"alpha_{link.name}"][0]
        assert own == pytest.approx(rates[3], abs=1e-9 * np.abs(rates).max() + 1e-12)
    assert graphkin.check(scene, at={"time": 0.2}).ok


@pytest.mark.parametrize("time", [0.05, 0.55, 0.65])
def test_the_bounds_hold_what_rounding_does_to_a_law(time):
    law = {"from": 20, "to": 110, "duration": 0.7, "by": "4567"}
    links, frame = {"1": {"points": ["A", "B"], "length": 24}}, {"points": {"A": [0, 0]}}
    here = graphkin.solve({"frame": frame, "links": links, "driver": {"link": "1", "time": time, "law": law}}).data
    moved, bound = (here["positions"][0][key] for key in ("links", "error_bound"))
    with mpmath.workdps(40):
        x, way = mpmath.mpf(str(time)) / mpmath.mpf("0.7"), mpmath.pi / 2
        rate = 140 * (x - x * x) ** 3 * way / mpmath.mpf("0.7")
        second = 420 * (x - x * x) ** 2 * (1 - 2 * x) * way / mpmath.mpf("0.7") ** 2
        off = {"omega": float(abs(moved["1"]["omega"] - rate)), "alpha": float(abs(moved["1"]["alpha"] - second))}
    assert [] == [name for name, error in off.items() if not error <= bound[name]]


@pytest.mark.parametrize(("at", "moment"), [
    (None, 0.4), ({"time": 0.2}, 0.2), ({"1": 110}, None), ({"3": 70}, None), ({"1": 125, "3": 70}, None),
])
def test_a_moment_is_told_where_all_laws_stand_at_it(at, moment):
    entry = graphkin.solve(five_bar(), at=at).data["positions"][0]
    sheet = graphkin.check(five_bar(), at=at).sheet
    lines = given_drivers(sheet, notation_of(sheet, "chinese"))
    assert (moment, moment is not None) == (entry.get("time"), repr(lines[0]).startswith("$t$"))


def test_of_laws_of_unlike_length_the_shorter_ends_with_an_extreme_of_its_own():
    laws = {"1": {"from": 100, "to": 140, "duration": 1.9}, "3": {"from": 80, "to": 60, "duration": 3.1}}
    drivers = [{"link": link, "time": 1, "law": {**law, "by": "parabolic"}} for link, law in laws.items()]
    outputs = graphkin.sweep({**FIVE_BAR, "driver": drivers}, find=["theta_1"]).data["outputs"]
    assert {"value": math.radians(140), "time": 1.9} == pytest.approx(outputs["theta_1"]["greatest"])


def test_a_greatest_rate_of_nothing_has_no_sign():
    laws = {"1": {"from": 60, "to": 140, "duration": 1}, "3": {"from": 100, "to": 40, "duration": 1.4}}
    drivers = [{"link": link, "time": 0.4, "law": {**law, "by": "cycloidal"}} for link, law in laws.items()]
    bars = {**FIVE_BAR["links"], "2": {"points": ["B", "C"], "length": 150}, "4": {"points": ["D", "C"], "length": 140}}
    scene = {**FIVE_BAR, "links": bars, "sketch": {"C": [60, 180]}, "driver": drivers}
    swept = graphkin.sweep(scene, find=["omega_2"], positions=3)
    assert "greatest 0 rad/s at 0 s" in swept.text
    assert "0.0" == repr(swept.data["outputs"]["omega_2"]["greatest"]["value"])


def test_an_extreme_just_before_a_seam_of_the_law_stands_at_the_seam_with_the_value_to_which_its_piece_comes():
    law = {"from": 0, "pieces": [{"to": 0.3, "rise": 40, "by": "parabolic"}, {"to": 1.0}]}
    least = graphkin.sweep(crank(time=0.4, law=law), positions=5).data["outputs"]["a_3/0"]["least"]
    angle, rate, second = (math.radians(40) * part for part in (1 / 2, 2 / 0.3, 4 / 0.3**2))

    def place(time):  # as the first half of the rise goes on
        turned = angle + rate * time + second * time**2 / 2
        return 24 * mpmath.cos(turned) + mpmath.sqrt(58**2 - (24 * mpmath.sin(turned) + 16) ** 2)

    assert 0.15 == pytest.approx(least["time"], abs=1e-16)
    assert float(mpmath.diff(place, 0, 2)) == pytest.approx(least["value"], rel=1e-12)


def test_a_rate_grows_without_bound_where_a_law_leads_to_an_end_of_the_motion():
    law = {"from": 10, "to": 100, "duration": 0.5, "by": "uniform"}
    scene = slider_crank(100, 100, driver={"link": "1", "time": 0.1, "law": law})
    scene["frame"]["guides"]["h"]["through"] = [0, -40]  # crank and rod end upright at asin(60/100)
    end = math.asin(0.6), 0.5 * (math.degrees(math.asin(0.6)) - 10) / 90
    swept = graphkin.sweep(scene, positions=4)
    outputs = swept.data["outputs"]
    assert end == pytest.approx(tuple(outputs["theta_1"]["greatest"].values()), rel=1e-9)
    assert (80, end[1]) == pytest.approx(tuple(outputs["s_3/0"]["least"].values()), rel=1e-6)
    nothing = {"value": None, "why": "it grows without bound there", "time": pytest.approx(end[1], rel=1e-9)}
    assert [nothing, nothing] == [outputs[rate]["least"] for rate in ("v_3/0", "a_3/0")]
    assert "v_3/0: grows without bound at 0.14928 s, greatest" in swept.text
    # the chart shows nine tenths of the way, to -1090 mm/s; its least sample is -3.4e6
    told = re.findall(r"<text[^>]*>([^<]*)", swept.figures["motion-slide-3-0"].content("svg").decode())
    assert [", grows without bound at an end of the range"] == [text[6:] for text in told if text.startswith("(mm/s)")]
    assert -1e5 < min(float(text.replace("−", "-")) for text in told if re.fullmatch(r"−?[\d.]+", text)) < -1090
    pieces = [{"to": 0.5, "rise": 90, "by": "uniform"}, {"to": 1, "fall": 90, "by": "uniform"}]
    scene["driver"]["law"] = {"from": 10, "pieces": pieces}
    there_and_back = graphkin.sweep(scene, positions=4).data["outputs"]
    back = nothing | {"time": pytest.approx(1 - end[1], rel=1e-9)}
    assert [nothing, back] == [*there_and_back["v_3/0"].values()]
    assert pytest.approx([-math.pi, math.pi]) == [rate["value"] for rate in there_and_back["omega_1"].values()]


def test_the_greatest_angle_of_a_spline_counts_its_whole_turns_between_moments_that_were_looked_at():
    table = [[0, 20], [0.3, 700], [1, 20]]
    # natural: the second rate at the middle moment, by the condition that the first is the same on both sides
    second = 6 * ((20 - 700) / 0.7 - (700 - 20) / 0.3) / (2 * 1)
    time = mpmath.findroot(lambda t: -second * (1 - t) ** 2 / 1.4 + (20 - 700) / 0.7 + second * 0.7 / 6, 0.4)
    angle = second * (1 - time) ** 3 / 4.2 + 20 + (680 / 0.7 - second * 0.7 / 6) * (1 - time)
    outputs = graphkin.sweep(crank(time=0.4, law={"table": table}), find=["theta_1"], positions=3).data["outputs"]
    assert float(mpmath.radians(angle)) == pytest.approx(outputs["theta_1"]["greatest"]["value"], rel=1e-11)
    assert float(time) == pytest.approx(outputs["theta_1"]["greatest"]["time"], rel=1e-5)


def test_an_angle_that_changes_little_has_its_extremes():
    law = {"from": 100, "to": 100.05, "duration": 0.5, "by": "345"}
    outputs = graphkin.sweep(crank(time=0.4, law=law), find=["theta_1"], positions=3).data["outputs"]
    assert [100, 100.05] == pytest.approx([math.degrees(end["value"]) for end in outputs["theta_1"].values()])
