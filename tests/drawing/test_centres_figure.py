"""The figures of instant centres and of centrodes, read back."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from itertools import permutations
from pathlib import Path

import pytest
import shapely

import graphkin
from graphkin.account.notation import notation_of
from graphkin.api.centred import centrodes, found_centres
from graphkin.construction import centres as construction_centres
from graphkin.construction.board.projective import wedge
from graphkin.construction.board.scales import Room
from graphkin.construction.centres import Centres
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import FigurePage
from graphkin.drawing.figures.centres import (
    background,
    centre_marks,
    centres_figure,
    circle_diagram,
    named_centres,
    untold,
)
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Polyline, Primitive, Text, on_page, walk
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined
from graphkin.drawing.text import text_box
from graphkin.drawing.write.drawing import Drawing
from graphkin.drawing.write.svg import svg_bytes
from graphkin.errors import CallError, Disagreement
from graphkin.scene import mechanism_of
from tests.mechanisms import random_scene
from tests.scenes import slider_crank

CLASSROOM = ("fourbar-150-500-300-400", "slider-crank-offset", "shaper-scheme-2", "sixbar-420rpm", "whitworth")


def figure(name: str, convention: str | None = None) -> tuple[Centres, Drawing]:
    centres = found_centres(mechanism_of(name), None)
    return centres, centres_figure(FigurePage.of(centres.sheet, "centres", None, convention), centres)


def things(drawing: Drawing) -> Iterator[Primitive]:
    return iter(tuple(walk(drawing.children)))


def labels(drawing: Drawing) -> list[Text]:
    return [t for t in things(drawing) if isinstance(t, Text) and "centre" in t.classes]


@pytest.mark.parametrize("name", CLASSROOM)
def test_every_centre_has_a_group_of_its_own(name: str) -> None:
    centres, drawing = figure(name)
    wanted = {"centre-" + "-".join(sorted(pair)) for pair in centres.table}
    assert wanted <= {t.id for t in things(drawing) if isinstance(t, Group)}


@pytest.mark.parametrize("name", CLASSROOM)
def test_every_centre_is_named_once(name: str) -> None:
    centres, drawing = figure(name)
    written = ", ".join(t.string for t in labels(drawing))
    assert [1] * len(centres.table) == [written.count("P" + "".join(sorted(pair))) for pair in centres.table]


@pytest.mark.parametrize("name", CLASSROOM)
def test_names_of_centres_do_not_overlap_each_other(name: str) -> None:
    boxes = [text_box(t) for t in labels(figure(name)[1])]
    assert not [1 for i, a in enumerate(boxes) for b in boxes[:i] if a.overlaps(b)]


@pytest.mark.parametrize("name", CLASSROOM)
def test_nothing_runs_off_the_page(name: str) -> None:
    _, drawing = figure(name)
    for thing in things(drawing):
        if isinstance(thing, Line):
            for z in (thing.start, thing.end):
                assert 0 <= z.real <= drawing.width
                assert 0 <= z.imag <= drawing.height


@pytest.mark.parametrize("name", CLASSROOM)
def test_no_label_of_the_figure_is_badly_placed(name: str, violations: Callable[[bytes], list[str]]) -> None:
    assert [] == violations(svg_bytes(figure(name)[1]))


def test_the_circle_diagram_has_a_side_for_every_centre() -> None:
    centres, drawing = figure("sixbar-420rpm")
    sides = [t for t in things(drawing) if isinstance(t, Group) and "side" in t.classes]
    assert len(centres.table) == len(sides)


def test_the_circle_diagram_numbers_the_centres_found() -> None:
    _, drawing = figure("sixbar-420rpm")
    written = [t.string for t in things(drawing) if isinstance(t, Text) and t.id.startswith("label-side-")]
    assert ["1", "2", "3", "4", "5", "6", "7", "8"] == sorted(written)


def test_numbers_of_a_circle_diagram_stand_nearest_the_middle_of_their_side_with_three_mm_of_room() -> None:
    diagram = circle_diagram(found_centres(mechanism_of("fourbar-150-500-300-400"), None), 0j, 50.0)
    numbers = [thing for thing in walk((diagram,)) if isinstance(thing, Text) and "side" in thing.id]
    # two sides cross at the middle: in hundredths of their 100 mm the first 3 mm from the other, the second also
    # 3 mm and half a gap from the first
    assert pytest.approx([3.0, 4.0]) == [abs(number.at - 0.75j) for number in numbers]


def test_bars_in_the_place_of_a_cam_join_its_axis_the_centre_of_curvature_and_the_roller() -> None:
    centres, drawn = figure("cam-offset-roller")
    axis, curvature, roller = (on_page(centres.of(*pair).point) for pair in (("1", "0"), ("1", "OB"), ("2", "OB")))
    dash = strokes.REDUNDANT.dash
    bars = [t.end - t.start for t in things(drawn) if isinstance(t, Line) and t.stroke.dash == dash]
    assert pytest.approx([roller - curvature, curvature - axis]) == bars


def test_the_us_convention_calls_a_centre_i() -> None:
    assert {"I"} == {t.string[0] for t in labels(figure("slider-crank-offset", "us")[1])}


def test_a_centre_far_away_is_shown_by_an_arrow_with_its_distance() -> None:
    assert "AP24= 9369 mm" in [t.string for t in labels(figure("fourbar-150-500-300-400")[1])]


def test_a_centre_at_infinity_is_shown_by_an_arrow() -> None:
    assert "P34→ ∞" in [t.string for t in labels(figure("slider-crank-offset")[1])]


def test_the_same_scene_gives_the_same_bytes() -> None:
    assert svg_bytes(figure("whitworth")[1]) == svg_bytes(figure("whitworth")[1])


def test_an_indeterminate_linkage_is_said_to_be_one_on_its_figure() -> None:
    _, drawing = figure("single-flier")
    assert any("indeterminate" in t.string for t in things(drawing) if isinstance(t, Text))


def test_branches_of_a_centrode_end_where_the_centre_passes_through_infinity() -> None:
    found = centrodes("fourbar-150-500-300-400", link="2")
    fixed = [g for g in things(found.figure) if isinstance(g, Group) and g.id == "centrode-fixed"]
    assert 2 <= sum(isinstance(line, Polyline) for line in fixed[0].children)


def test_no_stroke_of_a_centrode_leaps_across_the_figure() -> None:
    found = centrodes("slider-crank-offset", link="2", point="S2")
    curves = [t for t in things(found.figure) if isinstance(t, Polyline)]
    assert 8.0 > max(abs(b - a) for c in curves for a, b in zip(c.points, c.points[1:], strict=False))


def test_a_centrode_that_its_centre_goes_over_twice_is_drawn_once() -> None:
    found = centrodes("slotter-75-150", link="4")
    moving = next(g for g in things(found.figure) if isinstance(g, Group) and g.id == "centrode-moving")
    curves = [shapely.linestrings([(z.real, z.imag) for z in t.points]) for t in moving.children]
    assert 1.0 < sum(curve.length for curve in curves)
    assert [] == [one for one, other in permutations(curves, 2) if other.buffer(0.1).covers(one)]


def test_the_moving_centrode_touches_the_fixed_one_at_the_centre() -> None:
    found = centrodes("slider-crank-offset", link="2")
    pose = found.centres.poses["2"]
    mm = found.centres.mm
    moving = pose.origin + pose.axis * complex(found.curves.moving[0]) * mm
    assert abs(moving - complex(found.curves.fixed[0]) * mm) <= 1e-9 * abs(moving)


def test_the_centre_that_is_drawn_lies_on_the_centrode_of_a_mechanism_that_a_slide_drives() -> None:
    scene = slider_crank(50, 120, driver={"slide": "3", "travel": 150, "velocity": 40})
    found = centrodes(scene, link="2")
    turn = math.acos((50**2 + 150**2 - 120**2) / (2 * 50 * 150))  # the crank's; its line meets the upright through C
    assert complex(0.15, 0.15 * math.tan(turn)) == pytest.approx(found.exact)
    assert (True, False) == (found.ok, replace(found, exact=found.exact + 1e-6).ok)


@pytest.mark.parametrize("link", ["1", "3", "9"])
def test_links_without_centrodes_are_refused_by_name(link: str) -> None:
    with pytest.raises(CallError, match=f"centrode {link}"):
        centrodes("slider-crank-offset", link=link)


def test_a_formula_of_a_bilingual_figure_is_written_once():
    from graphkin import centres

    svg = centres("shaper-scheme-2", language="both").figure.content("svg").decode()
    assert 1 == svg.split("</desc>")[1].count("603 mm/s")


@pytest.mark.parametrize("name", ["single-flier", "double-butterfly", "whitworth", "fourbar-150-500-300-400"])
def test_the_lines_of_every_centre_in_the_figure_are_named_there_or_in_a_picture_of_its_own(name: str) -> None:
    found = graphkin.centres(name)
    texts = {thing.id for thing in walk(found.figure.children) if isinstance(thing, Text)}
    pictures = {one.id for page in found.figure.further for one in walk(page.children) if isinstance(one, Group)}
    groups = [one for one in walk(found.figure.children) if isinstance(one, Group) and "centre" in one.classes]
    near = {one.id for one in groups if "far" not in one.classes}
    crossing = {"centre-" + "-".join(sorted(c.pair)): c.number for c in found.centres.found if c.lines}
    wanted = {name: f"{name}-{number}" for name, number in crossing.items() if name in near}
    assert wanted
    assert [] == [n for n, picture in wanted.items() if f"label-lines-{n}" not in texts and picture not in pictures]


def test_a_picture_of_one_centre_has_its_two_lines_through_the_centres_that_are_known() -> None:
    found = graphkin.centres("single-flier")
    crowded = found.centres.at(replace(found.centres.sheet.scales, length=5e-3))
    pages = centres_figure(FigurePage.of(crowded.sheet, "centres", None, None), crowded).further
    assert 2 <= len(pages)
    small: dict[int, list[Line]] = {}
    for page in pages:
        for group in (g for g in walk(page.children) if isinstance(g, Group) and g.id.startswith("centre-lines-")):
            small[int(group.id.removeprefix("centre-lines-"))] = [t for t in group.children if isinstance(t, Line)]
    numbers = {c.number: c for c in found.centres.found if c.lines}
    assert len(small) >= 10
    for number, lines in small.items():
        assert 2 == len(lines)
        ways = [complex(-one.line[1], one.line[0]) for one in numbers[number].lines]
        for line, way in zip(lines, ways, strict=True):
            drawn = (line.end - line.start).conjugate()
            assert abs(drawn.real * way.imag - drawn.imag * way.real) < 1e-6 * abs(drawn) * abs(way)


def test_the_pages_of_single_centres_are_files_beside_the_figure(tmp_path: Path) -> None:
    written = {path.name for path in graphkin.centres("single-flier").write(tmp_path, ("svg", "pdf"))}
    assert {"centres.svg", "centres-2.svg", "centres.pdf", "centres.csv"} <= written
    assert "centres-2.pdf" not in written


@pytest.mark.parametrize("name", ["single-flier", "sixbar-rotating-guide-35rpm", "whitworth"])
def test_no_label_of_a_picture_is_overlapped_crossed_or_cut(
    name: str, violations: Callable[[bytes], list[str]]
) -> None:
    pages = graphkin.centres(name, language="both").figure.further
    assert pages
    assert [[] for _ in pages] == [violations(svg_bytes(page)) for page in pages]


def test_in_a_crowd_no_name_of_a_found_centre_stands_on_another_and_it_is_shown_on_a_further_page() -> None:
    centres = found_centres(mechanism_of("single-flier"), None)
    centres = centres.at(centres.sheet.scales_for(Room(mechanism=(40.0, 32.0))))
    letters = notation_of(centres.sheet, "chinese")
    back = background(bare_mechanism(centres.sheet, letters))
    box = ink_box(back.drawn)
    assert box is not None
    panel = box.grown(6.0)
    near = [c for c in centres.found if c.point is not None and panel.distance(c.point.conjugate()) == 0.0]
    found = {"label-centre-" + "-".join(sorted(c.pair)): c for c in near if c.lines}

    def names(piece: Piece) -> dict[str, Box]:
        written = [thing for thing in piece.layers["labels"] if isinstance(thing, Text) and "centre" in thing.classes]
        return {text.id: text_box(text) for text in written}

    def struck(named: dict[str, Box]) -> set[str]:
        return {a for a in named for b in named if a != b and a in found and named[a].overlaps(named[b])}

    piece = joined((back, centre_marks(centres, letters, panel, back.drawn)))
    all_of_them, clear = names(with_labels(piece, panel)), names(named := named_centres(piece, panel, centres))
    assert struck(all_of_them)
    assert struck(clear) == set()
    left_out = {found[id].pair for id in all_of_them.keys() - clear.keys()}
    assert left_out
    assert left_out <= {centre.pair for centre in untold(centres, named.drawn)}


def test_special_points_of_the_polygons_stand_on_no_figure_of_centres() -> None:
    drawn = graphkin.draw("single-flier", figures=("mechanism", "centres")).figures
    pages = {k: {one.id for one in walk(page.children) if isinstance(one, Group)} for k, page in drawn.items()}
    assert {"mechanism"} == {k for k, ids in pages.items() if any(one.startswith("point-S") for one in ids)}


def test_long_names_of_links_and_points_stand_clear_of_each_other(violations: Callable[[bytes], list[str]]) -> None:
    scene = {
        "frame": {"name": "frame", "points": {"Anchor": [0, 0], "Drum": [400, 0]}},
        "links": {
            "crank": {"points": ["Anchor", "Bolt"], "length": 150},
            "connectingrod": {"points": ["Bolt", "Coupling"], "length": 500},
            "rocker": {"points": ["Drum", "Coupling"], "length": 300},
        },
        "driver": {"link": "crank", "angle": 60, "omega": 10},
    }
    drawing = graphkin.draw(scene, figures=["centres"]).figures["centres"]
    assert [] == violations(drawing.content("svg"))
    assert any("AnchorP" in text.string for text in labels(drawing))


def at_rest(name: str) -> graphkin.Scene:
    scene = graphkin.read(name).to_dict()
    return graphkin.read(scene | {"driver": {"link": "1", "angle": scene["driver"]["angle"], "omega": 0}})


@pytest.mark.parametrize("made", [
    lambda: graphkin.draw("sixbar-420rpm", figures=["centres"]).figures,
    lambda: graphkin.draw(at_rest("sixbar-420rpm"), figures=["centres"]).figures,
    lambda: graphkin.handout("sixbar-420rpm", formats=("html",), positions=1).files,
], ids=["draw", "draw at rest", "handout"])
def test_centres_whose_lines_are_a_tenth_of_a_degree_off_are_not_written(made, monkeypatch):
    def turned(a, b):
        (x, y, w), sine = wedge(a, b)
        z = complex(x, y) * cmath.rect(1.0, math.radians(0.1))
        return (z.real, z.imag, w), sine

    monkeypatch.setattr(construction_centres, "wedge", turned)
    with pytest.raises(Disagreement, match=r"P35: lies 0\.\d+° off its computed place"):
        made()


def test_centres_that_rounding_alone_moves_are_drawn_a_hundredth_of_a_degree_before_a_dead_point():
    # a guide turns parallel to that of the frame: what slides on both lies half a kilometre away
    drawn = graphkin.draw(random_scene(1016, ("PRP", "RPR", "RRR")), at=-186.3134797714, figures=["centres"])
    assert ["centres"] == list(drawn.figures)


def test_long_names_of_links_do_not_run_off_the_page(violations: Callable[[bytes], list[str]]) -> None:
    scene = {
        "frame": {"name": "Foundation", "points": {"A": [0, 0], "D": [100, 0]}},
        "links": {
            "crankshaft": {"points": ["A", "B"], "length": 30},
            "connectingrod": {"points": ["B", "C"], "length": 90},
            "rockerarm": {"points": ["D", "C"], "length": 60},
        },
        "driver": {"link": "crankshaft", "angle": 60, "omega": 10},
    }
    figure = graphkin.draw(scene, figures=["centres"], convention="us").figures["centres"]
    assert [] == violations(svg_bytes(figure))


def test_the_names_of_many_permanent_centres_at_one_pin_stand_on_no_others(
    violations: Callable[[bytes], list[str]]
) -> None:
    pin, rods = cmath.rect(30, math.radians(40)), range(6)
    ends = [cmath.rect(110, math.radians(20 + 60 * k)) for k in rods]
    feet = [z + cmath.rect(50, math.radians(120 + 60 * k)) for k, z in zip(rods, ends, strict=True)]
    scene = {
        "frame": {"points": {"A": [0, 0]} | {f"D{k}": [z.real, z.imag] for k, z in enumerate(feet)}},
        "links": {"1": {"points": ["A", "B"], "length": 30}}
        | {f"{2 * k + 2}": {"points": ["B", f"C{k}"], "length": abs(ends[k] - pin)} for k in rods}
        | {f"{2 * k + 3}": {"points": [f"D{k}", f"C{k}"], "length": 50} for k in rods},
        "driver": {"link": "1", "angle": 40, "omega": 10},
        "sketch": {f"C{k}": [z.real, z.imag] for k, z in enumerate(ends)},
    }
    figures = graphkin.draw(scene, figures=["centres"]).figures
    assert {} == {name: found for name, page in figures.items() if (found := violations(svg_bytes(page)))}
