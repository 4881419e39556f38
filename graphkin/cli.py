"""The command line: every command is a thin call of the public function of the same name."""

from __future__ import annotations

import json
import sys
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from graphkin import __version__
from graphkin.errors import CallError, GraphkinError, Problem, Unsolvable

if TYPE_CHECKING:
    from graphkin.api import Checked, Solved, SpeedAccuracy, Stability

__all__ = ["app", "main"]

app = typer.Typer(
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    help="Velocity and acceleration polygons of mechanisms: constructed, measured, checked, drawn.",
)

SceneArgument = Annotated[
    str, typer.Argument(metavar="SCENE", help="A scene file, or the name of a scene that comes along.")
]
AtOption = Annotated[
    list[str] | None,
    typer.Option(
        "--at",
        metavar="DEG",
        help="Driver value instead of the scene's, in the driver's unit; LINK=VALUE names the driver.",
    ),
]
FindOption = Annotated[
    list[str] | None,
    typer.Option("--find", metavar="SYMBOL", help="Ask for this only (v_D, omega_3, ...); may be repeated."),
]
JsonOption = Annotated[bool, typer.Option("--json", help="Print one JSON object.")]
QuietOption = Annotated[bool, typer.Option("-q", "--quiet", help="Print nothing but errors.")]
InstrumentOption = Annotated[
    str, typer.Option("--instrument", metavar="exact|cad|pencil", help="What draws and reads.")
]
ConventionOption = Annotated[
    str | None, typer.Option("--convention", metavar="chinese|us|british|russian", help="Letters and marks.")
]
SeedOption = Annotated[int, typer.Option("--seed", help="Seed of the pencil's errors.")]
LangOption = Annotated[
    str | None, typer.Option("--lang", metavar="en|zh", help="Language of the figures and the report.")
]


def _known_words(lang: str | None, convention: str | None, instrument: str = "exact") -> None:
    """Refuse common options that are no words of theirs, all of them together."""
    from graphkin.api.checked import INSTRUMENTS
    from graphkin.api.files import CONVENTIONS
    from graphkin.errors import did_you_mean
    from graphkin.words import LANGUAGES

    given = [
        ("lang", lang, LANGUAGES),
        ("convention", convention, CONVENTIONS),
        ("instrument", instrument, INSTRUMENTS),
    ]
    wrong = [Problem(o, f'"{w}"', did_you_mean(w, known)) for o, w, known in given if w is not None and w not in known]
    if wrong:
        raise CallError(*wrong)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"graphkin {__version__}")
        raise typer.Exit


@app.callback()
def _common(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version.")
    ] = False,
) -> None:
    pass


def main() -> None:
    """Run the command line; problems are said on stderr, one a line, and give the exit status."""
    for stream in (sys.stdout, sys.stderr):
        if hasattr(stream, "reconfigure"):
            stream.reconfigure(encoding="utf-8", errors="replace")
    try:
        app()
    except GraphkinError as error:
        _say(error)
        sys.exit(error.exit_code)
    except BrokenPipeError:
        sys.exit(0)


def _say(error: GraphkinError) -> None:
    for problem in error.problems:
        typer.echo(f"graphkin: {problem}", err=True)


def _dump(data: object) -> None:
    typer.echo(json.dumps(data, ensure_ascii=False, allow_nan=False))


def _values(at: list[str] | None) -> float | dict[str, float] | None:
    """Driver values as given on the command line: DEG, or LINK=DEG."""
    if not at:
        return None
    named: dict[str, float] = {}
    bare: list[float] = []
    for text in at:
        name, _, number = text.rpartition("=")
        try:
            value = float(number)
        except ValueError:
            raise CallError(Problem(f"--at {text}", f'"{number}" is no number', "write --at 50 or --at 1=50")) from None
        if name in named or (not name and bare):
            raise CallError(Problem("--at", f"{text} is given twice for one driver", "write --at 1=50 --at 2=30"))
        if name:
            named[name] = value
        else:
            bare.append(value)
    if bare and named:
        raise CallError(Problem("--at", "a bare value beside named ones", "write --at 1=50 --at 2=30"))
    return bare[0] if bare else named


