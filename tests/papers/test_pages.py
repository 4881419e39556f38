from __future__ import annotations

import base64
import hashlib
import json
import re

import pytest

import tests.papers
from graphkin.account.notation import Notation
from graphkin.api.classroom.handouts import handout
from graphkin.papers.blocks import Picture, laid_out
from graphkin.papers.documents import solution
from graphkin.papers.html import words_html
from graphkin.papers.pdf import FORMS
from graphkin.scene.symbol import Symbol
from graphkin.words.symbols import sign
from tests import EVERYTHING
from tests.construction.test_trains import FOUND_LATER


def _data(page: str) -> dict:
    return tests.papers.unpacked(page)


def _page(made, name="handout.html") -> str:
    return made.files[name].decode()


@pytest.mark.parametrize("name", ["handout.html", "problem.html"])
def test_a_page_refers_to_nothing_outside_itself(shaper, name):
    page = _page(shaper, name)
    if name == "handout.html":  # what is packed refers to nothing either
        page = re.sub(r'id="positions">[^<]*<', "<", page) + json.dumps(_data(page))
    page = re.sub(r'xmlns(:\w+)?=\\?"[^"]*"|url\(data:font/woff;base64,[^)]*\)', "", page)
    assert not re.findall(r"https?://|//\w|url\((?!#)|@import|<link|<img|<iframe|<object| src=", page)


@pytest.mark.parametrize("name", ["handout.html", "problem.html"])
def test_the_policy_allows_just_the_scripts_and_styles_that_are_there(shaper, name):
    page = _page(shaper, name)
    policy = re.search(r'Content-Security-Policy" content="([^"]*)"', page)[1]
    inside = re.findall(r"<style>(.*?)</style>|<script>(.*?)</script>", page, re.DOTALL)
    hashes = {f"sha256-{base64.b64encode(hashlib.sha256((a or b).encode()).digest()).decode()}" for a, b in inside}
    assert "default-src 'none'" in policy
    assert hashes == set(re.findall(r"'(sha256-[^']*)'", policy))


def test_no_part_has_a_style_or_a_handler_of_its_own(shaper):
    assert not re.findall(r"<[^>]*\s(?:style|on\w+)=", _page(shaper))


def test_the_page_is_not_large():
    assert len(handout("sixbar-guide-40deg", language="both", formats=("html",)).files["handout.html"]) < 800_000
    if EVERYTHING:
        assert len(handout("shaper-scheme-2", language="en", formats=("html",)).files["handout.html"]) < 600_000


def test_every_step_lights_something_or_is_a_step_of_words(shaper):
    position = _data(_page(shaper))["positions"][0]
    drawn = set(map(int, re.findall(r"step-(\d+)", "".join(f["svg"] for f in position["figures"]))))
    vectors = {s["n"] for s in position["steps"] if "found" in s["text"] or "Lay off" in s["text"]}
    assert vectors <= drawn


def test_ids_are_unique_in_a_position(shaper):
    for position in _data(_page(shaper))["positions"]:
        ids = re.findall(r' id="([^"]*)"', "".join(f["svg"] for f in position["figures"]))
        assert len(ids) == len(set(ids))


def test_all_positions_show_the_fixed_pivots_at_one_place(shaper):
    places = set()
    for position in _data(_page(shaper))["positions"]:
        svg = next(f["svg"] for f in position["figures"] if f["name"] == "mechanism")
        group = re.search(r'<g[^>]*id="point-O4".*?<circle[^>]*cx="([^"]*)" cy="([^"]*)"', svg)
        places.add(group.groups())
    assert 1 == len(places)


def test_the_positions_hold_mechanism_polygons_and_centres(shaper):
    for position in _data(_page(shaper))["positions"]:
        assert ["mechanism", "velocity", "acceleration", "centres"] == [f["name"] for f in position["figures"]]


def test_a_driver_that_cannot_turn_fully_shows_the_positions_that_it_reaches():
    made = handout("hydraulic-cylinder", formats=("html",), positions=6)
    assert 4 <= len(_data(_page(made))["positions"]) <= 7


def test_both_languages_stand_on_one_page():
    page = _page(handout("slotter-75-150", language="both", formats=("html",), positions=1))
    assert 'lang="en"' in page
    assert 'lang="zh-Hans"' in page


