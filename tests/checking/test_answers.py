"""Tables of answers as people write them: encodings, separators, decimal commas, units, Greek letters."""

from __future__ import annotations

import math
import re

import pytest

import graphkin
from graphkin.errors import CallError
from graphkin.scene.spelling import read_cell, read_way
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from tests.command import run
from tests.scenes import slider_crank

pytestmark = pytest.mark.quick

SIXBAR = "sixbar-guide-40deg"
MESSY = "姓名;v_D (mm/s);a_D [mm/s²];ω3;备注\n张三;482,7;554,7 mm/s²;-2,82;好\n李四;(-482,7 0);-;2,82;\n"


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "gb18030"])
def test_a_table_is_read_as_people_write_it(tmp_path, encoding):
    (tmp_path / "a.csv").write_bytes(MESSY.replace("²", "2" if encoding == "gb18030" else "²").encode(encoding))
    audited = graphkin.audit(SIXBAR, answers=tmp_path / "a.csv")
    found = [(v["person"], v["symbol"], v["verdict"]) for v in audited.data["values"]]
    expected = [("张三", s, "right") for s in ("v_D", "a_D", "omega_3")]
    rest = [("李四", "v_D", "right"), ("李四", "a_D", "missing"), ("李四", "omega_3", "wrong")]
    assert [*expected, *rest] == found
    assert ("备注",) == audited.unused


def test_variants_without_answers_are_refused(tmp_path):
    with pytest.raises(CallError, match="variants: without answers"):
        graphkin.audit("shaper-scheme-2", variants=tmp_path)


def test_a_force_of_a_scene_without_loads_is_no_head(tmp_path):
    (tmp_path / "a.csv").write_text("name,v_D,F_2/3\nx,480,5\n")
    with pytest.raises(CallError, match="column F_2/3: F_2/3 is a force"):
        graphkin.audit(SIXBAR, answers=tmp_path / "a.csv")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("name,v_D (kg)\nx,0.48\n", "give it in mm/s"),
        ("name,v_D,v_D\nx,480,481\n", "stands twice"),
    ],
)
def test_what_may_be_meant_in_two_ways_is_refused(tmp_path, text, said):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(CallError, match=re.escape(said)):
        graphkin.audit(SIXBAR, answers=tmp_path / "a.csv")


def test_a_wrong_unit_in_a_head_is_told_in_one_language(tmp_path):
    (tmp_path / "a.csv").write_text("name,v_D (kg)\nx,0.48\n")
    refused = run("audit", SIXBAR, "--answers", str(tmp_path / "a.csv"), "--lang", "zh")
    assert (True, False) == ("kg 不是速度的单位" in refused.stderr, "velocity" in refused.stderr)


@pytest.mark.parametrize(
    ("head", "cell", "said"),
    [("a_D", '"1,126"', "may be 1126 or 1.126"), ("omega_3", "1 2", "more than one number")],
)
def test_a_cell_that_may_be_meant_in_two_ways_is_not_readable(tmp_path, head, cell, said):
    (tmp_path / "a.csv").write_text(f"name,{head}\nx,{cell}\n")
    (value,) = graphkin.audit(SIXBAR, answers=tmp_path / "a.csv").data["values"]
    assert ("not readable", True) == (value["verdict"], said in value["why"])


def test_a_comma_between_digits_of_a_list_is_a_decimal_comma_where_it_can_be_nothing_else(tmp_path):
    (tmp_path / "a.csv").write_text('name,v_D\nx,"482,7"\n')
    assert graphkin.audit(SIXBAR, answers=tmp_path / "a.csv").ok


def test_a_component_that_cancels_is_zero():
    (value,) = graphkin.audit("slotter-75-150").data["values"]
    assert 0 == value["exact"][1]


def test_a_value_in_the_unit_of_its_head_is_shown_with_it(tmp_path):
    table = tmp_path / "answers.csv"
    table.write_text("name,v_C (m/s),omega_2 (rpm),a_C (mm/s2)\nAnn,0.94888,22.79 cw,5907.2\n", encoding="utf-8")
    audited = graphkin.audit(slider_crank(100, 280), answers=str(table))
    assert ["0.94888 m/s", "22.79 cw (rpm)", "5907.2"] == list(audited.table["printed"])
    assert ["right"] * 3 == list(audited.table["verdict"])


FOUR_BAR = "fourbar-150-500-300-400"


def verdicts(tmp_path, text, **more):
    (tmp_path / "a.csv").write_text(text)
    return [one["verdict"] for one in graphkin.audit(FOUR_BAR, answers=tmp_path / "a.csv", **more).data["values"]]


def test_a_minus_in_a_column_of_senses_is_a_sense_where_a_plus_is_one(tmp_path):
    assert ["right", "wrong"] == verdicts(tmp_path, "name,omega_3,sense\nLi,5.19,+\nWu,5.19,-\n")
    assert ["right", "right"] == verdicts(tmp_path, "name,omega_3,sense\nLi,5.19,ccw\nWu,5.19,-\n")


