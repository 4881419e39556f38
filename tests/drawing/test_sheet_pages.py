"""What stands on a sheet, and on the pages on which it goes on."""

import re
from dataclasses import replace
from functools import cache
from itertools import combinations

import pytest

from graphkin import draw, read
from graphkin.account.given import given_lengths
from graphkin.account.notation import notation_of
from graphkin.construction import draft, plan
from graphkin.drawing import Text
from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Group, Polygon, Polyline, walk
from graphkin.drawing.parts.insets import INSET, coriolis_rows, coriolis_terms
from graphkin.drawing.parts.mechanism import mechanism_piece
from graphkin.drawing.parts.polygon import details
from graphkin.drawing.place.piece import ink_box
from graphkin.drawing.sheet_plan import sheet_plan, sheet_room
from graphkin.drawing.tables import table_rows
from graphkin.scene import mechanism_of
from tests.drawn import drafted

FOUR = ("chinese", "us", "british", "russian")


def words(figure) -> list[str]:
    return [thing.string for thing in walk(figure.children) if isinstance(thing, Text)]


def pages(drawn) -> list[str]:
    return [text for name, figure in drawn.figures.items() if name.startswith("sheet") for text in words(figure)]


@pytest.mark.parametrize(
    ("scene", "first"),
    [
        ("hit16-double-guide", "vB1=ω1lAB="),
        ("rotating-guide-bar", "vB1=ω1lAB="),
        ("oldham-coupling", "vM1=ω1lAM="),
        ("shaper-scheme-2", "vA3=ω2lO2A="),
    ],
)
def test_the_first_equation_is_written_whatever_drives(scene, first):
    drawn = draw(scene, convention="british")
    assert any(text.replace(" ", "").startswith(first) for text in pages(drawn))


def test_links_that_turn_together_are_said_to():
    assert "ω3=ω2=ω1" in [text.replace(" ", "") for text in pages(draw("oldham-coupling"))]


@pytest.mark.parametrize("convention", FOUR)
def test_a_size_is_told_by_its_rule_in_every_convention(convention):
    told = [re.sub(r"\W", "", text) for text in pages(draw("shaper-scheme-2", convention=convention))]
    assert "2ω4vA4A3" in told or "2ω4VA4A3" in told


@pytest.mark.parametrize("convention", FOUR)
def test_a_vector_in_an_equation_is_bold_or_bears_an_arrow_and_its_magnitude_does_not(convention):
    sheet = draw("shaper-scheme-2", convention=convention).figures["sheet"]
    texts = [thing for thing in walk(sheet.children) if isinstance(thing, Text)]
    letter = "V" if convention == "us" else "v"
    mark = "→" if convention == "russian" else None
    whole = [text.runs[0] for text in texts if re.sub(r"\W", "", text.string) == f"{letter}A4A3"]
    told = [run.text == mark if mark else run.bold for run in whole]
    assert {True} == set(told)
    assert not any(run.bold or run.text == mark for text in texts if "ω" in text.string for run in text.runs)


@pytest.mark.parametrize("language", ["en", "both"])
def test_every_reading_stands_on_a_sheet(language):
    drawn = draw("sixbar-AE70", language=language)
    rows = [text for text in pages(drawn) if re.search(r"\w, (mm|rad)/s²?$", text)]
    assert len(table_rows(drawn.small.report)) == len(rows)


def test_a_sheet_that_goes_on_is_one_pdf_of_two_pages(tmp_path):
    draw("sixbar-1A-last-link", out=tmp_path, formats=("svg", "pdf"))
    assert {"sheet.svg", "sheet-2.svg", "sheet.pdf"} == {p.name for p in tmp_path.glob("sheet*")}
    assert b"/Count 2" in (tmp_path / "sheet.pdf").read_bytes()


@pytest.mark.parametrize(("name", "at", "diagram"), [
    ("shaper-scheme-2", 151, "acceleration"), ("double-butterfly", 33, "velocity"),
])
def test_small_vectors_near_each_other_share_an_inset(name, at, diagram):
    (detail,) = details(draw(name, at=at, figures=[]).checked.sheet, diagram)
    assert len(detail.vectors) == 2


