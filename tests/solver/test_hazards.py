"""Random mechanisms that just have a dead point or just miss it (a hundred thousand: tests/bench/hazards.py)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from graphkin.solver.algebra.pose import Array
from graphkin.solver.path import continuity
from graphkin.solver.path.driver_path import Path
from tests import EVERYTHING
from tests.bench.hazards import Found, look

FEW = 1000  # positions, enough for what is wrong on purpose to be seen


@pytest.fixture(scope="module")
def found() -> Found:
    return look(30_000 if EVERYTHING else FEW, 11, each=8)


def test_nothing_jumps_nor_is_left_open_nor_is_not_a_number(found: Found) -> None:
    assert found.wrong == []


def test_dead_points_are_among_them(found: Found) -> None:
    assert found.dead > 10


def test_a_jump_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    passed_by = continuity._passed_by

    def in_one_form(path: Path, i: int, form: Callable[[Array], Array], *rest: Any) -> Path:
        return passed_by(path, i, lambda t: np.broadcast_to(form(np.zeros(1)), t.shape), *rest)

    monkeypatch.setattr(continuity, "_passed_by", in_one_form)
    assert any("jumps" in x for x in look(FEW, 11, each=8).wrong)
