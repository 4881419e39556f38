"""The figure of the velocity plan: each train laid on its line of centres, beside it one line of velocities a link, and
the rate scale, on which parallels through a pole mark off the angular rates."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

from graphkin.account.headings import number, written
from graphkin.account.notation import Letters
from graphkin.construction.sheet import Sheet
from graphkin.construction.trains import CentreLine, PlanLine, TrainPlan
from graphkin.drawing.boxes import GAP, Block, FigurePage, column, panel, row, table
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Stroke, on_page
from graphkin.drawing.ink.symbols import COMPONENT, arrow, hatched_line
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece
from graphkin.drawing.text import plain, rich, symbol
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.model import Mechanism
from graphkin.structure import Mesh
from graphkin.words import Phrase, languages, word
from graphkin.words.written import amount, on_paper, product

__all__ = ["FIGURES", "moving_plans", "scheme", "train_figure"]

ROOM = 9.0  # mm above and below a line of centres
SCHEME = 68.0
"""mm that the train seen from the side may take."""
PLAN = 78.0
"""mm from the left margin to where velocities may begin."""
TABLE = 62.0  # mm
SHORT = 0.3


def train_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing | None:
    """A page for each plan; None where nothing rolls, or nothing of it moves.

    Parameters
    ----------
    sheet : what was drawn
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    page = FigurePage.of(sheet, "plan", language, convention)
    pages = [_page(page, plan) for plan in moving_plans(sheet)]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


def moving_plans(sheet: Sheet) -> list[TrainPlan]:
    """The plans in which anything moves: these have a page."""
    return [plan for plan in sheet.trains if any(plan.velocities.values()) or any(one.rate for one in plan.lines)]


def _page(page: FigurePage, plan: TrainPlan) -> Drawing:
    sheet, velocity = page.sheet, plan.order == "velocity"
    name = "plan" if velocity else "plan accelerations"
    why = [Phrase("plan reason" if velocity else "plan reason accelerations")]
    why += [Phrase("plan relative", (line.still,)) for line in plan.on if not line.in_frame]
    lines = [_train(page, plan, k) for k in range(len(plan.on))]
    rates = _rate_scale(sheet, plan, page.letters)
    least = min(0.0, *(one.foot for one in plan.lines))
    scale = panel(page.width - TABLE - 4.0, plan.scales.pole + 16.0, lambda room: with_labels(
        moved_piece(rates, complex(PLAN + 4.0 - least - TABLE - 4.0, 7.0)), room))
    body = column(page.prose(why), *lines, row(_table(page, plan), scale, gap=4.0), gap=GAP)
    size, speed = plan.scales.length / sheet.scene.units.metres, plan.scales.speed / sheet.scene.units.rates.metres
    scales = {"length": size, plan.order: speed, "omega" if velocity else "alpha": plan.scales.rate}
    return page.drawing(
        page.at_drivers(page.term(name)), body, ",  ".join(_scales(page, plan)), title=name,
        said=page.said("plan described")[0],
        metadata={"scales": {key: float(f"{value:.12g}") for key, value in scales.items()}},
    )  # fmt: skip


def _train(page: FigurePage, plan: TrainPlan, k: int) -> Block:
    """A line of centres: the train seen from the side, and the velocities of its places."""
    line, mm = plan.on[k], 1.0 / plan.scales.length
    heights = [spot.height * mm for spot in line.spots]
    seen = scheme(page.sheet.scene, line, mm, SCHEME)
    # the zero line stands where the slowest place still clears the train
    reach = [z.real for one in plan.lines if one.on == k for z in one.ends]
    x = PLAN - min(0.0, *reach) if reach else PLAN
    ink = ink_box(seen.drawn)
    velocities = _lines(page.sheet, plan, k, page.letters, (ink.right if ink else 0.0) - x)
    whole = joined((seen, moved_piece(velocities, complex(x, 0.0))))
    return page.panel(
        max(heights) - min(heights) + 2 * ROOM,
        lambda room: with_labels(moved_piece(whole, complex(0.0, ROOM + max(heights))), room.grown(2.0)),
    )


