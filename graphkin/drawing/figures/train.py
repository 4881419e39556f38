"""The figure of the velocity plan: each train laid on its line of centres, beside it one line of velocities a link, and
the rate scale, on which parallels through a pole mark off the angular rates."""

from __future__ import annotations

from dataclasses import replace

from graphkin.account.headings import drivers, number, written
from graphkin.account.notation import Letters
from graphkin.construction.centre_lines import PlanLine, TrainPlan
from graphkin.construction.sheet import Sheet
from graphkin.drawing.boxes import GAP, Block, FigurePage, column, panel, row, table
from graphkin.drawing.figures import Figure
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Text
from graphkin.drawing.ink.symbols import COMPONENT, arrow
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, moved_piece
from graphkin.drawing.text import rich, symbol
from graphkin.drawing.train_scheme import scheme
from graphkin.drawing.write.drawing import Drawing
from graphkin.scene.model import Mechanism
from graphkin.words import Phrase, languages, word
from graphkin.words.written import amount, on_paper, product

__all__ = ["FIGURES", "moving_plans", "train_figure"]

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
        f"{page.term(name)}:  {drivers(sheet, page.letters)}", body, ",  ".join(_scales(page, plan)), title=name,
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
        text = Text(0j, symbol(markup, 3.0), "start", classes=("label",), id=f"label-plan-{'-'.join(names)}{tag}")
        labels.append(Label(text, complex(0.0, -h), rank=1))
    for one in own:
        colour = strokes.colour_of_link(sheet.scene, one.link)
        a, b = (z.conjugate() for z in one.ends)
        over = 3.0 * (b - a) / abs(b - a)
        arrows.append(Group((Line(a - over, b + over, strokes.LINK.coloured(colour)),),
                            id=f"plan-line-{one.link}{tag}", classes=("plan-line",)))  # fmt: skip
        name = Text(0j, rich(one.link, 3.2, bold=True), "start", colour, f"label-plan-line-{one.link}{tag}", ("label",))
        labels.append(Label(name, (a, b), rank=0))
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
    labels = [Label(Text(0j, symbol("P", 3.2), "start", classes=("label",)), 0j, (1.57,), rank=0)]
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
        text = Text(0j, symbol(markup, 3.0), "start", classes=("label",), id=f"label-plan-rate-{'-'.join(links)}")
        labels.append(Label(text, complex(x, deep + 1.2), (-1.57,), rank=0))
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


FIGURES = (Figure("plan", train_figure, by_itself=_rolls, of_all=True, place=11),)
