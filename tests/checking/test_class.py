"""A class's answers as people write them: symbols, senses, directions, units; verdicts, points, and who made what."""

from __future__ import annotations

import csv
import json

import pytest

import graphkin
from graphkin.errors import CallError
from graphkin.papers.documents import answers_template
from graphkin.scene import mechanism_of
from graphkin.scene.asked import spelling_of
from graphkin.scene.scene import written
from graphkin.scene.spelling import read_cell
from graphkin.scene.symbol import Symbol
from graphkin.scene.tables import Units
from tests.command import run

SIXBAR = "sixbar-guide-40deg"  # v_D 482.72 to the left, omega_3 -2.819, alpha_3 6.577


def judged(**values):
    named = {k.replace("_at_", "@").replace("_to_", "/"): v for k, v in values.items()}
    return graphkin.audit(SIXBAR, answers={"A": named}).data["values"]


def table(folder, text, **more):
    (folder / "a.csv").write_text(text, encoding="utf-8")
    return graphkin.audit(SIXBAR, answers=folder / "a.csv", **more)


@pytest.mark.parametrize(
    ("text", "symbol"),
    [
        ("v_B3", "v_B@3"), ("vB3", "v_B@3"), ("v_{B3}", "v_B@3"), ("v_B2", "v_B"), ("ω₃", "omega_3"),
        ("omega3", "omega_3"), ("$\\omega_3$", "omega_3"), ("w3", "omega_3"), ("角速度ω3", "omega_3"),
        ("ε3", "alpha_3"), ("v_B3B2", "v_B@3/B@2"), ("a_{B3B2}^{k}", "ak_B@3/B@2"), ("aᵏ_B3B2", "ak_B@3/B@2"),
        ("a^n_B3C", "an_B@3/C"), ("anB3C", "an_B@3/C"), ("v_d", "v_D"), ("φ3", "theta_3"), ("dBC", "d_B/C"),
        ("s2/3", "s_2/3"),
    ],
)
def test_a_symbol_is_read_as_people_spell_it(text, symbol):
    assert symbol == str(spelling_of(mechanism_of(SIXBAR)).symbol(text))


@pytest.mark.parametrize("text", ["name", "note", "student", "score", "v_Q", "id", "at"])
def test_a_word_that_names_nothing_of_the_scene_is_no_symbol(text):
    assert spelling_of(mechanism_of(SIXBAR)).symbol(text) is None


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("2.82 clockwise", -2.82), ("2.82 cw", -2.82), ("2.82 逆时针", 2.82), ("↻ 2.82", -2.82), ("2.82 (CCW)", 2.82),
        ("−2.82 rad/s", -2.82), ("≈2.82", 2.82), ("ω = 2.82 rad/s", 2.82), ("30 r/min", 3.14159265358979),
        ("2.82 ± 0.1", 2.82), ("2．82", 2.82), ("0.282×10¹", 2.82), ("2.82 s^-1", 2.82), ("2.82 1/s", 2.82),
        ("2.82 radians per second", 2.82), ("2.82↷", -2.82), ("顺时针方向，大小为2.82", -2.82), ("-2.82 k̂", -2.82),
    ],
)
def test_a_rate_is_read_as_people_write_it(text, value):
    assert pytest.approx(value) == read_cell(text, Symbol.parse("omega_3"), Units()).value


