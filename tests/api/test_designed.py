"""A mechanism for what it shall do: its lengths, its drawing and its motion agree, and what cannot be is refused."""

from __future__ import annotations

import json
import math
import re

import mpmath
import pytest

import graphkin
from graphkin.checking.closed_form import compare_lengths
from graphkin.construction import pencil
from graphkin.construction.synthesis import construct
from graphkin.drawing import Text
from graphkin.drawing.ink.primitives import walk
from graphkin.plane import direction
from graphkin.scene.designs import design_of, designs
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import PointRef
from graphkin.solver.synthesis import synthesise
from graphkin.words import say
from tests.command import run

SLIDER = {"kind": "slider-crank", "stroke": 50, "offset": 16, "K": 1.2}
ROCKER = {"kind": "crank-rocker", "swing": 40, "rocker": 50, "K": 1.3, "frame": 45}
EVEN = {"kind": "crank-rocker", "swing": 60, "rocker": 75, "K": 1, "frame": 100}
BAR = {"kind": "guide-bar", "stroke": 100, "centres": 150, "K": 2}
LIMITS = {"kind": "limits", "A": [0, 0], "D": [100, 20], "rocker": 60, "angles": [130, 70]}
PLACES = {"kind": "three-positions", "BC": 80, "positions": [
    {"B": [10, 60], "angle": 10}, {"B": [35, 80], "angle": -8}, {"B": [70, 82], "angle": -35}]}
PAIRS = {"kind": "function", "frame": 10, "pairs": [[60, 20], [75, 45], [135, 130]]}
POLE = [10 + 12.5 + 10 / math.tan(math.radians(9)), 60 + 10 - 12.5 / math.tan(math.radians(9))]
"""About it the bar turns from its first place to the second."""
ABOUT_ONE_CENTRE = {"kind": "three-positions", "positions": [
    {"B": [3 * c - 4 * s, 4 * c + 3 * s], "C": [9 * c - 12 * s, 12 * c + 9 * s]}
    for c, s in ((1, 0), (0.8, 0.6), (0, 1))]}
EACH = [SLIDER, ROCKER, EVEN, BAR, LIMITS, PLACES, {**PLACES, "A": [11, -35], "D": [57, 28]}, PAIRS]


def found(task):
    return graphkin.design({"design": task})


@pytest.mark.parametrize("task", [SLIDER, BAR])
def test_the_crank_of_a_designed_scene_stands_at_the_degrees_that_were_meant(task):
    angle = found(task).scene.driver.angle
    assert angle == round(angle, 9)


def lengths(task):
    return found(task).data["lengths"]


def test_slider_crank_by_stroke_offset_and_K():
    assert {"AB": 23.8220, "BC": 58.3700} == pytest.approx(lengths(SLIDER), abs=5e-5)


def test_slotter_by_K_stroke_and_centres():
    made = lengths(BAR)
    assert (75, 150, 100, 93.3013) == pytest.approx((made["AB"], made["AC"], made["CD"], made["ram"]), abs=5e-5)


@pytest.mark.parametrize("task", EACH, ids=lambda task: f"{task['kind']}{'-pivots' if 'A' in task else ''}")
def test_what_was_drawn_and_what_moves_confirm_the_wish(task):
    made = found(task)
    assert made.ok
    assert all(one.ok for one in made.confirmed)
    assert all(row.error <= 1e-9 * max(made.found.lengths.values()) for row in made.rows)


@pytest.mark.parametrize("task", EACH, ids=lambda task: f"{task['kind']}{'-pivots' if 'A' in task else ''}")
def test_every_length_that_is_compared_is_told_as_it_was_measured(task):
    made = found(task)
    *_, last = made.sheet.steps
    told = dict(re.findall(r"(\w+) = ([\d.]+) mm", say(last.phrase).replace("_", "")))
    assert {row.symbol: f"{row.on_paper:.2f}" for row in made.rows} == told


@pytest.mark.parametrize("name", designs())
def test_designs_that_come_along_can_be_made(name):
    assert graphkin.design(name).ok


