"""What the page asks, message by message, and what it is told: values in, values out, no state between two questions.

A message is a mapping with ``do``, one of `QUESTIONS`, and what that needs; the answer is a mapping for JSON.  The text
of the scene comes with each question, so that nothing is lost when a server ends.
"""

from __future__ import annotations

import base64
import io
import math
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from graphkin.api.drawn import FIGURES
from graphkin.board import building, pictures
from graphkin.board.moving import pulled
from graphkin.board.pictures import Message
from graphkin.board.scene_text import changed, completions, line_of
from graphkin.board.shelf import Shelf, mark_of
from graphkin.errors import CallError, GraphkinError, Problem, SceneError, did_you_mean
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.new_scene import NEW, new_scene
from graphkin.scene.reading import clause_of
from graphkin.scene.source import LARGEST_FILE, parsed
from graphkin.scene.written import put, resolved, safe_name
from graphkin.structure import mobility_of
from graphkin.words import LANGUAGES, Phrase, area, from_others, say

__all__ = ["LINK", "QUESTIONS", "Desk", "answer", "scene_link", "text_of_link"]

LINK = "graphkin:"
"""How a link begins that carries a scene in itself."""
MOST_VARIANTS = 60

Answer = dict[str, Json]
"""What it is told, as JSON."""


@dataclass(frozen=True)
class Desk:
    """What a page may reach: its scenes, and the link or text that it begins with."""

    shelf: Shelf = field(default_factory=Shelf)
    first: str = ""
    text: str = ""


def answer(desk: Desk, message: object) -> Answer:
    """What a message is told.  Whatever it holds, the answer is one: ``ok``, or ``problems`` in sentences with the
    lines of the text that they are about.

    >>> answer(Desk(), {"do": "opne"})["problems"][0]["text"]
    'question: "opne"; did you mean "open"?'
    """
    number = message.get("id") if isinstance(message, Mapping) else None
    head = {"id": number} if isinstance(number, int | str) else {}
    try:
        if not isinstance(message, Mapping):
            raise CallError(
                Problem("question", Phrase("found value", value=f"{message!r:.40}"), Phrase("send an object"))
            )
        name = message.get("do")
        if not isinstance(name, str) or name not in QUESTIONS:
            raise CallError(Problem("question", f'"{name!s:.40}"', did_you_mean(f"{name!s:.40}", QUESTIONS)))
        return {**head, "ok": True, **QUESTIONS[name](desk, message)}
    except GraphkinError as error:
        return {**head, "ok": False, **_problems(desk, error, message)}
    except (RecursionError, MemoryError, OverflowError):
        huge = CallError(Problem(Phrase("the scene"), Phrase("is too large to be shown")))
        return {**head, "ok": False, **_problems(desk, huge, message)}


def language_of(message: object) -> str:
    """The language in which a message wants its answer, English where it does not say."""
    language = message.get("language") if isinstance(message, Mapping) else None
    return language if language in LANGUAGES else LANGUAGES[0]


def _problems(desk: Desk, error: GraphkinError, message: object) -> Answer:
    text = message.get("text") if isinstance(message, Mapping) else ""
    text = text if isinstance(text, str) else ""
    spoken, lines = language_of(message), isinstance(error, SceneError) or text != ""
    found: list[dict[str, Json]] = [
        {"text": problem.text(spoken), "line": line_of(problem, text) if lines else 0}
        for problem in error.problems[:100]
    ]
    return {"problems": found, "kind": type(error).__name__, **_draft_of(desk, text, message)}


def _draft_of(desk: Desk, text: str, message: object) -> Answer:
    """What can be shown of a scene that does not move yet: its sketch and its mobility."""
    language = message.get("language") if isinstance(message, Mapping) else None
    try:
        made = parsed(text)
    except SceneError:
        return {}
    told: Answer = {"draft": building.draft(made), "form": made}
    trial = building.trial_driver(made)
    try:
        made = pictures.with_own_files(parsed(text), desk.shelf.folder)
        scene = resolved({**made, "driver": trial} if trial else made, "scene")[1]
        count = 0 if trial else len(scene.drivers)
        spoken = language if language in LANGUAGES else scene.sheet.language
        told["mobility"] = pictures.mobility_text(scene, spoken, count)
        told["freedom"] = mobility_of(scene).value
    except GraphkinError:
        pass
    return told