@pytest.mark.parametrize(
    ("text", "value", "degrees"),
    [
        ("0.483 m/s", 0.483, None), ("0,483 m/s; 180°", 0.483, 180), ("483 168°", 0.483, 168),
        ("48,3 cm/s", 0.483, None), ("483 ←", 0.483, 180), ("483 向左", 0.483, 180),
        ("483 mm/s, 12° above x", 0.483, 12), ("483 12° above -x", 0.483, 168), ("483 12° below x", 0.483, -12),
        ("483 ∠168.9°", 0.483, 168.9), ("483 168.9°", 0.483, 168.9), ("约 483 毫米/秒", 0.483, None),
        ("483 与x轴成30°", 0.483, 30), ("483 mm s^{-1}, θ = 180°", 0.483, 180), ("483 at an angle of 12°", 0.483, 12),
        ("483 in -x direction", 0.483, 180), ("483 downward to the right", 0.483, -45),
        ("483，方向角 150°", 0.483, 150),
        ("毫米/秒483", 0.483, None), ("483 mm/s, 1.2 rad", 0.483, 68.75493541569878),
        ("483 mm·s^{-1} left", 0.483, 180), ("0.483 m s^-1 ←", 0.483, 180),
    ],
)
def test_a_vector_is_read_with_its_unit_and_direction(text, value, degrees):
    found = read_cell(text, Symbol.parse("v_D"), Units())
    way = None if found.way.angle is None else pytest.approx(degrees * 3.141592653589793 / 180)
    assert (pytest.approx(value), way) == (found.value, found.way.angle)


@pytest.mark.parametrize(("text", "symbol", "value"), [
    ("22.5 rad/s^2 cw", "alpha_3", -22.5), ("120 牛", "F_1/2", 120), ("0.12 千牛", "F_1/2", 120),
    ("120 牛·米 顺时针", "M_2", -120), ("120 牛米", "M_2", 120), ("ω3 = - 2.82 rad/s", "omega_3", -2.82),
])
def test_units_are_read_before_a_sense_and_in_chinese(text, symbol, value):
    assert value == pytest.approx(read_cell(text, Symbol.parse(symbol), Units()).value)


@pytest.mark.parametrize("text", ["v_x = -300 mm/s, v_y = 400 mm/s", "-300 î + 400 ĵ", "(-300|400)", "[-300 400]",
                                  "(-300,400)", "(-300.0,400.0) mm/s", "<-300,400>", "(- 300; + 400)",
                                  "vx = - 300, vy = + 400", "vy=400 mm/s vx=-300", "-300.0 400.0"])
def test_two_components_are_read_as_people_write_them(text):
    assert pytest.approx(-0.3 + 0.4j) == read_cell(text, Symbol.parse("v_D"), Units()).value


@pytest.mark.parametrize(("text", "value"), [("1'220", 1.22), ("1.220,5", 1.2205), ("1,220.5", 1.2205)])
def test_thousands_are_read_as_people_part_them(text, value):
    assert pytest.approx(value) == read_cell(text, Symbol.parse("v_D"), Units(), style="").value


@pytest.mark.parametrize("text", ["many", "5 apples", "1 2 3", "nan", "4.8 rad/s", "1 220", "1 220.5", "1 220 168°"])
def test_what_is_no_such_value_says_so(text):
    with pytest.raises(ValueError, match=r"is no|more than one|unit|two components"):
        read_cell(text, Symbol.parse("v_D"), Units())


@pytest.mark.parametrize(
    ("values", "verdict"),
    [
        ({"v_D": "482.7 ←"}, "right"), ({"v_D": "482.7 →"}, "wrong"), ({"v_D": "482.7 180°"}, "right"),
        ({"v_D": "482.7 5° above -x"}, "wrong"), ({"alpha_3": "7"}, "wrong"), ({"v_D": "5e2"}, "wrong"),
        ({"v_D": "0.4827 m/s"}, "right"), ({"omega_3": "2.82 clockwise"}, "right"),
        ({"v_D": [-482.72, 0.0]}, "right"), ({"v_D": [-600.0, 0.0]}, "wrong"),
        ({"v_D": "482.77"}, "within drafting accuracy"),
    ],
)
def test_digits_and_directions_say_what_was_meant_and_pardon_nothing(values, verdict):
    assert verdict == judged(**values)[0]["verdict"]


