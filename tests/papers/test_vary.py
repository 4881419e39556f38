"""What ``[vary]`` says: ranges, ties, what stays, what is asked, how hard a problem may be."""

from __future__ import annotations

import time

import pytest

import graphkin
from graphkin.errors import CallError
from graphkin.papers.documents import problem
from graphkin.papers.fresh_numbers import LEVELS, Spread, candidate, level_of, varied_keys
from graphkin.papers.variants import Unfit, asked_of, examined
from graphkin.scene import mechanism_of
from graphkin.scene.scene import written

RULES = {
    "ranges": {"links.1.length": [38, 44], "driver.angle": [40, 80]},
    "ratios": [["links.1.length", "links.2.length"]],
    "keep": ["driver.omega"],
    "find": ["v_C", "v_P", "omega_2"],
    "ask": 2,
}


def _source(**vary):
    source, _ = written("four-bar-coupler-point")
    return {**source, "vary": {**RULES, **vary}}


def test_a_range_holds_a_tie_follows_and_what_is_kept_stays():
    source = _source()
    for number in range(12):
        made = candidate(source, Spread(), 1, number, 0)
        crank = made["links"]["1"]["length"]
        assert 38 <= crank <= 44
        assert 40 <= made["driver"]["angle"] <= 80
        assert source["links"]["2"]["length"] / source["links"]["1"]["length"] == pytest.approx(
            made["links"]["2"]["length"] / crank
        )
        assert source["driver"]["omega"] == made["driver"]["omega"]


def test_nothing_else_varies_where_only_the_ranges_do():
    source = _source(only=True)
    made = candidate(source, Spread(), 1, 3, 0)
    assert source["links"]["3"] == made["links"]["3"]


def test_a_rack_the_end_of_a_turn_and_the_moment_of_a_law_in_pieces_do_not_vary():
    law = [{"to": 90, "rise": 20}, {"to": 360, "fall": 20}]
    assert () == varied_keys({"gears": {"g": {"teeth": [20, "rack"]}}})
    assert () == varied_keys({"driver": {"time": 0.5, "law": {"pieces": law}}})
    assert ((("cams", "1", "law", 0, "to"), "end"), (("cams", "1", "law", 0, "rise"), "length")) == varied_keys(
        {"cams": {"1": {"law": law}}})
    assert ((("driver", 1, "angle"), "angle"),) == varied_keys({"driver": [{"omega": 0}, {"angle": 0}]})


def test_a_pivot_that_two_distances_place_stays_while_the_lengths_vary():
    source, _ = written("fourbar-150-500-300-400")
    points = {**source["frame"]["points"], "E": {"from": ["A", "D"], "r": [300, 200], "side": "left"}}
    source = {**source, "frame": {**source["frame"], "points": points}}
    made = candidate(source, Spread(), 1, 3, 0)
    assert points["E"] == made["frame"]["points"]["E"]
    assert source["links"]["2"] != made["links"]["2"]


def test_an_angle_of_0_varies_but_no_zero_place_no_wheel_of_a_rack_and_no_moment_of_several_laws():
    source = {
        "frame": {"points": {"A": [0, 5]}}, "gears": {"g": {"teeth": [20, 40]}, "r": {"teeth": [20, "rack"]}},
        "driver": [{"angle": 0, "omega": 3}, {"travel": 0, "law": {"pieces": []}, "time": 2}],
    }
    varied = [("frame", "points", "A", 1), ("driver", 0, "angle"), ("driver", 0, "omega"),
              ("gears", "g", "teeth", 0), ("gears", "g", "teeth", 1)]
    assert varied == [path for path, _ in varied_keys(source)]


def test_each_variant_asks_some_of_the_list_in_its_order():
    asked = [tuple(candidate(_source(), Spread(), 1, n, 0)["find"]) for n in range(20)]
    assert {("v_C", "v_P"), ("v_C", "omega_2"), ("v_P", "omega_2")} == set(asked)


def test_the_table_of_a_set_has_a_column_for_each_quantity_that_somebody_is_asked():
    made = graphkin.problem_set(_source(), variants=3, seed=2)
    assert made.ok
    assert 3 == len(made.table)
    for answers in made.answers.values():
        assert 2 == len(answers)
        assert all(a.tolerance <= LEVELS["usual"].tolerance * abs(a.value) for a in answers)


def test_every_wrong_key_is_named():
    with pytest.raises(CallError) as refusal:
        graphkin.problem_set(_source(keep=["links.9.length"], ranges={"driver.angle": [80, 40]}, ask=4), variants=2)
    assert 3 == len(refusal.value.problems)


def test_a_scene_that_cannot_vary_is_refused_in_seconds():
    source = _source(only=True, ranges={"links.1.length": [300, 400]}, ratios=[])
    begun = time.process_time()
    made = graphkin.problem_set(source, variants=30)
    assert 5 > time.process_time() - begun
    assert 30 == len(made.failures)