@app.command()
def scenes(
    name: Annotated[str | None, typer.Argument(help="A scene that comes along: print its text.")] = None,
    file: Annotated[
        Path | None, typer.Argument(help="With --copy: where to write it; NAME.toml here if not given.")
    ] = None,
    copy: Annotated[bool, typer.Option("--copy", help="Write the scene out to start from.")] = False,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print the JSON schema of scene files, for editors.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """List the scenes that come along, print one, or copy one out."""
    from graphkin import scene as room

    if schema:
        typer.echo(json.dumps(room.schema(), ensure_ascii=False, indent=2))
    elif name is not None:
        text = room.library_text(name)
        if copy:
            _write_new(file or Path(f"{name}.toml"), text)
        else:
            typer.echo(text, nl=False)
    elif copy:
        raise CallError(Problem("--copy", "no scene is named", "write graphkin scenes NAME --copy"))
    else:
        from graphkin.api import scenes as listed

        found = listed()
        if as_json:
            _dump(found.data)
            return
        _table(["scene", "title", "", "F"], [[n, t, z, str(f)] for n, t, z, f in found.rows])


def _write_new(path: Path, text: str) -> None:
    if path.exists():
        raise CallError(Problem(str(path), "a file of that name is there already", "name another file"))
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CallError(Problem(str(path), f"cannot be written: {error.strerror}")) from None
    typer.echo(str(path))


@app.command()
def draw(
    scene: SceneArgument,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given.")
    ] = None,
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the figures.")] = "svg",
    at: AtOption = None,
    find: FindOption = None,
    lang: LangOption = None,
    convention: Annotated[
        str | None, typer.Option("--convention", metavar="chinese|us|british|russian", help="Letters and marks.")
    ] = None,
    instrument: InstrumentOption = "exact",
    seed: SeedOption = 0,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Draw the mechanism, the velocity and the acceleration polygon; measure and check them."""
    from graphkin.api import draw as drawing

    def run() -> Checked:
        wanted = [f.strip().lower() for f in formats.split(",") if f.strip()]
        drawn = drawing(scene, None, _values(at), find or None, wanted, lang, convention, instrument, seed)
        paths = drawn.write(out, wanted)
        if not as_json and not quiet:
            typer.echo("\n".join(str(p) for p in paths))
        return drawn.checked

    _report(run, as_json, quiet, lang)


@app.command()
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

    def run() -> Checked:
        checked = checking(scene, _values(at), find or None, instrument, seed)
        if out is not None:
            _write_check(out, checked, lang)
        return checked

    _known_words(lang, convention, instrument)
    _report(run, as_json, quiet, lang)


def _write_check(folder: Path, checked: Checked, lang: str | None) -> None:
    from graphkin.api.drawn import readings_csv
    from graphkin.api.files import write_files
    from graphkin.api.told import told

    report = told(checked, lang or checked.scene.sheet.language)
    write_files(folder, {"readings.csv": readings_csv(checked).encode(), "report.txt": report.encode()})


def _report(run: Callable[[], Checked], as_json: bool, quiet: bool, lang: str | None) -> None:
    """Print a check, and leave with the status that belongs to it."""
    from graphkin.api.told import show, verdict
    from graphkin.words import say

    try:
        checked = run()
    except Unsolvable as error:
        if as_json:
            _dump({"instrument": "exact", "ok": False, "status": error.status, "why": error.why, "readings": []})
        raise
    language = lang or checked.scene.sheet.language
    if as_json:
        _dump(checked.data)
    elif not quiet:
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
        _table(["quantity", "mm on paper", "measured", "exact", ""], rows, right=(1, 2, 3))
        for note in checked.sheet.notes:
            typer.echo(say(note, language, show))
        if checked.advice:
            typer.echo(say(checked.advice.phrase(), language, show))
        typer.echo(verdict(checked, language))
    if checked.sheet.stopped is not None:
        typer.echo(f"graphkin: {say(checked.sheet.stopped, language, show)}", err=True)
        if checked.report.missing or not checked.report.rows:
            raise typer.Exit(3)
    if not checked.ok:
        raise typer.Exit(1)


@app.command()
def solve(
    scene: SceneArgument,
    at: AtOption = None,
    sweep: Annotated[
        int | None, typer.Option("--sweep", metavar="N", help="N positions over a turn of the driver.")
    ] = None,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for solution.json.")] = None,
    lang: LangOption = None,
    convention: ConventionOption = None,
    instrument: InstrumentOption = "exact",
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """The analytic solution alone, at one position or over a turn."""
    from graphkin.api import solve as solving
    from graphkin.api.solved import refused

    _known_words(lang, convention, instrument)
    try:
        solved = solving(scene, _values(at), sweep)
    except Unsolvable as error:
        if as_json:
            _dump(refused(scene, _values(at), error))
        raise
    if out is not None:
        from graphkin.api.files import write_files

        text = json.dumps(solved.data, ensure_ascii=False, allow_nan=False) + "\n"
        write_files(out, {"solution.json": text.encode()})
    if as_json:
        _dump(solved.data)
    elif not quiet:
        _print_solution(solved, lang)
    if not solved.ok:
        first = solved.data["positions"][0]
        typer.echo(f"graphkin: {first['status']}: {first['why']}", err=True)
        raise typer.Exit(3)


@app.command()
def centres(
    scene: SceneArgument,
    out: Annotated[
        Path | None,
        typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given, none with --json."),
    ] = None,
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the figures.")] = "svg",
    at: AtOption = None,
    centrode: Annotated[
        str | None, typer.Option("--centrode", metavar="LINK", help="The centrodes of a link over a turn instead.")
    ] = None,
    point: Annotated[str, typer.Option("--point", metavar="P", help="With --centrode: the path of this point.")] = "",
    lang: LangOption = None,
    convention: Annotated[
        str | None, typer.Option("--convention", metavar="chinese|us|british|russian", help="Letters and marks.")
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """All instant centres, how each was found, and the velocities by centres."""
    from graphkin.api import centres as finding
    from graphkin.api import centrodes
    from graphkin.api.centres_told import told_centres

    wanted = [f.strip().lower() for f in formats.split(",") if f.strip()]
    if point and centrode is None:
        raise CallError(Problem("--point", "without --centrode", "write --centrode LINK --point P"))
    if centrode is not None:
        rolled = centrodes(scene, centrode, point, _values(at), None, wanted, lang, convention)
        paths = rolled.write(out, wanted)
        if not quiet:
            typer.echo("\n".join(str(p) for p in paths))
        if not rolled.ok:
            raise typer.Exit(1)
        return
    try:
        found = finding(scene, _values(at), None, wanted, lang, convention)
    except Unsolvable as error:
        if as_json:
            _dump({"links": [], "centres": {}, "ok": False, "status": error.status, "why": error.why})
        raise
    paths = [] if as_json and out is None else found.write(out, wanted)
    if as_json:
        _dump(found.data)
    elif not quiet:
        typer.echo("\n".join(str(p) for p in paths))
        told = told_centres(found)
        _table(told.heads, [list(row) for row in told.rows])
        typer.echo("\n".join(told.sentences))
    if not found.ok:
        raise typer.Exit(1)


_PARTS = ("links", "points", "slides")


def _print_solution(solved: Solved, lang: str | None) -> None:
    from graphkin.words import Phrase, say

    data, scene = solved.data, solved.motion.scene
    language = lang or scene.sheet.language
    heads = {k: say(Phrase(f"heads of {k}", (scene.units.length,)), language).split("|") for k in _PARTS}
    title = scene.title_in(language)
    typer.echo(f"{title}   F = {data['mobility']}")
    for group in data["groups"]:
        typer.echo(f"links {', '.join(group['links'])}: {group['kind']}, class {group['class']}; {group['assembly']}")
    for position in data["positions"]:
        typer.echo("")
        typer.echo("driver " + ", ".join(f"{k} = {v:.6g}" for k, v in position["driver"].items()))
        if position["status"] != "ok":
            typer.echo(f"{position['status']}: {position['why']}")
            continue
        _table(
            heads["links"],
            [[n, _deg(v["angle"]), _num(v["omega"]), _num(v["alpha"])] for n, v in position["links"].items()],
            right=(1, 2, 3),
        )
        _table(
            heads["points"],
            [
                [n, *(_pair(v[k]) for k in ("position", "velocity", "acceleration"))]
                for n, v in position["points"].items()
            ],
        )
        _table(
            heads["slides"],
            [_slide_row(n, v) for n, v in position["slides"].items()],
            right=(1, 2, 3),
        )


def _slide_row(name: str, slide: Mapping[str, Any]) -> list[str]:
    return [name, *(_num(slide[k]) for k in ("travel", "velocity", "acceleration")), _pair(slide["coriolis"])]


@app.command()
def audit(
    scene: SceneArgument,
    answers: Annotated[
        Path | None,
        typer.Option(
            "--answers", metavar="FILE.csv", help="A row for each person, symbols as heads, values in scene units."
        ),
    ] = None,
    at: AtOption = None,
    out: Annotated[Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for audit.csv.")] = None,
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Judge the scene's printed values, or people's answers: right, within drafting accuracy, or wrong and why."""
    from graphkin.api import audit as auditing

    audited = auditing(scene, answers, _values(at), lang)
    paths = audited.write(out) if out is not None else []
    if as_json:
        _dump(audited.data)
    elif not quiet:
        first = len(audited.heads) - 6
        _table(audited.heads, audited.rows, right=(first + 1, first + 2, first + 3))
        for path in paths:
            typer.echo(str(path))
    if not audited.ok:
        raise typer.Exit(1)


def _num(value: float) -> str:
    return f"{value:.6g}"


def _deg(value: float) -> str:
    return f"{value * 57.29577951308232:.6g}"


def _pair(value: list[float]) -> str:
    return f"{value[0]:.6g}, {value[1]:.6g}"


def _table(heads: list[str], rows: list[list[str]], right: tuple[int, ...] = ()) -> None:
    if not rows:
        return
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for i, head in enumerate(heads):
        table.add_column(head, justify="right" if i in right else "left", no_wrap=i != 1)
    for row in rows:
        table.add_row(*(Text(cell) for cell in row))
    console = Console()
    if not console.is_terminal:
        console = Console(width=160)
    console.print(table)


@app.command()
def sweep(
    scene: SceneArgument,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given.")
    ] = None,
    positions: Annotated[
        int, typer.Option("--positions", metavar="12|36|N", help="Rows of the table over a turn of the driver.")
    ] = 36,
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
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the figures.")] = "svg",
    at: AtOption = None,
    find: FindOption = None,
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Tables and motion diagrams over a turn, limit positions, strokes and K; and the same over designs."""
    from graphkin.api import sweep as sweeping
    from graphkin.api.turn_told import told_turn
    from graphkin.scene import read

    wanted = [f.strip().lower() for f in formats.split(",") if f.strip()]
    target = out if out is not None else Path(read(scene).name)
    try:
        with _bar(not as_json and not quiet) as progress:
            swept = sweeping(
                scene, target, positions, find or None, _values(at), _replaced(replace), designs, None,
                _processes(workers, scheduler), scheduler, wanted, lang, progress,
            )
    except Unsolvable as error:
        if as_json:
            _dump({"status": error.status, "why": error.why})
        raise
    except KeyboardInterrupt:
        typer.echo(f"graphkin: interrupted; what is done is kept in {target}, the same command goes on", err=True)
        raise
    if as_json:
        _dump(swept.data)
    elif not quiet:
        typer.echo(told_turn(swept))
        typer.echo("\n".join(str(p) for p in sorted(target.iterdir()) if not p.name.startswith(".")))
    if not swept.ok:
        typer.echo("graphkin: no position could be solved; designs.csv or table.csv says why", err=True)
        raise typer.Exit(3)


def _replaced(given: list[str] | None) -> dict[str, str]:
    """Designs as given on the command line: KEY=VALUES."""
    found: dict[str, str] = {}
    for text in given or []:
        key, sign, values = text.partition("=")
        if not sign or not key.strip():
            raise CallError(Problem(f"--set {text}", "says no key or no values", "write --set links.1.length=40:60:21"))
        if key.strip() in found:
            raise CallError(Problem(f"--set {text}", "the key is given twice", "write KEY=40,50,60"))
        found[key.strip()] = values
    return found


def _processes(workers: int | None, scheduler: str | None) -> int | None:
    import os

    return None if scheduler else workers if workers is not None else os.cpu_count()


@contextmanager
def _bar(shown: bool) -> Iterator[Callable[[int, int], None] | None]:
    """A progress bar on stderr, where that is a terminal and it takes longer than a second."""
    if not shown or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, Progress, TimeRemainingColumn

    columns = BarColumn(), MofNCompleteColumn(), TimeRemainingColumn()
    bar = Progress(*columns, console=Console(stderr=True), transient=True)
    task = bar.add_task("", total=None)
    started = time.monotonic()

    def tell(done: int, total: int) -> None:
        if time.monotonic() - started > 1.0 and not bar.live.is_started:
            bar.start()
        bar.update(task, completed=done, total=total)

    try:
        yield tell
    finally:
        bar.stop()


study = typer.Typer(no_args_is_help=True, help="The charts of the methods against each other.")
app.add_typer(study, name="study")


@study.command("speed-accuracy")
def speed_accuracy(
    scene: SceneArgument,
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder for the chart (SVG, CSV); ./speed-accuracy.")
    ] = Path("speed-accuracy"),
    repeats: Annotated[int, typer.Option("--repeats", metavar="N", help="Runs of each method; the best counts.")] = 5,
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the chart.")] = "svg",
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Cost of a position against the largest error, for all methods, measured on this machine."""
    from graphkin.api import speed_accuracy as racing

    _study(racing(scene, repeats, lang), out, formats, as_json, quiet)


@study.command("stability")
def stability(
    out: Annotated[
        Path, typer.Option("-o", "--out", metavar="DIR", help="Folder for the charts (SVG, CSV); ./stability.")
    ] = Path("stability"),
    formats: Annotated[str, typer.Option("--format", metavar="svg,pdf,png", help="Formats of the charts.")] = "svg",
    lang: LangOption = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Errors beside every kind of singular position: how fast they grow, where methods stop and how they say so."""
    from graphkin.api import stability as measuring

    _study(measuring(language=lang or "en"), out, formats, as_json, quiet)


def _study(found: SpeedAccuracy | Stability, out: Path, formats: str, as_json: bool, quiet: bool) -> None:
    paths = found.write(out, [f.strip().lower() for f in formats.split(",") if f.strip()])
    if as_json:
        _dump(found.data)
    elif not quiet:
        typer.echo("\n".join(str(p) for p in paths))


@app.command()
def handout(
    scene: SceneArgument,
    out: Annotated[
        Path | None, typer.Option("-o", "--out", metavar="DIR", help="Folder for the files; ./NAME if not given.")
    ] = None,
    formats: Annotated[str, typer.Option("--format", metavar="html,pdf", help="Formats of the papers.")] = "html,pdf",
    at: AtOption = None,
    find: FindOption = None,
    lang: Annotated[
        str | None, typer.Option("--lang", metavar="en|zh|both", help="Language of the papers.")
    ] = None,
    convention: ConventionOption = None,
    positions: Annotated[
        int, typer.Option("--positions", metavar="N", help="Positions of the driver on the page to step through.")
    ] = 24,
    variants: Annotated[
        int | None, typer.Option("--variants", metavar="N", help="A set of N problems with other numbers instead.")
    ] = None,
    seed: Annotated[int, typer.Option("--seed", help="Seed of the variants.")] = 0,
    rows: Annotated[
        Path | None, typer.Option("--rows", metavar="FILE.csv", help="A set of problems, one for each row of data.")
    ] = None,
    workers: Annotated[
        int | None, typer.Option("--workers", metavar="N", help="Processes for a set; as many as there are cores.")
    ] = None,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Problem sheet, worked solution with every step, and answer key; or a set of them with other numbers."""
    from graphkin.api import handout as handing
    from graphkin.words import say

    wanted = [f.strip().lower() for f in formats.split(",") if f.strip()]
    if variants is not None or rows is not None:
        _problem_set(scene, out, wanted, lang, convention, variants, seed, rows, workers, as_json, quiet)
        return
    made = handing(scene, None, _values(at), find or None, wanted, lang, convention, positions)
    paths = made.write(out)
    if as_json:
        _dump(made.data | {"files": [str(p) for p in paths]})
    elif not quiet:
        typer.echo("\n".join(str(p) for p in paths))
    for note in made.notes:
        typer.echo(f"graphkin: {say(note, 'zh' if made.lesson.language == 'zh' else 'en')}", err=True)
    if not made.ok:
        raise typer.Exit(1)


def _problem_set(
    scene: str, out: Path | None, formats: list[str], lang: str | None, convention: str | None, variants: int | None,
    seed: int, rows: Path | None, workers: int | None, as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    from graphkin.api import problem_set
    from graphkin.api.handed import papers_of
    from graphkin.scene import read

    target = out if out is not None else Path(read(scene).name)
    papers = papers_of(scene, formats, lang, convention)
    try:
        with _bar(not as_json and not quiet) as progress:
            made = problem_set(
                scene, variants, seed, rows, target, workers=_processes(workers, None), render=papers, progress=progress
            )
    except KeyboardInterrupt:
        typer.echo(f"graphkin: interrupted; what is done is kept in {target}, the same command goes on", err=True)
        raise
    if as_json:
        _dump(made.data)
    elif not quiet:
        typer.echo(f"{len(made.made.names)} problems in {target}, all answers in {target / 'answers.csv'}")
    for failure in made.made.failures:
        typer.echo(f"graphkin: {failure.name}: {failure.why}", err=True)
    if not made.ok:
        raise typer.Exit(3)
