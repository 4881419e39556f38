"""The parts of the elements in the polygons: driven links, dyads, larger groups.

Of a larger group contours of known shape come first, then special points or trial polygons.  Whatever the rest of a
group does, links that drivers inside it hold to each other move as one link for the moment, except for the drivers'
given motions.  These motions, seen with one link of such a contour held still, are drawn first; points of the others
are then points of the held link with a known vector added (Coriolis included), and the group is drawn as if the contour
were one link.  A point's velocity, seen from the held link, is its velocity relative to the coincident point of that
link; other vectors have the link's name.

All vectors are linear in the assumed rates: with k unknown rates it takes k + 1 polygons, whose gaps are divided
proportionally (method of superposition: Hain, Applied Kinematics; Artobolevsky, Theory of mechanisms).
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import chain, product
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from graphkin.construction.board.proportional_division import divide, magnified
from graphkin.construction.board.sheet import Board, Rate
from graphkin.construction.board.steps import (
    Bar,
    Direction,
    FarPoint,
    Mark,
    Order,
    Step,
    Term,
    Vector,
    changed,
)
from graphkin.construction.polygons.equations import (
    add_rates,
    draw_equation,
    known_turns,
    parts_of,
    same_turn,
    share_rate,
    spread,
    turn_about,
    turned,
)
from graphkin.construction.polygons.polygons import RATE, Polygons, letter
from graphkin.construction.polygons.vector_graph import (
    RelativeMotion,
    VectorChain,
    VectorGraph,
    contacts_of,
    links_alike,
    node,
    past,
)
from graphkin.construction.position.links_on_paper import stuck
from graphkin.errors import Unsolvable
from graphkin.plane import added_up, dot, unit
from graphkin.scene.model import Driver
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.structure import Driven, DrivenJoint, Dyad, Element, LargerGroup, driver_pair
from graphkin.words import links_named
from graphkin.words.written import LONGEST, MOST

if TYPE_CHECKING:
    from graphkin.construction.polygons.group_plan import GroupPlan

LETTERS = tuple("SQTUVWXYZ") + tuple(f"S{i}" for i in range(1, 30))  # of special points
MOST_WAYS = 12  # choices of held links that are tried
MUCH_BETTER = 2.0  # so many times as well must another plan find the rates
NAUGHT = 1e-9  # part of the largest vector that an end that meets may be off in a trial polygon
NEARER = (0.25, 0.2, 0.15, 0.1, 0.07, 0.05, 0.03, 0.02, 0.01, 0.005)  # of a rate, by which it is assumed off
SLOW = 1.2  # so many times these, of the driver's rate, where the true one is nearly naught
ALIKE = 1e-9  # of unit motions: what differs less moves alike
Joint = tuple[tuple[str, str], complex, complex | None, bool]
"""What joins two links: a hinge in a place, or along a direction a sliding pair; and whether a driver gives how they
turn or slide on each other."""
BEYOND = 0.08  # of the size of the true polygon, by which a trial polygon may reach beyond it


def draw_element(plot: Polygons, order: Order, element: Element) -> None:
    """Draw a driven link, a dyad or a larger group in a polygon."""
    if isinstance(element, Driven):
        _driven(plot, order, element)
    elif isinstance(element, Dyad):
        if element not in plot.chains:
            chain = _graph_of(plot, element).equation(plot.ends["velocity"])
            if chain is None:
                # every dyad has an equation with two unknowns, but its points must be apart on the sheet
                raise stuck("not drawn", element.named, "points of theirs fall together on any sheet")
            plot.chains[element] = chain
        known_turns(plot, order, element)
        draw_equation(plot, order, element, plot.chains[element])
    else:
        _draw_group(plot, order, element)
    for name in element.members:
        plot.complete(order, name)


def _driven(plot: Polygons, order: Order, element: Driven) -> None:
    """Draw a driven link: its rate, given or read from a train's plan, with its points about the hinge; or the given
    motion along its guide."""
    name, driver, pair = element.link, element.driver, element.pair
    mm = _roll(plot, order, element) if driver.rolls else 0.0
    rate = plot.given[order, driver.key]
    if isinstance(driver, Driver) and driver.turns:
        other, sign = (driver.relative_to, 1) if driver.link == name else (driver.link, -1)
        base = added_up(plot.given[order, step.key] * (1 if forth else -1)
                        for step, forth in element.ahead if isinstance(step, Driver)
                        ) if element.ahead else plot.rates[order][other].value
        plot.rates[order][name] = Rate(name, base + sign * rate, mm=mm, plan=driver.rolls)
        if base or rate:
            add_rates(plot, order, name, (other, driver.link), base, rate)
    elif pair.turns:
        plot.rates[order][name] = Rate(name, rate, mm=mm, plan=driver.rolls)
    if pair.turns and name in plot.rates[order]:
        turn_about(plot, order, element, name, pair.point)
        return
    known = pair.b if name == pair.a else pair.a
    share_rate(plot, order, known, name)
    point = pair.pin or next(iter([*plot.links[name].points, *plot.places]), "")
    if point:
        a, b = node(plot.links, point, pair.a), node(plot.links, point, pair.b)
        labels, written = (PointRef(point, pair.b), PointRef(point, pair.a)), Direction("along", plot.guide_names(pair))
        edge = RelativeMotion(b, a, labels, written, slide=pair)
        draw_equation(plot, order, element, VectorChain.closing(edge if name == pair.a else edge.reversed()))


def _roll(plot: Polygons, order: Order, element: Driven) -> float:
    """The rate of a rolling link, read from a velocity plan, as the driver's rate; and the length read for it (mm)."""
    from graphkin.construction.trains import rolled

    driver = element.driver
    coordinate = ("angle", element.link) if driver.turns else ("travel", driver.key)
    turns = [(s.a, s.b, 0.0) for s in plot.structure.slides]
    turns += [(*d.links, plot.given[order, d.key]) for d in plot.structure.scene.drivers if d.turns]
    known = {name: rate.value for name, rate in plot.rates[order].items()}
    value, mm, steps = rolled(
        plot.structure, plot.trains, order, coordinate, known, lambda key: _travel_rate(plot, order, key), turns,
        plot.board.instrument,
    )
    for step in steps:
        plot.do(step)
    plot.given[order, driver.key] = value
    return mm