@pytest.mark.parametrize(("level", "equations"), [("easy", 4), ("usual", 2), ("hard", 0)])
def test_a_level_gives_more_or_less_of_the_equations(level, equations):
    source = {**_source(), "vary": {"level": level}}
    lesson = graphkin.handout(source, formats=("pdf",)).lesson
    from tests.papers.test_papers import _pictures

    small = [d for d in _pictures(problem(lesson)) if d.height < 60 and not d.desc]
    assert equations == len(small)


def test_a_driver_that_cannot_turn_fully_is_placed_within_its_reach():
    spread = Spread(reach=(20.0, 50.0))
    source = graphkin.read("triad-slider").to_dict()
    angles = {candidate(source, spread, 1, number, 0)["driver"]["angle"] for number in range(40)}
    assert {25.0, 30.0, 35.0, 40.0, 45.0} == angles


@pytest.mark.parametrize("level", LEVELS)
def test_a_key_is_right_to_five_percent_at_every_level_unless_the_scene_allows_more(level):
    assert 0.05 == level_of({"vary": {"level": level}}).tolerance
    assert 0.1 == level_of({"vary": {"level": level, "tolerance": 0.1}}).tolerance


@pytest.mark.parametrize(
    ("scene", "bound", "why"),
    [
        ("four-bar-coupler-point", {"transmission": 90}, "the transmission angle of links 2, 3 is"),
        ("disc-on-disc", {"transmission": 85}, "the transmission angle of link 2 and the bar OB is 79 degrees only"),
        ("slider-crank-offset", {"pressure": 1}, "the pressure angle of links 2, 3 is"),
    ],
)
def test_transmission_and_pressure_angles_are_held(scene, bound, why):
    source = {**written(scene)[0], "vary": bound}
    with pytest.raises(Unfit, match=why):
        examined(source, None, "01", bounds=level_of(source))


@pytest.mark.parametrize(
    ("scene", "asked"),
    [
        ("cam-offset-roller", {"v_B", "a_B"}),
        ("cam-swinging-roller", {"omega_2", "alpha_2", "v_B", "a_B"}),
        ("wheel-on-rail", {"v_P", "a_P"}),
        ("gears-epicyclic", {"omega_2", "omega_3", "v_P", "a_P"}),
    ],
)
def test_cams_and_rolling_wheels_vary_and_are_asked_for_something(scene, asked):
    made = graphkin.problem_set(scene, variants=2, seed=4)
    assert made.ok
    for answers in made.answers.values():
        assert {a.symbol for a in answers} <= asked
        assert all(a.tolerance <= 0.05 * abs(a.value) for a in answers)
    one, two = made.answers.values()
    assert one != two


@pytest.mark.parametrize(
    ("scene", "asked"),
    [
        ("cam-swinging-roller", ["omega_2", "alpha_2", "v_B", "a_B"]),
        ("gears-epicyclic", ["omega_2", "omega_3", "v_P", "a_P"]),
    ],
)
def test_only_what_follows_a_law_is_asked_for_its_angular_acceleration_where_the_driver_turns_evenly(scene, asked):
    assert asked == [str(symbol) for symbol in asked_of(mechanism_of(scene))]


def test_a_slider_that_never_turns_is_not_asked_for_its_rate():
    source = {key: value for key, value in graphkin.read("triad-slider").to_dict().items() if key != "find"}
    assert all(answer.value for answer in examined(source, None, "01", fewest=1).answers)


def _drawn(name, key, **vary):
    """A number of twelve candidates of a scene, by its key with dots."""
    source, _ = written(name)
    made = [candidate({**source, "vary": vary}, Spread(), 1, number, 0) for number in range(12)]
    return [_get(one, key) for one in made]


def _get(made, key):
    for part in key.split("."):
        made = made[int(part)] if isinstance(made, list) else made[part]
    return made


@pytest.mark.parametrize(
    ("name", "key"),
    [
        ("disc-on-disc", "links.1.discs.k.r"), ("gears-epicyclic", "gears.sun.teeth.0"),
        ("geared-five-bar", "gears.g.teeth.1"), ("cam-swinging-roller", "cams.1.law.0.to"),
        ("cam-swinging-roller", "cams.1.law.0.rise"), ("cam-swinging-roller", "cams.1.roller"),
    ],
)
def test_discs_wheels_and_cams_vary(name, key):
    assert len(set(_drawn(name, key))) > 3
    assert 1 == len(set(_drawn(name, key, only=True)))


def test_a_planet_meshes_with_sun_and_ring():
    keys = ("sun.teeth.0", "sun.teeth.1", "ring.teeth.1")
    suns, planets, rings = (_drawn("gears-epicyclic", f"gears.{k}") for k in keys)
    assert all(isinstance(z, int) for z in (*suns, *planets, *rings))
    assert [s + 2 * p for s, p in zip(suns, planets, strict=True)] == [-r for r in rings]
    assert planets == _drawn("gears-epicyclic", "gears.ring.teeth.0")


