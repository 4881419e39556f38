"""Matching and strongly connected components."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphkin.structure.analysis import components, match

pytestmark = pytest.mark.quick

rows = st.lists(st.lists(st.integers(0, 6), max_size=4, unique=True), max_size=7)


def best(equations: list[list[int]], used: frozenset[int] = frozenset()) -> int:
    """The most equations that can be served, by trying all."""
    if not equations:
        return 0
    first, rest = equations[0], equations[1:]
    return max([best(rest, used)] + [1 + best(rest, used | {u}) for u in first if u not in used])


@settings(deadline=None)
@given(rows)
def test_each_unknown_is_given_once(equations: list[list[int]]) -> None:
    given_ = match(equations)
    assert len(set(given_.values())) == len(given_)


@settings(deadline=None)
@given(rows)
def test_an_equation_gives_one_of_its_own_unknowns(equations: list[list[int]]) -> None:
    assert all(u in equations[i] for i, u in match(equations).items())


@settings(deadline=None)
@given(rows)
def test_as_many_equations_are_served_as_can_be(equations: list[list[int]]) -> None:
    assert len(match(equations)) == best(equations)


graphs = st.dictionaries(st.integers(0, 6), st.lists(st.integers(0, 6), max_size=4), max_size=7).map(
    lambda g: {k: [n for n in v if n in g] for k, v in g.items()}
)


def reach(graph: dict[int, list[int]], node: int) -> set[int]:
    found, todo = {node}, [node]
    while todo:
        for n in graph[todo.pop()]:
            if n not in found:
                found.add(n)
                todo.append(n)
    return found


@settings(deadline=None)
@given(graphs)
def test_two_nodes_are_together_just_when_each_needs_the_other(graph: dict[int, list[int]]) -> None:
    place = {n: i for i, c in enumerate(components(graph)) for n in c}
    for a in graph:
        for b in graph:
            assert (place[a] == place[b]) == (b in reach(graph, a) and a in reach(graph, b))


@settings(deadline=None)
@given(graphs)
def test_a_component_stands_after_those_it_needs(graph: dict[int, list[int]]) -> None:
    place = {n: i for i, c in enumerate(components(graph)) for n in c}
    assert all(place[b] <= place[a] for a in graph for b in graph[a])
