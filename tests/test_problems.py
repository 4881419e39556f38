"""What is wrong, in the language that is asked for: each phrase has its words in every table, names are kept."""

from __future__ import annotations

import ast
import json
import re
import string
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest

import graphkin
import graphkin.scene.designs
from graphkin.api.report_text import report_text
from graphkin.errors import CallError, GraphkinError, Problem, SceneError
from graphkin.scene.scene import library_text
from graphkin.scene.tables import FileTable, key_of, keys_of, meaning
from graphkin.words import Phrase, area, from_others, say, word
from tests.command import run

ROOMS = Path(graphkin.__file__).parent
TABLE = tomllib.loads((ROOMS / "words" / "en.toml").read_text(encoding="utf-8"))
ENGLISH = {key: text for words in TABLE.values() for key, text in words.items()}


def calls(*names: str) -> Iterator[tuple[str, ast.Call, frozenset[str]]]:
    """Where something of these names is called, the call, and the gaps that are filled there."""
    for path in sorted(ROOMS.rglob("*.py")):
        for call in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if not isinstance(call, ast.Call) or None in {k.arg for k in call.keywords}:
                continue
            if (getattr(call.func, "attr", "") or getattr(call.func, "id", "")) in names:
                yield f"{path.name}:{call.lineno}", call, frozenset(k.arg for k in call.keywords if k.arg)


def phrases_made() -> Iterator[tuple[str, str, frozenset[str]]]:
    """Where a phrase with named gaps is made, its key, and the gaps that are filled there."""
    for where, call, filled in calls("Phrase"):
        if len(call.args) == 1 and isinstance(call.args[0], ast.Constant):
            yield where, call.args[0].value, filled


def gaps(text: str) -> frozenset[str]:
    return frozenset(name for _, name, _, _ in string.Formatter().parse(text) if name is not None)


def test_every_phrase_is_made_with_the_gaps_of_its_table():
    made = [(where, key, filled) for where, key, filled in phrases_made() if filled or key in TABLE["problems"]]
    assert 400 < len(made)
    assert [] == [(where, key) for where, key, filled in made if filled != gaps(word(key, otherwise="{unknown}"))]


def test_a_problem_told_by_ids_fills_the_gaps_of_both_and_no_others():
    told = []
    for where, call, filled in calls("Problem", "say", "of", "unfit"):
        texts = [arg.value for arg in call.args[1:] if isinstance(arg, ast.Constant)]
        told.append((where, [key for key in texts if key in TABLE["problems"]], filled))
    assert 400 < sum(bool(keys) for _, keys, _ in told)
    wanted = [frozenset().union(*(gaps(ENGLISH[key]) for key in keys)) for _, keys, _ in told]
    assert [] == [(where, keys) for (where, keys, filled), all_ in zip(told, wanted, strict=True)
                  if keys and filled != all_]


def test_every_phrase_of_a_problem_is_made_somewhere():
    written = "".join(path.read_text(encoding="utf-8") for path in ROOMS.rglob("*.py"))
    keys = {key.removesuffix(" one") for key in area("problems") if not key.startswith(("noun ", "status "))}
    assert [] == sorted(key for key in keys if f'"{key}"' not in written and f'"{key} one"' not in written)


def test_every_problem_has_other_words_in_chinese():
    neutral = re.compile(r'"[^"]*"|\{\w+\}|pip install.*')
    same = [key for key, text in area("problems", "zh").items() if text == area("problems")[key]]
    assert [] == [key for key in same if re.search("[a-z]{3}", neutral.sub("", ENGLISH[key]))]


def test_what_the_words_tell_of_keys_is_of_keys_that_there_are():
    keys = {f"{table.__name__}.{key_of(key)}" for table in FileTable.__subclasses__() for key in keys_of(table)}
    assert [] == sorted(area("keys").keys() - keys)


def test_every_key_has_its_meaning_in_words_or_a_name_that_says_it():
    telling = {"SceneTables.units", "SceneTables.frame", "SceneTables.sheet", "SheetWishes.paper",
               "SheetWishes.orientation", "SheetWishes.convention", "SheetWishes.language"}
    silent = {f"{table.__name__}.{key_of(key)}" for table in FileTable.__subclasses__() for key in keys_of(table)
              if not meaning(table, key_of(key)) and table.__name__ != "Design"}
    assert telling == silent


