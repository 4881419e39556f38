"""Sums on a sheet: measured lengths with their millimetres, products and quotients true as written."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from decimal import Decimal
from types import SimpleNamespace

import numpy as np
import pytest

from graphkin import check, draw, read
from graphkin.account.account import telling, written_lines
from graphkin.account.arithmetic import (
    divisions,
    factors_of,
    laid_sum,
    lengths_measured,
    plan_sum,
    rate_sum,
    rule_sum,
    scale_of,
    trials_of,
)
from graphkin.account.notation import notation_of
from graphkin.account.voice import account_of
from graphkin.checking.readings import read_off
from graphkin.checking.report import measured
from graphkin.construction import draft, pencil
from graphkin.construction.board.instruments import EXACT
from graphkin.construction.board.sheet import Board, Equation
from graphkin.construction.board.steps import Direction, Size, Step
from graphkin.drawing.ink.primitives import Text, walk
from graphkin.drawing.sheet_plan import sheet_room
from graphkin.scene import library, mechanism_of
from graphkin.scene.scene_tables import Tools
from graphkin.scene.symbol import PointRef, Symbol
from graphkin.words import say
from graphkin.words.written import amount, on_paper, product
from tests.drawn import drafted


def drawn(name):
    sheet, _ = drafted(name)
    return sheet, notation_of(sheet, "chinese")


def test_a_length_that_is_not_given_stands_with_its_millimetres():
    assert ["$l_{CB}$ = 190.80 mm × 2 mm/mm = 381.6 mm"] == [
        repr(line) for *_, line in lengths_measured(*drawn("sixbar-guide-40deg"))
    ]


def test_a_solution_measures_a_length_in_the_step_that_needs_it_first():
    account = account_of(drawn("sixbar-guide-40deg")[0])
    told = [repr(line) for step in account.sheet.steps for line in telling(account, step).work]
    lengths = [(line, told[k + 1].split(" = ")[0]) for k, line in enumerate(told) if line.startswith("$l_")]
    assert [
        ("$l_{CB}$ = 190.80 mm × 2 mm/mm = 381.6 mm", "$ω_{3}$"),
        ("$l_{CD}$ = 83.79 mm × 2 mm/mm = 167.58 mm", "$v_{D3}$"),
    ] == lengths


def test_nothing_is_measured_where_every_length_is_given():
    assert [] == [*lengths_measured(*drawn("fourbar-150-500-300-400"))]


def test_the_sheet_tells_the_rate_in_numbers_once():
    lines = [repr(line) for line in written_lines(*drawn("sixbar-guide-40deg"), "en") if not isinstance(line, Equation)]
    assert 1 == sum("1075.8\u00a0/\u00a0381.6 =\u00a02.819" in line for line in lines)


@pytest.mark.parametrize("name", ["contour-four-bars", "double-butterfly"])
def test_trial_rates_are_divided_as_it_is_written(name):
    sheet, _ = drawn(name)
    steps = [step for step in sheet.steps if step.reason == "open ends"]
    assert ["velocity", "acceleration"] == [step.diagram for step in steps]
    for step in steps:
        for (_, rate), one in zip(step.rates, divisions(sheet, step), strict=True):
            value = eval(one.terms.replace("×", "*").replace("−", "-"))
            told = one.value.split(" ")[0].replace("−", "-")
            assert value == pytest.approx(float(told), abs=0.5000001 * 10.0 ** -len(told.partition(".")[2]))
            assert rate == pytest.approx(value, rel=5e-3)


def test_the_sheet_tells_how_trials_are_divided():
    lines = [repr(line) for line in written_lines(*drawn("contour-four-bars"), "en") if not isinstance(line, Equation)]
    told = [line.replace("\u00a0", " ") for line in lines if "no gap" in line]
    assert "no gap: $ω_{3}$ = −6 − 6.13 / (5.97 + 6.13) × 1.3 = −6.659 (−6.6584) rad/s" == told[0]
    assert 2 == len(told)


@pytest.mark.parametrize("name", sorted(library())[::4])
def test_every_sum_is_true_as_it_is_written(name):
    sheet, _ = drawn(name)
    for step in sheet.steps:
        if step.reason == "rate" and not step.held:
            text = rate_sum(sheet, step, units=False)
        elif step.verb == "lay off" and step.mm:
            text = rule_sum(sheet, step.size, step.diagram)
        else:
            continue
        if not text or "·10" in text:
            continue
        sum_, told = text.split(" = ")
        value = eval(re.sub("²", "**2", sum_.replace("×", "*")))
        result = told.split(" ")[0]
        step_of = 10.0 ** -len(result.partition(".")[2])
        assert abs(value - float(result)) <= 0.5000001 * step_of, text


@pytest.mark.parametrize("at", [170.0, 215.0, 331.0])
def test_an_equation_that_is_only_a_rule_is_the_product_of_what_it_shows(at):
    root = ET.fromstring(draw("rotating-guide-bar", at=at).figures["sheet"].content("svg"))
    texts = ("".join(text.itertext()) for text in root.iter("{http://www.w3.org/2000/svg}text"))
    whole = " ".join(texts).replace("\u00a0", " ")
    sums = re.findall(r"((?:[\d.]+²? × )+[\d.]+) = ([\d.]+)", whole)
    assert sums
    for factors, value in sums:
        exact = math.prod(float(one.rstrip("²")) ** (1 + one.endswith("²")) for one in factors.split(" × "))
        last = 10.0 ** -len(value.partition(".")[2])
        assert float(value) == pytest.approx(exact, rel=0.0, abs=0.5001 * last)


def test_no_length_of_nothing_is_among_the_given_ones():
    # the pitch circle of this cam stands about its pivot at this position
    text = draw("cam-swinging-roller", at=25).figures["sheet"].content("svg").decode()
    assert "·10" not in "".join(ET.fromstring(text).itertext())


@pytest.mark.parametrize("instrument", [EXACT, pencil(Tools(), 1)])
def test_a_rate_read_off_the_plan_of_a_train_is_the_product_of_what_it_shows(instrument):
    sheet = draft(mechanism_of("gears-epicyclic"), instrument=instrument)
    sums = [plan_sum(step).split(" ") for step in sheet.steps if step.reason == "plan"]
    assert sums
    for length, _, _, scale, _, _, value, *_ in sums:
        assert Decimal(value) == Decimal(length) * Decimal(scale)


@pytest.mark.parametrize(("name", "seed"), [("gears-epicyclic", 1), ("geared-five-bar", 2), ("gears-epicyclic", 5)])
def test_the_sentence_of_a_rate_read_off_a_plan_says_the_product_of_its_numbers(name, seed):
    sheet = draft(mechanism_of(name), instrument=pencil(Tools(), seed))
    said = " ".join(say(step.phrase) for step in sheet.steps if step.reason in ("plan", "given on plan"))
    sums = re.findall(r"= ([\d.]+) × ([\d.]+) = ([\d.]+)", said)
    assert sums
    assert [Decimal(value) for _, _, value in sums] == [Decimal(one) * Decimal(other) for one, other, _ in sums]


@pytest.mark.parametrize("instrument", ["exact", "pencil"])
def test_rates_in_the_table_of_a_plan_are_their_millimetres_times_the_scale(instrument):
    figure = draw("gears-epicyclic", figures=["plan"], instrument=instrument).figures["plan"]
    texts = [t for t in walk(figure.children) if isinstance(t, Text) and not t.id]
    lines = [[t.string for t in texts if t.at.imag == height] for height in dict.fromkeys(t.at.imag for t in texts)]
    rows = [line for line in lines if len(line) == 3 and line[0] in "123"]
    read = [(Decimal(mm), Decimal(rate.replace("−", ""))) for _, mm, rate in rows if "(" not in rate]
    assert 2 == len(read)
    assert [rate for _, rate in read] == [mm * Decimal("0.25") for mm, _ in read]


@pytest.mark.parametrize("length", [70.0, 80.0, 85.0])
def test_the_pull_of_a_spring_is_what_its_numbers_come_to(length):
    scene = read("rocker-return-spring").replace("links.1.length", length)
    whole = "".join(ET.fromstring(draw(scene).figures["forces"].content("svg")).itertext()).replace("\u00a0", " ")
    start, rate, now, free, pull = map(Decimal, re.search(
        r"= ([\d.]+) \+ ([\d.]+) × \(([\d.]+) − ([\d.]+)\) = ([\d.]+)", whole).groups())
    assert abs(start + rate * (now - free) - pull) <= Decimal("0.5") * Decimal(1).scaleb(pull.as_tuple().exponent)


@pytest.mark.parametrize("name", ["sixbar-420rpm", "shaper-scheme-2"])
def test_with_a_pencil_given_lengths_stay_given_in_every_sum(name):
    scene = mechanism_of(name)
    sheet = draft(scene, instrument=pencil(Tools(), 3))
    given = {
        frozenset((p, q)): abs(z - w) / scene.units.rates.metres
        for link in (scene.frame, *scene.links)
        for p, z in link.points.items()
        for q, w in link.points.items()
    }
    arms = [(step.points, rate_sum(sheet, step, units=False).split(" = ")[0].split(" / ")[-1])
            for step in sheet.steps if step.reason == "rate" and not step.held]
    sizes = [step.size for step in sheet.steps if step.size and step.size.rule == "rate"]
    arms += [(size.factor, factors_of(sheet, size)[-1]) for size in sizes if not isinstance(size.factor, Symbol)]
    told = [(given[frozenset(bar)], float(arm)) for bar, arm in arms if frozenset(bar) in given]
    assert len(told) >= 5
    assert [] == [(true, said) for true, said in told if said != pytest.approx(true, rel=1e-4)]


BY_RATE = {  # link 2 turns on a block of 3, as seen from 4, at the driver's rate: about no hinge of 4
    "frame": {"points": {"A": [0, 0], "D": [135.501, 12.632]}},
    "links": {
        "1": {"points": ["A"]},
        "2": {"points": ["B"], "on": "3.g", "angle_on": 33.9},
        "3": {"points": ["D"], "on": "5", "guides": {"g": {"through": [-37.321, 20.627], "angle": 130.96}}},
        "4": {"points": ["B", "C"], "length": 54.673, "on": "1", "angle_on": 68.22},
        "5": {"points": ["C"]},
    },
    "driver": {"link": "2", "relative_to": "4", "angle": -23.85, "omega": -3.33, "alpha": 37.9},
    "sketch": {"B": [151.3, 35.6], "C": [159.4, 89.6]},
}


def seen_from_a_held_link():
    sheet = draft(mechanism_of(BY_RATE))
    return sheet, [step for step in sheet.steps if step.reason == "rates" and step.held]


def test_what_a_held_link_shows_is_laid_off_by_the_rates_as_the_other_vectors_are():
    sheet, steps = seen_from_a_held_link()
    assert ["velocity", "acceleration"] == [step.diagram for step in steps]
    for step in steps:
        drawn_ = {aid.symbol: aid for aid in step.auxiliary}
        vectors = (aid for t in sheet.steps for aid in t.auxiliary)
        (start,) = (s.tip for s in vectors if s.symbol == step.begins[0])
        parts = step.by_rates
        assert drawn_[step.symbol].tip - start == pytest.approx(sum(part.span for part in parts), abs=1e-9)


def test_sizes_relative_to_a_held_link_stand_in_numbers():
    sheet, _ = seen_from_a_held_link()
    lines = [repr(line).replace("\u00a0", " ") for line in written_lines(sheet, notation_of(sheet, "chinese"), "en")
             if not isinstance(line, Equation)]
    told = [part for line in lines for part in line.split(";  ")]
    by_rates = [line for line in told if "(4)}_{D3B3}" in line]
    assert ["3.33 × 27.861 = 92.777 mm/s,  $⊥DB$", "3.33² × 27.861 = 308.95 mm/s²,  $D→B$",
            "37.9 × 27.861 = 1055.9 mm/s²,  $⊥DB$"] == [line.split(" = ", 2)[2] for line in by_rates]
    assert "$a^{n(4)}_{D5C}$ = 3.33² × 80.645 = 894.26 mm/s²" in told
    assert "$a^{k(4)}_{B3B5}$ = 2 × 3.33 × 128.65 = 856.81 mm/s²" in told


def test_lengths_from_a_special_point_are_measured_before_they_are_used():
    named = [repr(line).split(" = ")[0] for *_, line in lengths_measured(*drawn("single-flier"))]
    assert ["$l_{SH}$", "$l_{KS}$", "$l_{JS}$"] == named


def test_what_a_cylinder_is_pushed_to_is_given_and_not_measured():
    assert ["$l_{CB}$ = $s_{23}$ = 520 mm"] == [
        repr(line) for *_, line in lengths_measured(*drawn("hydraulic-cylinder"))
    ]


@pytest.mark.parametrize("name", ["whitworth", "four-bar-coupler-point", "shaper-scheme-2"])
def test_with_a_pencil_products_take_measured_rates_as_they_stand_on_the_sheet(name):
    sheet = draft(mechanism_of(name), instrument=pencil(Tools(), 3))
    said = {step.link: rate_sum(sheet, step).rsplit(" = ", 1)[-1].split()[0] for step in sheet.steps
            if step.reason == "rate" and step.kind == "omega"}
    sizes = [step.size for step in sheet.steps if step.size and step.size.rule == "rate"]
    used = [(said[sheet.rates["omega"][size.links[0]].same_as or size.links[0]], factors_of(sheet, size)[size.twice])
            for size in sizes if size.rate == "omega" and sheet.rates["omega"][size.links[0]].vector]
    assert used
    assert [] == [(one, other) for one, other in used if one != other]


def test_with_a_pencil_a_product_carries_the_figures_of_what_was_measured():
    sheet = draft(mechanism_of("whitworth"), instrument=pencil(Tools(), 0), room=sheet_room(mechanism_of("whitworth")))
    sizes = {str(s.symbol): s.size for s in sheet.steps if s.verb == "lay off"}
    assert "4.543² × 156.4 = 3228 mm/s²" == rule_sum(sheet, sizes["an_A@4/O4"], "acceleration")


def drawn_by_hand(name, seed=1):
    """What a pencil draws of a scene, and the readings of its table by symbol."""
    hand, scene = pencil(Tools(), seed), mechanism_of(name)
    sheet = draft(scene, instrument=hand, room=sheet_room(scene))
    return sheet, {reading.symbol: reading for reading in read_off(sheet, (), hand)}


@pytest.mark.parametrize("name", library())
def test_with_a_pencil_each_product_and_quotient_follows_from_what_it_shows(name):
    sheet, _ = drawn_by_hand(name)
    letters = notation_of(sheet, "chinese")
    lines = [line for line in written_lines(sheet, letters, "en") if not isinstance(line, Equation)]
    lines += [line for *_, line in lengths_measured(sheet, letters)]
    whole = " ".join(map(repr, lines)).replace("\u00a0", " ").replace(" mm/mm", "")
    number, false = r"\d[\d.]*", []
    for sum_, told in re.findall(rf"((?:{number}²?(?: mm)? [×/] )+{number}²?) = ({number})(?![\d.·])", whole):
        value = eval(sum_.replace(" mm", "").replace("²", "**2").replace("×", "*"))
        if abs(value - float(told)) > 0.5001 * 10.0 ** -len(told.partition(".")[2]):
            false.append((sum_, told, value))
    assert [] == false


@pytest.mark.parametrize("name", library())
def test_with_a_pencil_what_is_read_once_is_the_same_number_wherever_it_stands(name):
    sheet, table = drawn_by_hand(name)
    for step in sheet.steps:
        if step.reason == "vector" and step.symbol in table:
            assert table[step.symbol].on_paper == pytest.approx(step.mm, abs=1e-12)
        if step.reason != "rate" or step.held or not (told := rate_sum(sheet, step, units=False)):
            continue
        rate = table[Symbol(step.kind, link=step.link)]
        shown = measured(rate, sheet.scene.units)
        assert told.split(" = ")[1].split()[0] == shown.lstrip("-")
        if step.symbol in table:
            per = amount(scale_of(sheet, step.diagram), 12)
            assert told.split(" / ")[0] == product(on_paper(table[step.symbol].on_paper), per)


def test_a_vector_that_an_equation_says_to_be_another_is_read_with_it():
    _, table = drawn_by_hand("hit-two-RPR")
    one, other = (table[Symbol.parse(name)] for name in ("a_B", "an_B/A"))
    assert (one.on_paper, one.value) == (other.on_paper, other.value)


def test_a_pencil_reads_the_same_thing_once_whichever_way_it_is_named():
    board = Board(pencil(Tools(), 1))
    arm, speed = board.read(frozenset("AB"), 41.37), board.read(Symbol.parse("v_C/B"), 12.0)
    assert (arm, speed) == (board.read(frozenset("BA"), 41.37), board.read(Symbol.parse("v_B/C"), 12.0))
    assert 2 == board.instrument.acts
    assert (arm, speed) == (round(arm, 2), round(speed, 2))
    assert arm != board.read(frozenset("AC"), 41.37)


def test_a_given_length_has_all_its_figures_in_what_is_given_on_the_figure_and_in_every_sum():
    told = "".join(ET.fromstring(draw("single-flier").figures["sheet"].content("svg")).itertext())
    assert told.count("113.442")
    assert [] == re.findall(r"113\.44(?!2)", told)


def superposed_twice():
    """Two rates at once, from what three trials leave open: both times the way to what is right is along slopes."""
    slopes, right = np.array([[2.0, -0.7], [0.4, 1.5]]), np.array([-3.2, 1.64])
    tried = np.array([[-2.0, 4.0], [-5.0, 4.0], [-2.0, 6.0]])
    names = [Symbol("omega", link=name) for name in "57"]
    apart = tuple(tuple((slopes @ (row - right)).tolist()) for row in tried)
    found = tuple(zip(names, right.tolist(), strict=True))
    way, ref = Direction("along", ("A", "B")), PointRef("A")
    last = Step("divide", "open ends", "velocity", number=9, rates=found, closing=("3", "4"), apart=apart,
                ways=(way, way), between=((ref, ref),) * 2, less=((), ()))
    # others before them, of the same polygon and of the other
    trials = [(1, tuple((name, 9.0) for name in names))] * 2
    trials += [(i, tuple(zip(names, row, strict=True))) for i, row in enumerate(tried.tolist(), 1)]
    before = tuple(Step("trial", "polygon", "velocity", number=i, trial=trial, rates=assumed)
                   for i, (trial, assumed) in enumerate(trials))
    return SimpleNamespace(before=lambda step: before[: step.number], instrument=EXACT.name), last, right, tried


def test_several_trial_rates_are_divided_each_by_its_part_of_its_step():
    sheet, step, right, tried = superposed_twice()
    assert tried.tolist() == [[value for _, value in act.rates] for act in trials_of(sheet, step)]
    for i, one in enumerate(divisions(sheet, step)):
        share = (right[i] - tried[0][i]) / (tried[i + 1][i] - tried[0][i])
        assert share == pytest.approx(float(one.part.replace("−", "-")), abs=0.00005)
        assert right[i] == pytest.approx(eval(one.terms.replace("×", "*").replace("−", "-")), abs=0.0005)


def test_trials_that_differ_by_less_than_a_ruler_shows_are_divided_by_what_they_do():
    sheet, _ = drawn("contour-four-bars")
    step = next(step for step in sheet.steps if step.reason == "open ends")
    (one,) = divisions(sheet, replace(step, apart=((10.001,), (10.002,))))
    assert "/ 0.001 ×" in one.terms


def test_a_hand_writes_no_more_than_its_ruler_shows():
    hand = pencil(Tools(), 1)
    sheet = draft(mechanism_of("sixbar-guide-40deg"), instrument=hand)
    measured = [str(told).split(" = ")[-1] for *_, told in lengths_measured(sheet, notation_of(sheet, "chinese"))]
    assert [] == [told for told in measured if "(" in told]
    sheet = draft(mechanism_of("contour-four-bars"), instrument=hand)
    steps = [step for step in sheet.steps if step.reason == "open ends"]
    assert [] == [one for step in steps for one in divisions(sheet, step) if "(" in one.value]


@pytest.mark.parametrize(("mm", "carried"), [(0.06, 1), (0.5, 2), (9.87, 3), (12.34, 4), (123.45, 4)])
def test_a_rate_has_as_many_figures_as_the_line_that_it_is_read_from(mm, carried):
    sheet, _ = drawn("sixbar-guide-40deg")
    step = next(step for step in sheet.steps if step.reason == "rate" and not step.held)
    of_links = sheet.rates["omega"]
    rate = of_links[step.link]
    value = mm * sheet.scales.velocity / rate.arm
    short = replace(sheet, rates=sheet.rates | {"omega": of_links | {step.link: replace(rate, value=value, mm=mm)}})
    told = rate_sum(short, step, units=False).split(" = ")[1].split(" ")[0]
    assert value == pytest.approx(float(told), rel=0.6 * 10.0 ** (1 - carried))
    assert len(told.replace(".", "").lstrip("0")) <= carried


def turning(sheet, **rates):
    """The sheet of links that turn at other rates."""
    of_links = sheet.rates["omega"]
    others = {n: replace(of_links[n], value=r) for n, r in rates.items()}
    return replace(sheet, rates=sheet.rates | {"omega": of_links | others})


@pytest.mark.parametrize(("more", "told"), [(1e-15, 0.0), (1e-4, 7e-4), (-2.0, 14.0)])
def test_two_links_turn_on_each_other_by_the_difference_of_their_rates(more, told):
    sheet, _ = drawn("sixbar-guide-40deg")
    one, other = (link.name for link in sheet.scene.links[:2])
    seen = turning(sheet, **{one: 7.0, other: 7.0 * (1.0 + more)})
    rate, *_ = factors_of(seen, Size("rate", (one, other), sheet.scene.links[0].bar))
    assert told == pytest.approx(float(rate), rel=1e-4, abs=1e-20)
    once, again, radius = factors_of(seen, Size("rolling curves", (one, other), curves=(one, other), radius=0.025))
    assert (once, 25.0) == (again, float(radius))
    assert told == pytest.approx(float(once), rel=1e-4, abs=1e-20)


def test_by_rates_is_laid_off_what_they_give_over_the_length_between_two_points():
    sheet, steps = seen_from_a_held_link()
    for step in steps:
        start, end = (sheet.points[PointRef(ref.point)] for ref in (step.refs[0], step.ref))
        omega, alpha = (rates[step.link].value - rates[step.held].value for rates in sheet.rates.values())
        arm = (end - start) * sheet.scales.length / sheet.scales.of(step.diagram)
        expected = [1j * omega * arm] if step.diagram == "velocity" else [-(omega**2) * arm, 1j * alpha * arm]
        assert expected == pytest.approx([part.span for part in step.by_rates])


def test_by_rates_that_are_nought_nothing_is_laid_off():
    evenly = {**BY_RATE, "driver": {**BY_RATE["driver"], "alpha": 0.0}}
    steps = [step for step in draft(mechanism_of(evenly)).steps if step.reason == "rates" and step.held]
    assert [("velocity", ["v"]), ("acceleration", ["an"])] == [
        (step.diagram, [part.symbol.kind for part in step.by_rates]) for step in steps
    ]


def test_quotients_come_to_what_was_measured_and_what_is_laid_off_to_its_length():
    sheet, _ = drawn("sixbar-guide-40deg")
    step = next(step for step in sheet.steps if step.reason == "rate" and not step.held and step.kind == "omega")
    of_links, rng = sheet.rates["omega"], np.random.default_rng(5)
    rate = of_links[step.link]
    carried = []
    for mm, arm in rng.uniform((10.0, 30.0), (180.0, 200.0), (60, 2)).tolist():
        metres = arm * sheet.scales.length
        value = mm * sheet.scales.velocity / metres
        changed = of_links | {step.link: replace(rate, value=value, mm=mm, arm=metres)}
        other = replace(sheet, rates=sheet.rates | {"omega": changed})
        quotient, told = rate_sum(other, replace(step, points=("?", "!")), units=False).split(" = ")
        over, under = quotient.split(" / ")
        assert float(f"{value:.4g}") == float(told.split(" ")[0])
        assert float(f"{float(over) / float(under):.4g}") == float(told.split(" ")[0])
        carried.append(len(over.replace(".", "")))
    assert 45 < carried.count(5)  # one more than the length on paper has
    sheet = replace(sheet, scales=replace(sheet.scales, velocity=0.0025))
    for mm in rng.uniform(100.0, 180.0, 200).tolist():
        product, length = laid_sum(sheet, "velocity", None, mm)
        value, _, per, _, told = re.match(r"([\d.]+) (\S+) ÷ ([\d.]+) (\S+) = ([\d.]+) mm", length).groups()
        assert product.startswith(value)
        assert f"{mm:.2f}" == told
        assert abs(Decimal(value) / Decimal(per) - Decimal(told)) <= Decimal("0.005")


@pytest.mark.parametrize(
    ("said", "name", "language"),
    [
        ("$V_{S2}$ by the image of link 2: $BS_{2}$ : $BC$", "slider-crank-offset", "en"),
        ("$V_{P}$ by the image of link 2: △$BCP$", "four-bar-coupler-point", "en"),
        ("由构件 2 的影像得 $A_{P}$：△$BCP$", "four-bar-coupler-point", "zh"),
    ],
)
def test_where_end_points_have_no_letters_the_vector_of_an_image_is_told(said, name, language):
    sheet, _ = drafted(name)
    lines = written_lines(sheet, notation_of(sheet, "us"), language)
    assert said in [repr(line).replace("\u00a0", " ") for line in lines]


@pytest.mark.parametrize("name", ["hydraulic-cylinder", "shaper-scheme-2", "sixbar-420rpm", "double-butterfly"])
def test_a_step_tells_a_measured_rate_as_its_quotient_gives_it(name):
    sheet, _ = drawn(name)
    told = {(s.kind, s.link): s.phrase.gaps["told"] for s in sheet.steps if s.reason == "rate" and not s.held}
    rates = [s for s in sheet.steps if s.reason == "rate" and not s.held and rate_sum(sheet, s)]
    quotients = {(s.kind, s.link): re.search(r"= ([\d.e⁻−-]+) rad", rate_sum(sheet, s))[1] for s in rates}
    assert quotients
    assert quotients == {key: told[key] for key in quotients}


# rates of links that a driver turns from another moving link

ARM = {
    "frame": {"points": {"A": [0, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 300}, "2": {"points": ["B", "C"], "length": 200},
        "3": {"points": ["T"], "on": "2", "angle_on": 15, "at": {"U": [30, 0]}},
    },
    "driver": [
        {"link": "1", "angle": 30, "omega": 1, "alpha": 4},
        {"link": "2", "relative_to": "1", "angle": 50, "omega": -3, "alpha": -1.5},
        {"slide": "3", "travel": 260, "velocity": 40, "acceleration": -7},
    ],
}
"""A second arm on a first, driven from it in the opposite sense, and a slide on the second."""


def arm(**changes):
    first, second, third = ARM["driver"]
    return {**ARM, "driver": [first, {**second, **changes}, third]}


ON_A_BLOCK = {  # a dyad of blocks on a fixed guide and on a crank; a driver turns the first from the second
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": [0, 60], "angle": 10}}},
    "links": {"1": {"points": ["A", "B"], "length": 95}, "2": {"points": ["C"], "on": "0.g"},
              "3": {"points": ["C"], "on": "1"}},
    "driver": {"link": "2", "angle": -50, "relative_to": "3", "omega": 3},
    "sketch": {"C": [30, 65]},
}
IN_A_FOUR_BAR = {
    "frame": {"points": {"A": [0, 0], "D": [200, 0]}},
    "links": {"1": {"points": ["A", "B"], "length": 100}, "2": {"points": ["B", "C"], "length": 150},
              "3": {"points": ["D", "C"], "length": 120}},
    "driver": {"link": "2", "relative_to": "1", "angle": -50, "omega": 2, "alpha": 0.5},
    "sketch": {"B": [60, 80], "C": [190, 120]},
}


def lines_of(scene, language="en"):
    sheet = draft(mechanism_of(scene))
    lines = written_lines(sheet, notation_of(sheet, "chinese"), language)
    return [repr(line).replace("\u00a0", " ") for line in lines if not isinstance(line, Equation)]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_rate_of_a_link_driven_from_a_moving_one_is_told_as_a_sum_with_senses_before_it_is_used(language):
    lines = lines_of(ARM, language)
    omega = lines.index("$ω_{3}$ = $ω_{2}$ = $ω_{1}$ + $ω_{21}$ = 1 − 3 = −2 rad/s")
    alpha = lines.index("$α_{3}$ = $α_{2}$ = $α_{1}$ + $α_{21}$ = 4 − 1.5 = 2.5 rad/s²")
    assert [omega + 1, alpha + 1] == [
        lines.index("$v_{CB}$ = 2 × 200 = 400 mm/s"),
        lines.index("$a^{n}_{CB}$ = 2² × 200 = 800 mm/s²;  $a^{t}_{CB}$ = 2.5 × 200 = 500 mm/s²"),
    ]


@pytest.mark.parametrize("language", ["en", "zh"])
def test_the_steps_tell_the_sum_of_rates_next_before_the_first_vector_that_it_gives(language):
    sheet = draft(mechanism_of(ARM))
    said = [say(step.phrase, language) for step in sheet.steps]
    omega, alpha = (said.index(one) for one in ("ω_2 = ω_1 + ω_21 = 1 − 3 = −2 rad/s",
                                                "α_2 = α_1 + α_21 = 4 − 1.5 = 2.5 rad/s²"))
    assert ["v_C/B", "an_C/B"] == [str(sheet.steps[i + 1].symbol) for i in (omega, alpha)]


def test_links_that_slide_on_a_link_driven_from_a_moving_one_are_told_to_turn_as_it_does_once():
    assert [] == [line for line in lines_of(ARM) if line in ("$ω_{3}$ = $ω_{2}$", "$α_{3}$ = $α_{2}$")]


def test_a_link_driven_from_a_moving_one_at_a_steady_rate_has_the_second_rate_of_that_one():
    assert "$α_{3}$ = $α_{2}$ = $α_{1}$ + $α_{21}$ = 4 + 0 = 4 rad/s²" in lines_of(arm(alpha=0))


def test_no_sum_of_rates_is_told_where_neither_changes():
    first, second, third = arm(alpha=0)["driver"]
    steady = {**ARM, "driver": [{**first, "alpha": 0}, second, third]}
    kinds = [step.kind for step in draft(mechanism_of(steady)).steps if step.reason == "sum of rates"]
    assert ["omega"] == kinds


def test_a_driver_that_turns_the_known_link_from_the_other_is_taken_off():
    scene = {
        "frame": {"points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 300}, "2": {"points": ["T"], "on": "1"},
                  "3": {"points": ["T", "U"], "length": 200}},
        "driver": [{"link": "1", "angle": 30, "omega": 1}, {"slide": "2", "travel": 260, "velocity": 40},
                   {"link": "2", "relative_to": "3", "angle": -50, "omega": 3}],
    }
    assert "$ω_{3}$ = $ω_{2}$ − $ω_{23}$ = 1 − 3 = −2 rad/s" in lines_of(scene)
    assert check(scene).ok


@pytest.mark.parametrize(("scene", "line"), [
    (ON_A_BLOCK, "$ω_{1}$ = $ω_{3}$ = $ω_{2}$ − $ω_{23}$ = 0 − 3 = −3 rad/s"),
    (IN_A_FOUR_BAR, "$ω_{2}$ = $ω_{1}$ + $ω_{21}$ = −1.4838 + 2 = 0.5162 (0.51616) rad/s"),
], ids=["on a block", "in a four-bar"])
def test_a_driver_within_a_dyad_adds_its_rate_to_that_of_the_known_link(scene, line):
    assert line in lines_of(scene)
    assert check(scene).ok


def test_the_given_rate_of_a_coupler_driven_from_the_frame_is_no_sum():
    scene = {**IN_A_FOUR_BAR, "driver": {"link": "2", "angle": 17.1, "omega": 2, "alpha": 0.5}}
    assert [] == [step for step in draft(mechanism_of(scene)).steps if step.reason == "sum of rates"]