def _travel_rate(plot: Polygons, order: Order, key: str) -> float | None:
    """The rate of a sliding link along its guide (m/s, m/s2), if it is known: given, or read from the polygon as the
    component along the guide of its motion relative to the coincident point; the Coriolis term is square to it."""
    if any(driver.slide == key for driver in plot.structure.scene.drivers):
        return plot.given[order, key]
    slide = plot.structure.slide(key)
    if not {slide.a, slide.b} <= plot.rates[order].keys():
        return None
    point = slide.pin or next(iter(plot.links[slide.a].points), "")
    if not point:
        raise stuck("not drawn", links_named((slide.a, slide.b)), "no point of the sliding link is drawn")
    along = slide.along(plot.paper.poses)
    slip = plot.end(order, node(plot.links, point, slide.a)) - plot.end(order, node(plot.links, point, slide.b))
    return dot(slip, along) * plot.per[order]


# larger groups


def _draw_group(plot: Polygons, order: Order, group: LargerGroup) -> None:
    """Draw a larger group in a polygon, by its construction, which is found first for all drawings."""
    known_turns(plot, order, group)
    _rolling_points(plot, group)
    if group in plot.plans:
        plot.contours[group] = plot.plans[group].contours
        _draw_by(plot, order, group, plot.plans[group])
        return
    plain = _plans(plot, group)
    first = next(plain, None)
    if first is None or not first.tried:
        _take(plot, order, group, () if first is None else (first,))
        return
    shorter, far = _with_fewer_trials(plot, group, len(first.tried))
    if shorter:
        plot.contours[group] = shorter[0].contours
        _draw_contours(plot, order, group)
        _take(plot, order, group, shorter)
    else:
        _take(plot, order, group, (replace(p, far=p.far or far) for p in chain((first,), plain)))


def _take(plot: Polygons, order: Order, group: LargerGroup, plans: Iterable[GroupPlan]) -> None:
    """Draw a group by the first plan without trials, else by the plan whose trials find the rates best; all have the
    same number."""
    best: tuple[float, GroupPlan] | None = None
    for candidate in plans:
        if not candidate.tried:
            best = 1.0, candidate
            break
        quality, made = TrialPolygons(plot, order, group, candidate).judged()
        if best is None or quality > MUCH_BETTER * best[0]:
            best = quality, made
        if MUCH_BETTER * best[0] >= len(candidate.tried) ** 0.5:
            break  # none can be so much better
    if best is None or not best[0]:
        raise stuck("dead point", group.named, "no drawing tells how this group moves here")
    plot.plans[group] = best[1]
    _draw_by(plot, order, group, best[1])