@pytest.mark.parametrize(
    ("symbol", "text", "verdict"),
    [
        ("v_D", "482.7 mm/s due west", "right"), ("v_D", "482.7 向西", "right"), ("v_D", "482.7 east", "wrong"),
        ("v_D", "482.7 horizontal", "right"), ("v_D", "482.7 竖直", "wrong"), ("v_D", "482.7 e^{i180°}", "right"),
        ("v_B", "1220 south-east", "right"), ("v_B", "1220 NE", "wrong"), ("v_B", "1220 S 50° E", "right"),
        ("v_B", "1220 40° south of east", "right"), ("v_B", "1220 40° north of east", "wrong"),
        ("v_B", "1220 bearing 130°", "right"), ("v_B", "1220 东偏南40°", "right"), ("v_B", "1220 ⊥AB", "right"),
        ("v_B", "1220 mm/s ∥ AB", "wrong"), ("v_B", "1220 垂直于AB，向左上", "wrong"), ("a_B", "12200 B→A", "right"),
        ("a_B", "12200 toward A", "right"), ("a_B", "12200 从A指向B", "wrong"),
        ("v_B", "1220 right and down at 40°", "right"),
        ("v_B", "1.22 m/s, 40° to the horizontal, up and to the right", "wrong"), ("v_B", "934.6 → 784.2 ↓", "right"),
        ("v_B", "0.9346 m/s right, 0.7842 m/s up", "wrong"), ("omega_3", "2.82 into the page", "right"),
        ("omega_3", "2.82 (negative)", "right"), ("omega_3", "2.82 垂直纸面向外", "wrong"),
        ("omega_3", "2.82 im Uhrzeigersinn", "not readable"), ("v_D", "483 mm/s vers la gauche", "not readable"),
    ],
)
def test_directions_are_judged_as_people_write_them(symbol, text, verdict):
    assert verdict == judged(**{symbol: text})[0]["verdict"]


def test_a_direction_in_another_language_is_told_as_what_is_not_read():
    (value,) = judged(v_D="483 mm/s nach links")
    assert "no direction or sense that is read here; write it in English or Chinese" in value["why"]


def test_newtons_are_not_north():
    assert (500.0, None) == (lambda p: (p.value, p.way.angle))(read_cell("500 N", Symbol.parse("F_1/2"), Units()))


@pytest.mark.parametrize(
    ("values", "read"),
    [
        ({"omega_3": "-2,819", "v_B@3": "1075,8 mm/s"}, [-2.819, 1075.8]),
        ({"omega_3": "-2,819", "v_B@3": "1075.8"}, [None, 1075.8]),
        ({"omega_3": "-2,819", "v_B@3": "1,075,800"}, [None, 1075800.0]),
        ({"omega_3": "-2,819", "v_B@3": "1,075.8"}, [-2819.0, 1075.8]),
        ({"v_D": "1.220", "v_B@3": "3.936,6"}, [1220.0, 3936.6]),
        ({"v_D": "1.220", "v_B@3": "1075,8"}, [None, 1075.8]),
        ({"v_D": "1.220.500", "v_B@3": "1.220"}, [1220500.0, None]),
    ],
)
def test_a_comma_or_a_point_is_read_as_the_other_numbers_of_its_row_have_it(values, read):
    assert read == [row["printed"] for row in graphkin.audit(SIXBAR, answers={"Ann": values}).data["values"]]


@pytest.mark.parametrize(("other", "read"), [("3.936,6", 1220.0), ("482,7", None), ("482.7", 1.22)])
def test_a_row_without_a_style_of_its_own_has_the_one_of_its_table(tmp_path, other, read):
    (tmp_path / "a.csv").write_text(f"name;v_D\nLi;1.220\nWu;{other}\n")
    assert read == graphkin.audit(SIXBAR, answers=tmp_path / "a.csv").data["values"][0]["printed"]


def test_a_zero_component_is_zero_to_the_accuracy_of_the_other():
    mapping = {"A": {"v_D": [-0.7, 0.0]}}
    assert "wrong" == graphkin.audit(SIXBAR, answers=mapping).data["values"][0]["verdict"]


def test_a_direction_turned_back_is_called_so():
    assert "the direction is reversed" == judged(v_D="482.7 →")[0]["looks_like"]


