from __future__ import annotations

import json
import math
import os
import re
import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import graphkin
from graphkin.drawing.ink import symbols as arrows
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Polyline, Run, Text
from graphkin.drawing.ink.strokes import CONSTRUCTION, DIRECTION, LINK
from graphkin.drawing.ink.symbols import vector_group
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import check_standard, number, svg_bytes, svg_element
from tests.notation import noted

pytestmark = pytest.mark.quick

SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def drawing(*children, **more):
    return Drawing(210.0, 297.0, tuple(children), "Title", "What it shows", **more)


def root(*children, **more):
    return ET.fromstring(svg_bytes(drawing(*children, **more)))


EVERYTHING = (
    Group(
        (
            vector_group("v_B", 1, 20 + 50j, 80 + 30j, title="velocity of B"),
            vector_group("v_C", 2, 20 + 50j, 20 + 50j, arrows.COMPONENT),
            Line(0j, 10 + 10j, DIRECTION),
            Polyline((0j, 5 + 5j, 9 + 1j), CONSTRUCTION),
            Polygon((0j, 5 + 5j, 9 + 1j), "", LINK),
            Circle(30 + 30j, 2.0, "#ffffff", LINK),
            Arc(30 + 30j, 9.0, 0.0, 4.0, CONSTRUCTION),
        ),
        id="velocity",
        layer="velocity",
    ),
    Group(
        (Text(10 + 10j, rich(noted("速度 $a^n_{C/B}$")), classes=("label",)), Text(9 + 9j, plain("2"), "end")),
        layer="labels",
    ),
)


def test_one_user_unit_is_one_millimetre():
    page = root()
    assert tuple(page.get(key) for key in ("width", "height", "viewBox")) == ("210mm", "297mm", "0 0 210 297")


@pytest.mark.parametrize("name", [None, "shaper-scheme-2"])
def test_svgwrite_itself_finds_nothing_wrong_with_any_element(name):
    pages = [drawing(*EVERYTHING)] if name is None else graphkin.draw(name).figures.values()
    assert [svg_bytes(page) for page in pages] == [svg_bytes(page, debug=True) for page in pages]


def test_svgwrite_finds_an_attribute_that_an_element_does_not_have():
    with pytest.raises(ValueError, match="r"):
        check_standard(svg_bytes(drawing(*EVERYTHING)).decode().replace("<line ", '<line r="1" '))


@pytest.mark.parametrize("asked", [
    "'whitworth', figures=('velocity', 'centres')", "'shaper-forces', figures=['centres'], language='both'",
])
def test_another_process_writes_the_same_bytes(asked):
    program = (
        f"import sys, graphkin; pages = graphkin.draw({asked}).figures.values();"
        "sys.stdout.buffer.writelines(page.content('svg') for page in pages)"
    )
    call = [sys.executable, "-c", program]
    first, second = (
        subprocess.run(call, capture_output=True, check=True, env={**os.environ, "PYTHONHASHSEED": seed}).stdout
        for seed in ("1", "77")
    )
    assert first == second


def test_a_vector_is_a_group_with_its_line_first():
    group = root(*EVERYTHING).find(f".//{SVG}g[@id='v_B']")
    assert (f"{SVG}line", "vector step-01") == (group[0].tag, group.get("class"))


def test_the_line_of_a_vector_is_as_long_as_the_vector():
    line = root(*EVERYTHING).find(f".//{SVG}g[@id='v_B']/{SVG}line")
    x1, y1, x2, y2 = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
    assert math.hypot(60, 20) == pytest.approx(math.hypot(x2 - x1, y2 - y1), abs=1e-3)


def test_the_line_of_a_vector_is_solid():
    assert root(*EVERYTHING).find(f".//{SVG}g[@id='v_B']/{SVG}line").get("stroke-dasharray") is None


def test_a_vector_says_in_words_what_it_is():
    assert root(*EVERYTHING).find(f".//{SVG}g[@id='v_B']/{SVG}title").text == "velocity of B"


def test_layers_are_layers_in_inkscape():
    layers = [g for g in root(*EVERYTHING) if g.get(f"{INKSCAPE}groupmode") == "layer"]
    assert [layer.get(f"{INKSCAPE}label") for layer in layers] == ["velocity", "labels"]


def test_ids_are_given_once():
    twice = (vector_group("a", 1, 0j, 9 + 0j), vector_group("b", 1, 0j, 9 + 0j))
    ids = [element.get("id") for element in root(*twice).iter() if element.get("id")]
    assert len(ids) == len(set(ids))


def test_title_and_description_come_first():
    page = root()
    assert [page[0].text, page[1].text] == ["Title", "What it shows"]


def test_the_page_is_an_image_in_a_language():
    page = root(lang="zh")
    assert (page.get("role"), page.get("lang")) == ("img", "zh")


def test_the_metadata_are_one_json_object():
    facts = {"scene": "four-bar", "at": {"1": 50.0}, "说明": "中文 <&>"}
    assert json.loads(root(metadata=facts).find(f"{SVG}metadata").text) == facts


def test_each_run_has_a_place_of_its_own():
    spans = root(*EVERYTHING).find(f".//{SVG}text").findall(f"{SVG}tspan")
    assert all(span.get("x") and span.get("y") and span.get("font-size") for span in spans)


def test_nothing_is_left_to_the_guess_of_the_reader():
    text = svg_bytes(drawing(*EVERYTHING)).decode()
    assert not any(word in text for word in ("baseline-shift", " dy=", " dx=", "marker", "transform"))


def test_a_text_is_found_again_as_text():
    assert "".join(root(*EVERYTHING).find(f".//{SVG}text").itertext()) == "速度aC/Bn"