def test_vectors_that_would_cover_each_other_lie_side_by_side():
    lines = {}
    for thing in walk(draw("shaper-scheme-2").figures["velocity"].children):
        if isinstance(thing, Group) and "vector" in thing.classes:
            lines[thing.id] = thing.children[0]
    whole, part = lines["v_B"], lines["v_S4"]
    way = (whole.end - whole.start) / abs(whole.end - whole.start)
    apart = ((part.start - whole.start) * way.conjugate()).imag
    assert pytest.approx(0.0, abs=1e-9) == ((part.end - part.start) * way.conjugate()).imag
    assert abs(apart) > 0.9


def test_steps_are_numbered_at_the_vectors():
    drawn = draw("sixbar-guide-40deg")
    texts = [thing for thing in walk(drawn.figures["velocity"].children) if isinstance(thing, Text)]
    numbers = [text.string for text in texts if "step-number" in text.classes]
    drawn_in = {f"({step.number})" for step in drawn.checked.sheet.steps if step.diagram == "velocity"}
    assert set(numbers) <= drawn_in
    assert len(numbers) >= 5


def test_a_sheet_keeps_the_scales_that_the_scene_wishes_for():
    drawn = draw("sixbar-guide-40deg")
    assert {"length": 2, "velocity": 10, "acceleration": 100} == drawn.figures["sheet"].metadata["scales"]
    assert (297.0, 420.0) == (drawn.figures["sheet"].width, drawn.figures["sheet"].height)


def test_scales_are_round_in_inches():
    scene = mechanism_of("slider-crank-offset")
    scene = replace(scene, units=replace(scene.units, length="in"))
    scales = plan(scene).exact.scales_for(sheet_room(scene))
    for per in (scales.length / 0.0254, scales.velocity / 0.0254, scales.acceleration / 0.0254):
        assert f"{per:e}"[:3] in ("1.0", "2.0", "2.5", "5.0")


@pytest.mark.parametrize(("at", "expected"), [(None, "position 7"), (75, "scheme 2")])
def test_the_title_elsewhere_is_without_the_words_of_the_scenes_own_position(at, expected):
    told = words(draw("shaper-scheme-2", at=at).figures["velocity"])
    assert [expected] == [text[-len(expected) :] for text in told if text.startswith("Shaper")]


@cache
def sheets(scene, **how):
    return draw(scene, figures=("sheet",), **how).figures


IN_ROOMS_LEFT = [
    ("slotter-75-150", {}),
    ("oldham-coupling", {"language": "zh"}),
    ("hit-two-RPR", {"convention": "us", "language": "both"}),
]


@pytest.mark.parametrize(("scene", "how"), IN_ROOMS_LEFT)
def test_few_lines_that_have_no_room_in_their_place_stand_where_the_page_has_some(scene, how):
    assert ["sheet"] == list(sheets(scene, **how))


@pytest.mark.parametrize("scene", ["oldham-coupling", "four-bar-coupler-point"])
def test_readings_that_begin_in_a_room_left_higher_up_are_continued_in_their_own(scene):
    texts = [thing for thing in walk(sheets(scene, language="en")["sheet"].children) if isinstance(thing, Text)]
    captions = sorted((text for text in texts if text.string.startswith("Readings")), key=lambda text: text.at.imag)
    assert ["Readings and check", "Readings and check (continued)"] == [text.string for text in captions]


def test_readings_beside_whole_equations_begin_below_them_and_not_to_their_right():
    boom = {
        "frame": {"points": {"C": [0, 0], "D": [-350, 120]}},
        "links": {"1": {"points": ["D", "E"], "length": 900, "at": {"B": [400, -50]}},
                  "2": {"points": ["B"], "on": "3"}, "3": {"points": ["C"]}},
        "driver": {"slide": "2", "travel": 330, "velocity": -40, "acceleration": 15},
    }
    drawn = draw(boom, figures=("sheet",)).figures["sheet"].children
    texts = [thing for thing in walk(drawn) if isinstance(thing, Text)]
    captions = {text.string: text.at for text in texts if text.string.startswith("Readings")}
    assert captions["Readings and check"].real < captions["Readings and check (continued)"].real


@pytest.mark.parametrize(("scene", "how"), IN_ROOMS_LEFT)
def test_what_goes_on_in_other_rooms_of_a_sheet_stands_on_nothing_else(scene, how):
    texts = [thing for thing in walk(sheets(scene, **how)["sheet"].children) if isinstance(thing, Text)]
    inks = [(text.string, box) for text in texts if (box := ink_box((text,))) is not None]
    assert [] == [
        (one, two)
        for (one, a), (two, b) in combinations(inks, 2)
        if min(a.right, b.right) - max(a.left, b.left) > 0.3 and min(a.bottom, b.bottom) - max(a.top, b.top) > 0.3
    ]


