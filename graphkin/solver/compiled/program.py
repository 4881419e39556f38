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
from graphkin.solver.drivers import meant, meant_direction
from graphkin.structure import Body, Driven, Dyad, LargerGroup, RollingRelation, Structure
from graphkin.structure.model import Coordinate

SPECIAL = (0.0, 1.0, -1.0)
"""Numbers with which formulas are shorter."""


class Program:
    """The formulas of all mechanisms of one form.

    poses : each link by its name, fields are formulas
    groups, joints : the solution of each dyad, and its joint frames, by its index among the elements
    """

    def __init__(self, structure: Structure, moving: Sequence[bool], open_: Container[Name] = ()) -> None:
        self.graph = ExpressionGraph()
        self.structure = structure
        self._moving = moving
        self._open = open_
        self._numbers = _numbers(structure)
        self.joints: dict[int, Joints[Vec, Real]] = {}
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
            one, two = self.rates_of(coordinate)
            factor = self.ratio(rolled, coordinate)
            rate, second = rate + factor * one, second + factor * two
        if rolled.turns:
            stands: Real | Vec = Vec(*(self.graph.input(("rolled", rolled.key, part)) for part in ("cos", "sin")))
        else:
            stands = self.graph.input(("rolled", rolled.key, "travel"))
        return stands, rate, second

    def ratio(self, rolled: RollingRelation, coordinate: Coordinate) -> Real:
        """The ratio of a rolling link's motion to one of the angles and travels that it follows."""
        return self.number("ratio", rolled.key, *coordinate).real

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
            self.poses[element.link] = driven(self, element, self.poses)
        elif isinstance(element, LargerGroup):
            for name in element.members:
                self.poses[name] = self._placed(name)
        else:
            rest = self.at_rest(0j, 1 + 0j)
            shapes = body_shape(self, element.first, rest), body_shape(self, element.second, rest)
            joints = dyad_joints(self, element, shapes, self.poses, self.graph.param(("size",)))
            self.joints[i] = joints
            solved = solve_dyad(element.kind, joints, self.graph.input(("sign", i)))
            self.groups[i] = solved
            self.poses.update(members(shapes[0], solved.first))
            self.poses.update(members(shapes[1], solved.second))

    def _placed(self, name: str) -> PoseFormula:
        """A link of a larger group, whose pose is given."""
        def real(part: str, axis: str = "x") -> Real:
            return self.graph.input(("pose", name, part, axis))

        def vec(part: str) -> Vec:
            return Vec(real(part), real(part, "y"))

        return Pose(vec("z"), vec("u"), vec("v"), real("omega"), vec("a"), real("alpha"))

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
    _written: dict[Name, tuple[tuple[Decimal, Decimal], bool]] = field(default_factory=dict)

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

    def _meant(self, name: Name) -> tuple[tuple[Decimal, Decimal], bool]:
        """The decimals written in the file for a place or direction, and whether they can be told."""
        if name not in self._written:
            z = self._numbers[name]
            if name[0] in ("turn", "direction"):
                self._written[name] = meant_direction(z)
            else:
                (x, known_x), (y, known_y) = meant(z.real), meant(z.imag)
                self._written[name] = (x, y), known_x and known_y
        return self._written[name]


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
    if key in structure.kept:
        known: DimensionedProgram = structure.kept[key]
        return known
    form = _form(structure, open_), moving
    program = _PROGRAMS.pop(form, None) or Program(structure, moving, open_)
    _PROGRAMS[form] = program
    while len(_PROGRAMS) > MOST:
        with suppress(RuntimeError, StopIteration):  # another thread may be at the same
            _PROGRAMS.pop(next(iter(_PROGRAMS)), None)
    dimensioned = structure.kept[key] = DimensionedProgram(program, structure)
    return dimensioned


