"""From a scene to the elements in the order of solution."""

from __future__ import annotations

from graphkin.errors import Unsolvable
from graphkin.scene.model import Scene
from graphkin.structure.constraints import Constraints, Node
from graphkin.structure.faults import wrong_count, wrong_part
from graphkin.structure.graph import components, match
from graphkin.structure.groups import element_of
from graphkin.structure.model import Element, Mobility, Structure

__all__ = ["analyse", "mobility_of"]


def analyse(scene: Scene) -> Structure:
    """Find the mobility and the order of solution.

    Each constraint is assigned one coordinate that it gives (a perfect matching exists just when every part of the
    mechanism has as many constraints as coordinates); the strongly connected components of what needs what are then
    the Assur groups, in the order of solution.

    Raises
    ------
    Unsolvable
        status "mobility": the number of drivers is not the mobility, or a part of the mechanism is held too much
        while another is free.
    """
    system = Constraints(scene)
    mobility = system.mobility()
    if mobility.value != len(scene.drivers):
        raise Unsolvable("mobility", wrong_count(system, mobility))
    equations = system.equations()
    unknowns = [sorted(e) for e in equations]
    given = match(unknowns)
    if len(given) < len(equations):
        raise Unsolvable("mobility", wrong_part(system, unknowns, given))
    needs: dict[Node, list[Node]] = {node: [] for node in system.nodes()}
    for i, (node, _) in given.items():
        others = sorted({n for n, _ in unknowns[i]} - {node}, key=system.place)
        needs[node] += [n for n in others if n not in needs[node]]
    elements: list[Element] = []
    known = {scene.frame.name}
    for component in components(needs):
        members = [name for kind, name in component if kind == "link"]
        if not members:
            continue
        members.sort(key=lambda name: system.place(("link", name)))
        elements.append(element_of(system, members, known))
        known.update(members)
    return Structure(scene, system.links, system.slides, system.hinges, mobility, tuple(elements))


def mobility_of(scene: Scene) -> Mobility:
    """Links, pairs and F of a scene, whatever its drivers are."""
    return Constraints(scene).mobility()
