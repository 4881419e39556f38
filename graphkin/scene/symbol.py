"""Names of quantities: ``v_B``, ``v_B@3/B@2``, ``omega_3``, ``an_C/B`` ..."""

from __future__ import annotations

import re
from dataclasses import dataclass

__all__ = ["VECTORS", "PointRef", "Symbol"]

VECTORS = ("v", "a", "an", "at", "ak", "ar")
_POINT = re.compile(r"([A-Z][A-Za-z0-9]*)(?:@([A-Za-z0-9]+))?")
_LINK = re.compile(r"[A-Za-z0-9]+")


@dataclass(frozen=True, order=True)
class PointRef:
    """A point as a point of a link: ``B@3`` is the point of link 3 that lies at B at this moment.

    ``link`` is "" for the pin itself (``B``).
    """

    point: str
    link: str = ""

    def __str__(self) -> str:
        return f"{self.point}@{self.link}" if self.link else self.point


@dataclass(frozen=True, order=True)
class Symbol:
    """A quantity by name.

    ``kind`` is v, a (velocity, acceleration of ``of``, relative to ``to`` if given), an, at, ak, ar (normal,
    tangential, Coriolis, sliding part of an acceleration), omega or alpha (of link ``link``).

    >>> Symbol.parse("v_B@3/B@2").id
    'v_B3-B2'
    >>> str(Symbol.parse("omega_3"))
    'omega_3'
    """

    kind: str
    of: PointRef | None = None
    to: PointRef | None = None
    link: str = ""

    @classmethod
    def parse(cls, text: str) -> Symbol:
        """Read a symbol.  Raises ValueError, saying what is wrong, where it is none."""
        kind, _, rest = text.partition("_")
        if kind in ("omega", "alpha"):
            if not _LINK.fullmatch(rest):
                raise ValueError(f'"{text}" names no link; write for example {kind}_3')
            return cls(kind, link=rest)
        if kind not in VECTORS:
            raise ValueError(
                f'"{text}" is no quantity; known are v_B, v_C/B, a_B, an_C/B, at_C/B, ak_B@3/B@2, '
                "ar_B@3/B@2, omega_3, alpha_3"
            )
        parts = rest.split("/")
        refs = [_POINT.fullmatch(part) for part in parts]
        if len(parts) > 2 or not all(refs):
            raise ValueError(f'"{text}" names no point; write for example {kind}_B, {kind}_B@3 or {kind}_C/B')
        points = [PointRef(m[1], m[2] or "") for m in refs if m]
        if kind in ("ak", "ar") and len(points) == 1:
            raise ValueError(f'"{text}" needs two coincident points; write for example {kind}_B@3/B@2')
        return cls(kind, points[0], points[1] if len(points) == 2 else None)

    @property
    def is_vector(self) -> bool:
        return self.kind in VECTORS

    @property
    def id(self) -> str:
        """The symbol as an SVG id: ``@`` dropped, ``/`` written ``-``."""
        return str(self).replace("@", "").replace("/", "-")

    def __str__(self) -> str:
        if self.of is None:
            return f"{self.kind}_{self.link}"
        return f"{self.kind}_{self.of}" + (f"/{self.to}" if self.to else "")
