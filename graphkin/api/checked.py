"""``graphkin check``: draw, measure, compare with the analytic solver."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from graphkin import solver
from graphkin.api.arguments import (
    At,
    as_scene,
    asked_symbols,
    drawn_symbols,
    hand_of,
    in_convention,
    placed,
    value_at,
)
from graphkin.api.results import OfScene, Result, named
from graphkin.checking.readings import report_on
from graphkin.checking.report import Compared, ReadValue, Report, reading_row, without_residues
from graphkin.construction import EXACT, Instrument, Plan, Sheet, execute, plan, plan_with_forces
from graphkin.errors import Problem, Unsolvable
from graphkin.files import Json
from graphkin.scene.model import Mechanism
from graphkin.scene.scene import SceneLike
from graphkin.scene.symbol import Symbol, asked_here
from graphkin.solver import Motion
from graphkin.solver.values import as_drawn, exact_values, forces_here
from graphkin.structure import part_of
from graphkin.structure.assembly import ChangePoint
from graphkin.table import Table
from graphkin.words import Phrase, listed, say

if TYPE_CHECKING:
    from graphkin.construction.centres import Centres

_FORMS = {
    "symbol": "", "unit": "", "on_paper_mm": ".12g", "measured": ".12g", "exact": ".12g", "error": ".3g",
    "tolerance": ".3g", "direction_error_rad": ".3g", "ok": "", "uncertainty": ".3g",
}


@dataclass(frozen=True, repr=False, eq=False)
class Checked(OfScene, Result):
    """A drawing, its readings, and their comparison with the exact values.

    ``advice`` is a sentence on the least certain reading of a drawing with finite tools, and its remedy; ``passed`` are
    the change points on the path to it; ``at_contacts`` is the drawing with sliding contacts drawn at the contact
    itself, if exact hands have drawn it so; ``over_turn`` are asked values of the whole turn that belong to no single
    position, as they are computed.
    """

    table_file = "readings.csv"

    report: Report
    advice: Phrase | None = None
    passed: tuple[ChangePoint, ...] = ()
    over_turn: Mapping[Symbol, float] = field(default_factory=dict)
    at_contacts: Checked | None = None

    @property
    def sheet(self) -> Sheet:
        return self.report.sheet

    @property
    def mechanism(self) -> Mechanism:
        return self.sheet.scene

    @cached_property
    def part(self) -> Mechanism:
        """The part of the scene that leads to the asked quantities."""
        return part_of(self.sheet.structure, self.sheet.asked)

    @property
    def ok(self) -> bool:
        """Whether the drawing is whole and every reading lies within its tolerance; readings that are not determined
        at this position do not count, and a drawing of such readings alone is not ok."""
        return self.complete and self.report.ok and (self.at_contacts is None or self.at_contacts.ok)

    @property
    def complete(self) -> bool:
        """Whether all asked quantities were drawn."""
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
        units, rows = self.mechanism.units, []
        for row in self.report.rows:
            shown = reading_row(self.mechanism, without_residues(row), degrees=True)
            cells = {**shown, "unit": row.symbol.unit(units).text}
            rows.append([cells.get(key) for key in _FORMS])
        return Table.of(list(_FORMS), rows, list(_FORMS.values()))

    @cached_property
    def data(self) -> dict[str, Json]:
        """The object that ``graphkin check --json`` prints: scene units, readings with sign."""
        scene, construction, rows = self.mechanism, self._construction, []
        ok, scales, others = self.ok, self.scales, self._by_other_ways
        for row in self.report.rows:
            unit = row.symbol.unit(scene.units, radians=True)
            methods = {m: float(unit.of(values[row.symbol])) for m, values in others.items() if row.symbol in values}
            per_mm, own_scale = row.reading.per_mm, dict[str, Json]()
            if row.reading.diagram == "force" and per_mm not in (0.0, self.sheet.scales.force):
                own_scale = {"scale": float(f"{unit.of(per_mm):.12g}")}
            rows.append({**reading_row(scene, row), **own_scale, **methods})
        return {
            "instrument": self.sheet.instrument,
            "ok": ok,
            "scales": scales,
            "readings": rows,
            **({"not_drawn": [str(symbol) for symbol in self.report.missing]} if self.report.missing else {}),
            **({"computed_over_turn": {
                str(s): float(s.unit(scene.units, radians=True).of(v)) for s, v in self.over_turn.items()
            }} if self.over_turn else {}),
            **({"advice": say(self.advice)} if self.advice else {}),
            **({"forces": None, "why": str(self.sheet.without_forces)} if self.sheet.without_forces else {}),
            **construction,
        }

    @property
    def _construction(self) -> dict[str, Json]:
        """The construction of groups larger than a dyad: a word for all of them, and each by itself."""
        groups, forces = self.sheet.groups, dict[str, Json]()
        for state in self.sheet.forces[:1]:
            forces = {"forces": ["drawn system" if method == "drawn system" else "moments and polygon"
                                 for method in dict.fromkeys(group.way for group in state.groups)
                                 if method != "driver"]}
        if not groups:
            return forces
        methods = ", ".join(dict.fromkeys(groups.values()))
        rows = [{"links": list(g.links), "class": g.order, "construction": method} for g, method in groups.items()]
        return {"construction": methods, "groups": rows, **forces}

    @property
    def scales(self) -> dict[str, float]:
        """The scales, the value of one mm on paper, as `Scales.shown`."""
        units = self.mechanism.units
        return self.sheet.scales.shown(units.rates.metres, units.newtons)

    @cached_property
    def centres(self) -> Centres:
        """The instant centres of the part that leads to the asked quantities, which give velocities in a third way."""
        from graphkin.construction.centres import centres_on

        return centres_on(self.sheet, self.sheet.asked)

    @property
    def _by_other_ways(self) -> Mapping[str, Mapping[Symbol, float]]:
        """The readings by other methods: by instant centres (velocities), by Zhukovsky's lever (the balancing
        load), and on the drawing at the contacts, which is this drawing where pins slide in straight slots; sizes of
        vectors, SI.
        """
        sheet, symbols = self.sheet, [row.reading.symbol for row in self.report.rows]
        velocities = {
            s: self.centres.velocity(s) for s in symbols if s.kind in ("v", "omega") and not s.at
        }
        methods = {"by_centres": {s: abs(v) if s.kind == "v" else v.real + 0.0
                                  for s, v in velocities.items() if v is not None}}
        states = sheet.forces
        for symbol in symbols if states else ():
            balance = replace(symbol, plus=False, at="")
            for lever in states[-1 if symbol.plus else 0].levers:
                if lever.unknown.symbol == balance:
                    size = lever.value if balance.kind == "M" else abs(lever.value)
                    methods.setdefault("by_lever", {}).setdefault(symbol, 0.0 + size)
        slotted = any(pair.higher for pair in sheet.scene.slides)
        other = self if self.at_contacts is None and slotted else self.at_contacts
        if other is not None:
            methods["at_contact"] = {
                r.symbol: abs(r.measured) if r.symbol.is_vector else r.measured.real for r in other.report.rows
            }
        return methods


def check(
    scene: SceneLike,
    *,
    at: At = None,
    find: Iterable[str | Symbol] | None = None,
    convention: str | None = None,
    instrument: str = "exact",
    seed: int = 0,
) -> Checked:
    """Draw a scene, measure the drawing, and compare every reading with the analytic solver.

    Parameters
    ----------
    scene, at : as for `solve`
    find : the asked quantities by name ("v_D", "omega_3"); the scene's own ``find`` if None; all if that is empty
    convention : of the letters of its report: "chinese", "us", "british" or "russian"; the scene's own if None
    instrument : "exact", "cad" (lengths read to 0.01 mm, angles to 0.01 degree) or "pencil" (the tools of the scene's
        ``[sheet.instrument]``); a finite instrument is judged by the uncertainty predicted from the construction
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
    given = in_convention(as_scene(scene), convention)
    asked, by_name = drawn_symbols(given, find), asked_symbols(given, find)
    given, values = placed(given, at)
    hand, here = hand_of(given.question.sheet, instrument, seed), asked_here(asked)
    structure = solver.structure_of(given)
    motion = solver.solved_here(structure, values, here)
    planned = plan_with_forces(structure, values, here, by_name)
    return with_elsewhere(settled(checked(planned, motion, hand), hand), asked, seed)


