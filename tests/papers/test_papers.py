from __future__ import annotations

import csv
import dataclasses
import io
import math
import re
import subprocess

import pytest

import graphkin
from graphkin.api.checked import check
from graphkin.api.classroom.handouts import handout
from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Line, Polygon, Text, walk
from graphkin.papers.blocks import Heading, Picture, StepItem, TableBlock, laid_out
from graphkin.papers.documents import accepted, answer_key, key_rows, problem, result_cells, solution, step_items
from graphkin.papers.html import document_page
from graphkin.papers.pictures import POLYGONS, mechanism_picture, workspace
from graphkin.scene import library, mechanism_of
from graphkin.scene.scene import written
from tests import EVERYTHING


def _pictures(document):
    return (block.drawing for block in laid_out(document.blocks) if isinstance(block, Picture))


def _words(document) -> str:
    return re.sub("<[^>]*>", "", document_page(document).split("</style>")[1])


# problem sheet


def test_the_problem_sheet_shows_nothing_that_is_asked(shaper):
    texts = {t.id for d in _pictures(problem(shaper.lesson)) for t in walk(d.children) if isinstance(t, Text)}
    assert not {
        i for i in texts if i.startswith(("label-omega", "label-alpha", "label-v_", "label-a_", "label-direction"))
    }


def test_no_number_of_the_key_stands_on_the_problem_sheet(shaper):
    words = _words(problem(shaper.lesson))
    assert not [r.symbol for r in shaper.key if f"{r.on_paper:.2f}" in words]


def test_the_problem_sheet_asks_for_every_bold_row_of_the_key(shaper):
    table = next(b for b in laid_out(problem(shaper.lesson).blocks) if isinstance(b, TableBlock))
    assert sum(row.asked for row in shaper.key) == len(table.rows)


def test_the_mechanism_of_the_problem_sheet_is_to_scale(shaper):
    lesson = shaper.lesson
    spaces = [d for d in _pictures(problem(lesson)) if d.height > 100]
    assert 1 == len(spaces)  # it stands beside the poles of both polygons
    for drawing in spaces:
        lengths = {round(abs(t.end - t.start), 2) for t in walk(drawing.children) if isinstance(t, Line)}
        assert round(0.09 / lesson.sheet.scales.length, 2) in lengths  # the crank of 90 mm


@pytest.mark.parametrize("name", ["shaper-forces", "gears-epicyclic", "geared-five-bar"])
def test_figures_of_a_solution_are_numbered_and_equations_name_theirs(name):
    blocks = list(laid_out(solution(handout(name, formats=("html",), positions=1).lesson).blocks))
    captions = [str(b.caption[0][1]) for b in blocks if isinstance(b, Picture) and b.caption]
    heads = [str(b.words[0][1]) for b in blocks if isinstance(b, Heading)]
    named = [int(n) for head in heads for n in re.findall(r"\(figure (\d+)\)", head)]
    assert [f"Figure {i}." for i in range(1, len(captions) + 1)] == [" ".join(c.split()[:2]) for c in captions]
    assert named
    assert set(named) <= set(range(1, len(captions) + 1))


@pytest.mark.parametrize("name", ["geared-five-bar", "hypocycloid-straight-line", "sixbar-guide-40deg"])
def test_the_figure_that_an_equation_names_is_a_polygon_of_its_kind_after_it(name):
    # a plan of a train between them was named
    blocks = list(laid_out(solution(handout(name, formats=("html",), positions=1).lesson).blocks))
    captions, named = [], []
    for block in blocks:
        if isinstance(block, Heading) and (head := re.search(r": (\w+) \(figure (\d+)\)", str(block.words[0][1]))):
            named.append((int(head[2]), head[1], len(captions)))
        if isinstance(block, Picture) and block.caption:
            captions.append(str(block.caption[0][1]))
    assert named
    for number, kind, before in named:
        (caption,) = (c for c in captions if c.startswith(f"Figure {number}."))
        assert f"{kind.capitalize()} polygon" in caption
        assert captions.index(caption) >= before


