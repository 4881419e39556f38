"""``graphkin handout``: problem sheet, worked solution and key, of one problem or of a set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from graphkin.cli.options import (
    AtOption,
    ConventionOption,
    FindOption,
    JsonOption,
    OutOption,
    PositionOption,
    QuietOption,
    SceneArgument,
    SheetLangOption,
    driver_values,
    processes,
    split_words,
)
from graphkin.cli.output import complain, print_json, print_paths, progress_bar, short_bar, tell, tell_unused
from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.words import Phrase

if TYPE_CHECKING:
    from graphkin.api.course_designs import CourseDesigns
    from graphkin.api.handouts import Handout

__all__ = ["handout"]

TEMPLATES = ("papers", "course-design")


def handout(
    scene: SceneArgument,
    out: OutOption = None,
    formats: Annotated[str, typer.Option("--format", metavar="html,pdf", help="Formats of the papers.")] = "html,pdf",
    at: AtOption = None,
    position: PositionOption = None,
    find: FindOption = None,
    lang: SheetLangOption = None,
    convention: ConventionOption = None,
    positions: Annotated[
        int | None,
        typer.Option(
            "--positions",
            metavar="N",
            help="Positions of the driver on the page; 12 if not given, 6 with more than ten moving links.",
        ),
    ] = None,
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
    export: Annotated[
        str, typer.Option("--export", metavar="moodle,gift,prairielearn", help="Questions for learning platforms.")
    ] = "",
    template: Annotated[
        str, typer.Option("--template", metavar="papers|course-design", help="What is written.")
    ] = "papers",
    students: Annotated[
        Path | None,
        typer.Option(
            "--students",
            metavar="NAMES.csv",
            help="Of a course design: a report for each (heads: name, id, scheme, position; 姓名, 学号, 方案, 位置).",
        ),
    ] = None,
    text: Annotated[str, typer.Option("--text", hidden=True)] = "glyphs",
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Problem sheet, worked solution with every step, and answer key; a set of them with other numbers; or reports."""
    from graphkin.api.handouts import handout as handing
    from graphkin.scene.designs import is_design

    wanted = split_words(formats)
    if text != "glyphs":
        raise CallError(
            Problem(
                "text", Phrase("with papers", text=text), Phrase("their pdf has its letters with it and", scene=scene),
            )
        )  # fmt: skip
    if template not in TEMPLATES:
        raise CallError(Problem("template", f'"{template}"', did_you_mean(template, TEMPLATES)))
    if template == "course-design":
        if export:
            raise CallError(Problem("template course-design", Phrase("with export"), Phrase("leave one of them out")))
        place = driver_values(at, position)
        drawn = variants, seed
        _course(scene, students, rows, out, place, find, wanted, lang, convention, positions, drawn, as_json, quiet)
        return
    if students is not None:
        raise CallError(Problem("students", Phrase("without a course design"), Phrase("add template course-design")))
    if is_design(scene):
        from graphkin.api.designed import design as designing
        from graphkin.api.task_papers import write_design_papers

        designed = designing(scene, None, ("svg",), lang)
        files = write_design_papers(designed, out, wanted)
        if as_json:
            print_json(designed.data | {"files": [str(path) for path in files]})
        elif not quiet:
            print_paths(files)
        return
    if variants is not None or rows is not None:
        if at or positions is not None:
            raise CallError(
                Problem("variants", Phrase("with at or positions"), Phrase("a set draws positions of its own one"))
            )
        _problem_set(
            scene,
            out,
            wanted,
            find,
            lang,
            convention,
            variants,
            seed,
            rows,
            workers,
            split_words(export),
            as_json,
            quiet,
        )
        return
    with short_bar(not as_json and not quiet) as progress:
        values = driver_values(at, position)
        made = handing(
            scene, None, values, find or None, wanted, lang, convention, positions, progress, split_words(export)
        )
        paths = made.write(out)
    _tell_written(made, paths, made.lesson.language, as_json, quiet)


def _course(
    scene: str, students: Path | None, rows: Path | None, out: Path | None,
    at: float | str | dict[str, float] | None, find: list[str] | None, formats: list[str], lang: str | None,
    convention: str | None, positions: int | None, drawn: tuple[int | None, int], as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    from graphkin.api.course_designs import course_design

    with short_bar(not as_json and not quiet) as progress:
        made = course_design(
            scene, students, rows, None, at, find or None, formats, lang, convention, positions, progress, *drawn
        )  # fmt: skip
        paths = made.write(out)
    _tell_written(made, paths, lang or made.mechanism.sheet.language, as_json, quiet)


def _tell_written(
    made: Handout | CourseDesigns, paths: Sequence[Path], language: str, as_json: bool, quiet: bool
) -> None:
    """Say what was written, and what was not done as asked."""
    from graphkin.words import languages, say

    if as_json:
        print_json(made.data | {"files": [str(p) for p in paths]})
    elif not quiet:
        print_paths(paths)
    for note in made.notes:
        tell(f"graphkin: {say(note, languages(language)[0])}", err=True)
    if not made.ok:
        raise typer.Exit(1)


def _problem_set(
    scene: str, out: Path | None, formats: list[str], find: list[str] | None, lang: str | None,
    convention: str | None, variants: int | None,
    seed: int, rows: Path | None, workers: int | None, exports: list[str], as_json: bool, quiet: bool,
) -> None:  # fmt: skip
    from graphkin.api.handouts import papers_of
    from graphkin.api.problem_sets import problem_set
    from graphkin.scene import mechanism_of
    from graphkin.words import languages, say

    target = out if out is not None else Path(mechanism_of(scene).name)
    papers = papers_of(scene, formats, lang, convention, exports)
    with progress_bar(not as_json and not quiet, target) as progress:
        made = problem_set(
            scene,
            variants,
            seed,
            rows,
            target,
            workers=processes(workers),
            render=papers,
            progress=progress,
            find=find or None,
            language=lang,
        )
    if as_json:
        print_json(made.data)
    elif not quiet:
        answers = target / "answers.csv"
        done = Phrase(
            "problems in a folder with all answers", count=len(made.made.names), folder=target, answers=answers
        )
        tell(say(done, languages(lang or mechanism_of(scene).sheet.language)[0]))
    tell_unused(made.unused)
    for failure in made.made.failures:
        complain(Phrase("where and what", where=failure.name, found=failure.why))
    if not made.ok:
        raise typer.Exit(min(failure.exit_code for failure in made.made.failures))
