"""The formulas of a structure: every link and group by the values of the drivers.

Lengths and places are open in them, so that one program serves all mechanisms that differ in these only.
"""

from __future__ import annotations

from collections.abc import Container, Hashable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from decimal import Decimal

from graphkin.scene.model import Driver
from graphkin.scene.pairs import LawCam, Pair
from graphkin.solver.algebra.dyads import DyadSolution, Joints, PoseFormula, solve_dyad
from graphkin.solver.algebra.expressions import Code, ExpressionGraph, Name, Real, Vec, components
from graphkin.solver.algebra.pose import GIVEN, Pose
from graphkin.solver.drivers import meant_vector
from graphkin.structure import Body, Driven, Dyad, LargerGroup, RollingRelation, Structure, kept_with
from graphkin.structure.model import Coordinate

SPECIAL = (0.0, 1.0, -1.0)
"""Numbers with which formulas are shorter."""


class Program:
    """The formulas of all mechanisms of one form.

    poses : each link by its name, fields are formulas
    groups : the solution of each dyad, by its index among the elements
    """

    def __init__(self, structure: Structure, moving: Sequence[bool], open_: Container[Name] = ()) -> None:
        self.graph = ExpressionGraph()
        self.structure = structure
        self._moving = moving
        self._open = open_
        self._numbers = _numbers(structure)
        self.poses: dict[str, PoseFormula] = {structure.scene.frame.name: self.at_rest(0j, 1 + 0j)}
        self.groups: dict[int, DyadSolution[Vec, Real]] = {}
        for i, element in enumerate(structure.elements):
            self._add(i, element)
        self._codes: dict[Hashable, Code] = {}

    # numbers

    def at_rest(self, place: Vec | complex, direction: Vec | complex) -> PoseFormula:
        """Axes that do not move."""
        zero = self.graph.const(0)
        none = Vec(zero, zero)
        return Pose(none + place, none + direction, none, zero, none, zero)

    def number(self, *name: str) -> Vec:
        """A place or direction of the scene: ("point", link, point), ("turn", slide), ("through", slide), ("ratio",
        rolling link, "angle" or "travel", of link), ..."""
        z = self._numbers[name]
        return Vec(*(self._part(name, axis, x) for axis, x in (("x", z.real), ("y", z.imag))))

    def _part(self, name: Name, axis: str, value: float) -> Real:
        plain = value in SPECIAL and (*name, axis) not in self._open
        return self.graph.const(value) if plain else self.graph.param((*name, axis))

    def rest(self, pair: Pair, link: str) -> PoseFormula:
        """The joint's frame in the axes of one of its links."""
        if pair.turns:
            return self.at_rest(self.number("point", link, pair.point), 1 + 0j)
        if link == pair.a:
            return self.at_rest(0j, self.number("turn", pair.key).conjugate())
        return self.at_rest(self.number("through", pair.key), self.number("direction", pair.key))

    def guide(self, slide: Pair) -> PoseFormula:
        """The guide of a sliding pair in the world."""
        return self.poses[slide.b].fixed(self.number("through", slide.key), self.number("direction", slide.key))

    def _rates(self, driver: Driver) -> tuple[Real, Real]:
        k = self.structure.drivers.index(driver)
        second = self.graph.param(("second", k)) if self._moving[k] else self.graph.const(0)
        return self.graph.param(("rate", k)), second

    def turn(self, driver: Driver) -> PoseFormula:
        """The rotation that an angle driver gives."""
        k = self.structure.drivers.index(driver)
        rate, second = self._rates(driver)
        none = Vec(self.graph.const(0), self.graph.const(0))
        return Pose(none, Vec(self.graph.input(("cos", k)), self.graph.input(("sin", k))), none, rate, none, second)

    def travel(self, driver: Driver) -> tuple[Real, Real, Real]:
        """Value, rate and second rate of a slide driver."""
        k = self.structure.drivers.index(driver)
        return self.graph.input(("travel", k)), *self._rates(driver)

    def lift(self, cam: LawCam) -> tuple[Real | Vec, Real, Real]:
        """The place of a follower, and its derivatives by the angle of the cam."""
        parts = ("slope", "second", *(("cos", "sin") if cam.turns else ("travel",)))
        slope, second, *stands = (self.graph.input(("lift", cam.link, part)) for part in parts)
        return (Vec(*stands) if len(stands) == 2 else stands[0]), slope, second

    def rolled(self, rolled: RollingRelation) -> tuple[Real | Vec, Real, Real]:
        """The value of a rolling link, and its rates, from those of the links on which it rolls."""
        rate = second = self.graph.const(0)
        for coordinate, _ in rolled.factors:
            velocity, acceleration = self.rates_of(coordinate)
            factor = self.number("ratio", rolled.key, *coordinate).real
            rate, second = rate + factor * velocity, second + factor * acceleration
        if rolled.turns:
            stands: Real | Vec = Vec(*(self.graph.input(("rolled", rolled.key, part)) for part in ("cos", "sin")))
        else:
            stands = self.graph.input(("rolled", rolled.key, "travel"))
        return stands, rate, second

    def rates_of(self, coordinate: Coordinate) -> tuple[Real, Real]:
        """Rate and second rate of an angle or a travel."""
        kind, name = coordinate
        if kind == "angle":
            return self.poses[name].omega, self.poses[name].alpha
        slide = self.structure.slide(name)
        seen = self.guide(slide).inverse().of(self.poses[slide.a])
        return seen.v.real, seen.a.real

    # elements

    def _add(self, i: int, element: Driven | Dyad | LargerGroup) -> None:
        if isinstance(element, Driven):
            self.poses[element.link] = self._driven(element)
        elif isinstance(element, LargerGroup):
            for name in element.members:
                self.poses[name] = self._placed(name)
        else:
            first, second = map(self._shape, element.bodies)
            joints = self._joints(element, first, second)
            solved = self.groups[i] = solve_dyad(element.kind, joints, self.graph.input(("sign", i)))
            for base, shape in ((solved.first, first), (solved.second, second)):
                self.poses |= {link: base.of(pose) for link, pose in shape.items()}

    def _placed(self, name: str) -> PoseFormula:
        """A link of a larger group, whose pose is given."""
        def real(part: str, axis: str = "x") -> Real:
            return self.graph.input(("pose", name, part, axis))

        def vec(part: str) -> Vec:
            return Vec(real(part), real(part, "y"))

        return Pose(vec("z"), vec("u"), vec("v"), real("omega"), vec("a"), real("alpha"))

    def _driven(self, element: Driven) -> PoseFormula:
        """The pose of a link that a driver or a cam moves from known links: crank, driven slider, follower."""
        pair, link = element.pair, element.link
        base = pair.b if pair.a == link else pair.a
        mine, theirs = self.rest(pair, link), self.rest(pair, base)
        at, sense = self.poses[base].fixed(theirs.z, theirs.u), 1.0 if pair.a == link else -1.0
        stands: Real | Vec
        mover = element.driver
        if isinstance(mover, LawCam):
            stands, slope, by_angle = self.lift(mover)
            cam, sense = self.poses[mover.link], 1.0
            rate, second = slope * cam.omega, by_angle * (cam.omega * cam.omega) + slope * cam.alpha
        elif isinstance(mover, RollingRelation):
            stands, rate, second = self.rolled(mover)
        elif mover.turns:
            given = self.turn(mover)
            forward = mover.link == link
            to = mover.relative_to if forward else mover.link
            from_ = self.poses[self.structure.scene.frame.name if element.ahead else to]
            for step, forth in element.ahead:
                turn = self.turn(step) if isinstance(step, Driver) else (
                    self.rest(step, step.b).of(self.rest(step, step.a).inverse()))
                from_ = from_.of(turn if forth else turn.inverse())
            seen = from_.of(given if forward else given.inverse())
            stands, rate, second = seen.u, seen.omega, seen.alpha
        else:
            stands, rate, second = self.travel(mover)
        if isinstance(stands, Vec):
            return at.pinned(mine, stands, rate, second)
        return at.along(stands * sense, rate * sense, second * sense).of(mine.inverse())

    def _shape(self, body: Body) -> dict[str, PoseFormula]:
        """Every link of a body in the axes of its base."""
        shape = {body.links[0]: self.at_rest(0j, 1 + 0j)}
        for joint in body.joints:
            placed = shape[joint.a].of(self.rest(joint.pair, joint.a))
            if joint.driver.turns:
                given = self.turn(joint.driver)
                placed = placed.of(given if joint.sign > 0 else given.inverse())
            else:
                sense = 1.0 if joint.b == joint.pair.a else -1.0
                placed = placed.along(*(rate * sense for rate in self.travel(joint.driver)))
            shape[joint.b] = placed.of(self.rest(joint.pair, joint.b).inverse())
        return shape

    def _joints(
        self, dyad: Dyad, first: Mapping[str, PoseFormula], second: Mapping[str, PoseFormula]
    ) -> Joints[Vec, Real]:
        """The six joint frames of a dyad, from the shapes of its bodies."""

        def frame(pair: Pair, poses: Mapping[str, PoseFormula]) -> PoseFormula:
            """A pair on the link that has a pose."""
            link = pair.a if pair.a in poses else pair.b
            at = self.rest(pair, link)
            return poses[link].fixed(at.z, at.u)

        left, right = dyad.outer_first, dyad.outer_second
        return Joints(
            frame(left, self.poses), frame(left, first), frame(dyad.inner, first),
            frame(right, self.poses), frame(right, second), frame(dyad.inner, second),
            1.0 if right.a in second else -1.0, self.graph.param(("size",)),
        )

    # code

    def code(self, key: Hashable, asked: Sequence[Real | Vec], varying: frozenset[Name] = frozenset()) -> Code:
        """The code for some formulas, made once; for a vector both components.  ``varying`` are rates of drivers that
        change from position to position."""
        if (key, varying) not in self._codes:
            self._codes[key, varying] = Code(self.graph, [x for value in asked for x in components(value)], (), varying)
        return self._codes[key, varying]


