"""Questions for learning platforms: pictures, tolerances from the key, feedback for the usual slips.

Moodle XML (numerical and cloze questions, docs.moodle.org "Moodle XML format"), GIFT (docs.moodle.org "GIFT format"),
and the folder of a PrairieLearn question (prairielearn.readthedocs.io "Question writing").
"""

from __future__ import annotations

import base64
import json
import re
import uuid
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from xml.sax.saxutils import escape

from markupsafe import Markup

from graphkin.account.headings import structure_words
from graphkin.checking.slips import Evidence
from graphkin.construction import Plan
from graphkin.errors import GraphkinError
from graphkin.papers.blocks import clean, in_each
from graphkin.papers.documents import coincident_points, given, key_rows, reach, scene_title
from graphkin.papers.html import rendered, said_html, words_html
from graphkin.papers.lesson import Lesson
from graphkin.papers.pictures import mechanism_picture
from graphkin.scene.symbol import Symbol
from graphkin.solver import Motion
from graphkin.words import languages, say, word

PLATFORMS = ("moodle", "gift", "prairielearn")
BANKED = ("moodle.xml", "questions.gift")
"""Files of single questions that are put together for a set."""
MOST_SLIPS = 6
PICTURE = "mechanism.png"
DPI = 96.0
_NOTHING = re.compile(r"[^A-Za-z0-9]+")


@dataclass(frozen=True)
class AskedNumber:
    """An asked number: symbol, letters (HTML, plain), unit, value, tolerance; wrong values, each with its slip."""

    symbol: str
    html: str
    plain: str
    unit: str
    value: float
    tolerance: float
    slips: tuple[tuple[float, str], ...] = ()

    @property
    def answers(self) -> tuple[tuple[int, str, str, str], ...]:
        """The right answer and the known wrong ones: share of the mark (%), value, tolerance, feedback."""
        right = 100, f"{self.value:.10g}", f"{self.tolerance:.3g}", ""
        return right, *((0, f"{value:.10g}", f"{self.tolerance / 2:.3g}", words) for value, words in self.slips)


@dataclass(frozen=True)
class Question:
    """A problem for a platform: title, structure and data as HTML, the figure (PNG), and its description."""

    name: str
    title: str
    html: str
    picture: bytes
    seen: str
    asked: tuple[AskedNumber, ...]
    sign_rule: str
    number: str

    @property
    def key(self) -> str:
        """A name that a file can have."""
        return _NOTHING.sub("-", self.name).strip("-") or "question"


def question_of(lesson: Lesson, planned: Plan, motion: Motion, name: str) -> Question:
    """The question of a lesson, drawn by a plan; quantities without a bound of the drawing's error are left out."""
    evidence = Evidence.of(planned, motion, lesson.tolerance)
    first, scene = lesson.first, lesson.sheet.scene
    built = in_each(
        lesson.language, lambda each: word("between sentences", each).join(structure_words(scene.whole, each))
    )
    paragraphs = [built, *(p.words for p in (*given(lesson), *coincident_points(lesson), *reach(lesson)))]
    drawing = mechanism_picture(lesson)
    asked = []
    for row in key_rows(lesson):
        if not row.asked or not row.tolerance or row.tolerance >= abs(row.exact):
            continue
        symbol = Symbol.parse(row.symbol)
        letters = lesson.letters.vector(symbol)
        slips = tuple(_slips(lesson, evidence, symbol, row.exact, row.tolerance, first))
        names = row.symbol, words_html(letters, first), str(letters), row.unit
        asked.append(AskedNumber(*names, row.exact, row.tolerance, slips))
    return Question(
        name,
        clean(str(scene_title(lesson)[0][1])),
        "".join(said_html(words, "p") for words in paragraphs),
        drawing.content("png", DPI),
        clean(drawing.desc),
        tuple(asked),
        " ".join(word("sign of answers", each) for each in languages(lesson.language)),
        scene.name,
    )


def _slips(
    lesson: Lesson, evidence: Evidence, symbol: Symbol, right: float, tolerance: float, language: str
) -> Iterator[tuple[float, str]]:
    """The commonest slips whose values differ clearly from the right value and from each other."""
    taken = [right]
    try:
        suspects = sorted(evidence.suspects(symbol).all, key=lambda s: -s.share)
    except GraphkinError:
        return
    for suspect in suspects:
        value = abs(suspect.value) if symbol.is_vector else float(complex(suspect.value).real)
        value = lesson.in_unit(symbol, value)
        if any(abs(value - other) <= 2 * tolerance for other in taken):
            continue
        taken.append(value)
        said = say(suspect.phrase, language)
        yield value, clean(said[:1].upper() + said[1:])
        if len(taken) > MOST_SLIPS:
            return


