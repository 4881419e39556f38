from __future__ import annotations

import cmath
import math
from dataclasses import replace

import numpy as np
import pytest

import graphkin
from graphkin.account.notation import notation_of
from graphkin.checking import readings
from graphkin.checking.readings import read_off
from graphkin.construction import execute, plan
from graphkin.construction.centres import find_centres
from graphkin.papers import lesson
from graphkin.papers.documents import solution_blocks
from graphkin.papers.html import blocks_html
from graphkin.papers.lesson import usual_count
from graphkin.papers.screen import motion_data
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import solve
from graphkin.structure import analyse
from tests import scenes
from tests.command import run

pytestmark = pytest.mark.quick


def test_centres_followed_from_a_neighbour_are_those_found_afresh():
    scene = mechanism_of("double-butterfly")
    key = scene.drivers[0].key
    start = scene.drivers[0].values[0]
    one = find_centres(scene, {key: start + 0.1})
    two = find_centres(scene, {key: start + 0.2}, near=one)
    afresh = find_centres(scene, {key: start + 0.2})
    for pair, centre in afresh.table.items():
        if centre.point is not None:
            assert centre.point == pytest.approx(two.table[pair].point, abs=1e-6)


def test_a_mechanism_of_many_links_is_shown_in_fewer_positions():
    assert 12 == usual_count(mechanism_of("double-butterfly"))


FOUR_BAR = "fourbar-150-500-300-400"


@pytest.fixture
def misread(monkeypatch):
    """A drawing of which omega_3 is read with the wrong sign."""

    def wrong(reading):
        return replace(reading, value=-reading.value) if str(reading.symbol) == "omega_3" else reading

    monkeypatch.setattr(readings, "read_off", lambda *given: [wrong(reading) for reading in read_off(*given)])


@pytest.mark.parametrize(
    "call",
    [
        ["handout", FOUR_BAR, "--format", "html"],
        ["handout", FOUR_BAR, "--export", "gift"],
        ["handout", FOUR_BAR, "--template", "course-design", "--format", "html"],
        ["draw", FOUR_BAR],
        ["draw", FOUR_BAR, "--figure", "sheet"],
    ],
)
def test_a_paper_whose_own_check_fails_is_refused_and_nothing_is_written(call, misread, tmp_path):
    answer = run(*call, "-o", str(tmp_path / "out"), "--quiet")
    assert (1, False) == (answer.returncode, (tmp_path / "out").exists())
    drawn, right = (f"{sign}{graphkin.solve(FOUR_BAR)['omega_3'][0]:.6g} rad/s".replace("--", "") for sign in ("-", ""))
    assert f"graphkin: omega_3: {drawn} by the drawing, {right} by computation; no paper is written" in answer.stderr


def test_a_variant_whose_own_check_fails_is_named_and_none_of_its_papers_written(misread, tmp_path):
    call = ["handout", FOUR_BAR, "--variants", "1", "--workers", "1", "--format", "html", "--quiet"]
    answer = run(*call, "-o", str(tmp_path))
    assert 1 == answer.returncode
    assert "01: omega_3: " in answer.stderr
    assert [] == [path.name for path in tmp_path.rglob("*.html")]


def test_a_pencil_drawing_that_misses_is_drawn_all_the_same(misread, tmp_path):
    answer = run("draw", FOUR_BAR, "--instrument", "pencil", "--figure", "velocity", "-o", str(tmp_path), "--quiet")
    assert (1, True) == (answer.returncode, (tmp_path / "velocity.svg").exists())


def test_positions_of_the_screen_whose_check_fails_are_left_out(monkeypatch):
    structure = analyse(mechanism_of("boom-lifted"))
    key = structure.drivers[0].key
    bare = plan(structure, None, ())
    paper = execute(bare).scales
    whole, start = lesson.views_of(structure, None, (), "en", "us", paper, 4)
    missed = {whole[k].sheet.drivers[key] for k in (0, start + 1)}

    def wrong(sheet, *others):
        off = 1.01 if sheet.drivers[key] in missed else 1.0
        return [replace(reading, value=off * reading.value) for reading in read_off(sheet, *others)]

    monkeypatch.setattr(readings, "read_off", wrong)
    kept, now = lesson.views_of(structure, None, (), "en", "us", paper, 4)
    assert whole[start].sheet.drivers == kept[now].sheet.drivers
    assert (start - 1, len(whole) - 2) == (now, len(kept))


def guide_in_motion(name):
    """The ends of the only guide that the screen shows (mm, y up), each at five positions, and the size of the
    mechanism on paper."""
    scene = mechanism_of_text(getattr(scenes, name), name)
    sheet = execute(plan(analyse(scene), None, ()))
    moving = motion_data(sheet, notation_of(sheet, "chinese"), None, count=5)
    ((start, end),) = moving["lines"]
    tracks = (np.array(moving["tracks"][k]).reshape(-1, 2) for k in (start, end))
    return [x - 1j * y for x, y in (track.T for track in tracks)], scene.size / sheet.scales.length


def test_a_guide_of_the_frame_reaches_on_the_screen_as_far_as_the_mechanism_is_large_to_either_side():
    (start, end), size = guide_in_motion("OFFSET_SLIDER")
    reach = cmath.rect(size, math.radians(12))
    assert np.full(5, 10 + 25j) == pytest.approx((start + end) / 2, abs=0.01)
    assert np.full(5, reach) == pytest.approx((end - start) / 2, abs=0.01)


def test_a_guide_of_a_link_runs_on_the_screen_through_what_slides_on_it():
    (start, end), _ = guide_in_motion("GUIDE_OVER_CRANK")  # over A, at the origin
    assert np.zeros(5) == pytest.approx((start * end.conjugate()).imag / abs(end - start), abs=0.02)


def test_a_guide_of_a_link_is_on_the_screen_six_tenths_of_the_mechanism_ahead_and_a_little_behind():
    (start, end), size = guide_in_motion("GUIDE_OVER_CRANK")
    angle = solve(mechanism_of_text(scenes.GUIDE_OVER_CRANK, "guide"), sweep=5).angle("5") + math.radians(140)
    assert 0.69 * size * np.exp(1j * angle) == pytest.approx(end - start, abs=0.02)


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-swinging-roller", "disc-on-disc"])
def test_in_every_position_of_a_page_the_centres_of_cams_are_those_of_that_position(name):
    sheet = execute(plan(mechanism_of(name)))
    views, _ = lesson.views_of(sheet.structure, None, (), "en", "chinese", sheet.scales, 3)
    assert 3 == len(views)
    for view in views:
        at = math.degrees(view.sheet.drivers["1"])
        there, per_m = graphkin.centres(name, at=at).centres, view.sheet.scales.length
        for pair, centre in there.table.items():
            if centre.point is not None:
                place = centre.point * there.sheet.scales.length
                assert place == pytest.approx(view.centres.table[pair].point * per_m, abs=1e-9)


@pytest.fixture(scope="module")
def geared():
    return graphkin.handout("geared-five-bar", positions=1, formats=["html"]).lesson


def test_steps_of_a_velocity_plan_stand_under_its_heading_and_under_no_equation(geared):
    assert [] == [stage.equation for stage in geared.stages if len({bool(step.plan) for step in stage.steps}) > 1]
    assert [(9, 11), (24, 26)] == [(stage.first, stage.last) for stage in geared.stages if stage.of_plans]


def test_a_figure_of_several_equations_marks_the_steps_of_all_of_them(geared):
    assert "Figure 3. Velocity polygon, step 20" in blocks_html(tuple(solution_blocks(geared)), "en")
