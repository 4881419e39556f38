"""Every argument and option of the command line, declared once; a command is a function of what was given, with the
names of the options that it takes."""

from __future__ import annotations

import inspect
import os
from collections.abc import Callable
from functools import wraps
from pathlib import Path
from types import SimpleNamespace
from typing import Any, TypeVar

import typer

from graphkin.errors import CallError, Problem
from graphkin.words import BOTH, LANGUAGES

__all__ = ["At", "Given", "command", "driver_values", "named_numbers", "processes", "split_words"]

T = TypeVar("T")
At = float | str | dict[str, float] | None
"""Driver values as public functions take them."""
Texts = list[str] | None
NoText, NoPath, NoNumber = str | None, Path | None, int | None
arg, opt = typer.Argument, typer.Option

OPTIONS: dict[str, tuple[Any, Any]] = {
    # arguments
    "scene": (str, arg(..., metavar="SCENE", help="A scene file, or the name of a scene that comes along.")),
    "scene of open": (str, arg("", help="A scene file, a folder of them, a scene that comes along, or a link.")),
    "file of design": (str, arg(..., metavar="FILE", help="A design file, or the name of one that comes along.")),
    "source": (str, arg(..., metavar="FILE", help="A file of Linkage, pyslvs, pylinkage, GeoGebra or PMKS, a link of "
                                                  "PMKS+, or a scene.")),
    "name": (NoText, arg(None, help="A scene that comes along: print its text.")),
    "file": (NoPath, arg(None, help="With --copy: where to write it; NAME.toml here if not given.")),
    # what is written where
    "out": (NoPath, opt(None, "-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given.")),
    "out of centres": (NoPath, opt(None, "-o", "--out", metavar="DIR",
                                   help="Folder for the files; ./NAME if not given, none with --json.")),
    "out of check": (NoPath, opt(None, "-o", "--out", metavar="DIR", help="Folder for readings.csv and report.txt.")),
    "out of audit": (NoPath, opt(None, "-o", "--out", metavar="DIR", help="Folder for audit.csv.")),
    "out of solve": (NoPath, opt(None, "-o", "--out", metavar="DIR", help="Folder for solution.json.")),
    "out of convert": (NoPath, opt(None, "-o", "--out", metavar="FILE", help="What to write: .toml, .linkage2, "
                                   ".pyslvs, .json; printed if not given.")),
    "out of speed-accuracy": (Path, opt(Path("speed-accuracy"), "-o", "--out", metavar="DIR",
                                        help="Folder for the chart (SVG, CSV); ./speed-accuracy.")),
    "out of stability": (Path, opt(Path("stability"), "-o", "--out", metavar="DIR",
                                   help="Folder for the charts (SVG, CSV); ./stability.")),
    "format": (str, opt("svg", "--format", metavar="svg,pdf,png,dxf", help="Formats of the figures.")),
    "format of handout": (str, opt("html,pdf", "--format", metavar="html,pdf", help="Formats of the papers.")),
    "format of speed-accuracy": (str, opt("svg", "--format", metavar="svg,pdf,png", help="Formats of the chart.")),
    "format of stability": (str, opt("svg", "--format", metavar="svg,pdf,png", help="Formats of the charts.")),
    "text": (str, opt("glyphs", "--text", metavar="glyphs|outlines",
                      help="Letters of an SVG: with their glyphs, or as paths (Inkscape, CAD).")),
    "text of handout": (str, opt("glyphs", "--text", hidden=True)),
    "lang": (NoText, opt(None, "--lang", metavar="|".join(LANGUAGES), help="Language of the figures and the report.")),
    "lang of sheets": (NoText, opt(None, "--lang", metavar="|".join((*LANGUAGES, BOTH)),
                                   help="Language of what is drawn and written.")),
    "convention": (NoText, opt(None, "--convention", metavar="chinese|us|british|russian", help="Letters and marks.")),
    "json": (bool, opt(False, "--json", help="Print one JSON object.")),
    "quiet": (bool, opt(False, "-q", "--quiet", help="Print nothing but errors.")),
    # what is asked
    "at": (Texts, opt(None, "--at", metavar="DEG", help="Driver value instead of the scene's, in the driver's unit; "
                                                        "LINK=VALUE names the driver.")),
    "position": (NoText, opt(None, "--position", metavar="NAME",
                             help="The position of this name, of [positions], instead of --at.")),
    "find": (Texts, opt(None, "--find", metavar="SYMBOL",
                        help="Ask for this only (v_D, omega_3, ...); may be repeated.")),
    "instrument": (str, opt("exact", "--instrument", metavar="exact|cad|pencil", help="What draws and reads.")),
    "seed": (int, opt(0, "--seed", help="Seed of the pencil's errors.")),
    "seed of handout": (int, opt(0, "--seed", help="Seed of the variants.")),
    "figure": (Texts, opt(None, "--figure", metavar="NAME",
                          help="Draw this figure only (velocity, sheet, ...); may be repeated.")),
    "driver": (str, opt("", "--driver", metavar="LINK",
                        help="With --figure structure: another driver beside the first.")),
    "beside": (Texts, opt(None, "--beside", metavar="NAME|DEG",
                          help="With --figure polygons: a position; two or more.")),
    "centrode": (NoText, opt(None, "--centrode", metavar="LINK",
                             help="The centrodes of a link over a turn instead.")),
    "point": (str, opt("", "--point", metavar="P", help="With --centrode: the path of this point.")),
    "motion": (bool, opt(False, "--motion",
                         help="Centres in motion with their paths too: centres-motion.svg, which plays.")),
    "step": (float, opt(1.0, "--step", metavar="DEG", help="Degrees between two rows of cam.csv.")),
    "answers": (NoPath, opt(None, "--answers", metavar="FILE.csv",
                            help="A row for each person, symbols as heads, values in scene units.")),
    "variants of audit": (NoPath, opt(None, "--variants", metavar="DIR",
                                      help="Folder of the problem set, for answers with a column variant.")),
    "grading": (str, opt("", "--grading", metavar="equations=20,drawing=30,values=50",
                         help="Points, also by symbol.")),
    # over a turn, over designs
    "sweep": (NoNumber, opt(None, "--sweep", metavar="N", help="N positions over a turn of the driver.")),
    "loops": (bool, opt(False, "--loops", help="Print the vector loops: projections and matrix equations, LaTeX too.")),
    "positions": (NoNumber, opt(None, "--positions", metavar="12|36|N", help="Rows of the table over a turn of the "
                                "driver; 36 if not given, or as many as the scene's positions.")),
    "set": (Texts, opt(None, "--set", metavar="KEY=VALUES", help="Designs: links.1.length=40:60:21 (a grid), "
                       "=40,50,60 (a list); several give every combination.")),
    "designs": (NoPath, opt(None, "--designs", metavar="FILE.csv", help="Designs: a CSV file whose head names keys.")),
    "workers": (NoNumber, opt(None, "--workers", metavar="N",
                              help="Processes; as many as there are cores if long.")),
    "scheduler": (NoText, opt(None, "--scheduler", metavar="ADDRESS", help="Run on a Dask cluster (extra cluster).")),
    "measured": (NoPath, opt(None, "--measured", metavar="FILE.csv",
                             help="Values measured elsewhere (heads: at, symbols), to lie over the curves.")),
    "differentiate": (Texts, opt(None, "--differentiate", metavar="QUANTITY",
                                 help="Differentiated on paper (s_6/1, theta_4).")),
    "integrate": (Texts, opt(None, "--integrate", metavar="QUANTITY", help="Integrated on paper (v_6/1, omega_4).")),
    "repeats": (int, opt(5, "--repeats", metavar="N", help="Runs of each method; the best counts.")),
    # papers
    "positions of handout": (NoNumber, opt(None, "--positions", metavar="N", help="Positions of the driver on the "
                                           "page; 12 if not given, 6 with more than ten moving links.")),
    "variants": (NoNumber, opt(None, "--variants", metavar="N",
                               help="A set of N problems with other numbers instead.")),
    "rows": (NoPath, opt(None, "--rows", metavar="FILE.csv", help="A set of problems, one for each row of data.")),
    "workers of handout": (NoNumber, opt(None, "--workers", metavar="N",
                                         help="Processes for a set; as many as there are cores.")),
    "export": (str, opt("", "--export", metavar="moodle,gift,prairielearn", help="Questions for learning platforms.")),
    "template": (str, opt("papers", "--template", metavar="papers|course-design", help="What is written.")),
    "students": (NoPath, opt(None, "--students", metavar="NAMES.csv", help="Of a course design: a report for each "
                             "(heads: name, id, scheme, position; 姓名, 学号, 方案, 位置).")),
    # files of scenes
    "copy": (bool, opt(False, "--copy", help="Write the scene out to start from.")),
    "schema": (bool, opt(False, "--schema", help="Print the JSON schema of scene files, for editors.")),
    "new": (NoText, opt(None, "--new", metavar="KIND",
                        help="A new commented scene: four-bar, slider-crank, guide-bar, ...")),
    "set of new": (Texts, opt(None, "--set", metavar="NAME=VALUE",
                              help="With --new: a length (crank=150); asked for otherwise.")),
    "lossy": (bool, opt(False, "--lossy", help="Leave out what cannot be carried over, and name it.")),
    "port": (int, opt(0, min=0, max=65535, help="Port to listen on; a free one if 0.")),
    "browser": (bool, opt(True, help="Open the page in the browser.")),
}  # fmt: skip
"""Type, and declaration with default and help, by name; "out of check" is the option ``out`` as ``check`` has it."""