def test_the_words_of_the_key_are_right(tmp_path):
    from graphkin.papers.blocks import TableBlock
    from graphkin.papers.documents import answer_key

    for language in ("en", "zh"):
        lesson = graphkin.handout(SIXBAR, language=language).lesson
        (key,) = (b for b in answer_key(lesson).blocks if isinstance(b, TableBlock))
        rows = [
            (str(line.symbol), str(row[2]), row[6])
            for row, line in zip(key.rows, lesson.results, strict=True) if row[6]
        ]
        heads = ",".join(f"{symbol},{symbol} direction" for symbol, _, _ in rows)
        cells = ",".join(f"{value},{way}" for _, value, way in rows)
        found = table(tmp_path, f"name,{heads}\nx,{cells}\n").data["values"]
        assert {"right"} == {v["verdict"] for v in found}


def test_missing_and_unreadable_cells_do_not_stop_the_rest(tmp_path):
    found = table(tmp_path, "学号,姓名,v_D,omega_3\n7,张,482.7,\n8,李,abc,-2.82\n").data["values"]
    expected = [("张", "right"), ("张", "missing"), ("李", "not readable"), ("李", "right")]
    assert expected == [(v["person"], v["verdict"]) for v in found]
    assert {"7", "8"} == {v["id"] for v in found}


def test_points_follow_a_scheme_with_marks_of_the_teacher(tmp_path):
    text = "name,equations,drawing,v_D,omega_3\nA,18,20,482.7,-2.82\nB,10,,482.7,2.82\n"
    people = table(tmp_path, text, grading={"equations": 20, "drawing": 30, "values": 50}).data["people"]
    assert [(88, 100), (35, 70)] == [(p["total"], p["of"]) for p in people]


def test_a_scheme_stands_in_the_scene_too():
    source = graphkin.read(SIXBAR).to_dict() | {"grading": {"v_D": 3, "omega_3": 1}}
    (person,) = graphkin.audit(source, answers={"A": {"v_D": "482.7", "omega_3": "2.82"}}).data["people"]
    assert (3, 4) == (person["total"], person["of"])


def test_a_strange_name_in_a_scheme_is_refused():
    with pytest.raises(CallError, match="no part and no quantity"):
        graphkin.audit(SIXBAR, answers={"A": {"v_D": 480}}, grading={"neatness": 5})


def test_each_student_has_a_slip_and_each_quantity_its_commonest(tmp_path):
    text = "name,v_D,omega_3\nA,482.7,2.819\nB,0.4827,2.819\nC,482.7,-2.82\n"
    data = table(tmp_path, text).data
    assert ["sign", "wrong unit: 0.001 times the right value", None] == [p.get("slip") for p in data["people"]]
    rates = data["quantities"][1]
    assert ("omega_3", "sign", 2, 1) == (rates["symbol"], rates["commonest_slip"], rates["made_by"], rates["right"])


def test_one_table_serves_a_set_of_variants_and_whose_answer_it_is_is_told(tmp_path):
    made = graphkin.problem_set(
        "four-bar-coupler-point", find=["v_P", "omega_3"], variants=2, seed=3, out=tmp_path / "set"
    )
    one, two = (made[name][0].value for name in ("01", "02"))
    (tmp_path / "a.csv").write_text(f"name,variant,v_P\nA,01,{one:.4g}\nB,1,{two:.4g}\nC,2,{two:.4g}\n")
    judged = graphkin.audit("four-bar-coupler-point", answers=tmp_path / "a.csv", variants=tmp_path / "set")
    found = judged.data["values"]
    assert ["right", "wrong", "right"] == [v["verdict"] for v in found]
    assert "the answer of variant 02" == found[1]["looks_like"]