def files_for(question: Question, platforms: Sequence[str]) -> dict[str, bytes]:
    """The files of one question by name, for each of the platforms."""
    made: dict[str, bytes] = {}
    if "moodle" in platforms:
        made["moodle.xml"] = moodle_bank(question.number, [moodle_entries(question)])
    if "gift" in platforms:
        made["questions.gift"] = gift(question).encode()
    if "prairielearn" in platforms:
        made |= {f"prairielearn/{question.key}/{name}": data for name, data in prairielearn(question).items()}
    return made


def bank(category: str, files: Sequence[Mapping[str, bytes]]) -> dict[str, bytes]:
    """A bank of the questions of many variants, from the files of each."""
    texts = {name: [made[name].decode() for made in files if name in made] for name in BANKED}
    moodle = [text[text.index(_CUT) : text.rindex("</quiz>")] for text in texts["moodle.xml"]]
    gifts = f"$CATEGORY: {category}\n\n" + "\n".join(texts["questions.gift"])
    banks = {"moodle.xml": moodle_bank(category, moodle), "questions.gift": gifts.encode()}
    return {name: whole for name, whole in banks.items() if texts[name]}


# Moodle

_CUT = "<!-- questions -->"


def moodle_bank(category: str, entries: Sequence[str]) -> bytes:
    """A file of questions under one category."""
    return rendered("moodle.xml", category=category, questions=Markup("".join(entries))).encode()


def moodle_entries(question: Question) -> str:
    """A cloze question with all asked quantities, and a numerical question for each."""
    return rendered(
        "moodle_questions.xml",
        question=question,
        body=partial(_body, question, f"@@PLUGINFILE@@/{PICTURE}"),
        field=_cloze_field,
        cdata=lambda html: Markup("<![CDATA[" + str(html).replace("]]>", "]]]]><![CDATA[>") + "]]>"),
        PICTURE=PICTURE,
        CUT=Markup(_CUT),
    )


def _body(
    question: Question,
    source: str,
    asked: Sequence[AskedNumber],
    field: Callable[[AskedNumber], str] | None = None,
) -> str:
    """The HTML of a question: structure, data, figure, rule of signs, asked quantities with their fields or units."""
    return rendered("question.html", question=question, source=source, asked=asked, field=field)


def _cloze_field(asked: AskedNumber) -> str:
    answers = (
        f"%{share}%{value}:{tolerance}#{said}" if said else f"={value}:{tolerance}"
        for share, value, tolerance, words in asked.answers
        for said in (re.sub(r"([}#~/\"\\])", r"\\\1", escape(words)),)
    )
    return "{1:NUMERICAL:" + "~".join(answers) + "}"


# GIFT


def gift(question: Question) -> str:
    """The question in GIFT, with the figure as a data URI: a numerical question in HTML for each quantity."""
    figure = f"data:image/png;base64,{base64.b64encode(question.picture).decode()}"
    made = []
    for asked in question.asked:
        title = _gift_words(f"{question.title}: {asked.plain}")
        ask = _gift_words(_body(question, figure, [asked]))
        answers = [f"=%{share}%{v}:{within}#{_gift_words(escape(words))}" for share, v, within, words in asked.answers]
        made.append(f"::{title}::[html]{ask} {{#\n" + "\n".join(answers) + "\n}\n")
    return "\n".join(made)


def _gift_words(words: str) -> str:
    return re.sub(r"([~=#{}:\\])", r"\\\1", words).replace("\n", " ")


# PrairieLearn


def prairielearn(question: Question) -> dict[str, bytes]:
    """The files of a question's folder by name."""
    right, slips = {}, {}
    for asked in question.asked:
        (_, value, _, _), *others = asked.answers
        right[_variable(asked)] = float(value)
        slips[_variable(asked)] = [[float(value), float(tolerance), words] for _, value, tolerance, words in others]
    info = {
        "uuid": str(uuid.uuid5(uuid.NAMESPACE_URL, f"graphkin/{question.name}/{question.title}/{right}")),
        "title": question.title,
        "topic": "Mechanisms",
        "tags": ["graphical"],
        "type": "v3",
    }
    return {
        "info.json": (json.dumps(info, ensure_ascii=False, indent=2) + "\n").encode(),
        "question.html": rendered("prairielearn.html", question=question, variable=_variable, PICTURE=PICTURE).encode(),
        "server.py": rendered("prairielearn.py.txt", right=repr(right), slips=repr(slips)).encode(),
        f"clientFilesQuestion/{PICTURE}": question.picture,
    }


def _variable(asked: AskedNumber) -> str:
    return _NOTHING.sub("_", asked.symbol.replace("+", "_plus")).strip("_")