def test_what_a_large_sheet_leaves_goes_overleaf_on_a4():
    scene = mechanism_of("sixbar-guide-40deg")
    finer = replace(scene.question.sheet, acceleration_scale=0.8 * scene.question.sheet.acceleration_scale)
    figures = draw(scene.asking(sheet=finer), figures=("sheet",)).figures
    assert (297.0, 420.0) == (figures["sheet"].width, figures["sheet"].height)
    assert (210.0, 297.0) == (figures["sheet-2"].width, figures["sheet-2"].height)


def test_a_plan_holds_figures_that_fill_it_and_none_that_are_larger():
    _, sheet = drafted("sixbar-guide-40deg")
    page = sheet_plan(sheet)
    sizes = [page.room.mechanism, page.room.polygon, page.room.polygon]
    full = [tuple(side * (1 + 1e-12) for side in size) for size in sizes]
    assert page.holds(tuple(full))
    for which in range(3):
        for side in range(2):
            larger = [list(size) for size in sizes]
            larger[which][side] *= 1 + 1e-6
            assert not page.holds(tuple(map(tuple, larger)))


def test_lengths_are_given_however_short_and_what_rounding_leaves_is_none():
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 150}, "3": {"points": ["C", "D"], "length": 300},
                  "2": {"points": ["B", "C"], "length": 500, "at": {"E": [0.5, 0], "F": [1e-13, 0]}}},
        "driver": {"link": "1", "angle": 60, "omega": 10}, "sketch": {"C": [420, 290]},
    })
    given = {str(name): value for name, value in given_lengths(scene, notation_of(draft(scene), "chinese"))}
    assert "0.5" == given["l_BE"]
    assert {"l_BF"} == {f"l_{p}{q}" for p in "BC" for q in "EF"} - set(given)


@pytest.mark.parametrize(("scene", "value"), [
    ("sixbar-1A-last-link", "−84.247°"), ("loader-cylinder", "s76=180"), ("loader-cylinder", "70°"),
])
def test_the_value_of_a_driver_stands_in_the_mechanism_of_the_sheet_and_of_its_own_figure(scene, value):
    drawn = draw(scene)
    for figure, box in (("sheet", sheet_plan(drafted(scene)[1]).mechanism), ("mechanism", None)):
        texts = [thing for thing in walk(drawn.figures[figure].children) if isinstance(thing, Text)]
        found = [text.at for text in texts if value in text.string.replace(" ", "") and "," not in text.string
                 and (box is None or box.distance(text.at) == 0.0)]
        assert 1 == len(found)


@pytest.mark.parametrize(("high", "angle"), [(0, 75), (-30, 30)])
def test_a_guide_that_its_panel_cuts_keeps_its_letter(high, angle):
    scene = mechanism_of({
        "frame": {"points": {"A": [0, 0]}, "guides": {"k": {"through": [112, high], "angle": 20}}},
        "links": {"1": {"points": ["A", "B"], "length": 70},
                  "2": {"points": ["C"], "on": "0.k", "guides": {"s": {"through": [0, 0], "angle": 80}}}},
        "pins": {"B": {"of": "1", "in": "2.s"}},
        "driver": {"link": "1", "angle": angle, "omega": 5},
        "sketch": {"C": [112, high + 5], "B": [10, 70]},
    })
    sheet = draft(scene, room=sheet_room(scene))
    room = sheet_plan(sheet).mechanism.grown(-0.8)
    whole, box = mechanism_piece(sheet, notation_of(sheet, "chinese"))
    cut, _ = mechanism_piece(sheet, notation_of(sheet, "chinese"), (room.width, room.height))
    assert box.width > room.width
    names = {label.text.id for label in whole.labels if "length" not in label.text.id}
    assert "label-guide-0-k" in names
    assert names <= {label.text.id for label in cut.labels}


@pytest.mark.parametrize("name", ["hydraulic-cylinder", "shaper-scheme-2", "sixbar-guide-40deg"])
def test_a_sheet_says_of_as_many_readings_that_they_agree_as_its_table_shows(name):
    drawn = draw(name, figures=["sheet"])
    rows = table_rows(drawn.checked.report)
    (said,) = [text for text in pages(drawn) if "readings agree" in text]
    assert f"all {len(rows)} readings agree with the analytic solution" == said