def _lines(sheet: Sheet, plan: TrainPlan, k: int, letters: Letters, start: float) -> Piece:
    """The plan over one line of centres, its zero line at x = 0, heights up the page from 0; the heights
    are carried over from ``start``."""
    line, mm = plan.on[k], 1.0 / plan.scales.length
    tag = f"-{k + 1}" if k else ""
    own = [one for one in plan.lines if one.on == k and one.link in sheet.scene.by_name]
    heights = {s.name: s.height * mm for s in line.spots}
    low, high = min(heights.values()), max(heights.values())
    thin: list[Primitive] = [Line(complex(0.0, 4.0 - low), complex(0.0, -4.0 - high), strokes.OUTLINE)]
    arrows: list[Primitive] = []
    labels: list[Label] = []
    written: dict[float, list[str]] = {}
    for spot in line.spots:
        x, h = plan.velocities.get((k, spot.name)), heights[spot.name]
        if x is None:
            continue
        thin.append(Line(complex(start, -h), complex(max(0.0, x), -h), strokes.OF_CENTRES))
        if abs(x) > SHORT:
            shapes = arrow(complex(0.0, -h), complex(x, -h), COMPONENT)
            arrows.append(Group(shapes, id=f"plan-{spot.name}{tag}", classes=("speed",)))
        thin.append(Circle(complex(x, -h), 0.5, fill=strokes.BLACK))
        written.setdefault(round(h, 3), []).append(letters.point(spot.name) if not spot.rolls else spot.name)
    for h, names in written.items():
        markup = ", ".join(dict.fromkeys(names))
        labels.append(Label.of(symbol(markup, 3.0), complex(0.0, -h), f"label-plan-{'-'.join(names)}{tag}", rank=1))
    for one in own:
        colour = strokes.colour_of_link(sheet.scene, one.link)
        a, b = (on_page(z) for z in one.ends)
        over = 3.0 * (b - a) / abs(b - a)
        arrows.append(Group((Line(a - over, b + over, strokes.LINK.coloured(colour)),),
                            id=f"plan-line-{one.link}{tag}", classes=("plan-line",)))  # fmt: skip
        labels.append(Label.of(rich(one.link, 3.2, bold=True), (a, b), f"label-plan-line-{one.link}{tag}",
                               colour=colour))
    return Piece({"construction": tuple(thin), plan.order: tuple(arrows)}, tuple(labels))


def _rate_scale(sheet: Sheet, plan: TrainPlan, letters: Letters) -> Piece:
    """Parallels to the lines through the pole, which stands at 0, down to the scale."""
    sign = "ω" if plan.order == "velocity" else "α"
    deep = plan.scales.pole
    shown = _plan_lines(sheet, plan)
    feet = [0.0, *(one.foot for one in shown)]
    thin: list[Primitive] = [Line(complex(min(feet) - 4.0, deep), complex(max(feet) + 4.0, deep), strokes.OUTLINE),
                             Line(0j, complex(0.0, deep), strokes.DIRECTION),
                             Circle(0j, 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE)]  # fmt: skip
    rays: list[Primitive] = []
    labels = [Label.of(symbol("P", 3.2), 0j, toward=(1.57,))]
    feet_of: dict[float, list[str]] = {}
    for one in shown:
        colour = strokes.colour_of_link(sheet.scene, one.link)
        foot = complex(one.foot, deep)
        rays.append(Group((Line(0j, foot, strokes.RELATIVE.coloured(colour)),), id=f"plan-rate-{one.link}",
                          classes=("plan-rate",)))  # fmt: skip
        thin.append(Line(foot - 1.2j, foot + 1.2j, strokes.OUTLINE))
        feet_of.setdefault(round(one.foot, 2), []).append(one.link)
    for x, links in feet_of.items():
        markup = ", ".join(f"{sign}_{{{n}}}" for n in links)
        labels.append(Label.of(symbol(markup, 3.0), complex(x, deep + 1.2), f"label-plan-rate-{'-'.join(links)}",
                               toward=(-1.57,)))
    return Piece({"construction": tuple(thin), plan.order: tuple(rays)}, tuple(labels))


def _plan_lines(sheet: Sheet, plan: TrainPlan) -> list[PlanLine]:
    """One line for each link of the scene: that from which its rate is read."""
    links = dict.fromkeys(one.link for one in plan.lines if one.link in sheet.scene.by_name)
    found = [plan.line(link) for link in links if link != sheet.scene.frame.name]
    return [one for one in found if one is not None]


