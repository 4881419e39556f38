"""What stands on the figures, read from the finished SVG files: true lengths, names, layers, words."""

from __future__ import annotations

import cmath
import json
import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from functools import lru_cache

import pytest

import graphkin
from graphkin.checking.readings import report_on
from graphkin.construction import draft
from graphkin.drawing import Box, Drawing, Text, svg_bytes
from graphkin.drawing.boxes import FigurePage
from graphkin.drawing.figures.diagrams import diagram_figures
from graphkin.drawing.ink.primitives import Circle, Group, Line, Polygon, walk
from graphkin.drawing.text import text_box
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.scene.scene_tables import PAPERS
from graphkin.solver import solve
from tests import scenes
from tests.drawn import drafted, drawn, figures

SVG = "{http://www.w3.org/2000/svg}"
GUIDE = "sixbar-guide-40deg"


@lru_cache(maxsize=64)
def root(name: str, figure: str, language: str = "en", convention: str = "chinese") -> ET.Element:
    return ET.fromstring(svg_bytes(drawn(name, language, convention)[figure]))


def facts(page: ET.Element) -> dict:
    return json.loads(page.find(f"{SVG}metadata").text)


def vectors(page: ET.Element) -> dict[str, complex]:
    """Each vector by its id, y up, in mm, from the first child of its group."""
    found = {}
    for group in page.iter(f"{SVG}g"):
        if "vector" in group.get("class", "").split():
            line = group[0]
            x1, y1, x2, y2 = (float(line.get(key)) for key in ("x1", "y1", "x2", "y2"))
            found[group.get("id")] = complex(x2 - x1, y1 - y2)
    return found


def words(page: ET.Element) -> list[str]:
    """Texts without spaces: between runs they are distances, not characters."""
    return ["".join(text.itertext()).replace(" ", "") for text in page.iter(f"{SVG}text")]


def ids(page: ET.Element) -> list[str]:
    return [element.get("id") for element in page.iter() if element.get("id")]


# true to scale


def test_b3_of_the_worked_example_lies_107_578_mm_from_the_pole() -> None:
    assert abs(vectors(root(GUIDE, "velocity"))["v_B3"]) == pytest.approx(107.578, abs=1e-3)


def test_a_vector_times_the_scale_of_the_file_is_its_value() -> None:
    page = root(GUIDE, "acceleration")
    assert abs(vectors(page)["ak_B3-B2"]) * facts(page)["scales"]["acceleration"] == pytest.approx(3244.28, abs=0.2)


def test_one_user_unit_is_one_millimetre() -> None:
    page = root(GUIDE, "sheet")
    across, down = page.get("width").removesuffix("mm"), page.get("height").removesuffix("mm")
    assert f"0 0 {across} {down}" == page.get("viewBox")


@pytest.mark.parametrize("name", library())
@pytest.mark.parametrize("figure", ["velocity", "acceleration"])
def test_every_vector_of_the_drawing_stands_on_the_figure_with_its_length_and_direction(name: str, figure: str) -> None:
    drawn = drafted(name)[0].vectors[figure]
    found = vectors(root(name, figure))
    assert {s.id for s in drawn} == set(found)
    assert max((abs(v.span - found[s.id]) for s, v in drawn.items()), default=0.0) < 1.5e-3


def test_a_vector_along_a_guide_is_parallel_to_it() -> None:
    sheet = drafted(GUIDE)[0]
    along = sheet.poses["3"].axis
    off = cmath.phase(vectors(root(GUIDE, "velocity"))["v_B3-B2"] / along) % math.pi
    assert min(off, math.pi - off) < 1e-4


def test_a_vector_square_to_a_bar_is_square_to_it() -> None:
    along = drafted(GUIDE)[0].poses["3"].axis
    assert abs(math.cos(cmath.phase(vectors(root(GUIDE, "velocity"))["v_B3"] / along))) < 1e-4


