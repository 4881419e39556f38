"""Names of quantities: ``v_B``, ``v_B@3/B@2``, ``omega_3``, ``theta_3/2``, ``d_B/C``, ``stroke_5/6``, ``F_5/6`` ...

A kind of quantity is one entry of `KINDS`: what its name is followed by, and what it measures.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Container, Iterator
from dataclasses import dataclass, field, replace
from typing import Literal, NamedTuple

from graphkin.errors import Problem
from graphkin.scene.tables import Measure, Unit, Units
from graphkin.words import Phrase

__all__ = ["KINDS", "VECTORS", "Kind", "Measure", "PointRef", "Symbol", "Value", "centre_links", "missing_names"]

Value = complex | float
"""What a quantity is: a vector of the plane, or a number."""
Scope = Literal["motion", "position", "turn", "force", "cycle"]

_POINT = r"[A-Z][A-Za-z0-9]*"
_LINK = r"[A-Za-z0-9]+"
_REF = rf"{_POINT}(?:@{_LINK})?"
# what may stand behind the kind: groups "of" and "to" are points, "link" and "other" links
_FORMS = {
    "point": rf"(?P<of>{_POINT})",
    "points": rf"(?P<of>{_REF})(?:/(?P<to>{_REF}))?",
    "coincident": rf"(?P<of>{_REF})/(?P<to>{_REF})",
    "two points": rf"(?P<of>{_POINT})/(?P<to>{_POINT})",
    "link": rf"(?P<link>{_LINK})",
    "link of link": rf"(?P<link>{_LINK})(?:/(?P<other>{_LINK}))?",
    "pair": rf"(?P<link>{_LINK})/(?P<other>{_LINK})",
    "links": rf"(?P<link>{_LINK})-(?P<other>{_LINK})",
    "link or joint": rf"(?P<link>{_LINK})(?:/(?P<other>{_LINK})(?:@(?P<of>{_POINT}))?)?(?P<plus>\+)?",
    "of link": rf"(?P<link>{_LINK})(?P<plus>\+)?",
    "load": rf"(?P<name>{_LINK})(?P<plus>\+)?",
    "force": rf"(?P<name>(?:F|Fi|G|P)_{_LINK})(?P<plus>\+)?",
    "excess work": r"(?P<name>W)",
    "flywheel": r"(?P<name>F)",
}


@dataclass(frozen=True)
class Kind:
    """A kind of quantity.

    ``form`` says what it is of (a key of the forms above), ``scope`` whether it is a motion drawn in a polygon, a
    position measured on the mechanism, belongs to the whole turn, stands in a force polygon, or is of a flywheel.
    """

    name: str
    measure: Measure
    form: str
    scope: Scope
    example: str
    is_vector: bool = False

    @property
    def sign(self) -> str:
        """What parts the names of two links."""
        return "-" if self.form == "links" else "/"


KINDS = {
    kind.name: kind
    for kind in (
        Kind("v", "velocity", "points", "motion", "v_B, v_B@3 or v_C/B", True),
        Kind("a", "acceleration", "points", "motion", "a_B, a_B@3 or a_C/B", True),
        Kind("an", "acceleration", "points", "motion", "an_B or an_C/B", True),
        Kind("at", "acceleration", "points", "motion", "at_B or at_C/B", True),
        Kind("ak", "acceleration", "coincident", "motion", "ak_B@3/B@2", True),
        Kind("ar", "acceleration", "coincident", "motion", "ar_B@3/B@2", True),
        Kind("omega", "angular velocity", "link", "motion", "omega_3"),
        Kind("alpha", "angular acceleration", "link", "motion", "alpha_3"),
        Kind("x", "length", "point", "position", "x_D"),
        Kind("y", "length", "point", "position", "y_D"),
        Kind("theta", "angle", "link of link", "position", "theta_3 or theta_3/2"),
        Kind("d", "length", "two points", "position", "d_B/C or d_P12/A"),
        Kind("s", "length", "pair", "position", "s_2/3"),
        Kind("gamma", "angle", "links", "position", "gamma_2-3"),
        Kind("pressure", "angle", "link", "position", "pressure_5"),
        Kind("stroke", "length", "pair", "turn", "stroke_5/6"),
        Kind("swing", "angle", "link", "turn", "swing_3"),
        Kind("K", "number", "link of link", "turn", "K_5/6"),
        Kind("theta_lag", "angle", "link of link", "turn", "theta_lag_5/6"),
        Kind("F", "force", "link or joint", "force", "F_5/6, F_5/6@C or F_2", True),
        Kind("Fi", "force", "of link", "force", "Fi_6", True),
        Kind("G", "force", "of link", "force", "G_6", True),
        Kind("P", "force", "load", "force", "P_cut", True),
        Kind("M", "moment", "link or joint", "force", "M_2 or M_6/1"),
        Kind("Mi", "moment", "of link", "force", "Mi_4"),
        Kind("h", "length", "of link", "force", "h_4"),
        Kind("arm", "velocity", "force", "force", "arm_P_cut or arm_G_6"),
        Kind("excess", "work", "excess work", "cycle", "excess_W"),
        Kind("J", "inertia", "flywheel", "cycle", "J_F"),
    )
}
"""All kinds of quantities by name.  A further kind of quantity is a further entry."""

VECTORS = tuple(name for name, kind in KINDS.items() if kind.is_vector)
_LONGEST_FIRST = sorted(KINDS, key=len, reverse=True)
_ELSEWHERE = re.compile(r"(.*\S)\s+at\s+(\S+)", re.DOTALL)


class PointRef(NamedTuple):  # looked up by the ten thousand
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

    ``kind`` is a name of `KINDS`; ``of`` and ``to`` are its points (``to`` that relative to which it is meant, or the
    second of two), ``link`` and ``other`` its links (of a sliding pair the sliding and the guiding one; of a pin in a
    slot ``link`` is the pin).  ``at`` names the position that is meant, "" this one.

    Of forces ``link`` acts on ``other`` at the joint ``of`` (where they share two); ``name`` is that of a load, or of a
    force whose arm is meant; with ``plus`` the load that begins or ends exactly there acts.  ``turning`` is a load that
    is a moment, which no name tells.  ``seen`` is the link from which a vector is seen, with that held still; "" for
    the frame.

    >>> Symbol.parse("v_B@3/B@2").id
    'v_B3-B2'
    >>> str(Symbol.parse("omega_3")), str(Symbol.parse("gamma_2-3 at 7"))
    ('omega_3', 'gamma_2-3 at 7')
    """

    kind: str
    of: PointRef | None = None
    to: PointRef | None = None
    link: str = ""
    other: str = ""
    at: str = ""
    name: str = ""
    plus: bool = False
    turning: bool = field(default=False, compare=False)
    seen: str = ""

    @classmethod
    def parse(cls, text: str) -> Symbol:
        """Read a symbol.  Raises ValueError, saying what is wrong, where it is none."""
        elsewhere = _ELSEWHERE.fullmatch(text)
        if elsewhere:
            return replace(cls.parse(elsewhere[1]), at=elsewhere[2])
        name = next((kind for kind in _LONGEST_FIRST if text.startswith(f"{kind}_")), None)
        if name is None:
            known = ", ".join(re.sub(" or .*|,.*", "", kind.example) for kind in KINDS.values())
            raise ValueError(Phrase("is no quantity known are", text=text, names=known))
        kind = KINDS[name]
        match = re.fullmatch(_FORMS[kind.form], text[len(name) + 1 :])
        if match is None:
            raise ValueError(Phrase("write for example", text=text, missing=_MISSING[kind.form], example=kind.example))
        found = {part: given for part, given in match.groupdict().items() if given}
        points = {part: PointRef(*found[part].split("@")) for part in ("of", "to") if part in found}
        words = {part: found.get(part, "") for part in ("link", "other", "name")}
        return cls(name, **points, **words, plus="plus" in found)  # type: ignore[arg-type]

    @property
    def is_vector(self) -> bool:
        return self.kind in VECTORS and not self.turning

    @property
    def scope(self) -> Scope:
        return KINDS[self.kind].scope

    @property
    def measure(self) -> Measure:
        return "moment" if self.turning else KINDS[self.kind].measure

    @property
    def pair(self) -> str:
        """The sliding pair or the link that it is of, as `solve` names it."""
        return f"{self.link}/{self.other}" if self.other else self.link

    @property
    def here(self) -> Symbol:
        """The same quantity without the position that is meant."""
        return replace(self, at="") if self.at else self

    def links(self) -> Iterator[str]:
        """The names of links in it; the first may be a pin's (see ``link``)."""
        yield from (name for name in (self.link, self.other) if name)
        yield from (ref.link for ref in (self.of, self.to) if ref and ref.link)

    def unit(self, units: Units, radians: bool = False) -> Unit:
        """Its unit in files and tables, where the scene's are these; with ``radians`` that in JSON."""
        return units.of(self.measure, radians)

    @property
    def id(self) -> str:
        """The symbol as an SVG id: ``@`` dropped, ``/`` written ``-``."""
        return str(self).replace("@", "").replace("/", "-").replace(" at ", "-at-").replace("+", "-with").replace(
            " seen from ", "-seen-from-"
        )

    def __str__(self) -> str:
        if self.of is None or self.link:
            name = f"{self.kind}_{self.link or self.name}"
            name += f"{KINDS[self.kind].sign}{self.other}" if self.other else ""
            name += (f"@{self.of}" if self.of else "") + ("+" if self.plus else "")
        else:
            name = f"{self.kind}_{self.of}" + (f"/{self.to}" if self.to else "")
            name += f" seen from {self.seen}" if self.seen else ""
        return f"{name} at {self.at}" if self.at else name


