"""Words in each language: one table for each, complete, and a further language is one more of them."""

from __future__ import annotations

import ast
import json
import re
import shutil
import subprocess
import sys
import tomllib
from collections import Counter
from pathlib import Path

import pytest

import graphkin
from graphkin.errors import did_you_mean
from graphkin.words import LANGUAGES, Phrase, area, gaps_of, listed, rich_text, say
from graphkin.words.symbols import RichText, sign, stretches
from graphkin.words.written import roman
from tests.command import start

MARK = "¤"
TABLES = Path(graphkin.__file__).parent / "words"


def areas(language: str) -> dict[str, dict[str, str]]:
    return tomllib.loads((TABLES / f"{language}.toml").read_text(encoding="utf-8"))


def words(language: str) -> dict[str, str]:
    return {key: text for area in areas(language).values() for key, text in area.items()}


def gaps(text: str) -> set[str]:
    return set(re.findall(r"(?<!\{)\{(\w+)\}", text.replace("{{{", "{")))


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_a_language_has_every_word_that_english_has(language):
    assert {area: list(table) for area, table in areas("en").items()} == {
        area: list(table) for area, table in areas(language).items()
    }


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_table_is_read_line_by_line_as_toml_reads_it(language):
    assert areas(language) == {name: area(name, language) for name in areas(language)}


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_key_stands_in_one_area_only(language):
    assert [] == [k for k, n in Counter(key for area in areas(language).values() for key in area).items() if n > 1]


@pytest.mark.parametrize("language", LANGUAGES[1:])
def test_a_sentence_has_the_same_gaps_in_every_language(language):
    english = words("en")
    assert {} == {k: text for k, text in words(language).items() if gaps(text) != gaps(english[k])}


def test_every_gap_bears_a_name():
    sentences = {key: text for area, texts in areas("en").items() if area != "spelling" for key, text in texts.items()}
    assert {} == {key: text for key, text in sentences.items() if any(gap.isdigit() for gap in gaps_of(key))}


def test_english_is_the_first_language():
    assert "en" == LANGUAGES[0]


@pytest.fixture(scope="module")
def with_another_language(tmp_path_factory):
    """A copy of graphkin with one file more: a table that says everything in English, with a mark before it."""
    folder = tmp_path_factory.mktemp("languages")
    shutil.copytree(Path(graphkin.__file__).parent, folder / "graphkin", ignore=shutil.ignore_patterns("__pycache__"))
    marked = [f"{json.dumps(key)} = {json.dumps(MARK + text)}" for key, text in words("en").items()]
    (folder / "graphkin" / "words" / "xx.toml").write_text("[words]\n" + "\n".join(marked), encoding="utf-8")
    return folder


ONE_BY_ONE = """
import sys
from graphkin.cli import main
for command in sys.argv[1:]:
    sys.argv = ["graphkin", command, "slider-crank-s50-e16-K1.2", "--lang", "xx", "-o", command]
    try:
        main()
    except SystemExit as end:
        assert not end.code, (command, end.code)
"""


def test_a_further_language_is_one_more_table(with_another_language):
    said_in = {"check": "report.txt", "draw": "sheet.svg", "centres": "centres.svg", "handout": "problem.html"}
    call = [sys.executable, "-c", ONE_BY_ONE, *said_in]
    done = subprocess.run(call, cwd=with_another_language, capture_output=True, text=True, encoding="utf-8")
    assert 0 == done.returncode, done.stderr
    texts = {c: (with_another_language / c / name).read_text(encoding="utf-8") for c, name in said_in.items()}
    assert [*said_in] == [command for command, text in texts.items() if MARK in text]


def test_the_help_names_every_language(with_another_language):
    assert "|xx|" in start("check", "--help", cwd=with_another_language).stdout


def test_a_scene_may_ask_for_a_further_language(with_another_language):
    scene = {"frame": {"points": {"A": [0, 0]}}, "links": {"1": {"points": ["A"]}}, "sheet": {"language": "xx"}}
    asking = f"from graphkin.scene import mechanism_of; print(mechanism_of({scene}).question.sheet.language)"
    done = subprocess.run([sys.executable, "-c", asking], cwd=with_another_language, capture_output=True, text=True)
    assert "xx" == done.stdout.strip(), done.stderr


