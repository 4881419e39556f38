"""The closed form by itself: the formulas of a mechanism as bare code, without the care that surrounds it in ``solve``.

It is what can be timed and what shows how rounding grows: doubles, single precision, plain floats, compiled.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import CallError, Problem
from graphkin.exact.choice import choose_forms
from graphkin.exact.formula import Real
from graphkin.exact.pose import Pose
from graphkin.exact.program import Program, program_of
from graphkin.exact.rendering import Code
from graphkin.structure import Cluster, Structure, Turn

__all__ = ["Closed", "Formulas", "Output", "outputs_of"]

Array = NDArray[Any]


@dataclass(frozen=True)
class Output:
    """A point whose motion is looked at: a point of a link, or of ``link`` where it lies under that pin."""

    point: str
    link: str

    def __str__(self) -> str:
        return f"{self.point}@{self.link}"


def outputs_of(structure: Structure) -> tuple[Output, ...]:
    """Every moving point by the first moving link that has it, and the points of guides under sliding pins."""
    scene = structure.scene
    fixed = scene.frame.points
    found = [Output(p, link.name) for link in scene.links for p in link.points if not link.redundant]
    found = [o for o in found if o.point not in fixed]
    firsts = {o.point: o for o in reversed(found)}
    unders = [
        Output(s.pin, s.b)
        for s in structure.slides
        if s.pin and s.b != scene.frame.name and s.pin not in structure.links[s.b].points and s.b in scene.by_name
    ]
    return (*dict.fromkeys(firsts[o.point] for o in found), *unders)


class Formulas:
    """The code for some formulas of a mechanism.

    Parameters
    ----------
    choose : which formulas, out of the program of the mechanism

    Raises
    ------
    CallError : the scene has a group larger than a dyad, for which there is no closed form
    """

    def __init__(self, structure: Structure, choose: Callable[[Program], Sequence[Real]]) -> None:
        group = next((e for e in structure.elements if isinstance(e, Cluster)), None)
        if group is not None:
            raise CallError(
                Problem(
                    f"links {', '.join(group.links)}",
                    "a group larger than a dyad has no closed form to be timed",
                    "give a mechanism of class II",
                )
            )
        self.structure = structure
        self.drivers = structure.scene.drivers
        self.forms = {i: float(np.asarray(f)) for i, f in choose_forms(structure).items()}
        fitted = program_of(structure, tuple(bool(d.values[2]) for d in self.drivers))
        self.code = Code(fitted.program.sheet, choose(fitted.program))
        given: dict[Any, float] = {}
        for k, driver in enumerate(self.drivers):
            _, given["rate", k], given["second", k] = driver.values
        self.params = fitted.params(self.code.params, given)

    def inputs(self, values: Array) -> list[Array]:
        """What changes from position to position: cosines and sines of drivers, signs of assemblies.

        Parameters
        ----------
        values : driver values, shape (n, drivers), rad or m
        """
        found: list[Array] = []
        for name, key in self.code.inputs:
            if name == "sign":
                found.append(np.full(len(values), self.forms[key], dtype=values.dtype))
            else:
                value = np.ascontiguousarray(values[:, key])
                found.append(value if name == "travel" else np.cos(value) if name == "cos" else np.sin(value))
        return found

    def arrays(self, values: Array) -> Array:
        """All positions at once, shape (columns, n), in the precision of the values."""
        out = np.empty((len(self.code.asked), len(values)), dtype=values.dtype)
        self.code.arrays(self.code.same(self.params, values.dtype), self.inputs(values), list(out))
        return out

    def one_by_one(self) -> Callable[[Sequence[float]], tuple[float, ...]]:
        """A function of the driver values of one position, in plain floats."""
        run, params = self.code.floats, self.params
        ways: list[tuple[Callable[[float], float] | None, int, float]] = []
        for name, key in self.code.inputs:
            if name == "sign":
                ways.append((None, 0, self.forms[key]))
            else:
                ways.append(({"cos": math.cos, "sin": math.sin, "travel": float}[name], key, 0.0))

        def position(values: Sequence[float]) -> tuple[float, ...]:
            return run(params, [fixed if f is None else f(values[k]) for f, k, fixed in ways])

        return position


class Closed(Formulas):
    """The code for place, velocity and acceleration of some points.

    Parameters
    ----------
    orders : which of place, velocity, acceleration ("z", "v", "a") are computed
    """

    def __init__(self, structure: Structure, outputs: Sequence[Output], orders: str = "zva") -> None:
        self.outputs, self.orders = tuple(outputs), orders

        def choose(program: Program) -> list[Real]:
            found: list[Real] = []
            for output in self.outputs:
                pose = _axes(program, structure, output)
                for order in orders:
                    vector = getattr(pose, order)
                    found += [vector.real, vector.imag]
            return found

        super().__init__(structure, choose)

    def vectors(self, columns: Array) -> dict[str, Array]:
        """The columns as complex arrays of shape (outputs, n), by order."""
        n = len(self.orders)
        return {
            order: columns[2 * k :: 2 * n] + 1j * columns[2 * k + 1 :: 2 * n] for k, order in enumerate(self.orders)
        }


def _axes(program: Program, structure: Structure, output: Output) -> Pose:
    """Axes that move with the output's link, their origin at its point."""

    def own(link: str) -> Pose:
        return program.poses[link].of(program.rest(Turn(output.point, link, ""), link))

    if output.point in structure.links[output.link].points:
        return own(output.link)
    pose = program.poses[output.link]
    pin = own(next(n for n in program.poses if output.point in structure.links[n].points))
    return pose.of(Pose(**{**vars(program.at_rest(0j, 1 + 0j)), "z": pose.u.conjugate() * (pin.z - pose.z)}))
