"""``graphkin check``: readings of the drawn diagrams against the analytic solver; `print_check` serves ``draw`` too.

``graphkin draw``: figures, readings and the check.

``graphkin audit``: printed values, or people's answers, against the exact ones.
"""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FindOption,
    FormatOption,
    InstrumentOption,
    JsonOption,
    LangOption,
    OutOption,
    PositionOption,
    QuietOption,
    SceneArgument,
    SeedOption,
    SheetLangOption,
    TextOption,
    driver_values,
    split_words,
)
from graphkin.cli.output import complain, print_json, print_paths, print_table, tell, tell_unused, unsolvable_as_json
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.words import Phrase, languages

if TYPE_CHECKING:
    from graphkin.api.checked import Checked

__all__ = ["audit", "check", "draw", "print_check", "unchecked"]


def check(
    scene: SceneArgument,
    at: AtOption = None,
    position: PositionOption = None,
    find: FindOption = None,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for readings.csv and report.txt.")
    ] = None,
    instrument: InstrumentOption = "exact",
    seed: SeedOption = 0,
    lang: LangOption = None,
    convention: ConventionOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Measure the drawn diagrams and compare every reading with the analytic solver."""
    from graphkin.api.arguments import known_words
    from graphkin.api.checked import check as checking

    known_words(language=lang, convention=convention, instrument=instrument)
    with unsolvable_as_json(as_json, unchecked):
        checked = checking(scene, driver_values(at, position), find or None, instrument, seed)
    language = lang or checked.mechanism.sheet.language
    if out is not None:
        _write(out, checked, language)
    print_check(checked, language, as_json, quiet)


def unchecked(error: Unsolvable) -> dict[str, object]:
    """The answer for a program, where there is nothing to check."""
    return {"instrument": "exact", "ok": False, "status": error.status, "why": error.why, "readings": []}


def print_check(checked: Checked, language: str, as_json: bool, quiet: bool) -> None:
    """Print a check, and leave with the status that belongs to it."""
    if as_json:
        print_json(checked.data)
    elif not quiet:
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


def _write(folder: Path, checked: Checked, language: str) -> None:
    from graphkin.api.arguments import write_files
    from graphkin.api.report_text import report_text

    report = report_text(checked, language)
    checked.write(folder)
    write_files(folder, {"report.txt": report.encode()})


def draw(
    scene: SceneArgument,
    out: OutOption = None,
    formats: FormatOption = "svg",
    at: AtOption = None,
    position: PositionOption = None,
    find: FindOption = None,
    lang: SheetLangOption = None,
    convention: ConventionOption = None,
    instrument: InstrumentOption = "exact",
    seed: SeedOption = 0,
    figure: Annotated[
        list[str] | None,
        typer.Option("--figure", metavar="NAME", help="Draw this figure only (velocity, sheet, ...); may be repeated."),
    ] = None,
    text: TextOption = "glyphs",
    driver: Annotated[
        str, typer.Option("--driver", metavar="LINK", help="With --figure structure: another driver beside the first.")
    ] = "",
    beside: Annotated[
        list[str] | None,
        typer.Option("--beside", metavar="NAME|DEG", help="With --figure polygons: a position; two or more."),
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Draw the mechanism, the velocity and the acceleration polygon; measure and check them."""
    from graphkin.api.arguments import known_words
    from graphkin.api.drawn import draw as drawing

    wanted = split_words(formats)
    known_words(wanted, text=text)
    with unsolvable_as_json(as_json, unchecked):
        drawn = drawing(
            scene, None, driver_values(at, position), find or None, wanted, lang, convention, instrument, seed,
            figure or None, driver, beside or (),
        )  # fmt: skip
        paths = drawn.write(out, wanted, text)
    made = {name.split("-")[0] for name in drawn.figures}
    missing = [name for name in figure or () if name not in made]
    complain(*(Problem(f"figure {name}", Phrase("the scene has nothing of it")) for name in missing))
    if not as_json and not quiet:
        print_paths(paths)
    print_check(drawn.checked, languages(lang or drawn.checked.mechanism.sheet.language)[0], as_json, quiet)


def audit(
    scene: SceneArgument,
    answers: Annotated[
        Path | None,
        typer.Option(
            "--answers", metavar="FILE.csv", help="A row for each person, symbols as heads, values in scene units."
        ),
    ] = None,
    at: AtOption = None,
    position: PositionOption = None,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for audit.csv.")] = None,
    variants: Annotated[
        Path | None,
        typer.Option("--variants", metavar="DIR", help="Folder of the problem set, for answers with a column variant."),
    ] = None,
    grading: Annotated[
        str, typer.Option("--grading", metavar="equations=20,drawing=30,values=50", help="Points, also by symbol.")
    ] = "",
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Judge the scene's printed values, or people's answers: right, within drafting accuracy, or wrong and why."""
    from graphkin.api.audited import audit as auditing

    audited = auditing(scene, answers, driver_values(at, position), lang, variants, _points(grading))
    paths = audited.write(out) if out is not None else []
    if as_json:
        print_json(audited.data)
    elif not quiet:
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
    if not audited.ok:
        raise typer.Exit(1)


def _points(text: str) -> dict[str, float] | None:
    """Points by part or symbol, as ``--grading`` gives them."""
    found: dict[str, float] = {}
    for one in filter(None, map(str.strip, text.split(","))):
        name, _, points = one.partition("=")
        try:
            found[name.strip()] = float(points)
        except ValueError:
            raise CallError(
                Problem("grading", f'"{one[:40]}"', Phrase("write equations 20 drawing 30 values 50"))
            ) from None
    return found or None
