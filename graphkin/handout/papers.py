"""The files of a handout, by name."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from graphkin import exact
from graphkin.drawing import figures
from graphkin.drawing.save import drawing_bytes
from graphkin.handout.key import answer_key, key_csv
from graphkin.handout.lesson import Lesson
from graphkin.handout.page import document_page, handout_page
from graphkin.handout.paper import paper_plan
from graphkin.handout.prepare import lesson_of
from graphkin.handout.problem import problem
from graphkin.handout.solution import solution
from graphkin.handout.typeset_pdf import can_typeset, pdf
from graphkin.handout.variants import Variant, asked_of
from graphkin.handout.viewer import Progress, View

__all__ = ["FORMATS", "Papers", "handout_files"]

FORMATS = ("html", "pdf")


def handout_files(
    lesson: Lesson,
    views: Sequence[View] = (),
    start: int = 0,
    formats: Sequence[str] = FORMATS,
    progress: Progress | None = None,
) -> Mapping[str, bytes]:
    """Everything to be written for a lesson.

    ``problem.html`` and ``problem.pdf`` (without answers), ``handout.html`` (the solution to step through),
    ``solution.pdf``, ``key.html``, ``key.pdf`` and ``key.csv``.  Without the extra ``pdf`` the figure sheets
    ``mechanism.pdf``, ``velocity.pdf`` and ``acceleration.pdf`` take the place of the typeset ones.

    Parameters
    ----------
    views, start : positions of the driver for the screen, and which of them is the given one; without any the given
        one alone
    formats : "html", "pdf" or both
    progress : called with the number of positions done for the screen and the number of all
    """
    made: dict[str, bytes] = {}
    if "html" in formats:
        made["problem.html"] = document_page(problem(lesson)).encode()
        made["handout.html"] = handout_page(lesson, views or (View(lesson),), start, progress).encode()
        made["key.html"] = document_page(answer_key(lesson)).encode()
    if "pdf" in formats:
        made |= _typeset(lesson)
    made["key.csv"] = key_csv(lesson).encode()
    return made


def _typeset(lesson: Lesson) -> dict[str, bytes]:
    """The typeset papers, or the figure sheets where nothing can be typeset."""
    if can_typeset():
        return {
            "problem.pdf": pdf(problem(lesson)),
            "solution.pdf": pdf(solution(lesson)),
            "key.pdf": pdf(answer_key(lesson)),
        }
    drawn = figures(lesson.sheet, language=lesson.language, convention=lesson.convention)
    return {f"{name}.pdf": drawing_bytes(figure, "pdf") for name, figure in drawn.items()}


@dataclass(frozen=True)
class Papers:
    """Writes the papers of a variant: problem sheet and key in each format, and the worked solution as PDF.

    A value that can be sent to another process.
    """

    language: str
    convention: str
    formats: tuple[str, ...]

    def __call__(self, variant: Variant) -> Mapping[str, bytes]:
        scene = variant.scene
        asked = asked_of(scene)
        lesson = lesson_of(paper_plan(scene, None, asked), exact.solve(scene), self.language, self.convention)
        made = {"key.csv": key_csv(lesson).encode()}
        if "html" in self.formats:
            made["problem.html"] = document_page(problem(lesson)).encode()
            made["key.html"] = document_page(answer_key(lesson)).encode()
        if "pdf" in self.formats:
            made |= _typeset(lesson)
        return made