def driven(program: Program, element: Driven, poses: Mapping[str, PoseFormula]) -> PoseFormula:
    """The pose of a link that a driver or a cam moves from known links: crank, driven slider, follower."""
    pair, link = element.pair, element.link
    base = pair.b if pair.a == link else pair.a
    mine, theirs = program.rest(pair, link), program.rest(pair, base)
    at = poses[base].fixed(theirs.z, theirs.u)
    if element.lifted is not None:
        stands, slope, by_angle = program.lift(element.lifted)
        cam = poses[element.lifted.link]
        rate, second = slope * cam.omega, by_angle * (cam.omega * cam.omega) + slope * cam.alpha
        if isinstance(stands, Vec):
            return at.pinned(mine, stands, rate, second)
        return at.along(stands, rate, second).of(mine.inverse())
    if element.rolled is not None:
        stands, rate, second = program.rolled(element.rolled)
        if isinstance(stands, Vec):
            return at.pinned(mine, stands, rate, second)
        sense = 1.0 if pair.a == link else -1.0
        return at.along(stands * sense, rate * sense, second * sense).of(mine.inverse())
    (driver,) = element.drivers
    if driver.turns:
        given = program.turn(driver)
        forward = driver.link == link
        to = driver.relative_to if forward else driver.link
        from_ = poses[program.structure.scene.frame.name if element.ahead else to]
        for step, forth in element.ahead:
            turn = program.turn(step) if isinstance(step, Driver) else (
                program.rest(step, step.b).of(program.rest(step, step.a).inverse()))
            from_ = from_.of(turn if forth else turn.inverse())
        seen = from_.of(given if forward else given.inverse())
        return at.pinned(mine, seen.u, seen.omega, seen.alpha)
    travel, rate, second = program.travel(driver)
    if pair.a == link:
        return at.along(travel, rate, second).of(mine.inverse())
    return at.along(-travel, -rate, -second).of(mine.inverse())


def body_shape(program: Program, body: Body, rest: PoseFormula) -> dict[str, PoseFormula]:
    """Every link of a body in the axes of its base; ``rest`` are axes that do not move."""
    shape = {body.links[0]: rest}
    for joint in body.joints:
        placed = shape[joint.a].of(program.rest(joint.pair, joint.a))
        if joint.driver.turns:
            given = program.turn(joint.driver)
            placed = placed.of(given if joint.sign > 0 else given.inverse())
        else:
            travel, rate, second = program.travel(joint.driver)
            if joint.b != joint.pair.a:
                travel, rate, second = -travel, -rate, -second
            placed = placed.along(travel, rate, second)
        shape[joint.b] = placed.of(program.rest(joint.pair, joint.b).inverse())
    return shape


def dyad_joints(
    program: Program, dyad: Dyad, shapes: tuple[dict[str, PoseFormula], dict[str, PoseFormula]],
    poses: Mapping[str, PoseFormula], size: Real,
) -> Joints[Vec, Real]:  # fmt: skip
    """The six joint frames of a dyad."""

    def inside(pair: Pair, shape: Mapping[str, PoseFormula]) -> tuple[PoseFormula, str]:
        link = pair.a if pair.a in shape else pair.b
        at = program.rest(pair, link)
        return shape[link].fixed(at.z, at.u), link

    def known(pair: Pair, link: str) -> PoseFormula:
        base = pair.b if link == pair.a else pair.a
        at = program.rest(pair, base)
        return poses[base].fixed(at.z, at.u)

    outer1, link1 = inside(dyad.outer_first, shapes[0])
    outer2, link2 = inside(dyad.outer_second, shapes[1])
    return Joints(
        known(dyad.outer_first, link1),
        outer1,
        inside(dyad.inner, shapes[0])[0],
        known(dyad.outer_second, link2),
        outer2,
        inside(dyad.inner, shapes[1])[0],
        1.0 if link2 == dyad.outer_second.a else -1.0,
        size,
    )


def members(shape: Mapping[str, PoseFormula], base: PoseFormula) -> dict[str, PoseFormula]:
    """The links of a body in the world, from the base's pose."""
    return {link: base.of(pose) for link, pose in shape.items()}
