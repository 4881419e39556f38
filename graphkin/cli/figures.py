"""Commands that draw: ``draw``, ``check``, ``audit``, ``centres``, ``design`` and ``cam``."""

from __future__ import annotations

from typing import TYPE_CHECKING

import typer

from graphkin.cli.options import Given, command, named_numbers
from graphkin.cli.output import (
    complain,
    finish,
    print_json,
    print_paths,
    print_table,
    tell,
    tell_unused,
    unsolvable_as_json,
)
from graphkin.errors import CallError, Problem
from graphkin.words import Phrase, languages

if TYPE_CHECKING:
    from graphkin.api.checked import Checked

__all__ = ["audit", "cam", "centres", "check", "design", "draw"]

UNCHECKED = {"instrument": "exact", "ok": False, "status": "", "why": "", "readings": []}
"""What a program reads where there is nothing to check."""


@command(
    "scene", "at", "position", "find", "out of check", "instrument", "seed", "lang", "convention", "json", "quiet"
)
def check(given: Given) -> None:
    """Measure the drawn diagrams and compare every reading with the analytic solver."""
    from graphkin.api.arguments import known_words, write_files
    from graphkin.api.checked import check as checking

    known_words(language=given.lang, convention=given.convention, instrument=given.instrument)
    with unsolvable_as_json(given.json, UNCHECKED):
        checked = given.call(checking)
    language = given.lang or checked.mechanism.question.sheet.language
    if given.out is not None:
        from graphkin.api.report_text import report_text

        checked.write(given.out)
        write_files(given.out, {"report.txt": report_text(checked, language).encode()})
    _tell_check(checked, language, given)


def _tell_check(checked: Checked, language: str, given: Given) -> None:
    """Print a check, and leave with the status that belongs to it."""
    if given.json:
        print_json(checked.data)
    elif not given.quiet:
        _print_readings(checked, language)
    if not checked.ok:
        wrong = any(row.ok is False for row in checked.report.rows)
        raise typer.Exit(1 if wrong and checked.complete else 3)


def _print_readings(checked: Checked, language: str) -> None:
    from graphkin.api.arguments import passed_words
    from graphkin.api.report_text import contact_lines, lever_lines, plain_said, reading_words, verdict
    from graphkin.words import say, word

    rows = [
        [symbol, length, measured, exact, unit, {True: "ok", False: "off", None: "?"}[ok]]
        for symbol, length, measured, exact, unit, ok in reading_words(checked)
    ]
    heads = [word(key, language) for key in ("quantity", "on paper", "measured", "exact", "unit")]
    print_table([*heads, ""], rows, right=(1, 2, 3))
    for line in (*lever_lines(checked, language), *contact_lines(checked, language)):
        tell(line)
    for note in checked.sheet.notes:
        tell(plain_said(note, language))
    if checked.advice:
        tell(plain_said(checked.advice.phrase(), language))
    for said in passed_words(checked.mechanism, checked.passed):
        tell(say(said, language))
    tell(verdict(checked, language))


@command(
    "scene", "out", "format", "at", "position", "find", "lang of sheets", "convention", "instrument", "seed", "figure",
    "text", "driver", "beside", "json", "quiet",
)  # fmt: skip
def draw(given: Given) -> None:
    """Draw the mechanism, the velocity and the acceleration polygon; measure and check them."""
    from graphkin.api.arguments import known_words
    from graphkin.api.drawn import draw as drawing

    known_words(given.formats, text=given.text)
    with unsolvable_as_json(given.json, UNCHECKED):
        drawn = given.call(drawing)
        paths = drawn.write(given.out, given.formats, given.text)
    made = {name.split("-")[0] for name in drawn.figures}
    missing = [name for name in given.figure or () if name not in made]
    complain(*(Problem(f"figure {name}", Phrase("the scene has nothing of it")) for name in missing))
    if given.speaks:
        print_paths(paths)
    _tell_check(drawn.checked, languages(given.lang or drawn.mechanism.question.sheet.language)[0], given)


