"""The figure of the velocity plan: each train on its line of centres, beside it a line of velocities for each link, and
the rate scale, on which parallels through a pole give the angular rates."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from itertools import pairwise
from typing import TypeAlias

from graphkin.account.headings import number
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import Bar, Step
from graphkin.construction.trains import CentreLine, TrainPlan
from graphkin.drawing.boxes import GAP, Block, FigurePage, column, panel, row, table
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, on_page
from graphkin.drawing.ink.symbols import COMPONENT, arrow, hatched_line
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece
from graphkin.drawing.plate import Plate
from graphkin.drawing.text import plain, rich
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import PlacedGear
from graphkin.scene.symbol import KINDS
from graphkin.scene.tables import Units
from graphkin.words import Phrase, languages, word
from graphkin.words.symbols import RichText, Words, rate, sign, spaced
from graphkin.words.written import amount, on_paper, printed, product

ROOM = 9.0  # mm above and below a line of centres
SCHEME = 68.0  # mm that the train seen from the side may take
PLAN = 78.0  # mm from the left margin to where velocities may begin
TABLE = 62.0  # mm
PLAN_WORDS = {"velocity": "plan", "acceleration": "plan accelerations"}
"""The name of the plan of each order."""
SHORT = 0.3


def train_figure(page: FigurePage) -> Drawing | None:
    """A page for each plan; None without moving trains."""
    pages = [*train_pages(page).values()]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


def train_pages(page: FigurePage) -> dict[int, Drawing]:
    """The pages of the plans with motion, by the numbers of these."""
    pages: dict[int, Drawing] = {}
    reasons = ("plan", "given on plan")
    for count, plan in enumerate(page.sheet.trains, 1):
        if any((*plan.velocities.values(), *(line.value for line in plan.lines.values()))):
            lines = (key for key in plan.lines if key[1] in page.sheet.scene.by_name)
            drawn = (step for step in page.sheet.steps if step.plan == count)
            steps = (step.number for step in drawn if step.reason in reasons)
            pages[count] = _page(page, plan, dict(zip(lines, steps, strict=True)))
    return pages


Steps: TypeAlias = Mapping[tuple[int, str], int]
"""The number of the step that draws the line of a link, by line of centres and link."""


def _page(page: FigurePage, plan: TrainPlan, steps: Steps) -> Drawing:
    sheet, velocity, name = page.sheet, plan.order == "velocity", PLAN_WORDS[plan.order]
    why = [Phrase("plan reason" if velocity else "plan reason accelerations", pole=_pole(plan))]
    why += [Phrase("plan relative", point=line.still) for line in plan.on if not line.in_frame]
    rates, read = _rate_scale(sheet, plan, steps), _table(page, plan)
    least = min(0.0, *map(foot, plan.lines.values()))
    scale = panel(page.width - TABLE - 4.0, plan.pole + 16.0, lambda room: with_labels(
        moved_piece(rates, complex(PLAN + 4.0 - least - TABLE - 4.0, 7.0)), room))
    lines = [_train(page, plan, k, steps) for k in range(len(plan.on))]
    last = max(steps.values())  # until then the table tells what is to be found
    layers = {layer: (Group(things, step=last),) for layer, things in read.piece.layers.items()}
    body = column(page.prose(why), *lines, row(replace(read, piece=Piece(layers)), scale, gap=4.0), gap=GAP)
    size, speed = plan.length / sheet.scene.units.metres, plan.speed / sheet.scene.units.rates.metres
    scales = {"length": size, plan.order: speed, plan.rate: plan.turning}
    unit = _unit(plan)
    angular: Words = sign("μ", rate(plan.rate, "")) + f" = {number(plan.turning)} ({unit})/mm"
    if page.convention in ("us", "british"):
        times, head = (1, "1 mm") if page.convention == "us" else (10, "1 cm")
        angular = f"{head} = {number(times * plan.turning)} {unit}"
    written_scales = page.scale("mechanism", plan.length), page.scale(plan.order, plan.speed), angular
    return page.drawing(
        page.at_drivers(page.term(name)), body, spaced(",  ", written_scales), title=name,
        said=page.said("plan described")[0],
        metadata={"scales": {key: float(f"{value:.12g}") for key, value in scales.items()}},
    )


def _unit(plan: TrainPlan) -> str:
    """The unit of the rates of a plan."""
    return Units().of(KINDS[plan.rate].measure).written


def _train(page: FigurePage, plan: TrainPlan, k: int, steps: Steps) -> Block:
    """A line of centres: the train seen from the side, and the velocities of its points."""
    line, mm = plan.on[k], 1.0 / plan.length
    heights = [spot.height * mm for spot in line.spots]
    seen = scheme(page.sheet.scene, line, mm, SCHEME)
    # the zero line stands where the slowest place still clears the train
    reach = [z.real for _, bar in _bars(plan, k) for z in (bar.a, bar.b)]
    x = PLAN - min(0.0, *reach) if reach else PLAN
    ink = ink_box(seen.drawn)
    velocities = _velocities(page, plan, k, steps, (ink.right if ink else 0.0) - x)
    whole = joined((seen, moved_piece(velocities, complex(x, 0.0))))
    lowered = moved_piece(whole, complex(0.0, ROOM + max(heights)))
    return page.panel(max(heights) - min(heights) + 2 * ROOM, lambda room: with_labels(lowered, room.grown(2.0)))


def _velocities(page: FigurePage, plan: TrainPlan, k: int, steps: Steps, start: float) -> Piece:
    """The plan over one line of centres, its zero line at x = 0, heights from 0; the heights are carried over from
    ``start``."""
    plate, scene, mm = Plate(), page.sheet.scene, 1.0 / plan.length
    tag = f"-{k + 1}" if k else ""
    heights = {s.name: s.height * mm for s in plan.on[k].spots}
    low, high = min(heights.values()), max(heights.values())
    plate.line("construction", complex(0.0, low - 4.0), complex(0.0, high + 4.0), strokes.OUTLINE)
    names: dict[float, dict[str, RichText]] = {}
    first: dict[str, int] = {}  # step by which a velocity is known
    for (on, link), step in steps.items():
        for spot in plan.on[k].spots_of(link) if on == k else ():
            first.setdefault(spot.name, step)
    for spot in plan.on[k].spots:
        x, h = plan.velocities.get((k, spot.name)), heights[spot.name]
        if x is None:
            continue
        foot, tip = complex(0.0, h), complex(x, h)
        plate.line("construction", complex(start, h), complex(max(0.0, x), h), strokes.OF_CENTRES)
        if abs(x) > SHORT:
            shapes = arrow(on_page(foot), on_page(tip), COMPONENT)
            plate.put(plan.order, *shapes, id=f"plan-{spot.name}{tag}", classes=("speed",), step=first.get(spot.name))
        plate.put("construction", Circle(on_page(tip), 0.5, strokes.BLACK), step=first.get(spot.name))
        letters = sign(spot.name) if spot.rolls else page.letters.point(spot.name)
        names.setdefault(round(h, 3), {})[spot.name] = letters
    for h, some in names.items():
        words = rich(spaced(", ", dict.fromkeys(some.values())), 3.0)
        plate.name(words, complex(0.0, h), f"label-plan-{'-'.join(some)}{tag}", rank=1)
    for link, bar in _bars(plan, k):
        if link in scene.by_name:
            colour, a, b = strokes.colour_of_link(scene, link), bar.a, bar.b
            over = 3.0 * (b - a) / abs(b - a)
            line = Line.between(a - over, b + over, strokes.LINK.coloured(colour))
            step = steps[k, link]
            plate.put(plan.order, line, id=f"plan-line-{link}{tag}", classes=("plan-line",), step=step)
            plate.name(rich(link, 3.2, bold=True), (a, b), f"label-plan-line-{link}{tag}", colour=colour, step=step)
    return plate.piece


def _bars(plan: TrainPlan, k: int) -> Iterator[tuple[str, Bar]]:
    """The lines over a line of centres, by their links."""
    for (on, link), step in plan.lines.items():
        yield from ((link, bar) for bar in step.each(Bar) if on == k)


def foot(line: Step) -> float:
    """The place where the parallel to a link's line cuts the rate scale (mm), counter-clockwise to the right."""
    return math.copysign(line.mm, line.value)


