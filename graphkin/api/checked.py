"""``graphkin check``: draw, measure, compare with the analytic solver."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from graphkin.api.arguments import (
    INSTRUMENTS,
    MOST_SEED,
    At,
    SceneLike,
    as_scene,
    asked_symbols,
    placed,
    value_at,
    whole_number,
)
from graphkin.api.reading_rows import ReadValue, reading_row, without_residues
from graphkin.api.results import OfScene, Result, named
from graphkin.checking.readings import read_off
from graphkin.checking.report import Compared, Report, compare, rounding_of
from graphkin.construction import EXACT, Cad, Instrument, Plan, Sheet, execute, pencil, plan
from graphkin.errors import CallError, Problem, Unsolvable, did_you_mean, unfit
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.symbol import Symbol
from graphkin.structure import Structure, part_of
from graphkin.structure.assembly import ChangePoint
from graphkin.words import Phrase, listed, say

if TYPE_CHECKING:
    from graphkin.checking.uncertainty import Advice
    from graphkin.construction.centres import Centres, Turning
    from graphkin.construction.forces import ForceSheet
    from graphkin.solver import Motion
    from graphkin.table import Table

__all__ = ["Checked", "asked_here", "check", "checked", "drawn_symbols", "hand_of", "solved_here", "with_elsewhere"]

_FORMS = {
    "symbol": "", "unit": "", "on_paper_mm": ".12g", "measured": ".12g", "exact": ".12g", "error": ".3g",
    "tolerance": ".3g", "direction_error_rad": ".3g", "ok": "", "uncertainty": ".3g",
}  # fmt: skip


@dataclass(frozen=True, repr=False, eq=False)
class Checked(OfScene, Result):
    """A drawing, its readings, and how they compare with the exact values.

    ``advice`` names the least certain reading of a drawing with finite tools, and what would help it; ``asked`` is
    what the drawing was limited to, empty where it was not; ``passed`` are the change points on the way to it;
    ``at_contacts`` is the same with sliding contacts drawn at the contact itself, where exact hands have drawn it so;
    ``over_turn`` are asked values of the whole turn that stand in no single position, as they are computed;
    ``forces`` are drawn by the same hands, None where there is neither mass nor load, or nothing of them is asked.
    """

    sheet: Sheet
    report: Report
    advice: Advice | None = None
    asked: tuple[Symbol, ...] = ()
    passed: tuple[ChangePoint, ...] = ()
    over_turn: Mapping[Symbol, float] = field(default_factory=dict)
    forces: ForceSheet | None = None
    at_contacts: Checked | None = None

    @property
    def mechanism(self) -> Mechanism:
        return self.sheet.scene

    @cached_property
    def part(self) -> Mechanism:
        """The scene as far as it leads to the asked."""
        return part_of(self.sheet.structure, self.asked)

    @property
    def ok(self) -> bool:
        """Whether the drawing is whole and every reading lies within its tolerance; readings that are not determined
        at this position count for nothing, and a drawing of such alone agrees with nothing."""
        return self.report.ok and self.complete and (self.at_contacts is None or self.at_contacts.ok)

    @property
    def complete(self) -> bool:
        """Whether all that is asked was drawn."""
        return not self.report.missing

    def __repr__(self) -> str:
        return (
            f"<Checked {self.mechanism.name}: {len(self.report.rows)} readings, "
            f"{sum(row.ok is False for row in self.report.rows)} out of tolerance>"
        )

    def __getitem__(self, name: str) -> ReadValue:
        """A reading by its symbol beside the exact value, in the file's units.  Raises CallError for one not drawn."""
        rows = {str(row.symbol): row for row in self.report.rows}
        return ReadValue.of(self.mechanism, named(rows, name, Phrase("no reading of this name")))

    @cached_property
    def table(self) -> Table:
        """The readings, in scene units."""
        from graphkin.table import Table

        units, rows = self.mechanism.units, []
        for row in self.report.rows:
            shown = reading_row(self.mechanism, without_residues(row), degrees=True)
            cells = {**shown, "unit": row.symbol.unit(units).text}
            rows.append([cells.get(key) for key in _FORMS])
        return Table.of(list(_FORMS), rows, list(_FORMS.values()))

    @property
    def tables(self) -> Mapping[str, Table]:
        return {"readings.csv": self.table}

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin check --json`` prints: scene units, readings with sign."""
        return {
            "instrument": self.report.instrument,
            "ok": self.ok,
            "scales": self.scales,
            "readings": [
                {**reading_row(self.mechanism, row), **self._by_centres(row), **self._by_lever(row),
                 **self._at_contact(row)} for row in self.report.rows
            ],
            **({"not_drawn": [str(symbol) for symbol in self.report.missing]} if self.report.missing else {}),
            **({"computed_over_turn": {str(s): self._plain(s, v) for s, v in self.over_turn.items()}}
               if self.over_turn else {}),
            **({"advice": say(self.advice.phrase())} if self.advice else {}),
            **self._construction,
        }

    def _plain(self, symbol: Symbol, value: float) -> float:
        """A value (SI) as in JSON."""
        return float(symbol.unit(self.mechanism.units, radians=True).of(value))

    @property
    def _construction(self) -> dict[str, Json]:
        """How groups larger than a dyad were drawn: one word for all of them, and each by itself."""
        groups, forces = self.sheet.groups, dict[str, Json]()
        if self.forces is not None:
            forces = {"forces": ["drawn system" if way == "drawn system" else "moments and polygon"
                                 for way in self.forces.ways if way != "driver"]}  # fmt: skip
        if not groups:
            return forces
        ways = ", ".join(dict.fromkeys(g.way for g in groups))
        rows = [{"links": list(g.group.links), "class": g.group.order, "construction": g.way} for g in groups]
        return {"construction": ways, "groups": rows, **forces}

    @property
    def scales(self) -> dict[str, float]:
        """What one mm on paper is: mm, and scene units per second and second squared."""
        scales, unit = self.report.scales, self.mechanism.units.rates.metres
        return {
            "length": _plain(scales.length * 1e3),
            "velocity": _plain(scales.velocity / unit),
            "acceleration": _plain(scales.acceleration / unit),
            **({"force": _plain(scales.force / self.mechanism.units.newtons)} if scales.force else {}),
        }

    @cached_property
    def centres(self) -> Centres:
        """The instant centres of what leads to the asked, from which velocities come by a third way."""
        from graphkin.construction.centres import centres_on

        return centres_on(self.sheet, self.asked)

    def _by_lever(self, row: Compared) -> dict[str, float]:
        """What balances by Zhukovsky's lever, in the scene's force unit."""
        if self.forces is None or row.symbol.scope != "force":
            return {}
        levers = self.forces.levers[-1 if row.symbol.plus else 0]
        for lever in levers:
            if lever.balance == replace(row.symbol, plus=False, at=""):
                found = 0.0 + (lever.value if lever.balance.kind == "M" else abs(lever.vector))
                return {"by_lever": self._plain(row.symbol, found)}
        return {}

    @cached_property
    def _turning(self) -> Mapping[str, Turning]:
        from graphkin.construction.centres import speeds

        return speeds(self.centres)

    def _at_contact(self, row: Compared) -> dict[str, Json]:
        """A reading of the drawing at the contacts, in scene units; of pins in straight slots it is this one."""
        other = self if self.at_contacts is None and self.mechanism.pins else self.at_contacts
        rows = {} if other is None else {r.symbol: r for r in other.report.rows}
        if row.symbol not in rows:
            return {}
        return {"at_contact": reading_row(self.mechanism, rows[row.symbol])["measured"]}

    def _by_centres(self, row: Compared) -> dict[str, float]:
        """A velocity by centres, in scene units; nothing for accelerations."""
        from graphkin.construction.centres import by_centres

        known = row.symbol.kind in ("v", "omega") and not row.symbol.at
        value = by_centres(self.centres, self._turning, row.symbol) if known else None
        if value is None:
            return {}
        plain = abs(value) if row.symbol.is_vector else float(value.real) + 0.0
        return {"by_centres": self._plain(row.symbol, plain)}


def _plain(value: float) -> float:
    """A scale factor without the noise of unit conversion."""
    return float(f"{value:.12g}")


def check(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    instrument: str = "exact",
    seed: int = 0,
) -> Checked:
    """Draw a scene, measure the drawing, and compare every reading with the analytic solver.

    Parameters
    ----------
    scene, at : as for `solve`
    find : what is asked, by name ("v_D", "omega_3"); the scene's own ``find`` if None; everything if that is empty
    instrument : "exact", "cad" (lengths read to 0.01 mm, angles to 0.01 degree) or "pencil" (the tools of the scene's
        ``[sheet.instrument]``); a finite one is judged by the uncertainty predicted from its construction
    seed : of the pencil; the same seed draws the same sheet

    Raises
    ------
    SceneError, CallError : the file or the call is wrong
    Unsolvable : wrong mobility, a position that cannot be assembled or reached, a dead point

    Examples
    --------
    >>> result = check("sixbar-guide-40deg")
    >>> result.ok, round(result["v_B@3"].on_paper, 3)
    (True, 107.578)
    """
    from graphkin import solver

    given = as_scene(scene)
    asked = drawn_symbols(given, find)
    given, values = placed(given, at)
    hand = hand_of(given, instrument, seed)
    structure = solver.structure_of(given)
    motion = solved_here(structure, values, asked_here(asked))
    made = checked(plan(structure, values, asked_here(asked)), motion, hand)
    return with_elsewhere(made, asked, seed)


def checked(what: Plan, motion: Motion, hand: Instrument) -> Checked:
    """Draw a plan and hold everything on it against the solver at the same position; sliding contacts at the contact
    itself too, by the same hands on another sheet."""
    other, again = what.at_contacts(), hand if hand is EXACT else deepcopy(hand)
    made = _checked(what, motion, hand)
    return made if other is None else replace(made, at_contacts=_checked(other, motion, again))


def _checked(what: Plan, motion: Motion, hand: Instrument) -> Checked:
    from graphkin.solver import as_drawn, exact_values

    passed, motion = motion.passed, as_drawn(motion, what.structure)
    value = exact_values(motion, what.asked)
    sheet = execute(what, hand)
    scale, lost, forces = 0.0, 0.0, None
    if sheet.has_forces:
        from graphkin.construction.forces import forces_on
        from graphkin.solver.values import force_values

        of_motion = value
        of_force, lost = force_values(motion)
        forces = forces_on(sheet, hand)
        scale = forces.per_mm

        def value(symbol: Symbol) -> complex | float:
            return of_force(symbol) if symbol.scope == "force" else of_motion(symbol)

    turning = {s: float(value(s).real) for s in what.asked if s.scope == "cycle"}
    readings = read_off(sheet, (), hand, forces)
    rounding = rounding_of(motion, lost)
    if hand is EXACT:
        report = compare(sheet, readings, value, what.asked, rounding=rounding, force_scale=scale)
        return Checked(sheet, report, None, what.asked, passed, turning, forces)
    from graphkin.checking.uncertainty import advise, predict

    tools = what.structure.scene.question.sheet.tools
    predicted = predict(what, hand.name, tools)
    advice = advise(what, hand.name, tools, readings, predicted)
    report = compare(sheet, readings, value, what.asked, predicted, rounding, scale)
    return Checked(sheet, report, advice, what.asked, passed, turning, forces)


def drawn_symbols(scene: Mechanism, find: Iterable[str | Symbol] | None) -> tuple[Symbol, ...]:
    """What is asked, or is the scene's own wish; of a scene with masses and loads forces are drawn then too."""
    asked = asked_symbols(scene, find)
    if find is not None or not asked or not scene.loading or any(s.scope == "force" for s in asked):
        return asked
    loading = scene.loading
    forces = [Symbol("Fi", link=mass.link) for mass in loading.masses]
    forces += [Symbol("P", name=load.name, turning=not load.is_force) for load in loading.loads]
    forces += [Symbol("P", name=spring.name) for spring in loading.springs]
    return (*asked, *forces)


