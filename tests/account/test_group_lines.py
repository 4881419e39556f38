"""What a sheet writes of groups larger than a dyad: from it alone they can be drawn again."""

from __future__ import annotations

import re
from itertools import combinations
from types import SimpleNamespace

import pytest

from graphkin import draw
from graphkin.account.account import telling, why, written_lines
from graphkin.account.in_mechanism import InMechanism
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.construction import draft
from graphkin.construction.board.sheet import Equation
from graphkin.construction.board.steps import Step, TrialPositions
from graphkin.drawing.parts.polygon import extent
from graphkin.drawing.sheet_plan import sheet_plan, with_less_mechanism, with_less_polygons
from graphkin.drawing.text import runs_width, wrapped
from graphkin.scene import mechanism_of
from graphkin.scene.symbol import PointRef
from graphkin.words.symbols import sign
from tests.construction.test_groups import BARE, HELD, UNBARRED, WELDED
from tests.drawn import drafted

GROUPS = ("contour-four-bars", "double-butterfly", "loader-cylinder", "single-flier", "sixbar-1A-last-link",
          "triad-slider")


def told(name, language="en"):
    """The lines of a sheet in words, spaces plain."""
    sheet, _ = drafted(name)
    lines = written_lines(sheet, notation_of(sheet, "chinese"), language)
    return [repr(line).replace("\u00a0", " ") for line in lines if not isinstance(line, Equation)]


def test_trial_positions_are_told_from_point_to_point_with_what_is_missed():
    line = next(line for line in told("contour-four-bars") if "by trial" in line)
    assert "$GE$ of link 6 to the x axis at −174.93°, −174.09°, −173.26°" in line
    assert "$E$, $F$ (6), $C$ ($B$, $E$), $D$ (3)" in line
    assert "the length $DF$ measured, less 32.50 mm, is 0.56 mm in 3, −0.25 mm in 4" in line
    assert line.endswith("it fits at −172.68°")


def test_a_point_on_a_guide_is_told_with_the_name_of_the_guide():
    assert any("$D$ (5)，" in line or "$E$ ($D$, $h$)" in line for line in told("triad-slider"))


@pytest.mark.parametrize("language", ["en", "zh"])
@pytest.mark.parametrize("name", GROUPS)
def test_every_point_of_a_group_placed_by_trial_is_told(name, language):
    sheet, _ = drafted(name)
    line = next(line for line in told(name, language) if "trial" in line or "试凑" in line)
    (act,) = (step for step in sheet.steps if isinstance(step, TrialPositions))
    known = (link for name, link in sheet.structure.links.items() if name not in act.links)
    before = {p for link in (sheet.scene.frame, *known) for p in link.points}
    points = {p for link in act.links for p in sheet.structure.links[link].points} - before
    assert points
    assert set() == {p for p in points if f"${p}$" not in line}


def test_lengths_to_a_special_point_are_measured_where_it_stands():
    lines = told("single-flier")
    special = next(i for i, line in enumerate(lines) if line.startswith("$S$ on link 5:"))
    assert ["$l_{SH}$", "$l_{KS}$", "$l_{JS}$"] == [line.split(" = ")[0] for line in lines[special + 1 : special + 4]]
    assert not any("l_{SH}" in line for line in lines[:special])


@pytest.mark.parametrize("name", GROUPS)
def test_every_length_in_a_product_is_given_or_measured(name):
    sheet, _ = drafted(name)
    per = sheet.scene.units.rates.metres
    bodies = (sheet.scene.frame, *sheet.scene.links)
    known = {abs(z - w) / per for body in bodies for z, w in combinations(body.points.values(), 2)}
    lines = told(name)
    known |= {float(n) for line in lines if line.startswith("$l_") for n in re.findall(r"[\d.]+", line.split("=")[-1])}
    squares = [float(n) for line in lines for n in re.findall(r"² × ([\d.]+) =", line)]
    assert squares
    assert [] == [n for n in squares if not any(n == pytest.approx(one, rel=1e-4) for one in known)]


def test_what_trial_polygons_leave_open_is_told_with_its_sense():
    lines = told("double-butterfly")
    start = next(i for i, line in enumerate(lines) if line.startswith("trial polygons"))
    assert "without link 8; gap on paper from $k$ to $p$ along $KD$, positive from $K$ to $D$:" in lines[start]
    trials = ["$I$: $ω_{3}$ = −1 rad/s;  gap 34.63 mm", "$II$: $ω_{3}$ = −1.6 rad/s;  gap −9.23 mm"]
    divided = "no gap: $ω_{3}$ = −1 − 34.63 / (9.23 + 34.63) × 0.6 = −1.4737 rad/s"
    assert [*trials, divided] == lines[start + 1 : start + 4]