def _pole(plan: TrainPlan) -> str:
    """The letter of the pole: P, where no place of the plan has it."""
    taken = {spot.name for line in plan.on for spot in line.spots}
    return "H" if "P" in taken else "P"


def _rate_scale(sheet: Sheet, plan: TrainPlan, steps: Steps) -> Piece:
    """Parallels to the lines through the pole, which stands at 0, down to the scale."""
    plate, deep = Plate(), -1j * plan.pole
    shown = _plan_lines(sheet, plan)
    feet = [0.0, *map(foot, shown)]
    plate.line("construction", min(feet) - 4.0 + deep, max(feet) + 4.0 + deep, strokes.OUTLINE)
    plate.line("construction", 0j, deep, strokes.DIRECTION)
    plate.circle("construction", 0j, 0.9, strokes.WHITE, strokes.OUTLINE)
    plate.name(rich(sign(_pole(plan)), 3.2), 0j, toward=(1.57,))
    marked: dict[float, list[str]] = {}
    read_in = {line.link: steps[key] for key, line in plan.lines.items() if line in shown}
    for line in shown:
        at, colour = foot(line) + deep, strokes.colour_of_link(sheet.scene, line.link)
        ray = Line(0j, on_page(at), strokes.RELATIVE.coloured(colour))
        plate.put(plan.order, ray, id=f"plan-rate-{line.link}", classes=("plan-rate",), step=read_in[line.link])
        tick = Line.between(at + 1.2j, at - 1.2j, strokes.OUTLINE)
        plate.put("construction", tick, step=read_in[line.link])
        marked.setdefault(round(foot(line), 2), []).append(line.link)
    for x, links in marked.items():
        names = rich(spaced(", ", (rate(plan.rate, link) for link in links)), 3.0)
        plate.name(names, x + deep - 1.2j, f"label-plan-rate-{'-'.join(links)}", toward=(-1.57,),
                   step=max(read_in[link] for link in links))
    return plate.piece