def test_the_chain_of_an_equation_closes_on_the_figure() -> None:
    v = vectors(root(GUIDE, "acceleration"))
    assert abs(v["an_B3-C"] + v["at_B3-C"] - v["a_B"] - v["ak_B3-B2"] - v["ar_B3-B2"]) < 5e-3


def test_an_image_is_similar_to_its_link_and_turned_the_same_way() -> None:
    sheet = drafted("sixbar-coupler-1A")[0]
    page = root("sixbar-coupler-1A", "velocity")
    image = next(g for g in page.iter(f"{SVG}g") if g.get("id") == "image-velocity-2")
    values = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", image[0].get("points"))]
    b, c, e = (complex(x, -y) for x, y in zip(values[::2], values[1::2], strict=True))
    places = {ref.point: z for ref, z in sheet.points.items()}
    assert (e - b) / (c - b) == pytest.approx((places["E"] - places["B"]) / (places["C"] - places["B"]), abs=1e-4)


@pytest.mark.parametrize("name", library())
@pytest.mark.parametrize("diagram", ["velocity", "acceleration"])
def test_a_polygon_fills_40_to_90_per_cent_of_its_panel(name: str, diagram: str) -> None:
    page = root(name, "sheet")
    prefix = "v" if diagram == "velocity" else "a"
    ends = [0.0, 0.0]
    points = []
    for group in page.iter(f"{SVG}g"):
        if "vector" in group.get("class", "").split() and group.get("id").startswith(prefix):
            points += [complex(*(float(group[0].get(k)) for k in keys)) for keys in (("x1", "y1"), ("x2", "y2"))]
    ends = [max(p.real for p in points) - min(p.real for p in points),
            max(p.imag for p in points) - min(p.imag for p in points)]
    panels = [g[0] for g in page.iter(f"{SVG}g") if g.get("class") == "panel"]
    sides = []
    for panel in panels:
        values = [float(n) for n in re.findall(r"-?\d+(?:\.\d+)?", panel.get("points"))]
        left, right, top, bottom = min(values[::2]), max(values[::2]), min(values[1::2]), max(values[1::2])
        if left <= points[0].real <= right and top <= points[0].imag <= bottom:
            sides = [right - left, bottom - top]
    assert 0.4 <= max(ends) / max(sides) <= 0.9


@pytest.mark.parametrize(
    ("name", "given"),
    [
        ("sixbar-guide-40deg", {"122", "280"}),
        ("shaper-scheme-2", {"90", "580", "174", "350"}),
        ("fourbar-150-500-300-400", {"150", "500", "300", "400"}),
        ("four-bar-coupler-point", {"40", "70", "100"}),
        ("swinging-block", {"50", "220", "130"}),
        ("hydraulic-cylinder", {"400", "200", "300"}),
    ],
)
def test_given_dimensions_are_drawn(name: str, given: set[str]) -> None:
    assert given <= {"".join(text.itertext()) for text in root(name, "mechanism").iter(f"{SVG}text")}


# structure


@pytest.mark.parametrize("name", library())
@pytest.mark.parametrize("figure", ["mechanism", "velocity", "acceleration", "sheet"])
def test_no_id_stands_twice_in_a_figure(name: str, figure: str) -> None:
    found = ids(root(name, figure))
    assert len(found) == len(set(found))


@pytest.mark.parametrize("name", library())
def test_every_link_bears_its_number_on_the_mechanism(name: str) -> None:
    scene = mechanism_of(name)
    named = {id for id in ids(root(name, "mechanism")) if id.startswith("label-link-")}
    assert {f"label-link-{link.name}" for link in (scene.frame, *scene.links)} == named