def _table(page: FigurePage, plan: TrainPlan) -> Block:
    """What is read off the rate scale: mm, and the rate."""
    sign, unit = ("ω", "rad/s") if plan.order == "velocity" else ("α", "rad/s²")
    units = page.sheet.scene.units.rates
    rows = []
    for one in _plan_lines(page.sheet, plan):
        read = on_paper(abs(one.foot))
        size = written(product(read, amount(plan.scales.rate, 12)))
        rate = f"−{size}" if one.rate < 0.0 and size != "0" else size
        if one.rate_known and not one.trial:
            rate = f"{number(one.rate, 5)} {page.term('plan given')}"
        rows.append((one.link, read, rate))
    tail = "/s" if plan.order == "velocity" else "/s²"
    rows += [(key, on_paper(abs(mm)), f"{number(value / units.metres, 5)} {units.length}{tail}")
             for key, (value, mm) in plan.travels.items()]  # fmt: skip
    heads = [[word("plan link", each), "mm", f"${sign}$, {unit}"] for each in languages(page.language)]
    return table(heads, rows, (0.2 * TABLE, 0.25 * TABLE, 0.55 * TABLE))


def _scales(page: FigurePage, plan: TrainPlan) -> tuple[str, str, str]:
    sign, unit = ("ω", "rad/s") if plan.order == "velocity" else ("α", "rad/s²")
    per = plan.scales.rate
    angular = f"$μ_{{{sign}}}$ = {number(per)} ({unit})/mm"
    if page.convention in ("us", "british"):
        times, head = (1, "1 mm") if page.convention == "us" else (10, "1 cm")
        angular = f"{head} = {number(times * per)} {unit}"
    of_plan = page.scale("velocity" if plan.order == "velocity" else "acceleration", plan.scales.speed)
    return page.scale("mechanism", plan.scales.length), of_plan, angular


def _rolls(scene: Mechanism) -> bool:
    return bool(scene.gears) or any(contact.rolling for contact in scene.contacts)


TOOTH, RIM, APART = 5.0, 6.0, 0.45
AXIS = Stroke(0.18, (5.0, 1.0, 0.6, 1.0))
STEP = 13.0
"""mm from one plane to the next, less where there are many."""


@dataclass(frozen=True)
class _Planes:
    """In which plane each pair lies, where the carriers and the legs of rings stand, and how many there are."""

    of: Mapping[str, int]
    behind: Mapping[str, int]
    count: int


def _planes(line: CentreLine) -> _Planes:
    of: dict[str, int] = {}
    rims: dict[tuple[str, str, float], int] = {}
    for mesh in line.meshes:
        pitch = line.spot(mesh.name).height
        own = [(wheel, axis, round(abs(pitch - line.spot(axis).height), 12))
               for wheel, axis in zip(mesh.wheels, mesh.axes, strict=True) if axis]  # fmt: skip
        plane = next((rims[rim] for rim in own if rim in rims), None)
        if plane is None:
            plane = len(set(of.values()))
        of[mesh.name] = plane
        rims.update(dict.fromkeys(own, plane))
    count = len(set(of.values()))
    behind: dict[str, int] = {}
    for mesh in line.meshes:
        parts = mesh.parts if all(mesh.axes) else ()
        rings = [w for w, part in zip(mesh.wheels, parts, strict=False) if part is not None and part < 0]
        for name in (*rings, mesh.carrier):
            if name not in behind:
                behind[name] = count
                count += 1
    return _Planes(of, behind, count)


