"""Bounds of the errors of each link by rounding and by the numbers of the file, from the constraints of all links
together.

With J the derivative of the constraints by places and turns, an error of place is J^-1 times the errors of the
constraints, term by term: their residuals at the computed place, the rounding of these, and the errors of the given
numbers (Higham, Accuracy and Stability of Numerical Algorithms, ch. 1: forward error is condition times backward
error).  Errors of the rates are the derivatives of those products by time, with the rates of J along the motion.  They
are computed when they are asked for: a motion does not need them.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.solver.algebra.constraints import Constraints, Layout, Parts, led_relation, product, solve_all
from graphkin.solver.algebra.pose import GIVEN, UNIT, Array, Drive, ErrorBound, Pose
from graphkin.solver.drivers import conversion_error, law_doubts, meant, meant_angle
from graphkin.structure import Structure

FEW = 4
"""The roundings of a sum of products."""
FEW_ROUNDINGS = 8
"""Roundings in a result that is itself exact but for the last place."""
LOOKED_UP = 4 * GIVEN
"""Relative error of what the law of a cam gives."""
SLACK = 1.001
"""For the rounding of the bounds themselves."""
SAFE = 2.0
"""The changes of the matrix are taken this much greater: an error is told to first order of them."""
FLAT = 1e-6
"""Changes of the matrix, relatively, that the slack takes."""
BLOCK = 4096
"""Positions whose constraints are looked at together."""
LEAST = 1e-30
"""Stands for an error of place (of the size, rad) that is none."""
VAST = 1e100
"""Stands for an entry of an inverse that is not known."""
Errors = ErrorBound[Array]


def error_bounds(
    structure: Structure, poses: Mapping[str, Pose], drive: Drive, slack: Array, refined: Array,
    value_error: Array | None = None,
) -> dict[str, Errors]:
    """Bounds of the errors of each moving link: the largest of any point of it, coincident points under sliding links
    too, and of its turning; fields of shape (n,), infinite where they are unknown.

    Parameters
    ----------
    poses : of all links, with their rates, as computed
    drive : of the drivers, shape (n, drivers)
    slack : the error of each cam's lift and of each rolling relation, in the order of the elements, shape (n,
        relations) (rad, m; of larger groups no unit)
    refined : positions that were computed in 50 digits, shape (n,)
    value_error : the errors of the drivers' values, shape (n, drivers); None for the errors of conversion and rounding
    """
    drive = drive.followed(structure)
    system, n = Constraints.whole(structure, drive), len(drive)
    names, size = system.group.members, structure.scene.size
    with np.errstate(all="ignore"):
        all_ = system.of(poses)
        parts = system.parts(all_, 2)
        matrices, residuals = system.matrices(parts), system.constraints(all_, 2, parts)
        rows = _row_errors(system, all_, parts, refined, _driver_errors(structure, drive, refined, value_error))
        _follow(system, all_, slack, matrices, residuals, rows)
        residuals[:, refined] = 0.0
        rows += np.abs(residuals)
        hanging, reached, _ = _of_form(system)
        sizes = _sizes(matrices, reached)
        terms = sizes @ np.moveaxis(rows, 0, 2)
        error = terms[0][..., 0]
        wild, grown = _growth(sizes[0], _changes(system, parts, error), error, hanging)
        errors = error, terms[0][..., 1] + terms[1][..., 0], terms[0][..., 2] + 2 * terms[1][..., 1] + terms[2][..., 0]
        largest: list[Array] = []
        for order, error in enumerate(errors):
            # each order has the inverse twice more
            for _ in range(2 * order + 1 if wild.any() else 0):
                error[wild] = (grown @ error[wild][..., None])[..., 0]
            error = error.reshape(n, -1, 3)
            largest += [size * np.hypot(error[..., 0], error[..., 1]), error[..., 2]]
        few = FEW_ROUNDINGS * UNIT * refined[:, None]
        wide = _largest(all_, len(names), size)
        bound = ErrorBound(*(largest[i] + few * w for i, w in zip((0, 2, 4, 1, 3, 5), wide, strict=True)))
        bounds = np.array([*_of_points(system, all_, bound)])
        bounds = np.where(bounds < VAST**0.5, bounds * SLACK, np.inf)
        return {name: ErrorBound(*bounds[:, :, k]) for k, name in enumerate(names)}


@dataclass(frozen=True, eq=False, repr=False)
class Accuracy:
    """The solution at n positions, from which its errors are computed when they are asked for.

    structure, poses, drive, slack, refined : as for ``error_bounds``
    clear : positions at which all errors are known to be slight, shape (n,)
    ok : solved positions, shape (n,); bounds elsewhere are NaN
    """

    structure: Structure
    poses: Mapping[str, Pose]
    drive: Drive
    slack: Array
    refined: Array
    clear: Array
    ok: Array

    def rows(self, rows: slice | Array) -> Accuracy:
        """The accuracy at some of the positions."""
        poses = {name: self.poses[name].rows(rows) for name in self.structure.links}
        columns = (x[rows] for x in (self.slack, self.refined, self.clear, self.ok))
        return Accuracy(self.structure, poses, self.drive[rows], *columns)

    @cached_property
    def links(self) -> Mapping[str, Errors]:
        """The bounds of each moving link that is not redundant."""
        return self._of_links(self.refined)

    @cached_property
    def drawn(self) -> Mapping[str, Errors]:
        """The accuracy of a computation in 16 digits throughout, as of a drawing."""
        return self._of_links(np.zeros_like(self.refined)) if self.refined.any() else self.links

    def of(self, links: Iterable[str], drawn: bool = False) -> Errors:
        """The largest bounds of some links; of all if only the frame is given."""
        known = self.drawn if drawn else self.links
        held = [known[name] for name in links if name in known] or [*known.values()]
        return most_of(held) if held else ErrorBound(*(np.where(self.ok, 0.0, np.nan),) * 6)

    def _of_links(self, refined: Array) -> dict[str, Errors]:
        names = [name for name in self.structure.links if name != self.structure.scene.frame.name]
        errors = {name: np.full((6, len(self.ok)), np.nan) for name in names}
        places = np.flatnonzero(self.ok)
        for rows in (places[first : first + BLOCK] for first in range(0, len(places) if names else 0, BLOCK)):
            poses = {name: self.poses[name].rows(rows) for name in self.structure.links}
            some = error_bounds(self.structure, poses, self.drive[rows], self.slack[rows], refined[rows])
            for name, bound in some.items():
                errors[name][:, rows] = [*bound]
        return {name: ErrorBound(*rows) for name, rows in errors.items()}


def most_of(bounds: Iterable[Errors]) -> Errors:
    """The largest bounds of several links."""
    return ErrorBound(*(np.maximum.reduce(np.broadcast_arrays(*column)) for column in zip(*bounds, strict=True)))


def roughness(structure: Structure, poses: Mapping[str, Pose], bound: Errors) -> Array:
    """A bound of velocities and accelerations over the greatest ones, for points as far off as the mechanism is large,
    shape (n,)."""
    size, n = structure.scene.size, len(bound.velocity)
    fields = [p.spread(n) for name, p in poses.items() if name != structure.scene.frame.name]
    speed = np.max([np.abs(p.v) + size * np.abs(p.omega) for p in fields], axis=0)
    push = np.max([np.abs(p.a) + size * (np.abs(p.alpha) + p.omega**2) for p in fields], axis=0)
    velocity, acceleration = bound.velocity + size * bound.omega, bound.acceleration + size * bound.alpha
    with np.errstate(all="ignore"):
        parts = velocity / np.maximum(speed, 1e-300), acceleration / np.maximum(push, 1e-300)
        return np.asarray(np.maximum(*parts))


def _largest(all_: Pose, count: int, size: float) -> tuple[Array | float, ...]:
    """The largest place, velocity and acceleration of the links, for points as far off as the mechanism is large; of a
    direction 1, and its rates."""
    z, v, a, omega, alpha = (np.abs(x[:, :count]) for x in (all_.z, all_.v, all_.a, all_.omega, all_.alpha))
    points = z + size, v + size * omega, a + size * (alpha + omega**2)
    place, speed, push, spin, turning = (x.max(axis=1, keepdims=True) for x in (*points, omega, alpha))
    return place, speed, push, 1.0, spin, turning


def _follow(
    system: Constraints, all_: Pose, slack: Array, matrices: Sequence[Array], residuals: Array, errors: Array
) -> None:
    """Add the relations of cams and rolling to the constraints of all links: the row of a cam's follower has in the
    matrix the slope of the lift in the column of its cam.

    Parameters
    ----------
    slack : see ``error_bounds``
    matrices, residuals, errors : the matrix, the constraints and their errors, each with its first and second rate;
        they are changed
    """
    layout, relations = system.layout, system.group.rolling
    scales = np.ones(len(relations))
    for element in (e for e in system.structure.driven if not e.drivers):
        relation = led_relation(element)
        k = relations.index(relation)
        row, scale = layout.rolling_rows[k], next(iter(relation.weights(layout.size).values()))
        scales[k] = scale
        if element.lifted is None:
            continue
        from graphkin.solver.cams import follower_inputs, greatest_jerk

        cam = layout.link[element.lifted.link]
        inputs = follower_inputs(element.lifted, all_.u[:, cam])
        slope, second = scale * inputs["slope"], scale * inputs["second"]
        jerk = scale * greatest_jerk(element.lifted.law)
        omega, alpha = all_.omega[:, cam], all_.alpha[:, cam]
        changes = slope, second * omega, abs(jerk) * omega**2 + np.abs(second * alpha)
        for matrix, change in zip(matrices, changes, strict=True):
            matrix[:, row, 3 * cam + 2] -= change
        for order, terms in enumerate(((slope * omega,), (second * omega**2, slope * alpha)), start=1):
            residuals[order][:, row] -= sum(terms)
            errors[order][:, row] += LOOKED_UP * sum(map(np.abs, terms))  # both are off, each by itself
    errors[0][:, layout.rolling_rows] += slack * scales


def _sizes(matrices: Sequence[Array], reached: Array) -> Array:
    """Sizes of the entries of the inverse of a matrix, and of its first and second rate along the motion, shape (3, n,
    columns, rows).

    With S the inverse, G and A the rates of the matrix these are -S G S and 2 S G S G S - S A S.

    Parameters
    ----------
    matrices : the matrix and its rates, shape (n, rows, columns) each
    reached : entries of the inverse that may differ from zero, shape (columns, rows)
    """
    here, first, second = matrices
    inverse = solve_all(here, np.broadcast_to(np.eye(here.shape[1]), here.shape))
    inverse = np.where(reached, inverse, 0.0)
    bent = inverse @ first @ inverse
    rates = np.array((inverse, bent, 2 * bent @ first @ inverse - inverse @ second @ inverse))
    return np.asarray(np.nan_to_num(np.abs(rates), nan=VAST, posinf=VAST))


def _of_form(system: Constraints) -> tuple[Array, Array, Sequence[Array]]:
    """Of all links together, made once: 1 where a coordinate may pass an error on to another, else 0, shape (columns,
    columns); the entries of the inverse that may differ from zero; the errors of the file's numbers."""
    structure, layout = system.structure, system.layout
    if "bounds" not in structure.kept:
        depending = _depending(structure, layout.names[: layout.members])
        hanging = np.kron(depending, np.ones((3, 3)))
        structure.kept["bounds"] = hanging, _reached(layout, depending), _written(layout)
    known: tuple[Array, Array, Sequence[Array]] = structure.kept["bounds"]
    return known