@pytest.mark.parametrize(("name", "triangles"), [("double-butterfly", 6), ("single-flier", 8), ("loader-cylinder", 4)])
def test_triangles_that_are_told_are_similar_in_one_sense(name, triangles):
    sheet, _ = drafted(name)
    ends = Account(sheet, notation_of(sheet, "chinese"))
    found = [pair for line in told(name) for pair in re.findall(r"△\$([^$]+)\$ ∽ △\$([^$]+)\$", line)]
    assert triangles <= len(found)
    for image, link in found:
        diagram = "acceleration" if "'" in image else "velocity"
        a, b, c = (sheet.points[PointRef(p)] for p in re.findall(r"[A-Z]", link))
        letters = re.findall(r"[a-z](?:_\{?\d\}?)?'?", image)
        x, y, z = (0j if letter[0] == "p" else _end(sheet, ends, diagram, letter) for letter in letters)
        assert (c - a) / (b - a) == pytest.approx((z - x) / (y - x), abs=1e-6)


def _end(sheet, ends, diagram, letter):
    named = (PointRef(p, n) for p in sheet.scene.holders for n in ("", *sheet.structure.links))
    points = [ends.end_point(diagram, ref) for ref in (PointRef("S"), *named)]
    return next(point.at for point in points if point is not None and repr(point.letter) == f"${letter}$")


def test_links_seen_from_a_held_one_are_told_with_the_rates_that_add_up():
    lines = told("scissor-lift")
    assert 2 == lines.count("marked (3): seen from link 3, held still")
    rule = r"(?:\$ω_\{7\}\$ = )?\$ω_\{(\d)\}\$ = \$ω_\{3\}\$ \+ \$ω_\{\d3\}\$"  # 7 slides on 6
    sums = [re.fullmatch(rule + r" = (.*) = (\S+)(?: \(.*\))? rad/s", line) for line in lines]
    found = {m[1]: (m[2], m[3]) for m in sums if m}
    assert {"2", "4", "5", "6"} == set(found)
    sheet, _ = drafted("scissor-lift")
    for link, (terms, value) in found.items():
        whole = sum(float(part) for part in terms.replace(" ", "").replace("−", "-").split("+"))
        assert whole == pytest.approx(float(value.replace("−", "-")), abs=1e-12)
        assert whole == pytest.approx(sheet.rates["omega"][link].value, abs=2e-6)


@pytest.mark.parametrize("scene", [BARE, UNBARRED, HELD, WELDED], ids=["bare", "unbarred", "held", "welded"])
def test_what_a_driver_between_links_of_a_group_adds_is_told_and_true(scene):
    sheet = draft(mechanism_of(scene))
    steps = [step for step in sheet.steps if step.reason == "sum of rates"]
    assert {"omega", "alpha"} == {step.kind for step in steps}
    account = Account(sheet, notation_of(sheet, "chinese"))
    for step in steps:
        (line,) = telling(account, step).written("en")
        line = repr(line).replace("\u00a0", " ")
        terms, value = re.fullmatch(r".*\$ = ([^=$]+) = (\S+)(?: \(\S+\))? rad/s²?", line).groups()
        value = float(value.replace("−", "-"))
        rates = sheet.rates[step.kind]
        assert rates[step.link].value == pytest.approx(value, abs=1e-4 * max(abs(step.value), abs(step.other)))
        assert eval(terms.replace("−", "-")) == pytest.approx(value, abs=1e-12)


@pytest.mark.parametrize(("language", "named"), [
    ("en", "the distance of $B$ to the left of the guide g of link 5, less what it should be,"),
    ("zh", "$B$ 偏离构件 5 上导路 g 的距离（向左为正）减去应有值"),
])
def test_what_is_missed_at_a_guide_is_told_with_the_guide(language, named):
    sheet = draft(mechanism_of(BARE))
    lines = written_lines(sheet, notation_of(sheet, "chinese"), language)
    assert any(named in repr(line) for line in lines)


