"""``graphkin sweep``: tables and motion diagrams over a turn, and over designs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import (
    AtOption,
    FindOption,
    FormatOption,
    JsonOption,
    LangOption,
    OutOption,
    QuietOption,
    SceneArgument,
    TextOption,
    driver_values,
    processes,
    split_words,
)
from graphkin.cli.output import complain, print_json, print_paths, progress_bar, tell, unsolvable_as_json
from graphkin.errors import CallError, Problem
from graphkin.words import Phrase

__all__ = ["sweep"]


def sweep(
    scene: SceneArgument,
    out: OutOption = None,
    positions: Annotated[
        int | None,
        typer.Option(
            "--positions", metavar="12|36|N",
            help="Rows of the table over a turn of the driver; 36 if not given, or as many as the scene's positions.",
        ),
    ] = None,
    replace: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="KEY=VALUES",
            help="Designs: links.1.length=40:60:21 (a grid), =40,50,60 (a list); several give every combination.",
        ),
    ] = None,
    designs: Annotated[
        Path | None, typer.Option("--designs", metavar="FILE.csv", help="Designs: a CSV file whose head names keys.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option("--workers", metavar="N", help="Processes; as many as there are cores if long.")
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option("--scheduler", metavar="ADDRESS", help="Run on a Dask cluster (extra cluster).")
    ] = None,
    measured: Annotated[
        Path | None,
        typer.Option(
            "--measured", metavar="FILE.csv",
            help="Values measured elsewhere (heads: at, symbols), to lie over the curves.",
        ),
    ] = None,
    differentiate: Annotated[
        list[str] | None,
        typer.Option("--differentiate", metavar="QUANTITY", help="Differentiated on paper (s_6/1, theta_4)."),
    ] = None,
    integrate: Annotated[
        list[str] | None,
        typer.Option("--integrate", metavar="QUANTITY", help="Integrated on paper (v_6/1, omega_4)."),
    ] = None,
    formats: FormatOption = "svg",
    text: TextOption = "glyphs",
    at: AtOption = None,
    find: FindOption = None,
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Tables and motion diagrams over a turn, limit positions, strokes and K; and the same over designs."""
    from graphkin.api.sweep import sweep as sweeping
    from graphkin.drawing.write.pdf import leave_undocumented
    from graphkin.scene import mechanism_of

    target = out if out is not None else Path(mechanism_of(scene).name)
    leave_undocumented()
    with (
        unsolvable_as_json(as_json, lambda error: {"status": error.status, "why": error.why}),
        progress_bar(not as_json and not quiet, target) as progress,
    ):
        swept = sweeping(
            scene, target, positions, find or None, driver_values(at), _replaced(replace), designs, None,
            None if scheduler else processes(workers), scheduler, split_words(formats), lang, progress, text, measured,
            differentiate or (), integrate or (),
        )  # fmt: skip
    if as_json:
        print_json(swept.data)
    elif not quiet:
        tell(swept.text)
        print_paths(sorted(p for p in target.iterdir() if not p.name.startswith(".")))
    if not swept.ok:
        complain(Phrase("no position could be solved designs.csv or table.csv"))
        raise typer.Exit(3)


def _replaced(given: list[str] | None) -> dict[str, str]:
    """Designs as given on the command line: KEY=VALUES."""
    found: dict[str, str] = {}
    for text in given or []:
        key, sign, values = text.partition("=")
        if not sign or not key.strip():
            raise CallError(
                Problem(
                    f"--set {text}", Phrase("says no key or no values"), Phrase("write set links.1.length 40 60 21")
                )
            )
        if key.strip() in found:
            raise CallError(Problem(f"--set {text}", Phrase("the key is given twice"), Phrase("write key 40 50 60")))
        found[key.strip()] = values
    return found