def test_pages_of_a_solution_are_filled(shaper):
    from pypdf import PdfReader

    assert 6 == len(PdfReader(io.BytesIO(shaper.files["solution.pdf"])).pages)


def test_what_is_asked_limits_the_problem_sheet():
    made = handout("shaper-scheme-2", find=["v_C"], formats=("html",), positions=1)
    assert ["v_C"] == [row.symbol for row in made.key if row.asked]


@pytest.mark.parametrize("name", library() if EVERYTHING else library()[::5])
def test_every_figure_of_every_scene_fits_the_page(name):
    assert [] == _too_large(handout(name, formats=("pdf",), language="both").lesson)


def _too_large(lesson):
    papers = [problem(lesson), solution(lesson)]
    sizes = [(d.width, d.height, paper.paper.body) for paper in papers for d in _pictures(paper)]
    return [s for s in sizes if s[0] > s[2].width + 1e-6 or s[1] > s[2].height]


def _on(name, **wishes):
    scene = mechanism_of(name)
    return scene.asking(sheet=dataclasses.replace(scene.question.sheet, **wishes))


PAPERS = [("A5", "portrait"), ("A4", "landscape"), ("A3", "portrait"), ("A3", "landscape"), ("A0", "portrait")]


@pytest.mark.parametrize(("paper", "orientation"), PAPERS)
@pytest.mark.parametrize("name", ["shaper-scheme-2", "sixbar-guide-40deg", "fourbar-150-500-300-400"])
def test_every_figure_fits_the_paper_that_the_scene_wishes(name, paper, orientation):
    scene = _on(name, paper=paper, orientation=orientation)
    assert [] == _too_large(handout(scene, formats=("pdf",), language="both").lesson)


def test_the_papers_have_the_size_that_the_scene_wishes():
    made = handout(_on("slotter-75-150", paper="A3", orientation="landscape"), positions=1).files
    for name in ("problem.pdf", "solution.pdf", "key.pdf"):
        assert re.search(rb"/MediaBox ?\[0 0 1190\.5\d* 841\.8\d*\]", made[name]), name
    for name in ("problem.html", "handout.html"):
        assert b"size: 420mm 297mm" in made[name]


def test_larger_paper_has_larger_figures_unless_the_scene_gives_the_scales():
    small, large, own = (
        handout(_on("fourbar-150-500-300-400", **wishes), formats=("pdf",)).lesson.sheet.scales.velocity
        for wishes in ({}, {"paper": "A2"}, {"paper": "A2", "velocity_scale": 10.0})
    )
    assert small > large
    assert 10e-3 == pytest.approx(own)


# solution


def test_the_solution_has_every_step_once_in_order(shaper):
    blocks = laid_out(solution(shaper.lesson).blocks)
    found = [block.number for block in blocks if isinstance(block, StepItem)]
    assert [s.number for s in shaper.lesson.sheet.steps] == found


def test_the_last_figure_holds_more_than_the_first(shaper):
    counts = [
        sum(1 for _ in walk(d.children))
        for d in _pictures(solution(shaper.lesson))
        if d.title == "Acceleration polygon"
    ]
    assert counts == sorted(counts)
    assert counts[0] < counts[-1]


# key


def test_the_key_gives_the_exact_values():
    made = handout("sixbar-guide-40deg", formats=("pdf",))
    exact = {row["symbol"]: row["exact"] for row in check("sixbar-guide-40deg").data["readings"]}
    assert {r.symbol: pytest.approx(exact[r.symbol]) for r in made.key} == {r.symbol: r.exact for r in made.key}


def test_a_pencil_drawing_at_the_scales_of_the_key_passes_it():
    made = handout("fourbar-150-500-300-400", formats=("pdf",))
    tolerance = {row.symbol: row.tolerance for row in made.key}
    for seed in range(5):
        drawn = check("fourbar-150-500-300-400", instrument="pencil", seed=seed)
        errors = {r["symbol"]: r["error"] for r in drawn.data["readings"]}
        assert [] == [s for s, most in tolerance.items() if errors[s] > 1.3 * most]


