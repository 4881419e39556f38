"""What the keys of a scene file do to the numbers of its mechanism: found by reading the scene a few times, once.

Nearly every number of a file acts in one of two ways: lengths, places and rates change as a straight line with it,
directions turn with an angle.  Three readings tell the line or the turn, one more with all keys changed proves that
they act side by side.  So also points that are placed from others, in any unit, follow as the reader places them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from numbers import Real

import numpy as np
from numpy.typing import NDArray

from graphkin.errors import CallError, Problem, SceneError
from graphkin.files import Tables
from graphkin.scene import mechanism_of
from graphkin.scene.dimensions import Dimension, changed_beside, dimensions
from graphkin.scene.model import Mechanism
from graphkin.scene.tables import path_of_key, value_at
from graphkin.solver.pose import turned
from graphkin.study.designs import applied
from graphkin.words import Phrase

__all__ = ["DesignKeys", "design_keys"]

Reals = NDArray[np.float64]
Complexes = NDArray[np.complex128]

SAME = 1e-12
"""Numbers of two readings that differ by less, beside the largest of them, are the same."""


@dataclass(frozen=True)
class _Law:
    """A number of the mechanism by the value of a key: fixed + slope value, or fixed + slope direction(value)."""

    fixed: complex
    slope: complex
    turning: bool

    def __call__(self, values: Reals) -> Complexes:
        return np.asarray(self.fixed + self.slope * (turned(np.radians(values)) if self.turning else values))


@dataclass(frozen=True)
class DesignKeys:
    """Keys of a scene file, and what each does to the numbers of the mechanism (SI)."""

    scene: Mechanism
    own: Mapping[Dimension, complex]
    laws: Mapping[str, Mapping[Dimension, _Law]]

    def numbers(self, values: Mapping[str, Reals]) -> dict[Dimension, Complexes]:
        """The numbers that change, from values of the keys in their units, shape (designs,) each.

        Raises
        ------
        CallError : a value that is no finite number, a length that is not positive
        """
        found: dict[Dimension, Complexes] = {}
        for key, of_key in values.items():
            low = 0.0 if key.endswith(".length") else -math.inf
            bad = ~(np.isfinite(of_key) & (of_key > low))
            if bad.any():
                found_one = float(of_key[int(np.argmax(bad))])
                wanted = Phrase("give lengths above 0") if low == 0 else Phrase("give finite numbers")
                raise CallError(Problem(f"designs {key}", Phrase("found value", value=f'{found_one:g}'), wanted))
            for name, law in self.laws[key].items():
                new = law(of_key)
                found[name] = found[name] + (new - self.own[name]) if name in found else new
        return found


def design_keys(source: Tables, scene: Mechanism, keys: Sequence[str]) -> DesignKeys:
    """Find what keys do.

    Parameters
    ----------
    source : the tables and keys of the scene's file
    keys : with dots: "links.1.length", "frame.points.D.x", "driver.rate"

    Raises
    ------
    CallError : a key that the scene does not have, that holds no number, that changes nothing in the mechanism or not
        by itself, or keys that do not act side by side; a driver whose value or rate follows from dimensions
    """
    written = mechanism_of(source)
    for driver in written.drivers:
        found = "the driver is given from a dead point, which moves with each" if driver.dead_point else ""
        if driver.given_speed:
            found = "the driver's rate is given by the speed of a point, and is another with each"
        elif driver.position:
            found = "the driver is given by a position, which moves with each"
        if found:
            raise CallError(Problem("designs", found, Phrase("give its value instead")))
    laws: dict[str, dict[Dimension, _Law]] = {}
    changed: dict[str, float] = {}
    for key in keys:
        begin, step = _begin(source, key)
        changed[key] = begin + step
        read = [_read(source, {key: begin + k * step}) for k in range(3)]
        laws[key] = _laws(key, begin, step, [dimensions(mechanism) for mechanism in read], scene)
        beside = dict.fromkeys(part for mechanism in read for part in changed_beside(written, mechanism))
        if beside:
            hint = "sweep over it: graphkin.sweep(..., designs=...)"
            raise CallError(
                Problem(f"designs {key}", Phrase("changes more than dimensions", beside=", ".join(beside)), hint)
            )
    made = DesignKeys(scene, dimensions(scene), laws)
    if len(keys) > 1:
        _side_by_side(made, changed, dimensions(_read(source, changed)))
    return made


def _begin(source: Tables, key: str) -> tuple[float, float]:
    """A value of a key and a step from it: its own where it has one."""
    path = path_of_key(source, key)
    own = None if path is None else value_at(source, path)
    if not isinstance(own, Real) or own == 0:  # of what is no number the reader says what is wrong
        return 0.0, 1.0
    return float(own), abs(float(own)) / 8


def _read(source: Tables, values: Mapping[str, float]) -> Mechanism:
    try:
        return mechanism_of(applied(source, tuple(values), tuple(values.values())))
    except SceneError as error:
        what = f"designs {', '.join(values)}"
        raise CallError(Problem(what, Phrase("changed by itself the scene no longer fits", error=error))) from None


def _laws(
    key: str, begin: float, step: float, found: Sequence[Mapping[Dimension, complex]], scene: Mechanism
) -> dict[Dimension, _Law]:
    """The laws of all numbers that a key changes, from three readings a step apart."""
    laws: dict[Dimension, _Law] = {}
    w = complex(turned(np.radians(np.array([step])))[0])
    for name in found[0]:
        a, b, c = (numbers[name] for numbers in found)
        size = SAME * max(abs(a), abs(b), abs(c))
        if abs(b - a) <= size and abs(c - b) <= size:
            continue
        if abs((c - b) - (b - a)) <= size:
            slope = _plain((c - a) / (2 * step), scene)
            law = _Law(_none(a - slope * begin, a), slope, False)
        elif abs((c - b) - w * (b - a)) <= size:
            first = complex(turned(np.radians(np.array([begin])))[0])
            slope = (b - a) / (first * (w - 1))
            slope = slope / abs(slope) if abs(abs(slope) - 1) < SAME else slope
            law = _Law(_none(a - slope * first, a), slope, True)
        else:
            hint = Phrase("sweep over it graphkin.sweep designs")
            raise CallError(Problem(f"designs {key}", Phrase("changes neither as a line nor as a", name=name[1]), hint))
        laws[name] = law
    if not laws:
        raise CallError(Problem(f"designs {key}", Phrase("changes no dimension of the mechanism and no")))
    return laws


def _plain(slope: complex, scene: Mechanism) -> complex:
    """A slope without the rounding of its finding, where it is one of the units."""
    for unit in (scene.units.metres, scene.units.rates.metres, 1.0, math.radians(1.0), math.pi / 30):
        for turn in (1, -1, 1j, -1j):
            if abs(slope - turn * unit) <= 1e-11 * unit:
                return turn * unit
    return slope


def _none(value: complex, beside: complex) -> complex:
    return 0j if abs(value) <= 4 * SAME * abs(beside) else value


def _side_by_side(keys: DesignKeys, values: Mapping[str, float], read_so: Mapping[Dimension, complex]) -> None:
    """Hold the laws of several keys against a reading with all of them changed.  Raises CallError."""
    own = keys.own
    told = keys.numbers({key: np.array([value]) for key, value in values.items()})
    for name, read_one in read_so.items():
        mine = complex(told[name][0]) if name in told else own[name]
        if abs(mine - read_one) > 10 * SAME * max(abs(own[name]), abs(read_one), keys.scene.size):
            what = f"designs {', '.join(values)}"
            hint = Phrase("sweep over them graphkin.sweep designs")
            raise CallError(Problem(what, Phrase("act on together not side by side", name=name[1]), hint))
