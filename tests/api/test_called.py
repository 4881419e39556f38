"""What callers of the public functions may give, and what is said of the rest."""

from __future__ import annotations

import math
import pickle

import numpy as np
import pytest

import graphkin
from graphkin.scene import Driver, Frame, Scene

pytestmark = pytest.mark.quick

SIXBAR = "sixbar-guide-40deg"
HERS = {"v_D": 480}


def test_one_symbol_may_stand_without_a_list():
    assert graphkin.check(SIXBAR, find=["v_D"]).data == graphkin.check(SIXBAR, find="v_D").data


@pytest.mark.parametrize(
    ("call", "said"),
    [
        (
            lambda: graphkin.check(SIXBAR, at="50"),
            'position 50: the scene has no [positions] table; give a value of driver 1: --at 75',
        ),
        (lambda: graphkin.check(SIXBAR, at={"1": float("nan")}), "at 1: nan is no driver value"),
        (lambda: graphkin.check(SIXBAR, at=True), "at 1: True is no driver value"),
        (lambda: graphkin.solve(SIXBAR, sweep=2.5), "sweep: 2.5 positions; give a whole number"),
        (lambda: graphkin.solve(SIXBAR, sweep="12"), "sweep: found '12'; give a whole number from 1 to 10000000"),
        (lambda: graphkin.sweep(SIXBAR, positions="x"), "positions: found 'x'; give a whole number"),
        (lambda: graphkin.handout(SIXBAR, positions="6"), "positions: found '6'; give a whole number from 1 to 72"),
        (lambda: graphkin.check(SIXBAR, instrument="pencil", seed="x"), "seed: found 'x'; give a whole number"),
        (lambda: graphkin.check(SIXBAR, find=3), 'find: found 3; give symbols: ["v_B", "omega_3"]'),
        (lambda: graphkin.check(SIXBAR, find=[None]), 'find None: "None" is no quantity'),
        (lambda: graphkin.check(SIXBAR, instrument=3), "instrument: found 3"),
        (lambda: graphkin.draw(SIXBAR, language=3), 'lang: "3"'),
        (lambda: graphkin.draw(SIXBAR, formats=3), "format: found 3; give a list: svg, pdf, png"),
        (lambda: graphkin.problem_set(SIXBAR, variants=True), "variants: found True; give a whole number"),
        (lambda: graphkin.draw(SIXBAR, formats="svg"), 'format: "svg" is a text; give a list: ["svg"]'),
        (lambda: graphkin.draw(SIXBAR, formats=()), "format: none given; known here: svg, pdf, png"),
        (lambda: graphkin.draw(SIXBAR, formats=None), "format: found None; give a list: svg, pdf, png"),
        (lambda: graphkin.check(SIXBAR, find=np.array(5)), 'find: found array(5); give symbols: ["v_B", "omega_3"]'),
        (lambda: graphkin.check(SIXBAR, instrument=None), "instrument: found None; known here: exact, cad"),
        (lambda: graphkin.sweep(SIXBAR, progress=5), "progress: found 5; give a function, or leave it out"),
        (lambda: graphkin.sweep(SIXBAR, designs=[1]), "designs: found [1]; give values by keys"),
        (lambda: graphkin.sweep(SIXBAR, designs={"links.1.length": None}), "--set links.1.length: found None; give"),
        (lambda: graphkin.sweep(SIXBAR, designs_file=3), "path: found 3; give the name of a file or folder as a text"),
        (lambda: graphkin.sweep(SIXBAR, executor=3), "executor: found 3; give one that has submit"),
        (lambda: graphkin.prepare(SIXBAR, find=5), "find: found 5; name quantities"),
        (lambda: graphkin.prepare(SIXBAR, find="v_D").at("50"), "at: '50' is no driver value"),
        (lambda: graphkin.prepare(SIXBAR, find="v_D").over([1]), "designs: are no numbers for each key"),
        (lambda: graphkin.centrodes(SIXBAR, link=2), "link: found 2; give a name as a text"),
        (lambda: graphkin.check(SIXBAR)[5], "name: found 5; give a name as a text"),
        (lambda: graphkin.solve(SIXBAR).table[None], "name: found None; give a name as a text"),
        (lambda: graphkin.solve(SIXBAR).write(5), "path: found 5; give the name of a file or folder as a text"),
        (lambda: graphkin.read(SIXBAR).save([]), "path: found []; give the name of a file or folder as a text"),
        (lambda: graphkin.audit(SIXBAR, answers={"a": 1}),
         'answers of a: found 1; give answers by person: {"Li": {"v_D": 480}}'),
        (lambda: graphkin.audit(SIXBAR, answers=HERS, grading=[30]), "grading: found [30]; give points by parts"),
        (lambda: graphkin.audit(SIXBAR, answers=HERS, grading=np.array([1, 2])), "grading: found array([1, 2]); give"),
        (lambda: graphkin.design(None), "design: found None; give a file, the name of a design that comes along"),
        (lambda: graphkin.design(["stroke"]), "design: found ['stroke']; give a file"),
        (lambda: graphkin.draw(SIXBAR, figures=[[]]), 'figure: "[]"; known here: acceleration'),
        (lambda: graphkin.draw(SIXBAR, figures=np.array(3)), 'figures: found array(3); give a list: ["velocity"]'),
        (lambda: graphkin.stability(kinds=None), 'kinds: found None; give a list: ["dead point RRR"]'),
        (lambda: graphkin.stability(out=0), "path: found 0; give the name of a file or folder as a text"),
        (lambda: graphkin.speed_accuracy("shaper-scheme-2", out=b""), "path: found b''; give the name of a file"),
        (lambda: graphkin.stability(kinds=[[]]), 'kind: "[]"; known here'),
        (lambda: graphkin.sweep(SIXBAR, differentiate=[None]), "differentiate: found None; give a name as a text"),
        (lambda: graphkin.prepare(SIXBAR, find="v_D").at(np.inf), "at: inf is no driver value; give a finite number"),
        (lambda: graphkin.prepare(SIXBAR, find="v_D").at(np.nan), "at: nan is no driver value; give a finite number"),
        (lambda: graphkin.solve(SIXBAR).loops(np.array([1, 2])), 'lang: "[1 2]"; known here: en, zh'),
        (
            lambda: Scene(name=5, frame=Frame(), links={}, driver=Driver(link="1", angle=0)),
            "name: found 5; give a name as a text",
        ),
        (lambda: graphkin.prepare(SIXBAR, find="v_D").columns([1, np.nan]), "values: found nan; give finite numbers"),
        (lambda: graphkin.sweep(SIXBAR, integrate=range(3)), "integrate: found 0; give a name as a text"),
    ],
)
def test_a_wrong_argument_is_told_in_a_sentence(call, said):
    with pytest.raises(graphkin.CallError) as refusal:
        call()
    assert str(refusal.value).startswith(said)