def _draw_by(plot: Polygons, order: Order, group: LargerGroup, plan: GroupPlan) -> None:
    """Draw a group by a plan: its contours, trial polygons for assumed rates, and the moves."""
    _draw_contours(plot, order, group)
    if order == "velocity":
        for _, first, second in plan.parallel:
            plot.board.notice("mechanism", "parallel legs", first=first, second=second)
    if plan.tried:
        trials = TrialPolygons(plot, order, group, plan).with_assumptions()
        plot.plans[group] = trials.plan
        trials.assume(plot, trials.true_rates())
    _complete(plot, order, group)
    for move in plan.moves:
        _draw_move(plot, order, group, move)
    # what moves along the guides, or slips at the contacts, and has not been drawn
    for edge in [edge for ref in plan.graph.nodes for edge in plan.graph.edges[ref] if edge.forward]:
        if edge.contact or (edge.slide is not None and edge.start.point == edge.slide.pin):
            symbol = plot.symbol(letter(order), edge.labels[1], edge.labels[0])
            if symbol not in plot.drawn[order] and not plot.fixed(edge.start):
                draw_equation(plot, order, group, VectorChain.closing(edge))


# moves


def _draw_move(plot: Polygons, order: Order, group: LargerGroup, step: VectorChain) -> None:
    """Draw a move of a plan."""
    for edge in (e for path in step.sides for e in path if e.held):
        # the point of the contour that the equation needs
        held_plot = plot.seen_from(edge.held)
        held_plot.end(order, edge.end if edge.forward else edge.start)
        for drawn in held_plot.board.steps if not plot.trial else ():
            plot.do(drawn)
    if step.is_special and step.end.point not in plot.places:
        _mark_special(plot, step)
    turned = step.is_special and not step.base
    draw_equation(plot, order, group, replace(step, sides=step.sides[::-1]) if turned else step)
    _complete(plot, order, group)


def _complete(plot: Polygons, order: Order, group: LargerGroup) -> None:
    """Draw all points of links of known rates with a known point, by images."""
    ends = plot.ends[order]
    left = [n for n in group.members if n in plot.rates[order]]
    while ready := [n for n in left if any(plot.on(ref, n) for ref in ends)]:
        for name in ready:
            plot.complete(order, name)
            left.remove(name)


def _mark_special(plot: Polygons, move: VectorChain) -> None:
    """Mark the special point on the mechanism: the crossing of the lines of two legs."""
    name, link = move.end.point, move.link
    legs = [[edge for edge in side if name not in edge.bar] for side in move.sides]
    free = (next(e for e in leg if e.unknown) for leg in legs)
    d, e = (1j * _direction(plot, edge, plot.places) for edge in free)
    p, q = (plot.places[leg[-1].end.point] for leg in legs)
    d = plot.own_values.line(Symbol("v", PointRef(name)), d)
    at = plot.board.cross("mechanism", p, d, q, e, name)
    plot.special.add(name)
    plot.places[name] = at
    if not move.base:
        pose = plot.paper.poses[link]
        points = {**plot.links[link].points, name: pose.local(at) / plot.paper.mm}
        plot.links[link] = replace(plot.links[link], points=points)
    joints = tuple(leg[-1].end.point for leg in legs)
    driven = any(not e.unknown and (e.slide or e.joint) for leg in legs for e in leg)
    strokes = Bar(p, at, ""), Bar(q, at, ""), Mark(PointRef(name), at)
    plot.do(Step("cross", "special point", strokes=strokes, point=name, points=joints, link=link,
                 base=move.base, kind="driven" if driven else ""))


# vector graphs


def _free_letters(plot: Polygons, group: LargerGroup) -> Sequence[str]:
    """Letters that no point has; special points of contours, and of other groups and contours, may be planned only."""
    contours, links = [rest for _, rest in plot.contours.get(group, ())], {plot.held, *group.members}
    plans = (plan for other, plan in plot.plans.items() if other in contours or links.isdisjoint(other.members))
    planned = (move.end.point for plan in plans for move in plan.moves if move.is_special)
    taken = {*plot.places, *planned, *(p for link in plot.links.values() for p in link.points)}
    return [name for name in LETTERS if name not in taken]


