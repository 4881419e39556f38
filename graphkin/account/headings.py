"""The words of a figure: its titles and remarks, facts for programs, and the description of the whole figure for
readers who do not see it; in one language or both.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping

from graphkin.account.notation import unit_of
from graphkin.account.spoken import spoken_vector
from graphkin.construction.board.sheet import Sheet
from graphkin.construction.board.steps import DiagramName, Direction, plain_in
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import told
from graphkin.version import __version__
from graphkin.words import Neutral, Phrase, in_all, languages, listed, say, word
from graphkin.words.written import ROUNDED, amount, on_paper, pointing, printed, product

FIGURE_WORDS: Mapping[DiagramName, str] = {
    "mechanism": "mechanism", "velocity": "velocity polygon", "acceleration": "acceleration polygon", "force": "forces",
}
"""What each figure is called, as a key of the table of words."""



def term(key: str, language: str, otherwise: str | None = None, **values: str) -> str:
    """A word in a language; for "both" in both, its values once.  ``otherwise`` for a word that no table has.

    >>> term("detail", "both", scale="5"), term("forces", "both"), term("law 345", "both")
    ('Detail 局部放大图 5 : 1', 'Forces 力分析', '3-4-5 多项式')
    """
    if values:
        lines = in_all(Phrase(key, **{gap: Neutral(value) for gap, value in values.items()}), language)
        return " ".join(map(str, lines))
    words = tuple(dict.fromkeys(word(key, each, otherwise) for each in languages(language)))
    return " ".join(name for name in words if not any(other.startswith(f"{name} ") for other in words))


def punctuation(key: str, language: str) -> str:
    """A mark of punctuation behind words of ``term``."""
    return word(key, languages(language)[-1])


# Words of a title that tell the scene's own position: "position 7", "crank at 40 deg", "位置 7".
_OWN_POSITION = re.compile(
    r"[,;:，；：、]?\s*(?:(?:in|at)\s+)?(?:position|pos\.)\s+[\w'′]+|[,;:，；：、]?\s*位置\s*[\w'′]+"
    r"|[,;:，；：、]?\s*(?:\w+\s+)?at\s+-?[\d.]+\s*(?:deg(?:rees)?\b|°)",
    re.IGNORECASE,
)


def titles(sheet: Sheet, language: str) -> tuple[str, ...]:
    """The title of the scene in each language; away from its own position without the words for that."""
    scene = sheet.scene
    unmoved = all(
        d.distance is not None or math.isclose(sheet.drivers[d.key], d.values[0], rel_tol=1e-9, abs_tol=1e-12)
        for d in scene.drivers
    )
    texts = (scene.question.title_in(each) or scene.name for each in languages(language))
    return tuple(dict.fromkeys(title if unmoved else _OWN_POSITION.sub("", title).strip() for title in texts))


def dimensions_in(sheet: Sheet, language: str) -> str:
    """The unit of dimensions, where it is not the millimetre, the default."""
    unit = sheet.scene.units.length
    if unit == "mm":
        return ""
    *others, last = languages(language)
    shared = word(f"unit {unit}", last)  # once, where both languages write it alike
    said = [say(Phrase("dimensions in", unit=word(f"unit {unit}", each)), each) for each in (*others, last)]
    return " / ".join((*(text.removesuffix(f" {shared}") for text in said[:-1]), said[-1]))


def number(value: float, digits: int = 6) -> str:
    """A number for people: no exponent where possible, a typographic minus sign.

    >>> number(-10.0), number(0.1230)
    ('−10', '0.123')
    """
    return printed(amount(value, digits))


DRAWN = ("length", "velocity", "acceleration")


def facts(sheet: Sheet, figure: str) -> dict[str, object]:
    """The facts of a figure for programs, in scene units: for the metadata of the file."""
    scene = sheet.scene
    at = {d.key: round(scene.unit_of(d).of(sheet.drivers[d.key]), 9) for d in scene.drivers}
    scales = {
        measure: float(f"{getattr(sheet.scales, measure) / scene.units.of(measure).si:.12g}") for measure in DRAWN
    }
    return {
        "figure": figure,
        "scene": scene.name,
        "units": {"length": scene.units.length, "time": "s", "angle": "deg", "paper": "mm"},
        "at": at,
        "scales": scales,
        "instrument": sheet.instrument,
        "graphkin": __version__,
    }


def figure_title(sheet: Sheet, figure: str, language: str) -> str:
    """Title of a figure as one line."""
    named = zip(languages(language), titles(sheet, language) * 2, strict=False)
    return " / ".join(title + word("colon", each) + word(figure, each) for each, title in named)


def describe(sheet: Sheet, diagrams: tuple[DiagramName, ...], language: str) -> str:
    """The content of a figure in sentences: the mechanism as it is built, each step, each found vector."""
    said = (word("between sentences", each).join(_sentences(sheet, diagrams, each)) for each in languages(language))
    return "\n".join(said)


def _sentences(sheet: Sheet, diagrams: tuple[DiagramName, ...], language: str) -> list[str]:
    said = []
    if "mechanism" in diagrams:
        said += structure_words(sheet.scene, language)
        unit, per_mm = sheet.scene.units.length, sheet.scales.length / sheet.scene.units.metres
        for ref, z in sheet.points.items():
            x, y = (number(part * per_mm if abs(part) > ROUNDED else 0.0, 5) for part in (z.real, z.imag))
            said.append(say(Phrase("point lies", point=ref.point, x=x, y=y, unit=unit), language))
    for diagram in diagrams:
        said += (f"{step.number}. {_sentence(step.phrase, language)}" for step in sheet.of(diagram))
        if diagram != "mechanism":
            said += _vectors(sheet, diagram, language)
    said += (_sentence(note, language) for note in remarks(sheet))
    return said


def remarks(sheet: Sheet) -> list[Phrase]:
    """The remarks on the drawing as a whole: badly conditioned crossings, parallel legs."""
    return list(dict.fromkeys(r.phrase for r in sheet.remarks if r.key != "zero vector"))


def structure_words(scene: Mechanism, language: str) -> list[str]:
    """Sentences on the joints: the links with their points, and the pairs that are no turning pairs."""
    fixed, name = [*scene.frame.points], scene.frame.name
    key = ("fixed link bare", "fixed link one", "fixed link")[min(len(fixed), 2)]
    said = [say(Phrase(key, link=name, **({"points": listed(fixed)} if fixed else {})), language)]
    for link in scene.links:
        if points := scene.own_points(link):
            said.append(say(Phrase("link joins", link=link.name, points=listed(points)), language))
    return said + [say(told(pair, "built"), language) for pair in scene.pairs]


def _vectors(sheet: Sheet, diagram: DiagramName, language: str) -> list[str]:
    unit = unit_of(sheet, diagram)
    per_mm = sheet.scales.of(diagram) / unit.si
    said = []
    for symbol, vector in sheet.vectors[diagram].items():
        words = _capital(spoken_vector(symbol, language))
        if vector.span == 0.0:
            said.append(say(Phrase("vector is zero", vector=words), language))
            continue
        size = on_paper(abs(vector.span))
        phrase = Phrase(
            "vector is", vector=words, size=printed(product(size, amount(per_mm, 12))), unit=unit.written,
            length=printed(size), angle=pointing(vector.span),
        )
        said.append(say(phrase, language))
    return said


def _sentence(said: Phrase, language: str) -> str:
    """A phrase as a sentence: symbols without marks between point and link, ``v_B3/B2``, directions as lines."""
    plain = plain_in(language)

    def shown(part: object) -> str:
        if isinstance(part, Direction) and part.relation != "towards":
            return ("∥" if part.relation == "along" else "⊥") + "".join(part.names)
        return plain(part).replace("@", "")

    text = say(said, language, shown)
    return _capital(text).rstrip("。.") + word("full stop", language)


def _capital(text: str) -> str:
    """A sentence with a capital first letter, unless it begins with a symbol."""
    letter = text[:1].isascii() and text[1:2] != "_"
    return (text[:1].upper() if letter else text[:1]) + text[1:]