def _depending(structure: Structure, names: tuple[str, ...]) -> Array:
    """Whether each link depends on each, as on itself and on its group, bool, shape (links, links): near a dead point
    of a group the links before it stay certain.  A rolling link may depend on later links."""
    before = {structure.scene.frame.name: frozenset[str]()}
    for element in structure.elements:
        ends = {*element.members, *(link for end in element.outside for link in before.get(end, ()))}
        before |= dict.fromkeys(element.members, frozenset(ends))
    return np.array([[other in before[name] for other in names] for name in names])


def _reached(layout: Layout, depending: Array) -> Array:
    """The entries of the inverse that may differ from zero: only constraints between links on which a link depends move
    it, shape (columns, rows)."""
    taking = layout.constant != 0
    taking.flat[layout.entries.entries] = True
    taking = taking.reshape(layout.rows, -1, 3).any(axis=2)
    return np.repeat(~((~depending).astype(int) @ taking.T.astype(int)).astype(bool), 3, axis=0)


def _changes(system: Constraints, parts: Parts, error: Array) -> Array:
    """The greatest change of each entry of the matrix within the error of place, shape (n, rows, columns)."""
    layout, n = system.layout, len(error)
    spread = np.zeros((n, len(layout.names), 3))
    spread[:, : layout.members] = error.reshape(n, -1, 3)
    turn, moved = spread[:, :, 2], np.hypot(spread[:, :, 0], spread[:, :, 1])
    ends, part = layout.joints[:, layout.joint], np.abs(layout.along)
    arms = np.abs(layout.places[:, layout.joint]) / layout.size
    turned, gap = turn[:, layout.axis], np.abs(parts.gap[0][:, layout.joint]) / layout.size
    across = part * turned
    # a place of the link with which the axis turns is the same along it
    swung = part * arms * np.where(ends == layout.axis, 0.0, turn[:, ends] + turned[:, None])
    seen = part * (gap * turned + (moved[:, ends] + arms * turn[:, ends]).sum(axis=1))
    entries = np.concatenate((across, across, across, across, swung.reshape(n, -1), seen), axis=1)
    changes = np.zeros((n, layout.rows * 3 * layout.members))
    changes[:, layout.entries.entries] = layout.entries.of(entries)
    return changes.reshape(n, layout.rows, -1)


