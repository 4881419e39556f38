"""Designs: what may be replaced, in which ways, and what is said about mistakes."""

from __future__ import annotations

import tomllib
from pathlib import Path
from typing import Any

import pytest

from graphkin.errors import CallError
from graphkin.scene import library_text
from graphkin.study.designs import applied, designs_of, read_designs

pytestmark = pytest.mark.quick


def four_bar() -> dict[str, Any]:
    return tomllib.loads(library_text("fourbar-150-500-300-400"))


def test_a_grid_holds_both_ends() -> None:
    designs = designs_of({"links.1.length": "40:60:21"})
    assert [(40.0,), (41.0,), (60.0,)] == [designs[0], designs[1], designs[20]]


def test_a_list_is_taken_as_it_is() -> None:
    designs = designs_of({"links.1.length": "40, 55,60"})
    assert [(40.0,), (55.0,), (60.0,)] == [designs[k] for k in range(len(designs))]


def test_a_text_that_is_a_number_stands_in_quotation_marks(tmp_path: Path) -> None:
    assert (1.0, "3") == designs_of({"driver.link": '1, "3"'}).grid[0]
    (tmp_path / "d.csv").write_text('driver.link\n"""3"""\n')
    assert (("3",),) == read_designs(tmp_path / "d.csv")[1]


def test_several_keys_give_every_combination_the_last_one_fastest() -> None:
    designs = designs_of({"a": "1,2", "b": [3.0, 4.0]})
    assert [(1.0, 3.0), (1.0, 4.0), (2.0, 3.0), (2.0, 4.0)] == [designs[k] for k in range(len(designs))]


def test_a_file_and_a_grid_give_every_combination(tmp_path: Path) -> None:
    file = tmp_path / "designs.csv"
    file.write_text("links.1.length,links.2.length\n100,500\n110,520\n")
    designs = designs_of({"driver.omega": "1,2"}, file)
    assert designs.keys == ("links.1.length", "links.2.length", "driver.omega")
    assert [(100.0, 500.0, 1.0), (100.0, 500.0, 2.0), (110.0, 520.0, 1.0), (110.0, 520.0, 2.0)] == [
        designs[k] for k in range(len(designs))
    ]


@pytest.mark.parametrize("text", ["1:2:0", "1:x:3", "", "1,,2", "nan", "1:inf:3"])
def test_wrong_values_are_refused_with_their_key(text: str) -> None:
    with pytest.raises(CallError, match=r"--set links\.1\.length"):
        designs_of({"links.1.length": text})


def test_a_row_with_a_missing_cell_is_named(tmp_path: Path) -> None:
    file = tmp_path / "designs.csv"
    file.write_text("a,b\n1,2\n3\n")
    with pytest.raises(CallError, match="row 3"):
        designs_of(None, file)


def test_a_number_is_replaced() -> None:
    assert applied(four_bar(), ["links.1.length"], [42.0])["links"]["1"]["length"] == 42.0


def test_a_coordinate_is_replaced_by_its_name() -> None:
    assert applied(four_bar(), ["frame.points.D.x"], [42.0])["frame"]["points"]["D"][0] == 42.0


def test_items_of_lists_are_counted_from_one() -> None:
    assert applied(four_bar(), ["frame.points.D.2"], [42.0])["frame"]["points"]["D"][1] == 42.0


def test_a_key_that_the_file_leaves_out_is_set() -> None:
    assert applied(four_bar(), ["driver.alpha"], [3.0])["driver"]["alpha"] == 3.0


def test_the_scene_given_is_not_changed() -> None:
    scene = four_bar()
    applied(scene, ["frame.points.D.x", "links.1.length"], [1.0, 2.0])
    assert scene == four_bar()


@pytest.mark.parametrize(
    ("key", "said"),
    [
        ("links.1.legth", "length"),
        ("link.1.length", "links"),
        ("frame.points.D.z", "has no item z"),
        ("links.1", "not a number"),
        ("links.1.length.x", "nothing inside"),
    ],
)
def test_every_wrong_key_is_named(key: str, said: str) -> None:
    with pytest.raises(CallError, match=said):
        applied(four_bar(), [key], [1.0])


def test_designs_are_read_as_spreadsheets_write_them(tmp_path: Path) -> None:
    (tmp_path / "d.csv").write_bytes("links.1.length;title\n40,5;四杆\n50;四杆\n".encode("gb18030"))
    assert (("links.1.length", "title"), ((40.5, "四杆"), (50.0, "四杆"))) == read_designs(tmp_path / "d.csv")


@pytest.mark.parametrize(("other", "read"), [("1.250,5", ((1220.0,), (1250.5,))), ("40.5", ((1.22,), (40.5,)))])
def test_thousands_of_designs_are_parted_as_the_file_shows(tmp_path: Path, other: str, read: object) -> None:
    (tmp_path / "d.csv").write_text(f"sep=;\nlinks.1.length\n1.220\n{other}\n")
    assert read == read_designs(tmp_path / "d.csv")[1]
    (tmp_path / "d.csv").write_text("sep=;\nlinks.1.length\n1.220\n40,5\n")
    with pytest.raises(CallError, match=r"d\.csv, line 3: \"1.220\" may be 1220 or 1.220"):
        read_designs(tmp_path / "d.csv")


def test_a_key_that_stands_twice_is_told_at_the_first_row_in_any_language(tmp_path: Path) -> None:
    (tmp_path / "designs.csv").write_text("links.1.length,links.1.length\n100,110\n")
    with pytest.raises(CallError) as refusal:
        read_designs(tmp_path / "designs.csv")
    assert "第 1 行" in refusal.value.text("zh")
