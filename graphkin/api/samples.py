"""What a prepared mechanism gives at many positions: arrays by name, and the table of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from graphkin.api.results import Tabled
from graphkin.errors import CallError, Problem, as_text, did_you_mean
from graphkin.table import Column, Table, Values
from graphkin.words import Phrase

__all__ = ["Quantities", "Samples"]

Reals = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Quantities:
    """What a mechanism was prepared for.

    units : of each quantity by its name, in the order in which they were asked for
    names : of the columns, two for a vector
    driver : name and unit of the first driver's column
    driver_values : values of the first driver in a sweep of so many positions
    """

    units: Mapping[str, str]
    names: tuple[str, ...]
    driver: tuple[str, str]
    driver_values: Callable[[int], Reals]

    def place(self, name: str) -> int:
        """Place of a quantity among those asked for.  Raises CallError for another one."""
        if name not in self.units:
            known = [*self.units, *self.names]
            raise CallError(Problem(f'"{name}"', Phrase("was not asked for"), did_you_mean(name, known)))
        return list(self.units).index(name)


@dataclass(slots=True, eq=False, repr=False)  # not frozen: that would take longer than a hundred positions
class Samples(Tabled):
    """The quantities of a prepared mechanism at many positions.

    ``samples["v_C"]`` is a complex array, ``samples["v_C.x"]`` and ``samples["omega_3"]`` are real ones, shape (n,),
    in the units of ``Prepared.units``; NaN where ``ok`` is False.

    Of many designs every array has the shape (designs, n), at one position (designs,).

    values : real, shape (columns, n), in the order of ``Prepared.names``
    ok : bool, shape (n,): False at positions that the motion does not reach, and at dead points
    designs : the values of the keys that the designs change, shape (designs,), or () where it is one alone
    """

    quantities: Quantities
    values: Reals
    ok: NDArray[np.bool_]
    _driver: Reals | None
    _bounds: Reals | None
    designs: Mapping[str, Reals] | None = None

    def __len__(self) -> int:
        return self.ok.size

    def __getitem__(self, name: str) -> NDArray[np.float64] | NDArray[np.complex128]:
        """A quantity or a column by its name.  Raises CallError for one that was not asked for."""
        name = as_text("name", name)
        names = self.quantities.names
        units = self.quantities.units
        if name in names:
            return Values.of(self.values[names.index(name)], units[name.removesuffix(".x").removesuffix(".y")])
        self.quantities.place(name)
        first = names.index(f"{name}.x")
        return Values.of(self.values[first] + 1j * self.values[first + 1], units[name])

    def bound(self, name: str) -> Reals:
        """How far rounding may have moved a quantity, shape (n,), in its unit: both components of a vector; infinite
        where nothing is known.  Raises CallError where bounds were not asked for."""
        if self._bounds is None:
            raise CallError(Problem("bound", Phrase("no bounds were asked for"), Phrase("prepare with bounds true")))
        return np.asarray(self._bounds[self.quantities.place(name)])

    @property
    def driver(self) -> Reals:
        """Values of the first driver (degrees, or the scene's length unit), shape (n,) or as ``ok``."""
        return self.quantities.driver_values(self.ok.shape[-1]) if self._driver is None else self._driver

    @property
    def table(self) -> Table:
        """A row for each position (of each design): what the design changes, the driver, the columns, and whether there
        is such a position."""
        shape, units, designs = self.ok.shape, self.quantities.units, self.designs or {}
        many = any(values.ndim for values in designs.values())
        index = ("design",) * many + ("position",) * (len(shape) - many)
        columns = [Column(name, np.ravel(k) + 1) for name, k in zip(index, np.indices(shape), strict=True)]
        for key, values in designs.items():
            own = values.reshape(-1, *[1] * (len(shape) - 1)) if many else values
            columns.append(Column(key, np.ravel(np.broadcast_to(own, shape))))
        driver, unit = self.quantities.driver
        columns.append(Column(driver, np.ravel(np.broadcast_to(np.round(self.driver, 11), shape)), unit))
        for name, values in zip(self.quantities.names, self.values, strict=True):
            symbol = name.removesuffix(".x").removesuffix(".y")
            columns.append(Column(name, np.ravel(values), units[symbol], symbol))
        return Table((*columns, Column("ok", np.ravel(self.ok))), index)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Samples):
            return NotImplemented
        return (self.quantities.units, self._bounds is None) == (other.quantities.units, other._bounds is None) and (
            self.table == other.table
        )

    def __hash__(self) -> int:
        return hash((tuple(self.quantities.units), self.ok.shape))

    def __repr__(self) -> str:
        return f"<Samples of {', '.join(self.quantities.units)}: {int(self.ok.sum())} of {self.ok.size} positions>"
