"""All commands: each calls the public function of its name with the given values, prints the result for people or for
programs, and leaves with its status."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

import graphkin
from graphkin.cli.options import Given, command, named_numbers, processes, split_words
from graphkin.cli.output import (
    answering,
    asked_languages,
    complain,
    finish,
    print_failed,
    print_json,
    print_paths,
    print_table,
    progress_bar,
    show,
    show_unused,
)
from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.words import Phrase, class_of, languages, say, word

if TYPE_CHECKING:
    from graphkin.api.checked import Checked
    from graphkin.api.classroom.course_designs import CourseDesigns
    from graphkin.api.classroom.handouts import Handout
    from graphkin.api.solved import Solved

# drawings

UNCHECKED = {"ok": False, "status": "", "why": "", "readings": []}
"""What a program reads where there is nothing to check."""


@command(
    "scene", "at", "position", "find", "out of check", "instrument", "seed", "lang", "convention", "json", "quiet"
)
def check(given: Given) -> None:
    """Measure the drawn diagrams and compare every reading with the analytic solver."""
    from graphkin.api.arguments import known_words
    from graphkin.files import write_files

    known_words(language=given.lang, convention=given.convention, instrument=given.instrument)
    with answering({"instrument": given.instrument, **UNCHECKED}):
        checked = given.call(graphkin.check)
    language = given.lang or checked.mechanism.question.sheet.language
    if given.out is not None:
        from graphkin.api.report_text import report_text

        checked.write(given.out)
        write_files(given.out, {"report.txt": report_text(checked, language).encode()})
    _tell_check(checked, language, given)


def _tell_check(checked: Checked, language: str, given: Given) -> None:
    """Print a check, and leave with its status."""
    if given.json:
        print_json(checked.data)
    elif not given.quiet:
        from graphkin.api.arguments import passed_words
        from graphkin.api.report_text import contact_lines, lever_lines, plain_said, reading_words, verdict

        marks = {True: "ok", False: "off", None: "?"}
        heads = [word(key, language) for key in ("quantity", "on paper", "measured", "exact", "unit")]
        print_table([*heads, ""], [[*cells, marks[ok]] for *cells, ok in reading_words(checked)], right=(1, 2, 3))
        for line in (*lever_lines(checked, language), *contact_lines(checked, language)):
            show(line)
        for note in (*checked.sheet.notes, *filter(None, (checked.advice,))):
            show(plain_said(note, language))
        for said in passed_words(checked.mechanism, checked.passed):
            show(say(said, language))
        show(verdict(checked, language))
    if not checked.ok:
        wrong = any(row.ok is False for row in checked.report.rows)
        raise typer.Exit(1 if wrong and checked.complete else 3)


@command(
    "scene", "out", "format", "at", "position", "find", "lang of sheets", "convention", "instrument", "seed", "figure",
    "text", "driver", "beside", "json", "quiet",
)
def draw(given: Given) -> None:
    """Draw the mechanism, the velocity and the acceleration polygon; measure and check them."""
    from graphkin.api.arguments import known_words

    known_words(given.formats, text=given.text)
    with answering({"instrument": given.instrument, **UNCHECKED}):
        drawn = given.call(graphkin.draw)
        paths = drawn.write(given.out, given.formats, given.text)
    complain(*(Problem(f"figure {name}", why) for name, why in drawn.not_drawn.items()))
    if given.speaks:
        print_paths(paths)
    _tell_check(drawn.checked, languages(given.lang or drawn.mechanism.question.sheet.language)[0], given)


@command(
    "scene", "answers", "at", "position", "out of audit", "variants of audit", "grading", "lang", "json", "quiet"
)
def audit(given: Given) -> None:
    """Judge the scene's printed values, or people's answers: right, within drafting accuracy, or wrong and why."""

    def wrong(text: str, _: str) -> Problem:
        return Problem("grading", f'"{text[:40]}"', "write equations 20 drawing 30 values 50")

    points = named_numbers([text for text in map(str.strip, given.grading.split(",")) if text], wrong) or None
    audited = given.call(graphkin.audit, grading=points)
    paths = audited.write(given.out) if given.out is not None else []
    if given.speaks:
        first = len(audited.heads) - 7
        if audited.rows or not audited.scans:
            print_table(audited.heads, audited.rows, right=(first + 1, first + 2, first + 4))
        if audited.scans:
            show("\n".join(audited.scan_lines))
        for summary in (audited.students, audited.matrix) if audited.is_class else ():
            show("")
            print_table(list(summary.heads), [list(row) for row in summary.texts()])
        if paths:
            print_paths(paths)
    show_unused(audited.unused)
    finish(given, audited)


@command(
    "scene", "out of centres", "format", "text", "at", "position", "centrode", "point", "motion", "lang of sheets",
    "convention", "json", "quiet",
)
def centres(given: Given) -> None:
    """All instant centres, how each was found, and the velocities by centres."""
    from graphkin.api.arguments import known_words
    from graphkin.api.centred import centres_text

    known_words(given.formats, text=given.text)
    if given.point and given.centrode is None:
        raise CallError.of("--point", "without centrode", "write centrode link point p")
    if given.motion and given.centrode is not None:
        raise CallError.of("--motion", "stands beside centrode", "write one of the two")
    if given.centrode is not None:

        rolled = given.call(graphkin.centrodes, link=given.centrode)
        finish(given, rolled, rolled.write(given.out, given.formats, given.text), files=True)
        return
    with answering({"links": [], "centres": {}, "ok": False}):
        centred = given.call(graphkin.centres)
    none_wanted = given.json and given.out is None
    paths = [] if none_wanted else centred.write(given.out, given.formats, given.text, given.motion)
    if given.speaks:
        print_paths(paths)
        heads, rows, sentences = centres_text(centred)
        print_table(heads, rows)
        show("\n".join(sentences))
    finish(given, centred)


@command("file of design", "out", "format", "lang of sheets", "instrument", "seed", "json", "quiet")
def design(given: Given) -> None:
    """Find the lengths of a mechanism for what it shall do: drawn, measured, checked; write it as a scene."""
    with answering({"ok": False, "status": "", "why": "", "lengths": {}, "readings": []}):
        designed = given.call(graphkin.design)
        paths = designed.write(given.out, given.formats)
    if given.speaks:
        language = languages(given.lang or designed.given.sheet.language)[0]
        print_paths(paths)
        rows = [
            [row.symbol, f"{row.on_paper:.3f}", f"{row.measured:.7g}", f"{row.exact:.7g}", designed.given.units.length,
             "ok" if row.ok else "off"]
            for row in designed.rows
        ]
        heads = [word(key, language) for key in ("length found", "on paper", "measured", "exact", "unit")]
        print_table([*heads, ""], rows, right=(1, 2, 3))
        confirmed = [
            [say(wish.what, language), f"{wish.asked:.7g}", f"{wish.found:.7g}", wish.unit, "ok" if wish.ok else "off"]
            for wish in designed.confirmed
        ]
        print_table([word("confirmed", language), word("given wish", language), "", "", ""], confirmed, right=(1, 2))
        for sentence in designed.sentences(language):
            typer.echo(sentence)
    finish(given, designed)


@command("scene", "out", "format", "lang of sheets", "step", "json", "quiet")
def cam(given: Given) -> None:
    """Cams drawn by inversion: pressure angles, curvature, undercutting, profile as CSV and DXF; discs measured."""
    with answering({"ok": False, "status": "", "why": "", "cams": {}}):
        cams = given.call(graphkin.cam)
        paths = cams.write(given.out, given.formats)
    if given.speaks:
        print_paths(paths)
        language = languages(given.lang or cams.mechanism.question.sheet.language)[0]
        show("\n".join(cams.sentences(language)))
    finish(given, cams)


# the solver alone


@command(
    "scene", "at", "position", "sweep", "loops", "out of solve", "lang", "convention", "instrument", "find", "json",
    "quiet",
)
def solve(given: Given) -> None:
    """The analytic solution alone, at one position or over a turn."""
    from graphkin.api.arguments import known_words
    from graphkin.api.solved import refused
    from graphkin.files import write_files

    known_words(language=given.lang, convention=given.convention, instrument=given.instrument)
    values = given.values
    with answering(lambda error: refused(given.scene, values, error)):
        solved = given.call(graphkin.solve)
    if given.out is not None:
        write_files(given.out, {"solution.json": solved.json()})
    drawn = solved.loops(given.lang, given.convention) if given.loops and solved.ok else None
    if given.json and not solved.ok:
        problem = Problem(solved.mechanism.name, solved.said)
        print_failed(str(solved.first.motion.status[0]), [problem], solved.data)
    elif given.json and drawn:
        print_json({**solved.data, "loops": drawn.data})
    elif given.json:
        for piece in solved.json():
            typer.echo(piece.decode(), nl=False)
    elif not given.quiet and drawn:
        show(f"{drawn.plain}\n\n{drawn.latex}")
    elif not given.quiet:
        _print_solution(solved, given.lang)
    if not solved.ok:
        complain(solved.said)
        raise typer.Exit(3)


def _print_solution(solved: Solved, lang: str | None) -> None:
    from graphkin.api.arguments import passed_words
    from graphkin.api.solved import solution_tables
    scene, blocks = solved.mechanism, solved.blocks()
    head: Mapping[str, Any] = solved.head
    first = next(blocks)
    language = lang or scene.question.sheet.language
    show(f"{scene.question.title_in(language)}   F = {head['mobility']}")
    for group, assembly in zip(first.motion.structure.groups, first.motion.assembly, strict=True):
        gaps = {"links": group.named, "order": class_of(group.order), "assembly": assembly}
        larger = Phrase("solved larger group", **gaps)
        show(say(Phrase("solved group", kind=group.kind, **gaps) if group.order == 2 else larger, language))
    for said in passed_words(scene, first.motion.passed):
        show(say(said, language))
    for some in (first, *blocks):
        for values, why, tables in solution_tables(some, language):
            show("")
            show(say(Phrase("solved driver", drivers=values), language))
            if why:
                show(say(why, language))
                continue
            for table in tables:
                print_table(*table)
    if (without := solved.without_forces) and not solved.find:
        show(say(without, language))


@command(
    "scene", "out", "positions", "set", "designs", "workers", "scheduler", "measured", "differentiate", "integrate",
    "format", "text", "at", "find", "lang", "convention", "json", "quiet",
)
def sweep(given: Given) -> None:
    """Tables and motion diagrams over a turn, limit positions, strokes and K; and the same over designs."""
    from graphkin.drawing.chart import leave_undocumented
    from graphkin.scene import mechanism_of

    target = given.out if given.out is not None else Path(mechanism_of(given.scene).name)
    leave_undocumented()
    with (
        answering({}),
        progress_bar(given.speaks, target) as progress,
    ):
        swept = given.call(
            graphkin.sweep, out=target, designs=_replaced(given.set or ()), designs_file=given.designs,
            progress=progress, workers=None if given.scheduler else processes(given.workers),
        )
    outcomes = swept.by_design
    wrong = all(outcome.status == "wrong scene" for outcome in outcomes)
    if given.json and not swept.ok:
        status, why = outcomes[0].status, outcomes[0].why
        print_failed("scene" if wrong else status, [Problem(swept.mechanism.name, why)], swept.data)
    elif given.json:
        print_json(swept.data)
    elif not given.quiet:
        show(swept.text)
        print_paths(sorted(swept.paths))
    if not swept.ok:
        if wrong:  # the call is at fault, not the mechanism
            complain(Phrase("where and what", where="--set, --designs", found=outcomes[0].why))
        complain(Phrase("no position could be solved designs.csv or table.csv"))
        raise typer.Exit(2 if wrong else 3)


def _replaced(given: Iterable[str]) -> dict[str, str]:
    """Designs as given on the command line: KEY=VALUES."""
    designs: dict[str, str] = {}
    for text in given:
        key, sign, values = text.partition("=")
        if not sign or not key.strip():
            raise CallError.of(f"--set {text}", "says no key or no values", "write set links.1.length 40 60 21")
        if key.strip() in designs:
            raise CallError.of(f"--set {text}", "the key is given twice", "write key 40 50 60")
        designs[key.strip()] = values
    return designs


@command("scene", "out of speed-accuracy", "repeats", "format of speed-accuracy", "lang", "json", "quiet")
def speed_accuracy(given: Given) -> None:
    """Cost of a position against the largest error, for all methods, measured on this machine."""
    race = given.call(graphkin.speed_accuracy)
    finish(given, race, race.write(given.out, given.formats))


@command("out of stability", "format of stability", "lang", "json", "quiet")
def stability(given: Given) -> None:
    """Errors beside every kind of singular position: how fast they grow, where methods stop and how they say so."""
    growth = graphkin.stability(language=given.lang or "en")
    finish(given, growth, growth.write(given.out, given.formats))


# papers

TEMPLATES = ("papers", "course-design")


@command(
    "scene", "out", "format of handout", "at", "position", "find", "lang of sheets", "convention",
    "positions of handout", "variants", "seed of handout", "rows", "workers of handout", "export", "template",
    "students", "text of handout", "json", "quiet",
)
def handout(given: Given) -> None:
    """Problem sheet, worked solution with every step, and answer key; a set of them with other numbers; or reports."""
    from graphkin.scene.designs import is_design

    if given.text != "glyphs":
        raise CallError.of("text", "with papers", "their pdf has its letters with it and", text=given.text,
                           scene=given.scene)
    if given.template not in TEMPLATES:
        raise CallError.of("template", f'"{given.template}"', did_you_mean(given.template, TEMPLATES))
    if given.template == "course-design":
        if given.export:
            raise CallError.of("template course-design", "with export", "leave one of them out")
        _papers(given, graphkin.course_design)
        return
    if given.students is not None:
        raise CallError.of("students", "without a course design", "add template course-design")
    if is_design(given.scene):
        _design(given)
    elif given.variants is not None or given.rows is not None:
        if given.at or given.positions is not None:
            raise CallError.of("variants", "with at or positions", "a set draws positions of its own one")
        _problem_set(given)
    else:
        _papers(given, graphkin.handout, exports=split_words(given.export))


def _papers(given: Given, function: Callable[..., Handout | CourseDesigns], **others: Any) -> None:
    """Write the papers that a public function makes; name the files, and deviations from the request."""
    with progress_bar(given.speaks) as progress:
        made = given.call(function, progress=progress, **others)
        paths = made.write(given.out)
    for note in made.notes:
        show(f"graphkin: {say(note, languages(given.lang or made.mechanism.question.sheet.language)[0])}", err=True)
    finish(given, made, paths, files=True)


NOT_OF_DESIGNS = ("at", "position", "find", "convention", "positions", "variants", "rows", "export")


def _design(given: Given) -> None:
    from graphkin.api.classroom.task_papers import write_design_papers

    refusal = Phrase("goes with a scene not with a design"), Phrase("leave it out")
    if wishes := [name for name in NOT_OF_DESIGNS if getattr(given, name) not in (None, "", [])]:
        raise CallError(*(Problem(f"--{name}", *refusal) for name in wishes))
    designed = graphkin.design(given.scene, language=given.lang)
    finish(given, designed, write_design_papers(designed, given.out, given.formats), files=True)


def _problem_set(given: Given) -> None:
    from graphkin.api.classroom.handouts import papers_of
    from graphkin.scene import mechanism_of

    target = given.out if given.out is not None else Path(mechanism_of(given.scene).name)
    papers = papers_of(given.scene, given.formats, given.lang, given.convention, split_words(given.export))
    with progress_bar(given.speaks, target) as progress:
        made = given.call(
            graphkin.problem_set, out=target, workers=processes(given.workers), render=papers, progress=progress
        )
    if given.json:
        print_json(made.data)
    elif not given.quiet:
        gaps = {"count": len(made.answers), "folder": target, "answers": target / "answers.csv"}
        spoken = languages(given.lang or mechanism_of(given.scene).question.sheet.language)[0]
        show(say(Phrase("problems in a folder with all answers", **gaps), spoken))
    show_unused(made.unused)
    for failure in made.failures:
        complain(Problem(failure.name, failure.why))
    if not made.ok:
        raise typer.Exit(min(failure.exit_code for failure in made.failures))


# files of scenes


@command("name", "file", "copy", "schema", "new", "set of new", "lang", "json", "quiet")
def scenes(given: Given) -> None:
    """List the scenes that come along, print one, copy one out, or begin a new one."""
    from graphkin import scene as room
    from graphkin.api.arguments import known_words

    known_words(language=given.lang)
    if given.set and given.new is None:
        raise CallError.of("--set", "without a new scene", "write scenes new kind")
    if given.new is not None:
        # the one name that is given is that of the file
        _begin(given, Path(given.name) if given.name is not None else given.file)
    elif given.schema:
        if not given.quiet:
            typer.echo(json.dumps(room.schema(), ensure_ascii=False, indent=2))
    elif given.name is not None:
        target = (given.file or Path(f"{given.name}.toml")) if given.copy else None
        _hand_out(given, room.library_text(given.name), target)
    elif given.copy:
        raise CallError.of("--copy", "no scene is named", "write graphkin scenes name copy")
    else:
        _list(given)


def _begin(given: Given, file: Path | None) -> None:
    """A new scene: missing values are asked for in a terminal, and the usual ones elsewhere."""
    from graphkin.scene.scene import NEW, new_scene

    def wrong(text: str, number: str) -> Problem:
        return Problem(f"--set {text}", "is no number", "write set crank 150", number=number)

    values = named_numbers(given.set or [], wrong)
    new_scene(given.new, values)
    if sys.stdin is not None and sys.stdin.isatty():
        for name, usual in NEW[given.new].items():
            if name not in values:
                values[name] = typer.prompt(name, default=usual, type=float, err=True)
    _hand_out(given, new_scene(given.new, values), file)


def _list(given: Given) -> None:
    scenes = graphkin.scenes()
    if given.json:
        print_json(scenes.data)
    if not given.speaks:
        return
    # without a wish that of the terminal
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    language = given.lang or ("zh" if locale.lower().startswith("zh") else "en")
    heads = [word(head, language) for head in ("scene in a list", "title in a list")]
    rows = [[n, z if language == "zh" else t, str(f)] for n, t, z, f in scenes.rows]
    print_table([*heads, "F"], rows, right=(2,))


def _hand_out(given: Given, text: str, path: Path | None) -> None:
    """Print the text of a scene, or write it where no file is yet."""
    if path is not None:
        from graphkin.files import whole_file, writing_to

        _must_be_new(path)
        with writing_to(str(path)), whole_file(path) as out:
            out.write(text.encode())
    if given.json:
        print_json({"text": text} if path is None else {"files": [str(path)]})
    elif path is None and not given.quiet:
        typer.echo(text, nl=False)
    elif path is not None and not given.quiet:
        print_paths([path])


def _must_be_new(path: Path) -> None:
    """Raises CallError where a file of that name is there."""
    if path.exists():
        raise CallError.of(str(path), "a file of that name is there already", "name another file")


@command("scene", "lang", "json", "quiet")
def explain(given: Given) -> None:
    """Say in words what was understood: links, joints, mobility, drivers, groups, assembly, units."""
    explained = given.call(graphkin.explain)
    if given.json and not explained.ok:
        print_failed(explained.status, [Problem(explained.mechanism.name, explained.why)], explained.data)
    elif given.json:
        print_json(explained.data)
    elif not given.quiet:
        show(explained.text)
    if not explained.ok:
        complain(explained.why)
        raise typer.Exit(explained.exit_code)


@command("source", "out of convert", "lossy", "lang of sheets", "json", "quiet")
def convert(given: Given) -> None:
    """Make a scene of another program's mechanism, or give a scene to another program."""
    if given.out is not None:
        _must_be_new(given.out)
    made = graphkin.convert(given.source, out=given.out, lossy=given.lossy)
    if given.json:
        print_json(made.data)
    elif given.out is None:
        typer.echo(made.text, nl=False)
    elif not given.quiet:
        print_paths([given.out])
    complain(*(Phrase("not carried over", part=part) for part in made.left))


@command("scene of open", "port", "browser", "lang of open")
def open_page(given: Given) -> None:
    """Edit a mechanism in the browser: text, form and figures together; drag points, build from nothing, print papers.

    The page is for this machine alone and lives until it is interrupted (Ctrl-C).
    """
    from graphkin.api.arguments import known_words
    from graphkin.board.answers import LINK, text_of_link
    from graphkin.board.server import Address, needs_live, serve
    from graphkin.board.shelf import Shelf

    known_words(language=given.lang)
    needs_live()
    linked = given.scene.startswith(LINK)
    shelf = Shelf(draft=text_of_link(given.scene)) if linked else Shelf.of(given.scene)

    def ready(address: Address) -> None:
        show("\n".join([address.url, *(word("ctrl-c ends it", each) for each in asked_languages(sys.argv[1:]))]))
        if given.browser:
            import webbrowser

            webbrowser.open(address.url)

    with suppress(KeyboardInterrupt):  # which is how it ends
        serve(shelf, given.port, ready, given.lang or "")
