"""The questions of the page and their answers, message by message: values in, values out, no state kept.

A message is a mapping with ``do``, one of `QUESTIONS`, and its arguments; the answer is a mapping for JSON.  The text
of the scene comes with each question, so that nothing is lost when a server ends.
"""

from __future__ import annotations

import base64
import io
import json
import math
import tempfile
import zipfile
import zlib
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from itertools import islice
from pathlib import Path
from typing import Annotated, Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from graphkin.api.arguments import known_words, placed
from graphkin.api.results import Result
from graphkin.board import building, pictures
from graphkin.board.building import pulled
from graphkin.board.pictures import FigureOptions
from graphkin.board.scene_text import changed, completions, line_of
from graphkin.board.shelf import Shelf, mark_of
from graphkin.construction.board.scales import Scales
from graphkin.drawing.figures import figure_kinds
from graphkin.errors import CallError, GraphkinError, Problem, SceneError, did_you_mean
from graphkin.files import Json, Tables
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import LARGEST_FILE, NEW, new_scene, parsed, put, resolved, safe_name
from graphkin.scene.tables import as_sentence
from graphkin.solver import solved_here, structure_of
from graphkin.words import LANGUAGES, Phrase, area, say, word

LINK = "graphkin:"
"""How a link begins that carries a scene in itself."""
MOST_VARIANTS = 60

Answer = dict[str, Json]
"""What it is told, as JSON."""


def answer(shelf: Shelf, message: object) -> Answer:
    """The answer to a message: with ``ok``, or with ``problems`` in sentences and the lines of the text concerned.

    >>> answer(Shelf(), {"do": "opne"})["problems"][0]["text"]
    'question: "opne"; did you mean "open"?'
    """
    number = message.get("id") if isinstance(message, Mapping) else None
    head = {"id": number} if isinstance(number, int | str) else {}
    try:
        if not isinstance(message, Mapping):
            raise CallError.of("question", "found value", "send an object", value=f"{message!r:.40}")
        name = message.get("do")
        if not isinstance(name, str) or name not in QUESTIONS:
            raise CallError.of("question", f'"{name!s:.40}"', did_you_mean(f"{name!s:.40}", QUESTIONS))
        needed, reply = QUESTIONS[name]
        return {**head, "ok": True, **reply(shelf, Message.of(message, needed))}
    except GraphkinError as error:
        return {**head, "ok": False, **_problems(shelf, error, message)}
    except (RecursionError, MemoryError, OverflowError):
        huge = CallError(Problem(Phrase("the scene"), Phrase("is too large to be shown")))
        return {**head, "ok": False, **_problems(shelf, huge, message)}


def language_of(message: object) -> str:
    """The language that a message asks for, English by default."""
    language = message.get("language") if isinstance(message, Mapping) else None
    return language if language in LANGUAGES else LANGUAGES[0]


def _problems(shelf: Shelf, error: GraphkinError, message: object) -> Answer:
    given = message if isinstance(message, Mapping) else {}
    text = given.get("text")
    text = text if isinstance(text, str) else ""
    lines = isinstance(error, SceneError) or text != ""
    problems: list[dict[str, Json]] = [
        {"text": problem.text(language_of(message)), "line": line_of(problem, text) if lines else 0}
        for problem in error.problems[:100]
    ]
    reply: Answer = {"problems": problems, "kind": type(error).__name__}
    with suppress(GraphkinError):  # of a scene that does not move yet the sketch and the mobility
        made = parsed(text)
        reply |= {"draft": building.draft(made), "form": _form(made)}
        trial = building.trial_driver(made)
        made = pictures.with_own_files(parsed(text), shelf.folder)
        scene = resolved({**made, "driver": trial} if trial else made, "scene")[1]
        language = given.get("language")
        spoken = language if language in LANGUAGES else scene.question.sheet.language
        reply["mobility"] = pictures.mobility_text(scene, spoken, trial is not None)
    return reply


def _form(made: Tables) -> Any:
    """The tables of a text for the form of the page; what JSON does not know (inf, a date) is a text."""
    return json.loads(json.dumps(made, default=str), parse_constant=str)


# the questions


