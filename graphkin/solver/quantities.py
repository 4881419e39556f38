"""Formulas of what may be asked for by name: points, velocities, accelerations, angles and travels."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from graphkin.errors import CallError, Problem, did_you_mean
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.solver.formula import Real, Vec
from graphkin.solver.pose import Pose
from graphkin.solver.program import Program
from graphkin.structure import Structure

__all__ = ["formulas"]


def formulas(program: Program, structure: Structure, asked: Sequence[str]) -> dict[str, Real]:
    """A formula for each column.

    Parameters
    ----------
    asked : "B", "B@3" (place of a point: columns B.x, B.y), "v_B", "a_B@3", "v_C/B" (two columns each), "theta_3",
        "omega_3", "alpha_3", "s_2/3" (travel of a sliding pair)

    Raises
    ------
    CallError : a name that is none of these, or names nothing in this mechanism
    """
    found: dict[str, Real] = {}
    for name in asked:
        value = _formula(program, structure, name)
        if isinstance(value, Vec):
            found[f"{name}.x"], found[f"{name}.y"] = value.real, value.imag
        else:
            found[name] = value
    return found


def _formula(program: Program, structure: Structure, name: str) -> Any:
    kind, mark, rest = name.partition("_")
    if not mark:
        point, _, link = name.partition("@")
        return _point(program, structure, PointRef(point, link)).z
    if kind == "s":
        slide = next((s for s in structure.slides if s.key == rest), None)
        if slide is None:
            hint = did_you_mean(rest, [s.key for s in structure.slides])
            raise CallError(Problem(f'"{name}"', "there is no such sliding pair", hint))
        guide = program.guide(slide)
        return ((program.poses[slide.a].z - guide.z) * guide.u.conjugate()).real
    if kind == "theta":
        u = _link(program, structure, rest).u
        return program.graph.line("atan2", u.imag.at, u.real.at)
    try:
        symbol = Symbol.parse(name)
    except ValueError as error:
        raise CallError(Problem(f'"{name}"', str(error))) from None
    if symbol.kind in ("omega", "alpha"):
        return getattr(_link(program, structure, symbol.link), symbol.kind)
    if symbol.kind not in ("v", "a") or symbol.of is None:
        raise CallError(Problem(f'"{name}"', "is no column", "ask for places, v_, a_, theta_, omega_, alpha_ or s_"))
    one = getattr(_point(program, structure, symbol.of), symbol.kind)
    return one - getattr(_point(program, structure, symbol.to), symbol.kind) if symbol.to else one


def _link(program: Program, structure: Structure, name: str) -> Pose:
    if name not in program.poses:
        raise CallError(Problem(f'link "{name}"', "there is no such link", did_you_mean(name, structure.links)))
    return program.poses[name]


def _point(program: Program, structure: Structure, ref: PointRef) -> Pose:
    holders = [n for n, link in structure.links.items() if ref.point in link.points]
    if not holders:
        known = [p for link in structure.links.values() for p in link.points]
        raise CallError(Problem(f'point "{ref.point}"', "there is no such point", did_you_mean(ref.point, known)))
    pose = _link(program, structure, ref.link or holders[0])
    if not ref.link or ref.link in holders:
        return pose.fixed(program.number("point", ref.link or holders[0], ref.point))
    pin = _link(program, structure, holders[0]).fixed(program.number("point", holders[0], ref.point))
    arm, spin = pin.z - pose.z, 1j * pose.omega
    return Pose(
        pin.z, pose.u, pose.v + spin * arm, pose.omega, pose.a + (1j * pose.alpha + spin * spin) * arm, pose.alpha
    )