def _plans(plot: Polygons, group: LargerGroup, wide: bool = False) -> Iterator[GroupPlan]:
    """The plans for drawing a group, those with the fewest trials first; ``wide`` as in `VectorGraph`."""
    from graphkin.construction.polygons.group_plan import plan_group

    graph = _graph_of(plot, group, wide)
    return plan_group(graph, partial(_direction, plot), _free_letters(plot, group))


def _graph_of(plot: Polygons, group: Dyad | LargerGroup, wide: bool = False) -> VectorGraph:
    """The points of a group and their relative motions; ``wide`` as in `VectorGraph`."""
    driven: Collection[str] = ()
    rolling: Mapping[str, tuple[str, tuple[str, str]]] = {}
    contours: Sequence[tuple[str, LargerGroup]] = ()
    pairs, joints = group.all_pairs, group.joints
    if isinstance(group, LargerGroup):
        held = [(d, driver_pair(d, plot.links, plot.structure.slides)) for d in group.drivers if d.turns]
        joints = tuple(DrivenJoint(pair, driver, pair.b, pair.a) for driver, pair in held if pair is not None)
        driven = {d.key for d in group.drivers if not d.turns}
        rolling, contours = _rolling_points(plot, group), plot.contours.get(group, ())
    names = {p.key: plot.guide_names(p) for p in pairs if not p.turns}
    touching = contacts_of(plot.structure, group) if plot.at_contacts else ()
    gone = {pair.block for pair in touching}
    return VectorGraph(
        plot.links, plot.places, plot.ground, plot.tiny, [name for name in group.members if name not in gone],
        past(pairs, gone), joints, same_turn(plot, group), names, driven, isinstance(group, LargerGroup), touching,
        rolling, [(held, n) for held, rest in contours for n in rest.links], wide,
    )


def _rolling_points(plot: Polygons, group: LargerGroup) -> dict[str, tuple[str, tuple[str, str]]]:
    """The points of rolling between links of a group, by the contact or the gear, with the links: contacts by their
    name, pitch points by a free letter, marked on the mechanism."""
    scene = plot.structure.scene
    between = {pair.name: pair.bodies for pair in scene.higher_pairs if pair.rolling}
    points = {}
    for name in (relation.name for relation in group.rolling):
        if name not in plot.structure.scene.contact_at and name not in plot.pitch_points:
            letter = plot.pitch_points[name] = _free_letters(plot, group)[0]
            touch = plot.touch(name)
            at = plot.places[letter] = plot.board.instrument.point(touch.at)
            plot.special.add(letter)
            strokes = (Mark(PointRef(letter), at),)
            plot.do(Step("mark", "pitch point", strokes=strokes, point=letter, links=touch.links))
        points[name] = plot.pitch_points.get(name, name), between[name]
    return points


def _direction(plot: Polygons, edge: RelativeMotion, places: Mapping[str, complex]) -> complex:
    """The direction of the velocity of an edge's end relative to its start; its length has no meaning."""
    if edge.rolling:
        return 1j * plot.touch(edge.rolling).normal
    if edge.slide is not None:
        return edge.slide.along(plot.paper.poses)
    if edge.contact:
        return -1j * plot.touch(edge.contact).normal
    if edge.joint is not None and edge.joint.pair.turns:  # both ends lie at one place, off the hinge
        return 1j * unit(places[edge.end.point] - places[edge.joint.pair.point])
    return 1j * unit(places[edge.end.point] - places[edge.start.point])


# contours of known shape


def _with_fewer_trials(plot: Polygons, group: LargerGroup, trials: int) -> tuple[list[GroupPlan], FarPoint | None]:
    """The plans of a group with fewer than ``trials`` trials: special points carried over to all links that turn with
    theirs, its contours drawn first if that saves more; none where neither helps, and then the useless special point.
    The links held still are chosen so that vectors seen from them are laid off in their own sense."""
    choices = [_rests_on(plot, group, links) for links in contours_of(plot, group, turned(plot, None, group))]
    choices = [some for some in choices if some]
    best: tuple[tuple[int, bool], list[GroupPlan]] | None = None
    far: FarPoint | None = None
    for number, chosen in enumerate(chain([()], product(*choices) if choices else ())):
        plot.contours[group] = chosen
        plans = _plans(plot, group, wide=True)
        first = next(plans, None)
        if first is not None and len(first.tried) >= trials:
            far = far or first.far
        elif first is not None:
            against = any(e.held and not e.forward for move in first.moves for path in move.sides for e in path)
            cost = len(first.tried), against
            if best is None or cost < best[0]:
                best = cost, [replace(p, contours=chosen) for p in (first, *(plans if first.tried else ()))]
        if number + 1 == MOST_WAYS or (best is not None and best[0] == (0, False)):
            break
    del plot.contours[group]
    return (best[1] if best is not None else []), far


