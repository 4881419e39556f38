"""Every argument and option of the command line, declared once; a command is a function of the given values, with the
names of its options."""

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

T = TypeVar("T")
At = float | str | dict[str, float] | None
"""Driver values as public functions take them."""
Texts = list[str] | None
NoText, NoPath, NoNumber = str | None, Path | None, int | None

OPTIONS: dict[str, tuple[Any, str, str]] = {
    # arguments
    "scene": (..., "SCENE", "A scene file, or the name of a scene that comes along."),
    "scene of open": ("", "", "A scene file, a folder of them, a scene that comes along, or a link."),
    "file of design": (..., "FILE", "A design file, or the name of one that comes along."),
    "source": (..., "FILE", "A file of Linkage, pyslvs, pylinkage, GeoGebra or PMKS, a link of PMKS+, or a scene."),
    "name": (NoText, "", "A scene that comes along: print its text."),
    "file": (NoPath, "", "With --copy: where to write it; NAME.toml here if not given."),
    # what is written where
    "out": (NoPath, "DIR", "Folder for the files; ./NAME if not given."),
    "out of centres": (NoPath, "DIR", "Folder for the files; ./NAME if not given, none with --json."),
    "out of check": (NoPath, "DIR", "Folder for readings.csv and report.txt."),
    "out of audit": (NoPath, "DIR", "Folder for audit.csv."),
    "out of solve": (NoPath, "DIR", "Folder for solution.json."),
    "out of convert": (NoPath, "FILE", "What to write: .toml, .linkage2, .pyslvs, .json; printed if not given."),
    "out of speed-accuracy": (Path("speed-accuracy"), "DIR", "Folder for the chart (SVG, CSV); ./speed-accuracy."),
    "out of stability": (Path("stability"), "DIR", "Folder for the charts (SVG, CSV); ./stability."),
    "format": ("svg", "svg,pdf,png,dxf", "Formats of the figures."),
    "format of handout": ("html,pdf", "html,pdf", "Formats of the papers."),
    "format of speed-accuracy": ("svg", "svg,pdf,png", "Formats of the chart."),
    "format of stability": ("svg", "svg,pdf,png", "Formats of the charts."),
    "text": ("glyphs", "glyphs|outlines", "Letters of an SVG: with their glyphs, or as paths (Inkscape, CAD)."),
    "text of handout": ("glyphs", "", ""),
    "lang": (NoText, "|".join(LANGUAGES), "Language of the figures and the report."),
    "lang of sheets": (NoText, "|".join((*LANGUAGES, BOTH)), "Language of what is drawn and written."),
    "convention": (NoText, "chinese|us|british|russian", "Letters and marks."),
    "json": (False, "", "Print one JSON object."),
    "quiet": (False, "", "Print nothing but errors."),
    # what is asked
    "at": (Texts, "DEG", "Driver value instead of the scene's, in the driver's unit; LINK=VALUE names the driver."),
    "position": (NoText, "NAME", "The position of this name, of [positions], instead of --at."),
    "find": (Texts, "SYMBOL", "Ask for this only (v_D, omega_3, ...); may be repeated."),
    "instrument": ("exact", "exact|cad|pencil", "What draws and reads."),
    "seed": (0, "", "Seed of the pencil's errors."),
    "seed of handout": (0, "", "Seed of the variants."),
    "figure": (Texts, "NAME", "Draw this figure only (velocity, sheet, ...); may be repeated."),
    "driver": ("", "LINK", "With --figure structure: another driver beside the first."),
    "beside": (Texts, "NAME|DEG", "With --figure polygons: a position; two or more."),
    "centrode": (NoText, "LINK", "The centrodes of a link over a turn instead."),
    "point": ("", "P", "With --centrode: the path of this point."),
    "motion": (False, "", "Centres in motion with their paths too: centres-motion.svg, which plays."),
    "step": (1.0, "DEG", "Degrees between two rows of cam.csv."),
    "answers": (NoPath, "FILE.csv", "A row for each person, symbols as heads, values in scene units."),
    "variants of audit": (NoPath, "DIR", "Folder of the problem set, for answers with a column variant."),
    "grading": ("", "equations=20,drawing=30,values=50", "Points, also by symbol."),
    # over a turn, over designs
    "sweep": (NoNumber, "N", "N positions over a turn of the driver."),
    "loops": (False, "", "Print the vector loops: projections and matrix equations, LaTeX too."),
    "positions": (NoNumber, "12|36|N", "Rows of the table over a turn of the driver; 36 if not given, or as many as "
                                       "the scene's positions."),
    "set": (Texts, "KEY=VALUES", "Designs: links.1.length=40:60:21 (a grid), =40,50,60 (a list); several give every "
                                 "combination."),
    "designs": (NoPath, "FILE.csv", "Designs: a CSV file whose head names keys."),
    "workers": (NoNumber, "N", "Processes; as many as there are cores if long."),
    "scheduler": (NoText, "ADDRESS", "Run on a Dask cluster (extra cluster)."),
    "measured": (NoPath, "FILE.csv", "Values measured elsewhere (heads: at, symbols), to lie over the curves."),
    "differentiate": (Texts, "QUANTITY", "Differentiated on paper (s_6/1, theta_4)."),
    "integrate": (Texts, "QUANTITY", "Integrated on paper (v_6/1, omega_4)."),
    "repeats": (5, "N", "Runs of each method; the best counts."),
    # papers
    "positions of handout": (NoNumber, "N", "Positions of the driver on the page; 12 if not given, 6 with more than "
                                            "ten moving links."),
    "variants": (NoNumber, "N", "A set of N problems with other numbers instead."),
    "rows": (NoPath, "FILE.csv", "A set of problems, one for each row of data."),
    "workers of handout": (NoNumber, "N", "Processes for a set; as many as there are cores."),
    "export": ("", "moodle,gift,prairielearn", "Questions for learning platforms."),
    "template": ("papers", "papers|course-design", "What is written."),
    "students": (NoPath, "NAMES.csv", "Of a course design: a report for each (heads: name, id, scheme, position; 姓名, "
                                      "学号, 方案, 位置)."),
    # files of scenes
    "copy": (False, "", "Write the scene out to start from."),
    "schema": (False, "", "Print the JSON schema of scene files, for editors."),
    "new": (NoText, "KIND", "A new commented scene: four-bar, slider-crank, guide-bar, ..."),
    "set of new": (Texts, "NAME=VALUE", "With --new: a length (crank=150); asked for otherwise."),
    "lossy": (False, "", "Leave out what cannot be carried over, and name it."),
    "port": (0, "", "Port to listen on; a free one if 0."),
    "browser": (True, "", "Open the page in the browser."),
}  # fmt: skip
"""The default, whose type a value has, or the type where nothing is the default; what stands for the value; the help;
by name: "out of check" is the option ``out`` as ``check`` has it."""
ARGUMENTS = ("scene", "scene of open", "file of design", "source", "name", "file")
FLAGS = {"out": ("-o", "--out"), "quiet": ("-q", "--quiet"), "browser": ()}
MORE: dict[str, dict[str, Any]] = {"port": {"min": 0, "max": 65535}, "text of handout": {"hidden": True}}