def test_a_rate_of_the_table_takes_its_index_into_its_symbol():
    said = rich_text(Phrase("omega zero", seen="3", symbol=sign("v", "B"), bar=sign("AB")), "en")
    assert "$ω_{3}$ = $v_{B}$ / $AB$ = 0" == repr(said)
    assert [False, True] * 3 == [isinstance(part, str) for part in stretches(said)]


def test_symbols_side_by_side_are_one_and_those_of_the_table_keep_their_indices():
    said = Phrase("tangent", **{"points.0": sign("A"), "points.1": sign("B"), "mm": "12", "pairs.0": "3"})
    assert "over $AB$ as diameter" in repr(rich_text(said, "en"))
    assert "turn B2 back" in rich_text(Phrase("design trial", point=sign("B", "2")), "en").plain("")


def test_a_mark_above_a_letter_without_an_index_stays_in_plain_text() -> None:
    assert ("a^n", "ω²", "v_B") == (str(sign("a", "", "n")), str(sign("ω", "", "2")), str(sign("v", "B")))


def test_empty_words_are_no_part_of_a_rich_text() -> None:
    assert (False, ("mm",)) == (bool(RichText("")), RichText("", RichText("", "mm"), "").parts)


def test_dollar_signs_and_braces_of_a_name_are_no_marks_of_symbols():
    said = rich_text(Phrase("design measured", measured="a$b$ {c}"), "en")
    assert ["measured on paper: a$b$ {c}"] == [*stretches(said)]


def test_a_sixth_trial_or_inset_has_a_numeral_of_its_own():
    assert ["I", "II", "III", "IV", "V", "VI", "VII"] == [roman(number) for number in range(1, 8)]


SENTENCES = {"Phrase", "Problem", "of", "say", "unfit"}


def is_joined(node: ast.AST) -> bool:
    """Whether an expression is texts joined by marks of English."""
    match node:
        case ast.Call(func=ast.Attribute(value=ast.Constant(value=", " | "; "), attr="join")):
            return True
    return isinstance(node, ast.Subscript) and is_joined(node.value)


def lists_by_hand(tree: ast.AST) -> list[int]:
    """The lines of sentences with a gap that is filled by texts joined by hand, there or in a variable of its
    function."""
    found = set()
    for function in (node for node in ast.walk(tree) if isinstance(node, ast.FunctionDef)):
        inner = [*ast.walk(function)]
        kept = {t.id for n in inner if isinstance(n, ast.Assign) and is_joined(n.value)
                for t in n.targets if isinstance(t, ast.Name)}
        for call in (n for n in inner if isinstance(n, ast.Call)):
            if getattr(call.func, "id", getattr(call.func, "attr", "")) in SENTENCES:
                values = (*call.args, *(keyword.value for keyword in call.keywords))
                found |= {v.lineno for v in values if is_joined(v) or getattr(v, "id", None) in kept}
    return sorted(found)


def test_lists_in_sentences_are_joined_with_the_marks_of_the_language():
    sources = {str(path): path.read_text(encoding="utf-8") for path in TABLES.parent.rglob("*.py")}
    by_hand = {name: lists_by_hand(ast.parse(source)) for name, source in sources.items() if ".join(" in source}
    assert {} == {name: lines for name, lines in by_hand.items() if lines}


def test_known_names_are_listed_with_the_comma_of_chinese():
    assert "可用的有：A、B、C" == say(did_you_mean("Q", "ABC"), "zh")


@pytest.mark.parametrize(
    ("number", "sentence"),
    [(Phrase("clockwise"), "第顺时针页，共 4 页"), ("顺时针", "第顺时针页，共 4 页"), ("3", "第 3 页，共 4 页"),
     (sign("v", "C"), "第 v_C 页，共 4 页")],
    ids=["phrase", "name", "number", "symbol"],
)
def test_chinese_meets_chinese_without_a_space_and_all_else_with_it(number, sentence):
    phrase = Phrase("page of", number=number, count="4")
    assert sentence == say(phrase, "zh")
    assert sentence == str(rich_text(phrase, "zh"))


def test_a_list_may_be_as_long_as_a_mechanism_has_names():
    names = [str(number) for number in range(5000)]
    assert ", ".join(names) == say(listed(names))


def test_no_space_parts_chinese_from_chinese_on_either_side_of_a_gap():
    said = [say(Phrase("link is the frame", name=name), "zh") for name in ("甲", "4")]
    assert ["构件甲是机架", "构件 4 是机架"] == said
