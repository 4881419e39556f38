"""``graphkin handout``: problem sheet, worked solution and key, of one problem or of a set."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from graphkin.cli.options import Given, command, processes, split_words
from graphkin.cli.output import complain, finish, print_json, print_paths, progress_bar, short_bar, tell, tell_unused
from graphkin.errors import CallError, did_you_mean
from graphkin.words import Phrase, languages, say

if TYPE_CHECKING:
    from graphkin.api.course_designs import CourseDesigns
    from graphkin.api.handouts import Handout

__all__ = ["handout"]

TEMPLATES = ("papers", "course-design")


@command(
    "scene", "out", "format of handout", "at", "position", "find", "lang of sheets", "convention",
    "positions of handout", "variants", "seed of handout", "rows", "workers of handout", "export", "template",
    "students", "text of handout", "json", "quiet",
)  # fmt: skip
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
        _course(given)
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
        _papers(given)


def _papers(given: Given) -> None:
    from graphkin.api.handouts import handout as handing

    with short_bar(given.speaks) as progress:
        made = given.call(handing, progress=progress, exports=split_words(given.export))
        paths = made.write(given.out)
    _tell_written(given, made, paths, made.lesson.language)


def _design(given: Given) -> None:
    from graphkin.api.designed import design as designing
    from graphkin.api.task_papers import write_design_papers

    designed = designing(given.scene, language=given.lang)
    files = write_design_papers(designed, given.out, given.formats)
    if given.json:
        print_json(designed.data | {"files": [str(path) for path in files]})
    elif not given.quiet:
        print_paths(files)


def _course(given: Given) -> None:
    from graphkin.api.course_designs import course_design

    with short_bar(given.speaks) as progress:
        made = given.call(course_design, progress=progress)
        paths = made.write(given.out)
    _tell_written(given, made, paths, given.lang or made.mechanism.question.sheet.language)


def _tell_written(given: Given, made: Handout | CourseDesigns, paths: Sequence[Path], language: str) -> None:
    """Say what was written, and what was not done as asked."""
    for note in made.notes:
        tell(f"graphkin: {say(note, languages(language)[0])}", err=True)
    finish(given, made, paths, files=True)


def _problem_set(given: Given) -> None:
    from graphkin.api.handouts import papers_of
    from graphkin.api.problem_sets import problem_set
    from graphkin.scene import mechanism_of

    target = given.out if given.out is not None else Path(mechanism_of(given.scene).name)
    papers = papers_of(given.scene, given.formats, given.lang, given.convention, split_words(given.export))
    with progress_bar(given.speaks, target) as progress:
        made = given.call(
            problem_set, out=target, workers=processes(given.workers), render=papers, progress=progress
        )
    if given.json:
        print_json(made.data)
    elif not given.quiet:
        gaps = {"count": len(made.answers), "folder": target, "answers": target / "answers.csv"}
        spoken = languages(given.lang or mechanism_of(given.scene).question.sheet.language)[0]
        tell(say(Phrase("problems in a folder with all answers", **gaps), spoken))
    tell_unused(made.unused)
    for failure in made.failures:
        complain(Phrase("where and what", where=failure.name, found=failure.why))
    if not made.ok:
        raise typer.Exit(min(failure.exit_code for failure in made.failures))