@pytest.mark.parametrize(
    ("text", "more", "said"),
    [
        ("name,at,omega_3\nLi,x,5\n", {}, 'line 2, at: "x" is no driver value'),
        ("name,variant,omega_3\nLi,3,5\n", {"variants": {"1": FOUR_BAR}}, "variant 3: is not in the set; known"),
        ('name,omega_3\n"Li,5\n', {}, "a.csv: is no table: unexpected end of data; save it as CSV"),
        ("name,omega_3\nLi,5\n", {"grading": {"omega_3": 1e7}},
         "grading omega_3: found 10000000.0; give points, from 0 to 1000000"),
        ("name,omega_3\nLi,5\n", {"grading": {"equations": True}}, "grading equations: found True; give points"),
    ],
)
def test_answers_that_cannot_be_judged_are_refused_by_name(tmp_path, text, more, said):
    with pytest.raises(CallError, match=re.escape(said)):
        verdicts(tmp_path, text, **more)


def test_a_row_that_is_not_reached_is_told_as_it_was_written():
    rocker = {
        "frame": {"points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 300}, "2": {"points": ["B", "C"], "length": 200},
            "3": {"points": ["D", "C"], "length": 150},
        },
        "driver": {"link": "1", "angle": 20, "omega": 10},
        "printed_rows": [{"at": at, "omega_3": 3, "by": "computation"} for at in (20, 120)],
    }
    with pytest.raises(graphkin.Unsolvable, match="driver 1 at 120°: not assembled"):
        graphkin.audit(rocker)


@pytest.mark.parametrize(
    ("text", "value"),
    [("1 220.5", 1220.5), ("12 345.6 rad/s", 12345.6), ("1 220", 1220.0), ("1'220.5", 1220.5), ("5.19 1/s", 5.19)],
)
def test_thousands_parted_by_spaces_are_one_number_with_its_decimals(text, value):
    assert value == read_cell(text, Symbol.parse("omega_3"), Units(), "", ".", None).value


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("NNW", 112.5), ("west-southwest", -157.5), ("northwest", 135.0), ("12° clockwise from -x", 168.0),
        ("12° cw from y", 78.0), ("12° W of N", 102.0), ("30", 30.0),
        ("0.5 rad", math.degrees(0.5)), ("57°54'", 57.9), ("S 50°30′ E", -39.5), ("57° 54′ 36″", 57.91),
        ("指向左下", -135.0), ("left and down", -135.0), ("0.5弧度", math.degrees(0.5)),
        ("1 Radian", math.degrees(1)), ("bearing 57°54'", 32.1),
    ],
)
def test_directions_are_read_from_words_and_axes(text, degrees):
    assert pytest.approx(degrees) == math.degrees(read_way(text, Symbol.parse("v_C")).angle)


@pytest.mark.parametrize(
    ("text", "degrees"),
    [
        ("483 at 3.316 rad", math.degrees(3.316)), ("483 mm/s, theta=190°", 190.0), ("483 θ=190", 190.0),
        ("483 mm/s, φ = 3.316 rad", math.degrees(3.316)), ("483 mm/s，指向左下", -135.0), ("483 at -57°54'", -57.9),
    ],
)
def test_a_direction_behind_a_size_is_read_in_its_unit(text, degrees):
    read = read_cell(text, Symbol.parse("v_D"), Units())
    assert (0.483, pytest.approx(degrees)) == (read.value, math.degrees(read.way.angle))


def test_minutes_of_arc_are_as_fine_as_they_are_written():
    read = read_cell("-57°54'", Symbol.parse("theta_3"), Units())
    assert pytest.approx((-57.9, 0.5 / 60)) == (math.degrees(read.value), math.degrees(read.rounding))


@pytest.mark.parametrize(
    ("cell", "verdict"),
    [("482.7 ∥h", "right"), ("482.7 ⊥h", "wrong"), ("482.7 // h", "right"), ("482.7 ∥g", "not readable")],
)
def test_a_direction_along_a_guide_is_read_as_the_sheets_print_it(cell, verdict):
    (judged,) = graphkin.audit(SIXBAR, answers={"Li": {"v_D": cell}}).data["values"]
    assert verdict == judged["verdict"]


def test_a_column_of_directions_is_in_the_unit_of_its_head(tmp_path):
    (right,) = (v["exact"] for v in graphkin.audit(FOUR_BAR, answers={"Li": {"v_C": 1}}).data["values"])
    way = graphkin.solve(FOUR_BAR).data["positions"][0]["points"]["C@3"]["velocity"]
    angle = math.atan2(*reversed(way))
    assert ["right"] == verdicts(tmp_path, f"name,v_C,direction (Radians)\nLi,{right},{angle:.4f}\n")