def _growth(inverse: Array, changes: Array, error: Array, hanging: Array) -> tuple[Array, Array]:
    """Positions at which changes of the matrix may matter, shape (n,), and for these the factor by which they enlarge
    each error: with C the product of both sizes it is (1 - C)^-1, unknown where that is not positive (Varga, Matrix
    Iterative Analysis, theorem 3.8).

    It is solved in parts of the errors of place: along a chain they grow by many powers of ten, and rounding in the
    large ones would reach the small.
    """
    product = SAFE * (inverse @ changes)
    wild = ~(product.sum(axis=2).max(axis=1) < FLAT)
    if not wild.any():
        return wild, changes[:0]
    scale = np.maximum(error[wild], LEAST)
    ratio = scale[:, :, None] / scale[:, None, :]
    parts, unit = product[wild] / ratio, np.eye(product.shape[1])
    grown = solve_all(unit - parts, np.broadcast_to(unit, parts.shape))
    unknown = ~(grown.min(axis=2) > -FLAT)
    grown = np.maximum(grown, unit + parts) * ratio  # the first terms of its series, should rounding leave less
    grown[unknown] = VAST
    return wild, grown * hanging


def _of_points(system: Constraints, all_: Pose, error: Errors) -> Errors:
    """The largest error of any point of each link, and of its turning, fields of shape (n, links)."""
    structure, layout = system.structure, system.layout
    names, count = layout.names[: layout.members], layout.members
    reach = [max(map(abs, structure.links[name].points.values()), default=0.0) for name in names]
    r = np.broadcast_to(np.array(reach), (len(error.angle), count)).copy()
    for slide in structure.slides:
        a, b = (layout.link[name] for name in slide.links)
        if b < count:
            r[:, b] = np.maximum(r[:, b], np.abs(all_.z[:, a] - all_.z[:, b]))
    z, v, a_, omega, alpha = (np.abs(x[:, :count]) for x in (all_.z, all_.v, all_.a, all_.omega, all_.alpha))
    return error.within(r, (z, v, a_), omega, alpha + omega**2, FEW * UNIT)


