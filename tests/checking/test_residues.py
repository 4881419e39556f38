"""What is printed of a reading: zero is zero, what is certain is not, and products are true as written."""

from __future__ import annotations

import csv
import io
import re
from decimal import Decimal

import pytest

from graphkin import audit, check, draw, read, solve
from graphkin.api.report_text import reading_words, report_text
from graphkin.drawing.ink.primitives import Group, Text, walk
from graphkin.words.written import amount

DEAD = [("shaper-scheme-2", 90), ("swinging-block", 180), ("whitworth", 270), ("slider-crank-offset", 0)]


@pytest.mark.parametrize(("name", "at"), DEAD)
def test_what_is_nothing_but_rounding_is_zero_on_both_sides(name, at):
    rows = check(name, at=at).report.rows
    largest = {}
    for row in rows:
        group = row.reading.diagram, row.symbol.is_vector
        largest[group] = max(largest.get(group, 0.0), abs(row.reading.value))
    tiny = [
        row
        for row in rows
        if max(abs(row.measured), abs(row.true)) < 1e-12 * largest[row.reading.diagram, row.symbol.is_vector]
    ]
    assert [] == [str(row.symbol) for row in tiny if row.measured != 0.0 or row.true != 0.0]


@pytest.mark.parametrize(("name", "at"), [("slider-crank-s50-e16-K1.2", 90), ("scissor-lift", None)])
def test_a_step_tells_no_rate_that_is_nothing_but_rounding(name, at):
    sheet = check(name, at=at).sheet
    zero = {s.symbol for d in ("velocity", "acceleration") for s in sheet.vectors[d].values() if s.span == 0.0}
    leading = (aid for step in sheet.steps for aid in step.auxiliary)
    zero |= {s.symbol for s in leading if s.span == 0.0}
    rates = [step for step in sheet.steps if step.reason == "rate" and step.symbol in zero]
    assert rates
    assert {0.0} == {step.value for step in rates}


def test_the_rounding_of_a_rate_is_that_of_velocities_over_its_bar():
    floor = {str(row.symbol): row.floor for row in check("four-bar-coupler-point").report.rows}
    bars = [floor["v_C"] / floor[name] for name in ("omega_3", "omega_2")]
    assert [0.07, 0.09] == pytest.approx(bars)


@pytest.mark.parametrize(("name", "at"), DEAD)
def test_zero_is_never_compared_in_per_cent(name, at):
    assert {None} >= {row.relative for row in check(name, at=at).report.rows if row.true == 0.0}


def test_a_tiny_value_that_is_certain_is_no_zero():
    row = check("sixbar-420rpm")["an_F/E"]
    assert abs(row.exact) == pytest.approx(abs(row.measured), rel=1e-9)


def test_a_tiny_value_that_no_pencil_draws_is_written_beside_its_point_and_not_magnified():
    figure = draw("sixbar-420rpm", language="en", convention="chinese").figures["acceleration"]
    texts = {text.id: text.string for text in walk(figure.children) if isinstance(text, Text)}
    assert "aFEn= 0.01012 m/s²" == texts["label-an_F-E"]
    assert "detail-acceleration-1" not in {group.id for group in walk(figure.children) if isinstance(group, Group)}


@pytest.mark.parametrize("name", ["shaper-scheme-2", "sixbar-420rpm", "sixbar-guide-40deg", "oldham-coupling"])
def test_a_vector_printed_is_its_length_on_paper_times_the_scale(name):
    checked = check(name)
    scales = {key: Decimal(amount(value, 12)) for key, value in checked.scales.items()}
    wrong = [
        symbol
        for row, (symbol, mm, measured, *_) in zip(checked.report.rows, reading_words(checked), strict=True)
        if row.symbol.is_vector and Decimal(measured) != Decimal(mm) * scales[row.reading.diagram]
    ]
    assert [] == wrong


def test_a_reading_of_a_pencil_below_its_uncertainty_is_zero_with_its_bound():
    checked = check("shaper-scheme-2", at=90, instrument="pencil", seed=1)
    said = {symbol: measured for symbol, _, measured, *_ in reading_words(checked)}
    assert said["v_C/B"].startswith("0 ± ")


def test_the_table_of_readings_has_no_residue():
    rows = list(csv.DictReader(io.StringIO(check("shaper-scheme-2", at=90).table.csv())))
    assert [] == [row["symbol"] for row in rows if 0.0 < abs(float(row["measured"])) < 1e-9]


@pytest.mark.parametrize("instrument", ["exact", "cad", "pencil"])
@pytest.mark.parametrize(
    ("name", "at"), [("cam-flat-face", 350), ("cam-offset-roller", 130), ("cam-swinging-roller", 10)]
)
def test_a_follower_that_dwells_has_no_rates_and_every_reading_is_determined(name, at, instrument):
    checked = check(name, at=at, instrument=instrument, seed=2)
    turning = [row.symbol.link for row in checked.report.rows if row.symbol.kind == "omega" and row.measured != 0.0]
    assert (["1"], (), True) == (turning, checked.report.undetermined, checked.ok)
    assert [] == [str(row.symbol) for row in checked.report.rows if row.symbol.kind != "omega" and row.measured != 0.0]


def test_the_advice_is_not_of_a_reading_that_is_not_told_from_zero():
    said = report_text(check("cam-flat-face", at=350, instrument="pencil"), "en")
    assert "least certain" not in said


@pytest.mark.parametrize("name", ["four-bar-coupler-point", "sixbar-rotating-guide-scheme2", "double-butterfly"])
def test_loops_that_close_have_the_sum_0(name):
    said = [line for line in solve(name).loops("en").plain.splitlines() if "sum of all arrows" in line]
    assert {"the sum of all arrows is 0"} == {line.strip() for line in said}


RESIDUE = re.compile(r"(?<![\w.])-0(?:\.0+)?(?![\d.])|\de-1[2-9]")


@pytest.mark.parametrize(("name", "at"), [*DEAD, ("boom-lifted", None), ("boom-lifted", 180), ("shaper-forces", 90)])
def test_no_table_shows_what_rounding_leaves(name, at):
    made = check(name, at=at)
    nought = {row["symbol"]: "0" for row in made.data["readings"]}
    computed = {s: v for s, v in nought.items() if s[:2] in ("F_", "M_", "v_", "om")}
    printed = read(name).to_dict() | {"printed": {"by": "computation", **computed}}
    tables = {
        "check": made.table.csv(),
        "audit": audit(name, answers={"x": nought}, at=at).table.csv(),
        "computed": audit(printed, at=at).table.csv(),
    }
    assert [] == [(t, line) for t, text in tables.items() for line in text.splitlines() if RESIDUE.search(line)]


def test_the_rate_of_a_carrier_that_two_drivers_hold_at_rest_is_0():
    # read off the plan of the train: sun at 10 rad/s, ring at -5 rad/s with twice its teeth
    train = {
        "frame": {"points": {"O": [0, 0]}},
        "links": {
            "s": {"points": ["O"]}, "h": {"points": ["O", "P"], "length": 60}, "p": {"points": ["P"]},
            "r": {"points": ["O"]},
        },
        "gears": {"a": {"between": ["s", "p"], "teeth": [40, 20]}, "b": {"between": ["p", "r"], "teeth": [20, -80]}},
        "driver": [{"link": "s", "angle": 0, "omega": 10}, {"link": "r", "angle": 0, "omega": -5}],
    }
    (carrier,) = [row for row in check(train).data["readings"] if row["symbol"] == "omega_h"]
    assert (0.0, 0.0) == (carrier["measured"], carrier["exact"])