class Given(SimpleNamespace):
    """What a command was called with, by the names of its options."""

    @property
    def values(self) -> At:
        """Driver values, or the name of a position."""
        return driver_values(getattr(self, "at", None), getattr(self, "position", None))

    @property
    def formats(self) -> list[str]:
        return split_words(self.format)

    def call(self, function: Callable[..., T], **others: Any) -> T:
        """What a public function makes of what was given: each of its parameters is the option of that name, and keeps
        its default where nothing was given; files are written later.

        Parameters
        ----------
        others : of the function, what the options do not say as it takes them
        """
        first, *names = inspect.signature(function).parameters
        given = {**vars(self), "at": self.values, "language": self.lang, "figures": getattr(self, "figure", None)}
        wishes = {name: given[name] for name in names if name != "out" and given.get(name) not in (None, "", [])}
        if "formats" in names:
            wishes["formats"] = self.formats
        return function(given[first], **wishes | others)

    @property
    def speaks(self) -> bool:
        """Whether it prints for people."""
        return not self.json and not self.quiet


def command(*names: str) -> Callable[[Callable[[Given], None]], Callable[..., None]]:
    """Make a command of a function of what was given.

    Parameters
    ----------
    names : of its options in `OPTIONS`, in the order of the help
    """
    parameters = [
        inspect.Parameter(name.split()[0], inspect.Parameter.KEYWORD_ONLY, default=declared, annotation=kind)
        for name, (kind, declared) in ((name, OPTIONS[name]) for name in names)
    ]

    def made(run: Callable[[Given], None]) -> Callable[..., None]:
        @wraps(run)
        def called(**given: Any) -> None:
            run(Given(**given))

        called.__annotations__ = {}
        called.__signature__ = inspect.Signature(parameters)  # type: ignore[attr-defined]
        return called

    return made