@command(
    "scene", "answers", "at", "position", "out of audit", "variants of audit", "grading", "lang", "json", "quiet"
)
def audit(given: Given) -> None:
    """Judge the scene's printed values, or people's answers: right, within drafting accuracy, or wrong and why."""
    from graphkin.api.audited import audit as auditing

    def wrong(text: str, _: str) -> Problem:
        return Problem("grading", f'"{text[:40]}"', "write equations 20 drawing 30 values 50")

    points = named_numbers([text for text in map(str.strip, given.grading.split(",")) if text], wrong) or None
    audited = given.call(auditing, grading=points)
    paths = audited.write(given.out) if given.out is not None else []
    if given.speaks:
        first = len(audited.heads) - 7
        if audited.rows or not audited.scans:
            print_table(audited.heads, audited.rows, right=(first + 1, first + 2, first + 4))
        if audited.scans:
            tell("\n".join(audited.scan_lines))
        for summary in (audited.students, audited.matrix) if audited.is_class else ():
            tell("")
            print_table(list(summary.heads), [list(row) for row in summary.texts()])
        if paths:
            print_paths(paths)
    tell_unused(audited.unused)
    finish(given, audited)


@command(
    "scene", "out of centres", "format", "text", "at", "position", "centrode", "point", "motion", "lang of sheets",
    "convention", "json", "quiet",
)  # fmt: skip
def centres(given: Given) -> None:
    """All instant centres, how each was found, and the velocities by centres."""
    from graphkin.api.arguments import known_words
    from graphkin.api.centred import centres as finding
    from graphkin.api.centred import centres_text

    known_words(given.formats, text=given.text)
    if given.point and given.centrode is None:
        raise CallError.of("--point", "without centrode", "write centrode link point p")
    if given.motion and given.centrode is not None:
        raise CallError.of("--motion", "stands beside centrode", "write one of the two")
    if given.centrode is not None:
        from graphkin.api.centred import centrodes

        rolled = given.call(centrodes, link=given.centrode)
        finish(given, rolled, rolled.write(given.out, given.formats, given.text), files=True)
        return
    with unsolvable_as_json(given.json, {"links": [], "centres": {}, "ok": False}):
        found = given.call(finding)
    none_wanted = given.json and given.out is None
    paths = [] if none_wanted else found.write(given.out, given.formats, given.text, given.motion)
    if given.speaks:
        print_paths(paths)
        heads, rows, sentences = centres_text(found)
        print_table(heads, rows)
        tell("\n".join(sentences))
    finish(given, found)


@command("file of design", "out", "format", "lang of sheets", "instrument", "seed", "json", "quiet")
def design(given: Given) -> None:
    """Find the lengths of a mechanism for what it shall do: drawn, measured, checked; write it as a scene."""
    from graphkin.api.designed import design as designing
    from graphkin.words import say, word

    with unsolvable_as_json(given.json, {"ok": False, "status": "", "why": "", "lengths": {}, "readings": []}):
        designed = given.call(designing)
        paths = designed.write(given.out, given.formats)
    if given.speaks:
        language = languages(given.lang or designed.given.sheet.language)[0]
        print_paths(paths)
        rows = [
            [row.symbol, f"{row.on_paper:.3f}", f"{row.measured:.7g}", f"{row.exact:.7g}", designed.given.units.length,
             "ok" if row.ok else "off"]
            for row in designed.rows
        ]  # fmt: skip
        heads = [word(key, language) for key in ("length found", "on paper", "measured", "exact", "unit")]
        print_table([*heads, ""], rows, right=(1, 2, 3))
        told = [
            [say(one.what, language), f"{one.asked:.7g}", f"{one.found:.7g}", one.unit, "ok" if one.ok else "off"]
            for one in designed.confirmed
        ]
        print_table([word("confirmed", language), word("given wish", language), "", "", ""], told, right=(1, 2))
        for sentence in designed.sentences(language):
            typer.echo(sentence)
    finish(given, designed)


@command("scene", "out", "format", "lang of sheets", "step", "json", "quiet")
def cam(given: Given) -> None:
    """Cams drawn by inversion: pressure angles, curvature, undercutting, profile as CSV and DXF; discs measured."""
    from graphkin.api.cams import cam as looking

    with unsolvable_as_json(given.json, {"ok": False, "status": "", "why": "", "cams": {}}):
        found = given.call(looking)
        paths = found.write(given.out, given.formats)
    if given.speaks:
        print_paths(paths)
        language = languages(given.lang or found.mechanism.question.sheet.language)[0]
        tell("\n".join(found.sentences(language)))
    finish(given, found)
