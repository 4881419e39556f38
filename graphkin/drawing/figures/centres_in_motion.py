"""The instant centres as the mechanism moves: links, centres and the paths of the centres, played by any program that
shows SVG; and the figure of the fixed and the moving centrode of a link, which roll on each other, with a coupler
curve."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.centres import Centres, LinkPair
from graphkin.drawing.box import Box
from graphkin.drawing.boxes import Block, FigurePage, column, prose, row
from graphkin.drawing.figures.centres import background, id_of, mark_of
from graphkin.drawing.ink.primitives import Group, Line, Polyline, Primitive, Stroke, Text, Travel, on_page
from graphkin.drawing.ink.strokes import colour_of_link
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.piece import Piece, ink_box, joined
from graphkin.drawing.plate import centred
from graphkin.drawing.text import rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import languages, word
from graphkin.words.symbols import RichText

ROOM, KEY = 8.0, 17.0  # mm around the figure, and of a line in the legend
AROUND = 0.6  # of the mechanism's size: how far around it paths are shown
SECONDS = 8.0
STANDS = 0.05  # mm: what moves less has no path
PATH = 0.25
NAMES = ((2.4 - 1.2j, "start"), (-2.4 - 1.2j, "end"), (2.4 + 3.4j, "start"), (-2.4 + 3.4j, "end"))
"""From a centre to its name (mm), and the end of the name that stands there: by turns, since centres meet."""

Places = NDArray[np.complex128]


def centres_in_motion(
    page: FigurePage, centres: Centres, origins: Mapping[str, Places], turned: Mapping[str, NDArray[np.float64]],
    points: Mapping[str, Places], paths: Mapping[LinkPair, Places],
) -> Drawing:
    """Draw a mechanism with its centres, all moving together, and the paths of the centres.

    Parameters
    ----------
    origins, turned, points, paths : places over the frames (mm on paper, y up), and angles of links from the first
        frame (rad); a centre at infinity is NaN.  The first frame is the position of ``centres``.
    """
    sheet, letters = page.sheet, page.letters
    back = background(bare_mechanism(sheet, letters))
    mechanism = ink_box(back.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    everywhere = np.concatenate([*points.values()]) if points else np.zeros(0, complex)
    for place in everywhere[np.isfinite(everywhere)].tolist():
        mechanism = mechanism.joined(Box.around((on_page(place),)).grown(3.0))
    around = mechanism.grown(AROUND * max(mechanism.width, mechanism.height))
    shown = {pair: _inside(path, around) for pair, path in paths.items()}
    content = mechanism
    for path in shown.values():
        if len(good := path[np.isfinite(path)]):
            content = content.joined(Box.around(np.conj(good).tolist()).grown(3.0))
    fixed = {f"point-{name}" for name in sheet.scene.holders if name not in points}
    gone = fixed - {f"point-{name}" for name in sheet.scene.frame.points}  # what stands for a cam at one position
    bodies = [body for body in back.layers["mechanism"] if getattr(body, "id", "") not in gone]
    links = [_moving(body, origins, turned, points) for body in bodies]
    drawn = [_path(pair, path, colour_of_link(sheet.scene, pair[0])) for pair, path in shown.items() if _moves(path)]
    for k, (pair, path) in enumerate(shown.items()):
        drawn += _centre(centres, pair, path, letters.centre(pair), k)
    whole = Piece({"mechanism": tuple(links), "centres": tuple(drawn)})
    page = page.wide_enough(content.width + 2 * ROOM)
    figure = centred(content, page.width, content.height + 2 * ROOM, lambda around: whole, lambda piece, around: piece)
    return page.drawing(
        page.term("centres in motion"), figure, page.scale("mechanism"), title="centres",
        said=page.term("centres in motion") + page.punctuation("full stop"),
    )


def _inside(path: Places, box: Box) -> Places:
    """The part of a path inside a box; NaN elsewhere."""
    spots = on_page(path)
    x, y = spots.real, spots.imag
    with np.errstate(invalid="ignore"):
        inside = (x >= box.left) & (x <= box.right) & (y >= box.top) & (y <= box.bottom)
    return np.where(inside, path, complex(math.nan, math.nan))


def _travel(path: Places, base: complex, turned: NDArray[np.float64] | None = None, about: complex = 0j) -> Travel:
    """The motion of a part drawn at its base place: a displacement on the page for each frame, None where it is
    hidden."""
    moves = tuple(complex(on_page(z - base)) if np.isfinite(z) else None for z in path)
    turns = () if turned is None else tuple(-math.degrees(float(t)) if math.isfinite(t) else 0.0 for t in turned)
    return Travel(moves, turns, about, SECONDS)


def _moving(
    body: Primitive, origins: Mapping[str, Places], turned: Mapping[str, NDArray[np.float64]],
    points: Mapping[str, Places],
) -> Primitive:
    if not isinstance(body, Group):
        return body
    kind, _, name = body.id.partition("-")
    if kind in ("link", "cam", "follower") and name in origins:
        path = origins[name]
        return body._replace(motion=_travel(path, path[0], turned[name], on_page(complex(path[0]))))
    moves = kind == "point" and name in points
    return body._replace(motion=_travel(points[name], points[name][0])) if moves else body


def _moves(path: Places) -> bool:
    good = path[np.isfinite(path)]
    return len(good) > 1 and float(np.max(np.abs(good - good[0]))) > STANDS


def _path(pair: LinkPair, path: Places, colour: str) -> Group:
    """The path in runs that a pen draws without lifting."""
    gaps = np.flatnonzero(~np.isfinite(path))
    runs = ([on_page(z) for z in run.tolist() if math.isfinite(z.real)] for run in np.split(path, gaps))
    lines = tuple(Polyline(tuple(run), Stroke(PATH, (), colour)) for run in runs if len(run) > 1)
    return Group(lines, id=id_of(pair).replace("centre", "path", 1), classes=("centre-path",))


def _centre(centres: Centres, pair: LinkPair, path: Places, name: RichText, k: int) -> Iterator[Group]:
    """A centre with its name, moving along its path."""
    good = np.flatnonzero(np.isfinite(path))
    if not len(good):
        return
    base = complex(path[good[0]])
    mark = mark_of(centres.of(*pair), centres.sheet.scene.frame.name, on_page(base))
    offset, anchor = NAMES[k % len(NAMES)]
    text = Text(on_page(base) + offset, rich(name, 3.0), anchor, classes=("label", "centre"))
    motion = _travel(path, base) if _moves(path) or len(good) < len(path) else None
    yield Group((*mark, text), id=id_of(pair), classes=("centre",), motion=motion)


Branch = Sequence[complex]  # places (mm on paper, y up) that a pen joins without lifting

CURVES_AROUND, REACH = 0.55, 1.3  # of the mechanism's size: how far around it curves are shown, and the centre at most
RETRACED = 0.05  # mm: a pen that stays so near to its line goes over it again
FIXED, MOVING, COUPLER = Stroke(0.5), Stroke(0.5, (3.0, 1.2)), Stroke(0.25, (0.8, 0.8))


def centrodes_figure(
    page: FigurePage, centres: Centres, link: str, fixed: Sequence[Branch], moving: Sequence[Branch],
    curve: Sequence[Branch], point: str,
) -> Drawing:
    """Draw the centrodes of a link about the mechanism, cut where they leave its surroundings.

    Parameters
    ----------
    fixed, moving : branches of the two curves, the moving one at this position
    curve : the path of ``point``, a point of the link
    """
    sheet, letters = page.sheet, page.letters
    back = background(bare_mechanism(sheet, letters))
    mechanism = ink_box(back.drawn) or Box(-20.0, -20.0, 20.0, 20.0)
    around = mechanism.grown(CURVES_AROUND * max(mechanism.width, mechanism.height))
    centre = centres.of(link, sheet.scene.frame.name)
    here = None if centre.point is None else on_page(centre.point)
    if here is not None and mechanism.distance(here) <= REACH * max(mechanism.width, mechanism.height):
        around = around.joined(Box.around((here,)).grown(ROOM))  # where the two touch
    colour = colour_of_link(sheet.scene, link)
    kinds: Sequence[tuple[str, str, Stroke, Sequence[Branch], Mapping[str, str]]] = (
        ("fixed centrode", "centrode-fixed", FIXED, fixed, {}),
        ("moving centrode", "centrode-moving", MOVING.coloured(colour), moving, {}),
        ("coupler curve", "coupler-curve", COUPLER.coloured(colour), curve, {"point": point}),
    )
    drawn = {id: _clipped(branches, stroke, around) for _, id, stroke, branches, _ in kinds}
    content = mechanism
    for lines in drawn.values():
        content = content.joined(ink_box(lines) or content)
    groups = tuple(Group(lines, id=id, classes=("centrode",)) for id, lines in drawn.items() if lines)
    names: tuple[Label, ...] = ()
    if here is not None and content.distance(here) == 0.0:
        names = (Label.of(rich(letters.centre(centre.pair)), here, classes=("centre",)),)
        mark = Group(mark_of(centre, sheet.scene.frame.name, here), id=id_of(centre.pair))
        groups = (*groups, mark)
    page = page.wide_enough(content.width + 2 * ROOM)
    whole = joined((back, Piece({"centres": groups}, names)))
    figure = centred(content, page.width, content.height + 2 * ROOM, lambda around: whole)
    legend = [(page.said(key, **gaps), stroke) for key, _, stroke, branches, gaps in kinds if branches]
    keys = [
        row(Block(Piece({"labels": (Line(2.2j, KEY - 3.0 + 2.2j, stroke),)}), 0.0, KEY),
            prose(said, page.width - KEY, 3.0, classes=("legend",))) for said, stroke in legend
    ]
    first = languages(page.language)[0]
    end = word("full stop", first) + word("between sentences", first)
    return page.drawing(
        page.at_drivers(f"{page.term('centrodes')} {link}"),
        column(figure, *keys), page.scale("mechanism"), title="centrodes",
        said="".join(str(said[0]) + end for said, _ in legend).strip(),
    )


def _clipped(branches: Sequence[Branch], stroke: Stroke, box: Box) -> tuple[Primitive, ...]:
    """The parts of curves inside a box, each as one polyline; where a pen would go back over its line it is lifted, for
    dashes over dashes would be a solid line."""
    import shapely  # a centrode is cut at the panel's edge; few figures need it

    def inside(curves: Iterable[Places]) -> list[shapely.LineString]:
        lines = [shapely.linestrings(z.real, z.imag) for z in curves if len(z) > 1]
        return [*shapely.get_parts(shapely.clip_by_rect(lines, box.left, box.top, box.right, box.bottom))]

    whole = [np.conj(np.array(branch)) for branch in branches]
    pieces = inside(piece for places in whole for piece in _one_way(places))
    drawn, again = shapely.Polygon(), set[int]()
    for k, piece in sorted(enumerate(pieces), key=lambda numbered: -numbered[1].length):
        if drawn.covers(piece):
            again.add(k)
        else:
            drawn = drawn.union(piece.buffer(RETRACED))
    parts = [piece for k, piece in enumerate(pieces) if k not in again] if again else inside(whole)
    return tuple(Polyline(tuple(complex(x, y) for x, y in part.coords), stroke) for part in parts)


def _one_way(places: Places) -> list[Places]:
    """A curve in pieces on which its pen does not turn back."""
    steps = np.diff(places)
    back = np.flatnonzero((steps[1:] * steps[:-1].conj()).real < 0.0) + 1
    return [places[low : high + 1] for low, high in pairwise([0, *back.tolist(), len(places) - 1])]
