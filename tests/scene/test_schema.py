"""The JSON schema that editors use agrees with what the reader takes."""

from __future__ import annotations

import tomllib

import pytest

from graphkin.scene import library, library_text, schema
from graphkin.scene.scene_tables import SCENE, SceneTables

from .scenes import FOUR_BAR, SIX_BAR, changed

jsonschema = pytest.importorskip("jsonschema")


def valid(text: str) -> bool:
    return bool(jsonschema.Draft202012Validator(schema()).is_valid(tomllib.loads(text)))


def test_the_schema_is_a_schema() -> None:
    jsonschema.Draft202012Validator.check_schema(schema())


@pytest.mark.parametrize("text", [FOUR_BAR, SIX_BAR], ids=["four-bar", "six-bar"])
def test_a_scene_keeps_the_schema(text: str) -> None:
    assert valid(text)


@pytest.mark.parametrize("name", library())
def test_every_scene_that_comes_along_keeps_the_schema(name: str) -> None:
    assert valid(library_text(name))


WRONG = {
    "misspelt key": ("length = 150", "lenght = 150"),
    "misspelt table": ("[driver]", "[drivers]"),
    "negative length": ("length = 150", "length = -1"),
    "text for a number": ("length = 150", 'length = "150"'),
    "name of a point": ('["B", "C"]', '["b", "C"]'),
    "name of a link": ("[links.3]", '[links."a b"]'),
    "form of a place": ("E = [100, 50]", "E = [100]"),
    "side": ("E = [100, 50]", 'E = { from = ["B", "C"], r = [1, 2], side = "up" }'),
}


@pytest.mark.parametrize("tables", [
    '[vary]\nranges = { "links.2.length" = [80, 120] }\n',
    '[scans.velocity]\npoints = { pole = [412, 903], B = [988, 610] }\nread = { C = [1100, 880] }\n',
])
def test_tables_with_keys_of_any_spelling_keep_the_schema(tables: str) -> None:
    assert valid(FOUR_BAR + tables)


def test_a_scan_is_one_of_three_drawings() -> None:
    assert not valid(FOUR_BAR + "[scans.forces]\npoints = { pole = [412, 903], B = [988, 610] }\nread = {}\n")


def test_no_table_is_closed_to_every_key() -> None:
    def closed(node: object) -> list[object]:
        if isinstance(node, list):
            return [found for item in node for found in closed(item)]
        if not isinstance(node, dict):
            return []
        shut = node.get("additionalProperties") is False and not {"properties", "patternProperties"} & node.keys()
        return [node] * shut + closed([*node.values()])

    assert [] == closed(schema())


@pytest.mark.parametrize("change", WRONG)
def test_the_schema_refuses_what_the_reader_refuses(change: str) -> None:
    assert not valid(changed(FOUR_BAR, WRONG[change]))


def test_every_key_is_described_or_has_its_choices() -> None:
    tables = [schema(), *schema()["$defs"].values()]
    silent = [key for table in tables for key, entry in table["properties"].items()
              if not {"description", "enum", "$ref"} & entry.keys()]
    assert silent == []


def test_the_rules_of_a_table_inside_a_file_are_not_made_before_a_file_has_it() -> None:
    # the form of all tables takes longer than a four-bar's solution
    assert 1 == str(SceneTables._rules().core_schema).count("'type': 'dataclass'")


def test_no_key_may_be_null() -> None:
    assert "null" not in str(schema())


@pytest.mark.parametrize(("table", "loc"), [
    ("SceneTables", ()),
    ("Guide", ("links", "2", "guides", "g")),
    ("DrivenSlide", ("driver", "<list>", 1, "<slide>")),
    ("LawPiece", ("driver", "<one>", "<angle>", "law", "pieces", 0)),
    ("Compass", ("frame", "points", "D", "<compass>")),
    ("ReadScan", ("scans", "velocity")),
    ("Vary", ("vary",)),
    ("NoneType", ("links", "2", "points")),
])
def test_the_table_at_a_place_follows_from_the_types_of_the_file(table, loc):
    assert table == getattr(SCENE.table_at(loc), "__name__", type(None).__name__)
