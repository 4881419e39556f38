"""``graphkin solve --loops``: vector loops of a position, their projections, and the two matrix equations in numbers,
as lines for a terminal, as LaTeX, and as data."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from graphkin.account.loops import (
    as_latex,
    as_plain,
    equation,
    matrices,
    matrix_latex,
    matrix_lines,
    projections,
    root,
)
from graphkin.errors import CallError, Problem
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.solver import Motion
from graphkin.structure.loop_values import LoopBlock, loops_in_numbers
from graphkin.structure.loops import Unknown
from graphkin.words import Phrase, say, word

__all__ = ["LoopText", "loops_text"]

ROUNDED = 1e-11
"""A sum of arrows that is less than this part of the longest is nothing but rounding."""


@dataclass(frozen=True)
class LoopText:
    """The loops of one position; ``plain`` and ``latex`` are what the command prints."""

    scene: Mechanism
    blocks: tuple[LoopBlock, ...]
    language: str = "en"

    @cached_property
    def data(self) -> list[dict[str, Json]]:
        """For programs: loops that are solved together, in scene units and radians; the matrix times the rates is the
        right side, rows are x and y of each loop in turn."""
        return [self._block(block) for block in self.blocks]

    def _block(self, block: LoopBlock) -> dict[str, Json]:
        metres, fast = self.scene.units.metres, self.scene.units.rates.metres

        def plain(unknown: Unknown, value: float, per: float) -> float:
            return value / per if unknown.kind == "s" else value

        loops = [
            {
                "name": one.loop.name, "links": list(one.loop.links), "points": list(one.loop.points),
                "arrows": [
                    {"link": a.arrow.link, "from": a.arrow.names[0], "to": a.arrow.names[1],
                     "vector": [a.vector.real / metres, a.vector.imag / metres],
                     **({"slide": a.arrow.slide, "travel": a.travel / metres} if a.arrow.slide else {})}
                    for a in one.arrows
                ],
                "gap": abs(one.gap) / metres,
                **({"root": {"of": str(one.root.unknown), "sign": one.root.sign,
                             "value": plain(one.root.unknown, one.root.value, metres)}} if one.root else {}),
            }
            for one in block.loops
        ]  # fmt: skip
        matrix = [
            [float(x) / (fast if u.kind == "theta" else 1.0) for x, u in zip(row, block.unknowns, strict=True)]
            for row in block.matrix
        ]
        return {
            "loops": loops,
            "unknowns": [str(u) for u in block.unknowns],
            "values": [plain(u, v, metres) for u, v in zip(block.unknowns, block.values, strict=True)],
            "matrix": matrix,
            "velocity": (block.velocity / fast).tolist(),
            "rates": [plain(u, v, fast) for u, v in zip(block.unknowns, block.rates, strict=True)],
            "acceleration": (block.acceleration / fast).tolist(),
            "second_rates": [plain(u, v, fast) for u, v in zip(block.unknowns, block.second_rates, strict=True)],
        }

    @property
    def plain(self) -> str:
        """The loops as lines of text."""
        units, letters = self.scene.units, self.scene.sheet.convention
        told = Phrase("explained unit", (units.length, units.of("velocity").text))
        lines = [say(told, self.language), ""] if self.blocks else []
        for block in self.blocks:
            for one in block.loops:
                head = Phrase("loop heading", (one.loop.name, ", ".join(one.loop.links), equation(one, letters)))
                x, y = projections(one, block, self.scene)
                lines += [as_plain(say(head, self.language)), f"  x: {as_plain(x)}", f"  y: {as_plain(y)}"]
                if one.root is not None:
                    lines.append(f"  {as_plain(root(one.root, one, self.scene, self.language))}")
                longest = max(abs(arrow.vector) for arrow in one.arrows)
                if abs(one.gap) <= ROUNDED * longest:
                    lines.append(f"  {word('loop closes', self.language)}")
                else:
                    gap = f"{abs(one.gap) / self.scene.units.metres:.1e}"
                    lines.append(f"  {say(Phrase('loop gap', (gap, self.scene.units.length)), self.language)}")
            for matrix in matrices(block, self.scene):
                lines += [f"  {word(matrix.key, self.language)}", *matrix_lines(matrix)]
                lines.append("  " + ", ".join(map(as_plain, matrix.solution)))
            lines.append("")
        return "\n".join(lines or [word("no loops", self.language)]).rstrip()

    @property
    def latex(self) -> str:
        """The same as LaTeX, a formula a line."""
        lines: list[str] = []
        letters = self.scene.sheet.convention
        for block in self.blocks:
            for one in block.loops:
                lines += [as_latex(equation(one, letters)), *map(as_latex, projections(one, block, self.scene))]
            lines += [matrix_latex(matrix) for matrix in matrices(block, self.scene)]
        return "\n".join(rf"\[ {line} \]" for line in lines)


def loops_text(motion: Motion, language: str) -> LoopText:
    """The loops at the first solved position of a motion.

    Raises
    ------
    CallError : no position is solved, or a chosen loop goes from a point to another that nothing joins
    """
    if not motion.ok.any():
        raise CallError(Problem("loops", Phrase("no position is solved", why=motion.reasons[0])))
    k = int(np.argmax(motion.ok))
    axes = {name: complex(pose.u[k]) for name, pose in motion.poses.items()}
    travels = {s.key: float(motion.slide(s.key).travel[k]) for s in motion.slides}
    travels = {key: value for key, value in travels.items() if math.isfinite(value)}
    return LoopText(motion.scene, loops_in_numbers(motion.structure, axes, travels), language)
