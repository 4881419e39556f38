"""Springs: forces drawn and computed agree, powers and energies balance, and what is wrong is named."""

from __future__ import annotations

import json
import math
import os
import random
import re

import numpy as np
import pytest

import graphkin
from graphkin.errors import SceneError, Unsolvable
from graphkin.scene.scene import as_mapping
from graphkin.scene.symbol import Symbol
from tests.construction.test_forces import judged
from tests.mechanisms import KINDS, random_scene
from tests.solver.test_forces import loaded, residues

SCENES = 200 if os.environ.get("GRAPHKIN_ALL_POSITIONS") else 4
ROCKER = "rocker-return-spring"


def sprung(scene, seed):
    """A scene with two springs between points of any two links."""
    rng, made = random.Random(seed), json.loads(json.dumps(scene))
    here = [(made["frame"].get("name", "0"), p) for p in made["frame"].get("points", {})]
    for name, link in made["links"].items():
        if not link.get("redundant"):
            here += [(name, p) for p in (*link.get("points", ()), *link.get("at", {}))]
    made["springs"] = {}
    for name in ("s", "t"):
        pairs = [(a, b) for a in here for b in here if a[0] != b[0] and a[1] != b[1]]
        (a, p), (b, q) = rng.choice(pairs)
        made["springs"][name] = {
            "between": [p, q], "links": [a, b], "rate": rng.uniform(0.1, 9), "free": rng.uniform(0, 200),
            "preload": rng.choice([0.0, 5.0, -4.0]),
        }
    return made


def rocker(**spring):
    made = graphkin.read(ROCKER).to_dict()
    made["springs"]["R"] |= spring
    return made


@pytest.mark.parametrize("seed", range(SCENES))
def test_drawn_springs_in_every_pair_kind_agree_with_the_solver_and_powers_balance(seed):
    rng = random.Random(seed)
    drive = rng.choice(("crank", "slider", "cylinder", "slot"))
    scene = sprung(loaded(random_scene(seed, tuple(rng.choices(KINDS, k=2)), drive), seed), seed)
    assert (True, []) == judged(scene)
    worst, most, power, largest = residues(scene)
    assert worst <= 1e-10 * max(most, 1.0)
    assert power <= 1e-10 * largest


def test_work_of_the_driver_is_the_growth_of_the_springs_energy():
    scene = rocker(preload=3.0)
    del scene["masses"], scene["gravity"]
    solved = graphkin.solve(scene, sweep=720)
    moment = solved.forces.value(Symbol.parse("M_1"))[:241]
    weights = np.array([1, *[4, 2] * 119, 4, 1]) / 3
    work = float(moment @ weights) * math.tau / 720
    stretch = abs(solved.motion.position("E") - solved.motion.position("G")) - 0.06
    energy = 1600 * stretch**2 / 2 + 3.0 * stretch
    assert abs(energy[240] - energy[0]) > 1.0
    assert float(energy[240] - energy[0]) == pytest.approx(work, rel=1e-7)


def test_a_spring_of_no_free_length_balances_a_weight_in_every_position():
    scene = {
        "frame": {"name": "0", "points": {"A": [0, 0], "H": [0, 200]}},
        "links": {"1": {"points": ["A", "B"], "length": 300, "at": {"K": {"from": "A", "r": 100, "angle": 0}}}},
        "driver": {"link": "1", "angle": 20, "omega": 0},
        "gravity": {"g": 10}, "masses": {"1": {"at": "B", "mass": 4}},
        "springs": {"W": {"between": ["K", "H"], "rate": 40 * 300 / (100 * 200), "free": 0}},
    }
    moments = graphkin.solve(scene, sweep=36).forces.value(Symbol.parse("M_1"))
    assert abs(moments).max() <= 1e-13 * 40 * 0.3


def test_the_force_named_pulls_the_first_links_point_to_the_other():
    scene = rocker()
    solved = graphkin.solve(scene)
    way = complex((solved.motion.position("G") - solved.motion.position("E"))[0])
    expected = (12 + 1600 * (abs(way) - 0.06)) * way / abs(way)
    assert expected == pytest.approx(complex(solved.forces.value(Symbol.parse("P_R"))[0]), rel=1e-13)
    turned = graphkin.solve(rocker(between=["G", "E"], links=["4", "3"]))
    assert -expected == pytest.approx(complex(turned.forces.value(Symbol.parse("P_R"))[0]), rel=1e-13)
    balance, beside = (float(one.forces.value(Symbol.parse("M_1"))[0]) for one in (solved, turned))
    assert balance == pytest.approx(beside, rel=1e-12)


