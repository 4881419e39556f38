"""Why a mechanism has more freedom than was meant: points that nothing joins, links that hang on one pin.

The commonest cause is a slip of the hand, a name written in two ways; the next a roller, whose own turning moves
nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from difflib import get_close_matches

from graphkin.errors import Problem
from graphkin.scene.model import PlacedLink
from graphkin.structure.constraints import Constraints

__all__ = ["loose_ends"]


def loose_ends(system: Constraints) -> tuple[Problem, ...]:
    """What lets links of a scene move that should not, by name: nothing where all hang together."""
    return tuple(_found(system))


def _found(system: Constraints) -> Iterator[Problem]:
    scene = system.scene
    moving = [link for name, link in system.links.items() if name in scene.by_name and name != scene.frame.name]
    unused = [p for p in scene.frame.points if p not in system.hinges]
    free = {link.name: [p for p in link.bar if not _held(system, p)] for link in moving}
    lonely = [p for points in free.values() for p in points]
    for link in moving:
        joints = _joints(system, link)
        ends = free[link.name]
        if len(joints) >= 2:
            continue
        for point in ends:
            like = _like(point, unused) or _like(point, [p for p in lonely if p not in link.points])
            wanted = f"did you mean {like}?" if like else "write the same name in the link that it shall be joined to"
            if like in unused:
                wanted = f"did you mean {like}, a point of the frame that no link has?"
            yield Problem(f"links.{link.name}", f"no other link has its point {point}{_hangs(joints)}", wanted)
        if not ends and len(joints) == 1 and system.mobility().value > len(scene.drivers):
            found = f"it hangs on {joints[0]} alone and turns there freely"
            wanted = "join it to another link too; or leave it out, as a roller whose own turning moves nothing else"
            yield Problem(f"links.{link.name}", found, wanted)
        if not ends and not joints:
            yield Problem(f"links.{link.name}", "nothing holds it", "name a point of another link, or a guide")


def _held(system: Constraints, point: str) -> bool:
    """Whether something else has a point too, or a pin of it runs in a slot."""
    on_cam = any(cam.name_of_point == point for cam in system.cams)
    return on_cam or point in system.hinges or any(s.slot and s.pin == point for s in system.slides)


def _joints(system: Constraints, link: PlacedLink) -> list[str]:
    """The hinges and slides of a link."""
    hinges = [p for p, names in system.hinges.items() if link.name in names]
    slides = [s.key for s in system.slides if link.name in (s.a, s.b)]
    return hinges + slides + [cam.key for cam in system.cams if link.name in (cam.link, cam.follower)]


def _hangs(joints: Sequence[str]) -> str:
    return f", so that it hangs on {joints[0]} alone" if joints else ""


def _like(point: str, names: Sequence[str]) -> str:
    """The name that resembles a point's most, "" if none does."""
    near = get_close_matches(point, names, n=1, cutoff=0.5)
    return near[0] if near else next((n for n in names if n.lower()[:1] == point.lower()[:1]), "")
