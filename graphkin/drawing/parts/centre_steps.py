"""The lines on which centres lie, each centre in a small picture of its own: of those whose lines have no room for
their names in the figure of all centres.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise, permutations

from graphkin.construction.centres import Centre, Centres
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, scale_statement
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.headings import facts, figure_title, term
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Group, Line, Primitive, Text, walk
from graphkin.drawing.page_text import MARGIN, WIDTH, foot, titled
from graphkin.drawing.parts.centre_marks import TOGETHER, centre_marks, line_name, near_box
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_crowd, without
from graphkin.drawing.place.obstacles import obstacles_of
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece, renamed
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import languages

__all__ = ["centre_steps", "named_centres", "untold"]

HEIGHT = 297.0
COLUMNS, ROWS = 2, 3
GAP, CAPTION = 3.0, 6.0  # mm between pictures, and above each
CLEAR, INSIDE = 1.0, 3.0  # mm from the frame of a picture to names, and to what it shows
LETTER = 3.0
ROUNDS = 4  # how often names are placed anew without those that have no clear place


def named_centres(piece: Piece, panel: Box, centres: Centres) -> Piece:
    """A figure of centres with its names in their places; in a crowd without those of found centres that would stand on
    others or have leaders through joints, which `untold` then returns too."""
    for _ in range(ROUNDS):
        named, crowded = with_crowd(piece, panel)
        ids = _overlapping(named) if crowded else set()
        marks = {label.mark for label in crowded if label.text.id in ids and _found(label, centres)}
        if not marks:
            break
        piece = replace(piece, labels=tuple(label for label in piece.labels if label.mark not in marks))
    return named


def _overlapping(named: Piece) -> set[str]:
    """The names that stand on others, or have leaders through joints."""
    written = named.layers["labels"]
    texts = {thing.id: text_box(thing) for thing in written if isinstance(thing, Text)}
    joints = obstacles_of(without(named, texts).drawn).areas
    ids = {a for a, b in permutations(texts, 2) if texts[a].overlaps(texts[b])}
    return ids | {
        name.id for leader, name in pairwise(written) if isinstance(leader, Line) and isinstance(name, Text)
        and any(one.clip(leader.start, leader.end) and one.distance(leader.start) > 0.0 for one in joints)
    }  # fmt: skip


def _found(label: Label, centres: Centres) -> bool:
    """Whether a name is that of centres that all lie where two lines cross."""
    at = label.mark
    if isinstance(at, tuple) or not label.text.id.startswith("label-centre-"):
        return False
    near = [c for c in centres.found if c.point is not None and abs(c.point.conjugate() - at) < TOGETHER]
    return all(c.lines for c in near)


def untold(centres: Centres, drawn: Sequence[Primitive]) -> tuple[Centre, ...]:
    """The found centres within a figure whose lines are not named in what is drawn of it."""
    things = [*walk(tuple(drawn))]
    ids = {thing.id for thing in things if isinstance(thing, Text)}
    near = {thing.id for thing in things if isinstance(thing, Group) and "centre" in thing.classes
            and "far" not in thing.classes}  # fmt: skip
    names = {centre: "centre-" + "-".join(sorted(centre.pair)) for centre in centres.found if centre.lines}
    return tuple(c for c, name in names.items() if name in near and f"label-lines-{name}" not in ids)


def centre_steps(
    centres: Centres, some: Sequence[Centre], behind: Piece, letters: Letters, language: str
) -> tuple[Drawing, ...]:
    """Pages with a picture of some centres each: the mechanism, the two lines through the centres that are known, and
    where they meet.

    Parameters
    ----------
    centres : on a drawing of a scale that a picture has room for
    behind : its mechanism, pale
    """
    each = COLUMNS * ROWS
    return tuple(
        _page(centres, some[i : i + each], behind, letters, language) for i in range(0, len(some), each)
    )


def _page(
    centres: Centres, some: Sequence[Centre], behind: Piece, letters: Letters, language: str
) -> Drawing:
    words, y = titled(centres.sheet, language, term("lines of centres", language))
    top, rows = y + 4.0, -(-len(some) // COLUMNS)
    wide = (WIDTH - 2 * MARGIN - (COLUMNS - 1) * GAP) / COLUMNS
    high = (HEIGHT - top - MARGIN - ROWS * (CAPTION + GAP) - 6.0) / ROWS
    pieces, said = [], []
    for i, centre in enumerate(some):
        corner = complex(MARGIN + (i % COLUMNS) * (wide + GAP), top + (i // COLUMNS) * (high + CAPTION + GAP))
        by = " × ".join(line_name(line, letters) for line in centre.lines)
        told = f"${letters.centre(centre.pair)}$ = {by}"
        numeral = plain(str(centre.number), LETTER, bold=True)
        words.append(Text(corner + complex(4.5, LETTER + 1.0), numeral, "end", classes=("told",)))
        words.append(Text(corner + complex(6.5, LETTER + 1.0), rich(told, LETTER), classes=("told",)))
        said.append(f"{centre.number}. " + told.replace("$", "").replace("_{", "").replace("}", ""))
        panel = Box(corner.real, corner.imag + CAPTION, corner.real + wide, corner.imag + CAPTION + high)
        pieces.append(renamed(_picture(centres, centre, behind, letters, panel), f"-{centre.number}"))
    end = top + rows * (high + CAPTION + GAP)
    words += foot(scale_statement(centres.sheet, letters.convention, "mechanism"), end + 8.0, LETTER, language)
    page = joined((*pieces, Piece({"labels": tuple(words)})))
    title = figure_title(centres.sheet, "lines of centres", language)
    described = title + "\n" + "\n".join(said)
    return Drawing(
        WIDTH, end + 14.0, layer_groups(page), title, described, languages(language)[0], facts(centres.sheet, "centres")
    )


def _picture(centres: Centres, centre: Centre, behind: Piece, letters: Letters, panel: Box) -> Piece:
    """One centre with its two lines and the centres through which they lead, in a frame."""
    through = dict.fromkeys(pair for line in centre.lines for pair in line.through if not isinstance(pair, str))
    known = (centres.of(*pair) for pair in through)
    table = {c.pair: replace(c, lines=()) for c in known} | {centre.pair: centre}
    alone = replace(centres, table=table)
    inside = panel.grown(-INSIDE)
    content = near_box(alone, ink_box(behind.drawn) or Box(-10.0, -10.0, 10.0, 10.0), (inside.width, inside.height))
    origin = inside.centre - content.centre
    around = panel.grown(-CLEAR).moved(-origin)
    piece, crowded = with_crowd(joined((behind, centre_marks(alone, letters, around, behind.drawn))), around)
    piece = without(piece, {label.text.id for label in crowded if label.rank > 2})  # told above the picture
    corners = panel.corners
    frame = tuple(Line(a, b, strokes.DIMENSION) for a, b in zip(corners, (*corners[1:], corners[0]), strict=True))
    return joined((moved_piece(piece, origin), Piece({"centres": frame})))