# -- the questions --------------------------------------------------------------------------------------------------


def _text(message: Message) -> str:
    return building.checked_text(message.get("text"))


def _name(message: Message) -> str:
    name = message.get("name")
    return name if isinstance(name, str) else ""


def _scene(desk: Desk, message: Message) -> Mechanism:
    return pictures.scene_of(_text(message), safe_name(_name(message).removesuffix(".toml")), desk.shelf.folder)


def _at(message: Message) -> dict[str, float] | None:
    at = message.get("at")
    if at is None:
        return None
    if not isinstance(at, Mapping) or not all(_finite(v) for v in at.values()):
        raise CallError(
            Problem("at", Phrase("found value", value=f"{at!r:.60}"), Phrase("give a number for each driver"))
        )
    return {str(key): float(value) for key, value in at.items()}


def _finite(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)


def _show(desk: Desk, message: Message) -> Answer:
    scene = _scene(desk, message)
    options = pictures.FigureOptions.of(message)
    quick = message.get("quick") is True
    told = pictures.shown(scene, _at(message), options, quick)
    return told if quick else {**told, "form": parsed(_text(message))}


def _pull(desk: Desk, message: Message) -> Answer:
    """A point pulled to a place: the figures that follow, and when the hand lets go the text that says so."""
    x, y, point = message.get("x"), message.get("y"), message.get("point")
    if not _finite(x) or not _finite(y) or not isinstance(point, str):
        raise CallError(
            Problem(
                "pull",
                Phrase("found to", point=f"{point!r:.40}", value=f"{x!r:.20}", other=f"{y!r:.20}"),
                Phrase("name a point and a place"),
            )
        )
    scene, at, text = _scene(desk, message), _at(message), _text(message)
    options = pictures.FigureOptions.of(message)
    raw = parsed(text)
    to = complex(float(x), float(y)) * scene.units.metres  # type: ignore[arg-type]
    found = pulled(raw, pictures.motion_at(scene, at), point, to, message.get("lengths") is True)
    now = {**(at or {}), **found.at} or None
    if message.get("final") is True:
        text = changed(text, found.changes) if found.changes else text
        return {**_show(desk, {**message, "text": text, "at": now, "quick": False}), "text": text}
    for key, value in found.changes.items():
        if problem := put(raw, key, value):
            raise CallError(problem)
    there = resolved(pictures.with_own_files(raw, desk.shelf.folder), "scene")[1] if found.changes else scene
    return {**pictures.shown(there, now, options, quick=True), "changes": found.changes}


def _change(desk: Desk, message: Message) -> Answer:
    changes = message.get("changes")
    if not isinstance(changes, Mapping) or not all(isinstance(key, str) for key in changes):
        raise CallError(
            Problem("changes", Phrase("found value", value=f"{changes!r:.60}"), Phrase("give values by key"))
        )
    return {"text": changed(_text(message), changes)}


def _build(desk: Desk, message: Message) -> Answer:
    step = message.get("step")
    if not isinstance(step, Mapping):
        raise CallError(Problem("piece", Phrase("found value", value=f'{step!r:.60}'), Phrase("say what to build")))
    return {"text": building.built(_text(message), step)}


def _keep(desk: Desk, message: Message) -> Answer:
    """The position shown, written into the scene as its own, with its sketch."""
    scene, text = _scene(desk, message), _text(message)
    told = pictures.shown(scene, _at(message), pictures.FigureOptions(("mechanism",)), quick=True)
    at, points = told["at"], told["points"]
    assert isinstance(at, dict)
    assert isinstance(points, dict)
    changes: Answer = {}
    raw = parsed(text)
    many = isinstance(raw.get("driver"), list)
    for index, driver in enumerate(scene.drivers, 1):
        key = f"driver.{index}" if many else "driver"
        name = "angle" if driver.key in {link.name for link in scene.links} else "travel"
        changes[f"{key}.{name}"] = float(f"{at[driver.key]:.10g}")
    spots = {p: [float(f"{z[c]:.6g}") for c in "xy"] for p, z in points.items() if isinstance(z, dict)}
    for table in ("sketch", "drawn"):
        changes |= {f"{table}.{p}": spots[p] for p in raw.get(table, {}) if p in spots}
    return {"text": changed(text, changes)}


