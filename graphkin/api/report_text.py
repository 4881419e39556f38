"""Reports in plain text, for terminal, notebook and files: of a drawing (steps, readings, check), of a turn's study."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from graphkin.api.arguments import passed_words
from graphkin.api.checked import Checked
from graphkin.checking.report import deviation, exact, measured, paper
from graphkin.construction.board.sheet import Equation
from graphkin.construction.board.steps import plain_in
from graphkin.errors import Unsolvable
from graphkin.scene.model import Mechanism
from graphkin.scene.tables import Unit
from graphkin.words import Phrase, about, links_named, listed, say, word
from graphkin.words.written import MOST, amount

if TYPE_CHECKING:
    from graphkin.solver.path.driver_path import Stretch
    from graphkin.study.extremes import Extreme
    from graphkin.study.turn import Output, TurnStudy


def plain_said(phrase: Phrase, language: str) -> str:
    """A sentence in plain text: ω_32 = v_B/A / AB."""
    return say(phrase, language, plain_in(language))


def report_text(checked: Checked, language: str) -> str:
    """The whole report."""
    sheet, scene = checked.sheet, checked.mechanism
    title, colon = scene.question.title_in(language), word("colon", language)
    lines = [title, "=" * _width(title), ""]
    if scene.question.source_in(language):
        lines.append(f"{word('source', language)}{colon}{scene.question.source_in(language)}")
    count = sheet.structure.mobility
    lines.append(f"F = 3·{count.links} − 2·{count.lower} − {count.higher} = {count.value}")
    drivers = [f"{d.key}: {scene.unit_of(d).said(sheet.drivers[d.key])}" for d in scene.drivers]
    lines.append(f"{word('driver', language)}{colon}{say(listed(drivers), language)}")
    for group, assembly in sheet.assembly.items():
        of = say(Phrase("group of links", links=group), language)
        lines.append(f"{of}{colon}{plain_said(assembly, language)}")
    lines += [say(said, language) for said in passed_words(scene, checked.passed)]
    scales = checked.scales
    names = "velocity", "acceleration"
    per_mm = f"{scales['length']:g} mm", *(scene.units.of(name).beside(f"{scales[name]:g}") for name in names)
    # what was drawn by itself, with a link held still
    steps_apart = [f"{s.number:3}  {plain_said(s.phrase, language)}" for s in sheet.held_still]
    held_still = [word("held still", language), *steps_apart, ""] if steps_apart else []
    lines += [
        "",
        f"1 mm = {say(listed(per_mm), language)}",
        "",
        *held_still,
        word("steps", language),
        *(f"{s.number:3}  {plain_said(s.phrase, language)}" for s in sheet.steps),
        "",
        word("equations", language),
    ]
    for equation in sheet.equations:
        lines += [*_rows(equation, language), ""]
    lines += _forces(checked, language)
    lines.append(word("readings", language))
    heads = [(word(key, language), wide) for key, wide in (("on paper", 12), ("measured", 16), ("exact", 16))]
    right = "".join(" " * (wide - _width(head)) + head for head, wide in heads)
    lines.append(_left(word("quantity", language), 16) + right)
    for symbol, length, read, true, own_unit, ok in reading_words(checked):
        mark = {True: "", False: "  !", None: "  ?"}[ok]
        lines.append(f"{symbol:<16}{length:>12}{read:>16}{true:>16} {own_unit}{mark}".rstrip())
    lines += ["", *lever_lines(checked, language), *contact_lines(checked, language)]
    if checked.at_contacts is not None:
        steps = (s for s in checked.at_contacts.sheet.steps if s.diagram in ("velocity", "acceleration"))
        lines += ["", *(f"{s.number:3}  {plain_said(s.phrase, language)}" for s in steps), ""]
    lines += [plain_said(note, language) for note in (*sheet.left_out, *sheet.notes)]
    lines.append(verdict(checked, language))
    return "\n".join(lines) + "\n"


def _forces(checked: Checked, language: str) -> list[str]:
    """The construction of the forces, group by group, with the reason of each step."""
    sheet = checked.sheet
    if not sheet.forces:
        return []
    from graphkin.account.forces import caption, told_of
    from graphkin.account.notation import notation_of
    from graphkin.account.voice import Account
    from graphkin.construction.forces.steps import BY_MOMENTS, COUPLES

    account = Account(sheet, notation_of(sheet, sheet.scene.question.sheet.convention))
    per = f"1 mm = {checked.scales['force']:g} {sheet.scene.units.force}"
    lines = [word("forces", language), per]
    lines += [say(line, language) for force in told_of(account, sheet.inertias.values()) for line in force.sums]
    for number, state in enumerate(sheet.forces):
        if len(sheet.forces) > 1:
            lines.append(word("force with load" if number else "force without load", language))
        for count, group in enumerate(state.groups, 1):
            lines.append(say(caption(account, group, count), language))
            steps = told_of(account, group.by(*BY_MOMENTS, "system", *COUPLES), group)
            lines += [f"    {say(line, language)}" for force in steps for line in (force.said, *force.sums)]
    return [*lines, ""]


def lever_lines(checked: Checked, language: str) -> list[str]:
    """The balancing load by Zhukovsky's lever, beside that of the polygons."""
    lines = []
    units, report = checked.mechanism.units, checked.report
    rows = {str(row.symbol): row for row in report.rows}
    for number, state in enumerate(checked.sheet.forces):
        for lever in state.levers:
            balance = lever.unknown.symbol
            row = rows.get(f"{balance}+" if number else "", rows.get(str(balance)))
            if row is None:
                continue
            moment = balance.kind == "M"
            unit = balance.unit(units)
            values = lever.value if moment else abs(lever.value), row.measured if moment else abs(row.measured)
            by_lever, by_polygons = (f"{amount(unit.of(float(v.real)), MOST)} {unit.text}" for v in values)
            said = Phrase("lever balance", lever=f"{row.symbol} = {by_lever}", polygons=by_polygons)
            lines.append(say(said, language))
    return list(dict.fromkeys(lines))