@pytest.mark.parametrize(("swing", "rocker", "frame"), [(60, 75, 100), (40, 50, 50.5), (120, 30, 200)])
def test_a_crank_rocker_without_quick_return_has_its_crank_on_the_line_of_the_limits(swing, rocker, frame):
    made = found({"kind": "crank-rocker", "swing": swing, "rocker": rocker, "K": 1, "frame": frame})
    half = math.radians(swing / 2)
    expected = rocker * math.sin(half), math.sqrt(frame**2 - (rocker * math.cos(half)) ** 2), rocker, frame
    assert expected == pytest.approx([made.found.lengths[name] for name in ("AB", "BC", "CD", "AD")], rel=1e-12)
    points = {ref.point: at for ref, at in made.sheet.points.items()}
    assert abs(points["C1"] - points["A"]) < abs(points["C2"] - points["A"])
    assert 0 == pytest.approx(((points["C2"] - points["A"]) / (points["C1"] - points["A"])).imag, abs=1e-12)
    assert made.ok
    assert {"K": 1, "swing": pytest.approx(swing)} == {one.what.key.split()[1]: one.found for one in made.confirmed}


@pytest.mark.parametrize("more", [1e-12, 1e-9, 1e-6])
def test_a_crank_rocker_nearly_without_quick_return_is_as_exact(more):
    task = {"kind": "crank-rocker", "swing": 60, "rocker": 75, "frame": 100}
    flat, near = (lengths({**task, "K": K}) for K in (1, 1 + more))
    assert flat == pytest.approx(near, rel=3 * more + 1e-14)


def test_lengths_of_a_slider_crank_in_30_digits():
    with mpmath.workdps(30):
        theta = mpmath.pi * mpmath.mpf("0.2") / mpmath.mpf("2.2")
        # the two distances of A from the ends of the stroke enclose theta
        far, near = mpmath.findroot(
            lambda a, b: [a**2 + b**2 - 2 * a * b * mpmath.cos(theta) - 2500, a * b * mpmath.sin(theta) - 50 * 16],
            (82.2, 34.5),
        )
        expected = {"AB": float((far - near) / 2), "BC": float((far + near) / 2)}
    assert expected == pytest.approx(lengths(SLIDER), rel=1e-14)


def test_freudensteins_equation_holds_for_the_three_pairs():
    made = lengths(PAIRS)
    for phi, psi in PAIRS["pairs"]:
        B, C = made["AB"] * direction(phi), made["AD"] + made["CD"] * direction(psi)
        assert made["BC"] == pytest.approx(abs(C - B), rel=1e-12)


def test_a_bar_that_stands_opposite_to_the_angles_is_told():
    task = {"kind": "function", "pairs": [[20, 100], [60, 70], [110, 65]]}
    made = found(task)
    assert made.data["turned"]
    sign = {name: -1 if name in made.data["turned"] else 1 for name in ("AB", "CD")}
    for phi, psi in task["pairs"]:
        B = sign["AB"] * made.found.lengths["AB"] * direction(phi)
        C = 1 + sign["CD"] * made.found.lengths["CD"] * direction(psi)
        assert made.found.lengths["BC"] == pytest.approx(abs(C - B), rel=1e-12)


def test_fixed_pivots_given_the_moving_ones_are_carried_by_the_bar():
    made = found({**PLACES, "A": [0, 0], "D": [60, -10]})
    points = {name: complex(*at) for name, at in made.data["points"].items()}
    assert {"A", "D", "M", "N"} == set(points)
    first, *others = made.given.task.positions
    for bar in others:
        for fixed, moving, length in (("A", "M", "AM"), ("D", "N", "DN")):
            place = first.moved(points[moving], bar)
            assert made.found.lengths[length] == pytest.approx(abs(place - points[fixed]), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({**SLIDER, "K": 1.0}, "leaves the rod free"),
        ({**SLIDER, "K": 0.8}, "K must be above 1"),
        ({**BAR, "K": 1}, "K must be above 1"),
        ({**ROCKER, "K": 0.9}, "1 or more"),
        ({**ROCKER, "K": 1}, "greater than 50, the rocker"),
        ({**SLIDER, "offset": 300}, r"it must be below 170\.\d+"),
        ({**SLIDER, "offset": 0}, "an offset greater than 0"),
        ({**ROCKER, "frame": 500}, r"between [\d.]+ and [\d.]+"),
        ({**ROCKER, "swing": 180}, "below 180"),
        # where A has no room a drawing of four digits less had been no drawing of it
        ({**ROCKER, "swing": 40.000001, "K": 1.25, "frame": 50.00000001}, "is twice"),
        ({**BAR, "rod": 1}, r"it must exceed [\d.]+"),
        ({**LIMITS, "A": [100, 20]}, "two pivots apart"),
        ({**LIMITS, "A": [99, -80]}, "to one side"),
        ({**PLACES, "positions": [{"B": [x, 0], "angle": x} for x in (0, 10, 20)]}, "in one line"),
        ({**PLACES, "A": [11, -35], "D": [11, -35]}, "A: lies where D lies; two pivots apart"),
        ({**PLACES, "A": POLE, "D": [57, 28]}, "two of the places of A are one, .*; other pivots or other positions"),
        ({**PLACES, "A": [11, -35], "D": POLE}, "two of the places of D are one, .*; other pivots or other positions"),
        (ABOUT_ONE_CENTRE, "A and D fall together"),
        ({**PAIRS, "pairs": [[30, 45], [30, 45], [120, 90]]}, "three pairs"),
    ],
)
def test_what_no_mechanism_does_is_refused_with_what_one_could(change, said):
    with pytest.raises(graphkin.Unsolvable, match=said):
        found(change)


