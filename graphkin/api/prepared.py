"""``prepare``: a mechanism made ready for an inner loop: at single positions in microseconds, at millions of positions,
for many designs."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from functools import cached_property, partial
from numbers import Real

import numpy as np
from numpy.typing import ArrayLike, NDArray

from graphkin.api.arguments import as_scene, columns_shown, whole_number
from graphkin.api.results import OfScene
from graphkin.errors import CallError, as_list, as_text, unfit
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike, written
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Unit
from graphkin.solver.compiled.kernel import pays
from graphkin.solver.prepared import PreparedMechanism
from graphkin.study.designs import Designs, Numbers, design_keys
from graphkin.study.prepared_designs import PreparedMechanisms
from graphkin.study.sweeps import FollowedDesign, Sweep
from graphkin.table import Table, Tabled
from graphkin.words import Phrase, listed

Reals = NDArray[np.float64]

MOST = 1_000_000_000
MOST_VALUE = 1e9


def driver_value(value: object) -> float:
    """A caller's value of a driver.  Raises CallError where it is no number."""
    if isinstance(value, Real) and not isinstance(value, bool) and abs(number := float(value)) <= MOST_VALUE:
        return number
    raise CallError.of("at", "is no driver value of value", "give a finite number below 1e9", value=f"{value!r:.60}")


@dataclass(frozen=True, repr=False, eq=False)
class Prepared(Tabled, OfScene):
    """A mechanism with its assembly followed over the whole range of its first driver, and the code for the asked
    quantities.

    ``prepared["v_C"]``, ``table`` and the other results belong to the scene's own position.

    asked : the names of the quantities
    names : of the columns, two for a vector ("v_B.x", "v_B.y")
    fast : whether formulas are compiled (numba, the extra ``fast``): True always, False never, None for many positions
    """

    source: SceneLike
    asked: tuple[str, ...]
    fast: bool | None
    ready: PreparedMechanism

    @property
    def mechanism(self) -> Mechanism:
        return self.ready.structure.scene

    @cached_property
    def names(self) -> tuple[str, ...]:
        return self.ready.names

    @cached_property
    def units(self) -> dict[str, str]:
        """The unit of each asked quantity, those without a formula last: the scene's length unit, seconds, degrees for
        angles, but radians in their rates (rad/s, rad/s2)."""
        units = self.mechanism.units
        return {str(symbol): symbol.unit(units).text for symbol in (*self.ready.wanted, *self.ready.solved)}

    @cached_property
    def base(self) -> FollowedDesign:
        """The mechanism with its quantities, of which sweeps are made."""
        return FollowedDesign.prepared(self.ready)

    @cached_property
    def _here(self) -> Sweep:
        return self.columns([self.here])

    @property
    def here(self) -> float:
        """The first driver's value at the scene's own position, in its own unit."""
        return float(self.own_unit.of(self.ready.range.start[0]))

    def __getitem__(self, name: str) -> NDArray[np.float64] | NDArray[np.complex128]:
        """A quantity or a column at the scene's own position, shape (1,).  Raises CallError as ``Sweep``."""
        return self._here[name]

    @property
    def table(self) -> Table:
        """The values at the scene's own position: one row."""
        return self._here.table

    @cached_property
    def own_unit(self) -> Unit:
        """The unit of the first driver."""
        return self.mechanism.unit_of(self.mechanism.drivers[0])

    def at(self, value: float) -> tuple[float, ...] | None:
        """The columns at one value of the first driver, as plain floats; in some microseconds.

        Parameters
        ----------
        value : in the driver's own unit (degrees, or travel in the scene's length unit)

        Returns
        -------
        In the order of ``names``; None where the motion does not reach the position, and at a dead point
        """
        if type(value) is not float or not -MOST_VALUE <= value <= MOST_VALUE:
            value = driver_value(value)
        columns = self.ready.at(value * self.own_unit.si)
        return columns if columns is None or not self.ready.bounded else columns[: len(self.names)]

    def columns(self, values: ArrayLike) -> Sweep:
        """The quantities at given values of the first driver, shape (n,), in its own unit."""
        try:
            driven = np.atleast_1d(np.asarray(values, dtype=float)).reshape(-1)
        except (TypeError, ValueError):
            raise unfit("values", values, "give numbers one for each position") from None
        wrong = driven[~(np.abs(driven) <= MOST_VALUE)]
        if len(wrong):
            raise CallError.of("values", "found value", "give finite numbers below 1e9", value=f"{wrong[0]:g}")
        arrays = self.ready.columns(driven * self.own_unit.si, fast=self.compiled(len(driven)))
        return Sweep(self.base, self.base.scene.name, len(driven), content=arrays, given=driven)

    def sweep(self, n: int, out: Reals | None = None) -> Sweep:
        """The quantities at n positions of the whole range: a turn from the scene's own position on, in the sense of
        the driver; of a driven slide evenly inside the range of travel.  As fast as the memory takes the columns: about
        5 ns a position compiled, 30 in NumPy.

        Parameters
        ----------
        out : array for the values, real, shape (columns, n), rows without gaps: new memory takes longer than many
            sweeps

        Raises
        ------
        CallError : n is no number of positions; ``out`` does not fit; numba is asked for and is not installed
        """
        if type(n) is not int or not 1 <= n <= MOST:
            n = whole_number("sweep", n, 1, MOST, "positions of number")
        if out is not None:
            self._fitting(n, out)
        arrays = self.ready.sweep(n, out, pays(n) if self.fast is None else self.fast)
        # at some hundred positions each call would be felt
        return Sweep(self.base, self.base.scene.name, n, content=arrays)

    def _fitting(self, n: int, out: Reals) -> None:
        shape = self.ready.rows, n
        if not isinstance(out, np.ndarray):
            raise unfit("out", out, "give an array of floats of the shape", shape=shape)
        if out.shape != shape or out.dtype != float or not out.flags.c_contiguous:
            wanted = Phrase("give an array of floats of the shape in", shape=shape)
            raise CallError.of("out", Phrase("of the shape", dtype=out.dtype, shape=out.shape), wanted)

    def over(self, designs: Mapping[str, ArrayLike]) -> PreparedDesigns:
        """This mechanism with other dimensions, without reading or analysing it again: for an optimiser's inner loop.

        Parameters
        ----------
        designs : values by keys of the scene file with dots, in their units, shape (designs,) or one number each:
            {"links.1.length": [50, 60], "frame.points.D.x": 400}; also of the drivers ("driver.omega").  Each design
            keeps the assembly that the scene has at its own position

        Raises
        ------
        CallError : a key that the scene does not have or that changes no dimension; values that are no finite numbers,
            lengths that are not positive, or values of different shapes
        """
        if self.ready.solved:
            raise CallError.of("over", "are not given over designs", "prepare each design or sweep over designs",
                               names=listed([*map(str, self.ready.solved)]))
        try:
            values = np.broadcast_arrays(*(np.asarray(v, dtype=float) for v in designs.values()))
        except (AttributeError, TypeError, ValueError):
            values = ()
        if not values or values[0].ndim > 1 or not values[0].size:
            raise CallError.of("designs", "are no numbers for each key", "give one number or a list for each")
        keys = tuple(as_text("designs", key) for key in designs)
        if keys not in self._keys:
            self._keys[keys] = design_keys(written(self.source)[0], self.mechanism, keys)
        given = {key: np.atleast_1d(numbers) for key, numbers in zip(keys, values, strict=True)}
        return PreparedDesigns(self, given, not values[0].ndim, PreparedMechanisms(self.ready, self._keys[keys](given)))

    @cached_property
    def _keys(self) -> dict[tuple[str, ...], Numbers]:
        """The numbers of the formulas that each key changes, found once."""
        return {}

    def compiled(self, n: int) -> bool:
        """Whether n positions are computed by compiled code."""
        return pays(n) if self.fast is None else self.fast

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Prepared) and self._said == other._said

    def __hash__(self) -> int:
        return hash(self.asked)

    def __reduce__(self) -> tuple[object, ...]:
        # what was asked is pickled, the code for it is made anew
        scene, find, bounds, fast = self._said
        return partial(prepare, find=find, bounds=bounds, fast=fast), (scene,)

    @property
    def _said(self) -> tuple[SceneLike, tuple[str, ...], bool, bool | None]:
        return self.mechanism, self.asked, self.ready.bounded, self.fast

    def __repr__(self) -> str:
        return f"<Prepared {self.mechanism.name}: {', '.join(self.asked)}>"


