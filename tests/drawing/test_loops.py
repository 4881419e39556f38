"""Vector loops: they close, on paper too, their matrices give the rates, and a scene may choose them."""

from __future__ import annotations

import cmath
import math
import xml.etree.ElementTree as ET
from typing import Any

import numpy as np
import pytest

import graphkin
from graphkin.account.loops import MatrixEquation
from graphkin.drawing import svg_bytes
from graphkin.drawing.figures.loops import _matrix
from graphkin.drawing.ink.primitives import Arc, Group, Line, Text, walk
from graphkin.errors import CallError
from graphkin.words.symbols import sign

SCENES = ("shaper-scheme-2", "sixbar-coupler-1A", "single-flier", "double-butterfly", "hydraulic-cylinder",
          "oldham-coupling", "scotch-yoke", "cam-eccentric-flat-rocker")
DRAWN = ("shaper-scheme-2", "sixbar-guide-40deg")


@pytest.mark.parametrize("name", SCENES)
def test_every_loop_closes(name: str) -> None:
    loops = [loop for block in graphkin.solve(name).loops().data for loop in block["loops"]]
    assert [] == [loop["name"] for loop in loops if loop["gap"] > 1e-12]


@pytest.mark.parametrize("name", SCENES)
def test_the_rates_follow_from_the_matrices_that_are_printed(name: str) -> None:
    solved = graphkin.solve(name)
    for block in solved.loops().data:
        for right, order in (("velocity", ("omega", "velocity")), ("acceleration", ("alpha", "acceleration"))):
            found = np.linalg.solve(block["matrix"], block[right])
            position: dict[str, Any] = solved.data["positions"][0]
            exact = [
                position["links"][u[6:]][order[0]] if u.startswith("theta") else position["slides"][u[2:]][order[1]]
                for u in block["unknowns"]
            ]
            assert exact == pytest.approx(found.tolist(), rel=1e-10, abs=1e-9)


@pytest.mark.parametrize("name", SCENES[:2])
def test_the_root_with_its_sign_is_the_position(name: str) -> None:
    for block in graphkin.solve(name).loops().data:
        values = dict(zip(block["unknowns"], block["values"], strict=True))
        root = block["loops"][0]["root"]
        assert values[root["of"]] == pytest.approx(root["value"], rel=1e-12)


@pytest.mark.parametrize("name", DRAWN)
def test_arrows_on_paper_are_tip_to_tail_and_close(name: str) -> None:
    root = ET.fromstring(svg_bytes(graphkin.draw(name, figures=["loops"]).figures["loops"]))
    loops = [g for g in root.iter("{http://www.w3.org/2000/svg}g") if g.get("id") in ("loop-I", "loop-II")]
    assert 2 == len(loops)
    for loop in loops:
        vectors = [g for g in loop if "vector" in (g.get("class") or "")]
        lines = [next(iter(g)) for g in vectors]
        tails = [(line.get("x1"), line.get("y1")) for line in lines]
        tips = [(line.get("x2"), line.get("y2")) for line in lines]
        assert tails == [tips[-1], *tips[:-1]]


@pytest.mark.parametrize(
    ("name", "turned"),
    [("fourbar-150-500-300-400", {"3"}), ("sixbar-coupler-1A", {"3", "5", "6"}), ("shaper-scheme-2", {"4"})],
)
def test_an_angle_stands_at_the_tail_of_its_vector_in_the_sense_of_it(name: str, turned: set[str]) -> None:
    figure = graphkin.draw(name, figures=["loops"]).figures["loops"]
    vectors = [x for g in walk(figure.children) if isinstance(g, Group) and "loop" in g.classes
               for x in g.children if isinstance(x, Line)]
    arcs = [x for x in walk(figure.children) if isinstance(x, Arc)]
    assert arcs
    for arc in arcs:
        own = [(v.end - v.start).conjugate() for v in vectors if abs(v.start - arc.centre) < 1e-6]
        angles = [cmath.phase(vector) % math.tau for vector in own]
        assert [a for a in angles if -1e-9 < a - arc.end <= 0.3 + 1e-9]
    texts = ["".join(run.text for run in x.runs) for x in walk(figure.children) if isinstance(x, Text)]
    assert turned == {text[1] for text in texts if "+ 180°" in text}


def test_a_scene_chooses_its_loops_as_a_book_does() -> None:
    scene = graphkin.read("sixbar-coupler-1A").to_dict()
    chosen = scene | {"loops": {"I": ["A", "B", "C", "D"], "II": ["D", "C", "E", "F", "G"]}}
    loops = [loop for block in graphkin.solve(chosen).loops().data for loop in block["loops"]]
    assert [["A", "B", "C", "D"], ["D", "C", "E", "F", "G"]] == [loop["points"] for loop in loops]


def test_chosen_loops_give_the_same_rates() -> None:
    scene = graphkin.read("sixbar-coupler-1A").to_dict()
    chosen = scene | {"loops": {"I": ["A", "B", "C", "D"], "II": ["D", "C", "E", "F", "G"]}}
    ours, books = (
        [rate for block in graphkin.solve(one).loops().data for rate in block["rates"]] for one in (scene, chosen)
    )
    assert ours == pytest.approx(books)


def test_a_loop_over_points_that_nothing_joins_is_refused() -> None:
    scene = graphkin.read("sixbar-coupler-1A").to_dict() | {"loops": {"I": ["A", "C", "D"]}}
    with pytest.raises(CallError, match=r"loops\.I: no link and no guide joins A and C"):
        graphkin.solve(scene).loops()


def test_the_loops_are_told_in_latex() -> None:
    assert r"\[ 500 \cos \theta_{2} - 300 \cos \theta_{3}" in graphkin.solve("fourbar-150-500-300-400").loops().latex


def test_a_sheet_bears_the_loops_where_the_scene_wishes_for_them() -> None:
    scene = graphkin.read("shaper-scheme-2").replace("sheet", {"loops": True})
    figures = graphkin.draw(scene, figures=["sheet"]).figures
    last = list(figures.values())[-1]
    assert (210.0, True) == (last.width, 'id="loop-I"' in last.content("svg").decode())


def test_no_loop_goes_along_a_link_and_back() -> None:
    loops = [loop["points"] for block in graphkin.solve("scissor-lift").loops().data for loop in block["loops"]]
    assert [["D", "N", "C", "M"], ["C", "Q", "P"], ["B", "A", "M"]] == loops


def test_a_matrix_too_wide_for_its_column_has_letters_of_2_mm() -> None:
    wide = MatrixEquation("loop velocities", (("−112.081",) * 6,) * 6, (sign("v", "12"),) * 6, ("24.7983",) * 6, ())
    block = _matrix(wide, 84.0)
    letters = (run.size for text in walk(block.piece.drawn) if isinstance(text, Text) for run in text.runs)
    assert (True, 2.0) == (block.width > 84.0, min(letters))
