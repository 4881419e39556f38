"""A polygon as it stands on a page: its vectors and steps, and where the pole is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

from graphkin.drafting.sheet import DiagramName, Sheet, Step, Vector
from graphkin.drawing.box import Box
from graphkin.drawing.conventions import Letters
from graphkin.drawing.detail import Detail
from graphkin.scene.symbol import Symbol

__all__ = ["SAME", "ZERO", "OnPage", "same_place"]

SAME = 0.02  # mm: nearer end points fall together on paper
ZERO = 0.02  # mm: a shorter vector is drawn as a dot


@dataclass(frozen=True)
class OnPage:
    """A sheet's polygon with the letters of a convention and the words of a language."""

    sheet: Sheet
    diagram: DiagramName
    letters: Letters
    language: str
    panel: Box
    origin: complex
    enlarged: tuple[Detail, ...]

    def at(self, z: complex) -> complex:
        """The page point of a point of the polygon."""
        return self.origin + z.conjugate()

    @cached_property
    def steps(self) -> tuple[Step, ...]:
        return tuple(step for step in self.sheet.steps if step.diagram == self.diagram)

    @cached_property
    def vectors(self) -> Mapping[Symbol, tuple[int, Vector]]:
        """Each vector, with the number of the step that drew it last."""
        return {s.symbol: (step.number, s) for step in self.steps for s in step.strokes if isinstance(s, Vector)}

    def in_order(self) -> list[tuple[int, Vector]]:
        """Long vectors first, so that short ones lie on top."""
        return sorted(self.vectors.values(), key=lambda sv: (-round(abs(sv[1].span), 6), sv[0]))

    def covered(self, a: complex, b: complex) -> bool:
        """Whether a drawn vector lies from a to b or back."""
        return any(
            (abs(v.tail - a) < SAME and abs(v.tip - b) < SAME) or (abs(v.tail - b) < SAME and abs(v.tip - a) < SAME)
            for _, v in self.vectors.values()
        )


def same_place(z: complex) -> complex:
    """A key that is the same for points that fall together."""
    return complex(round(z.real / SAME), round(z.imag / SAME))