def _numbers(structure: Structure) -> dict[Name, complex]:
    """Every place, direction and ratio that a structure gives, by name."""
    numbers: dict[Name, complex] = {}
    for name, link in structure.links.items():
        for point, z in link.points.items():
            numbers["point", name, point] = z
    for s in structure.slides:
        numbers["turn", s.key] = s.turn
        numbers["through", s.key] = s.guide.through
        numbers["direction", s.key] = s.guide.direction
    for element in structure.driven:
        if rolled := element.rolled:
            numbers |= {("ratio", rolled.key, *coordinate): complex(factor) for coordinate, factor in rolled.factors}
    return numbers


def _form(structure: Structure, open_: Container[Name]) -> Hashable:
    """The form of a program: elements, joints and drivers by name, and the numbers that are 0, 1 or -1."""
    drivers = tuple((d.key, *d.links, d.rolls) for d in structure.drivers)
    special = tuple(
        (*name, axis, x if x in SPECIAL and (*name, axis) not in open_ else None)
        for name, z in _numbers(structure).items()
        for axis, x in (("x", z.real), ("y", z.imag))
    )
    return structure.scene.frame.name, drivers, special, tuple(_element_form(e) for e in structure.elements)


def _element_form(element: Driven | Dyad | LargerGroup) -> Hashable:
    if isinstance(element, Driven):
        follows = tuple(c for c, _ in element.rolled.factors) if element.rolled else ()
        return element.link, _pair_form(element.pair), type(element.driver).__name__, element.driver.key, follows
    if isinstance(element, LargerGroup):
        return element.members
    bodies = [
        (b.links, tuple((_pair_form(w.pair), w.driver.key, w.a, w.b, w.sign) for w in b.joints)) for b in element.bodies
    ]
    pairs = (element.inner, element.outer_first, element.outer_second)
    return element.kind, *bodies, *(_pair_form(p) for p in pairs)


