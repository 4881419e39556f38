"""Questions for learning platforms say what the key says, and their files are read by outside readers' rules."""

from __future__ import annotations

import base64
import html
import json
import re
import runpy
import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from html.parser import HTMLParser

import pytest

import graphkin
from tests.command import run

SCENE = "sixbar-guide-40deg"
PLATFORMS = ("moodle", "gift", "prairielearn")


@pytest.fixture(scope="module")
def made():
    return graphkin.handout(SCENE, formats=("html",), positions=1, exports=PLATFORMS)


@pytest.fixture(scope="module")
def files(made):
    from graphkin.papers.exports import files_for

    return files_for(made.question, PLATFORMS)


def asked(made):
    return [row for row in made.key if row.asked]


def test_moodle_has_a_cloze_question_and_a_numerical_one_for_each_quantity(made, files):
    quiz = ElementTree.fromstring(files["moodle.xml"])
    kinds = [question.get("type") for question in quiz]
    assert ["category", "cloze", *["numerical"] * len(asked(made))] == kinds


def test_moodle_accepts_what_the_key_accepts(made, files):
    quiz = ElementTree.fromstring(files["moodle.xml"])
    for question, row in zip(quiz.findall("question[@type='numerical']"), asked(made), strict=True):
        right = [answer for answer in question.findall("answer") if answer.get("fraction") == "100"]
        assert 1 == len(right)
        assert row.exact == pytest.approx(float(right[0].find("text").text), rel=1e-9)
        assert row.tolerance == pytest.approx(float(right[0].find("tolerance").text), rel=5e-3)


def test_no_slip_is_within_the_tolerance_of_the_right_answer(made):
    assert any(one.slips for one in made.question.asked)
    for one in made.question.asked:
        assert all(abs(value - one.value) > one.tolerance for value, _ in one.slips)
        assert all(words for _, words in one.slips)


def test_the_coriolis_slip_is_answered_by_name(made):
    words = [said.lower() for one in made.question.asked for _, said in one.slips]
    assert any("coriolis" in said for said in words)


def test_the_figure_comes_along_as_a_picture(files):
    quiz = ElementTree.fromstring(files["moodle.xml"])
    for question in quiz.findall("question")[1:]:
        picture = base64.b64decode(question.find("questiontext/file").text)
        assert picture.startswith(b"\x89PNG")
        assert "@@PLUGINFILE@@/mechanism.png" in question.find("questiontext/text").text


def test_cloze_fields_have_the_form_that_moodle_reads(made, files):
    quiz = ElementTree.fromstring(files["moodle.xml"])
    text = quiz.find("question[@type='cloze']/questiontext/text").text
    fields = re.findall(r"\{1:NUMERICAL:((?:[^}\\]|\\.)*)\}", text)
    assert len(asked(made)) == len(fields)
    number = r"-?\d[\d.e+-]*"
    for field in fields:
        first, *others = re.split(r"(?<!\\)~", field)
        assert re.fullmatch(rf"={number}:{number}", first)
        assert all(re.fullmatch(rf"%0%{number}:{number}#(?:[^#~}}\\]|\\.)+", other) for other in others)


def test_gift_questions_have_the_form_that_is_published(made, files):
    text = files["questions.gift"].decode()
    blocks = re.findall(r"::((?:[^:\\]|\\.)+)::((?:[^{\\]|\\.)+)\{#\n(.*?)\n\}\n", text, re.DOTALL)
    assert len(asked(made)) == len(blocks)
    for (_, _, answers), row in zip(blocks, asked(made), strict=True):
        first = re.match(r"=%100%(-?[\d.e+-]+):([\d.e+-]+)#", answers)
        assert row.exact == pytest.approx(float(first[1]), rel=1e-9)
        assert all(line.startswith("=%") for line in answers.splitlines())


