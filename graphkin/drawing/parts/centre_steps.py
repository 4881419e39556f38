"""The lines on which centres lie, each centre in a small picture of its own: of those whose lines have no room for
their names in the figure of all centres.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise, permutations

from graphkin.account.headings import figure_title
from graphkin.account.notation import Letters
from graphkin.construction.centres import Centre, Centres
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import FigurePage, column, framed, numbered, panel, rows
from graphkin.drawing.font_widths import text_box
from graphkin.drawing.ink.primitives import Group, Line, Primitive, Text, walk
from graphkin.drawing.parts.centre_marks import TOGETHER, centre_marks, line_name, near_box
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_crowd, without
from graphkin.drawing.place.obstacles import obstacles_of
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece, renamed
from graphkin.drawing.write.drawing import Drawing

__all__ = ["centre_steps", "named_centres", "untold"]

WIDTH = 194.0  # mm of a page between its margins
COLUMNS, ROWS = 2, 3
PICTURE, GAP = (95.5, 76.0), 3.0  # mm, width and height of a picture, and between pictures
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
    page = FigurePage(centres.sheet, "centres", language, letters, WIDTH)
    each = COLUMNS * ROWS
    return tuple(_page(page, centres, some[i : i + each], behind) for i in range(0, len(some), each))


def _page(page: FigurePage, centres: Centres, some: Sequence[Centre], behind: Piece) -> Drawing:
    pictures, said = [], [figure_title(centres.sheet, "lines of centres", page.language)]
    for centre in some:
        by = " × ".join(line_name(line, page.letters) for line in centre.lines)
        told = f"${page.letters.centre(centre.pair)}$ = {by}"
        said.append(f"{centre.number}. " + told.replace("$", "").replace("_{", "").replace("}", ""))
        picture = panel(*PICTURE, partial(_picture, centres, centre, behind, page.letters))
        pictures.append(column(numbered(centre.number, told, PICTURE[0], LETTER), framed(picture), gap=0.6))
    return page.drawing(
        page.term("lines of centres"), column(*rows(pictures, WIDTH, GAP), gap=GAP), page.scale("mechanism"),
        title="lines of centres", said="\n".join(said),
    )  # fmt: skip


def _picture(centres: Centres, centre: Centre, behind: Piece, letters: Letters, room: Box) -> Piece:
    """One centre with its two lines and the centres through which they lead."""
    through = dict.fromkeys(pair for line in centre.lines for pair in line.through if not isinstance(pair, str))
    known = (centres.of(*pair) for pair in through)
    table = {c.pair: replace(c, lines=()) for c in known} | {centre.pair: centre}
    alone = replace(centres, table=table)
    inside = room.grown(-INSIDE)
    content = near_box(alone, ink_box(behind.drawn) or Box(-10.0, -10.0, 10.0, 10.0), (inside.width, inside.height))
    origin = inside.centre - content.centre
    around = room.grown(-CLEAR).moved(-origin)
    piece, crowded = with_crowd(joined((behind, centre_marks(alone, letters, around, behind.drawn))), around)
    piece = without(piece, {label.text.id for label in crowded if label.rank > 2})  # told above the picture
    return renamed(moved_piece(piece, origin), f"-{centre.number}")
