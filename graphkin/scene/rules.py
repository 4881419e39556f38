"""Rules that a file's entries must keep among themselves, before any length is looked at."""

from __future__ import annotations

import unicodedata

from graphkin.errors import Problem
from graphkin.scene.file import Compass, Polar, SceneFile
from graphkin.scene.names import Names
from graphkin.scene.placing import circle_of_references
from graphkin.scene.reading import Flaws

__all__ = ["not_held", "nowhere_placed", "unwritable_texts", "wrong_own_points"]


def unwritable_texts(file: SceneFile) -> list[Problem]:
    """Texts that cannot be written on one line of a sheet."""
    found = []
    for key in ("title", "title_zh", "source"):
        text = getattr(file, key)
        if any(unicodedata.category(c) in ("Cc", "Cs", "Cn", "Zl", "Zp") for c in text):
            found.append(Problem(key, "holds a control character or a line break", "write one line of plain text"))
    return found


def wrong_own_points(file: SceneFile, names: Names, flaws: Flaws) -> list[Problem]:
    """What is wrong with the own points of the links."""
    found = []
    if names.frame in file.links:
        found.append(Problem("frame.name", f'the frame is named "{names.frame}" as a moving link is',
                             "give the frame a name of its own"))
    for name, link in file.links.items():
        where, own = f"links.{name}", link.points
        if len(own) > 2:
            found.append(Problem(f"{where}.points", f"found {len(own)} names ({', '.join(own[:6])})",
                                 f"two at most; place {own[2]} in at = {{ {own[2]} = [x, y] }}"))
        twice = sorted({p for p in own if own.count(p) > 1})
        if twice:
            found.append(Problem(f"{where}.points", f"{twice[0]} stands there twice", "a bar has two different points"))
        if link.length is not None and len(own) < 2 and name not in names.unsure:
            found.append(Problem(f"{where}.length", f"found {link.length:g} with {len(own)} own point"
                                 f"{'' if len(own) == 1 else 's'}", "a length needs two names in points"))
        if not own and link.on is None and name not in names.unsure and not flaws.under("links", name, "on"):
            found.append(Problem(where, "has neither points nor on, so nothing places or holds it",
                                 'write points = ["A", "B"], or on = "..." for a link that slides'))
    return found


def nowhere_placed(file: SceneFile, names: Names, flaws: Flaws) -> list[Problem]:
    """Points that ``at`` and ``guides`` refer to and that are nowhere placed."""
    found: list[Problem | None] = []
    drawn_lost = flaws.under("drawn")
    for name, link in file.links.items():
        for point, entry in link.at.items():
            where = f"links.{name}.at.{point}"
            if isinstance(entry, Polar):
                refs = [("from", entry.origin)] + ([("toward", entry.toward)] if entry.toward else [])
                found += [names.no_point_of(f"{where}.{key}", name, ref) for key, ref in refs]
            elif isinstance(entry, Compass):
                found += [names.no_point_of(f"{where}.from", name, ref) for ref in entry.origins]
            elif entry == "drawn" and point not in file.drawn and point not in file.frame.points and not drawn_lost:
                found.append(Problem(where, f'is "drawn", but {point} is not in [drawn]',
                                     f"write {point} = [x, y] in [drawn]"))
        circle = circle_of_references(link)
        if circle:
            found.append(Problem(f"links.{name}.at", f"{', '.join(circle)} are placed from one another",
                                 "place one of them by [x, y] or from an own point of the link"))
    tables = [(f"links.{n}", n, link.guides) for n, link in file.links.items()]
    for where, name, guides in (*tables, ("frame", names.frame, file.frame.guides)):
        for guide, rail in guides.items():
            here, aim = f"{where}.guides.{guide}", rail.toward
            if isinstance(rail.through, str):
                found.append(names.no_point_of(f"{here}.through", name, rail.through))
            if rail.angle is None and aim is None:
                found.append(Problem(here, "has no direction", "write angle = ... in degrees, or toward = a point"))
            world = {*file.drawn, *file.frame.points}
            if aim and aim not in world and not drawn_lost and names.no_point_of("", name, aim):
                found.append(Problem(f"{here}.toward", f"{aim} is no point of link {name}, nor fixed or drawn",
                                     f"write {aim} = [x, y] in [drawn], or the direction as angle"))
    return [p for p in found if p]


def not_held(group: tuple[str, ...], names: Names) -> Problem:
    hint = f"share a point with another link, or slide; the frame is link {names.frame}"
    if len(group) == 1:
        return Problem(f"links.{group[0]}", "nothing holds this link", hint)
    return Problem("links " + ", ".join(group), "nothing joins these links to the frame", hint)
