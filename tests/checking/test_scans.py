"""Drawings judged by what was read off their scans."""

import cmath
import math

import numpy as np
import pytest

import graphkin
from graphkin.construction import execute, plan
from graphkin.errors import CallError, SceneError
from graphkin.scene import mechanism_of

SCENE = "slider-crank-s50-e16-K1.2"
TURNED = 6.3 * cmath.exp(0.2j)


def ends(diagram):
    sheet = execute(plan(mechanism_of(SCENE), None, ()))
    if diagram == "mechanism":
        return {str(ref): z for ref, z in sheet.points.items()}
    found = {"pole": 0j} | {str(ref): z for ref, z in sheet.ends[diagram].items()}
    return found | {str(s): v.tip for s, v in sheet.vectors[diagram].items() if s.kind not in "va"}


def pixels(z):
    """A place on somebody's paper, scanned a little askew."""
    w = TURNED * z + complex(700, -600)
    return [w.real, -w.imag]


def crossing(a, along, b, across):
    matrix = [[along.real, -across.real], [along.imag, -across.imag]]
    t, _ = np.linalg.solve(matrix, [(b - a).real, (b - a).imag])
    return a + t * along


def scanned(diagram, points, read, **more):
    own = ({n: pixels(z) for n, z in places.items()} for places in (points, read))
    scan = {**dict(zip(("points", "read"), own, strict=True)), **more}
    return {**graphkin.read(SCENE).to_dict(), "scans": {diagram: scan}}


def judged(diagram, points, read):
    return graphkin.audit(scanned(diagram, points, read)).scans[0]


@pytest.mark.parametrize("diagram", ["mechanism", "velocity", "acceleration"])
def test_a_right_drawing_is_right_line_by_line_however_it_lies_on_the_scanner(diagram):
    own = ends(diagram)
    first, second = ("A", "B") if diagram == "mechanism" else ("pole", "B")
    rest = {n: z for n, z in own.items() if n not in (first, second, "A")}
    result = judged(diagram, {first: own[first], second: own[second]}, rest)
    assert result.ok
    assert None is result.off
    assert all(abs(line.read - line.exact) < 1e-9 for line in result.lines)


def test_a_program_reads_each_line_beside_the_exact_one():
    own = ends("velocity")
    audited = graphkin.audit(scanned("velocity", {"pole": own["pole"], "B": own["B"]}, {"C": 1.1 * own["C"]}))
    lines = {line["line"]: line for line in audited.data["scans"]["velocity"]["lines"]}
    assert pytest.approx(abs(own["C"])) == lines["v_C"]["exact_mm"]
    assert pytest.approx(1.1 * abs(own["C"])) == lines["v_C"]["on_paper_mm"]


@pytest.mark.parametrize("turn", [-5, 3])
def test_a_direction_set_wrong_is_named_and_not_what_follows_from_it(turn):
    own = ends("velocity")
    b, c = own["B"], own["C"]
    wrong = crossing(b, (c - b) * cmath.exp(1j * math.radians(turn)), 0j, c)
    result = judged("velocity", {"pole": 0j, "B": b}, {"C": wrong})
    assert ["v_C", "v_C/B"] == sorted(line.name for line in result.lines if not line.ok)
    assert "v_C/B" == result.off.name
    assert turn == pytest.approx(math.degrees(result.off.turned), abs=1e-9)


def test_the_guide_s_direction_set_wrong_is_named():
    own = ends("velocity")
    b, c = own["B"], own["C"]
    wrong = crossing(b, c - b, 0j, c * cmath.exp(1j * math.radians(4)))
    assert "v_C" == judged("velocity", {"pole": 0j, "B": b}, {"C": wrong}).off.name


def test_a_normal_part_laid_off_too_short_is_named():
    own = ends("acceleration")
    b, n, c = own["B"], own["an_C/B"], own["C"]
    foot = b + 0.8 * (n - b)
    wrong = crossing(foot, c - n, 0j, c)
    result = judged("acceleration", {"pole": 0j, "B": b}, {"an_C/B": foot, "C": wrong})
    assert "an_C/B" == result.off.name
    assert -0.2 * abs(n - b) == pytest.approx(result.off.longer)
    assert "length -20.0 %" in "\n".join(graphkin.audit(
        scanned("acceleration", {"pole": 0j, "B": b}, {"an_C/B": foot, "C": wrong})).scan_lines)


def test_a_part_laid_off_the_wrong_way_is_said_so():
    own = ends("acceleration")
    b, n = own["B"], own["an_C/B"]
    result = judged("acceleration", {"pole": 0j, "B": b}, {"an_C/B": 2 * b - n})
    assert ("an_C/B", "line reversed") == (result.off.name, result.off.said.key)


def test_a_bar_of_the_wrong_length_is_named_on_the_mechanism():
    own = ends("mechanism")
    result = judged("mechanism", {"A": own["A"], "B": own["B"]}, {"C": own["C"] + 0.05 * (own["C"] - own["B"])})
    assert "BC" == result.off.name


def test_the_figure_shows_the_lines_read_and_the_one_that_is_off():
    own = ends("velocity")
    scene = scanned("velocity", {"pole": 0j, "B": own["B"]}, {"C": 0.8 * own["C"]})
    text = graphkin.draw(scene, figures=["velocity"]).figures["velocity"].content("svg").decode()
    assert 1 == text.count('id="read-v_C-B"') == text.count('class="label off"')


@pytest.mark.parametrize(
    ("scan", "said"),
    [
        ({"points": {"pole": [1, 2]}, "read": {"C": [3, 4]}}, "scans.velocity.points: found 1"),
        ({"points": {"pole": [1, 2], "B": [1, 2]}, "read": {"C": [3, 4]}}, "two ends at two places"),
        ({"points": {"pole": [1, 2], "B": [5, 2]}, "read": {}}, "scans.velocity.read: is empty"),
        ({"points": {"pole": [1, 2], "B": [5, 2]}, "read": {"B": [3, 4]}}, "read.B: stands in points too"),
        ({"points": {"pole": [1, 2], "B": [5, 2]}, "read": {"C": [3, 4]}, "file": "none.png"}, "cannot be read"),
    ],
)
def test_what_is_wrong_with_a_scan_is_said_by_name(scan, said):
    with pytest.raises(SceneError, match="scans") as stop:
        graphkin.read({**graphkin.read(SCENE).to_dict(), "scans": {"velocity": scan}})
    assert said in str(stop.value)


def test_an_end_that_the_figure_does_not_have_is_refused():
    own = ends("velocity")
    with pytest.raises(CallError, match=r"scans.velocity.Q: is no end of this figure"):
        graphkin.audit(scanned("velocity", {"pole": 0j, "B": own["B"]}, {"Q": own["C"]}))
