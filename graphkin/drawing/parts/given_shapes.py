"""How links are shaped beyond the distances of their points, as given data: guides that they carry, at which angle they
sit on what they slide on, and where further points of links without two points of their own lie.
"""

from __future__ import annotations

import math
import re
from cmath import phase
from collections.abc import Iterator

from graphkin.account.headings import number
from graphkin.account.notation import Letters
from graphkin.scene.model import Mechanism, PlacedLink
from graphkin.scene.pairs import PlacedGuide, SlidingPair
from graphkin.words import Phrase, languages, say

_BETWEEN_CHINESE = re.compile(r"(?<=[\u4e00-\u9fff]) (?=[\u4e00-\u9fff])")
LEVEL = 1e-9  # of directions and of lengths by the size of a scene: what rounding leaves


def given_shapes(scene: Mechanism, letters: Letters, language: str) -> list[str]:
    """The shapes of links as short phrases, symbols between dollar signs: ``guide s on 3: 140 mm from C, 90° to x``.

    Angles are those of lines, from -90 to 90 degrees, counter-clockwise positive; places are along the guide on which
    the link slides and to the left of it.
    """
    whole = scene.whole
    found = [phrase for link in whole.links if not link.redundant for phrase in _shape(whole, link, letters)]
    told = ((_BETWEEN_CHINESE.sub("", say(phrase, each)) for each in languages(language)) for phrase in found)
    return [" ".join(dict.fromkeys(shape)) for shape in told]


def _shape(scene: Mechanism, link: PlacedLink, letters: Letters) -> Iterator[Phrase]:
    pairs = along_its_guide(scene, link)
    axis = _axis(scene, link, pairs, letters)
    turn = pairs[0].turn if pairs and len(link.bar) < 2 else 1.0 + 0j
    if len(pairs) == 2:
        first, second = (_guide_name(scene, pair, letters) for pair in pairs)
        angle = number(as_line(pairs[0].turn / pairs[1].turn))
        yield Phrase("guides at angle", first=first, second=second, angle=angle)
    elif pairs and (len(link.bar) == 2 or _carries_its_axis(scene, link)) and abs(pairs[0].turn.imag) > LEVEL:
        own = axis if len(link.bar) == 2 else Phrase("axis of", link=link.name)
        held_to = _guide_name(scene, pairs[0], letters)
        yield Phrase("held at angle", bar=own, angle=number(as_line(pairs[0].turn)), axis=held_to)
    beside = off_its_guide(scene, link) if len(link.bar) < 2 else []
    if not pairs and len(link.points) <= 2 and not _axis_counts(scene, link):
        beside = []
    for point in beside:
        z = link.points[point]
        name = f"${letters.point(point)}$"
        if pairs:
            place, origin = _pair(z * turn, scene), _origin(link, letters)
            yield Phrase("point along", point=name, place=place, origin=origin, axis=axis)
        else:
            bar = f"${letters.point(link.bar[0])}{letters.point(point)}$" if link.bar else name
            yield Phrase("held at angle", bar=bar, angle=number(math.degrees(phase(z))), axis=axis)
    guides = used_guides(scene, link)
    alone = not pairs and len(link.bar) < 2 and len(guides) == 1 and not beside and not _carries_its_axis(scene, link)
    for guide in guides:
        name = f"${letters.guide(guide.name, scene.frame.name)}$"
        angle = number(as_line(guide.direction * turn))
        on = next((p for p, z in link.points.items() if abs(z - guide.through) < LEVEL * scene.size), None)
        if alone and on is not None:  # what its angle counts from is nothing else's
            yield Phrase("guide on link only through", guide=name, link=link.name, point=f"${letters.point(on)}$")
        elif on is None and abs(guide.through) < LEVEL * scene.size:
            yield Phrase("guide on link", guide=name, link=link.name, angle=angle, axis=axis)
        elif on is not None:
            point = f"${letters.point(on)}$"
            yield Phrase("guide on link through", guide=name, link=link.name, point=point, angle=angle, axis=axis)
        else:
            place = _pair(guide.through * turn, scene)
            at = {"place": place, "origin": _origin(link, letters), "axis": axis}
            yield Phrase("guide on link at", guide=name, link=link.name, **at, angle=angle)


def along_its_guide(scene: Mechanism, link: PlacedLink) -> list[SlidingPair]:
    """The sliding pairs in which a link slides on others."""
    return [pair for pair in scene.slidings if pair.link == link.name]


def off_its_guide(scene: Mechanism, link: PlacedLink) -> list[str]:
    """Further points of a link that lie beside its own axis."""
    return [p for p, z in link.points.items() if p not in link.bar and abs(z.imag) > LEVEL * scene.size]


def used_guides(scene: Mechanism, link: PlacedLink) -> list[PlacedGuide]:
    """The guides of a link, beside its own axis, on which something slides or which touch something."""
    used = {guide for on, guide in _ridden(scene) if on == link.name}
    used |= {
        c.guide for c in scene.contacts
        for body, disc in zip(c.links, c.discs, strict=True) if body == link.name and disc is None
    }  # fmt: skip
    return [guide for name, guide in link.guides.items() if name and name in used]


def as_line(way: complex) -> float:
    """The angle of a line (degrees), above -90 to 90."""
    angle = math.degrees(phase(way))
    return 90.0 if abs(abs(angle) - 90.0) < 1e-9 else math.remainder(angle, 180.0) + 0.0


def _carries_its_axis(scene: Mechanism, link: PlacedLink) -> bool:
    """Whether something slides on a link's own axis."""
    return (link.name, "") in _ridden(scene)


def _ridden(scene: Mechanism) -> set[tuple[str, str]]:
    """The guides on which links or pins slide, with the links that have them."""
    return {(s.on, s.guide) for s in scene.slides}


def _axis_counts(scene: Mechanism, link: PlacedLink) -> bool:
    """Whether anything is told from a link's own axis."""
    turned = any(link.name in d.links for d in scene.drivers if d.turns)
    return turned or _carries_its_axis(scene, link) or bool(used_guides(scene, link))


def _guide_name(scene: Mechanism, pair: SlidingPair, letters: Letters) -> str:
    if pair.guide:
        return f"${letters.guide(pair.guide, scene.frame.name)}$"
    on = scene.by_name[pair.on]
    return "$x$" if pair.on == scene.frame.name else _own(on, letters)


def _own(link: PlacedLink, letters: Letters) -> str:
    """The own axis of a link: its bar, else its number."""
    return f"${''.join(letters.point(p) for p in link.bar)}$" if len(link.bar) == 2 else link.name


def _axis(scene: Mechanism, link: PlacedLink, pairs: list[SlidingPair], letters: Letters) -> str | Phrase:
    """From what angles on a link count: its bar, the guide on which it slides, else its own axis."""
    if len(link.bar) == 2:
        return _own(link, letters)
    return _guide_name(scene, pairs[0], letters) if pairs else Phrase("axis of", link=link.name)


def _origin(link: PlacedLink, letters: Letters) -> str:
    """Where a link's own axes begin."""
    return f"${letters.point(link.bar[0])}$" if link.bar else f"({link.name})"


def _pair(z: complex, scene: Mechanism) -> str:
    unit = scene.units
    least = LEVEL * scene.size / unit.metres
    x, y = (part / unit.metres for part in (z.real, z.imag))
    return f"({number(x if abs(x) > least else 0.0)}, {number(y if abs(y) > least else 0.0)}) {unit.length}"