def settled(made: Checked, hand: Instrument) -> Checked:
    """A check that settles something.  Raises Unsolvable: so near a dead point that nothing can be judged."""
    if not made.report.settles_nothing:
        return made
    scene = made.sheet.scene
    values = made.sheet.drivers
    drivers = [Phrase("driver at value", driver=d.key, value=scene.unit_of(d).said(values.get(d.key, d.values[0])))
               for d in scene.drivers]
    wanted = "move the driver off this position" if hand is EXACT else "draw exactly with another seed or"
    raise Unsolvable("dead point", Problem(Phrase("driver of driver", driver=listed(drivers)),
                                           "so near a dead point nothing is determined", wanted))


def checked(planned: Plan, motion: Motion, hand: Instrument, at_contacts: bool = True) -> Checked:
    """Draw a plan and compare all its readings with the solver at the same position; sliding contacts also at the
    contact itself, by the same hands on another sheet."""
    if planned.has_forces and hand is not EXACT:  # before hands draw them: it tells best why there are none
        forces_here(as_drawn(motion, planned.structure))
    other, other_hand = planned.at_contacts() if at_contacts else None, hand if hand is EXACT else deepcopy(hand)
    sheet = execute(planned, hand)
    if hand is EXACT:
        report, advice = report_on(sheet, motion), None
    else:
        from graphkin.checking.uncertainty import advise, predict

        tools = sheet.scene.question.sheet.tools
        predicted = predict(planned, hand.name, tools)
        report = report_on(sheet, motion, hand, predicted)
        advice = advise(planned, hand.name, tools, [row.reading for row in report.rows], predicted)
    of_cycle = [symbol for symbol in sheet.asked if symbol.scope == "cycle"]
    over_turn = {s: float(value.real) for s, value in exact_values(motion, of_cycle).items()} if of_cycle else {}
    there = None if other is None else checked(other, motion, other_hand, at_contacts=False)
    return Checked(report, advice, motion.passed, over_turn, there)


def with_elsewhere(made: Checked, asked: Sequence[Symbol], seed: int = 0) -> Checked:
    """A check with the quantities asked of other positions ("v_C at 10"), drawn by the same hands at the same scales.

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
        planned = replace(plan(structure, values, wanted), scales=made.sheet.scales)
        hand = hand_of(scene.question.sheet, made.sheet.instrument, seed)
        there = checked(planned, solver.solved_here(structure, values, wanted), hand).report
        kept = [row for row in there.rows if row.symbol in wanted]
        rows += [replace(row, reading=replace(row.reading, symbol=replace(row.symbol, at=name))) for row in kept]
        missing += [replace(s, at=name) for s in there.missing]
    return replace(made, report=replace(made.report, rows=tuple(rows), missing=tuple(missing)))
