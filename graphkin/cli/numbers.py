"""Commands of the solver alone: ``solve``, ``sweep``, and the ``study`` of the methods against each other."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

from graphkin.cli.options import Given, command, processes
from graphkin.cli.output import (
    complain,
    finish,
    print_json,
    print_paths,
    print_table,
    progress_bar,
    tell,
    unsolvable_as_json,
)
from graphkin.errors import CallError
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.api.solved import Solved

__all__ = ["solve", "study", "sweep"]


@command(
    "scene", "at", "position", "sweep", "loops", "out of solve", "lang", "convention", "instrument", "find", "json",
    "quiet",
)  # fmt: skip
def solve(given: Given) -> None:
    """The analytic solution alone, at one position or over a turn."""
    from graphkin.api.arguments import known_words, write_files
    from graphkin.api.solved import refused
    from graphkin.api.solved import solve as solving

    known_words(language=given.lang, convention=given.convention, instrument=given.instrument)
    values = given.values
    with unsolvable_as_json(given.json, lambda error: refused(given.scene, values, error)):
        solved = given.call(solving)
    if given.out is not None:
        write_files(given.out, {"solution.json": solved.json()})
    drawn = solved.loops(given.lang) if given.loops and solved.ok else None
    if given.json and drawn:
        print_json({**solved.data, "loops": drawn.data})
    elif given.json:
        for piece in solved.json():
            typer.echo(piece.decode(), nl=False)
    elif not given.quiet and drawn:
        tell(f"{drawn.plain}\n\n{drawn.latex}")
    elif not given.quiet:
        _print_solution(solved, given.lang)
    if not solved.ok:
        complain(solved.said)
        raise typer.Exit(3)


def _print_solution(solved: Solved, lang: str | None) -> None:
    from graphkin.api.arguments import passed_words
    from graphkin.api.solution_text import solution_tables
    from graphkin.words import class_of, listed, say

    scene, blocks = solved.mechanism, solved.blocks()
    head: Mapping[str, Any] = solved.head
    first = next(blocks)
    language = lang or scene.question.sheet.language
    tell(f"{scene.question.title_in(language)}   F = {head['mobility']}")
    for group, assembly in zip(head["groups"], first.motion.assembly, strict=True):
        links, order = listed(group["links"]), class_of(group["class"])
        larger = Phrase("solved larger group", (links, order, assembly))
        dyad = Phrase("solved group", (links, group["kind"], order, assembly))
        tell(say(dyad if group["class"] == 2 else larger, language))
    for said in passed_words(scene, first.motion.passed):
        tell(say(said, language))
    for some in (first, *blocks):
        for k, (values, why, tables) in enumerate(solution_tables(some, language)):
            tell("")
            tell(say(Phrase("solved driver", (values,)), language))
            if why:
                tell(say(why, language))
                continue
            for table in tables:
                print_table(table.heads, table.at(k), right=table.right)


@command(
    "scene", "out", "positions", "set", "designs", "workers", "scheduler", "measured", "differentiate", "integrate",
    "format", "text", "at", "find", "lang", "json", "quiet",
)  # fmt: skip
def sweep(given: Given) -> None:
    """Tables and motion diagrams over a turn, limit positions, strokes and K; and the same over designs."""
    from graphkin.api.sweep import sweep as sweeping
    from graphkin.drawing.write.pdf import leave_undocumented
    from graphkin.scene import mechanism_of

    target = given.out if given.out is not None else Path(mechanism_of(given.scene).name)
    leave_undocumented()
    with (
        unsolvable_as_json(given.json, {}),
        progress_bar(given.speaks, target) as progress,
    ):
        swept = given.call(
            sweeping, out=target, designs=_replaced(given.set or ()), designs_file=given.designs, progress=progress,
            workers=None if given.scheduler else processes(given.workers),
        )  # fmt: skip
    if given.json:
        print_json(swept.data)
    elif not given.quiet:
        tell(swept.text)
        print_paths(sorted(p for p in target.iterdir() if not p.name.startswith(".")))
    if not swept.ok:
        complain(Phrase("no position could be solved designs.csv or table.csv"))
        raise typer.Exit(3)


def _replaced(given: Iterable[str]) -> dict[str, str]:
    """Designs as given on the command line: KEY=VALUES."""
    found: dict[str, str] = {}
    for text in given:
        key, sign, values = text.partition("=")
        if not sign or not key.strip():
            raise CallError.of(f"--set {text}", "says no key or no values", "write set links.1.length 40 60 21")
        if key.strip() in found:
            raise CallError.of(f"--set {text}", "the key is given twice", "write key 40 50 60")
        found[key.strip()] = values
    return found


study = typer.Typer(no_args_is_help=True, help="The charts of the methods against each other.")


@study.command("speed-accuracy")
@command("scene", "out of speed-accuracy", "repeats", "format of speed-accuracy", "lang", "json", "quiet")
def speed_accuracy(given: Given) -> None:
    """Cost of a position against the largest error, for all methods, measured on this machine."""
    from graphkin.api.studied import speed_accuracy as racing

    found = given.call(racing)
    finish(given, found, found.write(given.out, given.formats))


@study.command("stability")
@command("out of stability", "format of stability", "lang", "json", "quiet")
def stability(given: Given) -> None:
    """Errors beside every kind of singular position: how fast they grow, where methods stop and how they say so."""
    from graphkin.api.studied import stability as measuring

    found = measuring(language=given.lang or "en")
    finish(given, found, found.write(given.out, given.formats))