def split_words(words: str) -> list[str]:
    """Words between commas: formats.

    >>> split_words("svg, PDF,")
    ['svg', 'pdf']
    """
    return [word.strip().lower() for word in words.split(",") if word.strip()]


def driver_values(at: list[str] | None, position: str | None = None) -> At:
    """Driver values as given on the command line: DEG, or LINK=DEG; or the name of a position.

    >>> driver_values(["50"]), driver_values(["1=50", "2=30"])
    (50.0, {'1': 50.0, '2': 30.0})
    """
    if position is not None:
        if at:
            raise CallError.of("--position", "stands beside at of nothing", "write one of the two")
        return position
    if not at:
        return None
    named: dict[str, float] = {}
    for text in at:
        name, _, number = text.rpartition("=")
        try:
            value = float(number)
        except ValueError:
            raise CallError.of(f"--at {text}", "is no number", "write at 50 or at 1 50", number=number) from None
        if name in named:
            raise CallError.of("--at", "is given twice for one driver", "write at 1 50 at 2 30", text=text)
        named[name] = value
    if len(named) > 1 and "" in named:
        raise CallError.of("--at", "a bare value beside named ones", "write at 1 50 at 2 30")
    return named.get("", named)


def named_numbers(texts: list[str], wrong: Callable[[str, str], Problem]) -> dict[str, float]:
    """Numbers by name, as ``NAME=VALUE`` gives them.

    Parameters
    ----------
    wrong : the problem of a text whose number is none
    """
    found: dict[str, float] = {}
    for text in texts:
        name, _, number = text.partition("=")
        try:
            found[name.strip()] = float(number)
        except ValueError:
            raise CallError(wrong(text, number)) from None
    return found


def processes(workers: int | None) -> int | None:
    """How many processes: as many as there are cores, if not told."""
    return workers if workers is not None else os.cpu_count()
