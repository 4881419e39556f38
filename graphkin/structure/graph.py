"""Matching and strongly connected components, for the order of solution."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import TypeVar

__all__ = ["components", "match"]

N = TypeVar("N", bound=Hashable)


def match(equations: Sequence[Sequence[N]]) -> dict[int, N]:
    """Assign to as many equations as possible one of their unknowns each (augmenting paths).

    Parameters
    ----------
    equations : for each equation its unknowns

    Returns
    -------
    dict from the index of an equation to the unknown it gives; equations left out cannot be served
    """
    given: dict[N, int] = {}
    for start in range(len(equations)):
        # breadth-first search for a free unknown, so that depth is no limit
        came_from: dict[N, int] = {}
        queue = [start]
        free: N | None = None
        while queue and free is None:
            equation = queue.pop(0)
            for unknown in equations[equation]:
                if unknown in came_from:
                    continue
                came_from[unknown] = equation
                if unknown not in given:
                    free = unknown
                    break
                queue.append(given[unknown])
        if free is None:
            continue
        held = {equation: unknown for unknown, equation in given.items()}
        step: N | None = free
        while step is not None:
            equation = came_from[step]
            given[step] = equation
            step = held.get(equation)
    return {equation: unknown for unknown, equation in given.items()}


def components(needs: Mapping[N, Sequence[N]]) -> list[tuple[N, ...]]:
    """Strongly connected components, each after those it needs (Tarjan 1972, without recursion).

    Parameters
    ----------
    needs : for each node the nodes it needs
    """
    index: dict[N, int] = {}
    low: dict[N, int] = {}
    stack: list[N] = []
    on_stack: set[N] = set()
    found: list[tuple[N, ...]] = []
    for root in needs:
        if root in index:
            continue
        work: list[tuple[N, int]] = [(root, 0)]
        while work:
            node, place = work.pop()
            if node not in index:
                index[node] = low[node] = len(index)
                stack.append(node)
                on_stack.add(node)
            children = needs[node]
            while place < len(children) and children[place] in index:
                if children[place] in on_stack:
                    low[node] = min(low[node], index[children[place]])
                place += 1
            if place < len(children):
                work.append((node, place))
                work.append((children[place], 0))
                continue
            if low[node] == index[node]:
                members: list[N] = []
                while True:
                    member = stack.pop()
                    on_stack.discard(member)
                    members.append(member)
                    if member == node:
                        break
                found.append(tuple(members))
            if work:
                parent = work[-1][0]
                low[parent] = min(low[parent], low[node])
    return found
