"""Vector loops in words and as data: the equation of each, its projections, its root, and the two matrix equations of
its rates; those of a position as lines for a terminal, as LaTeX, and for programs (``graphkin solve --loops``).

Lines are rich text; `plain` and `as_latex` give them to terminals and papers.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import groupby
from typing import TYPE_CHECKING

import numpy as np

from graphkin.account.headings import number
from graphkin.account.notation import as_vector
from graphkin.errors import CallError
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.scene_tables import Convention
from graphkin.scene.symbol import KINDS
from graphkin.structure.loops import Loop, LoopArrow, LoopBlock, Root, loops_in_numbers
from graphkin.structure.model import Coordinate
from graphkin.words import Phrase, listed, rich_text, say, word
from graphkin.words.symbols import RichText, Words, notation, plain, rate, sign, spaced, stretches

if TYPE_CHECKING:
    from graphkin.solver import Motion

STRAIGHT = 1e-9  # rad
ROUNDING = 1e-12  # of the size of the mechanism
ROUNDED = 1e-11  # of the longest arrow: a sum of arrows that is less is nothing but rounding
MORE = 9  # figures of what a root of 7 is worked out from


def size_name(arrow: LoopArrow) -> RichText:
    """The size of an arrow: ``l_AB``, or ``s_34`` of a travel."""
    if arrow.slide:
        return sign("s", arrow.slide.replace("/", ""))
    if not all(arrow.names):
        return sign("l", arrow.link)
    return sign("l", "".join(arrow.names), meaning=("length", " ".join(arrow.names)))


def equation(loop: Loop, convention: Convention) -> RichText:
    """The vector equation: ``AB + BC + CD + DA = 0``."""
    return spaced(" + ", (as_vector(convention, size_name(a)) for a in loop.arrows)) + " = 0"


def projections(loop: Loop, block: LoopBlock, scene: Mechanism) -> tuple[RichText, RichText]:
    """The sums of the arrows' components along x and y, in numbers and unknowns (scene units)."""
    return _projection(loop, block, scene, "cos"), _projection(loop, block, scene, "sin")


def _projection(loop: Loop, block: LoopBlock, scene: Mechanism, function: str) -> RichText:
    terms, known, metres = [], 0.0, scene.units.metres
    for arrow in loop.arrows:
        turns, slides = ("angle", loop.ties[arrow.link]) in block.unknowns, ("travel", arrow.slide) in block.unknowns
        part = arrow.vector.real if function == "cos" else arrow.vector.imag
        if not turns and not slides:
            known += part / metres
            continue
        size = "" if slides else f"{number(abs(arrow.coefficient) * arrow.travel / metres, 5)} "
        name = size_name(arrow) if slides else RichText()
        if turns:
            before, angle = _angle(arrow)
            terms.append((before, size + name + " " * slides + f"{function} " + angle))
        else:
            share = arrow.along.real if function == "cos" else arrow.along.imag
            if abs(share) > 1e-12:
                scale = "" if abs(abs(share) - 1.0) < 1e-12 else f"{number(abs(share), 5)} "
                terms.append(("−" if share < 0 else "+", scale + name))
    if abs(known) > ROUNDING * scene.size / metres or not terms:
        terms.append(("−" if known < 0 else "+", RichText(number(abs(known), 6))))
    (first, term), *others = terms
    lead = term if first == "+" else "−" + term
    return RichText(lead, *(f" {before} " + term for before, term in others), " = 0")


def _angle(arrow: LoopArrow) -> tuple[str, RichText]:
    """The angle of an arrow by that of its link, and the sign of its size."""
    offset, name = cmath.phase(arrow.coefficient), sign("θ", arrow.link)
    if abs(math.remainder(offset, math.tau)) < STRAIGHT:
        return "+", name
    if abs(math.remainder(offset - math.pi, math.tau)) < STRAIGHT:
        return "−", name
    degrees = math.degrees(offset)
    return "+", "(" + name + f" {'−' if degrees < 0 else '+'} {number(abs(degrees), 6)}°)"


def root(solution: Root, scene: Mechanism, language: str) -> RichText:
    """The closed-form root with the sign of its assembly."""
    kind, of = solution.unknown
    name = sign("θ", of) if kind == "angle" else sign("s", of.replace("/", ""))

    def shown(value: float, power: int, carried: int = MORE) -> str:
        rounded = abs(value) <= ROUNDING * scene.size**power
        return number(0.0 if rounded else value / scene.units.metres**power, carried)

    angle = solution.key == "loop root angle"
    powers = {"A": 2, "B": 2, "C": 2} if angle else {"middle": 1, "rest": 2}
    numbers = zip(powers.items(), solution.numbers, strict=False)
    gaps = {gap: shown(value, power) for (gap, power), value in numbers}
    gaps["sign"] = "+" if solution.sign >= 0 else "−"
    gaps["value"] = number(math.degrees(solution.value), 7) if angle else shown(solution.value, 1, 7)
    return rich_text(Phrase(solution.key, unknown=name, **gaps, unit=scene.units.length), language)