@pytest.mark.parametrize("call", [
    lambda long: graphkin.check(SIXBAR, at=long),
    lambda long: graphkin.solve(SIXBAR, find=[long]),
    lambda long: graphkin.draw(SIXBAR, formats=[long]),
    lambda long: graphkin.centres(SIXBAR, out=long),
])
def test_a_sentence_does_not_repeat_a_page_of_what_was_given(call):
    with pytest.raises(graphkin.CallError) as refusal:
        call("x" * 100_000)
    assert 1000 > len(str(refusal.value))


def misuses():
    words = np.array([["svg", "pdf"]])
    return [
        lambda: graphkin.solve(SIXBAR, at=10**400),
        lambda: graphkin.check(SIXBAR, at={"1": 10**400}),
        lambda: graphkin.sweep(SIXBAR, designs={"links.1.length": 10**400}),
        lambda: graphkin.draw(SIXBAR, formats=words),
        lambda: graphkin.handout(SIXBAR, exports=words),
        lambda: graphkin.draw(SIXBAR, out="\ud800"),
        lambda: graphkin.handout(SIXBAR, out=5),
        lambda: graphkin.course_design(SIXBAR, out=b"x"),
        lambda: graphkin.open_board({"title": None}),
    ]


@pytest.mark.parametrize("call", misuses())
def test_what_stands_for_nothing_is_refused_in_a_sentence(call):
    with pytest.raises(graphkin.GraphkinError, match=r"found|known here|is no|cannot be"):
        call()


def test_whole_numbers_may_be_those_of_numpy():
    one, two = (graphkin.check(SIXBAR, instrument="pencil", seed=seed) for seed in (np.int64(3), 3))
    assert one.data == two.data
    assert 4 == len(graphkin.solve(SIXBAR, sweep=np.uint8(4)).motion)


RESULTS = {
    "Checked": lambda: graphkin.check(SIXBAR),
    "Solved": lambda: graphkin.solve(SIXBAR, sweep=3),
    "Prepared": lambda: graphkin.prepare(SIXBAR, find=["v_D"], bounds=True),
    "PreparedDesigns": lambda: graphkin.prepare(SIXBAR, find=["v_D"]).over({"links.1.length": [120, 121]}),
    "Sweep": lambda: graphkin.prepare(SIXBAR, find=["v_D"]).sweep(4),
    "Scene": lambda: graphkin.read(SIXBAR),
    "Mechanism": lambda: graphkin.read(SIXBAR).mechanism,
    "Table": lambda: graphkin.solve(SIXBAR).table,
    "Drawing": lambda: graphkin.draw(SIXBAR).figures["velocity"],
}