def test_the_greatest_offset_is_just_not_reached():
    with pytest.raises(graphkin.Unsolvable) as refused:
        found({**SLIDER, "offset": 300})
    most = float(re.search(r"below ([\d.]+)", refused.value.why)[1])
    assert found({**SLIDER, "offset": most * 0.999}).ok


def lying(first):
    """A bar that lies in three places, the first of which is given."""
    return {"kind": "three-positions", "positions": [first, {"B": [9, 9], "C": [18, 9]}, {"B": [9, 20], "C": [9, 29]}]}


@pytest.mark.parametrize(
    ("design", "said"),
    [
        ({"kind": "slider-crank", "stroke": 50}, "design.K: is missing"),
        ({**SLIDER, "stroke": -5}, "design.stroke: found -5, a negative length"),
        ({**SLIDER, "strok": 5}, 'did you mean "stroke"'),
        ({**SLIDER, "offset": -1}, "design.offset: found -1; 0 is the least that is possible here"),
        ({"kind": "slider"}, 'did you mean "slider-crank"? the kinds are slider-crank, crank-rocker, guide-bar'),
        ({"kind": "four-bar"}, "limits, three-positions, function"),
        ({"kind": "three-positions", "positions": [{"B": [0, 0], "C": [1, 0]}]}, "found 1 of them"),
        ({"kind": "function", "pairs": [[1, 2], [3], [4, 5]]}, "design.pairs.2: found [3]; two angles in degrees"),
        ({**SLIDER, "K": -1}, "design.K: found -1, a negative number"),
        ({**PLACES, "A": [0, 0]}, "design.D: is missing"),
        ({**PLACES, "angles": [10, -8, -35]}, "design.angles: unknown key"),
        ({"kind": "limits", "A": [0], "D": [1, 1], "rocker": 1, "angles": [1, 2]}, "a place is"),
        ({"stroke": 50}, "design.kind: is missing; one of slider-crank, crank-rocker, guide-bar, limits"),
        (lying({"B": [0, 0]}), "design.positions.1: has neither C nor angle; a bar lies where B and C lie"),
        (lying({"B": [0, 0], "C": [9, 0], "angle": 0}), "design.positions.1: has both C and angle"),
        (lying({"B": [0, 0], "angle": 0}), "design.BC: is missing; length of the bar, since its places are told by"),
        (lying({"B": [0, 0], "C": [9, 0]}) | {"BC": 8}, "design.BC: found 8; B and C of position 1 lie 9 apart"),
        (lying({"B": [0, 0], "C": [0, 0]}), "design.positions.1: B and C lie at one place; a bar has a length"),
        (lying({"B": [0, 0], "C": [8, 0]}), "design.positions.2: the bar is 9 long; in position 1 8"),
    ],
)
def test_a_wrong_file_is_told_by_name(design, said):
    with pytest.raises(graphkin.SceneError, match=re.escape(said)):
        found(design)


@pytest.mark.parametrize(("file", "said"), [
    ({"links": {}, "design": SLIDER}, "links: unknown table; this is a scene; a design file has a table [design]"),
    ({"units": {}}, "design: is missing; a design file has a table [design] with kind and its data"),
    ("slider-crank-s50", 'no design of this name comes along; did you mean "slider-crank-stroke-50"?'),
])
def test_what_is_no_design_file_is_told_so(file, said):
    with pytest.raises(graphkin.SceneError, match=re.escape(said)):
        graphkin.design(file)


