"""Arguments and options that several commands have, and what is written in them."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from graphkin.errors import CallError, Problem
from graphkin.words import BOTH, LANGUAGES, Phrase

__all__ = [
    "AtOption",
    "ConventionOption",
    "FindOption",
    "FormatOption",
    "InstrumentOption",
    "JsonOption",
    "LangOption",
    "OutOption",
    "PositionOption",
    "QuietOption",
    "SceneArgument",
    "SeedOption",
    "SheetLangOption",
    "TextOption",
    "driver_values",
    "processes",
    "split_words",
]

SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="A scene file, or the name of a scene that comes along.")
]
OutOption = Annotated[
    Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given.")
]
FormatOption = Annotated[str, typer.Option("--format", metavar="svg,pdf,png,dxf", help="Formats of the figures.")]
TextOption = Annotated[
    str,
    typer.Option(
        "--text", metavar="glyphs|outlines", help="Letters of an SVG: with their glyphs, or as paths (Inkscape, CAD)."
    ),
]
AtOption = Annotated[
    list[str] | None,
    typer.Option(
        "--at",
        metavar="DEG",
        help="Driver value instead of the scene's, in the driver's unit; LINK=VALUE names the driver.",
    ),
]
PositionOption = Annotated[
    str | None,
    typer.Option("--position", metavar="NAME", help="The position of this name, of [positions], instead of --at."),
]
FindOption = Annotated[
    list[str] | None,
    typer.Option("--find", metavar="SYMBOL", help="Ask for this only (v_D, omega_3, ...); may be repeated."),
]
LangOption = Annotated[
    str | None, typer.Option("--lang", metavar="|".join(LANGUAGES), help="Language of the figures and the report.")
]
SheetLangOption = Annotated[
    str | None,
    typer.Option("--lang", metavar="|".join((*LANGUAGES, BOTH)), help="Language of what is drawn and written."),
]
ConventionOption = Annotated[
    str | None, typer.Option("--convention", metavar="chinese|us|british|russian", help="Letters and marks.")
]
InstrumentOption = Annotated[
    str, typer.Option("--instrument", metavar="exact|cad|pencil", help="What draws and reads.")
]
SeedOption = Annotated[int, typer.Option("--seed", help="Seed of the pencil's errors.")]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="Print nothing but errors.")]


def split_words(words: str) -> list[str]:
    """Words between commas: formats.

    >>> split_words("svg, PDF,")
    ['svg', 'pdf']
    """
    return [word.strip().lower() for word in words.split(",") if word.strip()]


def driver_values(at: list[str] | None, position: str | None = None) -> float | str | dict[str, float] | None:
    """Driver values as given on the command line: DEG, or LINK=DEG; or the name of a position.

    >>> driver_values(["50"]), driver_values(["1=50", "2=30"])
    (50.0, {'1': 50.0, '2': 30.0})
    """
    if position is not None:
        if at:
            raise CallError(
                Problem("--position", Phrase("stands beside at of nothing"), Phrase("write one of the two"))
            )
        return position
    if not at:
        return None
    named: dict[str, float] = {}
    bare: list[float] = []
    for text in at:
        name, _, number = text.rpartition("=")
        try:
            value = float(number)
        except ValueError:
            raise CallError(
                Problem(f"--at {text}", Phrase("is no number", number=number), Phrase("write at 50 or at 1 50"))
            ) from None
        if name in named or (not name and bare):
            raise CallError(
                Problem("--at", Phrase("is given twice for one driver", text=text), Phrase("write at 1 50 at 2 30"))
            )
        if name:
            named[name] = value
        else:
            bare.append(value)
    if bare and named:
        raise CallError(Problem("--at", Phrase("a bare value beside named ones"), Phrase("write at 1 50 at 2 30")))
    return bare[0] if bare else named


def processes(workers: int | None) -> int | None:
    """How many processes: as many as there are cores, if not told."""
    import os

    return workers if workers is not None else os.cpu_count()