@pytest.mark.parametrize("number", [1, 2])
def test_a_ring_and_its_inset_share_a_numeral(number: int) -> None:
    page = root("geared-five-bar", "sheet")
    texts = {text.get("id"): "".join(text.itertext()) for text in page.iter(f"{SVG}text")}
    numeral = "I" * number
    assert numeral == texts[f"label-ring-acceleration-{number}"]
    assert texts[f"label-detail-acceleration-{number}"].startswith(f"{numeral}:")


def test_layers_have_names_a_person_understands() -> None:
    page = root(GUIDE, "sheet")
    label = "{http://www.inkscape.org/namespaces/inkscape}label"
    names = [g.get(label) for g in page if g.get(label)]
    assert ["construction", "mechanism", "velocity", "acceleration", "answers", "labels"] == names


@pytest.mark.parametrize("id", ["pole-velocity", "pole-acceleration", "point-B", "link-3", "link-6", "ak_D4-D3"])
def test_poles_points_links_and_vectors_have_their_ids(id: str) -> None:
    assert id in ids(root(GUIDE, "sheet"))


def test_a_vector_bears_the_number_of_its_step() -> None:
    sheet = drafted(GUIDE)[0]
    page = root(GUIDE, "velocity")
    group = next(g for g in page.iter(f"{SVG}g") if g.get("id") == "v_B3")
    step = next(s.number for s in sheet.steps for vector in s.vectors if str(vector.symbol) == "v_B@3")
    assert f"step-{step:02d}" in group.get("class").split()


def test_metadata_say_scene_position_scales_and_instrument() -> None:
    own = facts(root(GUIDE, "velocity"))
    assert {"1": 50.0} == own["at"]
    assert {"length": 2.0, "velocity": 10.0, "acceleration": 100.0} == own["scales"]
    assert (GUIDE, "exact", "mm") == (own["scene"], own["instrument"], own["units"]["length"])


def test_coincident_points_have_their_own_marks_where_they_fall_together() -> None:
    assert {"velocity-B3", "velocity-C"} <= set(ids(root("scotch-yoke", "velocity")))


def test_the_description_tells_every_vector() -> None:
    text = root(GUIDE, "velocity").find(f"{SVG}desc").text
    assert "Velocity of B of link 3 relative to B of link 2 is 575.4 mm/s" in text


def test_the_same_scene_gives_the_same_bytes() -> None:
    own, on_sheet = drafted(GUIDE)
    report = report_on(on_sheet, solve(on_sheet.scene))
    one, two = (figures(own, on_sheet, report, "both") for _ in range(2))
    assert [svg_bytes(d) for d in one.values()] == [svg_bytes(d) for d in two.values()]


# conventions and languages


@pytest.mark.parametrize(
    ("convention", "figure", "word"),
    [
        ("chinese", "velocity", "p (a, c)"),
        ("chinese", "velocity", "b3"),
        ("chinese", "velocity", "∥CB"),
        ("chinese", "velocity", "μv= 10 (mm/s)/mm"),
        ("chinese", "acceleration", "b3′"),
        ("chinese", "acceleration", "n3′"),
        ("us", "velocity", "Ov"),
        ("us", "velocity", "VB3/B2"),
        ("us", "velocity", "1 mm = 10 mm/s"),
        ("british", "velocity", "o (a, c)"),
        ("british", "velocity", "1 cm = 100 mm/s"),
        ("british", "acceleration", "b3,1′"),
        ("russian", "acceleration", "π (a′, c′)"),
        ("russian", "velocity", "μv= 10 mm/(s·mm)"),
    ],
)
def test_each_convention_has_its_letters(convention: str, figure: str, word: str) -> None:
    assert word.replace(" ", "") in words(root(GUIDE, figure, "en", convention))


@pytest.mark.parametrize(
    ("language", "word"), [("en", "direction"), ("zh", "方向"), ("zh", "大小"), ("both", "direction 方向")]
)
def test_the_rows_of_an_equation_are_named_in_the_language(language: str, word: str) -> None:
    assert word.replace(" ", "") in words(root(GUIDE, "sheet", language))


