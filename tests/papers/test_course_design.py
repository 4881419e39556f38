from __future__ import annotations

import csv
import io
import re
from types import SimpleNamespace

import pytest
from pypdf import PdfReader

import graphkin
from graphkin import CallError, solver
from graphkin.checking.readings import report_on
from graphkin.construction import execute, plan_with_forces
from graphkin.papers.courses import PlaceValues, Scheme, _value_tables, dealt_out, read_at
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import Symbol
from tests import command

SCENE = "slider-crank-offset"


def _file(folder, text, name="names.csv"):
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


def test_one_report_without_a_class_stands_at_the_position_asked_for(tmp_path):
    done = command.run("handout", SCENE, "--template", "course-design", "--at", "75", "--lang", "both",
                       "--positions", "4", "-o", "out", cwd=tmp_path)
    assert 0 == done.returncode, done.stderr
    names = {"report.html", "report.pdf", "class.html", "class.pdf", "class.csv", "answers_template.csv"}
    assert names == {path.name for path in (tmp_path / "out").iterdir()}
    pages = "".join(page.extract_text() for page in PdfReader(tmp_path / "out" / "report.pdf").pages)
    for words in ("Course design", "课程设计说明书", "Driver at 75°", "Structure", "Equation 1", "Motion diagrams"):
        assert words in pages


def test_everyone_has_a_position_of_their_own_and_stands_in_the_table_of_the_class(tmp_path):
    names = _file(tmp_path, "学号,姓名,位置\n1,李华,\n2,王芳,1\n3,=1+1,\n")
    made = graphkin.course_design(SCENE, students=names, find=["v_C"], positions=4, formats=("html",))
    assert ["2", "1", "3"] == [student.place for student, _ in made.rows]
    for name, (_, values) in zip(sorted(n for n in made.files if n[0].isdigit()), made.rows, strict=True):
        loops = graphkin.draw(SCENE, at=values.driver, figures=["loops"]).figures["loops"]
        numbers = set(re.findall(r"\d+\.\d{3,}", re.sub("<[^>]*>", " ", loops.content("svg").decode())))
        assert numbers
        assert numbers <= set(re.findall(r"\d+\.\d{3,}", made.files[name].decode()))
    for row in made.data["students"]:
        exact = graphkin.check(SCENE, at=row["at"], find="v_C")["v_C"].exact
        assert abs(exact) == pytest.approx(row["values"]["v_C"], rel=1e-9, abs=1e-9)
    rows = list(csv.reader(io.StringIO(made.files["class.csv"].decode("utf-8-sig"))))
    assert ["李华", "1", "", "2"] == rows[1][:4]
    assert "'=1+1" == rows[3][0]  # no spreadsheet runs it
    assert 3 == sum(name[0].isdigit() for name in made.files)
    heads = re.findall(r'<span lang="en">([^<]*)</span>', made.files["class.html"].decode().partition("<table")[2])
    assert ["Name", "number", "position", "driver (°)"] == heads[:4]  # of no scheme


def test_the_template_of_a_course_is_read_by_the_audit(tmp_path):
    names = _file(tmp_path, "name\nA\nB\n")
    made = graphkin.course_design(SCENE, students=names, find=["v_C"], positions=2, formats=("html",))
    lines = list(csv.reader(io.StringIO(made.files["answers_template.csv"].decode("utf-8-sig"))))
    for line, (_, values) in zip(lines[1:], made.rows, strict=True):
        line[4] = f"{next(iter(values.exact.values())):.6g}"
    text = "\n".join(",".join(line) for line in lines)
    assert graphkin.audit(SCENE, answers=_file(tmp_path, text, "filled.csv")).ok
    blanks = re.findall(r'<div><span lang="en">([^<]*)</span></div>', made.files["01-A-1.html"].decode())
    assert ["Class, number", "Teacher", "Date"] == blanks  # the name is there


def test_a_force_is_told_without_and_with_a_load_that_begins_just_there():
    engine = graphkin.read("engine-gas-force").to_dict()
    engine["loads"]["gas"]["when"] = {"driver": [30, 180]}
    scene, asked = mechanism_of(graphkin.read(engine)), (Symbol.parse("M_2"),)
    motion = solver.solve(scene)
    report = report_on(execute(plan_with_forces(motion.structure, None, (), ())), motion)
    place = read_at("1", 0.5, scene, report, asked)
    assert {"M_2": 66.423, "M_2+": -116.309} == {str(s): pytest.approx(v, abs=1e-3) for s, v in place.read.items()}
    lesson = SimpleNamespace(said=lambda *_, **__: "", letters=SimpleNamespace(vector=str), unit=str)
    (table,) = _value_tables(lesson, (), ((),), (place,), asked, "°")
    assert "66.423 / −116.31" == table.rows[0][-1]