def texts_of(files):
    """The HTML of each question, by its platform, as an importer gets it."""
    quiz = ElementTree.fromstring(files["moodle.xml"])
    gift = re.findall(r"::(?:[^:\\]|\\.)+::\[html\]((?:[^{\\]|\\.)+)\{#\n", files["questions.gift"].decode())
    return {
        "moodle": [q.find("questiontext/text").text for q in quiz.findall("question")[1:]],
        "gift": [re.sub(r"\\([~=#{}:\\])", r"\1", text) for text in gift],
        "prairielearn": [files[f"prairielearn/{SCENE}/question.html"].decode()],
    }


def test_a_gift_question_brings_its_figure(made, files):
    texts = texts_of(files)["gift"]
    assert len(asked(made)) == len(texts)
    for text in texts:
        (data,) = re.findall(r'<img src="data:image/png;base64,([A-Za-z0-9+/=]+)" alt="[^"]', text)
        assert made.question.picture == base64.b64decode(data, validate=True)


def test_every_question_says_what_is_joined_to_what_and_what_its_figure_shows(files):
    for platform, texts in texts_of(files).items():
        assert texts, platform
        for text in texts:
            assert not re.search(r"Source|Find\W", text), platform  # each asks for its own, and gives nothing away
            assert "Link 1 joins A, B. Link 2 joins B. " in re.sub(r"<p[^>]*>", "", text), platform
            assert " is the point of link 3 at B" in re.sub("<[^>]+>", "", text), platform
            assert "slides on link 6" in re.search(r'alt="([^"]*)"', text)[1], platform


@pytest.mark.parametrize(
    ("scene", "language", "said"),
    [("cam-offset-roller", "en", "Link 1 is a cam, and link 2 its roller follower."),
     ("cam-offset-roller", "en", "120°–150° dwell, 150°–260° 3-4-5 −24 mm, 260°–360° dwell."),
     ("cam-flat-face", "zh", "O 是凸轮 1 与从动件接触处的曲率中心。"),
     ("gears-epicyclic", "zh", "齿轮 1 与齿轮 3 啮合，其轴线在构件 2 上。"),
     ("geneva-step", "en", "Point B of link 1 runs in a slot of link 2.")],
)
def test_a_question_tells_its_structure_and_the_law_of_its_cam(scene, language, said):
    made = graphkin.handout(scene, formats=("html",), positions=1, exports=("gift",), language=language)
    assert said in re.sub("<[^>]+>", "", made.question.html)


class Inputs(HTMLParser):
    def __init__(self):
        super().__init__()
        self.found = {}

    def handle_starttag(self, tag, attrs):
        if tag == "pl-number-input":
            values = dict(attrs)
            self.found[values["answers-name"]] = float(values["atol"])


def test_a_prairielearn_folder_asks_grades_and_answers_slips(made, files, tmp_path):
    folder = f"prairielearn/{SCENE}"
    info = json.loads(files[f"{folder}/info.json"])
    assert {"uuid", "title", "topic", "type"} <= set(info)
    inputs = Inputs()
    inputs.feed(files[f"{folder}/question.html"].decode())
    (tmp_path / "server.py").write_bytes(files[f"{folder}/server.py"])
    server = runpy.run_path(str(tmp_path / "server.py"))
    data = {"correct_answers": {}, "submitted_answers": {}, "partial_scores": {}}
    server["generate"](data)
    assert set(inputs.found) == set(data["correct_answers"])
    one = next(one for one in made.question.asked if one.slips)
    name = re.sub(r"[^A-Za-z0-9]+", "_", one.symbol)
    data["submitted_answers"][name] = one.slips[0][0]
    server["grade"](data)
    assert one.slips[0][1] == data["partial_scores"][name]["feedback"]


def test_a_force_without_and_with_a_load_that_begins_have_a_field_each_in_prairielearn(made):
    from graphkin.papers.exports import prairielearn

    one = made.question.asked[0]
    forces = tuple(replace(one, symbol=symbol) for symbol in ("F_3/2", "F_3/2+"))
    inputs = Inputs()
    inputs.feed(prairielearn(replace(made.question, asked=forces))["question.html"].decode())
    assert {"F_3_2", "F_3_2_plus"} == set(inputs.found)


