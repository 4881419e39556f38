"""Random dyads of every kind: between moving links, with offsets, with bodies whose shape changes in a given way."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from graphkin.solver.algebra.dyads import DyadSolution, Joints, solve_dyad
from graphkin.solver.algebra.pose import Pose
from tests import EVERYTHING

EXAMPLES = 600 if EVERYTHING else 25
KINDS = ("RRR", "RRP", "RPR", "PRP", "RPP")
number = st.floats(-1.0, 1.0).map(lambda x: round(x, 3))


@st.composite
def moving(draw: st.DrawFn, reach: float = 1.0) -> Pose:
    z, v, a = (complex(draw(number), draw(number)) * reach for _ in range(3))
    u = np.exp(1j * np.pi * draw(number))
    return Pose(*(np.array([x]) for x in (z, u, v, draw(number), a, draw(number))))


@st.composite
def joints(draw: st.DrawFn) -> Joints:
    frames = [draw(moving(2.0 if i in (0, 3) else 1.0)) for i in range(6)]
    return Joints(*frames, sense=draw(st.sampled_from([1.0, -1.0])), size=1.0)


def solved(kind: str, j: Joints, sign: float) -> DyadSolution:
    with np.errstate(all="ignore"):
        found = solve_dyad(kind, j, np.array([sign]))
    assume(kind in ("PRP", "RPP") or found.discriminant[0] > 1e-3)
    assume(abs(found.sine[0]) > 0.03)
    assume(abs(j.inner1.z - j.outer1.z)[0] > 0.05 and abs(j.inner2.z - j.outer2.z)[0] > 0.05)
    return found


def gaps(kind: str, j: Joints, found: DyadSolution) -> dict[str, list[float]]:
    """For each pair how far it is open, in place, velocity and acceleration."""
    first, second = found.first, found.second
    ends = ((j.known1, first.of(j.outer1)), (first.of(j.inner1), second.of(j.inner2)), (j.known2, second.of(j.outer2)))
    open_: dict[str, list[float]] = {"position": [], "velocity": [], "acceleration": []}
    for letter, (one, two) in zip(kind, ends, strict=True):
        seen = two.inverse().of(one)
        place = [seen.z, seen.v, seen.a]
        turn = [seen.u - 1, seen.omega, seen.alpha]
        for what, z, t in zip(open_, place, turn, strict=True):
            open_[what] += [abs(z[0])] if letter == "R" else [abs(z[0].imag), abs(t[0])]
    return open_


def scale(found: DyadSolution) -> float:
    poses = (found.first, found.second)
    return 1 + max(float(np.max(np.abs(np.concatenate([p.z, p.v, p.omega, p.a, p.alpha])))) for p in poses)


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=EXAMPLES, deadline=None)
@given(j=joints(), sign=st.sampled_from([1.0, -1.0]))
def test_every_pair_of_a_random_dyad_stays_closed(kind: str, j: Joints, sign: float) -> None:
    found = solved(kind, j, sign)
    gain = scale(found) / found.sine[0] ** 2
    assert [what for what, open_ in gaps(kind, j, found).items() if not max(open_) < 1e-14 * gain] == []


@settings(max_examples=EXAMPLES, deadline=None)
@given(j=joints())
def test_the_inner_point_of_rrr_lies_left_of_the_line_between_the_outer_ones(j: Joints) -> None:
    found = solved("RRR", j, 1.0)
    inner = found.first.of(j.inner1).z - j.known1.z
    assert ((j.known2.z - j.known1.z).conj() * inner).imag[0] > 0


@settings(max_examples=EXAMPLES, deadline=None)
@given(j=joints())
def test_the_first_form_of_rrp_has_the_greater_travel(j: Joints) -> None:
    one, two = solved("RRP", j, 1.0), solved("RRP", j, -1.0)

    def travel(found: DyadSolution) -> float:
        seen = j.known2.inverse().of(found.second.of(j.outer2))
        return float(j.sense * seen.z[0].real)

    assert travel(one) > travel(two)


@settings(max_examples=EXAMPLES, deadline=None)
@given(j=joints())
def test_the_first_form_of_rpr_has_the_greater_travel_of_the_sliding_body(j: Joints) -> None:
    one, two = solved("RPR", j, 1.0), solved("RPR", j, -1.0)

    def travel(found: DyadSolution) -> float:
        return float(found.second.of(j.inner2).inverse().of(found.first.of(j.inner1)).z[0].real)

    assert travel(one) > travel(two)


def test_height_of_a_needle_keeps_its_digits() -> None:
    still = np.zeros(1)

    def axes(x: float) -> Pose:
        return Pose(np.array([x + 0j]), np.array([1 + 0j]), still, still, still, still)

    # arms 1 and 1, feet 2 - 1e-13 apart: the height is sqrt(1e-13) to 16 digits (1 - (1 - d)^2 = 2 d - d^2)
    gap = 2.0 - 1e-13
    half = (2.0 - gap) / 2
    found = solve_dyad(
        "RRR", Joints(axes(0), axes(0), axes(1), axes(gap), axes(0), axes(1), 1.0, 1.0), np.ones(1)
    )
    assert found.first.of(axes(1)).z[0].imag == pytest.approx(np.sqrt(half * (2 - half)), rel=1e-15)