def contours_of(plot: Polygons, group: LargerGroup, turned: Sequence[tuple[str, str, float]]) -> list[tuple[str, ...]]:
    """The contours of a group on paper, of which links are ``turned`` alike; none where its links roll or touch."""
    if group.rolling or (plot.at_contacts and contacts_of(plot.structure, group)):
        return []
    held = [driver_pair(driver, plot.links, plot.structure.slides) for driver in group.drivers]
    driven = {(pair.turns, frozenset(pair.links)) for pair in held if pair is not None}
    poses, inside, joints = plot.paper.poses, set(group.members), list[Joint]()
    for pair in (pair for pair in group.pairs if inside.issuperset(pair.links)):
        letter, along = pair.point or pair.pin, None if pair.turns else pair.along(poses)
        at = plot.places[letter] if letter else poses[pair.a].origin
        joints.append((pair.links, at, along, (pair.turns, frozenset(pair.links)) in driven))
    return contours(group.members, joints, [(a, b) for a, b, _ in turned if inside.issuperset((a, b))])


def on_held(group: LargerGroup, held: str, contour: Sequence[str]) -> LargerGroup:
    """The links of a contour besides the held link, as a group of their own."""
    rest, within = tuple(n for n in contour if n != held), set(contour)
    drivers = tuple(d for d in group.drivers if within.issuperset(d.links))
    pairs = tuple(p for p in group.pairs if within.issuperset(p.links))
    return LargerGroup(rest, pairs, drivers, tuple(n for n in rest if n in group.links), group.order)


def contours(
    links: Sequence[str], joints: Sequence[Joint], turning: Sequence[tuple[str, str]]
) -> list[tuple[str, ...]]:
    """The largest sets of links that can only move as one with drivers at rest, in every motion that the joints allow.

    Links that a driver holds at their common pair are one already: a set of only such links is left out.

    Parameters
    ----------
    joints : between links of the group
    turning : further links whose rotations differ only by the drivers' motions
    """
    turns = np.array([0.0, 0.0, 1.0])
    kept = [(both, turns) for both in turning]
    size = max((abs(at) for _, at, _, _ in joints), default=1.0) or 1.0
    for both, at, along, driven in joints:
        # how a point there moves: by the motion at the origin and the rate of turning
        across, up = np.array([1.0, 0.0, -at.imag / size]), np.array([0.0, 1.0, at.real / size])
        if along is None or driven:
            kept += [(both, across), (both, up)]
        else:
            kept.append((both, (1j * along).real * across + (1j * along).imag * up))
        if along is not None or driven:
            kept.append((both, turns))
    rows = np.zeros((len(kept), len(links), 3))
    for row, ((members, two), weights) in zip(rows, kept, strict=True):
        row[links.index(members)], row[links.index(two)] = weights, -weights
    _, sizes, motions = np.linalg.svd(rows.reshape(len(kept), -1))
    free = motions[int(np.sum(sizes > ALIKE)) :].T.reshape(len(links), 3, -1)
    sets: list[list[int]] = []
    for i in range(len(links)):
        distances = (np.abs(free[members[0]] - free[i]).max(initial=0.0) for members in sets)
        home = next((members for members, distance in zip(sets, distances, strict=True) if distance < 10 * ALIKE), None)
        if home is None:
            sets.append([i])
        else:
            home.append(i)
    alike = [tuple(links[i] for i in members) for members in sets if len(members) > 1]
    already = links_alike(links, ((*both, 0.0) for both, _, _, driven in joints if driven))
    return [members for members in alike if not already[members[0]].issuperset(members)]


def _rests_on(plot: Polygons, group: LargerGroup, contour: Sequence[str]) -> list[tuple[str, LargerGroup]]:
    """The links of a contour that can be held still so that the rest is drawn on it without trials; those with most
    other links on them first."""
    outer = [n for p in group.pairs for n in (p.a, p.b) if not {p.a, p.b} <= set(contour)]
    choices = []
    for held in sorted((n for n in contour if "/" not in n), key=lambda n: -outer.count(n)):
        rest = on_held(group, held, contour)
        plan = next(_plans(plot.seen_from(held, group), rest), None)
        if plan is not None and not plan.tried:
            plot.plans[rest] = plan
            choices.append((held, rest))
    return choices