def test_a_number_without_a_unit_is_asked_without_brackets(made):
    from graphkin.papers.exports import gift

    asked = (replace(made.question.asked[0], unit=unit) for unit in ("", "mm/s"))
    assert [False, True] == [" \\= ? (" in gift(replace(made.question, asked=(one,))) for one in asked]


def test_a_question_in_both_languages_tells_the_rule_of_signs_in_both():
    made = graphkin.handout("scotch-yoke", formats=("html",), positions=1, exports=("gift",), language="both")
    assert all(said in made.question.sign_rule for said in ("counter-clockwise positive.", "逆时针为正。"))


def test_a_coincident_point_that_two_quantities_need_is_explained_once():
    made = graphkin.handout(SCENE, find=["v_B@3/B@2", "y_B"], formats=("html",), positions=1, exports=("gift",))
    assert 1 == made.question.html.count(" is the point of link 2 ")


def test_a_set_of_variants_becomes_one_bank(tmp_path):
    done = run("handout", "slider-crank-offset", "--variants", "2", "--seed", "4", "--format", "html", "--lang", "zh",
               "--export", "moodle,gift", "--workers", "1", "-o", str(tmp_path / "set"))
    assert 0 == done.returncode, done.stderr
    quiz = ElementTree.parse(tmp_path / "set" / "moodle.xml").getroot()
    assert 2 == len(quiz.findall("question[@type='cloze']"))
    answers = {q.find("answer/text").text for q in quiz.findall("question[@type='numerical']")}
    assert len(answers) > len(quiz.findall("question[@type='numerical']")) // 2
    assert (tmp_path / "set" / "questions.gift").read_text().startswith("$CATEGORY")


def test_papers_with_letters_as_paths_are_refused_with_the_command_that_gives_them():
    done = run("handout", SCENE, "--text", "outlines")
    assert 2 == done.returncode
    assert f"graphkin draw {SCENE} --text outlines" in done.stderr


def test_an_unknown_platform_is_told_by_name():
    done = run("handout", SCENE, "--export", "moodel")
    assert 2 == done.returncode
    assert 'did you mean "moodle"' in done.stderr


@pytest.mark.parametrize("exports", [None, 3, 2.5, object()])
def test_what_is_no_list_of_platforms_is_refused_by_name(exports):
    with pytest.raises(graphkin.CallError, match="give a list: moodle"):
        graphkin.handout(SCENE, exports=exports)


def test_signs_of_markup_in_a_question_are_read_back_as_they_are(made):
    from dataclasses import replace

    from graphkin.papers.exports import bank, files_for

    words = 'a < b & "c" ]]> {#~}'
    one = replace(made.question.asked[0], slips=((1e9, words),))
    hostile = replace(made.question, title=words, seen=words, asked=(one,))
    files = bank(words, [files_for(hostile, PLATFORMS)] * 2)
    category, cloze, numerical, *more = ElementTree.fromstring(files["moodle.xml"])
    assert ["cloze", "numerical"] == [question.get("type") for question in more]
    assert f"$course$/top/{words}" == category.find("category/text").text
    assert words == cloze.find("name/text").text
    feedback = numerical.findall("answer")[1].find("feedback/text").text
    assert words == html.unescape(feedback) != feedback
    page = files_for(hostile, PLATFORMS)[f"prairielearn/{SCENE}/question.html"].decode()
    texts = numerical.find("questiontext/text").text, page
    assert [words, words] == [html.unescape(re.search(r'alt="([^"]*)"', text)[1]) for text in texts]


def test_symbols_of_a_question_in_chinese_are_read_aloud_in_chinese():
    text = graphkin.handout("slider-crank-offset", language="zh", exports=("moodle",), positions=1).files["moodle.xml"]
    assert b"velocity of C" not in text
    assert 'aria-label="C 的速度"'.encode() in text