def _plain_name(unknown: Coordinate) -> str:
    return f"{'theta' if unknown[0] == 'angle' else 's'}_{unknown[1]}"


@dataclass(frozen=True, eq=False, repr=False)
class MatrixEquation:
    """A matrix times unknowns is a column; and the solution in words (scene units)."""

    key: str
    rows: tuple[tuple[str, ...], ...]
    unknowns: tuple[RichText, ...]
    right: tuple[str, ...]
    solution: tuple[RichText, ...]


def _in_units(block: LoopBlock, scene: Mechanism) -> LoopBlock:
    """The matrix, its right sides and the rates in the file's unit of length for rates."""
    fast = scene.units.rates.metres
    per = np.array([fast if kind == "travel" else 1.0 for kind, _ in block.unknowns])
    rates, second = (tuple((np.array(values) / per).tolist()) for values in (block.rates, block.second_rates))
    return replace(block, matrix=block.matrix * per / fast, velocity=block.velocity / fast,
                   acceleration=block.acceleration / fast, rates=rates, second_rates=second)


def matrices(block: LoopBlock, scene: Mechanism) -> Iterator[MatrixEquation]:
    """The velocity and the acceleration equation of loops that are solved together, with this position's numbers."""
    in_units = _in_units(block, scene)
    sizes = np.abs(in_units.matrix)
    seen = np.where(sizes < 1e-14 * sizes.max(initial=0.0), 0.0, in_units.matrix)  # without rounding
    rows = tuple(tuple(number(x, 6) for x in row) for row in seen.tolist())
    for key, right, values, letters in (
        ("loop velocities", in_units.velocity, in_units.rates, ("omega", "v")),
        ("loop accelerations", in_units.acceleration, in_units.second_rates, ("alpha", "a")),
    ):
        units = [scene.units.of(KINDS[letter].measure) for letter in letters]
        travels = [kind == "travel" for kind, _ in block.unknowns]
        indices = (name.replace("/", "") for _, name in block.unknowns)
        names = [(sign if t else rate)(letters[t], index) for t, index in zip(travels, indices, strict=True)]
        rows_of = zip(names, travels, values, strict=True)
        solution = [n + f" = {units[t].beside(number(x, 7))}" for n, t, x in rows_of]
        yield MatrixEquation(key, rows, tuple(names), tuple(number(x, 6) for x in right.tolist()), tuple(solution))


# for terminals and for papers

_IN_LATEX = {"θ": r"\theta", "ω": r"\omega", "α": r"\alpha", "−": "-", "·": r"\cdot ", "°": r"^{\circ}",
             "cos": r"\cos", "sin": r"\sin"}
_LOWERED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-", strict=True))
_SIGNS = str.maketrans({sign: command for sign, command in _IN_LATEX.items() if len(sign) == 1})


def as_latex(line: Words) -> str:
    """A line as LaTeX, all of it in mathematics."""
    return "".join(
        notation(part, _IN_LATEX) if not isinstance(part, str)
        else " ".join(_IN_LATEX.get(text) or _word_in_latex(text) for text in part.split(" "))
        for part in stretches(line)
    )


def _word_in_latex(text: str) -> str:
    written = ""
    for raised, signs in groupby(text, _LOWERED.__contains__):
        part = "".join(signs)
        written += f"^{{{''.join(_LOWERED[sign] for sign in part)}}}" if raised else part.translate(_SIGNS)
    return written


def matrix_lines(matrix: MatrixEquation) -> list[str]:
    """A matrix equation in lines for a terminal."""
    rows = matrix.rows
    wide = [max(map(len, column)) for column in zip(*rows, strict=True)]
    names, right_side = [*map(plain, matrix.unknowns)], matrix.right
    high, right = (max(map(len, column)) for column in (names, right_side))
    lines = []
    for k, row in enumerate(rows):
        cells = "  ".join(cell.rjust(w) for cell, w in zip(row, wide, strict=True))
        equals = "=" if k == (len(rows) - 1) // 2 else " "
        lines.append(f"  | {cells} |  | {names[k].ljust(high)} |  {equals}  | {right_side[k].rjust(right)} |")
    return lines


def matrix_latex(matrix: MatrixEquation) -> str:
    """A matrix equation as LaTeX."""
    rows = r" \\ ".join(" & ".join(map(as_latex, row)) for row in matrix.rows)
    names = r" \\ ".join(map(as_latex, matrix.unknowns))
    right = r" \\ ".join(map(as_latex, matrix.right))
    return " ".join(rf"\begin{{bmatrix}} {part} \end{{bmatrix}}" if part != "=" else "="
                    for part in (rows, names, "=", right))


# the loops of a position


