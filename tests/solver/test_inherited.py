"""What links inherit of the errors of those they hang on: every kind of dyad, moving guides and driven bodies too."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from graphkin.scene import mechanism_of
from graphkin.scene.model import Mechanism
from graphkin.solver import solve
from tests import EVERYTHING, mechanisms
from tests.api.test_large import chain
from tests.bench import accuracy


@pytest.mark.parametrize("kind", ["RRR", "RRP", "RPR", "PRP", "RPP"])
def test_the_true_error_never_exceeds_the_bound(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    def drawn(rng: np.random.Generator) -> Mechanism:
        return mechanism_of(mechanisms.random_scene(int(rng.integers(10**6)), (kind, kind)))

    monkeypatch.setattr(accuracy, "random_scene", drawn)
    assert accuracy.measure(1200 if EVERYTHING else 36, 3, each=3).broken == []


def _bound(scene: dict[str, Any]) -> float:
    return float(solve(mechanism_of(scene)).bound.velocity[0])


def test_each_dyad_of_a_chain_at_most_trebles_the_bound() -> None:
    assert _bound(chain(9)) < 3**8 * _bound(chain(1))
