"""One table: what its writers make of it, the same with and without the libraries that speed them up."""

from __future__ import annotations

import io
import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from graphkin import table as room
from graphkin.errors import CallError
from graphkin.table import Column, Rows, Table, as_array, parquet_of_csv, table_of, table_of_csv

NUMBERS = [0.0, -0.0, 1.0, -1.5, 1e-6, 9.9e-7, 1e-5, 1 / 3, 1e10, 9999999999.5, 123456789012.3, 1e22, 5e-324, 3e-17]


def whole(n: int = 40) -> Table:
    rng = np.random.default_rng(1)
    speed = rng.normal(size=n) * 10.0 ** rng.uniform(-12, 15, n)
    speed[: len(NUMBERS)] = NUMBERS
    speed[-1] = np.nan
    return Table(
        (
            Column("position", np.arange(n) + 1),
            Column("v_C.x", speed, "mm/s", "v_C"),
            Column("ok", np.arange(n) % 3 > 0),
            Column("why", as_array([
                ("", 'a "limit", here', "死点")[k % 3] for k in range(n)])),
        ),
        ("position",),
    )


def csv_with(monkeypatch: pytest.MonkeyPatch, table: Table, pyarrow: bool) -> str:
    monkeypatch.setattr(room, "FEW", 0)
    monkeypatch.setattr(room, "have", lambda library: pyarrow)
    return table.csv()


