"""Results speak alike: in a terminal, in a notebook, as tables and for programs."""

from __future__ import annotations

import copy
import json
import math
import pickle
import re
from dataclasses import replace
from functools import cache
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import graphkin
from graphkin.api.results import Result, Tabled
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import MEASURES
from graphkin.solver.algebra.bounds import Accuracy
from tests.scenes import four_bar

SIXBAR = "sixbar-guide-40deg"
COMMANDS = ["check", "solve", "draw", "centres", "audit", "handout", "sweep"]
MAKE = {
    **{command: (lambda command=command: getattr(graphkin, command)(SIXBAR)) for command in COMMANDS},
    "centrodes": lambda: graphkin.centrodes("four-bar-coupler-point", link="2"),
    "scenes": graphkin.scenes,
    "problem_set": lambda: graphkin.problem_set("slider-crank-offset", variants=2),
    "stability": lambda: graphkin.stability(kinds=["crossing height"], samples=2),
}
NAMES = {
    **dict.fromkeys(["check", "draw", "audit", "handout"], "v_D"),
    "solve": "v_D", "sweep": "v_D", "centres": "1-3", "centrodes": "fixed_x", "scenes": SIXBAR,
    "problem_set": "01", "stability": "crossing height",
}


@cache
def made(kind):
    return MAKE[kind]()


@pytest.mark.parametrize("command", COMMANDS)
def test_a_result_prints_in_one_line_with_the_name_of_its_scene(command):
    shown = repr(made(command))
    assert "sixbar-guide-40deg" in shown
    assert len(shown) < 120


@pytest.mark.parametrize("kind", MAKE)
def test_every_result_has_a_table_data_and_a_page(kind):
    result = made(kind)
    assert isinstance(result, Result)
    assert [len(result.table)] * 2 == [len(result.to_pandas()), len(result.table.csv().splitlines()) - 1]
    assert json.loads(json.dumps(result.data, allow_nan=False)) == result.data
    assert "<" in result._repr_html_()


def test_a_notebook_shows_the_picture_above_the_readings():
    drawn = made("draw")
    page = drawn._repr_html_()
    assert page.index("<svg") < page.index("<table>")
    for figures in (drawn.figures, made("sweep").figures):
        assert len(repr(figures)) < 160 * len(figures)


def test_a_given_rate_is_read_nowhere_on_the_paper():
    checked = made("check")
    found = {row["symbol"]: row["on_paper_mm"] for row in checked.data["readings"]}
    assert [None, None] == [checked["omega_1"].on_paper, found["omega_1"]]
    assert "on paper" not in repr(checked["omega_1"])
    assert found["omega_3"] > 0


@pytest.mark.parametrize("kind", MAKE)
def test_every_result_is_asked_by_name_and_tells_an_unknown_one(kind):
    assert made(kind)[NAMES[kind]] is not None
    with pytest.raises(graphkin.CallError, match="nonsense"):
        made(kind)["nonsense"]
    assert [name in made(kind) for name in (NAMES[kind], "nonsense", 0)] == [True, False, False]


def test_the_scenes_that_come_along_are_gone_through_by_their_names():
    assert SIXBAR in list(graphkin.scenes())
    assert len(graphkin.scenes()) == len(list(graphkin.scenes()))
    assert list(graphkin.scenes().table) == ["scene", "title", "title_zh", "mobility"]


def test_a_result_without_an_order_says_how_it_is_asked():
    with pytest.raises(TypeError, match="by name"):
        list(made("check"))


@pytest.mark.parametrize("kind", MAKE)
def test_every_result_can_be_pickled_and_compared_after_it_was_shown(kind):
    result = made(kind)
    _ = result._repr_html_(), getattr(result, "_repr_svg_", str)()
    assert result == pickle.loads(pickle.dumps(result)) == copy.copy(result)
    assert result != made("solve" if kind == "check" else "check")


@pytest.mark.parametrize("kind", [k for k in MAKE if k not in ("draw", "handout", "sweep")])
def test_every_result_writes_the_table_that_it_shows(kind, tmp_path):
    paths = made(kind).write(tmp_path)
    assert set(paths) == set(tmp_path.iterdir())
    if kind != "scenes":
        (path,) = (p for p in paths if p.suffix == ".csv")
        assert made(kind).table.csv() == path.read_text(encoding="utf-8-sig")


