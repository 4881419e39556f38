"""Handouts of scenes with forces: what is given, room to solve it, force polygons group by group, results and key."""

from __future__ import annotations

import cmath
import math
import re
from pathlib import Path

import pytest

import graphkin
import tests.papers
from graphkin.account.forces import force_stages
from graphkin.papers.documents import task
from graphkin.papers.variants import examined
from tests.construction.test_forces import CRANK_WRITTEN_LAST, CROSSING, DRIVEN_IN_A_SLOT

ENGINE = "engine-gas-force"


@pytest.fixture(scope="module")
def papers(tmp_path_factory):
    out = tmp_path_factory.mktemp("engine")
    graphkin.handout(ENGINE, out=out, formats=("html",), language="both", positions=1, exports=("gift",))
    return {path.name: path.read_text(encoding="utf-8") for path in Path(out).rglob("*.*")}


def test_the_page_shows_the_measured_forces_beside_the_exact_ones(papers):
    results = tests.papers.unpacked(papers["handout.html"])["positions"][0]["results"]
    pairs = re.findall(r'<td class="right">([\d.]+)</td><td class="right">([\d.]+)</td><td>N</td>', results)
    assert len(pairs) >= 2
    for measured, exact in pairs:
        assert float(exact) == pytest.approx(float(measured), rel=1e-3)


def words(page):
    bare = re.sub(r"<(style|script)\b.*?</\1>", "", page, flags=re.DOTALL)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", bare))


def test_the_problem_gives_masses_and_loads_and_room_for_the_polygons(papers):
    text = words(papers["problem.html"])
    assert "m3 = 1.5 kg, J3 = 0.008 kg·m²" in text
    assert "Pgas = 6000 N" in text
    assert "力" in text
    assert "1 mm = 100 N" in text
    assert "3031" not in text


def test_a_problem_with_forces_has_blanks_for_its_equations_and_the_mechanism_beside_the_room_to_draw(papers):
    room = papers["problem.html"].split("Force equations of the links cut free")[1]
    assert "= 0" in words(room)
    assert 2 == room.split("draw a polygon for each")[1].count("50 mm, to check the print")  # both are to scale


def test_a_force_polygon_is_laid_off_with_lengths_directions_and_the_ends_that_close_it(papers):
    text = words(papers["handout.html"])
    assert "in this order" in text
    assert "arms on paper 图上力臂:" in text
    assert "de = Pgas = 6000 N ÷ 100 N/mm = 60.00 mm, 180.0°" in text
    assert "Through e, the end of Pgas, draw a line ⊥h: F14 lies on it; through a, the beginning of Ft23" in text
    assert "they meet in f, where F14 ends and Fn23 begins" in text


def test_a_force_found_before_is_laid_off_in_the_direction_in_which_it_acts(papers):
    on_crank = -graphkin.solve(ENGINE, find=["F_2/3"])["F_2/3"][0]
    turned = f"{math.degrees(cmath.phase(on_crank)):.1f}°"
    size = f"{abs(on_crank):.1f} N ÷ 100 N/mm = {abs(on_crank) / 100:.2f} mm, {turned}"
    assert f"F32 = {size}" in words(papers["handout.html"])


def test_the_solution_cuts_each_group_free_and_has_the_lever(papers):
    text = words(papers["handout.html"])
    for said in ("Links 3, 4 (RRP) cut free", "Link 2 (driven) cut free", "−116.31", "Zhukovsky"):
        assert said in text


def test_the_lever_of_a_solution_does_not_repeat_the_title_of_the_page(papers):
    assert 0 == papers["handout.html"].count('class="heading"')


def test_a_balancing_force_has_one_value_by_the_lever_and_by_the_polygons(tmp_path):
    graphkin.handout("boom-lifted", out=tmp_path, formats=("html",), language="en", positions=1)
    text = words((tmp_path / "handout.html").read_text(encoding="utf-8"))
    assert "13.638 kN by the lever, 13.638 kN by the polygons" in text


def test_the_forces_are_found_step_by_step_on_the_page(papers):
    (position,) = tests.papers.unpacked(papers["handout.html"])["positions"]
    svg = "".join(figure["svg"] for figure in position["figures"])
    ids = re.findall(r' id="([^"]*)"', svg)
    assert len(ids) == len(set(ids))
    steps = {step["n"]: step for step in position["steps"]}
    assert sorted(steps) == list(range(1, len(steps) + 1))
    found = [step for step in steps.values() if step["d"].startswith("force") and "find" in step]
    assert {"F_2/3", "M_2"} <= {step["find"]["symbol"] for step in found} | {
        step["find"]["symbol"] for step in steps.values() if step["d"] == "lever" and "find" in step
    }
    drawn = set(map(int, re.findall(r"step-(\d+)", svg)))
    assert {step["n"] for step in found} <= drawn