def _pair_form(pair: Pair) -> Hashable:
    return pair.key, pair.a, pair.b


@dataclass
class DimensionedProgram:
    """A program with the numbers of one mechanism."""

    program: Program
    structure: Structure
    _found: dict[Name, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        self._numbers = _numbers(self.structure)

    def params(self, names: Iterable[Name], drivers: Mapping[Name, float]) -> list[float]:
        """Numbers by their names, with the rates of the drivers and the greatest of their values."""
        numbers: list[float] = []
        for name in names:
            changing = drivers.get(name)
            if changing is None and name not in self._found:
                self._found[name] = self._fixed(name)
            numbers.append(self._found[name] if changing is None else changing)
        return numbers

    def _fixed(self, name: Name) -> float:
        if name[0] == "size":
            return self.structure.scene.size
        z = self._numbers[name[:-1]]
        return z.real if name[-1] == "x" else z.imag

    def decimal(self, name: Name) -> tuple[Decimal, Decimal]:
        """A number of the file as a decimal, and its error: 0 for a number written so in the file."""
        if name[0] == "size":
            return Decimal(self.structure.scene.size), Decimal(0)
        parts, known = self._meant(name[:-1])
        return parts[0 if name[-1] == "x" else 1], Decimal(0 if known else GIVEN * abs(self._numbers[name[:-1]]))

    @kept_with
    def _meant(self, name: Name) -> tuple[tuple[Decimal, Decimal], bool]:
        """The decimals written in the file for a place or direction, and whether they can be told."""
        return meant_vector(self._numbers[name], name[0] in ("turn", "direction"))


_PROGRAMS: dict[Hashable, Program] = {}
"""The latest programs by their form: mechanisms that differ in dimensions share one."""
MOST = 200


def program_of(
    structure: Structure, moving: tuple[bool, ...], open_: frozenset[Name] = frozenset()
) -> DimensionedProgram:
    """The program of a structure, made once for all of its form.

    Parameters
    ----------
    moving : for each driver whether it has a second rate
    open_ : numbers by name that stay open even if they are 0, 1 or -1
    """
    key = "program", moving, open_
    if key not in structure.kept:
        structure.kept[key] = DimensionedProgram(_program(structure, moving, open_), structure)
    known: DimensionedProgram = structure.kept[key]
    return known


def _program(structure: Structure, moving: tuple[bool, ...], open_: frozenset[Name]) -> Program:
    """The program of the form of a structure, made anew if it is none of the latest."""
    form = _form(structure, open_), moving
    program = _PROGRAMS.pop(form, None) or Program(structure, moving, open_)
    _PROGRAMS[form] = program
    while len(_PROGRAMS) > MOST:
        with suppress(RuntimeError, StopIteration):  # another thread may be at the same
            _PROGRAMS.pop(next(iter(_PROGRAMS)), None)
    return program