def test_all_problems_of_a_file_are_told_at_once():
    with pytest.raises(graphkin.SceneError) as wrong:
        graphkin.design({"design": {"kind": "slider-crank", "stroke": 0, "K": "x"}, "unitz": {}})
    assert 3 == len(wrong.value.problems)


@pytest.mark.parametrize("task", [SLIDER, ROCKER, EVEN, PLACES], ids=lambda task: f"{task['kind']}-{task.get('K')}")
def test_pencils_stay_within_what_is_predicted(task):
    given = design_of({"design": task})
    exact = synthesise(given.task).lengths
    rows = [
        row
        for seed in range(40)
        for hand in [pencil(Tools(), seed)]
        for row in compare_lengths(given.task, construct(given.task, 1.0, hand), exact)
    ]
    assert 0.95 < sum(row.ok for row in rows) / len(rows)
    assert any(row.error > 0.02 for row in rows)


def test_a_wrong_construction_is_noticed():
    task = design_of({"design": SLIDER}).task
    wrong = construct(design_of({"design": {**SLIDER, "offset": 16.001}}).task)
    assert not all(row.ok for row in compare_lengths(task, wrong, synthesise(task).lengths))


def test_the_command_writes_figure_and_scene_and_says_how_it_went(tmp_path):
    (tmp_path / "task.toml").write_text('[design]\nkind = "slider-crank"\nstroke = 50\noffset = 16\nK = 1.2\n')
    done = run("design", str(tmp_path / "task.toml"), "-o", str(tmp_path / "out"), "--json")
    assert 0 == done.returncode
    data = json.loads(done.stdout)
    assert {"kind", "ok", "lengths", "points", "readings"} <= set(data)
    assert ["AB", "BC"] == [row["symbol"] for row in data["readings"]]
    assert {"design.svg", "choice.svg", "scene.toml"} == {path.name for path in (tmp_path / "out").iterdir()}
    turn = graphkin.sweep(tmp_path / "out" / "scene.toml", positions=12).data["outputs"][0]
    assert (50, 1.2) == pytest.approx((turn["stroke"], turn["K"]))


def test_the_command_ends_with_the_status_of_the_contract(tmp_path):
    for status, K in ((3, "1"), (2, "-1"), (2, '"x"')):
        (tmp_path / "task.toml").write_text(f'[design]\nkind = "slider-crank"\nstroke = 50\noffset = 16\nK = {K}\n')
        assert status == run("design", str(tmp_path / "task.toml"), "-o", str(tmp_path / "out")).returncode
    assert not (tmp_path / "out").exists()


def test_every_length_on_the_figure_is_that_of_the_drawing_at_its_scale():
    svg = found(LIMITS).figures["design"].content("svg").decode()
    sheet = found(LIMITS).sheet
    ends = [(float(a), float(b)) for a, b in re.findall(r'<line[^>]*?x1="([\d.-]+)"[^>]*?x2="([\d.-]+)"', svg)]
    rocker = sheet.points[PointRef("C1")] - sheet.points[PointRef("D")]
    assert abs(rocker) * sheet.scales.length == pytest.approx(60)
    across = abs(rocker.real)
    assert any(math.isclose(abs(b - a), across, abs_tol=2e-3) for a, b in ends)


def test_measured_lengths_on_the_figure_are_what_the_paper_and_the_scale_come_to():
    made = graphkin.design("function-three-pairs")
    told = re.sub(r"<[^>]*>", "|", made.figures["design"].content("svg").decode())
    for row in made.rows:
        read = f"{row.on_paper:.2f}"
        assert f"|{read}|" in told
        assert f"|{float(read) * made.sheet.scales.length:.6g}|" in told


TURNED = [[30, 45], [70, 75], [130, 95]]
"""Pairs that no bars but opposite ones meet."""


@pytest.mark.parametrize(
    "pairs", [PAIRS["pairs"], [[40, 30], [70, 50], [110, 80]], [[60, 25], [80, 45], [130, 120]], TURNED]
)
def test_quotients_of_the_diagram_of_reciprocals_are_true_as_written(pairs):
    made = graphkin.design({"design": {**PAIRS, "pairs": pairs}})
    said = " ".join(say(step.phrase) for step in made.sheet.steps)
    base = re.search(r"draw AD, ([\d.]+) mm", said)[1]
    sums = re.findall(r"AD·([\d.]+)/([\d.]+) = ([\d.]+) mm", said)
    assert 2 == len(sums)
    assert [length for _, _, length in sums] == [f"{float(base) * float(a) / float(b):.2f}" for a, b, _ in sums]