def test_the_key_has_the_forces_with_what_to_accept(papers):
    exact = abs(graphkin.solve(ENGINE)["F_2/3"][0])
    row = next(line for line in papers["key.csv"].splitlines() if line.startswith("F_2/3"))
    _, unit, asked, on_paper, value, tolerance, _ = row.split(",")
    assert ("N", "yes") == (unit, asked)
    assert exact == pytest.approx(float(value), rel=1e-8)
    assert exact / 100 == pytest.approx(float(on_paper), abs=0.01)
    assert 0 < float(tolerance) < 0.1 * exact


def test_forces_are_questions_of_a_learning_platform(papers):
    assert "116.3" in "".join(text for name, text in papers.items() if "gift" in name)


def test_a_problem_that_asks_for_some_forces_does_not_ask_for_all(shaper_forces) -> None:
    problem = shaper_forces.files["problem.html"]
    assert "Find: " in problem.decode()
    assert "all joint forces" not in problem.decode()


def test_a_link_without_a_moment_of_inertia_is_told_without_its_couple(shaper_forces) -> None:
    lesson = shaper_forces.lesson
    stage = next(force_stages(lesson.account))
    assert [True, False] == ["couple" in str(step.sentence("en")) for step in stage.steps]


def test_a_driven_block_is_called_a_block_under_its_figure_on_a_paper_and_on_the_page(tmp_path):
    graphkin.handout(DRIVEN_IN_A_SLOT, out=tmp_path, formats=("html",), language="both", positions=1)
    page = (tmp_path / "handout.html").read_text(encoding="utf-8")
    assert "Forces on the block at B" in str(tests.papers.unpacked(page))
    text = words(page)
    for said in ("The block at B cut free, and its force polygon", "B 处滑块的分离体与力多边形",
                 "2. The block at B (driven) cut free", "All forces on the block at B are in equilibrium"):
        assert said in text
    assert "link B" not in text


def test_a_pin_in_two_slots_is_cut_free_with_its_blocks_on_a_paper_and_on_the_page(tmp_path):
    graphkin.handout(CROSSING, out=tmp_path, formats=("html",), language="both", positions=1)
    page = (tmp_path / "handout.html").read_text(encoding="utf-8")
    assert "Forces on the blocks at P" in str(tests.papers.unpacked(page))
    text = words(page)
    for said in ("The blocks at P cut free, and their force polygon", "P 处各滑块的分离体与力多边形",
                 "2. The blocks at P (PRP) cut free", "2. 取 P 处各滑块（PRP）为分离体",
                 "All forces on the blocks at P are in equilibrium",
                 "ab = FR2P = 30.014 N ÷ 0.5 N/mm = 60.03 mm, −178.3°",
                 "Through b, the end of FR2P, draw a line ⊥v: FR02 lies on it; through a, the beginning of FR2P, a line"
                 " ⊥x1: FR12 lies on it; they meet in c", "FR02 = 63.21 mm × 0.5 N/mm = 31.605 N",
                 "3. Link 1 (driven) cut free"):
        assert said in text


def test_the_polygon_of_a_pin_alone_is_told_on_a_paper(tmp_path):
    graphkin.handout(CRANK_WRITTEN_LAST, out=tmp_path, formats=("html",), language="both", positions=1)
    text = words((tmp_path / "handout.html").read_text(encoding="utf-8"))
    for said in ("the pin at E alone / 销 E", "The polygon of the pin at E alone closes with FR53.",
                 "由销 E 的力多边形封闭，求得 FR53。", "FR53 = 33.51 mm × 0.5 N/mm = 16.755 N"):
        assert said in text


def test_what_is_asked_where_a_load_begins_is_asked_without_and_with_it():
    engine = graphkin.read("engine-gas-force").to_dict() | {"find": ["M_2"]}
    engine["loads"]["gas"]["when"] = {"driver": [30, 180]}
    del engine["flywheel"]
    handout = graphkin.handout(graphkin.read(engine))
    assert ["M_2", "M_2+"] == [row.symbol for row in handout.key if row.asked]
    assert "A value with + is with the load" in str(list(task(handout.lesson)))
    variant = examined(engine, None, "1", strict=False)
    assert ["M_2", "M_2+"] == [answer.symbol for answer in variant.answers]