@pytest.mark.parametrize(("chinese", "sentence"), [
    ("没有命令“drw”；是否指 'draw'？", "No such command 'drw'. Did you mean 'draw'?"),
    ("没有这个文件或文件夹", "No such file or directory"),
    ("多出几个参数（a b）", "Got unexpected extra argument(s) (a b)"),
    ("第 1 行第 2 列（字符 1）：应为双引号中的键名",
     "Expecting property name enclosed in double quotes: line 1 column 2 (char 1)"),
    ("已有同名文件", FileExistsError(17, "File exists")),
    ("压缩包中没有 'geogebra.xml'", KeyError("There is no item named 'geogebra.xml' in the archive")),
    ("a sentence that no table has", "a sentence that no table has"),
])
def test_sentences_of_other_programs_are_known_by_their_words(chinese, sentence):
    assert chinese == say(from_others(sentence), "zh")


@pytest.mark.parametrize(("chinese", "english", "problem"), [
    ("links.2.length：读到 -5，长度为负；长度应为正",
     "links.2.length: found -5, a negative length; a length must be positive",
     Problem("links.2.length", Phrase("found a negative", value="-5", noun=Phrase("noun length")),
             Phrase("a must be positive", noun=Phrase("noun length")))),
    ("构件 2, 3：没有任何约束", "links 2, 3: nothing holds it",
     Problem(Phrase("links", links="2, 3"), Phrase("nothing holds it"))),
    ("name：the links of a title", "name: the links of a title", Problem("name", "the links of a title")),
])
def test_a_problem_is_said_in_each_language_with_what_stands_in_it(chinese, english, problem):
    assert (chinese, english, english) == (problem.text("zh"), problem.text("en"), str(problem))


def test_an_error_says_each_of_its_problems_in_a_language_and_is_english_itself():
    error = CallError(Problem("a", Phrase("is missing")), Problem("b", Phrase("is missing"), Phrase("give it once")))
    assert "a：没有给出\nb：没有给出；请只给一次" == error.text("zh")
    assert "a: is missing\nb: is missing; give it once" == str(error)


def test_lines_to_be_pasted_are_kept():
    pasted = Phrase("paste one of these at the head of the file", rows="C = [1, 2]")
    problem = Problem("x", Phrase("nothing holds it"), pasted)
    assert "x：没有任何约束；请把以下之一粘贴到文件开头：\nC = [1, 2]" == problem.text("zh")


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
        "graphkin: driver.link：没有构件“9”；可用的有：1、2",
    ]) == (done.returncode, done.stdout, done.stderr.splitlines())


def test_in_both_languages_the_english_lines_stand_first(broken):
    done, english = run("draw", broken, "--lang=both"), run("draw", broken)
    lines = done.stderr.splitlines()
    assert (2, english.stderr.splitlines(), 6) == (done.returncode, lines[:3], len(lines))


@pytest.mark.parametrize(("status", "said", "call"), [
    (3, "原动件 1/4 位于 270 mm：不能装配：构件 2、3 在 1/4 = 200 mm 处到达运动的尽头；运动范围从 -200 mm 到 200 mm",
     ("check", "elliptic-trammel", "--at", "270")),
    (3, "原动件 1 位于 170°：不能装配：构件 4、5 在 1 = 58.99728087° 处到达运动的尽头；"
        "运动范围从 -58.99728087° 到 58.99728087°",
     ("check", "sixbar-AE70", "--at", "170")),
    (2, "sweep：0 个位置；请给 1 到 10000000 之间的整数", ("solve", "elliptic-trammel", "--sweep", "0")),
    (2, "缺少参数“SCENE”", ("draw",)),
    (2, "没有命令“drw”；是否指 'draw'？", ("drw",)),
    (2, "没有选项 --positionz；是否指 --convention、--positions？", ("sweep", "shaper-scheme-2", "--positionz", "3")),
])
def test_a_call_is_refused_in_chinese_with_the_same_status(status, said, call):
    done = run(*call, "--lang", "zh")
    assert (status, f"graphkin: {said}\n") == (done.returncode, done.stderr)


