"""``graphkin solve``: the analytic solution in tables."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
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

if TYPE_CHECKING:
    from graphkin.api.solved import Solved, SolvedBlocks
    from graphkin.structure import Structure
    from graphkin.table import Column

Told = Mapping[str, Any]
"""A part of the object that ``--json`` prints."""

__all__ = ["solve"]

_SLIGHT = 1e-12
_OF_SLIDES = {"travel": "position", "velocity": "velocity", "acceleration": "acceleration"}
_KINDS = {"deg": "angle", "rad/s": "omega", "rad/s2": "alpha", "/s": "velocity", "/s2": "acceleration"}
"""Which bound of a position holds for a quantity, by its unit without that of lengths."""


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
        complain(f"{first.status[0]}: {first.why[0]}")
        raise typer.Exit(3)


def _print_solution(solved: SolvedBlocks, lang: str | None) -> None:
    from graphkin.api.arguments import passed_words
    from graphkin.words import Phrase, class_of, listed, say

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
    from graphkin.words import Phrase, say, word
    from graphkin.words.refused import refused

    scene = solved.motion.scene
    columns = [column for name in solved.find for column in solved.columns(name)]
    positions: Iterator[Told] = solved.entries()
    for number, position in enumerate(positions):
        tell("")
        values = ", ".join(f"{k} = {v:.6g}" for k, v in position["driver"].items())
        tell(say(Phrase("solved driver", (values,)), language))
        if position["status"] != "ok":
            tell(refused(f"{position['status']}: {position['why']}", language))
            continue
        if solved.find:
            bounds = [_bound_of(c, position["error_bound"], scene.units.length) for c in columns]
            told = [_certain(float(c.values[number]), b) for c, b in zip(columns, bounds, strict=True)]
            rows = [[c.name, _number(x), c.unit] for c, x in zip(columns, told, strict=True)]
            print_table([word("quantity", language), "", ""], rows, right=(1,))
            continue
        _print_position(position, solved.motion.structure, language)
        if "forces" in position:
            _print_forces(position, scene.units.force, language)


def _print_position(position: Told, structure: Structure, language: str) -> None:
    from graphkin.words import Phrase, say

    unit = structure.scene.units.length
    heads = {k: say(Phrase(f"heads of {k}", (unit,)), language).split("|") for k in ("links", "points", "slides")}
    bound = {kind: b or 0.0 for kind, b in position["error_bound"].items() if kind != "why"}
    of = {k: _rate_bounds(k, position, bound, structure) for k in ("omega", "alpha", "velocity", "acceleration")}
    links = [
        [
            name,
            _number(math.degrees(_certain(link["angle"], bound["angle"]))),
            *(_number(_certain(link[k], of[k][name])) for k in ("omega", "alpha")),
        ]
        for name, link in position["links"].items()
    ]
    points = [
        [name, _pair(point["position"], bound["position"]),
         *(_pair(point[k], of[k][name]) for k in ("velocity", "acceleration"))]
        for name, point in position["points"].items()
    ]  # fmt: skip
    slides = []
    for name, slide in position["slides"].items():
        # a difference of two points', and 2 omega v of such a one
        ends = [p for p in position["points"] if p.partition("@")[2] in name.split("/")]
        twice = {k: 2.0 * max((of[b][p] for p in ends), default=bound[b]) if b in of else 2.0 * bound[b]
                 for k, b in _OF_SLIDES.items()}  # fmt: skip
        spin = abs(position["links"].get(name.partition("/")[2], {"omega": 0.0})["omega"])
        turned = 2.0 * (spin * twice["velocity"] + bound["omega"] * abs(slide["velocity"]))
        told = [_number(_certain(slide[k], twice[k])) for k in twice]
        slides.append([name, *told, _pair(slide["coriolis"], turned)])
    print_table(heads["links"], links, right=(1, 2, 3))
    print_table(heads["points"], points)
    print_table(heads["slides"], slides, right=(1, 2, 3))


def _rate_bounds(kind: str, position: Told, bound: Told, structure: Structure) -> dict[str, float]:
    """The bound of a rate of each link or point: where no group comes before it, of what the drivers alone move."""
    from graphkin.scene.symbol import PointRef, Symbol
    from graphkin.structure import by_drivers_alone

    def symbol(name: str) -> Symbol:
        point, _, link = name.partition("@")
        if not link:
            return Symbol("omega", link=name)
        return Symbol("v", PointRef(point, "" if point in structure.scene.by_name[link].points else link))

    rows = position["points" if kind in ("velocity", "acceleration") else "links"]
    sizes = {name: math.hypot(*(row[kind] if "@" in name else [row[kind]])) for name, row in rows.items()}
    led = {name for name in rows if by_drivers_alone(structure, symbol(name))}
    least = min(bound[kind], _SLIGHT * max((sizes[name] for name in led), default=0.0))
    return {name: least if name in led else bound[kind] for name in rows}


def _print_forces(position: Told, unit: str, language: str) -> None:
    """Forces by components, size and direction, and moments; what its bound does not tell from 0 is 0."""
    from graphkin.words import Phrase, say

    force_bound, moment_bound = position["force_bound"].values()

    heads = {k: say(Phrase(f"heads of {k}", (unit,)), language).split("|") for k in ("forces", "moments")}
    forces = [
        [
            key,
            _pair(given, force_bound),
            _number(math.hypot(*force)),
            _number(math.degrees(math.atan2(force[1], force[0]))),
        ]
        for key, given in position["forces"].items()
        for force in [[_certain(x, force_bound) for x in given]]
    ]
    moments = [[key, _number(_certain(m, moment_bound))] for key, m in position["moments"].items()]
    print_table(heads["forces"], forces, right=(2, 3))
    print_table(heads["moments"], moments, right=(1,))


def _number(value: float) -> str:
    return f"{value:.6g}"


def _pair(value: Sequence[float], bound: float) -> str:
    return ", ".join(_number(_certain(x, bound)) for x in value)


def _certain(value: float, bound: float) -> float:
    """A value, 0 where its bound does not tell it from that."""
    return value if not abs(value) <= bound else 0.0


def _bound_of(column: Column, bound: Told, unit: str) -> float:
    """The bound of a quantity asked by name, in its unit: that of its kind, of two of them where it is relative."""
    kind = "position" if column.unit == unit else _KINDS.get(column.unit.replace(unit, ""))
    if kind is None:
        return 0.0
    own = float(bound[kind] or 0.0)
    return (math.degrees(own) if kind == "angle" else own) * (2.0 if "/" in column.name else 1.0)