def test_a_chinese_figure_has_no_english_words() -> None:
    english = [w for w in words(root(GUIDE, "sheet", "zh")) if re.search(r"[A-Za-z]{4,}", w)]
    assert [w for w in english if "sixbar" not in w and "rad/s" not in w] == []


def test_no_text_is_smaller_than_two_millimetres() -> None:
    page = root("hit-two-RPR", "sheet", "both", "british")
    assert min(float(span.get("font-size")) for span in page.iter(f"{SVG}tspan")) >= 2.0


def test_a_link_has_one_colour_in_the_mechanism_and_in_the_polygon() -> None:
    def colour(figure: str, id: str) -> str:
        group = next(g for g in root(GUIDE, figure).iter(f"{SVG}g") if g.get("id") == id)
        return next(e.get("stroke") for e in group.iter() if e.tag == f"{SVG}line")

    assert colour("mechanism", "link-3") == colour("velocity", "v_B3") == colour("acceleration", "a_B3")


# senses


@pytest.mark.parametrize(("id", "sense"), [("driver-1", -1), ("omega-3", -1), ("alpha-3", 1)])
def test_an_arc_turns_as_the_link_does(id: str, sense: int) -> None:
    group = next(g for g in root(GUIDE, "mechanism").iter(f"{SVG}g") if g.get("id") == id)
    sweep = int(re.findall(r"-?\d+(?:\.\d+)?", group.find(f"{SVG}path").get("d"))[6])
    assert {0: 1, 1: -1}[sweep] == sense  # the sweep flag 1 is clockwise on the page


def test_the_inset_of_a_coriolis_part_shows_the_sliding_velocity_turned_with_the_guide() -> None:
    sheet = drafted(GUIDE)[0]
    symbols = {str(s): v.span for d in ("velocity", "acceleration") for s, v in sheet.vectors[d].items()}
    group = next(g for g in root(GUIDE, "acceleration").iter(f"{SVG}g") if g.get("id") == "sense-ak_B3-B2")
    lines = group.findall(f"{SVG}line")
    spans = [complex(float(e.get("x2")) - float(e.get("x1")), float(e.get("y1")) - float(e.get("y2"))) for e in lines]
    turned = [s / abs(s) for s in spans]
    wanted = [symbols[n] / abs(symbols[n]) for n in ("v_B@3/B@2", "ak_B@3/B@2")]
    assert turned == pytest.approx(wanted, abs=1e-3)


@pytest.mark.parametrize("convention", ["chinese", "british", "russian"])
def test_no_two_feet_of_components_bear_the_same_name(convention):
    page = root("rotating-guide-bar", "acceleration", convention=convention)
    feet = [g for g in page.iter() if g.get("id", "").startswith("label-foot-")]
    names = ["".join(g.itertext()) for g in feet]
    assert 2 == len(set(names)) == len(names)


def on_paper(name: str, paper: str, orientation: str) -> Drawing:
    scene = mechanism_of(name)
    scene = scene.asking(sheet=replace(scene.question.sheet, paper=paper, orientation=orientation))
    return graphkin.draw(scene, figures=["sheet"]).figures["sheet"]


@pytest.mark.parametrize("orientation", ["portrait", "landscape"])
@pytest.mark.parametrize("paper", PAPERS)
def test_the_sheet_is_as_large_as_the_paper_that_the_scene_wishes(paper: str, orientation: str) -> None:
    short, long = PAPERS[paper]
    page = on_paper("shaper-scheme-2", paper, orientation)
    assert (short, long) == tuple(sorted((page.width, page.height)))
    assert (orientation == "landscape") == (page.width > page.height)