@pytest.mark.parametrize("kind", RESULTS)
def test_what_is_pickled_is_equal_and_of_one_hash(kind):
    one = RESULTS[kind]()
    other = pickle.loads(pickle.dumps(one))
    assert (kind, True, hash(one)) == (type(other).__name__, one == other, hash(other))


def test_a_chart_says_that_it_cannot_be_pickled():
    chart = next(iter(graphkin.sweep("slider-crank-s50-e16-K1.2", positions=4).figures.values()))
    with pytest.raises(graphkin.CallError, match="a chart: is drawn by a function and cannot be pickled; pick"):
        pickle.dumps(chart)


def test_a_link_that_is_turned_and_pushed_is_moved_by_the_driver_that_is_named():
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [30, 60]}, "guides": {"g": {"through": [0, -90], "angle": 40}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60}, "2": {"on": "0.g", "points": ["C"]}, "3": {"points": ["D"]},
        },
        "pins": {"B": {"of": "1", "in": "3"}},
        "driver": [{"slide": "2/0", "travel": 95, "velocity": -140},
                   {"link": "2", "angle": -80, "omega": 10, "relative_to": "1"}],
    }
    turned, pushed = (graphkin.solve(scene, at={key: -25}).data["positions"][0]["driver"] for key in ("2", "2/0"))
    assert {"2/0": 95, "2": math.radians(-25)} == pytest.approx(turned)
    assert {"2/0": -25, "2": math.radians(-80)} == pytest.approx(pushed)


FOUR_BAR = "fourbar-150-500-300-400"
BY_LAW = {
    "frame": {"points": {"A": [0, 0]}}, "links": {"1": {"points": ["A", "B"], "length": 3}},
    "driver": {"link": "1", "law": {"from": 0, "to": 90, "duration": 1, "by": "345"}, "time": 0.5},
}


@pytest.mark.parametrize(
    ("call", "given", "said"),
    [
        ("solve", {"scene": BY_LAW, "at": {"time": 2}}, "at time: found 2 s; the law goes from 0 to 1 s"),
        ("solve", {"scene": BY_LAW, "at": {"time": "x"}}, "at time: 'x' is no time; give seconds"),
        ("solve", {"scene": BY_LAW, "at": {"time": 0.2, "1": 3}},
         "at time: stands beside driver values; give the time, or values"),
        ("solve", {"scene": BY_LAW, "sweep": 5, "at": {"time": 0.2}},
         "sweep: stands beside at; a sweep goes over the whole time of the law"),
        ("sweep", {"scene": BY_LAW, "at": 3},
         "at: does not go with a driver that moves by a law over the time; leave it out, or give omega"),
        ("sweep", {"scene": FOUR_BAR, "executor": 3, "scheduler": "x"},
         "executor: is given beside a scheduler; give one of them"),
        ("sweep", {"scene": FOUR_BAR, "designs": {"links.1.length": [140, 150]}, "differentiate": ["theta_3"]},
         "differentiate, integrate: do not go with designs; give one design"),
        ("cam", {"scene": "cam-flat-face", "step": 0}, "step: found 0; degrees from 0.001 to 30"),
        ("check", {"scene": FOUR_BAR, "instrument": "ruler"}, 'instrument: "ruler"; known here: cad, exact, pencil'),
        ("centrodes", {"scene": FOUR_BAR, "link": "2", "point": "Q"},
         "point Q: link 2 has no such point; known here: B, C, M"),
        ("handout", {"scene": BY_LAW, "positions": 3},
         "positions: found 3; a driver that moves by a law stands at its own moment"),
        ("problem_set", {"scene": FOUR_BAR, "variants": 2, "spread": "x"}, "spread: found 'x'; give a Spread"),
        ("course_design", {"scene": FOUR_BAR, "students": "a.csv", "at": 3},
         "at: beside students; write each position into the table of the students"),
        ("course_design", {"scene": FOUR_BAR, "rows": "a.csv", "variants": 3},
         "variants: beside rows; give one of them"),
        ("prepare", {"scene": FOUR_BAR, "find": ["omega_3"], "fast": 3}, "bounds, fast: found False, 3; give True or"),
    ],
)
def test_a_call_that_cannot_be_meant_is_refused_in_a_sentence(call, given, said):
    with pytest.raises(graphkin.CallError) as refused:
        getattr(graphkin, call)(**given)
    assert said == str(refused.value)[: len(said)]
