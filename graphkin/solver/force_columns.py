"""Forces and moments as columns, for a prepared mechanism: they are solved with the motion, there are no formulas."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from graphkin.scene.force_names import force_names, opposite
from graphkin.scene.model import Mechanism
from graphkin.solver.driver_range import DriverRange
from graphkin.solver.forces import forces_of
from graphkin.solver.pose import Array

__all__ = ["force_heads", "force_rows"]


def force_heads(scene: Mechanism, name: str) -> tuple[str, ...]:
    """The heads of the columns of a force (two, ``F_5/6.x`` and ``F_5/6.y``) or a moment; none for what is neither."""
    known, plain = force_names(scene), name.removesuffix("+")
    kind = known.get(plain) or known.get(opposite(plain))
    return (f"{name}.x", f"{name}.y") if kind == "force" else (name,) if kind else ()


def force_rows(
    reach: DriverRange, names: Sequence[str], values: Array, bounded: bool = False
) -> tuple[list[Array], list[Array], Array]:
    """Forces and moments at values of the first driver (rad, m), shape (n,).

    Returns
    -------
    rows : one for each head of each name, in the scene's units
    bounds : for each name how far rounding may have moved its rows, where that is wanted (``bounded``)
    ok : bool, shape (n,): where the motion comes, and its balance does work
    """
    forces, per = forces_of(reach.motion(reach.offsets(values))), reach.scene.units.newtons
    rows, bounds = [], []
    for name in names:
        value = forces.value(name)
        assert value is not None
        vector = np.iscomplexobj(value)
        rows += [part / per for part in ((value.real, value.imag) if vector else (value,))]
        bounds += [forces.bound[0 if vector else 1] / per] if bounded else []
    return rows, bounds, forces.ok