class Message(BaseModel):
    """A message of the page.  Missing or null values are those with which the page begins."""

    model_config = ConfigDict(strict=True, frozen=True, allow_inf_nan=False)

    language: str | None = None
    name: str = ""  # of a file, and the mark of its version
    mark: str = ""
    text: str = ""  # of a scene, at values of its drivers, with wishes for its figures
    at: dict[str, float] | None = None
    figures: list[str] | None = None
    convention: str | None = None
    instrument: str = "exact"
    seed: int = 0
    scales: Annotated[list[Annotated[float, Field(gt=0)]], Field(min_length=3, max_length=3)] | None = None
    quick: bool = False
    point: str = ""  # pulled to a place
    x: float = 0.0
    y: float = 0.0
    lengths: bool = False
    final: bool = False
    changes: dict[str, Any] = Field(default_factory=dict)
    step: dict[str, Any] = Field(default_factory=dict)
    line: int = 0
    column: int = 0
    link: str | None = None
    new: str | None = None
    find: list[str] | None = None
    kind: str = ""
    count: Annotated[int, Field(ge=1, le=MOST_VARIANTS)] = 1

    @classmethod
    def of(cls, message: Mapping[str, Any], needed: Collection[str]) -> Message:
        """A message with all arguments of its question.  Raises CallError, naming those that are missing or wrong."""
        given = {key: value for key, value in message.items() if value is not None}
        wrong = {key: None for key in cls.model_fields if key in needed and key not in given}
        for key, value in given.items():
            try:
                json.dumps(value, ensure_ascii=False).encode()
            except UnicodeEncodeError:  # half of a character that needs two codes can be neither sent nor saved
                wrong[key] = value
        try:
            made = cls.model_validate(given)
        except ValidationError as error:
            wrong |= {str(fault["loc"][0]): fault["input"] for fault in error.errors(include_url=False)}
        if wrong:
            raise CallError(*(_refused(key, value) for key, value in wrong.items()))
        return made

    @property
    def spoken(self) -> str:
        """The language of the answer, English by default."""
        return self.language if self.language in LANGUAGES else LANGUAGES[0]

    def scene(self, shelf: Shelf) -> Mechanism:
        return pictures.scene_of(self.text, safe_name(self.name.removesuffix(".toml")), shelf.folder)

    @property
    def options(self) -> FigureOptions:
        """The message's options.  Raises CallError for an unknown language, convention or instrument."""
        language, convention, instrument = self.language or None, self.convention or None, self.instrument or "exact"
        known_words(language=language, convention=convention, instrument=instrument)
        figures = FigureOptions.figures if self.figures is None else tuple(self.figures)
        scales = Scales(*self.scales) if self.scales else None
        return FigureOptions(figures, language, convention, instrument, self.seed, scales)


_PULL, _COMPLETE = ("pull", Phrase("name a point and a place")), ("complete", Phrase("give line and column"))
_NEEDED: Mapping[str, tuple[str | Phrase, Phrase]] = {
    "text": (Phrase("the scene"), Phrase("give its text")),
    "at": ("at", Phrase("give a number for each driver")),
    "point": _PULL, "x": _PULL, "y": _PULL,
    "changes": ("changes", Phrase("give values by key")),
    "step": ("piece", Phrase("say what to build")),
    "line": _COMPLETE, "column": _COMPLETE,
    "count": ("variants", Phrase("give a number from 1 to", most=MOST_VARIANTS)),
}
"""What a key of a message is about, and what it needs."""


def _refused(key: str, value: object) -> Problem:
    """The problem of a message's value that its question cannot use."""
    where, needed = _NEEDED.get(key, (key, ""))
    return Problem(where, "found value", needed, value=f"{value!r:.60}")


def _show(shelf: Shelf, asked: Message) -> Answer:
    shown = pictures.shown(asked.scene(shelf), asked.at, asked.options, asked.quick)
    return shown if asked.quick else {**shown, "form": _form(parsed(asked.text))}


def _pull(shelf: Shelf, asked: Message) -> Answer:
    """A point pulled to a place: the figures that follow, and the changed text when the point is let go."""
    scene, raw = asked.scene(shelf), parsed(asked.text)
    to = complex(asked.x, asked.y) * scene.units.metres
    changes, at = pulled(raw, solved_here(*placed(scene, asked.at or None)), asked.point, to, asked.lengths)
    now = {**(asked.at or {}), **at} or None
    if asked.final:
        text = changed(asked.text, changes) if changes else asked.text
        return {**_show(shelf, asked.model_copy(update={"text": text, "at": now, "quick": False})), "text": text}
    for key, value in changes.items():
        if problem := put(raw, key, value):
            raise CallError(problem)
    there = resolved(pictures.with_own_files(raw, shelf.folder), "scene")[1] if changes else scene
    return {**pictures.shown(there, now, asked.options, quick=True), "changes": changes}