# what the constraints may be off by themselves


def _driver_errors(structure: Structure, drive: Drive, refined: Array, value_error: Array | None) -> list[Array]:
    """The errors of values, rates and second rates of the drivers, shape (n, drivers) each (rad, m)."""
    turns = np.array([d.turns for d in structure.drivers], dtype=bool)
    value = np.abs(drive.value)
    errors = [np.where(turns, GIVEN / 2 * value + UNIT, GIVEN * value) if value_error is None else value_error.copy()]
    errors += [GIVEN * np.abs(drive.rate), GIVEN * np.abs(drive.second)]
    by_laws = law_doubts(structure.drivers)
    for k in np.flatnonzero(refined):
        for j, driver in enumerate(structure.drivers):
            if by_laws[0, j]:
                continue
            number = float(drive.value[k, j])
            exact = driver.exact and number == driver.values[0]
            known = exact or (meant_angle if driver.turns else meant)(number)[1]
            errors[0][k, j] = 0.0 if known else GIVEN * abs(number)
            for error, rate in ((errors[1], drive.rate[k, j]), (errors[2], drive.second[k, j])):
                error[k, j] = 0.0 if meant(float(rate))[1] else GIVEN * abs(rate)
    return [error + doubt for error, doubt in zip(errors, by_laws, strict=True)]


