"""The figure of the velocity plan: each train laid on its line of centres, beside it one line of velocities a link, and
the rate scale, on which parallels through a pole mark off the angular rates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from graphkin.construction.centre_lines import PlanLine, TrainPlan
from graphkin.construction.sheet import Scales, Sheet
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters, letters_of, scale_statement
from graphkin.drawing.headings import drivers, facts, figure_title, number, term, written
from graphkin.drawing.ink import strokes
from graphkin.drawing.ink.primitives import Circle, Group, Line, Primitive, Text
from graphkin.drawing.ink.symbols import COMPONENT, arrow
from graphkin.drawing.page_text import titled
from graphkin.drawing.place.dimensions import check_bar
from graphkin.drawing.place.labels import Label
from graphkin.drawing.place.names import with_labels
from graphkin.drawing.place.piece import Piece, ink_box, joined, layer_groups, moved_piece
from graphkin.drawing.text import fitted, rich, symbol, wrapped
from graphkin.drawing.train_scheme import scheme
from graphkin.drawing.write.drawing import Drawing
from graphkin.words import Phrase, languages, say
from graphkin.words.written import amount, on_paper, product

__all__ = ["moving_plans", "train_figure"]

WIDTH, MARGIN, ROOM = 190.0, 10.0, 9.0
SCHEME = 68.0
"""mm that the train seen from the side may take."""
PLAN = 86.0
"""mm from the left edge to where velocities may begin."""
SIZE, ROW = 2.8, 4.6
SHORT = 0.3


def train_figure(sheet: Sheet, *, language: str | None = None, convention: str | None = None) -> Drawing | None:
    """A page for each plan; None where nothing rolls, or nothing of it moves.

    Parameters
    ----------
    sheet : what was drawn
    language : "en", "zh" or "both"; the scene's own if None
    convention : "chinese", "us", "british" or "russian"; the scene's own if None
    """
    spoken = language or sheet.scene.sheet.language
    letters = letters_of(sheet, convention or sheet.scene.sheet.convention)  # type: ignore[arg-type]
    pages = [_page(sheet, plan, letters, spoken, i) for i, plan in enumerate(moving_plans(sheet))]
    return replace(pages[0], further=tuple(pages[1:])) if pages else None


def moving_plans(sheet: Sheet) -> list[TrainPlan]:
    """The plans in which anything moves: these have a page."""
    return [plan for plan in sheet.trains if any(plan.velocities.values()) or any(one.rate for one in plan.lines)]


def _page(sheet: Sheet, plan: TrainPlan, letters: Letters, spoken: str, count: int) -> Drawing:
    name = "plan" if plan.order == "velocity" else "plan accelerations"
    words, y = titled(sheet, spoken, f"{term(name, spoken)}:  {drivers(sheet, letters)}", MARGIN)
    y += 1.0
    for each in languages(spoken):
        key = "plan reason" if plan.order == "velocity" else "plan reason accelerations"
        said = [say(Phrase(key), each)]
        said += [say(Phrase("plan relative", (line.still,)), each) for line in plan.on if not line.in_frame]
        for runs in (r for text in said for r in wrapped(text, SIZE, WIDTH - 2 * MARGIN)):
            y += ROW
            words.append(Text(complex(MARGIN, y), runs))
    y += 4.0
    pieces = []
    mm = 1.0 / plan.scales.length
    for k, line in enumerate(plan.on):
        heights = [s.height * mm for s in line.spots]
        left = scheme(sheet.scene, line, mm, SCHEME)
        # the zero line stands where the slowest place still clears the train
        reach = [z.real for one in plan.lines if one.on == k for z in one.ends]
        x = PLAN - min(0.0, *reach) if reach else PLAN
        ink = ink_box(left.drawn)
        drawn = _lines(sheet, plan, k, letters, MARGIN + (ink.right if ink else 0.0) - x)
        top = y + ROOM + max(heights)
        whole = joined((moved_piece(left, complex(MARGIN, 0.0)), moved_piece(drawn, complex(x, 0.0))))
        panel = Box(MARGIN - 4.0, y, WIDTH - MARGIN + 4.0, top - min(heights) + ROOM)
        pieces.append(with_labels(moved_piece(whole, complex(0.0, top)), panel))
        y = panel.bottom
    scale = _rate_scale(sheet, plan, letters)
    feet = [0.0, *(one.foot for one in plan.lines)]
    x = PLAN + 4.0 - min(feet)
    panel = Box(PLAN - 12.0, y, WIDTH - MARGIN + 4.0, y + plan.scales.pole + 16.0)
    pieces.append(with_labels(moved_piece(scale, complex(x, y + 7.0)), panel))
    bottom = _table(words, sheet, plan, letters, spoken, y + 7.0)
    y = max(panel.bottom, bottom) + 7.0
    for i, told in enumerate(_scales(sheet, plan, letters)):
        words.append(Text(complex(MARGIN + 42.0 * i, y), fitted(told, 3.0, 40.0)))
    words += check_bar(complex(WIDTH - MARGIN - 50.0, y), rich(term("check bar", spoken), 2.4))
    page = joined((*pieces, Piece({"labels": tuple(words)})))
    rates = sheet.scene.units.rates.metres
    size, speed = plan.scales.length / sheet.scene.units.metres, plan.scales.speed / rates
    angular = "omega" if plan.order == "velocity" else "alpha"
    told_scales = {"length": size, plan.order: speed, angular: plan.scales.rate}
    return Drawing(
        WIDTH, y + 8.0, layer_groups(page), figure_title(sheet, name, spoken),
        say(Phrase("plan described"), languages(spoken)[0]), languages(spoken)[0],
        facts(sheet, "plan") | {"scales": {k: float(f"{v:.12g}") for k, v in told_scales.items()}},
    )  # fmt: skip


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


def _table(
    words: list[Primitive], sheet: Sheet, plan: TrainPlan, letters: Letters, spoken: str, y: float
) -> float:
    """What is read off the rate scale: mm, and the rate."""
    sign, unit = ("ω", "rad/s") if plan.order == "velocity" else ("α", "rad/s²")
    columns = (MARGIN, MARGIN + 16.0, MARGIN + 34.0)
    heads = (term("plan link", spoken), "mm", f"${sign}$, {unit}")
    words += [Text(complex(x, y), rich(head, 2.5)) for x, head in zip(columns, heads, strict=True)]
    words.append(Line(complex(MARGIN, y + 1.4), complex(MARGIN + 62.0, y + 1.4), strokes.OUTLINE))
    y += 0.8
    for one in _plan_lines(sheet, plan):
        y += ROW
        read = on_paper(abs(one.foot))
        if one.rate_known and not one.trial:
            told = f"{number(one.rate, 5)} {term('plan given', spoken)}"
        else:
            size = written(product(read, amount(plan.scales.rate, 12)))
            told = f"−{size}" if one.rate < 0.0 and size != "0" else size
        cells = (one.link, read, told)
        words += [Text(complex(x, y), rich(text, SIZE, bold=x == MARGIN), classes=("cell",))
                  for x, text in zip(columns, cells, strict=True)]  # fmt: skip
    for key, (value, mm) in plan.travels.items():
        y += ROW
        tail = "/s" if plan.order == "velocity" else "/s²"
        said = f"{number(value / sheet.scene.units.rates.metres, 5)} {sheet.scene.units.rates.length}{tail}"
        cells = (key, on_paper(abs(mm)), said)
        words += [Text(complex(x, y), rich(text, SIZE), classes=("cell",))
                  for x, text in zip(columns, cells, strict=True)]  # fmt: skip
    return y


def _scales(sheet: Sheet, plan: TrainPlan, letters: Letters) -> Sequence[str]:
    speed = plan.scales.speed
    at_scale = replace(sheet, scales=Scales(plan.scales.length, speed, speed))
    diagrams = ("mechanism", "velocity" if plan.order == "velocity" else "acceleration")
    sign, unit = ("ω", "rad/s") if plan.order == "velocity" else ("α", "rad/s²")
    per = plan.scales.rate
    angular = f"$μ_{{{sign}}}$ = {number(per)} ({unit})/mm"
    if letters.convention in ("us", "british"):
        times, head = (1, "1 mm") if letters.convention == "us" else (10, "1 cm")
        angular = f"{head} = {number(times * per)} {unit}"
    return (*(scale_statement(at_scale, letters.convention, d) for d in diagrams), angular)  # type: ignore[arg-type]
