# %% [markdown]
# # Where there is a Coriolis term, and where there is none
#
# A point that slides on a guide that turns has a part 2 ω v, square to the guide. It is none where the guide does not
# turn, for ever (a guide of the frame, a yoke that is only shifted) or at this moment (a dead position of the guide
# bar), and where nothing slides (crank and guide bar in one line). Eight layouts, each in four stages: the mechanism,
# the velocities, what is known of the accelerations, what is found of them.

# %%
import math

from graphkin.account.notation import notation_of
from graphkin.construction import Room, draft
from graphkin.drawing import Box, Drawing, Group, Polygon, Text
from graphkin.drawing.ink.strokes import DIMENSION
from graphkin.drawing.parts.insets import coriolis_terms
from graphkin.drawing.parts.mechanism import bare_mechanism
from graphkin.drawing.parts.polygon import PolygonOnPage, extent, polygon_piece
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.stepwise import so_far, stepped
from graphkin.drawing.text import plain, rich
from graphkin.scene import mechanism_of


def scene(points, links, driver, guides=None, sketch=None):
    frame = {"name": "4", "points": points, "guides": guides or {}}
    file = {"units": {"length": "mm"}, "frame": frame, "links": links, "driver": driver}
    return file | ({"sketch": sketch} if sketch else {})


CRANK = {"points": ["A", "B"], "length": 20}
GUIDE_BAR = {"1": CRANK, "2": {"points": ["B"], "on": "3"}, "3": {"points": ["C"]}}
PIVOTS = {"A": [0, 0], "C": [0, -40]}

LAYOUTS = {
    "Swinging guide bar: the block slides on a bar that turns": scene(
        PIVOTS, GUIDE_BAR, {"link": "1", "angle": 30, "omega": 1}
    ),
    "The same in a dead position: the bar stands still for a moment": scene(
        PIVOTS, GUIDE_BAR, {"link": "1", "angle": -30, "omega": 1}
    ),
    "The same with crank and bar in one line: nothing slides": scene(
        PIVOTS, GUIDE_BAR, {"link": "1", "angle": 90, "omega": 1}
    ),
    "Rotating guide bar that drives": scene(
        {"A": [0, 0], "C": [10, 0]},
        {"1": {"points": ["A"]}, "2": {"points": ["B"], "on": "1"}, "3": {"points": ["C", "B"], "length": 25}},
        {"link": "1", "angle": 60, "omega": 1},
    ),
    "Swinging block: the rod is the guide": scene(
        {"A": [0, 0], "C": [45, 0]},
        {"1": CRANK, "2": {"points": ["B", "D"], "length": 65}, "3": {"points": ["C"], "on": "2"}},
        {"link": "1", "angle": 70, "omega": 1},
    ),
    "Cylinder: the rod is pushed out of a barrel that turns": scene(
        {"A": [0, 0], "C": [50, -20]},
        {"1": {"points": ["A", "B"], "length": 40}, "2": {"points": ["C"]}, "3": {"points": ["B"], "on": "2"}},
        {"slide": "3", "travel": 50, "velocity": 20},
        sketch={"B": [15, 37]},
    ),
    "Scotch yoke: the guide is only shifted": scene(
        {"A": [0, 0]},
        {"1": CRANK, "2": {"points": ["B"], "on": "3.s"},
         "3": {"on": "4.x", "guides": {"s": {"through": [0, 0], "angle": 90}}}},
        {"link": "1", "angle": 50, "omega": 1}, guides={"x": {"through": [0, 0], "angle": 0}},
    ),
    "Slider-crank: the guide is fixed": scene(
        {"A": [0, 0]},
        {"1": CRANK, "2": {"points": ["B", "C"], "length": 45}, "3": {"points": ["C"], "on": "4.h"}},
        {"link": "1", "angle": 50, "omega": 1}, guides={"h": {"through": [0, -8], "angle": 0}},
    ),
}

IN_CHINESE = (
    "摆动导杆：滑块在转动的导杆上滑动", "导杆处于极限位置：此瞬时导杆不转动", "曲柄与导杆共线：此瞬时无相对滑动",
    "转动导杆为原动件", "摇块机构：连杆即导路", "摆动油缸：活塞杆自转动的缸体推出", "正弦机构：导路只作平动",
    "曲柄滑块机构：导路固定",
)