def _declared(name: str) -> inspect.Parameter:
    """An argument or an option as a parameter of a command."""
    value, metavar, told = OPTIONS[name]
    empty, word = value in (Texts, NoText, NoPath, NoNumber), name.split()[0]
    default = None if empty else value
    kind = value if empty else str if value is ... else Path if isinstance(value, Path) else type(value)
    how: dict[str, Any] = {"metavar": metavar or None, "help": told or None, **MORE.get(name, {})}
    if name in ARGUMENTS:
        declared = typer.Argument(default, **how)
    else:
        declared = typer.Option(default, *FLAGS.get(word, (f"--{word}",)), **how)
    return inspect.Parameter(word, inspect.Parameter.KEYWORD_ONLY, default=declared, annotation=kind)



class Given(SimpleNamespace):
    """The values given to a command, by the names of its options."""

    @property
    def values(self) -> At:
        """Driver values, or the name of a position."""
        return driver_values(getattr(self, "at", None), getattr(self, "position", None))

    @property
    def formats(self) -> list[str]:
        return split_words(self.format)

    def call(self, function: Callable[..., T], **others: Any) -> T:
        """The result of a public function for the given values: each of its parameters is the option of that name, with
        its default where no value was given; files are written later.

        Parameters
        ----------
        others : values of parameters that differ from their options
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
    """Make a command of a function of given values.

    Parameters
    ----------
    names : of its options in `OPTIONS`, in the order of the help
    """
    parameters = [_declared(name) for name in names]

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
    """Driver values of the command line: DEG, or LINK=DEG; or the name of a position.

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
    wrong : the problem of a text without a number
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
    """The number of processes, by default the number of cores."""
    return workers if workers is not None else os.cpu_count()
