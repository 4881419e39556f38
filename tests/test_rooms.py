"""The house as its imports draw it: no circle, and the rooms of the README's picture are the ones that are there."""

from __future__ import annotations

import grimp
import pytest

pytestmark = pytest.mark.quick

# circles still to be untied; none may be added, none may grow
KNOWN = [
    {"graphkin.api.report_text", "graphkin.api.swept"},
    {"graphkin.construction.plot", "graphkin.construction.slip", "graphkin.construction.terms"},
]


@pytest.fixture(scope="module")
def imports() -> dict[str, set[str]]:
    """What each module imports: at its head, inside functions, and for types only."""
    graph = grimp.build_graph("graphkin", cache_dir=None)
    return {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}


def circles(imports: dict[str, set[str]]) -> list[set[str]]:
    """Modules that import each other, directly or through others."""
    reached: dict[str, set[str]] = {}
    for module in imports:
        seen, ahead = set(), list(imports[module])
        while ahead:
            if (one := ahead.pop()) not in seen:
                seen.add(one)
                ahead += imports[one]
        reached[module] = seen
    found = {frozenset(n for n in reached[m] if m in reached[n]) for m in imports if m in reached[m]}
    return sorted(map(set, found), key=sorted)


def test_no_module_imports_what_imports_it(imports: dict[str, set[str]]) -> None:
    assert [] == [circle for circle in circles(imports) if not any(circle <= known for known in KNOWN)]


def test_a_circle_through_three_modules_is_seen() -> None:
    assert [{"a", "b", "c"}] == circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}})