def test_a_further_page_says_in_its_description_what_it_holds():
    pages = draw("contour-four-bars", figures=["sheet"], language="en").figures
    assert "Vector equations, Readings and check" == pages["sheet-2"].desc


@pytest.mark.parametrize(("name", "at"), [("hydraulic-cylinder", None), ("boom-lifted", 300), ("scissor-lift", None)])
def test_a_vector_laid_off_before_its_turn_is_whole_in_its_panel(name, at):
    drawn = draw(name, at=at, figures=["sheet"])
    steps = [s for s in drawn.small.sheet.steps if s.reason == "before its turn" and s.mm > 1.0]
    groups = [g for g in walk(drawn.figures["sheet"].children) if isinstance(g, Group) and "construction" in g.classes]
    heads = {g.step for g in groups if any(isinstance(part, Polygon) for part in g.children)}
    assert {s.number for s in steps} == heads


@pytest.mark.parametrize("language", ["en", "zh", "both"])
def test_a_title_too_long_for_a_sheet_ends_in_dots(language, violations):
    scene = read("fourbar-150-500-300-400").to_dict()
    long = {"title": "a linkage with many words in its title " * 7, "title_zh": "一个很长的标题" * 40}
    sheet = draw(scene | long, figures=["sheet"], language=language).figures["sheet"]
    assert [] == violations(sheet.content("svg"))
    assert any(text.endswith("…") for text in words(sheet))


def test_a_cam_larger_than_its_panel_is_cut_at_the_edge():
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"v": {"through": [6, 0], "angle": 90}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.v"}},
        "cams": {"1": {"follower": "2", "base": {"r": 60}, "flat": True, "law": [
            {"to": 100, "rise": 16, "by": "cycloidal"}, {"to": 200}, {"to": 300, "fall": 16, "by": "345"},
            {"to": 360}]}},
        "driver": {"link": "1", "angle": 150, "omega": 9},
    }
    groups = (thing for thing in walk(draw(scene).figures["sheet"].children) if isinstance(thing, Group))
    (cam,) = (group for group in groups if group.id == "cam-1")
    outline = [z for thing in walk(cam.children) if isinstance(thing, Polyline) for z in thing.points]
    assert 10 < len(outline)
    low = max(z.imag for z in outline)
    assert 2 <= sum(abs(z.imag - low) < 1e-9 for z in outline)  # it ends at the edge of the panel


def test_numbers_of_the_divisions_of_a_short_fall_keep_off_each_other(violations):
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {"v": {"through": [0, 0], "angle": 90}}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "0.v"}},
        "cams": {"1": {"follower": "2", "base": {"r": 40}, "roller": 6, "law": [
            {"to": 80, "rise": 20, "by": "345"}, {"to": 245}, {"to": 260, "fall": 20, "by": "cycloidal"},
            {"to": 360}]}},
        "driver": {"link": "1", "angle": 20, "omega": 5},
    }
    assert [] == violations(draw(scene, figures=["cam"]).figures["cam"].content("svg"))


@pytest.mark.parametrize("letters", [24, 40])
def test_equations_with_names_as_long_as_they_may_be_stand_on_further_pages(letters):
    a, b, c, crank, block, guide = (name.ljust(letters, name.lower()) for name in "ABCKLG")
    scene = {
        "frame": {"name": "0", "points": {a: [0, 120], c: [0, 0]}},
        "links": {
            crank: {"points": [a, b], "length": 60}, block: {"points": [b], "on": guide}, guide: {"points": [c]},
        },
        "driver": {"link": crank, "angle": 20, "omega": 8, "alpha": 3},
    }
    told = {text.replace(" ", "") for text in pages(draw(scene, figures=["sheet"], convention="us"))}
    assert set() == {f"A{b}{guide}", f"A{b}{guide}/{b}{block}c"} - told


def test_coriolis_insets_stand_in_rows_and_what_has_no_room_is_left():
    sheet = drafted("shaper-scheme-2")[1]
    terms = coriolis_terms(sheet) * 3
    room = Box(0.0, 0.0, INSET[0] + 1.0, 2 * INSET[1] + 5.0)
    (drawn, left), (_, no_room_left) = (
        coriolis_rows(sheet, terms, notation_of(sheet, "chinese"), each, 4.0)
        for each in (room, room._replace(bottom=INSET[1] - 1.0))
    )
    insets = [thing for thing in walk(drawn.drawn) if isinstance(thing, Group) and "inset" in thing.classes]
    assert (2, terms[2:], terms) == (len(insets), left, no_room_left)