def asked_here(asked: Sequence[Symbol]) -> tuple[Symbol, ...]:
    """What is asked of the position itself; where all is asked of others, the same quantities here."""
    return tuple(s for s in asked if not s.at) or tuple(dict.fromkeys(s.here for s in asked))


def with_elsewhere(made: Checked, asked: Sequence[Symbol], seed: int = 0) -> Checked:
    """A check with what is asked of other positions ("v_C at 10"), each drawn by the same hands at the same scales.

    Raises
    ------
    Unsolvable : a position that cannot be assembled or reached, or that lies on a stroke without a whole turn
    """
    names = dict.fromkeys(s.at for s in asked if s.at)
    if not names:
        return made
    structure, scene = made.sheet.structure, made.mechanism
    rows: list[Compared] = list(made.report.rows) if any(not s.at for s in asked) else []
    missing: list[Symbol] = [s for s in made.report.missing if any(not a.at for a in asked)]
    for name in names:
        wanted = tuple(s.here for s in asked if s.at == name)
        values = {**made.sheet.drivers, scene.drivers[0].key: value_at(scene, name)}
        what = replace(plan(structure, values, wanted), scales=made.sheet.scales)
        hand = hand_of(scene, made.sheet.instrument, seed)
        there = checked(what, solved_here(structure, values, wanted), hand).report
        kept = [row for row in there.rows if row.symbol in wanted]
        rows += [replace(row, reading=replace(row.reading, symbol=replace(row.symbol, at=name))) for row in kept]
        missing += [replace(s, at=name) for s in there.missing]
    return replace(made, report=replace(made.report, rows=tuple(rows), missing=tuple(missing)))