def test_a_spring_is_the_same_in_other_units():
    inches = json.loads(json.dumps(rocker()))
    inches["units"] = {"length": "m", "force": "kN"}
    for point in inches["frame"]["points"].values():
        point[:] = [x / 1000 for x in point]
    text = graphkin.read(ROCKER).to_dict()
    per = 1e-3
    for name, link in text["links"].items():
        if "length" in link:
            inches["links"][name]["length"] = link["length"] * per
        for point, place in link.get("at", {}).items():
            inches["links"][name]["at"][point] = (
                [x * per for x in place] if isinstance(place, list) else place | {"r": place["r"] * per}
            )
    inches["sketch"] = {p: [x * per for x in at] for p, at in text.get("sketch", {}).items()}
    at = text["masses"]["3"]["at"]
    inches["masses"]["3"]["at"] = at if isinstance(at, str) else [x * per for x in at]
    inches["springs"]["R"] |= {"rate": 1.6, "free": 0.06, "preload": 0.012}
    one, other = (graphkin.solve(s).forces.value(Symbol.parse("P_R"))[0] for s in (rocker(), inches))
    assert complex(one) == pytest.approx(complex(other), rel=1e-12)


@pytest.mark.parametrize(
    ("wrong", "said"),
    [
        ({"between": ["E", "Q"], "links": None}, "Q"),
        ({"between": ["E"]}, "two different points"),
        ({"between": ["E", "E"]}, "two different points"),
        ({"between": ["E", "C"], "links": ["3", "3"]}, "both ends are on link 3"),
        ({"links": ["2", "4"]}, "E is nowhere placed on link 2"),
        ({"links": ["9", "4"]}, 'no link "9"'),
        ({"links": ["3"]}, "two links"),
        ({"rate": 0}, "springs.R.rate"),
        ({"rate": -2.0}, "springs.R.rate"),
        ({"free": -1.0}, "springs.R.free"),
        ({"lenght": 3.0}, "lenght"),
    ],
)
def test_what_is_wrong_with_a_spring_is_named(wrong, said):
    scene = rocker(**wrong)
    scene["springs"]["R"] = {k: v for k, v in scene["springs"]["R"].items() if v is not None}
    with pytest.raises(SceneError) as error:
        graphkin.solve(scene)
    assert said in str(error.value)
    assert "springs.R" in str(error.value)


def test_a_spring_and_a_load_of_one_name_are_told():
    scene = rocker() | {"loads": {"R": {"on": "3", "moment": 2}}}
    with pytest.raises(SceneError, match="a load is called R too"):
        graphkin.solve(scene)


def test_a_spring_whose_points_coincide_has_no_line_and_says_so():
    scene = {
        "frame": {"name": "0", "points": {"A": [0, 0], "H": [100, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 100}},
        "driver": {"link": "1", "angle": 0, "omega": 1},
        "springs": {"W": {"between": ["B", "H"], "rate": 2, "free": 10}},
    }
    solved = graphkin.solve(scene)
    assert ["dead point"] == list(solved.motion.status)
    assert "spring W coincide" in solved.motion.why[0]
    with pytest.raises(Unsolvable, match=r"springs\.W: its two points coincide"):
        graphkin.check(scene)


def test_a_built_mechanism_is_written_with_its_springs():
    once = graphkin.read(ROCKER).mechanism
    again = graphkin.read(as_mapping(once)).mechanism
    (one,), (other,) = once.loading.springs, again.loading.springs
    assert (one.points, one.links) == (other.points, other.links)
    assert (one.rate, one.free, one.preload) == pytest.approx((other.rate, other.free, other.preload), rel=1e-12)


@pytest.mark.parametrize(("language", "said"), [("en", "spring R between E of link 3"), ("zh", "弹簧 R")])
def test_explain_tells_springs(language, said):
    assert said in graphkin.explain(ROCKER, language=language).text


def test_the_figure_shows_the_spring_between_its_points():
    figure = graphkin.draw(ROCKER, figures=["mechanism"]).figures["mechanism"].content("svg").decode()
    assert 'id="spring-R"' in figure


def test_a_value_with_the_whole_length_for_the_stretch_is_called_by_its_slip():
    slipped = graphkin.solve(rocker(free=0.0)).forces.value(Symbol.parse("P_R"))[0]
    scene = rocker() | {"printed": {"P_R": f"{abs(slipped):.4f}", "by": "computation"}}
    (value,) = graphkin.audit(scene).data["values"]
    assert ("wrong", "free length of spring R not taken off") == (value["verdict"], value["looks_like"])


def test_the_sheet_of_forces_says_how_the_force_was_measured():
    figure = graphkin.draw(ROCKER, figures=["forces"]).figures["forces"].content("svg").decode()
    assert "140.12 N, a pull on link 3" in re.sub(r"<[^>]+>", "", figure)


def test_a_spring_whose_points_coincide_is_refused_where_it_is_drawn_and_no_warning_where_it_is_solved(recwarn):
    scene = graphkin.read(ROCKER).to_dict()
    scene["frame"]["points"]["G"] = graphkin.solve(scene).data["positions"][0]["points"]["E@3"]["position"]
    assert "forces" not in graphkin.solve(scene).data["positions"][0]
    for hand in ("exact", "pencil"):
        with pytest.raises(Unsolvable, match=r"^springs.R: its two points coincide in this position"):
            graphkin.check(scene, instrument=hand)
    assert [] == [*recwarn]