@pytest.mark.parametrize("orientation", ["portrait", "landscape"])
@pytest.mark.parametrize("name", ["shaper-scheme-2", "sixbar-guide-40deg", "four-bar-coupler-point"])
def test_nothing_runs_off_a_small_sheet_and_no_words_stand_on_each_other(name: str, orientation: str) -> None:
    page = on_paper(name, "A5", orientation)
    texts = [text_box(thing) for thing in walk(page.children) if isinstance(thing, Text)]
    assert all(Box(0.0, 0.0, page.width, page.height).grown(-5.0).holds(box) for box in texts)
    assert [] == [(a, b) for i, a in enumerate(texts) for b in texts[:i] if a.grown(-0.3).overlaps(b)]


@pytest.mark.parametrize("figure", ["mechanism", "forces", "lever", "loops"])
def test_the_line_below_a_title_has_the_colon_of_its_language(figure: str) -> None:
    drawn = graphkin.draw("shaper-forces", figures=[figure], language="zh")
    root = ET.fromstring(drawn.figures[figure].content("svg"))
    lines = ["".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text")]
    assert [] == [line for line in lines if "14.9006" in line and ": " in line]
    assert any(re.match("[一-龥]+：φ", line) for line in lines), lines[:5]


@pytest.mark.parametrize(
    ("name", "further"),
    [("wheel-on-rail", ["plan"]), ("gears-epicyclic", ["plan"]), ("disc-on-disc", ["contacts"]),
     ("cam-flat-face", ["cam", "contacts"]), ("four-bar-coupler-point", [])],
)
def test_what_rolls_has_a_plan_by_itself_and_what_slides_on_an_outline_polygons_at_the_contact(
    name: str, further: list[str]
) -> None:
    always = {"mechanism", "velocity", "acceleration", "sheet", "centres"}
    assert further == sorted({*graphkin.draw(name).wanted} - always)


def test_a_redundant_crank_stands_on_a_fixed_pivot_and_bears_its_pins() -> None:
    sheet = draft(mechanism_of_text(scenes.DOUBLE_PARALLELOGRAM, "p"))
    page = diagram_figures(FigurePage.of(sheet, "", None, None))["mechanism"]
    points = {group.id: group for group in walk(page.children) if isinstance(group, Group)}
    rings = {name: sum(isinstance(one, Circle) for one in walk(points[f"point-{name}"].children)) for name in "ADEF"}
    assert {"A": 1, "D": 1, "E": 1, "F": 1} == rings
    assert 3 == sum(isinstance(one, Polygon) for one in walk(points["link-0"].children))


def follower_figure(name: str, tip: dict[str, object], points: list[str]) -> dict[str, Group | Text]:
    """The named parts of the mechanism figure of a cam whose follower has some tip, and some points."""
    scene = graphkin.read(name).to_dict()
    scene["links"]["2"]["points"] = points
    scene["cams"]["1"] = {key: scene["cams"]["1"][key] for key in ("follower", "law", "base")} | tip
    made = graphkin.draw(scene, figures=["mechanism"]).figures["mechanism"]
    return {part.id: part for part in walk(made.children) if isinstance(part, Group | Text) and part.id}


@pytest.mark.parametrize("tip", [{"roller": 8}, {}, {"flat": True}], ids=["roller", "edge", "face"])
def test_a_follower_without_points_has_the_bar_from_its_block_to_its_tip(tip: dict[str, object]) -> None:
    links = [follower_figure("cam-flat-face", tip, points)["link-2"] for points in (["B"], [])]
    with_point, without = (
        [z for part in link.children if isinstance(part, Line) for z in (part.start, part.end)] for link in links
    )
    assert len(with_point) > 0
    assert with_point == pytest.approx(without)


def test_the_letter_of_the_guide_that_replaces_a_flat_face_stands_at_the_face() -> None:
    parts = follower_figure("cam-flat-face", {"flat": True}, ["B"])
    (face,), letter = parts["follower-2"].children, text_box(parts["label-guide-2-f"])
    assert isinstance(face, Line)
    assert min(abs(end - letter.centre) for end in (face.start, face.end)) < 2.5
