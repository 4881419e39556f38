"""Instant centres in plain text: a table of them, why some need another way, and the velocities through them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from graphkin.api.centred import Centred
from graphkin.drafting.centres import Centre, velocity_sentences
from graphkin.drafting.centres.pairs import Pair
from graphkin.scene.symbol import PointRef
from graphkin.words import Phrase, languages, say, word

__all__ = ["ToldCentres", "told_centres"]


@dataclass(frozen=True)
class ToldCentres:
    """Heads and rows of the table, and sentences below it."""

    heads: list[str]
    rows: list[tuple[str, str, str, str]]
    sentences: list[str]


def told_centres(centred: Centred) -> ToldCentres:
    """All centres of a position in words, in the language of the result."""
    language = languages(centred.language or centred.scene.sheet.language)[0]
    letter = "P" if (centred.convention or centred.scene.sheet.convention) in ("chinese", "russian") else "I"

    def name(pair: object) -> str:
        if not isinstance(pair, tuple):
            return pair.point if isinstance(pair, PointRef) else str(pair)
        a, b = sorted(pair, key=lambda n: (not n.isdigit(), int(n) if n.isdigit() else 0, n))
        return f"{letter}{a}{',' if len(a + b) > 2 else ''}{b}"

    rows = []
    for pair, centre in sorted(centred.centres.table.items(), key=lambda item: item[1].number):
        row = centred.data["centres"]["-".join(pair)]
        least = 1e-12 * centred.scene.size / centred.scene.units.metres
        place = ", ".join(f"{x if abs(x) > least else 0.0:.6g}" for x in row.get("point", row.get("direction", [])))
        if "direction" in row:
            place = f"∞ ({place})"
        how = say(_phrase(centre, name, ", ".join(centred.centres.kept)), language, name)
        rows.append((str(centre.number or ""), name(pair), place, how))
    sentences = [say(c.why, language, str) for c in centred.centres.indeterminate if c.why]
    sentences += [""] if sentences else []
    sentences.append(word("velocities by centres", language))
    for phrase in velocity_sentences(centred.centres, centred.turning):
        sentences.append(say(phrase, language, name).replace("_{", "").replace("}", ""))
    off = [name(p) for p, e in centred.errors.items() if e is not None and e > 1e-9]
    off += [str(v.symbol) for v in centred.velocities if not v.ok]
    count = sum(e is not None for e in centred.errors.values())
    verdict = Phrase("check failed", (", ".join(off),)) if off else Phrase("centres checked", (count,))
    sentences.append(say(verdict, language))
    heads = ["", *(word(key, language) for key in ("centre", "place", "how found"))]
    return ToldCentres(heads, rows, sentences)


def _phrase(centre: Centre, name: Callable[[object], str], kept: str) -> Phrase:
    """How a centre was found, as a sentence to be."""
    if centre.kind == "undetermined":
        return Phrase("centre none", (centre.pair,))
    if centre.kind == "permanent":
        return Phrase("centre joint" if centre.point is not None else "centre guide", (centre.pair, centre.joint))
    if centre.way:
        return Phrase(f"centre {centre.way}", (centre.pair, kept))
    lines = [_line(line.through, name) for line in centre.lines]
    return Phrase("centre crossing" if centre.point is not None else "centre crossing far", (centre.pair, *lines))


def _line(through: tuple[Pair, Pair] | tuple[str], name: Callable[[object], str]) -> str:
    return "".join(name(p) if isinstance(p, tuple) else f"n({p})" for p in through)