def _draw_contours(plot: Polygons, order: Order, group: LargerGroup) -> None:
    """Draw the contours of a group, each in its motion seen from one of its links."""
    for held, rest in plot.contours.get(group, ()):
        held_plot, equations = plot.seen_from(held, group), len(plot.board.equations)
        if rest.members[0] in held_plot.rates[order]:
            continue
        spread(held_plot, order, held, rest)
        for pair in (p for p in rest.pairs if p.turns and held in p.links):
            name = pair.other(held)
            if name in held_plot.rates[order] and name not in held_plot.still:
                turn_about(held_plot, order, rest, name, pair.point)
        _draw_group(held_plot, order, rest)
        for name in rest.members:
            held_plot.complete(order, name)
        first = equations + 1 if len(plot.board.equations) > equations else None
        drawn = held_plot.board.steps
        points = [step for step in drawn if step.diagram == "mechanism"]
        seen = Step("carry over", "seen from", order, (), first, held=held, links=rest.links)
        for step in (*points, seen, *(step for step in drawn if step.diagram != "mechanism")):
            plot.do(step)
    for held, rest in plot.contours.get(group, ()):
        for name in (held, *rest.members):
            if name in plot.rates[order]:
                spread(plot, order, name, group)


# trial polygons


@dataclass(frozen=True, eq=False, repr=False)
class TrialPolygons:
    """The trial polygons of a group by a plan that assumes rates.

    An open end is an edge whose ends should meet, and whether it is measured ``across`` it or along.
    """

    plot: Polygons
    order: Order
    group: LargerGroup
    plan: GroupPlan

    def assume(self, plot: Polygons, rates: Sequence[float]) -> None:
        """Let links turn, or pairs slide, at assumed rates (rad/s, m/s; per second)."""
        for (kind, name), value in zip(self.plan.tried, rates, strict=True):
            if kind == "angle":
                plot.rates[self.order][name] = Rate(name, value)
                spread(plot, self.order, name, self.group)
            else:
                plot.given[self.order, name] = value

    def polygon(self, number: int, rates: Sequence[float]) -> Polygons:
        """The polygon that follows from some rates."""
        plot, hand = self.plot, self.plot.board.instrument
        # a board of its own, whose hands do not read again what they have read
        trial = replace(plot.again(hand), trial=number, board=Board(hand, readings=plot.board.readings))
        self.assume(trial, rates)
        _complete(trial, self.order, self.group)
        for move in self.plan.moves:
            _draw_move(trial, self.order, self.group, move)
        return trial

    def rates(self) -> list[list[float]]:
        """First assumptions of each trial polygon: none moves in the first, then each in turn."""
        scene = self.plot.structure.scene
        fastest = max((abs(d.values[1]) for d in scene.drivers if d.turns), default=0.0)
        if not fastest:
            fastest = max((abs(d.values[1]) for d in scene.drivers), default=0.0) / scene.size or 1.0
        base = fastest if self.order == "velocity" else fastest**2
        once = [base * (1.0 if kind == "angle" else scene.size) for kind, _ in self.plan.tried]
        return [[0.0] * len(once), *([x if i == j else 0.0 for j, x in enumerate(once)] for i in range(len(once)))]

    def along(self, edge: RelativeMotion, across: bool) -> complex:
        """The direction in which an edge's gap is measured: along it, or square to it."""
        direction = _direction(self.plot, edge, self.plot.places)
        direction = direction if edge.slide is not None or edge.contact else -1j * direction
        return 1j * direction if across else direction

    def gap(self, trial: Polygons, edge: RelativeMotion, across: bool) -> float | None:
        """The gap of ends that should meet (mm) after a trial; None where it is unknown."""
        parts = parts_of(trial, self.order, replace(edge, unknown=None))
        missing = trial.end(self.order, edge.end) - trial.end(self.order, edge.start)
        missing -= added_up((p.span for p in parts if p.span is not None), 0j)
        if not across and any(p.span is None for p in parts):
            return None
        return dot(missing, self.along(edge, across))

    def gaps(self, trial: Polygons) -> list[float]:
        """The gaps of a trial at the open ends of the plan (mm, or as read)."""
        return [self.gap(trial, *end) or 0.0 for end in self.plan.open_ends]

    def judged(self) -> tuple[float, GroupPlan]:
        """The quality of a group's trials (0: useless; at most the root of the number of assumed rates), and the plan
        with the ends that give the true rates."""
        plan, order = self.plan, self.order
        # no point of a sliding pair without a pin is a joint
        edges = [edge for ref in plan.graph.nodes for edge in plan.graph.edges[ref] if edge.forward and (
            (edge.slide is not None and not edge.slide.pin) or plan.graph.natural >= {edge.start, edge.end})]
        keys = [(edge, across) for edge in edges for across in (False, True)]
        try:
            trials = [self.polygon(number, rates) for number, rates in enumerate(self.rates(), 1)]
            rows = [[self.gap(trial, *key) for key in keys] for trial in trials]
        except Unsolvable:
            return 0.0, plan
        known = [k for k in range(len(keys)) if all(row[k] is not None for row in rows)]
        gaps = np.array([[row[k] for row in rows] for k in known], dtype=float).reshape(len(known), len(rows))
        left = gaps[:, 1:] - gaps[:, :1]
        scale = max((abs(v) for trial in trials for v in trial.ends[order].values()), default=0.0)
        scale = max(scale, float(np.abs(left).max(initial=0.0)))
        chosen: list[int] = []
        quality = 1.0
        for _ in plan.tried:
            sizes = np.hypot.reduce(left, axis=1) if len(left) else np.zeros(1)
            best = int(np.argmax(sizes))
            if not len(left) or sizes[best] <= NAUGHT * scale:
                return 0.0, plan
            quality = min(quality, float(sizes[best]) / scale)
            chosen.append(known[best])
            e = left[best] / sizes[best]
            left = left - np.outer(left @ e, e)
        return quality, replace(plan, open_ends=tuple(keys[k] for k in chosen))

    def with_assumptions(self) -> TrialPolygons:
        """Rates to assume that make the trial polygons about as large as the true one: round ones on either side of it,
        all on the one side in the first trial, each in its turn on the other in those that follow; the nearer to the
        true ones, the further a trial polygon would reach beyond the true one."""
        plan, order = self.plan, self.order
        if order in plan.assumed:
            return self
        once = self.rates()
        trials = [self.polygon(1, assumed) for assumed in once]
        true = [float(rate) for rate in divide(once, [self.gaps(trial) for trial in trials])]
        reach = _reach([trial.drawn[order] for trial in trials], once)
        right, up, left, down = reach(true)
        most = reach(true) + BEYOND * max(right + left, up + down)
        # what hardly moves is tried by a part of the driver's rate
        bases = (rates[i] for i, rates in enumerate(once[1:]))
        spans = [SLOW * base if abs(x) <= 0.05 * abs(base) else x for x, base in zip(true, bases, strict=True)]

        def fitting(choices: Iterable[list[float]]) -> list[float]:
            for row in choices:
                if (reach(row) <= most).all():
                    break
            return row

        low = fitting([_round(x, -share * span) for x, span in zip(true, spans, strict=True)] for share in NEARER)
        fair = [low]
        for i, (x, span) in enumerate(zip(true, spans, strict=True)):
            fair.append(fitting([*low[:i], _round(x, share * span), *low[i + 1 :]] for share in NEARER))
        return replace(self, plan=replace(plan, assumed={**plan.assumed, order: tuple(map(tuple, fair))}))

    def true_rates(self) -> list[float]:
        """The true rates by proportional division of the trial polygons' gaps."""
        plot, order, plan = self.plot, self.order, self.plan
        rates, far = plan.assumed[order], plan.far and replace(plan.far, away=plan.far.away * plot.scales.length)
        gaps: list[list[float]] = []
        ends: list[dict[PointRef, complex]] = []
        for number, assumed in enumerate(rates, 1):
            trial = self.polygon(number, assumed)
            gaps.append([plot.board.instrument.read(mm) for mm in self.gaps(trial)])
            ends.append(trial.ends[order])
            plot.links.update(trial.links)
            plot.places.update(trial.places)
            plot.special.update(trial.special)
            for step in trial.board.steps:
                if step.diagram == "mechanism":  # special points met with first
                    plot.do(step)
            steps = [step for step in trial.board.steps if step.diagram == order]
            strokes = [changed(aid, trial=number) for step in steps for aid in step.auxiliary]
            assumption = self.as_symbols(assumed)
            plot.do(Step("trial", "polygon", order, tuple(strokes), trial=number, rates=assumption, far=far))
        shared = [ref for ref in ends[0] if all(ref in end for end in ends)]
        places = [[end[ref] for ref in shared] for end in ends]
        plot.board.notice(order, "magnified", links=self.group.named, size=magnified(places, gaps))
        true = self._as_noted(rates, gaps)
        edges = [edge for edge, _ in plan.open_ends]
        closing = tuple(edge.link or (edge.slide.key if edge.slide else "") for edge in edges)
        plot.do(Step(
            "divide", "open ends", order,
            rates=self.as_symbols(true), closing=closing, apart=tuple(map(tuple, gaps)),
            ways=tuple(Direction("square" if across else "along", e.bar if e.link else e.direction.names)
                       for e, across in plan.open_ends),
            between=tuple((plot.label(e.labels[0]), plot.label(e.labels[1])) for e in edges),
            less=tuple(tuple(self._taken_off(trial, *end)) for end in plan.open_ends),
        ))
        return true

    def _taken_off(self, trial: Polygons, edge: RelativeMotion, across: bool) -> Iterator[tuple[Term, float]]:
        """The known terms of an edge with a component in the direction of its gap."""
        direction = self.along(edge, across)
        for p in parts_of(trial, self.order, replace(edge, unknown=None)):
            if p.span and abs(dot(p.span, direction)) > NAUGHT * abs(p.span):
                yield p, dot(p.span, direction)

    def _as_noted(self, rates: Sequence[Sequence[float]], gaps: Sequence[Sequence[float]]) -> list[float]:
        """The divided rates as they are written down: the step from the first assumed rate with the figures of the
        divided lengths."""
        noted, made = self.plot.board.instrument.noted, []
        for i, ((kind, _), rate) in enumerate(zip(self.plan.tried, map(float, divide(rates, gaps)), strict=True)):
            unit = 1.0 if kind == "angle" else self.plot.structure.scene.units.rates.metres
            low, more = rates[0][i] / unit, (rates[i + 1][i] - rates[0][i]) / unit
            if len(self.plan.tried) == 1:
                added = noted(rate / unit - low, gaps[0][0], gaps[0][0] - gaps[1][0], carried=LONGEST)
            else:
                added = noted((rate / unit - low) / more, carried=MOST - 1) * more
            made.append(noted(low + added) * unit)
        return made

    def as_symbols(self, values: Sequence[float]) -> tuple[tuple[Symbol, float], ...]:
        """Rates by their symbols, in scene units."""
        plot, named = self.plot, []
        for (kind, name), value in zip(self.plan.tried, values, strict=True):
            if kind == "angle":
                named.append((Symbol(RATE[self.order], link=name), value))
                continue
            slide = plot.structure.slide(name)
            point = slide.pin or next(iter(plot.links[slide.a].points), "")
            of, to = plot.label(PointRef(point, slide.a)), plot.label(PointRef(point, slide.b))
            letter = "v" if self.order == "velocity" else "ar"
            named.append((Symbol(letter, of, to), value / plot.structure.scene.units.rates.metres))
        return tuple(named)


def _reach(
    drawn: Sequence[Mapping[Symbol, Vector]], rates: Sequence[Sequence[float]]
) -> Callable[[Sequence[float]], NDArray[np.float64]]:
    """The reach of a polygon to the right, up, left and down from its pole (mm) for assumed rates: every vector is
    linear in them."""
    shared = [symbol for symbol in drawn[0] if all(symbol in polygon for polygon in drawn)]
    ends = np.array([[0j, *(z for s in shared for z in (polygon[s].tail, polygon[s].tip))] for polygon in drawn])
    slopes = (ends[1:] - ends[0]) / np.diag(np.array(rates[1:]))[:, None]

    def reach(assumed: Sequence[float]) -> NDArray[np.float64]:
        places = ends[0] + np.array(assumed) @ slopes
        return np.array([np.max((places * turn).real) for turn in (1, -1j, -1, 1j)])

    return reach


def _round(value: float, step: float) -> float:
    """A number about a step from a value, with few figures: easy to lay off."""
    wanted = value + step
    for carried in range(1, 9):
        rounded = float(f"{wanted:.{carried}g}")
        if abs(rounded - wanted) <= 0.35 * abs(step):
            return rounded
    return wanted
