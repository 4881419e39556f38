"""Names in their places on a piece.

In a crowd, where a name has room only with its leader across vectors, its key stands there, the number of the vector's
step, and the name follows the key in a free place of the panel.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import replace
from itertools import accumulate, zip_longest

from graphkin.drawing.box import Box
from graphkin.drawing.ink.primitives import Line, Primitive, Text
from graphkin.drawing.place.labels import Label, Mark
from graphkin.drawing.place.obstacles import CLEAR, Obstacles, free_boxes
from graphkin.drawing.place.piece import Piece, obstacles_of
from graphkin.drawing.place.placement import Placed, Placement
from graphkin.drawing.text import behind, rich, text_box
from graphkin.plane import added_up
from graphkin.words.symbols import Words

POLYGONS = ("velocity", "acceleration", "forces")  # layers of vectors
BEHIND = 1.0  # mm between a key and the name behind it
APART = 3.0, 1.0  # mm between columns and between lines of the list
AID = 3  # the rank of what leads on only


def with_labels(piece: Piece, panel: Box) -> Piece:
    """The piece with its labels in their places, in the layer "labels"; some without a place are given up.

    No label leaves the panel.
    """
    return with_crowd(piece, panel)[0]


def with_crowd(piece: Piece, panel: Box, fences: Sequence[Box] = ()) -> tuple[Piece, tuple[Label, ...]]:
    """The piece as of `with_labels`, and the labels with faults; no label enters a fence."""
    count = len(piece.labels)
    most = 5 if count < 45 else 4 if count < 60 else 2  # from this rank on they would be too many to be read
    labels = [label for label in piece.labels if label.rank < most]
    obstacles = Obstacles(areas=tuple(fences), writing=tuple(fences))
    for layer, drawn in piece.layers.items():
        added = obstacles_of(drawn)
        obstacles += replace(added, vectors=added.thick) if layer in POLYGONS else added
    written, crowded = named(labels, panel, obstacles, piece.marks)
    layers = {**piece.layers, "labels": (*piece.layers.get("labels", ()), *written)}
    return Piece(layers, (), piece.marks), crowded


def without(piece: Piece, ids: Collection[str]) -> Piece:
    """A piece without some of its written labels and their leaders."""
    written = piece.layers["labels"]
    kept = tuple(
        part for part, after in zip_longest(written, written[1:])
        if not any(isinstance(text, Text) and text.id in ids for text in (part, isinstance(part, Line) and after))
    )
    return replace(piece, layers={**piece.layers, "labels": kept}) if len(kept) < len(written) else piece


def named(
    labels: Sequence[Label], panel: Box, obstacles: Obstacles, marks: Sequence[Mark]
) -> tuple[tuple[Primitive, ...], tuple[Label, ...]]:
    """Labels in their places with their leaders, parameters as for `Placement`; those of a crowd listed by their
    keys; and the labels with remaining faults."""
    placement = Placement(labels, panel, obstacles, marks)
    placed, crowded = placement.placed, placement.crowded
    listed: tuple[Text, ...] = ()
    if crowded:
        keyed = _listed(placement, panel, obstacles)
        if keyed is None and any(label.key and label.rank == AID for label in labels):
            # there is no room for all: auxiliary vectors go without
            some = [replace(label, key=None) if label.rank == AID else label for label in labels]
            keyed = _listed(Placement(some, panel, obstacles, marks), panel, obstacles)
        if keyed and len(keyed[2]) < len(crowded):
            placed, listed, crowded = keyed
    written = (part for place in placed for part in (place.leader, place.text) if part is not None)
    return (*written, *listed), tuple(labels[i] for i in crowded)


def _listed(
    placement: Placement, panel: Box, obstacles: Obstacles
) -> tuple[tuple[Placed, ...], tuple[Text, ...], list[int]] | None:
    """Labels in a crowd with keys for some, the list of these, and the labels with remaining faults; None where the
    list has no room."""
    placement.shorten()
    placed = placement.placed
    keyed, told = {name.text.id for name in placed if name.keyed}, {placement.labels[i].text.id for i in placement.told}
    entries = [
        _entry(label.text, label.key, label.between if label.text.id in told else "")
        for label in placement.labels if label.text.id in keyed | told
    ]
    boxes = tuple(name.box for name in placed)
    leaders = tuple((name.leader.start, name.leader.end) for name in placed if name.leader is not None)
    names = _list(entries, panel, obstacles + Obstacles(solid=leaders, areas=boxes, writing=boxes))
    return (placed, names, placement.crowded) if names or not entries else None


def _entry(name: Text, key: Text | None, between: Words) -> Text:
    """A key with its name, and the letters of its ends if neither stands at its vector; only the name without a key, or
    if the name begins with it."""
    runs = name.runs
    if key is not None and not name.string.startswith(key.string.rstrip("… ")):
        runs = behind(key.runs, name.runs, BEHIND)
    if between:
        runs = behind(runs, rich(": " + between))
    return Text(0j, runs, "start", name.colour, f"listed-{name.id}", (*name.classes, "listed"), since=name.since)


def _list(entries: Sequence[Text], panel: Box, around: Obstacles) -> tuple[Text, ...]:
    """The entries in columns in a free place of the panel, or in order in several if none holds all of them; empty
    where there is no room."""
    for lines in range(len(entries), 0, -1):
        columns = _in_columns(entries, lines, panel, around, CLEAR)
        if columns:
            return columns
    for count in range(len(entries) - 1, 0, -1):
        first = _in_columns(entries[:count], count, panel, around, APART[1])
        if first:
            boxes = tuple(text_box(entry) for entry in first)
            rest = _list(entries[count:], panel, around + Obstacles(areas=boxes))
            return first + rest if rest else ()
    return ()


def _in_columns(
    entries: Sequence[Text], lines: int, panel: Box, around: Obstacles, clear: float
) -> tuple[Text, ...]:
    """Entries in columns of at most ``lines`` lines in one free place; empty without such a place."""
    boxes = [text_box(entry) for entry in entries]
    columns = [range(k, min(k + lines, len(entries))) for k in range(0, len(entries), lines)]
    widths = [max(boxes[i].right for i in column) for column in columns]
    heights = [max(boxes[i].height for i in range(k, len(entries), lines)) for k in range(lines)]
    lefts = accumulate((width + APART[0] for width in widths[:-1]), initial=0.0)
    tops = list(accumulate((height + APART[1] for height in heights), initial=0.0))
    size = added_up(widths) + APART[0] * (len(widths) - 1), tops[-1] - APART[1]
    return tuple(
        entries[i]._replace(at=complex(room.left + left, room.top + tops[k] - boxes[i].top))
        for room in free_boxes(1, size, panel, around, clear)
        for left, column in zip(lefts, columns, strict=True) for k, i in enumerate(column)
    )