def test_chinese_in_an_english_figure_is_marked_as_chinese():
    text = root(*EVERYTHING).find(f".//{SVG}text")
    assert text.get("{http://www.w3.org/XML/1998/namespace}lang") == "zh"


def test_control_characters_are_dropped_and_signs_of_xml_escaped():
    page = root(Text(1 + 1j, plain("a<b>&\"\x00\x1b\ud800c")))
    assert page.find(f".//{SVG}tspan").text == 'a<b>&"c'


@pytest.mark.parametrize(("name", "key"), [("id", "id"), ("classes", "class"), ("layer", f"{INKSCAPE}label")])
def test_a_name_with_signs_of_xml_is_read_again_as_it_is(name, key):
    words = 'a"b\'<c>&d'
    page = root(Group((), **{name: (words,) if name == "classes" else words}))
    assert words == page.find(f"{SVG}g").get(key)


@settings(deadline=None)  # a rare sign has the machine's fonts looked through
@given(st.text(st.characters(exclude_categories=["Cs"])))
def test_any_title_makes_a_file_that_can_be_read(words):
    ET.fromstring(svg_bytes(Drawing(9.0, 9.0, (Text(1 + 1j, plain(words) or plain("x")),), title=words)))


@given(st.floats(-1e6, 1e6))
def test_a_number_is_written_to_three_decimals(value):
    assert abs(float(number(value)) - value) <= 0.0005 + 1e-9


@pytest.mark.parametrize(("value", "text"), [(-0.0001, "0"), (-0.0, "0"), (12.0, "12"), (0.5, "0.5"), (1e-9, "0")])
def test_a_number_is_written_without_ornament(value, text):
    assert text == number(value)


@pytest.mark.parametrize("value", [math.nan, math.inf])
def test_what_is_no_number_is_never_drawn(value):
    with pytest.raises(ValueError, match="coordinate"):
        number(value)


@pytest.mark.parametrize(("end", "flags"), [(1.0, "0 0"), (4.0, "1 0"), (-1.0, "0 1"), (-4.0, "1 1")])
def test_an_arc_turns_the_way_of_its_angles(end, flags):
    path = root(Arc(30 + 30j, 9.0, 0.0, end, CONSTRUCTION)).find(f"{SVG}path")
    assert f" 0 {flags} " in path.get("d")


def in_page(named=False):
    return ET.fromstring(svg_element(drawing(*EVERYTHING), named))


def test_in_a_page_a_line_ends_under_its_arrowhead_by_a_dash_and_not_by_a_clip():
    (vector,) = (g for g in in_page(True).iter("g") if g.get("id") == "v_B")
    dash, gap = map(float, vector[0].get("stroke-dasharray").split())
    length, shaft = math.hypot(60.0, 20.0), EVERYTHING[0].children[0].children[0]
    assert (round(length - shaft.covered, 3), True) == (dash, gap > length)
    assert shaft.covered > 2.0
    assert [] == [e for e in in_page().iter() if e.get("clip-path") or e.tag == "clipPath"]


def test_in_a_page_vectors_have_a_band_for_the_pointer_where_they_have_names_and_layers_have_none():
    ids = {named: [e.get("id") for e in in_page(named).iter() if e.get("id")] for named in (False, True)}
    assert {False: [], True: ["v_B", "v_C"]} == ids
    bands = {named: [e for e in in_page(named).iter("g") if e.get("class") == "hit"] for named in (False, True)}
    assert ([], 1) == (bands[False], len(bands[True]))
    line = bands[True][0][0]
    assert ("20", "50", "80", "30", "3") == tuple(line.get(key) for key in ("x1", "y1", "x2", "y2", "stroke-width"))


def test_words_of_a_figure_in_a_page_stay_as_they_are_though_they_look_like_its_markup():
    words = 'id="a" fill="#000000" textLength="3" /> <title>x</title>'
    svg = svg_element(Drawing(9.0, 9.0, (Text(1 + 1j, plain(words)),), words, "\u202etfel"))
    page = ET.fromstring(svg)
    assert (words, f"{words}. tfel") == ("".join(page.itertext()), page.get("aria-label"))


def test_what_goes_without_saying_is_not_said_in_a_page():
    svg = svg_element(Drawing(9.0, 9.0, (Text(1 + 1j, plain("B", 3.5)), Polygon((0j, 1j, 1 + 0j)))))
    assert svg.endswith('<text font-size="3.5" x="1" y="1"><tspan>B</tspan></text>'
                        '<polygon points="0,0 0,1 1,0"/></svg>')


def test_a_text_of_one_run_ends_at_its_place_though_the_run_begins_beside_it():
    (text,) = root(Text(30 + 5j, (Run("ab", 1.0),), "end")).iter(f"{SVG}text")
    assert ("30", "end") == (text.get("x"), text.get("text-anchor"))


def test_in_a_page_a_run_of_other_letters_than_its_text_has_its_size_and_face():
    runs = Run("2", 0.0, 0.0, 2.5), Run("B", 2.0, 0.0, 3.5, bold=True)
    svg = svg_element(Drawing(9.0, 9.0, (Text(1 + 1j, runs),)))
    assert svg.endswith('<text font-size="3.5" x="1" y="1"><tspan font-size="2.5" x="1" y="1">2</tspan>'
                        '<tspan font-size="3.5" font-weight="bold" x="3" y="1">B</tspan></text></svg>')


def test_letters_as_outlines_stand_at_the_place_of_their_text():
    page = ET.fromstring(svg_bytes(drawing(Text(30 + 40j, plain("I", 3.5))), outlines=True))
    first = re.match(r"M([\d.]+) ([\d.]+)", page.find(f"{SVG}g/{SVG}path").get("d"))
    assert (30, 40) == tuple(pytest.approx(float(n), abs=3.5) for n in first.groups())