def verdict(checked: Checked, language: str) -> str:
    """Whether the drawing agrees with the solver; missing quantities are named first."""
    report = checked.report
    said = []
    if missing := [str(s) for s in report.missing if s not in checked.over_turn]:
        said.append(Phrase("not drawn", quantities=listed(missing)))
    for symbol, value in checked.over_turn.items():
        unit = symbol.unit(checked.mechanism.units)
        shown = f"{amount(unit.of(value), MOST)} {unit.text}"
        said.append(Phrase("over the turn", symbol=str(symbol), value=shown))
    wrong = [str(r.symbol) for r in report.rows if r.ok is False]
    if report.undetermined:
        said.append(Phrase("not determined", readings=listed([*map(str, report.undetermined)])))
    if wrong:
        said.append(Phrase("check failed", readings=listed(wrong)))
    elif agree := [r for r in report.rows if r.ok is True]:
        whole = not said
        said.append(Phrase(about("check passed" if whole else "rest agrees", agree), readings=len(agree)))
    elif not report.rows and not checked.over_turn:
        said.append(Phrase("nothing checked"))
    return word("between sentences", language).join(say(phrase, language) for phrase in said)


def contact_lines(checked: Checked, language: str) -> list[str]:
    """Whether the drawing at sliding contacts agrees with that of their replacements; the rates and contacts found."""
    other = checked.at_contacts
    if other is None:
        pins = dict.fromkeys(s.pin for s in checked.mechanism.slides if s.higher)
        return [say(Phrase("at pins", points=listed([*pins])), language)] if pins else []
    gaps = {"at contact": "contact", "at pitch curve": "point"}
    contacts = dict.fromkeys((str(n.of[gaps[n.key]]), n.key) for n in other.sheet.remarks if n.key in gaps)
    if not contacts:  # nothing asked leads over a contact
        return []
    names, curve = [name for name, _ in contacts], any(key == "at pitch curve" for _, key in contacts)
    first = {row.symbol: row for row in checked.report.rows}
    both = [(row, first[row.symbol]) for row in other.report.rows if row.symbol in first]
    alike = sum(abs(a.reading.value - b.reading.value) <= a.tolerance + b.tolerance for a, b in both)
    readings = [
        f"{symbol} {length} mm, {said} {unit}" if length != "–" else f"{symbol} {said} {unit}"
        for symbol, length, said, _, unit, _ in reading_words(other)
        if any(f"_{n}@" in symbol for n in names)
    ]
    key = "at pitch curve" if curve else "at contact"
    where = {gaps[key]: listed(names)}
    key += " agrees" if other.ok and alike == len(both) else " differs"
    lines = [say(Phrase(key, **where, agreeing=alike, readings=len(both)), language)]
    return [*lines, *(f"  {line}" for line in readings)]


def _rows(equation: Equation, language: str) -> list[str]:
    """An equation over its rows of sizes and directions, in columns."""
    columns: list[tuple[str, str, str]] = []
    plain = plain_in(language)
    for i, side in enumerate(equation.sides):
        if i:
            columns.append(("=", "", ""))
        for j, term in enumerate(side):
            if j:
                columns.append(("+", "", ""))
            size = (plain(term.size) if term.size else "√") if term.size_known else "?"
            direction = (plain(term.direction) or "√") if term.direction_known else "?"
            columns.append((plain(term.symbol), size, direction))
    widths = [max(map(_width, column)) for column in columns]
    heads = ("", word("size", language), word("direction of", language))
    rows = ([_left(c[i], w) for c, w in zip(columns, widths, strict=True)] for i in range(len(heads)))
    return [_left(head, 11) + "  ".join(row).rstrip() for head, row in zip(heads, rows, strict=True)]


