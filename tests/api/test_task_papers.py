"""The papers of a synthesis and of a cam: problem without the answer, solution with every step, key."""

from __future__ import annotations

import re

import pytest

import graphkin
from graphkin.account.headings import number
from graphkin.api.classroom.task_papers import cam_papers, design_papers
from graphkin.scene.designs import designs, is_design
from tests.command import run

PAPERS = {"problem.html", "solution.html", "key.html"}


def text_of(page: bytes) -> str:
    return re.sub(r"<[^>]+>", " ", page.decode())


def steps_in(page: bytes) -> int:
    return len(re.findall(r"<li[ >]", page.decode()))


@pytest.mark.parametrize("name", designs())
def test_a_synthesis_has_its_papers(name):
    designed = graphkin.design(name)
    papers = design_papers(designed, ["html"])
    assert PAPERS == papers.keys()
    assert len(designed.sheet.steps) == steps_in(papers["solution.html"])
    assert 0 == steps_in(papers["problem.html"])


def test_the_problem_does_not_tell_the_answer():
    papers = design_papers(graphkin.design("slider-crank-stroke-50"), ["html"])
    told = {name: "58.37" in text_of(page) for name, page in papers.items()}
    assert {"problem.html": False, "solution.html": True, "key.html": True} == told


def test_the_solution_shows_what_was_measured_beside_the_exact_length_and_the_key_the_exact_one():
    designed = graphkin.design("slider-crank-stroke-50", instrument="pencil", seed=1)
    papers = {name: re.sub(r"\s+", " ", text_of(page)) for name, page in design_papers(designed, ["html"]).items()}
    for row in designed.rows:
        measured, exact = number(row.measured), number(row.exact)
        assert measured != exact
        assert f" {measured} {exact} mm" in papers["solution.html"]
        assert f" {exact} " in papers["key.html"]
        assert f" {measured} " not in papers["key.html"]


def test_only_what_a_turn_confirms_is_told_as_confirmed():
    pairs = {"kind": "function", "frame": 100, "pairs": [[10, 200], [50, 220], [90, 250]]}  # 293.4 and 339.6 degrees
    said = text_of(design_papers(graphkin.design({"design": pairs}), ["html"])["key.html"])
    assert "Confirmed by a turn: rocker at 10°: 200°." in said


def test_the_papers_of_a_synthesis_are_typeset(tmp_path):
    done = run("handout", "rocker-limits", "-o", str(tmp_path), "--lang", "both")
    assert 0 == done.returncode
    assert {f"{name}.{kind}" for name in ("problem", "solution", "key") for kind in ("html", "pdf")} == {
        path.name for path in tmp_path.iterdir()
    }


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-flat-face"])
def test_a_cam_has_its_papers(name):
    one = graphkin.cam(name)["1"]
    papers = cam_papers(one, ["html"], "en")
    assert {f"cam-{name}" for name in PAPERS} == papers.keys()
    assert len(one.sheet.steps) == steps_in(papers["cam-solution.html"])
    assert [2, 2] == [papers[f"cam-{name}.html"].count(b"<svg") for name in ("problem", "solution")]


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-flat-face", "cam-swinging-roller"])
def test_the_problem_of_a_cam_begins_with_its_circles_alone(name):
    papers = cam_papers(graphkin.cam(name)["1"], ["html"], "en")
    pages = (papers[f"cam-{part}.html"] for part in ("problem", "solution"))
    begun, whole = ({*re.findall(rb"strokes step-0*(\d+)", page)} for page in pages)
    assert {b"2"} == begun < whole


def test_the_problem_of_a_cam_numbers_the_divisions_of_which_it_asks():
    papers = cam_papers(graphkin.cam("cam-flat-face")["1"], ["html"], "en")
    numbered = [re.findall(r'class="cell"[^>]*>(?:<tspan[^>]*>)?(\d+)<', papers[f"cam-{part}.html"].decode())
                for part in ("problem", "solution")]
    assert numbered[0] == numbered[1] == [str(k) for k in range(22)]


def test_a_design_is_told_from_a_scene():
    assert [True, False] == [is_design("rocker-limits"), is_design("shaper-scheme-2")]


def test_a_wish_for_papers_that_only_a_scene_has_is_refused_for_a_design(tmp_path):
    call = ["handout", "rocker-limits", "--format", "html", "--export", "moodle", "--variants", "3", "--at", "40"]
    done = run(*call, cwd=tmp_path)
    refused = [line.partition(":")[2].partition(":")[0].strip() for line in done.stderr.splitlines()]
    assert (2, ["--at", "--variants", "--export"]) == (done.returncode, refused)
    assert [] == [*tmp_path.iterdir()]