def _plan_lines(sheet: Sheet, plan: TrainPlan) -> list[Step]:
    """The line of each link of the scene from which its rate is read."""
    links = dict.fromkeys(link for _, link in plan.lines if link in sheet.scene.by_name)
    lines = (plan.line(link) for link in links if link != sheet.scene.frame.name)
    return [line for line in lines if line is not None]


def _table(page: FigurePage, plan: TrainPlan) -> Block:
    """The readings of the rate scale: mm, and the rate."""
    along, rows = page.sheet.scene.units.of(plan.order), []
    tried = {symbol.link for symbol, _ in plan.trial.rates} if plan.trial else ()
    for line in _plan_lines(page.sheet, plan):
        read = on_paper(line.mm)
        size = printed(product(read, amount(plan.turning, 12)))
        turning = f"−{size}" if line.value < 0.0 and size != "0" else size
        if line.reason == "given on plan" and line.link not in tried:
            turning = f"{number(line.value, 5)} {page.term('plan given')}"
        rows.append((line.link, read, turning))
    rows += [(key, on_paper(step.mm), along.beside(number(step.value / along.si, 5)))
             for key, step in plan.travels.items()]
    rates = rate(plan.rate, "") + f", {_unit(plan)}"
    heads: list[list[Words]] = [[word("plan link", each), "mm", rates] for each in languages(page.language)]
    return table(heads, rows, (0.2 * TABLE, 0.25 * TABLE, 0.55 * TABLE))


# a train seen from the side

TOOTH, RIM, APART = 5.0, 6.0, 0.45
STEP = 13.0  # mm from one plane to the next, less where there are many


def _planes(line: CentreLine) -> tuple[Mapping[str, int], Mapping[str, int], int]:
    """The plane of each pair, of the carriers and of the legs of rings, and the number of planes."""
    of: dict[str, int] = {}
    rims: dict[tuple[str, str, float], int] = {}
    for mesh in line.meshes:
        pitch = line.spot(mesh.name).height
        rims_here = [(wheel, axis, round(abs(pitch - line.spot(axis).height), 12))
               for wheel, axis in zip(mesh.bodies, mesh.axes, strict=True) if axis]
        of[mesh.name] = next((rims[rim] for rim in rims_here if rim in rims), len(set(of.values())))
        rims.update(dict.fromkeys(rims_here, of[mesh.name]))
    first = len(set(of.values()))
    upright = [name for mesh in line.meshes for name in (
        *(wheel for wheel, part in zip(mesh.bodies, mesh.teeth, strict=True) if _ring(mesh, part)), mesh.carrier)]
    behind = {name: first + k for k, name in enumerate(dict.fromkeys(upright))}
    return of, behind, first + len(behind)


def _ring(mesh: PlacedGear, part: float | None) -> bool:
    """Whether a wheel has its teeth inside; a wheel on a rack has them outside."""
    return part is not None and part < 0 and all(mesh.axes)