def _left(text: str, width: int) -> str:
    """A text at the left of a column of a terminal."""
    return text + " " * (width - _width(text))


def _width(text: str) -> int:
    """The width in columns of a terminal; a Chinese character takes two."""
    return sum(2 if ord(c) > 0x2E7F else 1 for c in text)


MOST_CURVES = 40


def turn_text(turn: TurnStudy, language: str) -> list[str]:
    """The study of a turn, in lines."""
    scene = turn.scene
    driver, colon, semicolon = scene.drivers[0], word("colon", language), word("list semicolon", language)
    lines: list[str] = []
    if turn.reach.full:
        said = word("full turn", language)
        if turn.reach.turns > 1:
            said += semicolon + say(Phrase("turns to close", turns=turn.reach.turns), language)
    else:
        said = _between(scene, turn.ranges[0], language)
    stand = [*zip(scene.drivers, turn.reach.start.tolist(), strict=False)][1:]
    held = [f"{d.key} = {say(scene.place_said(d, value), language)}" for d, value in stand]
    others = say(Phrase("in brackets", words=listed(held)), language) if held else ""
    lines.append(f"{word('range', language)} {driver.key}{others}{colon}{said}")
    lines += ["  " + say(passed, language) for passed in passed_words(scene, turn.reach.change_points)]
    for other in turn.ranges[1:]:
        lines.append("  " + say(Phrase("also assembles", assembly=_between(scene, other, language)), language))
    if turn.not_searched:
        lines.append("  " + say(Phrase("not looked for", links=links_named(turn.not_searched)), language))
    turning = {output.quantity.pair for output in turn.outputs if output.turned}
    turning |= {driver.link} if turn.reach.full else set()
    for loop in turn.loops:
        named = f"{word('basic mechanism', language)} {say(listed(loop.links), language)}"
        parts = [f"{named}{colon}{word(loop.name, language)}"]
        # a link that its own lengths would let turn may be held back by the links before it
        for key, links in (("turns fully", turning.intersection(loop.turns)),
                           ("could turn fully", set(loop.turns) - turning)):
            if turned := [link for link in loop.turns if link in links]:
                parts.append(say(Phrase(key, links=listed(turned)), language))
        lines.append(semicolon.join(parts))
    for output in turn.outputs:
        lines += _output(turn, output, language)
    for least in turn.transmission:
        where = word("same everywhere", language)
        if least.drivers:
            places = listed([scene.place_said(driver, value) for value in least.drivers])
            where = f"{driver.key} = {say(places, language)}"
        where = say(Phrase("in brackets", words=where), language)
        pressure = say(Phrase("greatest pressure", angle=f"{math.degrees(least.pressure):.6g}°"), language)
        group = least.group
        names = f"{group.kind} {say(listed(group.links), language) if group.links else group.label}"
        angle = f"{math.degrees(least.angle):.6g}°"
        lines.append(f"{word('least transmission', language)} {names}{colon}{angle}{where}{semicolon}{pressure}")
    lines += _curves(turn, language)
    lines += _forces_of_turn(turn, language)
    return lines + _flywheel(turn, language)


def _forces_of_turn(turn: TurnStudy, language: str) -> list[str]:
    """The greatest and the least of each joint force, couple and balance."""
    scene = turn.scene
    if not scene.loading:
        return []
    from graphkin.study.force_diagrams import force_extremes  # it loads the drawing board

    try:
        ranges = force_extremes(turn.reach)
    except Unsolvable as stop:
        return [word("forces", language) + word("colon", language) + say(stop.reason, language)]
    lines = []
    for name, (quantity, extremes) in ranges.items():
        unit = quantity.unit(scene.units)
        parts = [_extreme(turn, unit, e, language) for e in extremes if math.isfinite(e.value)]
        if away := dict.fromkeys(_at(turn, e) for e in extremes if math.isinf(e.value)):
            parts.insert(0, say(Phrase("grows without bound at", place=listed([*away])), language))
        lines.append(_named(name, unit, language) + word("list semicolon", language).join(parts))
    return lines


def _flywheel(turn: TurnStudy, language: str) -> list[str]:
    """The flywheel that the scene asks for, or the reason why there is none."""
    flywheel, units = turn.flywheel, turn.scene.units
    if flywheel is None:
        return []
    if isinstance(flywheel, Unsolvable):
        return [say(flywheel.reason, language)]
    head = word("flywheel", language) + word("colon", language)
    moment, inertia = units.of("moment"), units.of("inertia")
    said = [
        say(Phrase("driving moment is", moment=f"{moment.of(flywheel.driving):.8g} {moment.text}"), language),
        say(Phrase("excess work is", work=f"{moment.of(flywheel.excess):.8g} {moment.text}"), language),
        f"J_F = {inertia.of(flywheel.inertia):.8g} {inertia.text} (δ = {flywheel.delta:g})",
    ]
    return [head + word("list semicolon", language).join(said)]