def test_the_key_as_csv_has_its_rows(shaper):
    rows = list(csv.DictReader(io.StringIO(shaper.files["key.csv"].decode())))
    assert [r.symbol for r in key_rows(shaper.lesson)] == [r["symbol"] for r in rows]


# PDF


def _pdftotext(pdf: bytes, tmp_path) -> str:
    path = tmp_path / "paper.pdf"
    path.write_bytes(pdf)
    try:
        done = subprocess.run(["pdftotext", "-layout", str(path), "-"], capture_output=True, check=True)
    except FileNotFoundError:
        pytest.skip("pdftotext is not installed (Debian: poppler-utils)")
    return done.stdout.decode()


def test_a_typeset_paper_is_a4_and_bears_no_date(shaper):
    for name in ("problem.pdf", "solution.pdf", "key.pdf"):
        content = shaper.files[name]
        # mechanism and pole face each other on two pages of A4
        wide, high = (rb"1190\.5\d*", rb"841\.8\d*") if name == "problem.pdf" else (rb"595\.27\d*", rb"841\.8\d*")
        assert re.search(rb"/MediaBox ?\[0 0 " + wide + rb" " + high + rb"\]", content), name
        assert b"CreationDate" not in content


def test_the_same_handout_has_the_same_bytes(shaper):
    again = handout("shaper-scheme-2", language="en", positions=4)
    assert shaper.files == again.files


def test_pages_are_numbered(shaper, tmp_path):
    text = _pdftotext(shaper.files["solution.pdf"], tmp_path)
    assert "page 1 of" in text
    assert "page 2 of" in text


def test_chinese_words_are_text_in_the_pdf(six_bar, tmp_path):
    text = _pdftotext(six_bar.files["solution.pdf"], tmp_path).replace(" ", "")
    assert "哥氏加速度" in text
    assert "第1页" in text


def test_what_nothing_asked_for_needs_is_left_out_and_every_paper_says_so():
    lesson = handout("shaper-scheme-2", find=["omega_4"], formats=("pdf",)).lesson
    for paper in (problem, solution, answer_key):
        assert "nothing asked for needs it: links 5, 6" in _words(paper(lesson))


def test_the_source_stands_where_the_solution_does_in_the_language_of_the_paper():
    scene = {**written("slider-crank-offset")[0], "source": "a book", "source_zh": "课程设计指导书"}
    pages = {
        each: graphkin.handout(scene, language=each, formats=("html",), positions=1).files
        for each in ("en", "zh", "both")
    }
    worked, sheets = ([pages[each][name].decode() for each in pages] for name in ("handout.html", "problem.html"))
    assert [True, False, True] == ["a book" in page for page in worked]
    assert [False, True, True] == ["课程设计指导书" in page for page in worked]
    # who is to solve it does not read "Willis: ..." or the result that a program gave
    assert [] == [page for page in sheets if "a book" in page or "课程设计指导书" in page]


def test_a_problem_does_not_show_how_a_larger_group_is_placed():
    lesson = handout("sixbar-1A-last-link", language="en", formats=("pdf",)).lesson
    drawn = [b.drawing for b in laid_out(problem(lesson).blocks) if isinstance(b, Picture)]
    ids = {thing.id for d in drawn for thing in walk(d.children) if hasattr(thing, "id")}
    assert "point-B" in ids
    assert set() == {"point-S", "special-S", "label-point-S", "label-trial-B-1"} & ids