def test_nothing_follows_from_ones_own_values_where_all_are_copied_from_another_problem(tmp_path):
    # of a slower crank: v_D would follow from the copied omega_3
    own = graphkin.read(SIXBAR).to_dict() | {"printed": {}}
    slow = own | {"driver": own["driver"] | {"omega": -8}}
    path = tmp_path / "class.csv"
    path.write_text("name,variant,v_D,omega_3\nAnn,2,482.7,-2.819\n")
    values = graphkin.audit(own, answers=path, variants={"1": own, "2": slow}).data["values"]
    assert [("wrong", "the answer of variant 1")] * 2 == [(v["verdict"], v["looks_like"]) for v in values]


@pytest.mark.parametrize(
    ("answers", "lead"),
    [("at,omega_3\n60,1\n0,2\n", ["at"]), ("name,id,omega_3\nann,7,1\n", ["person", "id"])],
)
def test_the_table_names_of_each_value_what_the_answers_tell_of_it(tmp_path, answers, lead):
    (tmp_path / "class.csv").write_text(answers)
    audited = graphkin.audit("fourbar-150-500-300-400", answers=tmp_path / "class.csv")
    first = [line.split(",")[: len(lead)] for line in answers.splitlines()[1:]]
    assert [*lead, "quantity"] == audited.heads[: len(lead) + 1]
    assert first == [row[: len(lead)] for row in audited.rows]


def test_answers_of_variants_need_their_set(tmp_path):
    with pytest.raises(CallError, match="--variants"):
        table(tmp_path, "name,variant,v_D\nA,01,482.7\n")


def test_no_cell_that_is_written_can_be_a_formula(tmp_path):
    audited = graphkin.audit(SIXBAR, answers={'=HYPERLINK("x")': {"v_D": "482.7", "omega_3": "=1+1"}})
    audited.write(tmp_path)
    tables = [(tmp_path / name).read_text("utf-8-sig") for name in ("audit.csv", "students.csv")]
    cells = [cell for text in tables for row in csv.reader(text.splitlines()) for cell in row]
    assert [] == [c for c in cells if c.startswith("=")]
    assert "'=1+1" in cells


def test_a_table_computed_by_somebody_is_judged_to_its_digits_and_its_slips_are_told():
    turn = graphkin.sweep("shaper-scheme-2", positions=12, find=["v_C", "x_C"])
    rows = [
        {"at": round(float(a), 6), "v_C": f"{abs(v):.3f}", "x_C": f"{x:.3f}"}
        for a, v, x in zip(turn.table.columns[1].values, turn["v_C"], turn["x_C"], strict=True)
    ]
    right = [r["v_C"] for r in rows]
    rows[2]["v_C"], rows[3]["v_C"] = right[3], right[2]  # exchanged with the next row
    rows[5]["v_C"] = right[5][:1] + right[5][2] + right[5][1] + right[5][3:]  # two digits exchanged
    source = graphkin.read("shaper-scheme-2").to_dict()
    source |= {"printed_rows": [{**r, "by": "computation"} for r in rows], "printed": {}}
    wrong = [v for v in graphkin.audit(source).data["values"] if v["verdict"] != "right"]
    assert [rows[2]["at"], rows[3]["at"], rows[5]["at"]] == [v["at"] for v in wrong]
    assert ["another position", "another position", "a slip of the pen"] == [
        v["looks_like"].partition(":")[0].partition(" for")[0] for v in wrong
    ]


def test_the_command_reads_points_and_prints_the_class(tmp_path):
    (tmp_path / "a.csv").write_text("name,equations,v_D\nA,5,482.7\n")
    done = run("audit", SIXBAR, "--answers", "a.csv", "--grading", "equations=10,v_D=10", "--json", cwd=tmp_path)
    assert (0, 15, 20) == (done.returncode, *(json.loads(done.stdout)["people"][0][k] for k in ("total", "of")))


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_tables_of_a_class_are_written_in_both_languages(tmp_path, language):
    answers = {"A": {"v_D": "482.7", "omega_3": "2.82"}}
    audited = graphkin.audit(SIXBAR, answers=answers, language=language, grading={"values": 10})
    audited.write(tmp_path)
    (row,) = csv.DictReader((tmp_path / "students.csv").read_text("utf-8-sig").splitlines())
    heads = {"en": ("total", "of"), "zh": ("总分", "满分")}[language]
    assert ("5", "10") == tuple(row[head] for head in heads)