def _keep(shelf: Shelf, asked: Message) -> Answer:
    """The position shown, as the scene's own: values or moments of drivers, places of its sketch, starts of rolling."""
    scene, raw = asked.scene(shelf), parsed(asked.text)
    shown = pictures.shown(scene, asked.at, FigureOptions(("mechanism",)), quick=True)
    at, points = shown["at"], shown["points"]
    assert isinstance(at, dict)
    assert isinstance(points, dict)
    moved, values = placed(scene, at if asked.at else None)
    motion = solved_here(moved, values)
    changes: Answer = {}
    many = isinstance(raw["driver"], list)
    for index, driver in enumerate(moved.drivers):
        key, table = (f"driver.{index + 1}", raw["driver"][index]) if many else ("driver", raw["driver"])
        changes |= {f"{key}.{other}": None for other in ("from", "near", "position") if other in table}
        if driver.law is not None and "time" in table:
            changes[f"{key}.time"] = float(f"{driver.law.time:.10g}")
        else:
            changes[f"{key}.{'angle' if driver.turns else 'travel'}"] = float(f"{at[driver.key]:.10g}")
    for name in (name for name, link in raw["links"].items() if "start" in link):
        slide = next((pair.key for pair in scene.slidings if pair.a == name and not pair.of), "")
        start = motion.slide(slide)[0][0] / scene.units.metres if slide else math.degrees(motion.angle(name)[0])
        changes[f"links.{name}.start"] = float(f"{start:.10g}")
    for table, figures in (("sketch", 6), ("drawn", 10)):  # lengths are taken from what is drawn
        spots = {p: [float(f"{z[c]:.{figures}g}") for c in "xy"] for p, z in points.items() if isinstance(z, dict)}
        changes |= {f"{table}.{p}": spots[p] for p in raw.get(table, {}) if p in spots}
    return {"text": changed(asked.text, changes)}


def _complete(shelf: Shelf, asked: Message) -> Answer:
    language, keys = asked.spoken, completions(asked.text, asked.line, asked.column)
    said = (say(key["detail"], language) for key in keys)
    details = (as_sentence(detail) if language == LANGUAGES[0] else detail for detail in said)
    labels = (str(key["label"]) for key in keys)
    return {"options": [{"label": label, "detail": detail} for label, detail in zip(labels, details, strict=True)]}


def _open(shelf: Shelf, asked: Message) -> Answer:
    """The first scene of the page, a scene of its shelf, the scene in a link, or a new scene of a kind."""
    name = asked.name or ("" if shelf.draft else shelf.first)
    fresh: Answer = {"name": "", "text": shelf.draft, "mark": "", "own": False}
    if asked.link is not None:
        return {**fresh, "text": text_of_link(asked.link)}
    if asked.new is not None:
        return {**fresh, "text": new_scene(asked.new, {}) if asked.new in NEW else building.EMPTY}
    if not name:
        return fresh
    text = shelf.text(name)
    return {"name": name, "text": text, "mark": mark_of(text), "own": name in shelf.files()}


def _thumbnail(shelf: Shelf, asked: Message) -> Answer:
    scene = asked.model_copy(update={"text": shelf.text(asked.name)}).scene(shelf)
    language = asked.language if asked.language in LANGUAGES else None
    title = scene.question.title_in(asked.spoken)
    return {"name": asked.name, "svg": pictures.thumbnail(scene, language), "title": title}


def _diagrams(shelf: Shelf, asked: Message) -> Answer:
    from graphkin.api.sweep import sweep

    return _charts(sweep(asked.scene(shelf), find=asked.find or None, language=asked.options.language))


def _race(shelf: Shelf, asked: Message) -> Answer:
    from graphkin.api.studied import speed_accuracy

    return _charts(speed_accuracy(asked.scene(shelf), repeats=1, language=asked.options.language))


def _charts(made: Result) -> Answer:
    return {"figures": {name: figure.content("svg").decode() for name, figure in islice(made.figures.items(), 12)}}


_FIGURES = {"svg": "image/svg+xml", "pdf": "application/pdf", "png": "image/png", "dxf": "image/vnd.dxf"}