# %% [markdown]
# A row for each, four cells in it.

# %%
WIDE, HIGH, HEAD, LEFT, TOP = 69.25, 48.5, 5.0, 10.0, 19.5
ROOM = Room((40.0, 26.0), (46.0, 27.0))


def framed(piece: Piece, corner: complex, content: Box) -> Piece:
    """A piece with its names in a cell."""
    cell = Box(corner.real, corner.imag, corner.real + WIDE - 1.5, corner.imag + HIGH - HEAD - 2.5)
    placed = with_labels(moved_piece(piece, cell.centre - content.centre), cell.grown(-0.6))
    return joined((Piece({"construction": (Polygon(cell.corners, "", DIMENSION),)}), placed))


def around(content: Box) -> Box:
    """What a cell shows around a polygon, about its pole."""
    half = complex(WIDE / 2 - 1.5, (HIGH - HEAD) / 2 - 2.0)
    return Box.around((content.centre - half, content.centre + half))


def plainly(things):
    """Without the bands around what is new."""
    kept = [t for t in things if not (isinstance(t, Group) and "new" in t.classes)]
    return tuple(t._replace(children=plainly(t.children)) if isinstance(t, Group) else t for t in kept)


def row(sheet, title, y, language):
    """Four stages of a layout, and whether it has the term."""
    letters = notation_of(sheet, "chinese")
    terms = [t for t in coriolis_terms(sheet) if abs(t[0].span) > 0.02]
    said = NONE[language]
    if terms:
        vector, _, rule = terms[0]
        said = letters.vector(vector.symbol) + " = " + letters.size(rule)
    back = bare_mechanism(sheet, letters)
    pieces = [framed(back, complex(LEFT, y + HEAD), ink_box(back.drawn))]
    laid_off = [s for s in sheet.steps if s.verb == "lay off" or s.reason == "before its turn"]
    known = max(s.number for s in laid_off if s.diagram == "acceleration")
    stages = (("velocity", 0, math.inf), ("acceleration", 0, known), ("acceleration", known + 1, math.inf))
    for column, (diagram, first, last) in enumerate(stages, 1):
        content = extent(sheet, diagram)
        polygon = polygon_piece(PolygonOnPage(sheet, diagram, letters, language, around(content), 0j))
        cell = framed(polygon, complex(LEFT + column * WIDE, y + HEAD), content)
        drawn = so_far(stepped(layer_groups(cell)), first, last)
        pieces.append(Piece({"stages": drawn if first else plainly(drawn)}))
    head = Text(complex(LEFT, y + 3.4), rich(f"{title}{COLON[language]}" + said, 3.4))
    return [*(thing for piece in pieces for thing in layer_groups(piece) or piece.drawn), head], bool(terms)


COLON = {"en": ":  ", "zh": "："}
NONE = {"en": "no Coriolis term", "zh": "无哥氏加速度"}
HEADS = {"en": "Where there is a Coriolis term", "zh": "哥氏加速度的有无"}
STAGES = {
    "en": ("mechanism", "velocities", "known of the accelerations", "found of them"),
    "zh": ("机构运动简图", "速度多边形", "加速度多边形：已知部分", "加速度多边形：求得部分"),
}


def page(language):
    """All layouts on a page, and which of them have the term."""
    head = Text(complex(LEFT, 12.5), plain(HEADS[language], 4.6, bold=True))
    stages = [Text(complex(LEFT + k * WIDE, 17.0), plain(words, 2.6)) for k, words in enumerate(STAGES[language])]
    children, found = [head, *stages], {}
    for number, ((title, file), chinese) in enumerate(zip(LAYOUTS.items(), IN_CHINESE, strict=True)):
        sheet = draft(mechanism_of(file), room=ROOM)
        shown = f"{number + 1}  {title if language == 'en' else chinese}"
        things, found[title] = row(sheet, shown, TOP + number * (HIGH + 1.0), language)
        children += things
    return children, found


children, with_term = page("en")

# %%
print(f"{sum(with_term.values())} of {len(with_term)} have the term")

# %%
picture = Drawing(297.0, 420.0, tuple(children), "Where there is a Coriolis term, and where there is none")

# %% [markdown]
# The same in Chinese.

# %%
picture_zh = Drawing(297.0, 420.0, tuple(page("zh")[0]), "哥氏加速度的有无", lang="zh")