@pytest.mark.parametrize(
    ("text", "symbol"), [("ω₃", "omega_3"), ("omega3", "omega_3"), ("v_B3", "v_B@3"), ("vD", "v_D"), ("v_D", "v_D")]
)
def test_printed_values_go_by_the_names_that_people_write(text, symbol):
    scene = {**written(SIXBAR)[0], "printed": {text: 1.0}}
    assert [symbol] == [str(one) for one in mechanism_of(scene).question.printed]


def test_a_quantity_printed_under_two_names_is_said():
    scene = {**written(SIXBAR)[0], "printed": {"omega_3": 1.0, "ω3": 2.0}}
    with pytest.raises(graphkin.SceneError, match="omega_3 is given twice"):
        mechanism_of(scene)


@pytest.mark.parametrize(
    ("name", "value", "verdict"),
    [
        ("ω₃", "2.82 clockwise", "right"), ("omega_3", "2.82 逆时针", "wrong"), ("v_D", "0.483 m/s ←", "right"),
        ("v_D (m/s)", "0.483", "right"), ("v_D (m/s)", 0.483, "right"), ("v_D", "0.483 m/s →", "wrong"),
        ("v_B3", "1075.8 mm/s, 12° below x", "right"), ("omega_3", "26.9 rpm cw", "right"), ("alpha_3", "7", "wrong"),
    ],
)
def test_printed_values_are_written_as_in_a_class_table(name, value, verdict):
    scene = {**graphkin.read(SIXBAR).to_dict(), "printed": {name: value}}
    assert [verdict] == [row["verdict"] for row in graphkin.audit(scene).data["values"]]


@pytest.mark.parametrize(("value", "said"), [("483 kg", "kg is no unit of"), ("1,220", "may be 1220 or 1.220")])
def test_a_printed_value_that_cannot_be_read_is_refused_by_name(value, said):
    scene = {**graphkin.read(SIXBAR).to_dict(), "printed": {"v_D": value}}
    with pytest.raises(graphkin.SceneError, match=rf"printed\.v_D.*{said}"):
        graphkin.audit(scene)


def test_no_slip_explains_a_value_by_what_it_would_be_anyway():
    assert "sign" != judged(v_B="1e3")[0].get("looks_like")


TRAIN = {
    "frame": {"name": "0", "points": {"A": [0, 0]}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["A", "B"], "length": 60},
        "3": {"points": ["B", "P"], "length": 20, "start": 30},
    },
    "gears": {
        "sun": {"between": ["1", "3"], "teeth": [36, 24], "carrier": "2"},
        "ring": {"between": ["3", "0"], "teeth": [24, -84], "carrier": "2"},
    },
    "driver": {"link": "2", "angle": 20, "omega": 5},
}  # Willis: omega_3 = 5 (1 - 84/24) = -12.5, omega_1 = 5 + 17.5 * 24/36 = 16.67


@pytest.mark.parametrize(
    ("name", "value", "slip"),
    [
        ("omega_3", "-17.50", "relative to link 2"),
        ("omega_1", "31.25", "teeth exchanged (gear sun)"),  # 5 + 17.5 * 36/24
        ("omega_1", "-6.667", "sense of turning (gear sun)"),  # 5 - 17.5 * 24/36
        ("omega_1", "8.333", "carrier taken as fixed (gear sun)"),  # 12.5 * 24/36
    ],
)
def test_the_usual_slips_with_wheels_have_names(name, value, slip):
    (found,) = graphkin.audit(TRAIN, answers={"x": {name: value}}).data["values"]
    assert slip in found["looks_like"]


