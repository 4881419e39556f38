"""Refusals in the language that is asked for: each clause of the program has its translation, names are kept."""

from __future__ import annotations

import ast
import json
import re
from collections.abc import Iterator
from dataclasses import MISSING, fields
from pathlib import Path

import pytest
from graphkin.words.refused import clauses, refused

import graphkin
from graphkin.api.report_text import report_text
from graphkin.errors import Problem
from graphkin.scene import reading
from graphkin.scene.design_file import KINDS
from graphkin.scene.file_table import keys_of
from graphkin.scene.source import library_text
from tests.command import run

ROOMS = Path(graphkin.__file__).parent
GAP = re.compile(r"\{\d?\}")
PARTS = {"drive a sliding pair: ", "it may be ", "write ", "paste one of these at the head of the file:\n", " or 0",
         ", and link {} slides on it or it on link {}", " and another with link {}",
         "{} redundant, is not counted: only a link that repeats what others hold may be marked so",
         ": write in the file [driver] with link, angle and omega, or with slide, travel and velocity"}  # fmt: skip
"""What is put together with something else before it is a clause; the clauses themselves have a translation."""


def written(node: ast.expr) -> str | None:
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        return node.value
    if isinstance(node, ast.JoinedStr):
        return "".join(v.value if isinstance(v, ast.Constant) else "{}" for v in node.values)
    return None


def literals(node: ast.expr) -> Iterator[str]:
    text = written(node)
    if text is not None:
        yield text
        return
    inside = {ast.IfExp: ("body", "orelse"), ast.BinOp: ("left", "right")}.get(type(node), ())
    for part in [getattr(node, name) for name in inside] + getattr(node, "values", []):
        yield from literals(part)


def clauses_made() -> Iterator[str]:
    for path in sorted(ROOMS.rglob("*.py")):
        source = path.read_text(encoding="utf-8")
        if "Problem(" in source:
            yield from clauses_of(ast.parse(source))


def clauses_of(module: ast.Module) -> Iterator[str]:
    """The clauses of the problems that a module makes, as they stand there or in variables and arguments."""
    named = set()
    for call in ast.walk(module):
        if isinstance(call, ast.Call) and getattr(call.func, "id", "") == "Problem":
            for part in (*call.args[1:], *(k.value for k in call.keywords if k.arg != "where")):
                yield from literals(part)
                if isinstance(part, ast.Name):
                    named.add(part.id)
    made = {f.name: [a.arg for a in f.args.args] for f in ast.walk(module) if isinstance(f, ast.FunctionDef)}
    for node in ast.walk(module):
        if isinstance(node, ast.Assign | ast.AugAssign | ast.NamedExpr):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            values = [(target, node.value) for target in targets]
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
            values = [*zip(map(ast.Name, made.get(node.func.id, ())), node.args, strict=False)]
            values += [(ast.Name(k.arg or ""), k.value) for k in node.keywords]
        else:
            continue
        for target, value in values:
            pairs = [(target, value)]
            if isinstance(target, ast.Tuple) and isinstance(value, ast.Tuple):
                pairs = [*zip(target.elts, value.elts, strict=True)]
            for name, said in pairs:
                if isinstance(name, ast.Name) and name.id in named:
                    yield from (text.removeprefix("; ") for text in literals(said) if " " in text)


def is_said(text: str) -> bool:
    """Whether a clause says something in words: quotation marks, commands and gaps alone need no translation."""
    return bool(re.search("[a-z]{3}", re.sub(r'"[^"]*"|pip install.*', "", text)))


def test_every_clause_of_a_refusal_has_a_chinese_one():
    known = clauses("zh")
    assert [] == sorted({c for c in clauses_made() if is_said(c) and c not in known and c not in PARTS})


def test_what_a_key_is_about_has_chinese():
    about = {
        reading.clause_of(one.metadata.get("description", "")) for _, table in reading._TABLES for one in keys_of(table)
    }
    # of a design what must be given is named where it is missing
    about |= {one.metadata["description"] for made in KINDS.values() for one in fields(made) if one.default is MISSING}
    assert [] == sorted(text for text in about if refused(text, "zh") == text != "")


def test_clauses_have_the_same_gaps_in_chinese():
    assert {} == {e: z for e, z in clauses("zh").items() if len(GAP.findall(e)) != len(GAP.findall(z))}


@pytest.mark.parametrize(("chinese", "english"), [
    ("读到 -5，长度为负", "found -5, a negative length"),
    ("构件 2, 3", "links 2, 3"),
    ("没有构件“9”", 'there is no link "9"'),
    ("可用的有：1, 2, 3", "known here: 1, 2, 3"),
    ("是否指“length”？", 'did you mean "length"?'),
    ("请从构件 2 去掉 B，或去掉销", "take B away from link 2, or the pin away"),
    ("可为 \"mm\", \"cm\" 之一，是否指“cm”？", 'one of "mm", "cm" is possible, did you mean "cm"?'),
    ("构件 4, 5 在 1 = 58.9° 处到达运动的尽头；运动范围从 -58.9° 到 58.9°",
     "links 4, 5 reach the end of their motion at 1 = 58.9 deg; the motion reaches from -58.9 deg to 58.9 deg"),
    ("不能装配：构件 4, 5：在机构自身的位置上它们够不着彼此；以这些长度，原动件取何值都不能装配",
     "not assembled: links 4, 5: they do not reach each other in the scene's own position; "
     "no value of the driver assembles them with these lengths"),
])  # fmt: skip
def test_a_clause_is_known_again_with_what_stands_in_it(chinese, english):
    assert chinese == refused(english, "zh")


