"""The check of instant centres: each centre and each velocity taken through them beside the analytic solver's."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from graphkin.checking.report import Known, in_unit
from graphkin.construction.board.projective import normal, wedge
from graphkin.construction.centres import Centre, Centres, LinkPair
from graphkin.errors import Disagreement, Problem
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import PointRef, Symbol, Value
from graphkin.solver import Motion
from graphkin.solver.quantities import pole
from graphkin.solver.values import as_drawn
from graphkin.words import Phrase, say

NO_MOTION = 1e-9
TOLERANCE = 1e-9
ON_PAPER = 1e-5  # rad: 0.001 mm at 100 mm, which no paper shows; far from a drawing that is wrong
FAIR = 1e-3  # of the largest: a value that may be off by more is not determined by the centres
SAFETY = 4.0  # the bound of a centre, or of a velocity by centres, over its error of first order


@dataclass(frozen=True, repr=False)
class SpeedByCentres(Known):
    """A velocity or an angular velocity by instant centres beside the exact one (SI, or in the file's units).

    ``tolerance`` is their allowed difference: 1e-9 of the largest velocity of the mechanism (of the largest rate, or
    that velocity over the size), or the rounding error of the centres and the position where it is larger.  Where it
    exceeds a thousandth of the largest, or where centres are missing, they do not determine the value: ``ok`` is None,
    and ``by_centres`` is None where they give no value at all.  ``chain`` are the centres used.
    """

    values: ClassVar = ("by_centres", "exact")
    by_centres: Value | None
    exact: Value
    chain: tuple[str, ...]
    tolerance: float
    largest: float
    ok: bool | None

    def in_units(self, scene: Mechanism) -> SpeedByCentres:
        """This value (SI) in the units of its scene, 0 where it is rounding alone."""
        unit, floor = self.symbol.unit(scene.units), 0.0 if self.ok is None else self.tolerance
        values = [None if v is None else in_unit(unit, complex(v) if self.symbol.is_vector else float(v.real), floor)
                  for v in (self.by_centres, self.exact)]
        assert values[1] is not None
        return replace(self, unit=unit.text, by_centres=values[0], exact=values[1], tolerance=unit.of(self.tolerance))

    def too_near(self, language: str) -> str:
        """The sentence for a value that the centres do not determine."""
        return say(Phrase("centres too near", symbol=str(self.symbol)), language)


def velocities_by_centres(centres: Centres, motion: Motion) -> tuple[SpeedByCentres, ...]:
    """Velocities (SI) measured through centres beside the exact ones: the asked ones, or all."""
    scene, size = centres.scene, centres.scene.size
    moving = [name for name in centres.names if name != scene.frame.name]
    every = [*(Symbol("omega", link=name) for name in moving), *centres.moving_pins]
    symbols = [s for s in scene.question.find if s.kind in ("v", "omega")] if scene.question.find else every
    # what is asked may be nought beside the rest: it is judged by the whole mechanism
    exact = {s: complex(motion.value(s)[0]) for s in dict.fromkeys((*symbols, *every))}
    largest = {kind: max((abs(x) for s, x in exact.items() if s.kind == kind), default=0.0) for kind in ("v", "omega")}
    largest["omega"] = max(largest["omega"], largest["v"] / size)
    speeds = []
    for symbol in symbols:
        value = centres.velocity(symbol)
        wanted = exact[symbol] if symbol.is_vector else exact[symbol].real
        chain: tuple[str, ...] = ()
        tolerance, most, ok = math.inf, largest[symbol.kind], None
        if value is not None:
            of = centres.turning_of(symbol.of or PointRef("", symbol.link))
            chain = () if of is None else of.chain
            most = max(most, 1e-300)
            rounded = float(motion.rates_in_double[0][0]) / (1.0 if symbol.is_vector else size)
            tolerance = max(TOLERANCE * most, rounded, SAFETY * centres.velocity_error(symbol))
            ok = None if tolerance > FAIR * most else abs(value - wanted) <= tolerance
        speeds.append(SpeedByCentres(symbol, "", value, wanted, chain, tolerance, most, ok))
    return tuple(speeds)


def centre_errors(centres: Centres, motion: Motion) -> dict[LinkPair, tuple[float, float] | None]:
    """For each centre its distance from the exact centre, and the allowed distance.

    Both are angles (rad) seen from the middle of the mechanism at half its size, so that far centres are judged by
    their direction.  None for a centre without a place, and for two links that move too little relative to each other.
    """
    frame = centres.scene.frame.name
    largest = max(_exact_centre(centres, motion, (name, frame))[1] for name in centres.names)
    return {pair: _error(centres, motion, centre, largest) for pair, centre in centres.table.items()}


def must_agree(centres: Centres, motion: Motion) -> None:
    """Raises Disagreement, naming every centre that is out of its allowed distance and would be seen to be."""
    errors = centre_errors(centres, as_drawn(motion.growing, centres.sheet.structure))
    off = {pair: error for pair, error in errors.items() if error and error[0] > max(error[1], ON_PAPER)}
    said = "no paper is written please report this scene"
    problems = [Problem(f"P{''.join(pair)}", "lies off its computed place", said, angle=f"{math.degrees(sine):.3g}")
                for pair, (sine, _) in off.items()]
    if problems:
        raise Disagreement(*problems)


def _exact_centre(centres: Centres, motion: Motion, pair: LinkPair) -> tuple[tuple[float, float, float], float]:
    """The exact centre of two links in homogeneous coordinates of the chart, and the strength of their relative motion,
    which is their length."""
    q, omega = pole(*(motion.poses[link] for link in pair))
    chart, turn = centres.chart, float(omega[0])
    away = (complex(q[0]) * centres.mm - turn * chart.middle) / chart.unit
    return (away.real, away.imag, turn), math.hypot(abs(away), turn)


def _error(centres: Centres, motion: Motion, centre: Centre, largest: float) -> tuple[float, float] | None:
    """The distance of a drawn centre from the exact one on the unit sphere, and the allowed distance; None where the
    relative motion is too small beside the largest motion of a link."""
    if centre.place is None:
        return None
    place, strength = _exact_centre(centres, motion, centre.pair)
    if strength <= NO_MOTION * largest:
        return None
    _, sine = wedge(normal(place), normal(centre.place))
    # what rounding does to both grows as the relative motion gets small beside the motions themselves
    unit = centres.chart.unit / centres.mm
    rounded = float(motion.bound.position[0]) / unit + float(motion.rates_in_double[0][0]) / (unit * strength)
    # as do the numbers of the file, where they lie far apart
    given = TOLERANCE + 1e-14 * largest / strength
    return sine, given + SAFETY * centre.error + (rounded if math.isfinite(rounded) else 0.0)