@pytest.mark.parametrize(("name", "old", "new", "said"), [
    ("cam-offset-roller", ', by = "cycloidal"', "", r'没有写运动规律；by = "\w+"、.*" 或 "\w+"$'),
    ("disc-on-disc", '"2.w"]', '"1.k"]', "：1.k 和 1.k 是同一构件 1 的轮廓"),
    ("oldham-coupling", "[driver]", '[loads.Q]\non = "2"\nforce = 3\nagainst = "2"\n[driver]', "“2”可以是 2/1 或 2/3"),
])
def test_names_in_a_refusal_are_joined_in_its_language(name, old, new, said):
    text = library_text(name)
    assert old in text
    with pytest.raises(SceneError) as refused:
        graphkin.read(tomllib.loads(text.replace(old, new)))
    assert re.search(said, refused.value.text("zh"), re.MULTILINE)


@pytest.mark.parametrize(("english", "chinese", "name", "tables"), [
    ("does not come back: a turn leaves the follower at 20; all that rises falls again",
     "没有回到原处：转一周后从动件的位移为 20；升程应等于回程", "cam-flat-face",
     {"cams": {"1": {"base": {"r": 40}, "follower": "2", "law": [{"to": 150, "rise": 20, "by": "345"}, {"to": 360}]}}}),
    ('found "2"; a whole number is wanted', "读到 \"2\"；应为整数", "shaper-forces", {"positions": {"count": "2"}}),
    ("positions.show.1: found a table; a text is wanted", "positions.show.1：读到表；应为文字", "shaper-forces",
     {"positions": {"show": [{"a": 1}]}}),
    ('title: found ["a", 2, ...]; a text', 'title：读到 ["a", 2, ...]；应为文字', "whitworth",
     {"title": ["a", 2, {"a": 1}]}),
    ("between: found nothing; two different points", "between：读到无；应为两个不同的点", "rocker-return-spring",
     {"springs": {"R": {"between": [], "rate": 1, "free": 1}}}),
    ("names no point; write for example a_B, a_B@3, a_C/B", "没有写点；例如写 a_B、a_B@3、a_C/B", "whitworth",
     {"find": ["a_9"]}),
    ("position 7: the scene has no [positions]", "位置 7：机构文件没有 [positions] 表", "whitworth", {}),
])
def test_a_refusal_names_its_values_in_its_language(english, chinese, name, tables):
    with pytest.raises(GraphkinError) as refused:
        graphkin.check({**tomllib.loads(library_text(name)), **tables}, at="7")
    assert english in refused.value.text()
    assert chinese in refused.value.text("zh")


def test_a_design_file_with_an_empty_table_is_refused_in_words():
    with pytest.raises(SceneError) as refused:
        graphkin.design({"design": {}})
    assert "design: is missing; a design file has a table [design] with kind and its data" == refused.value.text()


def test_a_list_of_pairs_that_is_too_short_is_refused_in_chinese():
    with pytest.raises(SceneError) as refused:
        graphkin.design({"design": {"kind": "function", "frame": 100, "pairs": [[60, 20], [75, 45]]}})
    assert "design.pairs：读到 2 个；应给三个 [曲柄角, 摇杆角]" == refused.value.text("zh")


@pytest.mark.parametrize(("said", "name", "text"), [
    ("c：不是 XML：第 1 行第 15 列：标签不配对；请在 Linkage 中重新保存", "c.linkage2", "<linkage2><a></linkage2>"),
    ("c：不是 pylinkage 的机构：运动副 A 没有位置；请重新保存", "c.json",
     '{"joints": [{"id": "A", "type": "ground"}], "links": []}'),
    ("c：不是 pylinkage 的机构：id：没有给出；请重新保存", "c.json", '{"joints": [{"type": "ground"}], "links": []}'),
    ("c：不是 JSON：第 1 行第 2 列（字符 1）：应为双引号中的键名；请在 pylinkage 中重新保存", "c.json", "{"),
])
def test_a_file_of_another_program_is_refused_in_chinese(tmp_path, said, name, text):
    (tmp_path / name).write_text(text, encoding="utf-8")
    done = run("convert", str(tmp_path / name), "--lang", "zh")
    assert (2, f"graphkin: {said}\n") == (done.returncode, done.stderr)