def hand_of(scene: Mechanism, name: str, seed: int) -> Instrument:
    """The instrument of a name.  Raises CallError for another name."""
    if not isinstance(name, str):
        raise unfit("instrument", name, Phrase("known here", names=", ".join(INSTRUMENTS)))
    if name == "exact":
        return EXACT
    if name == "cad":
        return Cad()
    if name == "pencil":
        return pencil(scene.question.sheet.tools, whole_number("seed", seed, -MOST_SEED, MOST_SEED))
    raise CallError(Problem("instrument", f'"{name}"', did_you_mean(str(name), INSTRUMENTS)))


def solved_here(
    of: Mechanism | Structure, values: Mapping[str, float] | None, asked: Sequence[Symbol] = ()
) -> Motion:
    """The exact motion at one position, of what leads to the asked.

    It comes before the drawing, because it tells best why a position cannot be had.
    """
    from graphkin import solver

    structure = solver.structure_of(of)
    scene = part_of(structure, asked)
    if scene is not structure.scene:
        structure = solver.structure_of(scene)
        kept = [d.key for d in scene.drivers]
        values = {k: v for k, v in values.items() if k in kept} if values else values
    motion = solver.solve(structure, at=values)
    if motion.status[0] != "ok":
        drivers = [
            Phrase("driver at value", driver=d.key, value=scene.unit_of(d).said((values or {}).get(d.key, d.values[0])))
            for d in scene.drivers
        ]
        raise Unsolvable(
            str(motion.status[0]), Problem(Phrase("driver of driver", driver=listed(drivers)), motion.said(0))
        )
    return motion