def test_points_of_a_contact_are_spelled_as_other_points_are(tmp_path):
    (tmp_path / "a.csv").write_text("name,v_K1,vK2\nx,1,1\n")
    found = graphkin.audit("cam-eccentric-flat-slider", answers=tmp_path / "a.csv").data["values"]
    assert ["v_K@1", "v_K@2"] == [v["symbol"] for v in found]


def test_millimetres_for_inches_are_a_wrong_unit():
    scene = {**graphkin.read("four-bar-coupler-point").to_dict(), "units": {"length": "in"}, "find": ["v_B"]}
    exact = graphkin.audit(scene, answers={"x": {"v_B": 1}}).data["values"][0]["exact"]
    (found,) = graphkin.audit(scene, answers={"x": {"v_B": f"{exact * 25.4:.5g}"}}).data["values"]
    assert "wrong unit: 25.4 times the right value" == found["looks_like"]


@pytest.mark.parametrize(("text", "verdict"), [("1.2e3", "right"), ("1e3", "wrong"), ("1.3e3", "wrong")])
def test_two_digits_are_right_where_they_are_rounded_rightly_and_one_is_not(text, verdict):
    assert verdict == judged(v_B=text)[0]["verdict"]


def test_a_computed_value_a_little_off_is_accused_of_nothing():
    source = graphkin.read("shaper-scheme-2").to_dict() | {"printed": {"by": "computation", "a_C": "4143.1"}}
    (found,) = graphkin.audit(source).data["values"]
    assert ("wrong", None) == (found["verdict"], found.get("looks_like"))


def test_a_template_filled_in_is_read_in_both_languages(tmp_path):
    for language in ("en", "zh"):
        asked = [Symbol.parse("v_D"), Symbol.parse("omega_3")]
        head = answers_template(asked, Units(), language).csv().splitlines()[0]
        found = table(tmp_path, f"{head}\n王,007,482.7,180,-2.82\n").data
        assert ["right", "right"] == [v["verdict"] for v in found["values"]]
        assert [("王", "007")] == [(p["person"], p["id"]) for p in found["people"]]
        assert "unused" not in found


def test_components_with_words_are_read_with_units_that_hold_a_digit():
    read = read_cell("1590.8 mm/s² right, 2852.1 mm/s² down", Symbol.parse("a_B"), Units())
    assert complex(1.5908, -2.8521) == pytest.approx(read.value)


@pytest.mark.parametrize(
    ("text", "slip"),
    [
        ("7500; -12990", "the sign of the x component"), ("-7500; 12990", "the sign of the y component"),
        ("-12990; -7500", "x and y components exchanged"), ("7500; 12990", "sign"),
    ],
)
def test_a_slip_in_two_components_is_named_not_taken_for_another_position(text, slip):
    four_bar = "fourbar-150-500-300-400"  # a_B = (-7500, -12990.4)
    (value,) = graphkin.audit(four_bar, answers={"A": {"a_B": text}}).data["values"]
    assert ("wrong", slip) == (value["verdict"], value["looks_like"])


@pytest.mark.parametrize("unit", ["米/秒²", "m/秒2", "米/秒平方", "米每二次方秒", "米每平方秒", "米·秒-2"])
def test_accelerations_in_chinese_units_are_read(unit, tmp_path):
    (tmp_path / "class.csv").write_text(f"name,a_B@3\np,3.937 {unit}\n", encoding="utf-8")
    (value,) = graphkin.audit("sixbar-guide-40deg", answers=tmp_path / "class.csv").data["values"]
    assert "right" == value["verdict"]


@pytest.mark.parametrize("data", [
    "name,v_D\rJosé,482.7\r".encode(), "\ufeffname,\ufeffv_D\nJosé,482.7\u200b\n".encode(),
], ids=["line ends of a Mac", "signs without width"])
def test_a_table_is_read_as_other_programs_write_it(data, tmp_path):
    (tmp_path / "class.csv").write_bytes(data)
    (value,) = graphkin.audit("sixbar-guide-40deg", answers=tmp_path / "class.csv").data["values"]
    assert ("José", "right") == (value["person"], value["verdict"])
