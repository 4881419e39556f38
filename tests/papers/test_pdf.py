"""Pages are filled, and what belongs together stays together."""

import random

import pytest

from graphkin.drawing.ink.primitives import Line, Scan, Stroke
from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.blocks import Document, Heading, Paragraph, Picture, StepItem, once
from graphkin.papers.pdf import FORMS, KEPT, Page, PageItem, balanced, fill_pages, pages_of

HEIGHT = 260.0
WORDS, ROOM, FRESH = Paragraph(()), Paragraph((), fills=True), Heading((), fresh=True)
FIGURE = Picture(None, floats=True)


def pages(pieces: list[PageItem]) -> list[Page]:
    return fill_pages(pieces, HEIGHT)[0]


def numbers(pieces: list[PageItem], page: Page) -> list[int]:
    """The pieces of a page by their numbers."""
    known = {id(piece): n for n, piece in enumerate(pieces)}
    return [known[id(piece)] for row in page for piece in (*row.left, *row.right)]


def drawn_lots(seed: int) -> list[PageItem]:
    """Stages as solutions have them: an equation, steps in two columns, a figure."""
    chance = random.Random(seed)
    pieces = []
    for _ in range(chance.randint(2, 9)):
        pieces.append(PageItem(WORDS, chance.uniform(15, 40), 5.2))
        steps = chance.randint(1, 12)
        ties = [KEPT if not i else 0.08 for i in range(steps)]
        pieces += [PageItem(WORDS, chance.uniform(5, 18), 2.0, tie, half=True) for tie in ties]
        pieces.append(PageItem(FIGURE, chance.uniform(40, 190), 3.3, 0.04))
    return pieces


@pytest.mark.parametrize("seed", range(10))
def test_every_piece_stands_on_one_page_and_only_figures_are_overtaken(seed):
    pieces = drawn_lots(seed)
    order = [n for page in pages(pieces) for n in numbers(pieces, page)]
    words = [n for n in order if not pieces[n].floats]
    figures = [n for n in order if pieces[n].floats]
    assert list(range(len(pieces))) == sorted(order)
    assert (words, figures) == (sorted(words), sorted(figures))


@pytest.mark.parametrize("seed", range(10))
def test_no_page_is_higher_than_the_paper(seed):
    pieces = drawn_lots(seed)
    for page in pages(pieces):
        heights = [
            balanced([piece.height for piece in (*row.left, *row.right)])[1] if row.left[0].half else row.left[0].height
            for row in page
        ]
        assert sum(heights) + sum(row.gap for row in page) <= HEIGHT + 1e-9


@pytest.mark.parametrize("seed", range(10))
def test_an_equation_is_never_parted_from_its_first_step(seed):
    pieces = drawn_lots(seed)
    heads = [page[0].left[0] for page in pages(pieces)]
    assert not [piece for piece in heads if piece.tie == KEPT]


def test_a_figure_without_room_gives_way_to_the_words_behind_it():
    words, figure = [PageItem(WORDS, size, 5.0) for size in (100.0, 40.0)], PageItem(FIGURE, 180.0, 3.0, 0.04)
    pieces = [PageItem(WORDS, 100.0), figure, *words]
    assert [[0, 2], [1, 3]] == [numbers(pieces, page) for page in pages(pieces)]


def test_no_figure_overtakes_another():
    words, figure = PageItem(WORDS, 150.0), PageItem(FIGURE, 120.0, 3.0, 0.04)
    pieces = [words, figure, PageItem(Picture(None), 100.0, 3.0), PageItem(WORDS, 30.0, 3.0)]
    assert [[0], [1, 2, 3]] == [numbers(pieces, page) for page in pages(pieces)]


def test_steps_in_two_columns_are_about_as_high_on_both_sides():
    assert (2, 32.0) == balanced([20.0, 10.0, 25.0])


def test_room_to_write_in_takes_what_the_page_has_left():
    first, _ = pages([PageItem(WORDS, 100.0), PageItem(ROOM, 0.0, 3.0), PageItem(FRESH, 50.0)])
    assert pytest.approx(157.0) == first[1].height


def test_a_page_is_not_filled_beyond_its_height_by_a_millimetre():
    pieces = [PageItem(WORDS, 150.0), PageItem(WORDS, 111.0), PageItem(WORDS, 20.0)]
    assert [[0], [1, 2]] == [numbers(pieces, page) for page in pages(pieces)]


def test_steps_in_two_columns_take_half_their_height_below_what_stands_above_them():
    pieces = [PageItem(WORDS, 100.0), *(PageItem(WORDS, 70.0, 2.0, 0.08, half=True) for _ in range(4))]
    assert [[0, 1, 2, 3, 4]] == [numbers(pieces, page) for page in pages(pieces)]


def test_a_figure_is_set_at_true_scale_with_room_for_lines_on_its_edge():
    line = Line(0j, 10 + 10j, Stroke(0.5))
    told = FORMS["drawing"](Drawing(10.0, 10.0, (line,), "title", "desc", "en"))
    expected = ('width="11mm"', 'height="11mm"', 'viewBox="0 0 11 11"', 'x1="0.5" x2="10.5" y1="0.5" y2="10.5"')
    assert (10.0, 10.0, 0.5) == tuple(told[key] for key in ("width", "height", "edge"))
    assert [] == [part for part in expected if part not in told["svg"]]


def test_a_scan_under_a_figure_is_no_part_of_a_paper():
    scan = Scan(0j, 1 + 0j, 1, 1, "image/png", b"")
    assert "" == FORMS["drawing"](Drawing(10.0, 10.0, (scan,), "title", "desc", "en"))["svg"]


def test_a_heading_goes_to_the_next_page_with_what_it_leads_to():
    heights = {Heading: 10.0, Paragraph: 200.0, StepItem: 100.0}

    def measure(questions):
        return [(100.0, heights[type(block)]) for block, _ in questions]

    words = once("words", "en")
    steps = [StepItem(number, words) for number in (1, 2)]
    document = Document("title", ("en",), (Paragraph(words), Heading(words), *steps))
    shown = [[type(row.left[0].block) for row in half] for page in pages_of(document, measure) for half in page]
    assert [[Paragraph], [Heading, StepItem, StepItem]] == shown