def test_csv_has_the_same_bytes_with_and_without_pyarrow(monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    table = whole(50_000)
    assert csv_with(monkeypatch, table, False) == csv_with(monkeypatch, table, True)


@settings(deadline=None)
@given(st.lists(st.floats(allow_nan=False), min_size=1, max_size=50))
def test_any_number_is_written_alike_and_reads_back_the_same(numbers: list[float]) -> None:
    pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    table = Table((Column("x", np.array(numbers)),))
    by_python, by_arrow = table._lines(slice(None)), table._lines_by_arrow(slice(None))
    assert (by_python, numbers) == (by_arrow, [float(line) for line in by_python.split()])


@pytest.mark.parametrize(
    ("number", "text"),
    [(0.0, "0"), (-0.0, "0"), (12.0, "12"), (0.00025, "0.00025"), (1e-6, "0.000001"), (1.5e-7, "1.5e-7"),
     (2e10, "2e+10"), (1 / 3, "0.3333333333333333"), (math.nan, "")],
)
def test_numbers_are_the_shortest_decimals(number: float, text: str) -> None:
    assert f"x\n{text}\n" == Table((Column("x", np.array([number])),)).csv()


def test_a_format_of_a_column_is_kept() -> None:
    assert "x\n0.333\n\n" == Table((Column("x", np.array([1 / 3, np.nan]), form=".3g"),)).csv()


def test_a_cell_is_quoted_only_where_it_must_be() -> None:
    assert 'why\nok\n"a ""b"", c"\n' == Table((Column("why", as_array(["ok", 'a "b", c'])),)).csv()


@pytest.mark.parametrize("pyarrow", [True, False])
def test_a_csv_file_reads_back_as_the_table(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, pyarrow: bool) -> None:
    if pyarrow:
        pytest.importorskip("pyarrow", reason="pyarrow is not installed")
    table = whole()
    table.write(tmp_path / "t.csv")
    monkeypatch.setattr(room, "have", lambda library: pyarrow)
    again = table_of_csv(tmp_path / "t.csv", table.rows(slice(0, 0)))
    for one, other in zip(table.columns, again.columns, strict=True):
        np.testing.assert_array_equal(one.values, other.values)


def test_parquet_holds_the_table_with_nulls(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    table = whole()
    read = parquet.read_table(table.write(tmp_path / "t.parquet"))
    assert read.column("v_C.x (mm/s)").to_pylist() == [*table["v_C.x"].tolist()[:-1], None]


def test_parquet_of_a_csv_file_is_that_of_the_table(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    table = whole()
    with open(tmp_path / "of.parquet", "wb") as out:
        parquet_of_csv(table.write(tmp_path / "t.csv"), table.rows(slice(0, 0)), out)
    assert parquet.read_table(tmp_path / "of.parquet").equals(parquet.read_table(table.write(tmp_path / "t.parquet")))


def test_parquet_keeps_words_in_dictionaries_and_no_number(tmp_path: Path) -> None:
    parquet = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    table = Table((Column("v", np.array([1.5, 2.5]), "m/s"), Column("status", as_array(["ok", "ok"]))))
    kept = parquet.read_metadata(table.write(tmp_path / "t.parquet")).row_group(0)
    encodings = [kept.column(k).encodings for k in range(2)]
    assert [False, True] == ["RLE_DICTIONARY" in encoding for encoding in encodings]


def test_json_has_units_symbols_and_null() -> None:
    out = io.BytesIO()
    Table((Column("v_C.x", np.array([1.5, np.nan]), "m/s", "v_C"),)).write_json(out)
    assert {"v_C.x": {"unit": "m/s", "symbol": "v_C", "values": [1.5, None]}} == json.loads(out.getvalue())


def test_json_written_as_it_goes_is_the_data(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "BLOCK", 7)
    out, table = io.BytesIO(), whole()
    table.write_json(out)
    assert table.data == json.loads(out.getvalue())


def test_html_shows_the_ends_of_a_long_table_and_escapes_it() -> None:
    shown = Table((Column("n", np.arange(1000)), Column("w", as_array(["<b>"] * 1000))))._repr_html_()
    assert (1 + 24 + 1, True, False) == (shown.count("<tr>"), "&lt;b&gt;" in shown, "<td>500" in shown)


def test_pandas_gets_the_columns_by_their_heads() -> None:
    pytest.importorskip("pandas", reason="pandas is not installed")
    frame = whole().to_pandas()
    assert ["position", "v_C.x (mm/s)", "ok", "why"] == list(frame.columns)


def test_xarray_gets_units_and_dimensions() -> None:
    pytest.importorskip("xarray", reason="xarray is not installed")
    design, position = np.repeat([1, 2], 3), np.tile([1, 2, 3], 2)
    columns = Column("design", design), Column("position", position), Column("v_C", np.arange(6.0), "m/s", "v_C")
    data = Table(columns, ("design", "position")).to_xarray()
    assert (5.0, "m/s") == (float(data.v_C.sel(design=2, position=3)), data.v_C.attrs["units"])


def test_a_library_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(room, "import_module", lambda name: exec("raise ImportError"))
    with pytest.raises(CallError, match="pip install pandas"):
        whole().to_pandas()


def test_a_column_that_is_not_there_is_named() -> None:
    with pytest.raises(CallError, match="did you mean"):
        whole()["v_C.z"]


def test_an_unknown_ending_is_refused(tmp_path: Path) -> None:
    with pytest.raises(CallError, match=r"\.csv, \.parquet"):
        whole().write(tmp_path / "table.xls")


def test_rows_as_they_are_found_become_columns() -> None:
    rows = [["v_B", 1, 2.5, True], ["v_C", 2, None, False]]
    table = Table.of(["symbol", "n", "value", "ok"], rows, ["", "", ".2f", ""])
    assert "symbol,n,value,ok\nv_B,1,2.50,yes\nv_C,2,,no\n" == table.csv()


@pytest.mark.quick
@pytest.mark.parametrize(
    ("form", "cells"),
    [("", ["0", "-0.004", "1.5"]), (".2f", ["0.00", "0.00", "1.50"]), (".3g", ["0", "-0.004", "1.5"])],
)
def test_zero_has_no_sign_in_csv_and_json(form, cells):
    table = Table((Column("a", np.array([-0.0, -0.004, 1.5]), form=form),))
    assert cells == table.csv().splitlines()[1:]
    out = io.BytesIO()
    table.write_json(out)
    assert "-0.0," not in out.getvalue().decode()


def test_a_picture_is_no_table_without_rows(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes(b"\x89PNG\r\n\x1a\n\x00\xff")
    with pytest.raises(CallError, match=r"a\.csv: is not UTF-8 text; save it as CSV"):
        table_of(tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("text", "encoding"),
    [("Müller;Größe", "cp1252"), ("GRÖßE;v (m/s²)", "cp1252"), ("André;30 °", "cp1252"), ("陶喆;朱镕基", "gb18030"),
     ("Li;ω3", "gb18030"), ("组;36°", "gb18030"), ("Müller;↑", "gb18030")],
)
def test_a_table_is_read_in_the_likelier_encoding(tmp_path: Path, text: str, encoding: str) -> None:
    (tmp_path / "a.csv").write_bytes(f"{text}\n1;2\n".encode(encoding))
    assert tuple(text.split(";")) == table_of(tmp_path / "a.csv").heads


def test_a_table_that_may_be_in_two_encodings_is_refused(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_bytes("喆;组\n1;2\n".encode("gb18030"))
    with pytest.raises(CallError, match=r"a\.csv: is not UTF-8 text; save it as CSV UTF-8"):
        table_of(tmp_path / "a.csv")


@pytest.mark.parametrize("first", ["sep=;\r\n", '"sep=;"\n', "\ufeffSEP=;\n"])
def test_a_first_line_may_tell_the_sign_between_cells(tmp_path: Path, first: str) -> None:
    (tmp_path / "a.csv").write_bytes(f"{first}a,b,c;d\n1;2\n".encode())
    assert Rows(("a,b,c", "d"), ((3, ("1", "2")),), ";") == table_of(tmp_path / "a.csv")


def test_a_decimal_comma_among_commas_is_told_and_not_cut_off(tmp_path: Path) -> None:
    (tmp_path / "a.csv").write_text("name,v_C\nLi,150,\nWu,150,5\n")
    with pytest.raises(CallError, match=r"^[^\n]*a\.csv, line 3: cells found: 3, in the head: 2$"):
        table_of(tmp_path / "a.csv")
