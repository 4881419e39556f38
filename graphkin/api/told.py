"""The report in plain text: what was drawn, in what order and why, what was read off, and the check."""

from __future__ import annotations

from graphkin.api.called import own_unit
from graphkin.api.checked import Checked, reading_row
from graphkin.drafting.sheet import Direction, Equation, Term
from graphkin.words import Phrase, say, word

__all__ = ["show", "told"]

_SIGNS = {"square": "⊥", "along": "∥"}


def show(argument: object) -> str:
    """An argument of a phrase in plain text."""
    if isinstance(argument, Direction):
        if argument.relation == "towards":
            return "→".join(argument.names)
        if argument.relation == "turned":
            return "⊥" + "".join(argument.names)
        return _SIGNS[argument.relation] + "".join(argument.names)
    return str(argument).replace("{", "").replace("}", "")


def told(checked: Checked, language: str) -> str:
    """The whole report."""
    sheet, scene = checked.sheet, checked.scene
    title = scene.title_in(language)
    lines = [title, "=" * sum(2 if ord(c) > 0x2E7F else 1 for c in title), ""]
    if scene.source:
        lines.append(f"{word('source', language)}: {scene.source}")
    count = sheet.structure.mobility
    lines.append(f"F = 3·{count.links} - 2·{count.lower} - {count.higher} = {count.value}")
    drivers = [f"{d.key}: {own_unit(scene, d, sheet.drivers[d.key])}" for d in scene.drivers]
    lines.append(f"{word('driver', language)}: {', '.join(drivers)}")
    for links, phrase in sheet.assembly.items():
        lines.append(f"{word('group', language)} {links}: {say(phrase, language, show)}")
    data = checked.data
    unit = scene.units.length
    scales = data["scales"]
    lines += [
        "",
        f"1 mm = {scales['length']:g} mm, {scales['velocity']:g} {unit}/s, {scales['acceleration']:g} {unit}/s²",
        "",
        word("steps", language),
        *(f"{s.number:3}  {say(s.phrase, language, show)}" for s in sheet.steps),
        "",
        word("equations", language),
    ]
    for equation in sheet.equations:
        lines += [*_rows(equation, language), ""]
    lines.append(word("readings", language))
    head = (word("quantity", language), word("on paper", language), word("measured", language), word("exact", language))
    lines.append(f"{head[0]:<16}{head[1]:>12}{head[2]:>16}{head[3]:>16}")
    for row in checked.report.rows:
        r = reading_row(scene, row)
        mark = "" if row.ok else "  !"
        lines.append(f"{r['symbol']:<16}{r['on_paper_mm']:>12.3f}{r['measured']:>16.6g}{r['exact']:>16.6g}{mark}")
    lines.append("")
    lines += [say(note, language, show) for note in (*sheet.left_out, *sheet.notes)]
    if sheet.stopped:
        lines.append(say(sheet.stopped, language, show))
    lines.append(verdict(checked, language))
    return "\n".join(lines) + "\n"


def verdict(checked: Checked, language: str) -> str:
    """One sentence: does the drawing agree with the solver."""
    off = [str(r.symbol) for r in checked.report.rows if not r.ok]
    if off:
        return say(Phrase("check failed", (", ".join(off),)), language)
    if not checked.report.rows:
        return say(Phrase("nothing checked"), language)
    return say(Phrase("check passed", (len(checked.report.rows),)), language)


def _rows(equation: Equation, language: str) -> list[str]:
    """An equation over its rows of sizes and directions, in columns."""
    columns: list[tuple[str, str, str]] = []
    for i, side in enumerate(equation.sides):
        if i:
            columns.append(("=", "", ""))
        for j, term in enumerate(side):
            if j:
                columns.append(("+", "", ""))
            columns.append((str(term.symbol), _size(term), _direction(term)))
    widths = [max(len(cell) for cell in column) for column in columns]
    heads = ("", word("size", language), word("direction of", language))
    return [
        f"{head:<11}" + "  ".join(f"{c[i]:<{w}}" for c, w in zip(columns, widths, strict=True)).rstrip()
        for i, head in enumerate(heads)
    ]


def _size(term: Term) -> str:
    return (show(term.size) or "√") if term.size_known else "?"


def _direction(term: Term) -> str:
    if not term.direction_known:
        return "?"
    return show(term.direction) if term.direction else "√"
