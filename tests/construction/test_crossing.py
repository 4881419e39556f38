"""Two drawn lines meet unless they are parallel: by one rule, and with one problem, wherever they are drawn."""

from __future__ import annotations

from typing import Any

import pytest

from graphkin.construction import EXACT, draft
from graphkin.construction.board.sheet import Board
from graphkin.construction.forces.draw import held_by_pairs
from graphkin.construction.forces.groups import CutFree
from graphkin.construction.forces.position import DrawnPosition
from graphkin.construction.forces.steps import ForceVector
from graphkin.construction.synthesis import construct
from graphkin.errors import Unsolvable
from graphkin.scene import mechanism_of
from graphkin.scene.designs import design_of
from graphkin.scene.symbol import Symbol
from tests.construction.test_verbs import ASIDE, OneVerbErrs

pytestmark = pytest.mark.quick


@pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
def test_lines_meet_however_long_the_vectors_along_them_are(size):
    assert 3 + 2j == pytest.approx(EXACT.crossing("A", 2j, size + 0j, 3 + 0j, size * 1j))


@pytest.mark.parametrize("size", [1e-7, 1.0, 1e7])
@pytest.mark.parametrize("lean", [0.0, 1e-13, -1e-13])
def test_parallel_lines_meet_nowhere_however_long_the_vectors_along_them_are(size, lean):
    with pytest.raises(Unsolvable, match="A: the two lines that should find it are parallel"):
        EXACT.crossing("A", 2j, size + 0j, 3 + 0j, complex(-size, size * lean))


def in_polygon() -> None:
    Board(EXACT).cross("velocity", 0j, 1j, 5 + 0j, -1j, Symbol.parse("v_B"))


def in_force_polygon() -> None:
    cut = CutFree(DrawnPosition(held_by_pairs(draft(mechanism_of("engine-gas-force")))), EXACT, 1.0)
    known, last, first = (ForceVector(Symbol("F", link=link, other="1"), link=link, force=force)
                          for link, force in (("2", 5 + 0j), ("3", 1j), ("4", -2j)))
    chain: list[ForceVector] = []
    cut.lay(chain, known)
    cut.close(chain, last, first)


def in_synthesis() -> None:
    places: list[dict[str, Any]] = [{"B": [x, 0], "C": [x, 10]} for x in (0, 20, 40)]
    construct(design_of({"design": {"kind": "three-positions", "positions": places}}).task)


@pytest.mark.parametrize(("draw", "where", "status", "wanted"), [
    (in_polygon, "v_B", "dead point", "move the driver off this position"),
    (in_force_polygon, "F_3/1", "dead point", "move the driver off this position"),
    (in_synthesis, "A", "not drawn", "other data"),
])
def test_parallel_lines_are_one_problem_with_the_remedy_of_their_task(draw, where, status, wanted):
    with pytest.raises(Unsolvable) as refusal:
        draw()
    (problem,) = refusal.value.problems
    assert (where, "the two lines that should find it are", wanted) == (
        str(problem.where), problem.data["id"], str(problem.wanted)
    )
    assert status == refusal.value.status


def test_a_crossing_is_pricked_and_so_errs_with_the_hand():
    hand = OneVerbErrs(errs_in="point")
    assert ASIDE == pytest.approx(hand.crossing("A", 2j, 1 + 0j, 3 + 0j, 1j) - (3 + 2j))