def test_the_coordinates_of_a_crossing_on_the_negative_side_have_the_minus_of_print():
    said = " ".join(say(step.phrase) for step in found({**PAIRS, "pairs": TURNED}).sheet.steps)
    assert re.search(r"Q lies −[\d.]+ mm across and −[\d.]+ mm up", said)


@pytest.mark.parametrize(("design", "said"), [
    ({"kind": "limits", "A": [0, 0], "D": [-80, 20], "rocker": 40, "angles": [-150, -100]}, "limits −150° and −100°"),
    ({"kind": "crank-rocker", "swing": 100, "rocker": 60, "K": 3.5, "frame": 58}, "lay off 10° at the left end"),
])
def test_angles_that_are_laid_off_have_the_minus_of_print_and_a_size(design, said):
    assert said in " ".join(say(step.phrase) for step in found(design).sheet.steps)


def test_what_a_turn_confirms_is_named_in_both_languages():
    svg = graphkin.design("crank-rocker-swing-32", language="both").figures["design"].content("svg").decode()
    assert "swing 摆角" in re.sub(r"<[^>]*>", "", svg)


@pytest.mark.parametrize(("design", "said"), [
    (PLACES, "B1 (10, 60), 10°; B2 (35, 80), −8°; B3 (70, 82), −35°"),
    ({"kind": "three-positions", "positions": [{"B": [0, 0], "C": [40, 30]}, {"B": [10, 5], "C": [50, 35.0]},
                                               {"B": [30, 5], "C": [30, 55]}]},
     "B1 (0, 0), C1 (40, 30); B2 (10, 5), C2 (50, 35); B3 (30, 5), C3 (30, 55)"),
])
def test_places_of_a_bar_that_are_given_stand_on_the_figure(design, said):
    drawn = re.sub(r"<[^>]*>|\s", "", found(design).figures["design"].content("svg").decode())
    assert said.replace(" ", "") in drawn


def test_what_a_turn_confirms_stands_on_the_figure_with_its_unit():
    made = found(SLIDER)
    words = [t.string for t in walk(made.figures["design"].children) if isinstance(t, Text)]
    stroke = f"{SLIDER['stroke']:g} mm"
    assert [stroke, stroke] == words[words.index("stroke") + 1 :][:2]


@pytest.mark.parametrize(
    ("task", "low", "high"),
    [
        # H / tan(theta), beyond which the circle does not reach the line; and the rocker, or where the arc about D
        # touches the circle over C1C2
        ({"kind": "slider-crank", "stroke": 120, "offset": 30, "K": 1.35}, 0.0, 120 / math.tan(math.pi * 0.35 / 2.35)),
        ({"kind": "crank-rocker", "swing": 50, "rocker": 80, "K": 1.4, "frame": 60},
         80 * math.sin(math.radians(50 - 30)) / math.sin(math.radians(30)), 80.0),
    ],
)
def test_a_free_datum_is_told_as_far_as_the_rest_of_the_wish_is_met(task, low, high):
    free = graphkin.design({"design": task}).data["choice"]
    assert (low, high) == pytest.approx((free["from"], free["to"]), rel=1e-8, abs=1e-9)


@pytest.mark.parametrize(("language", "said"), [("zh", "机架"), ("both", "frame"), (None, "frame")])
def test_the_chart_of_the_free_datum_speaks_the_language_of_the_call(language, said):
    chart = graphkin.design("crank-rocker-swing-32", language=language).figures["choice"]
    assert f">{said} (mm)<" in chart.content("svg").decode()


def test_a_rocker_that_is_the_better_the_smaller_it_is_has_no_best():
    assert graphkin.design("rocker-limits").choice is None


def test_the_ends_between_which_a_free_datum_may_be_chosen_are_not_said_to_be_chosen():
    rocker = {"kind": "crank-rocker", "swing": 32, "rocker": 75, "K": 1.25}
    (_, said) = graphkin.design({"design": {**rocker, "frame": 70}}).sentences("en")
    assert said.startswith("frame may be chosen between 45.592 and 75 ")
    with pytest.raises(graphkin.Unsolvable, match=r"between 45\.592 and 75"):
        graphkin.design({"design": {**rocker, "frame": 75}})