def test_a_cam_that_rises_comes_back_and_its_pieces_follow_each_other():
    ups, downs = (_drawn("cam-swinging-roller", f"cams.1.law.{k}") for k in ("0.rise", "2.fall"))
    assert ups == downs
    ends = zip(*(_drawn("cam-swinging-roller", f"cams.1.law.{i}.to") for i in range(4)), strict=True)
    assert all(0 < a < b < c < d == 360 for a, b, c, d in ends)


def test_a_range_of_teeth_gives_whole_numbers_and_the_others_follow():
    ranges = {"ranges": {"gears.sun.teeth.2": [24, 26]}}  # counted from 1, as drivers are
    assert {24, 25, 26} == set(_drawn("gears-epicyclic", "gears.sun.teeth.1", **ranges))
    suns, rings = (_drawn("gears-epicyclic", f"gears.{k}", **ranges) for k in ("sun.teeth.0", "ring.teeth.1"))
    assert {24, 25, 26} == {(-r - s) // 2 for s, r in zip(suns, rings, strict=True)}


def test_a_rolling_wheel_stands_on_its_rail_and_its_rim_stays_its_rim():
    made = graphkin.problem_set("wheel-on-rail", variants=4, seed=1, workers=1)
    assert made.ok
    lengths = {answers[0].value for answers in made.answers.values()}
    assert 4 == len(lengths)


ROLLING = {
    "title": "Two discs on an arm",
    "frame": {"name": "0", "points": {"A": [0, 0]}, "discs": {"s": {"centre": "A", "r": 30}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 50},
        "2": {"points": ["B", "P"], "length": 12, "discs": {"p": {"centre": "B", "r": 20}}},
    },
    "contacts": {"K": {"between": ["2.p", "0.s"], "rolling": True}},
    "driver": {"link": "1", "angle": 40, "omega": 5},
}


def test_an_arm_is_as_long_as_the_radii_of_what_rolls_on_each_other():
    for number in range(8):
        made = candidate(ROLLING, Spread(), 1, number, 0)
        radii = made["frame"]["discs"]["s"]["r"] + made["links"]["2"]["discs"]["p"]["r"]
        assert radii == pytest.approx(made["links"]["1"]["length"])
        graphkin.read(made)


def test_an_arm_that_is_kept_keeps_its_discs():
    made = candidate({**ROLLING, "vary": {"keep": ["links.1.length"]}}, Spread(), 1, 1, 0)
    assert (30, 20) == (made["frame"]["discs"]["s"]["r"], made["links"]["2"]["discs"]["p"]["r"])


def test_a_law_over_the_time_varies_with_the_moment_within_it():
    scene = graphkin.read("slider-crank-offset").to_dict()
    driver = {"link": "1", "time": 0.2, "law": {"from": 20, "to": 110, "duration": 0.5, "by": "cycloidal"}}
    made = [candidate({**scene, "driver": driver}, Spread(), 1, n, 0)["driver"] for n in range(12)]
    assert len({one["law"]["duration"] for one in made}) > 2
    assert all(0.149 < one["time"] / one["law"]["duration"] < 0.851 for one in made)


def test_a_variant_whose_driver_follows_from_the_speed_of_a_point_agrees_with_its_drawing():
    # the drawing had no rate: no problem of such a scene could be made
    crank = {
        "frame": {"points": {"O": [0, 0]}, "guides": {"h": {"through": [0, -10], "angle": 0}}},
        "links": {
            "1": {"points": ["O", "A"], "length": 40}, "2": {"points": ["A", "B"], "length": 140},
            "3": {"points": ["B"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 70, "speed": 200, "of": "A", "sense": "clockwise"},
        "find": ["v_B"],
    }
    (answer,) = examined(crank, None, "01").answers
    (exact,) = [row.exact for row in graphkin.check(crank).report.rows if str(row.symbol) == "v_B"]
    assert ("v_B", pytest.approx(1e3 * abs(exact))) == (answer.symbol, answer.value)


def test_an_angle_of_a_driver_with_a_law_stays_within_the_law():
    source, _ = written("fourbar-150-500-300-400")
    law = {"from": 10, "to": 90, "duration": 1, "by": "345"}
    source["driver"] = {"link": "1", "law": law, "angle": 50}
    for number in range(20):
        driver = candidate(source, Spread(), 0, number, 0)["driver"]
        assert 10 < driver["angle"] < driver["law"]["to"]


def test_a_range_narrower_than_a_step_is_drawn_in_finer_ones():
    lengths = {candidate(_source(ranges={"links.1.length": [40, 40.5]}), Spread(), 0, number, 0)["links"]["1"]["length"]
               for number in range(12)}
    assert 3 < len(lengths)
    assert 40 <= min(lengths) <= max(lengths) <= 40.5
