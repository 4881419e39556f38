"""Scenes at and beyond the limits end in a result or a sentence."""

from __future__ import annotations

import cProfile
import math

import pytest

import graphkin
from graphkin.errors import CallError, SceneError
from graphkin.scene import mechanism_of, mechanism_of_text
from graphkin.solver import solve


def chain(dyads):
    """A crank that drives a row of rockers, each by a rod from the last."""
    frame, links, sketch = {"A0": [0.0, 0.0]}, {"L0": {"points": ["A0", "B0"], "length": 20.0}}, {}
    last = (20 * math.cos(1.0), 20 * math.sin(1.0))
    for k in range(1, dyads + 1):
        foot = (60.0 * k, 0.0)
        end = (foot[0] + 30 * math.cos(1.2), 30 * math.sin(1.2))
        frame[f"A{k}"] = list(foot)
        links[f"C{k}"] = {"points": [f"B{k - 1}", f"B{k}"], "length": math.dist(last, end)}
        links[f"R{k}"] = {"points": [f"A{k}", f"B{k}"], "length": math.dist(foot, end)}
        sketch[f"B{k}"] = list(end)
        last = end
    driver = {"link": "L0", "angle": math.degrees(1.0), "omega": 10.0}
    return {"frame": {"name": "0", "points": frame}, "links": links, "driver": driver, "sketch": sketch}


def weak_chain(dyads, angle):
    """A row of rockers, each at a small angle to the rod that drives it: every dyad makes errors greater."""
    frame, links, sketch = {"A0": [0.0, 0.0]}, {"L0": {"points": ["A0", "B0"], "length": 20.0}}, {}
    last = (20 * math.cos(1.0), 20 * math.sin(1.0))
    for k in range(1, dyads + 1):
        end = (60.0 * k + 10, 25.0 if k % 2 else 20.0)
        along = math.atan2(end[1] - last[1], end[0] - last[0]) + angle
        foot = (end[0] + 30 * math.cos(along), end[1] + 30 * math.sin(along))
        frame[f"A{k}"] = list(foot)
        links[f"C{k}"] = {"points": [f"B{k - 1}", f"B{k}"], "length": math.dist(last, end)}
        links[f"R{k}"] = {"points": [f"A{k}", f"B{k}"], "length": math.dist(foot, end)}
        sketch[f"B{k}"] = list(end)
        last = end
    driver = {"link": "L0", "angle": math.degrees(1.0), "omega": 10.0}
    return {"frame": {"name": "0", "points": frame}, "links": links, "driver": driver, "sketch": sketch}


@pytest.mark.parametrize("dyads", [24, 33])
def test_a_chain_of_dyads_is_drawn_and_agrees(dyads):
    result = graphkin.check(chain(dyads))
    assert {True} == {row.ok for row in result.report.rows}
    assert all(row.error <= 1e-9 * max(1.0, abs(row.exact)) for row in result.report.rows)


def test_of_a_chain_of_weak_dyads_what_is_not_known_to_agree_is_not_said_to():
    # every dyad makes errors some twenty times greater; from rod 14 on the bound on rounding exceeds a thousandth
    result = graphkin.check(weak_chain(24, 0.05))
    known = {str(row.symbol): row.ok for row in result.report.rows}
    along = [known[f"v_B{k}"] for k in range(24)]
    assert [True] == along[:1]
    assert along == sorted(along, key=lambda ok: ok is None)  # the bounds grow along the chain
    assert {True, None} == set(known.values())
    assert all(row.error <= row.bound for row in result.report.rows if row.ok)


def test_of_the_centres_of_16_dyads_only_those_of_rods_that_move_alike_are_wanting():
    centres = graphkin.check(chain(16)).centres.table.values()
    wanting = [centre.why.key for centre in centres if centre.kind == "undetermined"]
    assert (33 * 34 // 2, {"centre no motion"}) == (len(centres), set(wanting))


@pytest.mark.parametrize("command", [graphkin.draw, graphkin.handout])
def test_a_figure_of_too_many_links_is_refused_in_a_sentence(command):
    with pytest.raises(CallError, match="49 moving links are too many"):
        command(chain(24))


def test_of_too_many_links_those_that_lead_to_what_is_asked_are_drawn():
    drawn = graphkin.draw(chain(24), find=["v_B4"])
    assert ["mechanism", "velocity", "sheet", "centres"] == [n for n in drawn.figures if "-" not in n]
    assert (9, ["A0", "A1", "A2", "A3", "A4"]) == (len(drawn.mechanism.links), list(drawn.mechanism.frame.points))
    assert drawn.ok
    assert drawn["v_B4"].exact == pytest.approx(graphkin.check(chain(24))["v_B4"].exact, rel=1e-9)


def test_too_many_links_that_lead_to_what_is_asked_are_counted():
    with pytest.raises(CallError, match="25 moving links are too many"):
        graphkin.draw(chain(24), find=["v_B12"])


@pytest.mark.parametrize(
    ("most", "command"),
    [(2.4, graphkin.solve), (4.0, graphkin.check), (4.0, lambda scene: graphkin.centres(scene).table)],
)
def test_the_work_grows_no_faster_than_the_square_of_the_links(most, command):
    command(chain(2))
    calls = []
    for dyads in (20, 40):
        profile = cProfile.Profile()
        profile.runcall(command, chain(dyads))
        calls.append(sum(entry.callcount for entry in profile.getstats()))
    assert calls[1] <= most * calls[0]


def test_ten_thousand_links_are_refused_by_the_reader():
    with pytest.raises(SceneError, match="more than 20000 values"):
        graphkin.solve(chain(5000))


@pytest.mark.parametrize("text", ["a = " + "[" * 100_000, "[" + "a." * 5000 + "a]\nb = 1", "x = 1" + "0" * 6000])
def test_deep_and_gigantic_texts_are_refused_in_sentences(text):
    with pytest.raises(SceneError) as refusal:
        mechanism_of_text(text, "hostile")
    assert all(len(str(p)) < 500 for p in refusal.value.problems)


def test_a_bound_that_says_nothing_is_null_with_a_reason():
    bound = graphkin.solve(weak_chain(24, 0.05)).data["positions"][0]["error_bound"]
    assert bound["velocity"] is None
    assert "says nothing" in bound["why"]


@pytest.mark.parametrize("chained", [chain(48), weak_chain(12, 0.05)])
def test_the_bounds_of_a_chain_are_none_below_zero_and_grow_along_it(chained):
    motion = solve(mechanism_of(chained))
    bounds = [motion.accuracy.of((f"R{k}",)).omega[0] for k in range(1, len(chained["links"]) // 2 + 1)]
    assert all(bound > 0.0 for bound in bounds)
    assert bounds[0] < 1e-6
    assert bounds[0] < bounds[-1]
