"""Springs as they are drawn between their points, as they are given, and how their forces were measured."""

from __future__ import annotations

from collections.abc import Iterator

from graphkin.construction.forces.force_sheet import ForceSheet
from graphkin.construction.sheet import Sheet
from graphkin.drawing import strokes, symbols
from graphkin.drawing.conventions import Letters
from graphkin.drawing.force_letters import force_letters
from graphkin.drawing.headings import number
from graphkin.drawing.labels import Label
from graphkin.drawing.mechanism_on_paper import MechanismOnPaper, page
from graphkin.drawing.piece import Piece
from graphkin.drawing.primitives import Group, Text
from graphkin.drawing.text import plain
from graphkin.scene.loads import SpringOn
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase, say

__all__ = ["spring_given", "spring_lines", "springs"]


def springs(here: MechanismOnPaper) -> Piece:
    """All springs between their points, with their names."""
    drawn, names = [], []
    for one in here.scene.loading.springs:
        if not {*one.links} <= {*here.sheet.poses}:
            continue
        poses = [(here.sheet.poses[link], at / here.sheet.scales.length) for link, at in one.ends]
        a, b = (pose.origin + pose.axis * at for pose, at in poses)
        drawn.append(Group(symbols.spring(page(a), page(b)), id=f"spring-{one.name}", classes=("spring",)))
        text = Text(0j, plain(one.name), "start", strokes.BLACK, f"label-spring-{one.name}", ("label",))
        names.append(Label(text, (page(a), page(b)), rank=1))
    return Piece({"mechanism": tuple(drawn)}, tuple(names)) if drawn else Piece()


def spring_given(scene: Mechanism, spring: SpringOn, letters: Letters, language: str) -> str:
    """What is given of a spring, in words with symbols."""
    units = scene.units
    one, two = (f"${letters.point(point)}$" for point in spring.points)
    rate = f"{number(spring.rate * units.metres / units.newtons)} {units.force}/{units.length}"
    free = f"{number(spring.free / units.metres)} {units.length}"
    preload = f"{number(spring.preload / units.newtons)} {units.force}"
    name = f"${force_letters(letters.convention, Symbol('P', name=spring.name))}$"
    told = (spring.name, one, spring.links[0], two, spring.links[1], rate, free, preload, name)
    return say(Phrase("given spring", told), language)


def spring_lines(sheet: Sheet, forces: ForceSheet, letters: Letters, language: str) -> Iterator[str]:
    """The force of each spring from its length as it was measured."""
    units = sheet.scene.units
    for spring in sheet.scene.loading.springs:
        name = Symbol("P", name=spring.name)
        own, other = (one for one in forces.states[0].known if one.symbol == name)
        length = abs(other.at - own.at) * sheet.scales.length
        force = spring.preload + spring.rate * (length - spring.free)
        preload = f"{number(spring.preload / units.newtons)} + " if spring.preload else ""
        rate = number(spring.rate * units.metres / units.newtons)
        stretch = f"({number(length / units.metres, 5)} − {number(spring.free / units.metres)})"
        size = f"{number(force / units.newtons, 5)} {units.force}"
        markup = force_letters(letters.convention, name)
        ends = "".join(letters.point(p) for p in spring.points)
        told = (f"${markup}$ = {preload}{rate} × {stretch} = {size}", ends, spring.links[0])
        key = "force spring" if force >= 0 else "force spring pushes"
        yield say(Phrase(key, told), language)