def test_what_is_printed_for_programs_says_the_same_in_every_language():
    call = ("solve", "elliptic-trammel", "--at", "270", "--json")
    english, chinese = run(*call), run(*call, "--lang", "zh")
    assert json.loads(english.stdout) == json.loads(chinese.stdout)


@pytest.mark.parametrize("name", ["scissor-lift", "shaper-scheme-2", "gears-epicyclic"])
def test_a_report_in_chinese_has_no_english_in_its_steps_and_equations(name):
    text = report_text(graphkin.check(name), "zh")
    assert [] == re.findall(r"\b(?:seen|from|given|the|of|on|link|links)\b", text)


ENGLISH_WORDS = re.compile(r"[a-z]{3,} [a-z]{2,}")


def test_a_scene_without_a_driver_is_refused_in_chinese(tmp_path):
    text = re.sub(r"\[driver\][^\[]*", "", library_text("sixbar-420rpm"))
    (tmp_path / "still.toml").write_text(text, encoding="utf-8")
    for command in ("check", "explain"):
        done = run(command, str(tmp_path / "still.toml"), "--lang", "zh")
        assert (2, [
            "graphkin: 自由度：F = 3*5 - 2*7 = 1，但没有给原动件；自由度为 1 的机构需要同样多的原动件；"
            "请在文件中写 [driver]，用 link、angle 和 omega，或用 slide、travel 和 velocity",
        ]) == (done.returncode, done.stderr.splitlines())


def test_what_cannot_be_solved_is_told_in_chinese_beside_the_results_too(tmp_path):
    solved = run("solve", "sixbar-AE70", "--at", "100", "--lang", "zh")
    swept = run("sweep", "sixbar-420rpm", "--set", "links.2.length=0.01,0.34", "-o", str(tmp_path), "--lang", "zh")
    assert (3, 0) == (solved.returncode, swept.returncode)
    assert "\n不能装配：构件 4、5" in solved.stdout
    assert "2 个方案：1 不能装配、1 可解\n" in swept.stdout
    assert [None, None] == [ENGLISH_WORDS.search(one.stdout.replace(str(tmp_path), "")) for one in (solved, swept)]


def test_clauses_in_chinese_are_parted_by_chinese_marks(tmp_path):
    swept = run("sweep", "toggle-press-force", "--positions", "4", "-o", str(tmp_path), "--lang", "zh")
    pages = [path.read_text(encoding="utf-8") for path in tmp_path.glob("*.svg")]
    assert [] == [text for text in (swept.stdout, *pages) if re.search(r"[\u4e00-\u9fff][^\n<]*; ", text)]


@pytest.mark.parametrize(
    ("language", "told"), [("en", "0, a zero count; a count must be positive"), ("zh", "0，个数为零；个数应为正")]
)
def test_a_number_of_positions_is_no_length(tmp_path, language, told):
    scene = tmp_path / "scene.toml"
    scene.write_text(library_text("slider-crank-offset") + "\n[positions]\ncount = 0\n")
    assert told in run("check", str(scene), "--lang", language).stderr


def test_designs_that_are_no_scene_are_refused_in_chinese(tmp_path):
    done = run("sweep", "whitworth", "--set", "links.2.length=-1,-2", "-o", str(tmp_path), "--lang", "zh")
    said = "graphkin: --set, --designs：links.2.length：读到 -1，长度为负；长度应为正\n"
    assert (2, said) == (done.returncode, done.stderr.splitlines(keepends=True)[0])


def test_designs_whose_driver_follows_from_dimensions_are_refused_in_chinese():
    driver = {"link": "2", "angle": 150, "speed": 400, "of": "A"}
    prepared = graphkin.prepare({**tomllib.loads(library_text("whitworth")), "driver": driver}, find=["v_C"])
    with pytest.raises(CallError) as refused:
        prepared.over({"links.2.length": [60, 70]})
    assert refused.value.text("zh").endswith("由死点、位置或点的速度给出，随每个方案而变；请直接给出其值")