def test_a_velocity_plan_and_the_inversion_of_a_cam_are_figures_of_the_page():
    wheels = _data(_page(handout("gears-epicyclic", positions=2, formats=("html",))))["positions"]
    for position in wheels:
        (plan,) = (f for f in position["figures"] if f["name"] == "plan-velocity")
        ends = [s["n"] for s in position["steps"] if s["text"].startswith("Velocity plan")]
        assert f'class="step-{ends[-1]}"' in plan["svg"]
    cam = _data(_page(handout("cam-offset-roller", positions=2, formats=("html",))))["positions"]
    assert [["cam-diagram-0", "cam-figure-0"]] * 2 == [[f["name"] for f in p["figures"]][-2:] for p in cam]
    # its steps are not those of the page
    assert not any("step-" in f["svg"] for p in cam for f in p["figures"][-2:])


def test_steps_on_a_velocity_plan_stand_under_its_name():
    page = _data(_page(handout("gears-epicyclic", positions=1, formats=("html",))))
    plans = {s["e"] for s in page["positions"][0]["steps"] if "lan of " in s["text"] or "Velocity plan" in s["text"]}
    titles = [re.sub("<.*?>", "", page["stages"][e]["title"]) for e in sorted(plans)]
    assert ["Velocity plan", "Plan of tangential accelerations"] == titles


def test_a_velocity_plan_is_stepped_through_line_by_line():
    (position,) = _data(_page(handout("gears-epicyclic", positions=1, formats=("html",))))["positions"]
    shown = [s["n"] for s in position["steps"] if s["d"] == "plan-velocity"]
    (plan,) = (f["svg"] for f in position["figures"] if f["name"] == "plan-velocity")
    assert [7, 8, 9, 10] == shown == [*map(int, re.findall(r'class="plan-line step-(\d+)"', plan))]


@pytest.fixture(scope="module")
def found_later():
    return handout(FOUND_LATER, positions=1, formats=("html",))


def test_each_velocity_plan_stands_there_from_its_own_last_step_on(found_later):
    (position,) = _data(_page(found_later))["positions"]
    first, later = (f["svg"] for f in position["figures"] if f["name"] == "plan-velocity")
    two, six = (s["n"] for s in position["steps"] if s["text"].startswith("Velocity plan: line of link"))
    assert f'class="step-{two}"' in first
    assert f'class="step-{six}"' in later


def test_every_velocity_plan_is_a_figure_of_the_solution_on_paper(found_later):
    lesson = found_later.lesson
    figures = (block for block in laid_out(solution(lesson).blocks) if isinstance(block, Picture))
    captions = [str(words) for figure in figures for _, words in figure.caption]
    plans = ["Figure 2. Velocity plan", "Figure 4. Velocity plan",
             "Figure 5. Plan of tangential accelerations", "Figure 7. Plan of tangential accelerations"]
    assert plans == [caption for caption in captions if "lan" in caption]


def test_a_template_without_one_of_its_values_is_refused():
    from jinja2 import UndefinedError

    from graphkin.papers.html import rendered

    with pytest.raises(UndefinedError, match="'policy' is undefined"):
        rendered("page.html", language="en", title="<b>")


def test_an_empty_step_and_a_plate_are_written_with_their_words_escaped():
    from graphkin.papers.blocks import Plate, StepItem, once
    from graphkin.papers.html import blocks_html

    page = blocks_html([StepItem(3, once("a<b", "en")), Plate("<svg/>", 254.0, 127.0, 'a "b" <c>')], "en")
    assert '<li value="3"><p lang="en">a&lt;b</p></li>' in page
    assert '<img alt="a &#34;b&#34; &lt;c&gt;" width="960" height="480" src="data:image/svg+xml;base64,PHN2' in page


def test_a_symbol_of_a_page_has_its_mark_above_its_index_and_is_read_by_its_meaning():
    html = words_html(Notation("chinese").vector(Symbol.parse("an_C/B")), "en")
    assert "<sup><i>n</i></sup><sub><i>C</i><i>B</i></sub>" in html
    assert 'aria-label="normal acceleration of C relative to B"' in html


def test_a_symbol_of_a_typeset_paper_has_its_mark_and_its_index():
    ((words, symbol),) = FORMS["work"](("so " + sign("a", "C", "n"),))
    (atom,) = symbol
    assert ("so ", "a", "C", "n") == (words, atom["text"], atom["sub"][0]["text"], atom["sup"][0]["text"])