def test_what_is_carried_over_from_a_held_link_is_told_by_its_parts():
    sheet, _ = drafted("scissor-lift")
    (line,) = (line for line in told("scissor-lift") if line.startswith("$a^{r}_{A3A2}$"))
    # a point of 3, seen from 2: less what 2 does seen from 3, and twice how 3 turns in 2 times the relative velocity
    given = re.fullmatch(r".* = −\$a\^\{\(3\)\}_\{A2A3\}\$ and from its end .* = ([\d.]+) mm/s², "
                         r"along \$v_\{A3\}\$ turned 90° (clockwise|counter-clockwise)", line)
    assert given
    seen = next(s.span for step in sheet.steps if step.diagram == "acceleration" for s in step.strokes
                if getattr(s, "symbol", None) is not None and s.symbol.of == PointRef("A")
                and s.symbol.to == PointRef("A", "3"))
    velocity = next(v.span for v in sheet.vectors["velocity"].values() if v.symbol.of == PointRef("A", "3"))
    turned = {"clockwise": -1j, "counter-clockwise": 1j}[given[2]]
    per = sheet.scales.acceleration / sheet.scene.units.rates.metres
    share = float(given[1]) / per * turned * velocity / abs(velocity)
    whole = next(v.span for v in sheet.vectors["acceleration"].values() if v.symbol.kind == "ar"
                 and v.symbol.of == PointRef("A", "3"))
    assert whole == pytest.approx(share - seen, abs=2e-3)


@pytest.mark.parametrize("name", ["four-bar-coupler-point", "triad-slider", "sixbar-AE70"])
def test_panels_that_leave_room_lie_clear_of_what_is_written_there(name):
    _, sheet = drafted(name)
    plan = sheet_plan(sheet)
    heights = [extent(sheet, d).height + 14.0 for d in ("velocity", "acceleration")]
    plans = [less for each in (plan, *with_less_mechanism(plan, sheet)) for less in with_less_polygons(each, heights)]
    assert plans
    for one in plans:
        boxes = [one.mechanism, one.velocity, one.acceleration, one.equations, one.given, one.readings, one.beside]
        for a, b in combinations(boxes, 2):
            assert a.right <= b.left or b.right <= a.left or a.bottom <= b.top or b.bottom <= a.top
        assert one.velocity.height >= min(heights[0], plan.velocity.height) - 1e-9
        assert one.acceleration.height >= min(heights[1], plan.acceleration.height) - 1e-9


def test_writing_that_no_panel_needs_room_for_goes_on_one_page():
    assert ["sheet"] == [name for name in draw("four-bar-coupler-point").figures if name.startswith("sheet")]


def test_an_open_end_on_a_block_is_told_by_its_letter():
    # a pin of link 5 in the block 7 of a guide on 6: the block has a letter, c7, that bears its index
    sheet, _ = drafted("loader-cylinder")
    ends = Account(sheet, notation_of(sheet, "chinese"))
    assert sign("e", "7") == ends.end_of("velocity", PointRef("E", "7")) == ends.end_of("velocity", PointRef("E"))
    assert sign("e", "6") == ends.end_of("velocity", PointRef("E", "6"))


def test_chinese_lists_break_after_their_commas():
    lines = wrapped("与 x 轴夹角取 147.72°、151.06°、154.41°、157.75°、161.09°", 2.6, 30.0)
    assert all(runs_width(line) <= 30.0 for line in lines)
    assert not any("".join(run.text for run in line).startswith("、") for line in lines)


def test_an_acceleration_as_seen_from_a_held_link_bears_its_mark():
    sheet, _ = drafted("scissor-lift")
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    steps = [step for step in sheet.steps if step.diagram == "acceleration"]
    said = " ".join(repr(telling(speaker, step).sentence("en")) for step in steps)
    assert "$a^{(3)}_{FF3}$" in said
    assert "$a_{FF3}$" not in said


def test_trial_polygons_say_that_a_link_is_left_out_not_an_equation():
    assert any("drawn by the equations below without link 5;" in line for line in told("contour-four-bars"))


def test_a_moving_point_over_a_pivot_is_no_fixed_pivot():
    sheet, _ = drafted("scissor-lift")
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    said = " ".join(repr(why(speaker, equation, "en")) for equation in sheet.equations)
    assert "fixed pivot $A_{3}$" not in said
    assert "$B$ and $A_{3}$ are points of the rigid link 3: the relative acceleration has a part" in said


def test_the_rate_that_a_division_gives_is_the_value_of_its_sum():
    sheet, _ = drafted("double-butterfly")
    account = Account(sheet, notation_of(sheet, "chinese"))
    said = " ".join(str(telling(account, step).sentence("en")) for step in sheet.steps if step.reason == "open ends")
    assert "α_3 = 7.562 (7.5619) rad/s², that is 6 + 11.42 / (10.51 + 11.42) × 3" in said


def test_the_way_to_the_points_of_a_group_ends_where_the_trials_of_the_next_group_begin():
    trial = TrialPositions("trial", "positions", number=1)
    marks = [Step("mark", "points", link=link, points=(point,)) for point, link in (("B", "2"), ("E", "4"))]
    sheet = SimpleNamespace(steps=(trial, marks[0], trial, marks[1]))
    account = SimpleNamespace(sheet=sheet, letters=SimpleNamespace(point=sign))
    assert ["B (2)"] == [str(line) for line in InMechanism(account, trial)._route()]