def _written(layout: Layout) -> Sequence[Array]:
    """The errors of the file's numbers in 16 digits and in 50: of the places of each joint, shape (2, 2, joints), of
    the direction of each line and of each turn, shape (2, numbers)."""
    def errors(numbers: Iterable[tuple[complex, bool]]) -> Array:
        numbers = [*numbers]
        known = {number: conversion_error(*number) for number in {*numbers}}
        return np.array([known[number] for number in numbers]).reshape(-1, 2).T

    turning = [(0j, False) if p.turns else (p.guide.direction, True) for p in layout.line_pairs]
    guides = errors((1 + 0j, True) if p is None else (p.guide.direction, True) for p in layout.turn_pairs)
    blocks = errors((1 + 0j, True) if p is None else (p.turn, True) for p in layout.turn_pairs)
    places = errors((complex(z), False) for z in layout.places.flat).reshape(2, *layout.places.shape)
    return places, errors(turning), guides + blocks


def _row_errors(
    system: Constraints, all_: Pose, parts: Parts, refined: Array, given: Sequence[Array]
) -> Array:
    """The errors of constraints and their rates with the links exactly at their computed places: (3, n, rows).

    For each product of the lines the size of one factor times the error of the other, with all rates.
    """
    layout, which = system.layout, refined.astype(int)
    unit = np.where(refined, 0.0, UNIT)[:, None]
    lean = np.abs(np.abs(all_.u) - 1) * (unit > 0)
    places, directed, turning = (written[which] for written in _of_form(system)[2])
    rates = np.abs(all_.omega), np.abs(all_.alpha)
    spins = np.ones_like(lean), rates[0], rates[1] + rates[0] ** 2
    in_link = np.abs(layout.places) * (lean[:, layout.joints] + FEW * unit[:, None]) + 1.5 * places
    place_errors = [(spin[:, layout.joints] * in_link + unit[:, None] * np.abs(place)).sum(axis=1)
           for spin, place in zip(spins, parts.place, strict=True)]
    axis = [np.abs(layout.along) * spin[:, layout.axis] for spin in spins]
    bent = lean[:, layout.axis] + 1.5 * directed + FEW * unit
    moved = product(axis, [x[:, layout.joint] for x in place_errors])
    leant = product([x * bent for x in axis], [np.abs(x[:, layout.joint]) for x in parts.gap])
    errors, weights = np.zeros((3, len(refined), layout.rows)), np.abs(layout.rolled).T
    for order in range(3):
        errors[order][:, layout.line_rows.entries] = layout.line_rows.of(moved[order] + leant[order]) / layout.size
        errors[order][:, layout.driven] += given[order][:, layout.drivers] * layout.scales[1]
    errors[0][:, layout.turn_rows] += FEW * unit + 1.5 * turning
    for order, rate in enumerate(rates, start=1):
        errors[order][:, layout.turn_rows] += unit * (rate[:, layout.one] + rate[:, layout.two])
    if len(layout.rolling_rows):
        for order, place_errors in enumerate((lean + FEW * unit, *((FEW + 1) * unit * rate for rate in rates))):
            errors[order][:, layout.rolling_rows] += place_errors @ weights
    return errors