def _between(scene: Mechanism, stretch: Stretch, language: str) -> str:
    """The driver's values at both ends of a stretch, dots where it has no end; without any, how far it is followed."""
    low, high = (scene.place_said(scene.drivers[0], value) for value in (stretch.low, stretch.high))
    if not any(stretch.ends):
        return say(Phrase("followed without an end", low=low, high=high), language)
    return " – ".join(value if ended else "..." for value, ended in zip((low, high), stretch.ends, strict=True))


def _at(turn: TurnStudy, extreme: Extreme) -> str:
    from graphkin.study.extremes import driver_value

    begin = driver_value(turn.reach, extreme.offset - extreme.rest) if extreme.rest else extreme.driver
    return _stretch(turn.scene, begin, extreme.driver)


def _stretch(scene: Mechanism, begin: float, end: float) -> str:
    """The driver's values at both ends of a stretch, one where they are the same."""
    return " – ".join(dict.fromkeys(scene.place_said(scene.drivers[0], value) for value in (begin, end)))


def _output(turn: TurnStudy, output: Output, language: str) -> list[str]:
    scene, quantity = turn.scene, output.quantity
    unit, colon = quantity.unit(scene.units), word("colon", language)

    def amount(value: float) -> str:
        return unit.beside(f"{unit.of(value):.10g}")

    head = f"{word('output', language)} {quantity.pair}{colon}"
    if output.stroke is None:
        return [head + word(output.without, language)]
    kind = "swing" if quantity.kind == "theta" else "stroke"
    said = say(Phrase(f"{kind} is", **{kind: amount(output.stroke)}), language)
    back = turn.quick_return(output)
    if back is not None:
        limits = (*output.lows, *output.highs)
        dwells = "dwells not counted" if any(e.rest for e in limits) else ""
        without = dwells or ("way between equal limits not counted" if len(limits) > 2 else "")
        also = f"{word('list comma', language)}{word(without, language)}" if without else ""
        lag = say(Phrase("in brackets", words=f"θ = {math.degrees(back[1]):.8g}°{also}"), language)
        said += f"{word('list comma', language)}K = {back[0]:.10g}{lag}"
    places = listed([f"{amount(e.value)} @ {_at(turn, e)}" for e in output.position.extremes])
    return [head + said, f"  {word('limit position', language)}{colon}{say(places, language)}"]


def _curves(turn: TurnStudy, language: str) -> list[str]:
    scene = turn.scene
    lines = []
    moving = [t for t in turn.curves if t.constant is None and not t.quantity.is_position]
    for traced in moving[:MOST_CURVES]:
        quantity, unit = traced.quantity, traced.quantity.unit(scene.units)
        furthest = traced.furthest(1.0, "max"), traced.furthest(-1.0, "min")
        parts = [_extreme(turn, unit, extreme, language) for extreme in furthest if extreme is not None]
        if traced.unbounded:
            parts.append(word("unbounded", language))
        if traced.zeros:
            places = listed([_stretch(scene, *ends) for ends in traced.zero_stretches])
            parts.append(f"{word('zero at', language)} {say(places, language)}")
        lines.append(_named(str(quantity), unit, language) + word("list semicolon", language).join(parts))
    return lines


def _extreme(turn: TurnStudy, unit: Unit, extreme: Extreme, language: str) -> str:
    """A greatest or least value, and the place of it."""
    key = "greatest" if extreme.kind == "max" else "least"
    named = word(f"local {key}" if extreme.local else key, language)
    return f"{named} {unit.of(extreme.value):.6g} @ {_at(turn, extreme)}"


def _named(name: str, unit: Unit, language: str) -> str:
    """A quantity with its unit, before what is said of it."""
    return name + say(Phrase("in brackets", words=unit.text), language) + word("colon", language)


def reading_words(checked: Checked) -> Iterator[tuple[str, str, str, str, str, bool | None]]:
    """Each reading in words: symbol, mm on paper, measured to the figures drawn, exact, unit, whether they agree."""
    units = checked.mechanism.units
    for row in checked.report.rows:
        said = measured(row.reading, units, row)
        if said == "0" and row.uncertainty is not None and row.bound > row.floor:
            said = f"0 {deviation(row, units)}"
        yield str(row.symbol), paper(row.reading, row), said, exact(row, units), row.symbol.unit(units).text, row.ok
