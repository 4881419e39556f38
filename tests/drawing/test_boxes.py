"""Boxes of a page know their size, and stand clear of each other."""

from __future__ import annotations

import re
from itertools import combinations
from pathlib import Path

import pytest

from graphkin.api.drawn import SUPPLIES
from graphkin.drawing import figures
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, column, foot, framed, heading, page, pages, panel, prose, row, rows, table
from graphkin.drawing.figures import figure_kinds
from graphkin.drawing.ink.primitives import Line, Polygon, Text, walk
from graphkin.drawing.place.piece import Piece, ink_box
from graphkin.drawing.text import text_box, width
from graphkin.scene.scene_tables import DIAGRAMS
from graphkin.words import word
from graphkin.words.symbols import sign

LONG = "the velocity polygon turned by 90 degrees is a rigid lever about its pole " * 3


def square(size: float) -> Block:
    return panel(size, size, lambda room: Piece({"mechanism": (Polygon(room.corners, "#fff"),)}))


def inked(block: Block) -> Box:
    box = ink_box(block.piece.drawn)
    assert box is not None
    return box


def texts(block: Block) -> list[Text]:
    return [thing for thing in walk(block.piece.drawn) if isinstance(thing, Text)]


def test_a_column_is_as_high_as_its_blocks_with_a_gap_between_each_two() -> None:
    assert (17.0, 7.0) == (column(square(5.0), None, square(7.0), square(3.0), gap=1.0).height,
                           column(square(5.0), square(7.0)).width)


def test_an_empty_block_takes_no_gap() -> None:
    assert 11.0 == column(square(5.0), prose((), 50.0), square(5.0), gap=1.0).height


def test_blocks_below_each_other_do_not_overlap() -> None:
    assert Box(0.0, 0.0, 5.0, 14.0) == inked(column(square(5.0), square(5.0), gap=4.0))


def test_blocks_beside_each_other_begin_level_and_are_as_high_as_the_highest() -> None:
    beside = row(square(5.0), square(9.0), gap=2.0)
    assert (9.0, 16.0, Box(0.0, 0.0, 16.0, 9.0)) == (beside.height, beside.width, inked(beside))


def test_a_row_holds_as_many_blocks_as_its_width() -> None:
    assert [22.0, 10.0] == [one.width for one in rows([square(10.0)] * 3, 33.0, gap=2.0)]


def test_a_page_holds_as_many_blocks_as_its_height() -> None:
    assert [22.0, 22.0, 10.0] == [one.height for one in pages([square(10.0)] * 5, 33.0, gap=2.0)]


def test_a_block_higher_than_its_page_stands_alone() -> None:
    assert [5.0, 40.0, 5.0] == [one.height for one in pages([square(5.0), square(40.0), square(5.0)], 30.0, gap=2.0)]


def test_prose_lies_within_its_width_and_height() -> None:
    told = prose((LONG, LONG), 60.0)
    assert Box(0.0, 0.0, 60.0, told.height).grown(0.1).holds(inked(told))  # a letter may hang over its place


@pytest.mark.parametrize("width", [20.0, 9.0])
def test_no_cell_of_a_table_reaches_into_the_next(width: float) -> None:
    made = table([["force", "N"], ["力", "N"]], [[sign("F", "I4"), "−737440.25"], ["P", "3"]], [width, width])
    boxes = [text_box(text) for text in texts(made)]
    assert [] == [pair for pair in combinations(boxes, 2) if pair[0].overlaps(pair[1])]


def test_a_cell_wider_than_its_column_is_set_smaller() -> None:
    made = table([["force", "N"]], [["P", "−737440.25"]], [12.0, 12.0])
    assert 12.0 <= text_box(texts(made)[-1]).left


def test_a_column_too_narrow_for_its_cells_takes_room_from_the_others() -> None:
    made = table([["moment", "measured", "exact"]], [["M", "−0.0000404145", "−0.0000404145"]], [26.0, 9.0, 9.0])
    boxes = [text_box(text) for text in texts(made)]
    assert [] == [pair for pair in combinations(boxes, 2) if pair[0].overlaps(pair[1])]
    assert 44.0 >= max(box.right for box in boxes)


def test_the_parts_of_a_cell_that_is_set_smaller_stand_clear_of_each_other() -> None:
    made = table([["quantity", "mm"]], [[sign("A", "Coupling/Drum", "n") + ", mm/s²", "3"]], [14.0, 30.0])
    runs = texts(made)[2].runs
    index, unit = runs[-2], runs[-1]
    assert index.x + width(index.text, index.size, index.italic, index.bold) <= unit.x + 0.01


def test_a_head_that_both_languages_share_stands_once() -> None:
    made = table([["force", "N"], ["力", "N"]], [["P", "3"]], [20.0, 20.0])
    assert ["force", "N", "力", "P", "3"] == [text.string for text in texts(made)]


def test_a_table_ends_at_its_lower_rule() -> None:
    made = table([["force", "N"]], [["P", "3"]], [20.0, 20.0])
    assert made.height == max(line.start.imag for line in walk(made.piece.drawn) if isinstance(line, Line))


def test_a_frame_is_the_edge_of_its_block() -> None:
    assert Box(0.0, 0.0, 30.0, 8.0) == inked(framed(Block(Piece(), 8.0, 30.0)))


def test_a_page_holds_heading_body_and_foot_clear_of_each_other() -> None:
    parts = heading(("Shaper", "牛头刨床"), "forces", 100.0), square(40.0), foot("1 mm = 2 N", 100.0, "both", "a note")
    made = page(*parts, title="", said="", language="both", metadata={})
    boxes = [text_box(thing) for thing in walk(made.children) if isinstance(thing, Text)]
    boxes += [Box.around(thing.points) for thing in walk(made.children) if isinstance(thing, Polygon)]
    assert Box(0.0, 0.0, made.width, made.height).grown(-1.0).holds(ink_box(made.children))
    assert [] == [pair for pair in combinations(boxes, 2) if pair[0].overlaps(pair[1])]


def test_every_figure_is_named_once_and_supplied_with_what_it_needs() -> None:
    folder = Path(figures.__file__).parent
    written = [name for file in folder.glob("*.py") for name in re.findall(r'Figure\("(\w+)"', file.read_text())]
    assert len(written) == len(set(written))
    assert {*written, *DIAGRAMS} == {*figure_kinds()}
    assert set() == {figure.needs for figure in figure_kinds().values()} - {*SUPPLIES}


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_figure_has_a_name_on_the_page(language: str) -> None:
    assert [] == [name for name in figure_kinds() if not word(f"page figure {name}", language, "")]