@dataclass(frozen=True, eq=False, repr=False)
class LoopText:
    """The loops of a position; the command prints ``plain`` or ``latex``.  ``rolling`` tells that cams, gears or
    rolling contacts give rates that the loops alone leave open."""

    scene: Mechanism
    blocks: tuple[LoopBlock, ...]
    language: str = "en"
    convention: Convention = "chinese"
    rolling: bool = False

    @cached_property
    def data(self) -> list[dict[str, Json]]:
        """For programs: loops that are solved together, in scene units and radians; the matrix times the rates is the
        right side, rows are x and y of each loop in turn."""
        return [self._block(block) for block in self.blocks]

    def _block(self, block: LoopBlock) -> dict[str, Json]:
        metres, in_units = self.scene.units.metres, _in_units(block, self.scene)

        def plain(unknown: Coordinate, value: float) -> float:
            return value / metres if unknown[0] == "travel" else value

        loops = [
            {
                "name": loop.name, "links": list(loop.links), "points": list(loop.points),
                "arrows": [
                    {"link": a.link, "from": a.names[0], "to": a.names[1],
                     "vector": [a.vector.real / metres, a.vector.imag / metres],
                     **({"slide": a.slide, "travel": a.travel / metres} if a.slide else {})}
                    for a in loop.arrows
                ],
                "gap": abs(loop.gap) / metres,
                **({"root": {"of": _plain_name(loop.root.unknown), "sign": loop.root.sign,
                             "value": plain(loop.root.unknown, loop.root.value)}} if loop.root else {}),
            }
            for loop in block.loops
        ]
        return {
            "loops": loops, "unknowns": [*map(_plain_name, block.unknowns)],
            "values": [*map(plain, block.unknowns, block.values)], "matrix": in_units.matrix.tolist(),
            "velocity": in_units.velocity.tolist(), "rates": list(in_units.rates),
            "acceleration": in_units.acceleration.tolist(), "second_rates": list(in_units.second_rates),
        }

    @property
    def plain(self) -> str:
        """The loops as lines of text."""
        units = self.scene.units
        units_named = Phrase("explained unit", length=units.length, velocity=units.of("velocity").text)
        lines = [say(units_named, self.language), ""] if self.blocks else []
        for block in self.blocks:
            for loop in block.loops:
                sum_ = equation(loop, self.convention)
                head = Phrase("loop heading", loop=loop.name, links=listed(loop.links), equation=sum_)
                x, y = projections(loop, block, self.scene)
                lines += [say(head, self.language), f"  x: {plain(x)}", f"  y: {plain(y)}"]
                if loop.root is not None:
                    lines.append(f"  {plain(root(loop.root, self.scene, self.language))}")
                longest = max(abs(arrow.vector) for arrow in loop.arrows)
                if abs(loop.gap) <= ROUNDED * longest:
                    lines.append(f"  {word('loop closes', self.language)}")
                else:
                    gap = f"{abs(loop.gap) / self.scene.units.metres:.1e}"
                    lines.append(f"  {say(Phrase('loop gap', gap=gap, unit=self.scene.units.length), self.language)}")
            for matrix in matrices(block, self.scene):
                lines += [f"  {word(matrix.key, self.language)}", *matrix_lines(matrix)]
                lines.append("  " + ", ".join(map(plain, matrix.solution)))
            lines.append("")
        if self.rolling:
            lines.append(word("loops and rolling", self.language))
        return "\n".join(lines or [word("no loops", self.language)]).rstrip()

    @property
    def latex(self) -> str:
        """The loops as LaTeX, a formula a line."""
        lines: list[str] = []
        for block in self.blocks:
            for loop in block.loops:
                formulas = equation(loop, self.convention), *projections(loop, block, self.scene)
                lines += map(as_latex, formulas)
            lines += [matrix_latex(matrix) for matrix in matrices(block, self.scene)]
        return "\n".join(rf"\[ {line} \]" for line in lines)


def loops_text(motion: Motion, language: str, convention: Convention) -> LoopText:
    """The loops at the first solved position of a motion.

    Raises
    ------
    CallError : no position is solved, or a chosen loop joins two points that no link and no guide joins
    """
    if not motion.ok.any():
        raise CallError.of("loops", "no position is solved", why=motion.reasons[0])
    k = int(np.argmax(motion.ok))
    axes = {name: complex(pose.u[k]) for name, pose in motion.poses.items()}
    travels = {s.key: float(motion.slide(s.key)[0][k]) for s in motion.slides}
    travels = {key: value for key, value in travels.items() if math.isfinite(value)}
    blocks = loops_in_numbers(motion.structure, axes, travels)
    in_loops = {name for block in blocks for loop in block.loops for name in loop.links}
    structure = motion.structure
    rolling = any(not e.driver.given for e in structure.driven) or any(g.rolling for g in structure.larger_groups)
    left = any(not in_loops.issuperset(group.links) for group in structure.groups)
    return LoopText(motion.scene, blocks, language, convention, rolling and (left or not blocks))