@pytest.mark.parametrize("own", ["links.2.length", "my scene; links of the and at", "known only to me", ""])
def test_names_and_what_no_table_has_stay_as_they_are(own):
    assert own == refused(own, "zh")


def test_what_stands_in_quotation_marks_is_not_translated():
    assert "没有构件“the file”" == refused('there is no link "the file"', "zh")


def test_english_stays_as_it_was_made():
    assert "links 2, 3 have parallel guides" == refused("links 2, 3 have parallel guides", "en")


def test_lines_to_be_pasted_are_kept():
    problem = Problem("links 2, 3", "nothing holds it", "paste one of these at the head of the file:\nC = [1, 2]")
    said = problem.text(lambda text: refused(text, "zh"), "：", "；")
    assert "构件 2, 3：没有任何约束；请把以下之一粘贴到文件开头：\nC = [1, 2]" == said


@pytest.fixture(scope="module")
def broken(tmp_path_factory) -> str:
    path = tmp_path_factory.mktemp("scenes") / "broken.toml"
    path.write_text(
        'title = "x"\n[frame]\nname = "4"\npoints = { A = [0, 0] }\n[links.1]\npoints = ["A", "B"]\nlength = -5\n'
        '[links.2]\npoints = ["B", "C"]\nlenght = 4\n[driver]\nlink = "9"\nomega = 1\n',
        encoding="utf-8",
    )
    return str(path)


def test_each_problem_of_a_file_is_said_in_chinese_on_a_line_of_its_own(broken):
    done = run("check", broken, "--lang", "zh")
    assert (2, "", [
        "graphkin: links.2.lenght：没有这个键；是否指“length”？",
        "graphkin: links.1.length：读到 -5，长度为负；长度应为正",
        "graphkin: driver.link：没有构件“9”；可用的有：1, 2",
    ]) == (done.returncode, done.stdout, done.stderr.splitlines())  # fmt: skip


def test_in_both_languages_the_english_lines_stand_first(broken):
    done, english = run("draw", broken, "--lang=both"), run("draw", broken)
    lines = done.stderr.splitlines()
    assert (2, english.stderr.splitlines(), 6) == (done.returncode, lines[:3], len(lines))


@pytest.mark.parametrize(("status", "said", "call"), [
    (3, "原动件 1/4 位于 270 mm：不能装配：构件 2, 3 在 1/4 = 200 mm 处到达运动的尽头；运动范围从 -200 mm 到 200 mm",
     ("check", "elliptic-trammel", "--at", "270")),
    (2, "缺少参数“SCENE”", ("draw",)),
    (2, "没有命令“drw”；是否指 'draw'？", ("drw",)),
    (2, "没有选项 --positionz；是否指 --positions？", ("sweep", "shaper-scheme-2", "--positionz", "3")),
])  # fmt: skip
def test_a_call_is_refused_in_chinese_with_the_same_status(status, said, call):
    done = run(*call, "--lang", "zh")
    assert (status, f"graphkin: {said}\n") == (done.returncode, done.stderr)


def test_what_is_printed_for_programs_says_the_same_in_every_language():
    call = ("solve", "elliptic-trammel", "--at", "270", "--json")
    english, chinese = run(*call), run(*call, "--lang", "zh")
    assert json.loads(english.stdout) == json.loads(chinese.stdout)


@pytest.mark.parametrize("name", ["scissor-lift", "shaper-scheme-2", "gears-epicyclic"])
def test_a_report_in_chinese_has_no_english_in_its_steps_and_equations(name):
    text = report_text(graphkin.check(name), "zh")
    assert [] == re.findall(r"\b(?:seen|from|given|the|of|on|link|links)\b", text)


ENGLISH = re.compile(r"[a-z]{3,} [a-z]{2,}")


def test_a_scene_without_a_driver_is_refused_in_chinese(tmp_path):
    text = re.sub(r"\[driver\][^\[]*", "", library_text("sixbar-420rpm"))
    (tmp_path / "still.toml").write_text(text, encoding="utf-8")
    for command in ("check", "explain"):
        done = run(command, str(tmp_path / "still.toml"), "--lang", "zh")
        assert (2, [
            "graphkin: 自由度：F = 3*5 - 2*7 = 1，但没有给原动件；自由度为 1 的机构需要同样多的原动件："
            "请在文件中写 [driver]，含 link、angle 和 omega，或含 slide、travel 和 velocity",
        ]) == (done.returncode, done.stderr.splitlines())  # fmt: skip


def test_what_cannot_be_solved_is_told_in_chinese_beside_the_results_too(tmp_path):
    solved = run("solve", "sixbar-AE70", "--at", "100", "--lang", "zh")
    swept = run("sweep", "sixbar-420rpm", "--set", "links.2.length=0.01,0.34", "-o", str(tmp_path), "--lang", "zh")
    assert (3, 0) == (solved.returncode, swept.returncode)
    assert "\n不能装配：构件 4, 5" in solved.stdout
    assert "2 个方案：1 不能装配, 1 可解\n" in swept.stdout
    assert [None, None] == [ENGLISH.search(one.stdout.replace(str(tmp_path), "")) for one in (solved, swept)]


def test_two_clauses_that_stand_in_a_third_are_both_known():
    said = "not assembled: links 2, 3: they do not reach each other in the scene's own position; the nearest position "
    assert "不能装配：构件 2, 3：在机构自身的位置上它们够不着彼此；最近的能装配的位置在 1 = -14.6°" == (
        refused(f"{said}where they do is at 1 = -14.6 deg", "zh"))  # fmt: skip