@dataclass(frozen=True, repr=False, eq=False)
class PreparedDesigns(Tabled, OfScene):
    """Many designs of a prepared mechanism.

    ``designs["v_C"]``, ``table`` and the other results belong to the own position of each.

    values : the values of the changed keys, shape (designs,)
    single : whether each is one number: then the arrays are those of one mechanism
    """

    prepared: Prepared
    values: Mapping[str, Reals]
    single: bool
    _designs: PreparedMechanisms

    def __len__(self) -> int:
        return self._designs.count

    @property
    def mechanism(self) -> Mechanism:
        return self.prepared.mechanism

    def __getitem__(self, name: str) -> NDArray[np.float64] | NDArray[np.complex128]:
        """A quantity or a column of all designs at the own position of each, shape (designs,), or () for a single
        design. Raises CallError as ``Sweep``."""
        return self._here[name]

    @property
    def table(self) -> Table:
        """The values at the own position of each: a row for each design."""
        return self._here.table

    @cached_property
    def _here(self) -> Sweep:
        columns, ok, values = self._designs.at(None)
        return self._swept(1, columns, ok, np.asarray(self.prepared.own_unit.of(values)))

    def at(self, value: float) -> Sweep:
        """All designs at one value of the first driver, in its own unit: arrays of shape (designs,)."""
        value = driver_value(value)
        columns, ok, _ = self._designs.at(value * self.prepared.own_unit.si)
        return self._swept(1, columns, ok, np.asarray(float(value)))

    def sweep(self, n: int) -> Sweep:
        """All designs over the whole range of the first driver, as ``Prepared.sweep``: arrays of shape (designs, n).

        Designs whose groups stay away from dead points over the whole turn are computed together, in some microseconds
        each; others (a rocker that is driven, a larger group) are followed one by one, in some milliseconds.
        """
        n = whole_number("sweep", n, 1, MOST, "positions of number")
        columns, ok, values = self._designs.sweep(n, self.prepared.compiled(n * len(self)))
        return self._swept(n, columns, ok, np.asarray(self.prepared.own_unit.of(values)))

    def _swept(self, n: int, columns: Reals, ok: NDArray[np.bool_], driver: Reals) -> Sweep:
        if self.single:
            one_each = driver.shape[:1] == ok.shape[:1] and driver.ndim == ok.ndim
            columns, ok, driver = columns[:, 0], ok[0], driver[0] if one_each else driver
        base, name = self.prepared.base, self.prepared.name
        return Sweep(base, name, n, self._rows, self._designs, content=(columns, ok), given=driver)

    @cached_property
    def _rows(self) -> Designs:
        return Designs(tuple(self.values), (), tuple(zip(*(x.tolist() for x in self.values.values()), strict=True)))

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, PreparedDesigns):
            return NotImplemented
        same = self.prepared == other.prepared and self.single == other.single and [*self.values] == [*other.values]
        return same and all(np.array_equal(self.values[key], other.values[key]) for key in self.values)

    def __hash__(self) -> int:
        return hash((self.prepared, tuple(self.values)))

    def __reduce__(self) -> tuple[object, ...]:
        given = {key: float(numbers[0]) if self.single else numbers for key, numbers in self.values.items()}
        return self.prepared.over, (given,)

    def __repr__(self) -> str:
        return f"<PreparedDesigns {self.prepared.mechanism.name}: {len(self)} of {', '.join(self.values)}>"


