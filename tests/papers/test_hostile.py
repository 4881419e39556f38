"""Words of a scene are shown as they are, and never read as anything else."""

from __future__ import annotations

import dataclasses
import re
from functools import cache
from html.parser import HTMLParser

import pytest

from graphkin.api.classroom.handouts import handout
from graphkin.papers.blocks import clean
from graphkin.scene import mechanism_of
from tests.scenes import four_bar

TITLES = (
    "</title></style></script><script>document.title='owned'</script>",
    '"><img src=x onerror=alert(1)>',
    '#eval("1+1") #import "x.typ" $x^2$ *b* \\u{41} @ref <label>',
    "$v_{B$ {0} {1} %s &amp; &lt;b&gt; ]]> --> <!--",
)


def _scene(title: str) -> dict:
    return four_bar(150, 500, 300, 400, title=title, title_zh=title, source=title, sketch={"C": [500, 290]})


class _Tags(HTMLParser):
    def __init__(self) -> None:
        super().__init__()
        self.tags: list[str] = []
        self.words: list[str] = []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)
        assert not [name for name, _ in attrs if name.startswith("on")]

    def handle_data(self, data):
        self.words.append(data)


def _read(page: str) -> _Tags:
    tags = _Tags()
    tags.feed(page)
    return tags


@cache
def _handout(title: str):
    return handout(_scene(title), language="both", formats=("html",), positions=1)


@pytest.mark.parametrize("title", TITLES)
def test_a_title_adds_no_element_to_a_page(title):
    plain, hostile = _handout("Four-bar"), _handout(title)
    for name in ("problem.html", "handout.html"):
        one, two = (_read(made.files[name].decode()) for made in (plain, hostile))
        assert one.tags == two.tags


@pytest.mark.parametrize("title", TITLES)
def test_a_title_is_shown_as_it_is(title):
    page = _handout(title).files["problem.html"].decode()
    shown = " ".join("".join(_read(page).words).split())
    assert " ".join(clean(title).split()) in shown


@pytest.mark.parametrize("title", TITLES)
def test_a_title_is_typeset_as_words(title):
    made = handout(_scene(title), formats=("pdf",)).files
    assert made["problem.pdf"].startswith(b"%PDF")


def test_marks_that_hide_or_turn_what_stands_beside_them_are_dropped():
    # the reader of files refuses them; a scene built in a program may still hold them
    given = mechanism_of("slotter-75-150")
    title = "safe\u202egpj.exe\u2066x\u2069\x00\x1b[31mend"
    scene = dataclasses.replace(given, question=dataclasses.replace(given.question, title=title))
    made = handout(scene, positions=1).files
    for name in ("problem.html", "handout.html"):
        assert not re.findall("[\u202a-\u202e\u2066-\u2069\x00\x1b]", made[name].decode())


def test_a_scene_name_never_leads_out_of_the_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "inside").mkdir()
    monkeypatch.chdir(tmp_path / "inside")
    scene = dataclasses.replace(mechanism_of("slotter-75-150"), name="../../evil/..")
    paths = handout(scene, formats=("pdf",)).write()
    assert {tmp_path / "inside"} == {p.resolve().parent.parent for p in paths}
