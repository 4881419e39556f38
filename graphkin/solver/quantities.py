"""Formulas of what may be asked for by name: points, velocities, accelerations, angles and travels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver.engine import SLACK
from graphkin.solver.expressions import PoseFormula, Real, Vec, fmax
from graphkin.solver.frame_errors import FrameError
from graphkin.solver.program import Program
from graphkin.structure import Structure, in_stages
from graphkin.words import Phrase

__all__ = ["Units", "bounds", "formulas"]


Units = tuple[float, float, float]
"""What one metre, one radian and one metre in rates are in the units of the columns."""


def formulas(
    program: Program, structure: Structure, asked: Sequence[str], units: Units = (1.0, 1.0, 1.0)
) -> dict[str, Real]:
    """A formula for each column.

    Parameters
    ----------
    asked : "B", "B@3" (place of a point: columns B.x, B.y), "v_B", "a_B@3", "v_C/B" (two columns each), "theta_3",
        "omega_3", "alpha_3", "s_2/3" (travel of a sliding pair)
    units : of lengths, of angles and of lengths in rates; rates of angles are in radians always

    Raises
    ------
    CallError : a name that is none of these, or names nothing in this mechanism
    """
    found: dict[str, Real] = {}
    for name in asked:
        value = _Quantity(program, structure, name)
        formula = value.formula() * value.scale(units)
        if isinstance(formula, Vec):
            found[f"{name}.x"], found[f"{name}.y"] = formula.real, formula.imag
        else:
            found[name] = formula
    return found


def bounds(
    program: Program, structure: Structure, asked: Sequence[str], units: Units = (1.0, 1.0, 1.0)
) -> dict[str, Real]:
    """For each name how far rounding may have moved its columns, in their units.

    With a larger group they are made from the bounds of the whole mechanism, inputs ("bound", 0) to ("bound", 5).
    """
    quantities = {name: _Quantity(program, structure, name) for name in asked}
    return {name: SLACK * (q.bound() * q.scale(units)) for name, q in quantities.items()}


class _Quantity:
    """What a name asks for."""

    def __init__(self, program: Program, structure: Structure, name: str) -> None:
        self.program, self.structure, self.name = program, structure, name
        kind, mark, rest = name.partition("_")
        self.kind = kind if mark else "point"
        self.refs: list[PointRef] = []
        self.link = rest
        if not mark:
            point, _, link = name.partition("@")
            self.refs = [PointRef(point, link)]
        elif kind == "s":
            keys = [s.key for s in structure.slides]
            if rest not in keys:
                raise CallError(Problem(f'"{name}"', Phrase("there is no such sliding pair"), did_you_mean(rest, keys)))
        elif kind != "theta":
            self._parse()

    def _parse(self) -> None:
        try:
            symbol = Symbol.parse(self.name)
        except ValueError as error:
            raise CallError(Problem(f'"{self.name}"', error.args[0])) from None
        if symbol.kind in ("omega", "alpha"):
            self.link = symbol.link
        elif symbol.kind in ("v", "a") and symbol.of is not None:
            self.refs = [symbol.of, *([symbol.to] if symbol.to else [])]
        else:
            hint = Phrase("ask for places v_ a_ theta_ omega_ alpha_")
            raise CallError(Problem(f'"{self.name}"', Phrase("is no column"), hint))

    def scale(self, units: Units) -> Real | float:
        """What the formula in SI is to be multiplied by."""
        if self.kind in ("omega", "alpha"):
            return 1.0
        rate = self.kind in ("v", "a")
        what, factor = ("per metre of rates", units[2]) if rate else ("per metre", units[0])
        if self.kind == "theta":
            what, factor = "per radian", units[1]
        return 1.0 if factor == 1.0 else self.program.graph.param((what,))

    def formula(self) -> Real | Vec:
        """Its formula, in SI."""
        program = self.program
        if self.kind == "s":
            slide = self.structure.slide(self.link)
            guide = program.guide(slide)
            return ((program.poses[slide.a].z - guide.z) * guide.u.conjugate()).real
        if self.kind == "theta":
            u = self._pose(self.link).u
            return program.graph.line("atan2", u.imag.at, u.real.at)
        if self.kind in ("omega", "alpha"):
            return cast(Real, getattr(self._pose(self.link), self.kind))
        field = {"point": "z", "v": "v", "a": "a"}[self.kind]
        one, *other = [getattr(self._point(ref), field) for ref in self.refs]
        return cast(Vec, one - other[0] if other else one)

    def bound(self) -> Real:
        """How far rounding may have moved it, in SI."""
        unit = self.program.bounds.unit
        if self.kind == "s":
            slide = self.structure.slide(self.link)
            moved, guide = self._link_bounds(slide.a).position, self._link_bounds(slide.b)
            return moved + guide.position + abs(cast(Real, self.formula())) * (guide.angle + 4.0 * unit)
        if self.kind in ("theta", "omega", "alpha"):
            self._pose(self.link)
            bound = self._link_bounds(self.link).of_turning[("theta", "omega", "alpha").index(self.kind)]
            return bound + 16.0 * unit if self.kind == "theta" else bound
        order = {"point": 0, "v": 1, "a": 2}[self.kind]
        one, *other = [self._point_bounds(ref)[order] for ref in self.refs]
        if not other:
            return one
        both = cast(Vec, self.formula())
        return one + other[0] + unit * fmax(abs(both.real), abs(both.imag))

    def _link_bounds(self, link: str) -> FrameError:
        """Of any point of a link and of its turning."""
        if in_stages(self.structure.elements):
            return FrameError(*(self.program.graph.input(("bound", k)) for k in range(6)))
        return self.program.bounds.of_link(link)

    def _pose(self, name: str) -> PoseFormula:
        if name not in self.program.poses:
            raise CallError(
                Problem(
                    Phrase("link", name=name), Phrase("there is no such link"), did_you_mean(name, self.structure.links)
                )
            )
        return self.program.poses[name]

    def _holders(self, ref: PointRef) -> list[str]:
        links = self.structure.links
        holders = [n for n, link in links.items() if ref.point in link.points]
        if not holders:
            known = [p for link in links.values() for p in link.points]
            raise CallError(
                Problem(
                    Phrase("point of point", point=ref.point),
                    Phrase("there is no such point"),
                    did_you_mean(ref.point, known),
                )
            )
        return holders

    def _point(self, ref: PointRef) -> PoseFormula:
        """A point of a link, or what of a link lies at a point now."""
        program, holders = self.program, self._holders(ref)
        pose = self._pose(ref.link or holders[0])
        if not ref.link or ref.link in holders:
            return pose.fixed(program.number("point", ref.link or holders[0], ref.point))
        pin = self._pose(holders[0]).fixed(program.number("point", holders[0], ref.point))
        return pose.carrying(pin.z)

    def _point_bounds(self, ref: PointRef) -> tuple[Real, ...]:
        holders = self._holders(ref)
        if not ref.link or ref.link in holders:
            return self._link_bounds(ref.link or holders[0]).of_point
        pin, pose = self._point(PointRef(ref.point)), self._pose(ref.link)
        own, moved = self._link_bounds(ref.link), self._link_bounds(holders[0]).position
        return moved, *self.program.bounds.under(ref.link, own, pin.z - pose.z, moved)
