"""The papers of a task with a single construction (a synthesis, a cam): problem sheet, worked solution, key."""

from __future__ import annotations

import math
import os
from collections.abc import Mapping, Sequence
from functools import partial
from pathlib import Path

from graphkin.account.headings import number
from graphkin.account.voice import account_of
from graphkin.api.arguments import known_words, own_folder
from graphkin.api.cams import CamMade
from graphkin.api.designed import Designed
from graphkin.checking.closed_form import predict_cam, predict_lengths
from graphkin.checking.report import COVERAGE
from graphkin.construction import Sheet
from graphkin.construction.cam_sheet import divisions
from graphkin.construction.tasks import length_letters
from graphkin.drawing.figures.constructions import (
    asked_words,
    cam_given,
    cam_pictures,
    construction_picture,
)
from graphkin.drawing.write.drawing import Drawing
from graphkin.files import write_files
from graphkin.papers.blocks import (
    Block,
    Document,
    Fields,
    Heading,
    Paragraph,
    Picture,
    Said,
    StepItem,
    Together,
    finished,
    in_each,
    numbered,
    said,
    said_each,
    table_of,
)
from graphkin.papers.documents import accepted, labelled
from graphkin.papers.paper import Paper
from graphkin.papers.pdf import papers_as
from graphkin.papers.pictures import bare_picture
from graphkin.words import languages, say, word
from graphkin.words.symbols import Words, sign, spaced

MANY = 6  # steps that stand in two columns

Result = Mapping[str, Words]
"""A result of a construction by the keys of heads: its name, unit, as read off, the exact value, and what may
be accepted of a pencil drawing."""


def _papers(
    title: Said, given: Sequence[Said], start: Sequence[Drawing], whole: Mapping[Said, Drawing], sheet: Sheet,
    results: Sequence[Result], notes: Sequence[Said], language: str, paper: Paper, formats: Sequence[str],
    prefix: str = "",
) -> Mapping[str, bytes]:
    """Problem sheet, worked solution and key of a task, as files.

    Parameters
    ----------
    given : sentences on the given and the asked
    start : figures that the problem begins with, to scale
    whole : figures of the finished construction, by their subjects
    sheet : the construction with its steps
    notes : sentences on the result
    language : "en", "zh" or "both"
    """

    def document(key: str, *blocks: Block) -> Document:
        first = languages(language)[0]
        name = str(title[0][1]) + word("colon", first) + word(key, first)
        return Document(name, languages(language), (Heading(title, 1), *blocks), paper)

    def results_in(heading: str, keys: Sequence[str], rows: Sequence[Result], roomy: bool = False) -> Together:
        return Together((Heading(said(heading, language), 2), table_of(language, rows, keys, roomy=roomy)))

    asked = [Paragraph(finished(sentence)) for sentence in given]
    blank = [{key: cells[key] for key in ("quantity", "unit")} for cells in results]
    problem = document(
        "problem sheet",
        Fields(said_each(language, ("name of student", "class of student", "date"))),
        *asked,
        Paragraph(said("print true", language), small=True),
        *map(Picture, start),
        results_in("your results", ("quantity", "on paper", "value", "unit"), blank, roomy=True),
    )
    account, parted = account_of(sheet), len(sheet.steps) >= MANY
    solution = document(
        "worked solution",
        *asked,
        *(StepItem(step.number, finished(in_each(language, partial(account.say, step.phrase))), parted=parted)
          for step in sheet.steps),
        *(Picture(bare_picture(figure), numbered(i, caption), floats=i < len(whole))
          for i, (caption, figure) in enumerate(whole.items(), 1)),
        results_in("results", ("quantity", "measured", "exact", "unit"), results),
        *(Paragraph(finished(sentence)) for sentence in notes),
    )
    key = document(
        "answer key",
        table_of(language, results, ("quantity", "value", "accept", "unit")),
        *(Paragraph(finished(sentence), small=True) for sentence in notes),
    )
    return papers_as(formats, {f"{prefix}problem": problem, f"{prefix}solution": solution, f"{prefix}key": key})


def _result(
    name: Words, unit: str, read: str, exact: str, value: float, deviation: float, least: float = 0.0
) -> Result:
    """A result with its tolerance, the accepted number of standard deviations of a pencil drawing."""
    _, within = accepted(value, COVERAGE * deviation, least)
    return {"quantity": name, "unit": unit, "measured": read, "value": exact, "exact": exact, "accept": within}