def scheme(scene: Mechanism, line: CentreLine, mm: float, width: float) -> Piece:
    """The train within ``width`` mm from the left edge at 0, heights up the page from 0 at ``mm`` for one m."""
    (planes, behind, count), ground = _planes(line), scene.frame.name
    step = min(STEP, width / (count + 0.5))
    heights = {s.name: s.height * mm for s in line.spots}
    plate = Plate()
    shapes: dict[str, list[Primitive]] = {}
    on_axis: dict[tuple[str, str], set[int]] = {}

    def at(plane: int, height: float) -> complex:
        return complex((plane + 0.5) * step, height)

    def draw(link: str, *places: complex) -> None:
        stroke = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
        shapes.setdefault(link, []).extend(Line.between(a, b, stroke) for a, b in pairwise(places))

    def bar(link: str, plane: int, low: float, high: float) -> None:
        ends, id = (at(plane, low), at(plane, high)), f"label-plan-wheel-{link}"
        draw(link, *ends)
        if link in scene.by_name and all(label.text.id != id for label in plate.labels):
            plate.name(plain(link, 3.2, bold=True), ends, id, colour=strokes.colour_of_link(scene, link))

    def fixed(link: str, z: complex, away: float) -> None:
        """The frame at a place: above it (1), below it (-1), or a bearing to its right (0)."""
        half = complex(2.6, 0.0) if away else 2.6j
        ends = (z + half, z - half) if away < 0 else (z - half, z + half)
        shapes.setdefault(link, []).extend(hatched_line(on_page(ends[0]), on_page(ends[1])))

    for mesh in line.meshes:
        plane, pitch = planes[mesh.name], heights[mesh.name]
        for wheel, axis, part in zip(mesh.bodies, mesh.axes, mesh.teeth, strict=True):
            centre = heights[axis or mesh.axes[0]]
            away = 1.0 if pitch > centre else -1.0
            inward = away * (APART if not _ring(mesh, part) else -APART) if axis else 0.0
            tooth, half = at(plane, pitch - inward), TOOTH / 2 if axis else 0.7 * TOOTH
            draw(wheel, tooth - half, tooth + half)
            if axis and not _ring(mesh, part):
                bar(wheel, plane, centre, pitch - inward)
                on_axis.setdefault((wheel, axis), set()).add(plane)
                held, side = at(plane, centre), -away
            else:
                bar(wheel, plane, pitch - inward, pitch + away * RIM)
                held, side = at(plane, pitch + away * RIM), away
            if wheel == ground:
                fixed(wheel, held, side)
            elif axis and _ring(mesh, part):
                leg = behind[wheel]
                draw(wheel, held, at(leg, pitch + away * RIM), at(leg, centre))
                on_axis.setdefault((wheel, axis), set()).add(leg)
    for carrier in dict.fromkeys(mesh.carrier for mesh in line.meshes):
        plane, held_at = behind[carrier], [s for s in line.spots_of(carrier) if not s.rolls]
        ends = [heights[s.name] for s in held_at]
        if carrier == ground:
            for height in ends:
                fixed(carrier, at(plane, height), 0.0)
        elif carrier in scene.by_name and len(ends) > 1:
            bar(carrier, plane, min(ends), max(ends))
        if carrier in scene.by_name:
            for s in held_at:
                on_axis.setdefault((carrier, s.name), set()).add(plane)
    for axis in dict.fromkeys(axis for mesh in line.meshes for axis in mesh.axes if axis):
        plate.line("mechanism", complex(0.0, heights[axis]), complex(count * step, heights[axis]), strokes.AXIS)
    _shafts(plate, scene, line, on_axis, at, heights)
    for link, lines in shapes.items():
        plate.put("mechanism", *lines, id=f"plan-link-{link.replace('/', '-')}", classes=("link",))
    return plate.piece


def _shafts(
    plate: Plate, scene: Mechanism, line: CentreLine, on_axis: Mapping[tuple[str, str], set[int]],
    at: Callable[[int, float], complex], heights: Mapping[str, float],
) -> None:
    """The shafts that join wheels of one link about one axis in several planes; planets on their pins."""

    def shaft(link: str, axis: str, first: int, last: int) -> None:
        stroke = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
        plate.line("mechanism", at(first, heights[axis]), at(last, heights[axis]), stroke)

    for (link, axis), planes in on_axis.items():
        if len(planes) > 1:
            shaft(link, axis, min(planes), max(planes))
    for mesh in line.meshes:
        for wheel, axis in zip(mesh.bodies, mesh.axes, strict=True):
            planes_here, held = on_axis.get((wheel, axis), set()), on_axis.get((mesh.carrier, axis), set())
            # where several links turn about an axis one in another, shafts would hide each other
            if axis and planes_here and held and not (len(line.spot(axis).links) > 2 and axis == line.still):
                shaft(mesh.carrier, axis, max(planes_here), max(held))
                plate.circle("mechanism", at(max(planes_here), heights[axis]), 0.9, strokes.WHITE, strokes.OUTLINE)


FIGURES = (
    Figure("plan", train_figure, by_itself=lambda scene: any(pair.rolling for pair in scene.higher_pairs),
           of_all=True, place=11),
)