def _export(shelf: Shelf, asked: Message) -> Answer:
    """A figure, the papers, a set of variants, or the scene, as a file for the user."""
    kind, scene, options = asked.kind, asked.scene(shelf), asked.options
    if kind in _FIGURES:
        drawn, _ = pictures.drawn_at(structure_of(scene), asked.at, options)
        if not drawn.figures:
            raise CallError.of("figure", "there is nothing to draw", "choose another figure")
        pages = {f"{scene.name}-{name}.{kind}": page for name, page in drawn.figures.items()}
        first = next(iter(pages))
        if len(pages) == 1 or kind == "pdf":  # which holds all pages
            return _file(first, _FIGURES[kind], pages[first].content(kind))
        return _packed(f"{first[:-4]}.zip", {name: page.content(kind) for name, page in pages.items()})
    if kind == "scene":
        return _file(f"{scene.name}.toml", "application/toml", asked.text.encode())
    if kind in ("papers", "variants"):
        return _packed(f"{scene.name}-{kind}.zip", _papers(scene, asked, options))
    raise CallError.of("kind", f'"{kind!s:.40}"', "known here svg pdf png dxf papers variants")


def _file(name: str, media: str, content: bytes) -> Answer:
    return {"name": name, "type": media, "data": base64.b64encode(content).decode()}


def _packed(name: str, files: Mapping[str, bytes]) -> Answer:
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w", zipfile.ZIP_DEFLATED) as archive:
        for path, content in files.items():
            archive.writestr(path, content)
    return _file(name, "application/zip", packed.getvalue())


def _papers(scene: Mechanism, asked: Message, options: FigureOptions) -> dict[str, bytes]:
    """The papers of a scene, or a set of its variants, by name.  Raises CallError where no variant could be made."""
    from graphkin.api.classroom.handouts import handout, papers_of
    from graphkin.api.classroom.problem_sets import problem_set
    from graphkin.table import have

    formats = ("html", "pdf") if have("typst") else ("html",)
    spoken, school = options.language, options.convention
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        if asked.kind == "papers":
            handout(scene, out=folder, at=asked.at, formats=formats, language=spoken, convention=school)
        else:
            render = papers_of(scene, formats, spoken, school)
            made = problem_set(scene, variants=asked.count, seed=options.seed, out=folder, render=render)
            if not made.answers:
                raise CallError(*(Problem(variant.name, variant.why) for variant in made.failures))
        files = sorted(p for p in folder.rglob("*") if p.is_file() and not p.name.startswith("."))
        return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def scene_link(text: str) -> str:
    """A link that contains the text of a scene.

    >>> text_of_link(scene_link('title = "x"'))
    'title = "x"'
    """
    return LINK + base64.urlsafe_b64encode(zlib.compress(text.encode(), 9)).decode().rstrip("=")


def text_of_link(link: str) -> str:
    """The scene's text in a link.  Raises CallError for another link."""
    body = link.strip().removeprefix(LINK)
    try:
        data = base64.urlsafe_b64decode(body + "=" * (-len(body) % 4))
        unpacked = zlib.decompressobj()
        text = unpacked.decompress(data, LARGEST_FILE + 1)
        if not unpacked.eof or len(text) > LARGEST_FILE:
            raise ValueError
        return text.decode()
    except (ValueError, zlib.error):
        raise CallError.of("link", "carries no scene", Phrase("a link begins with", link=LINK),
                           link=link[:40]) from None


def _names(shelf: Shelf, asked: Message) -> Answer:
    """The words of the page in a language."""
    names = {key.removeprefix("page "): text for key, text in area("page", asked.spoken).items()}
    own_names: Answer = {each: word("name of the language", each) for each in LANGUAGES}
    return {"words": names, "language": asked.spoken, "languages": own_names, "figures": list(figure_kinds())}


QUESTIONS: Mapping[str, tuple[tuple[str, ...], Callable[[Shelf, Message], Answer]]] = {
    "show": (("text",), _show), "pull": (("text", "point", "x", "y"), _pull), "keep": (("text",), _keep),
    "change": (("text", "changes"), lambda _, asked: {"text": changed(asked.text, asked.changes)}),
    "build": (("text", "step"), lambda _, asked: {"text": building.built(asked.text, asked.step)}),
    "complete": (("text", "line", "column"), _complete), "open": ((), _open),
    "shelf": ((), lambda shelf, _: {
        "scenes": shelf.listing(), "new": sorted(NEW), "writes": shelf.folder is not None, "only": shelf.only,
    }),
    "thumbnail": ((), _thumbnail),
    "save": (("text",), lambda shelf, asked: {"mark": shelf.save(asked.name, asked.text, asked.mark)}),
    "watch": ((), lambda shelf, asked: {"changed": shelf.changed(asked.name, asked.mark)}),
    "race": (("text",), _race), "diagrams": (("text",), _diagrams), "export": (("text", "kind"), _export),
    "link": (("text",), lambda _, asked: {"link": scene_link(asked.text)}), "names": ((), _names),
}
"""What the page may ask, by name: what the message needs, and what it is told."""