def design_papers(designed: Designed, formats: Sequence[str]) -> Mapping[str, bytes]:
    """Problem sheet, worked solution and key of a synthesis, as files."""
    given, sheet = designed.given, designed.sheet
    language, unit, scale = designed.language or given.sheet.language, given.units.length, sheet.scales.length
    spread = predict_lengths(given.task, scale, "pencil", given.sheet.tools)
    results = []
    for row in designed.rows:
        name = length_letters(row.symbol)
        deviation = spread.get(row.symbol, math.inf) * scale
        results.append(_result(name, unit, number(row.measured), number(row.exact), row.exact, deviation))
    find = spaced(", ", (cells["quantity"] for cells in results))
    return _papers(
        title=in_each(language, lambda each: given.title_in(each) or given.name),
        given=(in_each(language, lambda each: asked_words(given, each)),
               in_each(language, lambda each: labelled("find", find, each))),
        start=(construction_picture(given, sheet, language, 1),),
        whole={said("design figure", language): construction_picture(given, sheet, language)},
        sheet=sheet,
        results=results,
        notes=_notes(designed, language),
        language=language,
        paper=Paper(*given.sheet.size),
        formats=formats,
    )


def write_design_papers(
    designed: Designed, folder: str | os.PathLike[str] | None = None, formats: Sequence[str] = ("html", "pdf")
) -> list[Path]:
    """Write the papers of a synthesis; returns their paths.

    Raises
    ------
    CallError : an unknown format, a folder that cannot be written
    """
    known_words(formats, known_formats=("html", "pdf"))
    target = own_folder(folder, designed.given.name)
    return write_files(target, design_papers(designed, formats))


def _notes(designed: Designed, language: str) -> list[Said]:
    """Sentences on the found mechanism, and on its values over a turn."""
    made: list[Said] = []
    known = [value for value in designed.confirmed if value.ok]

    def told(each: str) -> str:
        mark = word("colon", each)
        values = (f"{say(value.what, each)}{mark}{value.shown(value.found)}" for value in known)
        return word("list comma", each).join(values)

    if known:
        made.append(in_each(language, lambda each: labelled("confirmed", told(each), each)))
    return [*made, *_sentences(designed, language)]


def _sentences(of: Designed | CamMade, language: str) -> list[Said]:
    """The sentences on a result, each in the languages of a sheet."""
    spoken = ([(each, text) for text in of.sentences(each)] for each in languages(language))
    return list(zip(*spoken, strict=True))


def cam_papers(made: CamMade, formats: Sequence[str], language: str, prefix: str = "cam-") -> Mapping[str, bytes]:
    """Problem sheet, worked solution and key of a cam drawn by inversion, as files."""
    scene, sheet, cam = made.mechanism, made.sheet, made.cam
    swings, results = cam.turns, []
    spread = predict_cam(cam, sheet, "pencil", scene.question.sheet.tools)
    read = [*enumerate(zip(divisions(sheet), spread, strict=True))]
    for k, (d, tolerance) in read if not cam.flat else ():
        angle = math.degrees(d.pressure)
        deviation = math.degrees(tolerance["pressure"])
        results.append(_result(sign("α", str(k)), "°", f"{angle:.1f}", f"{angle:.3f}", angle, deviation))
    metres = scene.units.metres
    for k, (d, tolerance) in read:
        lift = cam.law.at(d.degree).lift
        drawn, value, deviation = (math.degrees(x) if swings else x / metres for x in (d.lift, lift, tolerance["lift"]))
        letter, unit = ("ψ", "°") if swings else ("s", scene.units.length)
        per = 1.0 if swings else sheet.scales.length / metres
        measured = number(round(drawn / per, 2) * per)  # to 0.01 mm, as lengths on paper are told
        results.append(_result(sign(letter, str(k)), unit, measured, number(value, 5), value, deviation, -math.inf))
    captions = said("cam diagram", language), said("cam figure", language)
    diagram, begun = cam_pictures(scene, cam, sheet, language, begun=True)
    return _papers(
        title=in_each(language, lambda each: scene.question.title_in(each) or scene.name),
        given=(in_each(language, lambda each: cam_given(scene, cam, each)),
               in_each(language, lambda each: labelled("find", word("cam find", each), each))),
        start=(bare_picture(diagram), begun),  # the first is wider than the page inside
        whole=dict(zip(captions, cam_pictures(scene, cam, sheet, language), strict=True)),
        sheet=sheet,
        results=results,
        notes=_sentences(made, language),
        language=language,
        paper=Paper(*scene.question.sheet.size),
        formats=formats,
        prefix=prefix,
    )
