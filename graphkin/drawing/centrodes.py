"""The figure of the centrodes: the fixed and the moving one of a link, which roll on each other; a coupler curve."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphkin.construction.centres import Centres
from graphkin.drawing.box import Box
from graphkin.drawing.centre_marks import mark_of
from graphkin.drawing.centres import background
from graphkin.drawing.conventions import letters_of, scale_statement
from graphkin.drawing.dimensions import check_bar
from graphkin.drawing.drawing import Drawing
from graphkin.drawing.headings import drivers, facts, figure_title, punctuation, term, titles
from graphkin.drawing.labels import Label
from graphkin.drawing.mechanism import bare_mechanism
from graphkin.drawing.piece import Piece, ink_box, joined, layer_groups, moved_piece, with_labels
from graphkin.drawing.primitives import Group, Line, Polyline, Primitive, Stroke, Text
from graphkin.drawing.strokes import colour_of_link
from graphkin.drawing.text import rich, wrapped
from graphkin.words import Phrase, languages, say

__all__ = ["Branch", "centrodes_figure"]

Branch = Sequence[complex]  # places (mm on paper, y up) that a pen joins without lifting

MARGIN, ROOM, LINE, FOOT = 8.0, 8.0, 5.0, 14.0
AROUND, REACH = 0.55, 1.3  # of the mechanism's size: how far around it curves are shown, and the centre at most
FIXED, MOVING, COUPLER = Stroke(0.5), Stroke(0.5, (3.0, 1.2)), Stroke(0.25, (0.8, 0.8))


def centrodes_figure(
    centres: Centres,
    link: str,
    fixed: Sequence[Branch],
    moving: Sequence[Branch],
    curve: Sequence[Branch] = (),
    point: str = "",
    *,
    language: str | None = None,
    convention: str | None = None,
) -> Drawing:
    """Draw the centrodes of a link about the mechanism, cut off where they leave its surroundings.

    Parameters
    ----------
    fixed, moving : branches of the two curves, the moving one where it lies at this position
    curve : the path of ``point``, a point of the link
    language, convention : as for `centres_figure`
    """
    sheet = centres.sheet
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    back = background(bare_mechanism(sheet, letters))
    mechanism = ink_box(back.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    around = mechanism.grown(AROUND * max(mechanism.width, mechanism.height))
    centre = centres.of(link, sheet.scene.frame.name)
    here = None if centre.point is None else centre.point.conjugate()
    if here is not None and mechanism.distance(here) <= REACH * max(mechanism.width, mechanism.height):
        around = around.joined(Box.around((here,)).grown(ROOM))  # where the two touch
    colour = colour_of_link(sheet.scene, link)
    kinds = (
        ("fixed centrode", "centrode-fixed", FIXED, fixed, ""),
        ("moving centrode", "centrode-moving", MOVING.coloured(colour), moving, ""),
        ("coupler curve", "coupler-curve", COUPLER.coloured(colour), curve, point),
    )
    drawn = {id: _clipped(branches, stroke, around) for _, id, stroke, branches, _ in kinds}
    content = mechanism
    for lines in drawn.values():
        content = content.joined(ink_box(lines) or content)
    width = max(130.0, content.width + 2 * (ROOM + MARGIN))
    head = [line for title in titles(sheet, spoken) for line in wrapped(title, 4.0, width - 2 * MARGIN, bold=True)]
    at = f"{term('centrodes', spoken)} {link}{punctuation('colon', spoken)}{drivers(sheet, letters)}"
    head += wrapped(at, 3.2, width - 2 * MARGIN)
    legend = [(say(Phrase(key, (name,)), each), stroke) for key, _, stroke, branches, name in kinds if branches
              for each in languages(spoken)[:1]]
    top = MARGIN + LINE * len(head) + 2.0
    panel = Box(MARGIN, top, width - MARGIN, top + content.height + 2 * ROOM)
    origin = panel.centre - content.centre
    groups = tuple(Group(lines, id=id, classes=("centrode",)) for id, lines in drawn.items() if lines)
    names: tuple[Label, ...] = ()
    if here is not None and content.distance(here) == 0.0:
        text = Text(0j, rich(f"${letters.centre(centre.pair)}$"), classes=("label", "centre"))
        names = (Label(text, here),)
        mark = Group(mark_of(centre, sheet.scene.frame.name, here), id="centre-" + "-".join(sorted(centre.pair)))
        groups = (*groups, mark)
    piece = with_labels(joined((back, Piece({"centres": groups}, names))), panel.moved(-origin))
    words: list[Primitive] = [
        Text(complex(MARGIN, MARGIN + 3.5 + LINE * i), runs, classes=("heading",)) for i, runs in enumerate(head)
    ]
    y = panel.bottom + 4.0
    for said, stroke in legend:
        words.append(Line(complex(MARGIN, y - 1.0), complex(MARGIN + 14.0, y - 1.0), stroke))
        words.append(Text(complex(MARGIN + 17.0, y), rich(said, 3.0), classes=("legend",)))
        y += LINE
    height = y + FOOT - LINE
    statement = rich(scale_statement(sheet, letters.convention, "mechanism"), 3.5)
    words.append(Text(complex(MARGIN, height - 6.0), statement))
    words += check_bar(complex(width - MARGIN - 50.0, height - 6.0), rich(term("check bar", spoken), 2.5))
    page = joined((moved_piece(piece, origin), Piece({"labels": tuple(words)})))
    end = punctuation("full stop", spoken) + punctuation("between sentences", spoken)
    return Drawing(
        width, height, layer_groups(page), figure_title(sheet, "centrodes", spoken),
        "".join(said + end for said, _ in legend).strip(), languages(spoken)[0], facts(sheet, "centrodes"),
    )  # fmt: skip


def _clipped(branches: Sequence[Branch], stroke: Stroke, box: Box) -> tuple[Primitive, ...]:
    """The parts of curves inside a box, each as one polyline."""
    import shapely  # a centrode is cut at the panel's edge; no other figure needs it

    places = [np.conj(np.array(branch)) for branch in branches if len(branch) > 1]
    curves = [shapely.linestrings(z.real, z.imag) for z in places]
    inside = shapely.get_parts(shapely.clip_by_rect(curves, box.left, box.top, box.right, box.bottom))
    return tuple(Polyline(tuple(complex(x, y) for x, y in part.coords), stroke) for part in inside)
