"""``graphkin check``: readings of the drawn diagrams against the analytic solver; `print_check` serves ``draw`` too."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FindOption,
    InstrumentOption,
    JsonOption,
    LangOption,
    QuietOption,
    SceneArgument,
    SeedOption,
    driver_values,
)
from graphkin.cli.output import print_json, print_table, unsolvable_as_json
from graphkin.errors import Unsolvable

if TYPE_CHECKING:
    from graphkin.api import Checked

__all__ = ["check", "print_check", "unchecked"]


def check(
    scene: SceneArgument,
    at: AtOption = None,
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
    from graphkin.api import check as checking
    from graphkin.api.wishes import known_words

    known_words(None, lang, convention, instrument)
    with unsolvable_as_json(as_json, unchecked):
        checked = checking(scene, driver_values(at), find or None, instrument, seed)
    language = lang or checked.scene.sheet.language
    if out is not None:
        _write(out, checked, language)
    print_check(checked, language, as_json, quiet)


def unchecked(error: Unsolvable) -> dict[str, object]:
    """The answer for a program, where there is nothing to check."""
    return {"instrument": "exact", "ok": False, "status": error.status, "why": error.why, "readings": []}


def print_check(checked: Checked, language: str, as_json: bool, quiet: bool) -> None:
    """Print a check, and leave with the status that belongs to it."""
    from graphkin.api.told import show
    from graphkin.words import say

    if as_json:
        print_json(checked.data)
    elif not quiet:
        _print_readings(checked, language)
    if checked.sheet.stopped is not None:
        typer.echo(f"graphkin: {say(checked.sheet.stopped, language, show)}", err=True)
        if checked.report.missing or not checked.report.rows:
            raise typer.Exit(3)
    if not checked.ok:
        raise typer.Exit(1)


def _print_readings(checked: Checked, language: str) -> None:
    from graphkin.api.told import show, verdict
    from graphkin.words import say, word

    rows = [
        [
            r["symbol"],
            f"{r['on_paper_mm']:.3f}",
            f"{r['measured']:.6g}",
            f"{r['exact']:.6g}",
            "ok" if r["ok"] else "off",
        ]
        for r in checked.data["readings"]
    ]
    heads = [word(key, language) for key in ("quantity", "on paper", "measured", "exact")]
    print_table([*heads, ""], rows, right=(1, 2, 3))
    for note in checked.sheet.notes:
        typer.echo(say(note, language, show))
    if checked.advice:
        typer.echo(say(checked.advice.phrase(), language, show))
    typer.echo(verdict(checked, language))


def _write(folder: Path, checked: Checked, language: str) -> None:
    from graphkin.api.drawn import readings_csv
    from graphkin.api.files import write_files
    from graphkin.api.told import told

    report = told(checked, language)
    write_files(folder, {"readings.csv": readings_csv(checked).encode(), "report.txt": report.encode()})