@pytest.mark.parametrize("kind", [k for k in MAKE if k not in ("handout", "draw")])
def test_every_result_writes_the_figures_tables_and_files_it_declares_into_a_folder_of_its_name(
    kind, tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    result = made(kind)
    figures = [f"{name}.svg" for name in result.figures]
    assert [*figures, *result.tables, *result.files] == [path.name for path in result.write()]
    assert sorted([*figures, *result.tables, *result.files]) == sorted(p.name for p in Path(result.name).iterdir())


def test_a_figure_that_goes_on_overleaf_is_one_pdf_and_several_pictures():
    result = graphkin.centres("shaper-scheme-2", language="both")
    assert ["centres.svg", "centres-2.svg"] == list(result.pages(("svg",)))[:2]
    assert ["centres.pdf"] == list(result.pages(("pdf",)))


@pytest.mark.parametrize("name", ["v_D", "omega_3", "a_B@3", "D", "theta_3", "s_2/3", "v_2/3", "driver_1"])
def test_a_solution_gives_a_quantity_as_a_sweep_does(name):
    solved, swept = graphkin.solve(SIXBAR, sweep=4), graphkin.sweep(SIXBAR, positions=4)
    np.testing.assert_allclose(solved[name], swept[name], rtol=1e-9)


@pytest.mark.parametrize("kind", [*COMMANDS, "problem_set", "centrodes"])
def test_the_scene_of_a_result_is_the_one_that_was_given(kind):
    name = {"problem_set": "slider-crank-offset", "centrodes": "four-bar-coupler-point"}.get(kind, SIXBAR)
    assert graphkin.read(name) == made(kind).scene


def test_the_scene_of_a_result_is_changed_and_saved(tmp_path):
    scene = graphkin.check(SIXBAR).scene
    path = scene.replace("links.1.length", 121).save(tmp_path / "x.toml")
    assert (121.0, 122.0) == (graphkin.read(path).links["1"].length, scene.links["1"].length)


PREPARED = {
    "prepared": lambda: graphkin.prepare(SIXBAR, find=["v_D", "omega_3"]),
    "samples": lambda: graphkin.prepare(SIXBAR, find=["v_D", "omega_3"]).sweep(4),
    "designs": lambda: graphkin.prepare(SIXBAR, find=["v_D", "omega_3"]).over({"links.1.length": [120, 121]}),
}


@pytest.mark.parametrize("kind", PREPARED)
def test_what_is_prepared_speaks_as_results_do(kind, tmp_path):
    ready = PREPARED[kind]()
    assert isinstance(ready, Tabled)
    rows = {"prepared": 1, "samples": 4, "designs": 2}[kind]
    assert [rows] * 4 == [len(ready["v_D"]), len(ready.table), len(ready.to_pandas()), ready.to_xarray()["v_D.x"].size]
    assert "<table>" in ready._repr_html_()
    assert json.loads(json.dumps(ready.data, allow_nan=False)) == ready.data
    assert set(ready.write(tmp_path / "all")) == set((tmp_path / "all").iterdir())
    assert [tmp_path / "one.csv"] == ready.write(tmp_path / "one.csv")


def test_what_is_prepared_says_the_position_of_the_scene():
    ready, solved = graphkin.prepare(SIXBAR, find=["v_D", "omega_3"]), graphkin.solve(SIXBAR)
    here = ready.over({"links.1.length": graphkin.read(SIXBAR).links["1"].length})
    for name in ("v_D", "omega_3"):
        np.testing.assert_allclose([solved[name][0]] * 2, [ready[name][0], here[name]], rtol=1e-9)


def test_two_results_of_different_positions_differ():
    assert graphkin.solve(SIXBAR) != graphkin.solve(SIXBAR, at=51)
    ready = graphkin.prepare(SIXBAR, find="v_D")
    assert ready.columns([50]) != ready.columns([51])


CENTIMETRES = four_bar(
    15, 50, 30, 40, units={"length": "cm", "speed": "m/s"}, find=["v_C", "a_C", "omega_3", "alpha_3", "theta_3"],
    sketch={"C": [50, 29]}, printed={"v_C": 1, "a_C": 1, "omega_3": 1, "alpha_3": 1, "theta_3": 1},
)
"""Lengths in cm, speeds in m/s, so that no unit is right by chance."""
UNITS = {"v_C": "m/s", "a_C": "m/s2", "omega_3": "rad/s", "alpha_3": "rad/s2", "theta_3": "deg"}


@cache
def routes(name):
    """A quantity and its unit by every way to it."""
    ways = {
        "check": graphkin.check(CENTIMETRES)[name], "draw": graphkin.draw(CENTIMETRES, figures=["velocity"])[name],
        "audit": graphkin.audit(CENTIMETRES)[name][0], "handout": graphkin.handout(CENTIMETRES)[name],
    }
    if name in ("v_C", "omega_3"):
        ways["centres"] = graphkin.centres(CENTIMETRES)[name]
    found = {way: (value.exact, value.unit) for way, value in ways.items()}
    arrays = {
        "solve": graphkin.solve(CENTIMETRES)[name], "sweep": graphkin.sweep(CENTIMETRES, positions=1)[name],
        "prepare": graphkin.prepare(CENTIMETRES, find=[name])[name],
    }
    return found | {way: (values[0], values.unit) for way, values in arrays.items()}


@pytest.mark.parametrize("name", UNITS)
def test_a_quantity_is_the_same_number_in_the_same_unit_by_every_way(name):
    units = {unit.replace("²", "2").replace("°", "deg") for _, unit in routes(name).values()}
    exact = graphkin.solve(CENTIMETRES).motion.value(Symbol.parse(name))[0]
    expected = {"m/s": 1.0, "m/s2": 1.0, "deg": math.degrees(1.0)}.get(UNITS[name], 1.0) * exact
    sizes = {"audit", "handout"} if name in ("v_C", "a_C") else set()  # where a vector is told by its size
    wrong = {
        way: value for way, (value, _) in routes(name).items()
        if (abs(expected) if way in sizes else expected) != pytest.approx(value, rel=1e-9)
    }
    assert ({UNITS[name]}, {}) == (units, wrong)


def test_what_is_asked_by_name_shows_its_unit():
    shown = [repr(result[name]) for result, name in (
        (graphkin.check(CENTIMETRES), "v_C"), (graphkin.solve(CENTIMETRES), "v_C"),
        (graphkin.centres(CENTIMETRES), "v_C"), (graphkin.audit(CENTIMETRES), "v_C"),
        (graphkin.handout(CENTIMETRES), "v_C"),
        (graphkin.sweep(CENTIMETRES, positions=2), "v_C"), (graphkin.prepare(CENTIMETRES, find=["v_C"]), "v_C"),
        (made("problem_set"), "01"), (graphkin.design("slider-crank-stroke-50"), "AB"), (made("centres"), "1-3"),
        (made("centrodes"), "fixed_x"),
    )]
    assert ["m/s"] * 7 == [next((unit for unit in ("m/s",) if unit in one), one) for one in shown[:7]]
    assert ["mm"] * 4 == [next((unit for unit in ("mm",) if unit in one), one) for one in shown[7:]]


@pytest.mark.parametrize(("kind", "heads"), [
    ("centres", ["x (mm)", "y (mm)"]), ("centrodes", ["driver (deg)", "fixed_x (mm)", "fixed_y (mm)"]),
    ("problem_set", ["v_C (mm/s)", "v_C +- (mm/s)"]),
])
def test_tables_have_their_units_in_their_heads(kind, heads):
    assert heads == [head for head in made(kind).table.heads if head in heads]


def test_centrodes_count_the_driver_in_degrees():
    driver = made("centrodes").table["driver"]
    assert 60 == pytest.approx(driver[0])


def test_what_is_nothing_but_rounding_is_0_in_tables_and_by_name():
    solved = graphkin.solve(SIXBAR)
    values = [solved.table["a_D.y"][0], solved["a_D"][0].imag, made("check")["a_D"].exact.imag]
    assert ["0.0"] * 3 == [str(value) for value in values]
    assert [] == re.findall(r">-0<|e-1[3-9]<", solved._repr_html_())


def test_what_is_not_determined_is_no_0():
    beside, doubtful = (graphkin.solve(four_bar(40, 110, 80, 120), at=60).motion for _ in range(2))
    off = replace(beside.bound, alpha=np.full(1, 1e6))
    with patch.object(Accuracy, "of", lambda *given, **more: off):
        assert [1e-14] == doubtful.settled(np.full(1, 1e-14), MEASURES["angular acceleration"]).tolist()
    assert [0.0] == beside.settled(np.full(1, 1e-14), MEASURES["angular acceleration"]).tolist()
    assert [1e-9] == beside.settled(np.full(1, 1e-9), MEASURES["angular acceleration"]).tolist()


@pytest.mark.parametrize("unit", ["mm", "m"])
@pytest.mark.parametrize(("part", "left"), [(0.5e-9, 0.0), (2e-9, 1e-12)])
def test_a_bound_is_slight_beside_the_velocity_of_a_point_as_far_off_as_the_mechanism_is_large(unit, part, left):
    scene = graphkin.read(four_bar(40, 110, 80, 120)).to_dict() | {"units": {"length": unit}}
    motion = graphkin.solve(scene, at=60).motion
    rate = abs(motion.scene.drivers[0].values[1])
    off = replace(motion.bound, velocity=np.full(1, part * motion.scene.size * rate))
    with patch.object(Accuracy, "of", lambda *given, **more: off):
        assert [left] == graphkin.solve(scene, at=60).motion.settled(np.full(1, 1e-12), MEASURES["velocity"]).tolist()


def minus_before_nought(data: object) -> list[str]:
    return re.findall(r"(?<![\w.])-0(?:\.0+)?(?![\d.eE])", json.dumps(data, default=str))


@pytest.mark.parametrize("name", ["elliptic-trammel", "cam-swinging-roller", "shaper-forces", "geneva-step"])
def test_no_minus_stands_before_nought_in_what_programs_read(name):
    made = [graphkin.check(name), graphkin.solve(name, sweep=5), graphkin.centres(name)]
    assert [] == [sign for result in made for sign in minus_before_nought(result.data)]


@pytest.mark.parametrize("made", [
    lambda language: graphkin.design("slider-crank-stroke-50", language=language),
    lambda language: graphkin.stability(kinds=["crossing height"], samples=1, language=language),
])
def test_a_program_reads_the_same_sentences_in_every_language(made):
    english, chinese = (made(language).data for language in ("en", "zh"))
    assert _sentences(english) == _sentences(chinese)


def _sentences(data) -> list[str]:
    inner = data.values() if isinstance(data, dict) else data if isinstance(data, list) else ()
    return [data] if isinstance(data, str) else [text for part in inner for text in _sentences(part)]