def _complete(desk: Desk, message: Message) -> Answer:
    line, column = message.get("line"), message.get("column")
    if not isinstance(line, int) or not isinstance(column, int):
        raise CallError(Problem("complete", Phrase("no place in the text"), Phrase("give line and column")))
    language, found = language_of(message), completions(_text(message), line, column)
    if language != LANGUAGES[0]:
        found = [{**key, "detail": say(from_others(clause_of(key["detail"])), language)} for key in found]
    return {"options": found}


def _open(desk: Desk, message: Message) -> Answer:
    """The first scene of the page, one of its shelf, a link that carries one, or a new one of a kind."""
    name, kind = message.get("name"), message.get("new")
    if isinstance(message.get("link"), str):
        return {"name": "", "text": text_of_link(message["link"]), "mark": "", "own": False}
    if isinstance(kind, str):
        return {"name": "", "text": new_scene(kind, {}) if kind in NEW else building.EMPTY, "mark": "", "own": False}
    if not isinstance(name, str) or not name:
        if desk.text:
            return {"name": "", "text": desk.text, "mark": "", "own": False}
        if not desk.first:
            return {"name": "", "text": "", "mark": "", "own": False}
        name = desk.first
    text = desk.shelf.text(name)
    return {"name": name, "text": text, "mark": mark_of(text), "own": name in desk.shelf.files()}


def _shelf(desk: Desk, message: Message) -> Answer:
    found = desk.shelf.listing()
    writes = desk.shelf.folder is not None
    return {"scenes": found, "new": sorted(NEW), "writes": writes, "only": desk.shelf.only}


def _thumbnail(desk: Desk, message: Message) -> Answer:
    name = _name(message)
    scene = pictures.scene_of(desk.shelf.text(name), safe_name(name.removesuffix(".toml")), desk.shelf.folder)
    language = message.get("language") if message.get("language") in LANGUAGES else None
    return {"name": name, "svg": pictures.thumbnail(scene, language), "title": scene.title_in(language or "en")}


def _save(desk: Desk, message: Message) -> Answer:
    mark = message.get("mark")
    return {"mark": desk.shelf.save(_name(message), _text(message), mark if isinstance(mark, str) else "")}


def _watch(desk: Desk, message: Message) -> Answer:
    return {"changed": desk.shelf.changed(_name(message), str(message.get("mark")))}


def _diagrams(desk: Desk, message: Message) -> Answer:
    from graphkin.api.sweep import sweep

    asked = message.get("find")
    find = [str(one) for one in asked] if isinstance(asked, list) and asked else None
    swept = sweep(_scene(desk, message), find=find, language=pictures.FigureOptions.of(message).language)
    return {"figures": {name: figure.content("svg").decode() for name, figure in islice(swept.figures.items(), 12)}}


def _race(desk: Desk, message: Message) -> Answer:
    from graphkin.api.studied import speed_accuracy

    found = speed_accuracy(_scene(desk, message), repeats=1, language=pictures.FigureOptions.of(message).language)
    return {"figures": {name: figure.content("svg").decode() for name, figure in found.figures.items()}}


_TYPES = {"svg": "image/svg+xml", "pdf": "application/pdf", "png": "image/png", "dxf": "image/vnd.dxf",
          "zip": "application/zip", "toml": "application/toml"}  # fmt: skip


