"""The papers of a task that is solved by one construction (a synthesis, a cam): problem sheet, worked solution, key."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from graphkin.drawing.write.drawing import Drawing
from graphkin.papers.blocks import (
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Said,
    StepItem,
    Steps,
    TableBlock,
    Together,
    finished,
    numbered,
    said,
)
from graphkin.papers.lesson import plain_words
from graphkin.papers.page import document_page
from graphkin.papers.paper import A4, Paper
from graphkin.papers.pdf import can_typeset, pdf
from graphkin.papers.pictures import bare_picture
from graphkin.words import languages, word

MANY = 6  # steps that stand in two columns

__all__ = ["DrawnTask", "TaskResult", "papers_of_task"]


@dataclass(frozen=True)
class TaskResult:
    """A result of a construction: its name (markup), unit, as read off, the exact value, and what may be accepted of a
    pencil drawing ("" where nothing is said)."""

    name: str
    unit: str
    read: str
    exact: str
    within: str = ""


@dataclass(frozen=True)
class DrawnTask:
    """A task with its construction.

    given : sentences of what is given and asked
    start : figures that the problem begins with, to scale
    whole, captions : figures of the finished construction, and what each shows
    steps : what is done, with its reason
    notes : what is found of the result
    language : "en", "zh" or "both"
    """

    title: Said
    given: tuple[Said, ...]
    start: tuple[Drawing, ...]
    whole: tuple[Drawing, ...]
    captions: tuple[Said, ...]
    steps: tuple[Said, ...]
    results: tuple[TaskResult, ...]
    notes: tuple[Said, ...]
    language: str
    paper: Paper = A4

    def _document(self, key: str, blocks: Sequence[Block]) -> Document:
        first = languages(self.language)[0]
        title = plain_words(self.title[0][1]) + word("colon", first) + word(key, first)
        return Document(title, languages(self.language), tuple(blocks), self.paper)

    def _heads(self, *keys: str) -> tuple[Said, ...]:
        return tuple(said(key, self.language) for key in keys)

    @property
    def problem(self) -> Document:
        """What is given, drawn to scale, with room to solve it, and a table to fill in."""
        lang = self.language
        rows = tuple((r.name, "", "", r.unit) for r in self.results)
        blank = TableBlock(self._heads("quantity", "on paper", "value", "unit"), rows, "lccl", roomy=True)
        return self._document("problem sheet", [
            Heading(self.title, 1),
            Fields(self._heads("name of student", "class of student", "date")),
            *(Paragraph(finished(one)) for one in self.given),
            Paragraph(said("print true", lang), small=True),
            *(Picture(one) for one in self.start),
            Together((Heading(said("your results", lang), 2), blank)),
        ])  # fmt: skip

    @property
    def solution(self) -> Document:
        """Every step with its reason, the construction, and what was read off beside what is exact."""
        lang = self.language
        steps = tuple(StepItem(i, finished(words)) for i, words in enumerate(self.steps, 1))
        rows = tuple((r.name, r.read, r.exact, r.unit) for r in self.results)
        figures = [
            Picture(bare_picture(one), numbered(i, told), floats=i < len(self.whole))
            for i, (one, told) in enumerate(zip(self.whole, self.captions, strict=True), 1)
        ]
        return self._document("worked solution", [
            Heading(self.title, 1),
            *(Paragraph(finished(one)) for one in self.given),
            Steps(steps, parted=len(steps) >= MANY),
            *figures,
            Together((Heading(said("results", lang), 2),
                      TableBlock(self._heads("quantity", "measured", "exact", "unit"), rows, "lrrl"))),
            *(Paragraph(finished(one)) for one in self.notes),
        ])  # fmt: skip

    @property
    def key(self) -> Document:
        """The results alone, with what to accept."""
        rows = tuple((r.name, r.exact, r.within or "–", r.unit) for r in self.results)
        return self._document("answer key", [
            Heading(self.title, 1),
            TableBlock(self._heads("quantity", "value", "accept", "unit"), rows, "lrrl"),
            *(Paragraph(finished(one), small=True) for one in self.notes),
        ])  # fmt: skip


def papers_of_task(task: DrawnTask, formats: Sequence[str], prefix: str = "") -> Mapping[str, bytes]:
    """The papers as files: problem, solution and key, each as HTML and as PDF where one can be typeset."""
    documents = {"problem": task.problem, "solution": task.solution, "key": task.key}
    made: dict[str, bytes] = {}
    if "html" in formats:
        made |= {f"{prefix}{name}.html": document_page(document).encode() for name, document in documents.items()}
    if "pdf" in formats and can_typeset():
        made |= {f"{prefix}{name}.pdf": pdf(document) for name, document in documents.items()}
    return made

