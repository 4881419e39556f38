"""``graphkin solve``: the analytic solution in tables."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FindOption,
    InstrumentOption,
    JsonOption,
    LangOption,
    PositionOption,
    QuietOption,
    SceneArgument,
    driver_values,
)
from graphkin.cli.output import complain, print_json, print_table, tell, unsolvable_as_json
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.api.solved import Solved, SolvedBlocks

Told = Mapping[str, Any]
"""A part of the object that ``--json`` prints."""

__all__ = ["solve"]


def solve(
    scene: SceneArgument,
    at: AtOption = None,
    position: PositionOption = None,
    sweep: Annotated[
        int | None, typer.Option("--sweep", metavar="N", help="N positions over a turn of the driver.")
    ] = None,
    loops: Annotated[
        bool, typer.Option("--loops", help="Print the vector loops: projections and matrix equations, LaTeX too.")
    ] = False,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for solution.json.")] = None,
    lang: LangOption = None,
    convention: ConventionOption = None,
    instrument: InstrumentOption = "exact",
    find: FindOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """The analytic solution alone, at one position or over a turn."""
    from graphkin.api.arguments import known_words
    from graphkin.api.solved import refused, solve_in_blocks

    known_words(language=lang, convention=convention, instrument=instrument)
    values = driver_values(at, position)
    with unsolvable_as_json(as_json, lambda error: refused(scene, values, error)):
        solved = solve_in_blocks(scene, values, sweep, find or None)
    if out is not None:
        from graphkin.api.arguments import write_files

        write_files(out, {"solution.json": solved.json()})
    drawn = next(some for some in solved if some.ok).loops(lang) if loops and solved.ok else None
    if as_json and drawn:
        print_json({**solved.data, "loops": drawn.data})
    elif as_json:
        for piece in solved.json():
            typer.echo(piece.decode(), nl=False)
    elif not quiet and drawn:
        tell(f"{drawn.plain}\n\n{drawn.latex}")
    elif not quiet:
        _print_solution(solved, lang)
    if not solved.ok:
        first = solved.first.motion
        complain(first.said(0))
        raise typer.Exit(3)


def _print_solution(solved: SolvedBlocks, lang: str | None) -> None:
    from graphkin.api.arguments import passed_words
    from graphkin.words import class_of, listed, say

    scene = solved.first.motion.scene
    said_first: Told = solved.first.head
    language = lang or scene.sheet.language
    tell(f"{scene.title_in(language)}   F = {said_first['mobility']}")
    for group, assembly in zip(said_first["groups"], solved.first.motion.assembly, strict=True):
        links, order = listed(group["links"]), class_of(group["class"])
        larger = Phrase("solved larger group", (links, order, assembly))
        dyad = Phrase("solved group", (links, group["kind"], order, assembly))
        tell(say(dyad if group["class"] == 2 else larger, language))
    for said in passed_words(scene, solved.first.motion.passed):
        tell(say(said, language))
    for some in solved:
        _print_positions(some, language)


def _print_positions(solved: Solved, language: str) -> None:
    from graphkin.api.solution_text import solution_tables
    from graphkin.words import say

    for k, (values, why, tables) in enumerate(solution_tables(solved, language)):
        tell("")
        tell(say(Phrase("solved driver", (values,)), language))
        if why:
            tell(say(why, language))
            continue
        for table in tables:
            print_table(table.heads, table.at(k), right=table.right)
