"""The papers of what is solved by one construction: a synthesis, a cam."""

from __future__ import annotations

import math
import os
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

from graphkin.account.headings import number, written
from graphkin.api.arguments import known_words, own_folder, write_files
from graphkin.api.cams import CamMade
from graphkin.api.designed import Designed
from graphkin.checking.closed_form import predict_cam, predict_lengths
from graphkin.checking.uncertainty import COVERAGE
from graphkin.drawing.figures.cam import cam_given, cam_pictures
from graphkin.drawing.figures.synthesis import asked_words, construction_picture, step_words
from graphkin.papers.blocks import Said, said
from graphkin.papers.drawn_task import DrawnTask, TaskResult, papers_of_task
from graphkin.papers.paper import Paper
from graphkin.papers.problem import labelled
from graphkin.scene.cams import SwingingFollower
from graphkin.words import languages, say, word
from graphkin.words.written import in_markup

__all__ = ["cam_papers", "design_papers", "write_design_papers"]

def _each(language: str, text: Callable[[str], str]) -> Said:
    return tuple((each, text(each)) for each in languages(language))


def _accepted(value: float, deviation: float, least: float = 0.0) -> str:
    """What may be accepted of a pencil drawing, to two figures of what it may be off; "" where that has no bound."""
    off = COVERAGE * deviation
    if not math.isfinite(off):
        return ""
    places = max(0, 1 - math.floor(math.log10(off))) if off else 3
    return " … ".join(written(f"{bound:.{places}f}") for bound in (max(value - off, least), value + off))


def design_papers(designed: Designed, formats: Sequence[str]) -> Mapping[str, bytes]:
    """Problem sheet, worked solution and key of a synthesis, as files."""
    given, sheet = designed.given, designed.sheet
    language, unit = designed.language or given.sheet.language, given.units.length
    spread = predict_lengths(given.task, sheet.scale, "pencil", given.sheet.tools)
    results = []
    for row in designed.rows:
        within = _accepted(row.exact, spread.get(row.symbol, math.inf) * sheet.scale)
        name = row.symbol if row.symbol == "ram" else f"${row.symbol}$"
        results.append(TaskResult(name, unit, number(row.measured), number(row.exact), within))
    find = ", ".join(result.name for result in results)
    task = DrawnTask(
        title=_each(language, lambda each: in_markup(given.title_in(each) or given.name)),
        given=(_each(language, lambda each: asked_words(given, each)),
               _each(language, lambda each: labelled("find", find, each))),
        start=(construction_picture(given, sheet, language, 1),),
        whole=(construction_picture(given, sheet, language),),
        captions=(said("design figure", language),),
        steps=tuple(_each(language, partial(step_words, step.phrase)) for step in sheet.steps),
        results=tuple(results),
        notes=tuple(_notes(designed, language)),
        language=language,
        paper=Paper(*given.sheet.size),
    )  # fmt: skip
    return papers_of_task(task, formats)


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
    """What a turn of the found mechanism confirms, and what else is said of it."""
    made: list[Said] = []
    known = [one for one in designed.confirmed if math.isfinite(one.found)]

    def told(each: str) -> str:
        mark = word("colon", each)
        return word("list comma", each).join(f"{say(one.what, each)}{mark}{one.shown(one.found)}" for one in known)

    if known:
        made.append(_each(language, lambda each: labelled("confirmed", told(each), each)))
    spoken = {each: designed.sentences(each) for each in languages(language)}
    return [*made, *_by_sentence(spoken)]


def _by_sentence(spoken: Mapping[str, Sequence[str]]) -> list[Said]:
    """Sentences of each language, put together one by one."""
    told = ([(each, in_markup(text)) for text in texts] for each, texts in spoken.items())
    return [tuple(pairs) for pairs in zip(*told, strict=True)]


def cam_papers(made: CamMade, formats: Sequence[str], language: str, prefix: str = "cam-") -> Mapping[str, bytes]:
    """Problem sheet, worked solution and key of a cam drawn by inversion, as files."""
    scene, sheet, cam = made.mechanism, made.sheet, made.cam
    swings = isinstance(cam.motion, SwingingFollower)
    results = []
    spread = predict_cam(sheet, "pencil", scene.sheet.tools)
    for d, off in zip(sheet.divisions, spread, strict=True) if not cam.flat else ():
        angle = math.degrees(d.pressure)
        within = _accepted(angle, math.degrees(off.pressure))
        results.append(TaskResult(f"$α_{{{d.number}}}$", "°", f"{angle:.1f}", f"{angle:.3f}", within))
    metres = scene.units.metres
    for d, off in zip(sheet.divisions, spread, strict=True):
        value, deviation = (math.degrees(x) if swings else x / metres for x in (d.lift, off.lift))
        letter, unit = ("ψ", "°") if swings else ("s", scene.units.length)
        within = _accepted(value, deviation, -math.inf)
        per = 1.0 if swings else sheet.scale / metres
        read = number(round(value / per, 2) * per)  # to 0.01 mm, as lengths on paper are told
        results.append(TaskResult(f"${letter}_{{{d.number}}}$", unit, read, number(value, 5), within))
    spoken = {each: made.sentences(each) for each in languages(language)}
    notes = tuple(_by_sentence(spoken))
    task = DrawnTask(
        title=_each(language, lambda each: in_markup(scene.title_in(each) or scene.name)),
        given=(_each(language, lambda each: cam_given(scene, cam, each)),
               _each(language, lambda each: labelled("find", word("cam find", each), each))),
        start=cam_pictures(scene, sheet, language, begun=True),
        whole=cam_pictures(scene, sheet, language),
        captions=(said("cam diagram", language), said("cam figure", language)),
        steps=tuple(_each(language, partial(say, phrase)) for phrase in sheet.steps),
        results=tuple(results),
        notes=notes,
        language=language,
        paper=Paper(*scene.sheet.size),
    )  # fmt: skip
    return papers_of_task(task, formats, prefix)
