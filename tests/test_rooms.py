"""The house as its imports draw it: no circle, and the manual's picture has the rooms that there are, by layers."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import grimp
import pytest
from importlinter.cli import lint_imports

import graphkin

pytestmark = pytest.mark.quick

TESTS = Path(__file__).parent
ROOT = TESTS.parent


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
    assert [] == circles(imports)


def test_a_circle_through_three_modules_is_seen() -> None:
    assert [{"a", "b", "c"}] == circles({"a": {"b"}, "b": {"c"}, "c": {"a"}, "d": {"a"}})


def test_the_import_contracts_hold(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    monkeypatch.chdir(ROOT)
    code = lint_imports(no_cache=True, no_logo=True)
    assert 0 == code, capsys.readouterr().out


def picture() -> list[set[str]]:
    """The rooms of the manual's picture, line by line."""
    text = (ROOT / "docs" / "how-it-works.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"(?s)<!-- rooms -->\n```\n(.*?)```", text)
    return [set(line.partition("|")[0].split()) for line in block.splitlines()]


def test_the_rooms_of_the_manual_are_those_that_there_are() -> None:
    there = {path.stem for path in Path(graphkin.__file__).parent.iterdir() if path.name[0] not in "_."} - {"py"}
    assert there == set.union(*picture())


def test_the_manual_has_the_rooms_in_the_layers_of_the_import_contract() -> None:
    tool = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["tool"]
    (layers,) = [c["layers"] for c in tool["importlinter"]["contracts"] if c["type"] == "layers"]
    assert [set(re.findall(r"\w+", layer)) for layer in layers] == picture()


@pytest.mark.parametrize("room", sorted(r for line in picture() for r in line - {"races"} if (TESTS / r).is_dir()))
def test_a_room_has_quick_tests(room: str) -> None:
    assert any("mark.quick" in path.read_text(encoding="utf-8") for path in (TESTS / room).glob("test_*.py"))