def scheme(scene: Mechanism, line: CentreLine, mm: float, width: float) -> Piece:
    """The train within ``width`` mm from the left edge at 0, heights up the page from 0 at ``mm`` for one m."""
    planes, ground = _planes(line), scene.frame.name
    step = min(STEP, width / (planes.count + 0.5))
    heights = {s.name: s.height * mm for s in line.spots}

    def at(plane: int, height: float) -> complex:
        return complex((plane + 0.5) * step, -height)

    shapes: dict[str, list[Primitive]] = {}
    labels: list[Label] = []
    named: set[str] = set()
    on_axis: dict[tuple[str, str], set[int]] = {}
    axes: dict[str, None] = {}

    def bar(link: str, plane: int, low: float, high: float) -> None:
        stroke = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
        a, b = at(plane, low), at(plane, high)
        shapes.setdefault(link, []).append(Line(a, b, stroke))
        if link not in named and link in scene.by_name:
            named.add(link)
            labels.append(Label.of(plain(link, 3.2, bold=True), (a, b), f"label-plan-wheel-{link}",
                                   colour=stroke.colour))

    for mesh in line.meshes:
        plane, pitch = planes.of[mesh.name], heights[mesh.name]
        for wheel, axis, part in zip(mesh.wheels, mesh.axes, mesh.parts, strict=True):
            colour = strokes.LINK.coloured(strokes.colour_of_link(scene, wheel))
            if not axis:
                away = 1.0 if pitch > heights[mesh.axes[0]] else -1.0
                own = shapes.setdefault(wheel, [])
                own.append(Line(at(plane, pitch) - 0.7 * TOOTH, at(plane, pitch) + 0.7 * TOOTH, colour))
                bar(wheel, plane, pitch, pitch + away * RIM)
                if wheel == ground:
                    own += _hatched(at(plane, pitch + away * RIM), away)
                continue
            axes[axis] = None
            away = 1.0 if pitch > heights[axis] else -1.0
            ring = part is not None and part < 0 and all(mesh.axes)  # what runs on a rack has its teeth outside
            tooth = at(plane, pitch - away * (APART if not ring else -APART))
            shapes.setdefault(wheel, []).append(Line(tooth - TOOTH / 2, tooth + TOOTH / 2, colour))
            if not ring:
                bar(wheel, plane, heights[axis], pitch - away * APART)
                on_axis.setdefault((wheel, axis), set()).add(plane)
                if wheel == ground:
                    shapes[wheel] += _hatched(at(plane, heights[axis]), -away)
                continue
            rim = pitch + away * RIM
            bar(wheel, plane, pitch + away * APART, rim)
            if wheel == ground:
                shapes[wheel] += _hatched(at(plane, rim), away)
            else:
                leg = planes.behind[wheel]
                shapes[wheel] += [Line(at(plane, rim), at(leg, rim), colour),
                                  Line(at(leg, rim), at(leg, heights[axis]), colour)]  # fmt: skip
                on_axis.setdefault((wheel, axis), set()).add(leg)
    for carrier in dict.fromkeys(mesh.carrier for mesh in line.meshes):
        held = [s for s in line.spots_of(carrier) if not s.rolls]
        plane = planes.behind[carrier]
        if carrier == ground:
            for s in held:
                shapes.setdefault(carrier, []).extend(_hatched(at(plane, heights[s.name]), 0.0))
                on_axis.setdefault((carrier, s.name), set()).add(plane)
        elif carrier in scene.by_name:
            ends = [heights[s.name] for s in held]
            if len(held) > 1:
                bar(carrier, plane, min(ends), max(ends))
            for s in held:
                on_axis.setdefault((carrier, s.name), set()).add(plane)
    drawn: list[Primitive] = [Line(complex(0.0, -heights[a]), complex(planes.count * step, -heights[a]), AXIS)
                              for a in axes]  # fmt: skip
    drawn += _shafts(scene, line, on_axis, at, heights)
    drawn += [Group(tuple(own), id=f"plan-link-{link.replace('/', '-')}", classes=("link",))
              for link, own in shapes.items()]  # fmt: skip
    return Piece({"mechanism": tuple(drawn)}, tuple(labels))


def _hatched(z: complex, away: float) -> tuple[Line, ...]:
    """The frame at a place: above it (1), below it (-1), or a bearing to its right (0)."""
    if away == 0.0:
        return hatched_line(z + complex(0.0, 2.6), z - complex(0.0, 2.6))
    half = complex(2.6, 0.0)
    return hatched_line(z + half, z - half) if away < 0 else hatched_line(z - half, z + half)


def _shafts(
    scene: Mechanism, line: CentreLine, on_axis: Mapping[tuple[str, str], set[int]], at: object,
    heights: Mapping[str, float],
) -> Iterator[Primitive]:
    """Wheels of one link that turn about one axis in several planes joined; planets on their pins."""
    assert callable(at)
    for (link, axis), planes in on_axis.items():
        if len(planes) > 1:
            colour = strokes.LINK.coloured(strokes.colour_of_link(scene, link))
            yield Line(at(min(planes), heights[axis]), at(max(planes), heights[axis]), colour)
    for mesh in line.meshes:
        for wheel, axis in zip(mesh.wheels, mesh.axes, strict=True):
            own, held = on_axis.get((wheel, axis), set()), on_axis.get((mesh.carrier, axis), set())
            if axis and own and held and not _central(line, mesh, axis):
                colour = strokes.LINK.coloured(strokes.colour_of_link(scene, mesh.carrier))
                yield Line(at(max(own), heights[axis]), at(max(held), heights[axis]), colour)
                yield Circle(at(max(own), heights[axis]), 0.9, fill=strokes.WHITE, stroke=strokes.OUTLINE)


def _central(line: CentreLine, mesh: Mesh, axis: str) -> bool:
    """Whether several links turn about an axis one in another, so that shafts there would hide each other."""
    return len(line.spot(axis).links) > 2 and axis == line.still


FIGURES = (Figure("plan", train_figure, by_itself=_rolls, of_all=True, place=11),)