@pytest.mark.parametrize(
    ("value", "off", "least", "told"),
    [
        (100.0, 3.21, 0.0, ("± 3.2", "96.8 … 103.2")), (1234.0, 345.0, 0.0, ("± 340", "890 … 1580")),
        (2.0, 3.0, 0.0, ("± 3.0", "0.0 … 5.0")), (2.0, 3.0, -math.inf, ("± 3.0", "−1.0 … 5.0")),
        (2.0, 0.0, 0.0, ("–", "–")), (2.0, math.inf, 0.0, ("–", "–")),
    ],
)
def test_what_is_accepted_lies_as_far_as_a_pencil_may_be_off_on_either_side_to_two_figures(value, off, least, told):
    assert told == accepted(value, off, least)


def test_what_is_told_to_be_measured_is_the_length_on_paper_times_the_scale_and_may_be_off_the_exact_value(
    shaper_forces,
):
    lesson = shaper_forces.lesson
    cells = {str(row.symbol): told for row, told in zip(lesson.results, result_cells(lesson), strict=True)}
    per_mm = lesson.sheet.scales.acceleration / lesson.sheet.scene.units.rates.metres
    told = cells["an_C/B"]
    assert per_mm * float(told["on paper"]) == pytest.approx(float(told["measured"]))
    off = 100 * abs(float(told["measured"]) / float(told["exact"]) - 1.0)
    assert (0.09, 0.09) == (float(told["course difference"]), round(off, 2))


def test_a_force_that_is_zero_has_no_residue_on_paper():
    key = key_rows(handout("boom-lifted", at=180, language="en", formats=("html",), positions=1).lesson)
    zero = {row.symbol: row.on_paper for row in key if row.exact == 0.0 and row.on_paper is not None}
    assert "F_3/2" in zero
    assert {0.0} == set(zero.values())


@pytest.mark.parametrize("name", ["hydraulic-cylinder", "engine-gas-force"])
def test_a_solution_says_of_as_many_readings_that_they_agree_as_its_table_shows(tmp_path, name):
    handout(name, out=tmp_path, formats=("html",), language="en", positions=1)
    page = (tmp_path / "handout.html").read_text(encoding="utf-8")
    said = re.search(r"all (\d+) readings agree", page, re.IGNORECASE)
    table = page[: said.start()].rsplit("<table", 1)[1]
    assert table.count("<tr") - 1 == int(said[1])


@pytest.mark.parametrize("page", [Box(0.0, 0.0, 500.0, 250.0), Box(0.0, 0.0, 280.0, 500.0)])
def test_the_mechanism_and_the_frames_of_both_polygons_stand_clear_of_each_other_on_a_page(page):
    lesson = handout("slider-crank-offset", formats=("pdf",)).lesson
    bare = mechanism_picture(lesson)
    drawn = workspace(lesson, bare, POLYGONS, page)
    one, two = (Box.around(c.points) for c in drawn.children if isinstance(c, Polygon))
    apart = (max(one.left, two.left) - min(one.right, two.right), max(one.top, two.top) - min(one.bottom, two.bottom))
    assert 4.0 < max(apart) < 4.5
    for frame in (one, two):
        assert bare.width < frame.left < frame.right <= page.width
        assert 0.0 <= frame.top < frame.bottom <= page.height


@pytest.mark.parametrize(("name", "told"), [
    ("wheel-on-rail", "Draw from the poles p, p′."), ("gears-epicyclic", "Draw from the pole p."),
])
def test_one_pole_is_a_pole_and_two_are_poles(name, told):
    problem = handout(name, language="en", formats=("html",), positions=1).files["problem.html"].decode()
    assert told in re.sub("<[^>]*>", "", problem)


def test_a_travel_on_a_plan_of_accelerations_is_not_called_one_of_velocities():
    lesson = handout("wheel-on-rail", language="zh", formats=("pdf",)).lesson
    stages = [stage for stage in lesson.stages if stage.diagram == "acceleration"]
    told = [str(words) for stage in stages for item in step_items(lesson, stage) for _, words in item.words]
    assert any("C/0" in words for words in told)
    assert [] == [words for words in told if "速度图" in words and "加速度图" not in words]