def prepare(
    scene: SceneLike, *, find: str | Symbol | Iterable[str | Symbol], bounds: bool = False, fast: bool | None = None
) -> Prepared:
    """Make a mechanism ready to give a few quantities very often: for an optimiser, a simulation, a table of millions.

    The scene is read and analysed, its assembly followed over the whole range of its first driver, and code written for
    the asked quantities, all of it once.

    Parameters
    ----------
    scene : a file, the name of a bundled scene, a mapping of the same shape, or a `Scene`
    find : quantities of a position by name, as for `solve`: "C" (place of a point), "v_C", "v_C.x", "a_B@3" (of the
        point of link 3 that lies at B), "v_C/B" (relative), "omega_3", "s_3/4", "v_3/4" (of a sliding pair).  Forces,
        moments ("F_5/6", "M_2") and angles at joints ("gamma_2-3") stand last, and are solved at each position
    bounds : also a bound of the rounding error of each of them, ``Sweep.bound``
    fast : compile the formulas with numba (the extra ``fast``): True on the first call, which then takes a second or
        two; False never; None in calls for 500,000 positions or more, where numba is installed

    Returns
    -------
    Prepared; all its values are in the scene's length unit, seconds and degrees, rates of angles in rad/s and rad/s2

    Raises
    ------
    SceneError, CallError : the file or the call is wrong, a name of no quantity
    Unsolvable : wrong mobility; the scene's own position cannot be assembled, or is a dead point

    A mechanism with a group larger than a dyad has no closed form: it is served too, by Newton's method at each
    position, some hundred times slower.

    Examples
    --------
    >>> shaper = prepare("shaper-scheme-2", find=["v_C", "omega_4"])
    >>> shaper.names
    ('v_C.x', 'v_C.y', 'omega_4')
    >>> ["%.4f" % x for x in shaper.at(90)]
    ['795.1085', '0.0000', '-1.3709']
    >>> turn = shaper.sweep(360)
    >>> fastest = abs(turn["v_C"]).argmax()
    >>> f"{abs(turn['v_C'][fastest]):.1f} {shaper.units['v_C']} at {turn.driver[fastest]:.1f} deg"
    '1345.6 mm/s at -90.1 deg'

    The same for other lengths, the strokes of the ram:

    >>> cranks = shaper.over({"links.2.length": [80, 90, 100]}).sweep(360)
    >>> cranks["v_C"].shape
    (3, 360)
    >>> [f"{fastest:.0f}" for fastest in abs(cranks["v_C"]).max(axis=1)]
    ['1152', '1346', '1555']
    """
    from graphkin.solver.prepared import prepare as prepared

    given = as_scene(scene)
    wanted = Phrase("name quantities for example v_c omega_3")
    asked = tuple(str(name) for name in ([find] if isinstance(find, Symbol) else as_list("find", find, wanted)))
    if not isinstance(bounds, bool) or not (fast is None or isinstance(fast, bool)):
        raise CallError.of("bounds, fast", "found of bounds and fast", "give true or false", bounds=f"{bounds!r:.40}",
                           fast=f"{fast!r:.40}")
    if not asked:
        raise CallError.of("find", "asks for nothing", "name quantities for example v_c omega_3")
    symbols = dict.fromkeys(columns_shown(given, asked))
    return Prepared(scene, asked, fast, prepared(given, tuple(symbols), given.units, bounds))