_MISSING = {
    "point": Phrase("names no point"),
    "points": Phrase("names no point"),
    "coincident": Phrase("needs two coincident points"),
    "two points": Phrase("needs two points"),
    "link": Phrase("names no link"),
    "link of link": Phrase("names no link"),
    "pair": Phrase("names no sliding pair"),
    "links": Phrase("needs two links"),
    "link or joint": Phrase("names no link and no joint of two"),
    "of link": Phrase("names no link"),
    "load": Phrase("names no load"),
    "force": Phrase("names no force"),
    "excess work": Phrase("is no quantity"),
    "flywheel": Phrase("is no quantity"),
}


def centre_links(name: str, links: Container[str]) -> tuple[str, str] | None:
    """The two links whose instant centre a name means, as books print it; None where it means none.

    >>> centre_links("P12", {"1", "2"}), centre_links("P", {"1"})
    (('1', '2'), None)
    """
    cuts = ((name[1:k], name[k:]) for k in range(2, len(name))) if name.startswith(("P", "I")) else ()
    return next(((a, b) for a, b in cuts if a != b and a in links and b in links), None)


def missing_names(
    symbol: Symbol,
    no_link: Callable[[str], Problem | None],
    no_point: Callable[[str], Problem | None],
    links: Container[str],
) -> list[Problem]:
    """What is wrong with the names in a symbol.

    Parameters
    ----------
    no_link, no_point : the problem of a name that is no link, or no point; None if it is one
    links : the names of all links, by which instant centres are named
    """
    pins = symbol.other != "" and symbol.kind in ("s", "stroke", "K", "theta_lag") and symbol.link[:1].isupper()
    found = [no_point(symbol.link) if pins and no_link(symbol.link) else no_link(symbol.link)] if symbol.link else []
    found += [no_link(name) for name in symbol.links() if name != symbol.link]
    for ref in (symbol.of, symbol.to):
        if ref is not None:
            missing = no_point(ref.point)
            found.append(None if symbol.kind == "d" and centre_links(ref.point, links) else missing)
    return [problem for problem in found if problem is not None]
