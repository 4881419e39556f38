"""What is told of instant centres: rates, speeds and sliding velocities, true as they are written."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from graphkin.account.centres import how_found, velocity_sentences
from graphkin.api.centred import centres as checked_centres
from graphkin.api.centred import centres_text
from graphkin.construction.centres import find_centres
from graphkin.scene import library, mechanism_of, mechanism_of_text
from graphkin.scene.symbol import Symbol
from graphkin.words import say, written
from tests.bench.attack import mechanism
from tests.mechanisms import random_scene
from tests.scenes import TRAMMEL, four_bar


def test_the_sense_is_opposite_where_the_common_centre_lies_between() -> None:
    centres = find_centres(mechanism_of("sixbar-420rpm"))
    assert "centre opposite sense" in [p.key for p in velocity_sentences(centres)]


@pytest.mark.parametrize("name", sorted(library()))
def test_the_told_rates_multiply_up_to_the_exact_ones(name: str) -> None:
    found = checked_centres(name)
    exact = {f"v_{v.symbol.of}": abs(v.exact) for v in found.velocities if v.symbol.kind == "v"}
    metres = found.scene.units.metres
    for phrase in velocity_sentences(found.centres):
        if phrase.key == "centre speed":
            symbol, rate, arm, scale = (phrase.gaps[gap] for gap in ("symbol", "rate", "length", "scale"))
            told = float(str(rate)) * float(str(arm)) * float(str(scale).split()[0]) * metres
            assert str(phrase.gaps["speed"]).endswith(f" {found.scene.units.rates.length}/s")
            carried = written.figures(str(rate), str(arm))
            assert told == pytest.approx(exact[str(symbol)], rel=max(2e-3, 10.0 ** (1 - carried)))


@pytest.mark.parametrize("name", sorted(library()))
def test_every_told_rate_is_true_as_it_is_written(name: str) -> None:
    found = checked_centres(name)
    turning = {link: written.amount(one.omega) for link, one in found.turning.items()}
    turning |= {"".join(d.links): written.amount(d.rate) for d in found.mechanism.drivers if d.turns}
    for phrase in velocity_sentences(found.centres):
        if phrase.key in ("centre same sense", "centre opposite sense"):
            gaps = (str(phrase.gaps[gap]).replace("−", "-") for gap in ("link", "known", "far", "near", "rate"))
            link, known, far, near, rate = gaps
            sign = -1.0 if phrase.key == "centre opposite sense" else 1.0
            value = sign * float(turning[known]) * float(far) / float(near)
            assert float(rate) == pytest.approx(value, rel=0.0, abs=0.5001 * unit_of(rate))
            turning[link] = rate
        elif phrase.key == "centre from cylinder":
            link, rate, near = (str(phrase.gaps[gap]) for gap in ("link", "rate", "near"))
            speed, scale = (float(str(phrase.gaps[gap]).split()[0]) for gap in ("speed", "scale"))
            assert float(rate) == pytest.approx(speed / (float(near) * scale), rel=0.0, abs=0.5001 * unit_of(rate))
            turning[link] = math.copysign(float(rate), float(turning[link]))
        elif phrase.key == "centre turns alike":
            turning[str(phrase.gaps["link"])] = turning[str(phrase.gaps["known"])]


def test_a_residue_is_no_rate_of_a_velocity_by_centres() -> None:
    # at this dead centre a link stands still: nothing but rounding is left of its rate
    scene = random_scene(9129, ("RRP", "RPR"), "slot", textbook=True)
    found = checked_centres(scene, at=121.65525060596437)
    told = [str(arg) for phrase in velocity_sentences(found.centres) for arg in phrase.gaps.values()]
    assert [] == [text for text in told if "e-" in text or "e−" in text]


def told(scene: str | dict[str, Any]) -> list[str]:
    """The construction of every centre, then the sentences on velocities."""

    def name(pair: object) -> str:
        return f"P{''.join(sorted(pair))}" if isinstance(pair, tuple) else str(pair)

    centres = find_centres(mechanism_of(scene))
    phrases = (*(how_found(centres, c, name) for c in centres.found), *velocity_sentences(centres))
    return [say(phrase, "en", name) for phrase in phrases]


def test_a_link_that_slides_has_the_velocity_of_a_link_that_turns_at_their_common_centre() -> None:
    # both slides go their own ways: they have no velocity in common
    said = told("elliptic-trammel")
    assert "link 3 translates with the velocity that link 2 has at P23" in said
    assert "P13 lies at infinity on P12P23, for P14P34 is the line at infinity" in said


def test_velocities_of_two_slides_that_push_each_other_differ_square_to_the_direction_of_their_centre() -> None:
    guides = {"x": {"through": [0, 0], "angle": 0}, "y": {"through": [0, 0], "angle": 90}}
    wedge = {
        "frame": {"guides": guides},
        "links": {
            "1": {"on": "0.x", "guides": {"s": {"through": [0, 10], "angle": 30}}},
            "2": {"points": ["P"], "on": "0.y"},
        },
        "pins": {"P": {"of": "2", "in": "1.s"}},
        "driver": {"slide": "1", "travel": -30, "velocity": 12},
    }
    said = told(wedge)
    assert "P12 lies at infinity on n(P/1), for P01P02 is the line at infinity" in said
    assert said[-1].endswith("P12 lies at infinity: their velocities differ by one square to that direction")


CYLINDER_IN_A_FOUR_BAR = {
    "frame": {"points": {"A": [0, 0], "B": [800, 0]}},
    "links": {
        "1": {"points": ["A", "C"], "length": 900, "at": {"P": [500, 150]}},
        "2": {"points": ["B", "D"], "length": 700, "at": {"Q": [300, 90]}},
        "3": {"points": ["C", "D"], "length": 620}, "4": {"points": ["P"], "on": "5"}, "5": {"points": ["Q"]},
    },
    "driver": {"slide": "4", "travel": 300, "velocity": -45},
    "sketch": {"C": [150, 890], "D": [760, 700]},
}


def test_the_rates_of_a_cylinder_between_moving_links_begin_with_its_speed() -> None:
    said = told(CYLINDER_IN_A_FOUR_BAR)
    assert "|ω_4| = |v_45| / P04P05 = 45 mm/s / (640.03 mm · 10 mm/mm) = 0.0070309 rad/s" in said
    assert said.index("P45 lies at infinity: ω_5 = ω_4") < next(i for i, one in enumerate(said) if "ω_2 = ω_5" in one)


def test_the_rates_of_a_coupler_driven_from_its_crank_begin_with_their_difference() -> None:
    said = told(four_bar(70, 140, 110, 180, driver={"link": "2", "relative_to": "1", "angle": -60, "omega": 2}))
    begin = next(one for one in said if one.startswith("ω_2"))
    assert begin.startswith("ω_2 = ω_21 · P14P12 / P14P24 = ω_21 · ")
    assert begin.endswith("= 0.3904 rad/s; P12 and P24 lie on one side of P14: the same sense")
    assert any(one.startswith("ω_1 = −ω_2 · P12P24 / P12P14") for one in said)


def test_nothing_is_headed_velocities_of_a_mechanism_at_rest() -> None:
    resting = four_bar(70, 150, 110, 180, driver={"link": "1", "angle": 60, "omega": 0})
    _, _, said = centres_text(checked_centres(resting))
    assert "Velocities by centres" not in said


def unit_of(number: str) -> float:
    """One in the last figure of a number as it is written; of a whole one, one."""
    head, _, power = number.partition("e")
    places = len(head.partition(".")[2])
    return float(10.0 ** (int(power or 0) - places))


def test_the_speed_of_a_translating_link_is_that_of_the_crank_at_their_centre() -> None:
    # the ram has no finite centre: its speed is that of the crank where both have one velocity
    given = mechanism_of("shaper-scheme-2")
    scene = replace(given, question=replace(given.question, find=(Symbol.parse("v_C@6"),)))
    centres = find_centres(scene)
    (told,) = [p for p in velocity_sentences(centres) if p.key == "centre speed"]
    link, end, rate, arm, scale, said = (told.gaps[gap] for gap in ("link", "end", "rate", "length", "scale", "speed"))
    exact = abs(checked_centres(scene).velocities[0].exact) / scene.units.metres
    assert ("2", True) == (link, isinstance(end, tuple))
    product = float(str(rate)) * float(str(arm)) * float(str(scale).split()[0])
    said = str(said).split()[0]
    assert float(said) == pytest.approx(product, rel=0.0, abs=0.5001 * unit_of(said))  # true as it is written
    assert product == pytest.approx(exact, rel=1e-2)  # as many figures as the distances carry


def test_a_clockwise_link_is_told_with_its_sign() -> None:
    centres = find_centres(mechanism_of("shaper-scheme-2"))
    told = {p.gaps["link"]: p.gaps["rate"] for p in velocity_sentences(centres) if "sense" in p.key}
    assert "−0.739" == told["4"]  # 6.70206 · 8.68 mm / 78.68 mm


def test_the_sliding_velocity_is_the_difference_of_rates_times_the_arm_from_the_common_centre():
    centres = find_centres(mechanism_of("sixbar-guide-40deg"))
    told = [p.gaps for p in velocity_sentences(centres) if p.key == "centre sliding"]
    assert [("1", "3"), ("5", "3")] == [(gaps["link"], gaps["guide"]) for gaps in told]
    sizes = [float(gaps["speed"].split()[0]) for gaps in told]
    assert [575.4062995771787, 99.20039152997784] == pytest.approx(sizes, rel=1e-3)


def test_no_sliding_velocity_is_told_of_links_that_turn_alike_but_for_rounding() -> None:
    centres = find_centres(mechanism_of(mechanism(9028)))
    moving = centres.turning
    told = [(p.gaps["link"], p.gaps["guide"]) for p in velocity_sentences(centres) if p.key == "centre sliding"]
    assert told
    for pinned, guiding in told:
        one, other = moving[str(pinned)].omega, moving[str(guiding)].omega
        assert abs(one - other) > 1e-3 * max(abs(one), abs(other))


def test_a_link_whose_known_centre_lies_in_the_common_one_is_said_to_stand_still() -> None:
    # at its outer dead centre the rocker turns neither in the crank's sense nor against it
    outer = math.degrees(math.acos((200**2 + 240**2 - 120**2) / (2 * 200 * 240)))
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [200, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 60},
            "2": {"points": ["B", "C"], "length": 180},
            "3": {"points": ["D", "C"], "length": 120},
        },
        "driver": {"link": "1", "angle": outer, "omega": 5},
    }
    assert [s for s in told(scene) if s.endswith("= 0 rad/s; P01 lies in P13: link 3 stands still")]


def test_links_that_do_not_move_relative_to_each_other_are_not_among_the_compared_centres() -> None:
    # a carrier at rest: its six centres were all said to agree, and of one nothing is compared
    scene = {
        "frame": {"points": {"O": [0, 0]}},
        "links": {"1": {"points": ["O"]}, "h": {"points": ["O", "P"], "length": 45}, "2": {"points": ["P"]}},
        "gears": {"a": {"between": ["1", "2"], "teeth": [30, 15]}},
        "driver": [{"link": "h", "angle": 30, "omega": 0}, {"link": "1", "angle": 0, "omega": 6}],
    }
    said = centres_text(checked_centres(scene))[2][-1]
    assert "5 instant centres agree with the analytic solution; the links of P0h do not move" in said


def test_a_pin_in_a_slot_of_the_frame_has_its_speed_alone_and_no_sliding_velocity_beside_it() -> None:
    centres = find_centres(mechanism_of_text(TRAMMEL, "trammel"))
    assert ["centre speed"] * 3 == [phrase.key for phrase in velocity_sentences(centres)]


def test_the_rates_of_driven_links_of_an_open_chain_go_on_from_the_first() -> None:
    arm = {
        "frame": {"points": {"A": [0, 0]}},
        "links": {"1": {"points": ["A", "B"], "length": 60}, "2": {"points": ["B", "C"], "length": 50}},
        "driver": [{"link": "1", "angle": 40, "omega": 3},
                   {"link": "2", "relative_to": "1", "angle": 50, "omega": -2}],
    }
    rate = "ω_2 = ω_1 · P12P01 / P12P02 = ω_1 · 60.00 / 180.00 = 1 rad/s"  # 3 - 2, for 60 : 180 = 1 : 3
    assert [rate in line for line in told(arm)].count(True) == 1


def test_scales_and_speeds_that_are_very_small_are_told_as_powers_of_ten() -> None:
    said = told({**four_bar(30e-6, 90e-6, 60e-6, 100e-6), "units": {"length": "m"}})
    assert [] == [one for one in said if "e-" in one]
    assert [] != [one for one in said if "·10⁻⁶ m/mm = " in one]