def _export(desk: Desk, message: Message) -> Answer:
    """A figure, the papers, a set of variants, or the scene, as a file to be kept."""
    kind, scene = message.get("kind"), _scene(desk, message)
    options = pictures.FigureOptions.of(message)
    if kind in ("svg", "pdf", "png", "dxf"):
        from graphkin import solver

        drawn, _ = pictures.drawn_at(solver.structure_of(scene), _at(message), options)
        figures = drawn.figures
        if not figures:
            raise CallError(Problem("figure", Phrase("there is nothing to draw"), Phrase("choose another figure")))
        name, figure = next(iter(figures.items()))
        return _file(f"{scene.name}-{name}.{kind}", figure.content(kind))
    if kind == "scene":
        return _file(f"{scene.name}.toml", _text(message).encode())
    if kind not in ("papers", "variants"):
        raise CallError(Problem("kind", f'"{kind!s:.40}"', Phrase("known here svg pdf png dxf papers variants")))
    with tempfile.TemporaryDirectory() as folder:
        _papers(scene, message, options, Path(folder))
        return _file(f"{scene.name}-{kind}.zip", _packed(Path(folder)))


def _papers(scene: Mechanism, message: Message, options: pictures.FigureOptions, folder: Path) -> None:
    from graphkin.api.handouts import handout, papers_of
    from graphkin.api.problem_sets import problem_set
    from graphkin.table import have

    formats = ("html", "pdf") if have("typst") else ("html",)
    if message.get("kind") == "papers":
        handout(scene, folder, _at(message), formats=formats, language=options.language, convention=options.convention)
        return
    count, seed = message.get("count"), message.get("seed")
    if not isinstance(count, int) or not 1 <= count <= MOST_VARIANTS:
        raise CallError(
            Problem(
                "variants",
                Phrase("found value", value=f"{count!r:.20}"),
                Phrase("give a number from 1 to", most=MOST_VARIANTS),
            )
        )
    render = papers_of(scene, formats, options.language, options.convention)
    problem_set(scene, count, seed if isinstance(seed, int) else 0, out=folder, render=render)


def _packed(folder: Path) -> bytes:
    made = io.BytesIO()
    with zipfile.ZipFile(made, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(p for p in folder.rglob("*") if p.is_file() and not p.name.startswith(".")):
            archive.write(path, path.relative_to(folder).as_posix())
    return made.getvalue()


def _file(name: str, content: bytes) -> Answer:
    ending = name.rpartition(".")[2]
    return {"name": name, "type": _TYPES[ending], "data": base64.b64encode(content).decode()}


def scene_link(text: str) -> str:
    """A link that carries the text of a scene in itself.

    >>> text_of_link(scene_link('title = "x"'))
    'title = "x"'
    """
    return LINK + base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def text_of_link(link: str) -> str:
    """The text that a link carries.  Raises CallError for another link."""
    body = link.strip().removeprefix(LINK)
    try:
        data = base64.urlsafe_b64decode(body + "=" * (-len(body) % 4))
        unpacked = zlib.decompressobj()
        text = unpacked.decompress(data, LARGEST_FILE + 1)
        if not unpacked.eof or len(text) > LARGEST_FILE:
            raise ValueError
        return text.decode()
    except (ValueError, zlib.error):
        raise CallError(
            Problem("link", Phrase("carries no scene", link=link[:40]), Phrase("a link begins with", link=LINK))
        ) from None


def _link(desk: Desk, message: Message) -> Answer:
    return {"link": scene_link(_text(message))}


def _names(desk: Desk, message: Message) -> Answer:
    """The words of the page in a language."""
    spoken = language_of(message)
    names = {key.removeprefix("page "): text for key, text in area("page", spoken).items()}
    return {"words": names, "language": spoken, "languages": LANGUAGES, "figures": list(FIGURES)}


QUESTIONS: Mapping[str, Callable[[Desk, Message], Answer]] = {
    "show": _show, "pull": _pull, "change": _change, "build": _build, "keep": _keep, "complete": _complete,
    "open": _open, "shelf": _shelf, "thumbnail": _thumbnail, "save": _save, "watch": _watch, "diagrams": _diagrams,
    "race": _race, "export": _export, "link": _link, "names": _names,
}  # fmt: skip
"""What the page may ask, by name."""
