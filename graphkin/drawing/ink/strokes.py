"""The kinds of lines, after ISO 128, and the colours of links.

Width and dash distinguish the kinds, so that black on white is enough; colour is added: one for each link, the same in
the mechanism and in every diagram, where a vector has the colour of the link whose motion it shows.
"""

from __future__ import annotations

from collections.abc import Iterable
from functools import lru_cache

from graphkin.account.voice import link_of_vector
from graphkin.construction.board.sheet import Sheet
from graphkin.drawing.ink.primitives import Circle, Group, Polygon, Primitive, Scan, Stroke, Text, map_tree
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol

BLACK, WHITE, GREY = "#000000", "#ffffff", "#595959"
LINK = Stroke(0.5)
REDUNDANT = Stroke(0.5, (3.0, 1.2))  # a link that only repeats what others hold
RESULTANT = Stroke(0.5)
RELATIVE = Stroke(0.35)
OUTLINE = Stroke(0.35)  # blocks, turning pairs, panels that carry weight
FRAME = Stroke(0.5)
DIRECTION = Stroke(0.18, (2.4, 0.9))
CONSTRUCTION = Stroke(0.18)
TRIALS = (Stroke(0.18, (4.0, 0.8, 0.6, 0.8)), Stroke(0.25, (0.6, 0.9)), Stroke(0.18, (4.0, 0.8, 0.6, 0.8, 0.6, 0.8)))
TRIAL_CURVE = Stroke(0.25)
PITCH = Stroke(0.25, (4.0, 0.8, 0.6, 0.8))  # circles and curves that roll, or on which a roller's centre runs
AXIS = Stroke(0.18, (4.0, 0.8, 0.6, 0.8))
LIMIT = Stroke(0.35, (3.0, 1.2))  # a link in a limit position
OF_CENTRES = Stroke(0.13, (), "#7a7a7a")  # lines on which centres lie
HATCHING = Stroke(0.18)
DIMENSION = Stroke(0.18)
LEADER = Stroke(0.18)
READ = Stroke(0.3, (1.6, 0.8), "#c2006b")  # lines read off a scan
READ_OFF = Stroke(0.8, (1.6, 0.8), "#c2006b")  # a wrong one of them
# Of the circle diagram: sides of permanent centres, of found ones, of those found otherwise.
PERMANENT, FOUND, OTHERWISE = Stroke(0.5), Stroke(0.25), Stroke(0.35, (2.4, 0.9))
HALO = Stroke(2.0, (), "#ffe08a")  # around what is new: pale enough to print as a light grey

# Okabe and Ito, Color Universal Design (2008), darkened to a contrast of at least 4.5 to 1 on white paper so that
# lines and letters in them survive a black-and-white printer; the order keeps neighbours apart for every kind of sight.
LINK_COLOURS = ("#0067a6", "#b34700", "#007a5a", "#a0467c", "#7a6200", "#1f7f93", "#5a4fa2", "#8a3b3b")


def link_colour(index: int) -> str:
    """Colour of the moving link at an index of the scene's order; colours repeat after eight links."""
    return LINK_COLOURS[index % len(LINK_COLOURS)]


# White along the middle of a link's lines, so that links are told apart without colour too: none, hollow throughout, in
# long dashes, in short ones, in long ones and dots, with dots alone, dashes and two dots, wide apart.
_TEXTURES = (
    None, Stroke(0.2, (1000.0, 1.0)), Stroke(0.2, (2.6, 1.6)), Stroke(0.2, (0.8, 0.8)),
    Stroke(0.2, (5.0, 1.2, 0.8, 1.2)), Stroke(0.2, (0.8, 3.0)), Stroke(0.2, (2.6, 0.8, 0.8, 0.8, 0.8, 0.8)),
    Stroke(0.2, (5.0, 5.0)),
)


def texture(index: int) -> Stroke | None:
    """The white texture along the lines of the moving link at an index of the scene's order; None for none."""
    stroke = _TEXTURES[index % len(_TEXTURES)]
    return None if stroke is None else stroke.coloured(WHITE)


@lru_cache(maxsize=256)
def tint(colour: str, strength: float = 0.14) -> str:
    """A colour thinned with white (0: white, 1: the colour), for the area of a rigid link."""
    parts = (int(colour[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(255 - (255 - part) * strength):02x}" for part in parts)


def pale(children: Iterable[Primitive], strength: float = 0.45, words: float = 1.0) -> tuple[Primitive, ...]:
    """The primitives in colours thinned to a strength, texts to the strength ``words``."""

    def thinned(part: Primitive) -> Primitive:
        if isinstance(part, Group | Scan):
            return part
        if isinstance(part, Text):
            return part if words == 1.0 else part._replace(colour=tint(part.colour, words))
        if isinstance(part, Polygon | Circle):
            stroke = part.stroke and part.stroke.coloured(tint(part.stroke.colour, strength))
            return part._replace(fill=part.fill and tint(part.fill, strength), stroke=stroke)
        return part._replace(stroke=part.stroke.coloured(tint(part.stroke.colour, strength)))

    return map_tree(children, thinned)


def colour_of_link(scene: Mechanism, link: str) -> str:
    """Colour of a link; the frame is black."""
    name = link.split("/")[-1]
    pair = scene.replaced_by.get(name)
    if name not in scene.order and pair is not None:  # what stands for a contact has the colour of what is moved
        name = next((n for n in reversed(pair.bodies) if n != scene.frame.name), pair.bodies[1])
    return BLACK if name == scene.frame.name else link_colour(scene.order[name])


def colour_of_vector(sheet: Sheet, symbol: Symbol) -> str:
    return colour_of_link(sheet.scene, link_of_vector(sheet, symbol))