def test_schemes_are_dealt_out_one_after_the_other(tmp_path):
    rows = _file(tmp_path, "scheme,links.1.length\nI,23.8\nII,20\n", "schemes.csv")
    names = _file(tmp_path, "name,scheme\nA,\nB,\nC,\nD,II\n")
    made = graphkin.course_design(SCENE, students=names, rows=rows, find=["v_C"], positions=2, formats=("html",))
    assert [("I", "1"), ("I", "2"), ("II", "1"), ("II", "2")] == [
        (student.scheme, student.place) for student, _ in made.rows
    ]
    assert "links.1.length" in made.files["01-A-I-1.html"].decode()


@pytest.mark.parametrize("lines", ["A,,1\nB,I,\nC,II,2\nD,,\n", "A,I,1\nB,,1\nC,,2\nD,,\n", "A,I,\nB,,1\nC,,\nD,,\n"])
def test_no_two_students_have_the_same_paper_where_some_give_a_position_and_no_scheme(tmp_path, lines):
    places = {name: PlaceValues(name, 1.0, {Symbol.parse("v_C"): 1.0}) for name in "12"}
    course = {name: Scheme(name, mechanism_of(SCENE), (), {}, places) for name in ("I", "II")}
    dealt = dealt_out(_file(tmp_path, "name,scheme,position\n" + lines), course)
    assert {("I", "1"), ("I", "2"), ("II", "1"), ("II", "2")} == {(who.scheme, who.place) for who in dealt}


def test_of_several_columns_with_a_head_of_names_the_first_is_read(tmp_path):
    places = {"1": PlaceValues("1", 1.0, {Symbol.parse("v_C"): 1.0})}
    course = {"": Scheme("", mechanism_of(SCENE), (), {}, places)}
    dealt = dealt_out(_file(tmp_path, "Name ,学号,student,id\nann,7,Ann Lee,8\nbob\n"), course)
    assert [("ann", "7"), ("bob", "")] == [(who.name, who.id) for who in dealt]


def test_a_student_whose_position_cannot_be_drawn_is_told_with_the_line(tmp_path):
    places = {"1": PlaceValues("1", 1.0, {Symbol.parse("v_C"): 1.0}), "2": PlaceValues("2", 2.0)}
    course = {"": Scheme("", mechanism_of(SCENE), (), {}, places)}
    with pytest.raises(CallError, match=r"line 3.*position 2 cannot be drawn"):
        list(dealt_out(_file(tmp_path, "name,position\nann,1\nbob,2\n"), course))


def test_schemes_without_their_data_are_refused_and_groups_are_not(tmp_path):
    wished = {"find": ["v_C"], "positions": 2, "formats": ("html",)}
    with pytest.raises(CallError, match=r"方案: schemes without their data: I, II; .*--rows"):
        graphkin.course_design(SCENE, students=_file(tmp_path, "姓名,方案\nA,I\nB,II\nC,\n"), **wished)
    for text in ("姓名,方案\nA,\nB,\n", "name,group\nA,I\nB,II\n", "name,group,position\nA,I,1\nB,II,\n"):
        made = graphkin.course_design(SCENE, students=_file(tmp_path, text), **wished)
        assert ["1", "2"] == [student.place for student, _ in made.rows]  # no two have the same paper
    rows = _file(tmp_path, "scheme,links.1.length\nI,23.8\n", "schemes.csv")
    with pytest.raises(CallError, match='line 2: there is no scheme "II"'):
        graphkin.course_design(SCENE, students=_file(tmp_path, "name,scheme\nA,II\n"), rows=rows, **wished)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("colour\nred\n", "no column of names"),
        ("name,position\nA,99\n", 'line 2: there is no position "99"'),
    ],
)
def test_what_is_wrong_with_a_table_of_students_is_said(tmp_path, text, said):
    with pytest.raises(CallError, match=said):
        graphkin.course_design(SCENE, students=_file(tmp_path, text), find=["v_C"], positions=2)


def test_a_template_that_there_is_not_is_said(tmp_path):
    done = command.run("handout", SCENE, "--template", "course-desing", cwd=tmp_path)
    assert 2 == done.returncode
    assert 'did you mean "course-design"' in done.stderr


def test_schemes_of_a_course_are_drawn_as_a_set_of_problems_is(tmp_path):
    names = _file(tmp_path, "name\nA\nB\nC\n")
    made = graphkin.course_design(
        SCENE, students=names, find=["v_C"], positions=2, formats=("html",), variants=2, seed=4
    )
    assert ["01", "01", "02"] == [student.scheme for student, _ in made.rows]
    whole = made.files["01-A-01-1.html"].decode()
    assert all(f'<span lang="en">{head}</span></th>' in whole for head in ("AB", "BC", "h.y"))
