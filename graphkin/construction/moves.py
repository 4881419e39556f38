"""The moves by which a group larger than a dyad is drawn in a polygon, each by ways from point to point."""

from __future__ import annotations

from dataclasses import dataclass

from graphkin.construction.net import Edge, TwoWays

__all__ = ["Closed", "Crossed", "Move", "OneLine", "Path", "Special", "paths_of"]

Path = tuple[Edge, ...]


@dataclass(frozen=True)
class Crossed:
    """An equation with two unknown sizes."""

    chain: TwoWays


@dataclass(frozen=True)
class Closed:
    """What is left of a way between two points known already: one vector at most is measured."""

    path: Path


@dataclass(frozen=True)
class Special:
    """The special point ``letter`` of a link and the legs that give it: ways from known points to points of the link,
    each with one unknown; or from points of another moving link, ``base``, as which the link moves there."""

    link: str
    letter: str
    legs: tuple[Path, Path]
    base: str = ""


@dataclass(frozen=True)
class OneLine:
    """Two parallel legs, their special point at infinity: the way from one to the other gives the link's rate."""

    link: str
    path: Path


Move = Crossed | Closed | Special | OneLine


def paths_of(move: Move) -> tuple[Path, ...]:
    """The ways that a move goes."""
    if isinstance(move, Crossed):
        return move.chain.left, move.chain.right
    return move.legs if isinstance(move, Special) else (move.path,)
