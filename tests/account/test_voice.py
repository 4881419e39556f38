from __future__ import annotations

import json
import math
import re
from decimal import Decimal
from typing import get_args

import pytest

from graphkin import check, read
from graphkin.account.account import reasons, telling, why
from graphkin.account.arithmetic import bound
from graphkin.account.in_mechanism import InMechanism
from graphkin.account.in_polygon import InPolygon
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account, PolygonPoints, link_of_vector, whole_sentence
from graphkin.api.classroom.handouts import handout
from graphkin.construction import draft
from graphkin.construction.board.sheet import Remark
from graphkin.construction.board.steps import PointNames, Reason
from graphkin.papers.lesson import stages
from graphkin.papers.screen import motion_data
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.words import Phrase
from graphkin.words.symbols import sign
from tests.construction.test_groups import BARE
from tests.mechanisms import random_scene, redriven
from tests.rolling_linkages import wheel_at_its_rim
from tests.scenes import FIXED_PIN


def _six_bar():
    sheet = draft(mechanism_of("sixbar-guide-40deg"))
    return sheet, Account(sheet, notation_of(sheet, "chinese"))


def _at(name, degrees):
    scene = mechanism_of(name)
    return draft(scene, {scene.drivers[0].key: math.radians(degrees)})


def test_every_equation_is_one_stage_and_the_position_another():
    sheet, _ = _six_bar()
    assert [None, 1, 2, 3, 4, 5, 6] == [s.equation and s.equation.number for s in stages(sheet)]


def test_an_angular_velocity_is_computed_from_what_was_measured():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "omega turning")
    assert Phrase("clockwise") == step.phrase.gaps["sense"]
    length, rate = "$l_{CB}$ = 190.80 mm × 2 mm/mm = 381.6 mm", "$ω_{3}$ = 1075.8 mm/s / 381.6 mm = 2.819 rad/s"
    assert [length, rate] == [*map(repr, telling(speaker, step).work)]


def test_a_coriolis_part_is_computed_from_a_measured_rate_and_a_measured_velocity():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "lay off coriolis")
    assert "2 × 2.8191 × 575.41 = 3244.3 mm/s²" in str(telling(speaker, step).work[0])


@pytest.mark.parametrize(
    ("name", "at"), [("double-butterfly", 180), ("sixbar-420rpm", 60), ("sixbar-AE70", 0), ("whitworth", 17.3)]
)
def test_what_is_laid_off_is_the_quotient_of_the_numbers_before_it(name, at):
    sheet = _at(name, at)
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    lines = [str(line) for step in sheet.steps for line in telling(speaker, step).work]
    divided = [re.fullmatch(r"([\d.]+) \S+ ÷ ([\d.]+) \S+ = ([\d.]+) mm", line) for line in lines]
    said = [tuple(map(Decimal, one.groups())) for one in divided if one]
    assert said
    half = [Decimal("0.5").scaleb(length.as_tuple().exponent) for *_, length in said]
    assert [] == [one for one, off in zip(said, half, strict=True) if abs(one[0] / one[1] - one[2]) > off]


def test_a_rate_comes_to_the_same_in_its_sentence_and_in_its_quotient():
    sheet = _at("sixbar-420rpm", 60)
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    rates = (s for s in sheet.steps if s.reason == "rate" and not s.held)
    step = next(s for s in rates if (s.kind, s.link) == ("alpha", "4"))
    assert "106.1 rad/s²" in str(speaker.sentence(step.phrase, "en"))
    assert str(telling(speaker, step).work[0]).endswith("= 106.1 rad/s²")


@pytest.mark.parametrize("name", sorted(library()))
def test_a_ratio_of_an_image_is_the_quotient_of_the_lengths_before_it(name):
    sheet = draft(mechanism_of(name))
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    for step in sheet.steps:
        for language in ("en", "zh"):
            told = str(telling(speaker, step).sentence(language))
            said = re.findall(r"= ([\d.]+) : ([\d.]+) = (\d+(?:\.\d+)?)", told)
            for part, whole, ratio in [map(Decimal, one) for one in said]:
                half = Decimal("0.5").scaleb(ratio.as_tuple().exponent)
                assert abs(part / whole - ratio) <= half, (part, whole, ratio)


def test_the_guide_bar_on_paper_divides_its_image_as_it_is_written():
    sheet, speaker = _six_bar()
    whole = " ".join(repr(telling(speaker, step).sentence("en")) for step in sheet.steps)
    assert "= 167.6 : 381.6 = 0.4392" in whole


def test_a_vector_too_small_for_letters_of_its_own_is_not_named_by_one_letter_twice():
    sheet = _at("sixbar-420rpm", 60)
    account = Account(sheet, notation_of(sheet, "chinese"))
    tiny = next(s for s in sheet.steps if s.verb == "lay off" and str(s.symbol) == "an_F/E")
    assert "lay off from" == telling(account, tiny).said.key


@pytest.mark.parametrize(("convention", "expected"), [("chinese", ["b", "c", "p_2"]), ("us", ["V_B", "V_C", "V_P"])])
def test_ends_of_moving_vectors_are_named_in_every_convention(convention, expected):
    sheet = draft(mechanism_of("four-bar-coupler-point"))
    moving = motion_data(sheet, notation_of(sheet, convention), None, count=3)
    assert expected == sorted(name for _, name in moving["velocity"]["ends"])


def test_a_sentence_ends_and_begins_as_its_language_does():
    sheet, speaker = _six_bar()
    step = next(s for s in sheet.steps if s.phrase.key == "lay off coriolis")
    english, chinese = (str(speaker.sentence(step.phrase, each)) for each in ("en", "zh"))
    assert ("L", ".", "。") == (english[0], english[-1], chinese[-1])


def _reasons(name, language):
    lesson = handout(name, language=language, formats=("pdf",)).lesson
    return {e.number: repr(why(lesson.account, e, language)) for e in lesson.sheet.equations}


@pytest.mark.parametrize("name", ["geneva-step", "cam-eccentric-flat-slider", "wheel-on-rail"])
@pytest.mark.parametrize("language", ["en", "zh"])
def test_a_reason_names_no_link_that_the_scene_does_not_have(name, language):
    told = " ".join(_reasons(name, language).values())
    sheet = draft(mechanism_of(name))
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    steps = [step for step in sheet.steps if step.diagram == "mechanism"]
    told += " ".join(str(telling(speaker, step).sentence(language)) for step in steps)
    assert [] == re.findall(r"(?:link|构件) [A-Z]\w*/\w+", told)
    assert {"en": "runs along", "zh": "导路运动"}[language] in told


def _steps(name, language, convention="chinese"):
    sheet = draft(mechanism_of(name))
    speaker = Account(sheet, notation_of(sheet, convention))
    return [str(telling(speaker, step).sentence(language)) for step in sheet.steps]


def test_a_vector_is_laid_off_from_a_lettered_point_in_a_sense_to_a_lettered_point():
    said = _steps("sixbar-guide-40deg", "en")[21:23]
    normal = "From the pole p′ lay off p′n_3′ = a^n_B3C = ω_3² l_CB (normal component), 30.33 mm, B→C: point n_3′."
    assert normal == said[0]
    assert "⊥CB, pointing to −11.9°: point k_2′" in said[1]


def test_a_chinese_step_makes_a_point_so_that():
    said = _steps("sixbar-guide-40deg", "zh")[21]
    assert said.startswith("由极点 p′ 作 n_3′ 点，使 p′n_3′ = a^n_B3C")


@pytest.mark.parametrize(
    ("name", "step", "said"),
    [
        ("sixbar-guide-40deg", 14, "pb_3 lengthened beyond p mark d_3 so that pd_3 : pb_3 = CD : CB = 167.6 : 381.6"),
        ("shaper-scheme-2", 17, "on pb mark s_4 so that ps_4 : pb = O_4S_4 : O_4B = 290 : 580 = 0.5"),
    ],
)
def test_a_division_by_the_image_tells_its_ratio_also_beyond_the_bar(name, step, said):
    assert said in _steps(name, "en")[step - 1]


def test_a_line_begins_at_the_end_of_the_term_before_it_in_the_equation():
    assert "Through b, the end of v_B, draw a line ⊥CB: v_CB lies on it" in _steps("shaper-scheme-2", "en")[18]


def test_where_vectors_are_named_a_step_begins_at_the_end_of_one():
    assert "From the end of A_B lay off A^n_C/B" in _steps("four-bar-coupler-point", "en", "us")[18]


def test_of_two_crossings_of_arcs_it_is_said_which_is_meant():
    assert "meet in B, to the left of the line from A to C" in _steps("hydraulic-cylinder", "en")[1]
    assert "of the two crossings the left one" in _steps("shaper-scheme-2", "en")[6]
    assert "the one to the left of the line from C to O" in _steps("cam-eccentric-flat-rocker", "en")[3]


def test_every_point_of_a_link_is_found_with_ruler_and_compass():
    coupler = _steps("four-bar-coupler-point", "en")[4]
    arcs = "an arc about B of 70.00 mm and one about C of 50.00 mm meet in P, to the left of the line from B to C"
    assert f"Join B and C: link 2; {arcs}." == coupler
    bar = "On O_4A lengthened beyond A mark B: O_4B = 116.00 mm on paper; on O_4B mark S_4: O_4S_4 = 58.00 mm on paper."
    assert bar == _steps("shaper-scheme-2", "en")[4]


@pytest.mark.parametrize(("across", "sense"), [(80, "counter-clockwise"), (-80, "clockwise")])
def test_a_point_beside_a_guide_that_a_pin_directs_is_turned_from_it(across, sense):
    source = read("shaper-scheme-2").to_dict()
    source["links"]["4"] = {"points": ["O4"], "at": {"B": [575, across]}}
    turned = f"At O_4 turn 7.921° {sense} from O_4A and lay off O_4B = 116.11 mm on paper: B."
    assert turned in _steps(source, "en")


def test_a_larger_group_is_placed_link_by_link_each_from_what_stands():
    said = _steps("sixbar-1A-last-link", "en")[4:8]
    assert "Through F draw link 5 at 154.233° to the x axis, counter-clockwise positive." == said[0]
    assert "Mark E on link 5: FE = 17.20 mm on paper." == said[1]
    assert said[2].endswith("meet in C, to the right of the line from E to D.")
    assert said[3].startswith("Join E and C: link 2; an arc about E of 74.57 mm and one about C of 52.80 mm meet in B")


def test_a_point_of_a_moving_link_over_a_fixed_pivot_is_not_the_pole():
    said = _steps("hit-two-RPR", "en")
    assert "The two lines meet in c_2, the end point of C_2." == said[9]
    assert "on bc_2 lengthened beyond c_2 mark d_4" in said[13]


def test_no_end_point_is_named_twice():
    said = _steps("shaper-scheme-2", "en")
    assert [] == [step for step in said if step.startswith("Name the end point")]


def test_a_term_laid_off_before_its_turn_ends_in_a_letter():
    said = " ".join(_steps("sixbar-1A-last-link", "en"))
    assert "before its turn, since it is known: point n_2′" in said
    assert "Through n_2′, the end of a^n_SE, draw a line ⊥EF: a^t_EF + a^t_SE lies on it" in said


def test_trials_of_a_group_are_told_with_what_is_measured_and_divided():
    said = " ".join(_steps("contour-four-bars", "en"))
    assert "the length DF measured, less 32.50 mm, is 2.10; 1.34; 0.56; −0.25;" in said
    assert "between the trial positions 3 and 4, divided as 0.56 to 0.25, at −172.68°" in said
    assert "cross at 3° only, 554 mm away, off the paper, so trial polygons are superposed" in said
    assert "from d to f along DF, positive from D to F: I 6.13; II −5.97 mm" in said
    assert "ω_3 = −6.659 (−6.6584) rad/s, that is −6 − 6.13 / (5.97 + 6.13) × 1.3" in said
    assert "From b lay off v_CB = ω_3 l_CB, 39.95 mm, ⊥CB, pointing to −91.5°: point c" in said


def test_rates_that_add_up_and_what_is_carried_over_from_a_held_link_are_steps_of_their_own():
    said = _steps("scissor-lift", "en")
    assert 4 == sum("ω_3 + ω_" in step for step in said)
    assert "ω_2 = ω_3 + ω_23 = −0.041617 + 0.083233 = 0.041616 (0.041617) rad/s." in said
    assert "α_2 = α_3 + α_23 = −0.014983 + 0.029966 = 0.014983 rad/s²." in said
    assert 1 == sum(step.endswith("point a_3; v_A3 = −v_A2A3.") for step in said)
    (more,) = (step for step in said if "a^r_A3A2 = −a^(3)_A2A3" in step)
    assert more.replace("\u00a0", " ").endswith("and from its end 2ω_32 v_A3 = 2 × 0.083233 × 66.587 = 11.084 mm/s², "
                         "along v_A3 turned 90° clockwise.")


def test_every_equation_says_why_and_the_rule_of_coriolis_stands_once():
    told = _reasons("shaper-scheme-2", "en")
    assert "$A_{4}$ turns about the fixed pivot $O_{4}$ with link 4" in told[2]
    assert "$A_{4}$ and $A_{3}$ coincide at this moment; link 3 slides on link 4" in told[2]
    assert "$C$ moves with link 6 along the fixed guide" in told[3]
    assert "$C$ and $B$ are points of the rigid link 5" in told[3]
    assert "$v_{B}$ is known from step 16" in told[3]
    rule = "turned by 90° in the sense in which"
    assert 1 == sum(rule in said for said in _reasons("sixbar-guide-40deg", "en").values())


def test_the_sense_of_a_coriolis_term_follows_from_the_two_arrows():
    said = _reasons("shaper-scheme-2", "zh")[5]
    assert "$v_{A4A3}$ 指向 76.9°，构件 4 顺时针转动，故指向 −13.1°" in said


def test_a_page_of_one_position_says_one():
    page = handout("swinging-block", formats=("html",), positions=1).files["handout.html"].decode()
    assert "drawn for one position of the driver" in page


def test_what_is_told_in_a_way_of_its_own_is_told_of_steps_of_the_board():
    told = [*InMechanism.sentences, *InPolygon.sentences]
    reasons = {reason for verb in get_args(Reason) for reason in get_args(verb) or (verb,)}
    assert set() == {*told, *InPolygon.arithmetic, *InPolygon.lines, *InMechanism.lines} - reasons
    assert len(set(told)) == len(told)


def test_a_sliding_velocity_is_not_told_by_that_of_one_of_its_points_where_both_move():
    sheet = draft(mechanism_of(redriven(29)))
    told = repr(why(Account(sheet, notation_of(sheet, "chinese")), sheet.equations[7], "en"))
    assert "link 8 slides on link 6, so their relative motion is along the guide" in told
    assert "$v_{P8_{6}}$ points to" not in told


def test_a_vector_that_is_nought_is_not_drawn_from_the_pole():
    sheet = draft(mechanism_of(random_scene(1, ("RPR", "slotted", "slotted"), "resting", True)))
    speaker = Account(sheet, notation_of(sheet, "chinese"))
    steps = [step for step in sheet.steps if step.reason == "pole to end"]
    assert "a_P1_3 = 0." in [str(telling(speaker, step).sentence("en")) for step in steps]


@pytest.mark.parametrize(("name", "old", "new", "convention"), [
    ("disc-on-disc", "O", "O", "british"), ("sixbar-guide-40deg", "D", "K", "chinese"),
    ("shaper-scheme-2", "C", "N", "chinese"), ("shaper-scheme-2", "B", "O", "british"),
])
def test_no_two_places_of_a_polygon_bear_one_letter(name, old, new, convention):
    scene = read(name).to_dict()
    asked = {key: scene[key] for key in ("frame", "links", "contacts", "pins", "driver", "sketch") if key in scene}
    sheet = draft(mechanism_of(json.loads(json.dumps(asked).replace(f'"{old}"', f'"{new}"'))))
    named = PolygonPoints(sheet, "acceleration", notation_of(sheet, convention)).named
    places = {}
    for point in named:
        places.setdefault(point.letter, []).append(point.at)
    assert {} == {letter: at for letter, at in places.items() if abs(max(at, key=abs) - min(at, key=abs)) > 1e-3}


@pytest.mark.parametrize(("told", "text", "language"), [
    ("So $v$ is found.", "so " + sign("v") + " is found", "en"), ("It ends.", "it ends.", "en"),
    ("$v$ 已知。", sign("v") + " 已知。", "zh"), ("Found: $v$.", "found: " + sign("v"), "en"),
])
def test_a_sentence_has_its_capital_and_one_full_stop(told, text, language):
    assert told == repr(whole_sentence(text, language))


def test_a_sum_breaks_only_before_its_sign_of_equality():
    assert "$v$ =\u00a02\u00a0×\u00a03 =\u00a06\u00a0mm" == repr(bound(sign("v") + " = 2 × 3 = 6 mm"))


def test_a_contact_is_named_as_the_point_that_it_is():
    sheet = draft(mechanism_of("cam-flat-face"))
    account = Account(sheet, notation_of(sheet, "chinese"))
    remark = Remark("acceleration", "at contact", {"contact": "K"}).phrase
    assert repr(account.say(remark, "en")).startswith("contact $K$ is drawn at the contact itself")


def test_a_link_that_is_named_like_a_point_is_no_point():
    sheet = draft(mechanism_of("four-bar-coupler-point"))
    account = Account(sheet, notation_of(sheet, "chinese"))
    assert "mark $B$ on link Rod2" == repr(account.say(Phrase("points", link="Rod2", points=PointNames(("B",))), "en"))


def test_a_vector_between_the_centres_of_two_discs_is_of_the_bar_that_stands_for_their_contact():
    sheet = draft(mechanism_of({
        "frame": {"points": {"A": [0, 0], "C": [100, 0], "F": [170, 0]}},
        "links": {
            "1": {"points": ["A", "O"], "length": 20, "discs": {"k": {"centre": "O", "r": 40}}},
            "2": {"points": ["C", "B"], "length": 70, "at": {"E": [30, -20]},
                  "discs": {"w": {"centre": "B", "r": 15}, "v": {"centre": "E", "r": 20}}},
            "3": {"points": ["F", "G"], "length": 60, "discs": {"u": {"centre": "G", "r": 40}}},
        },
        "contacts": {"K": {"between": ["1.k", "2.w"]}, "L": {"between": ["2.v", "3.u"]}},
        "sketch": {"B": [54, 52], "G": [160, 60]},
        "driver": {"link": "1", "angle": 50, "omega": 12},
    }))
    assert ["OB", "EG"] == [link_of_vector(sheet, Symbol.parse(name)) for name in ("v_B/O", "v_G/E")]


def test_the_foot_of_a_bar_between_two_discs_bears_its_points():
    sheet = draft(mechanism_of("disc-on-disc"))
    feet = PolygonPoints(sheet, "acceleration", notation_of(sheet, "chinese")).feet
    assert ["n1′", "n2′", "nOB′"] == [foot.letter.plain("") for foot in feet]


@pytest.mark.parametrize(
    ("scene", "expected"),
    [(wheel_at_its_rim(), {"why rolling velocity", "why rolling acceleration"}), ("disc-on-disc", set())],
)
def test_the_contact_of_bodies_that_roll_on_each_other_is_said_to_have_one_velocity(scene, expected):
    checked = check(scene)
    sheet = (checked.at_contacts or checked).sheet
    told = {phrase.key for equation in sheet.equations for phrase in reasons(sheet, equation)}
    assert expected == {key for key in told if "rolling" in key}


def test_several_trials_are_told_with_the_parts_of_their_steps_that_close_all_gaps():
    said = " ".join(_steps(BARE, "en"))
    assert "left out, until it fits; between trials by proportional division" in said  # of three, not of two
    assert "at I 43.14°, −31.35°; II 46.58°, −31.35°; III 43.14°, −27.91°" in said
    assert "are I 0.90 mm, −9.99 mm; II 0.90 mm, 6.74 mm; III −1.10 mm, −4.57 mm" in said
    # 0.90 − 2.00 q = 0 and −9.99 + 16.73 p + 5.42 q = 0
    assert "taking 0.45, 0.45 of the steps from trial I to II, III together, at 44.69°, −29.80°" in said
    assert "put in the place of I and divided so again" in said


def test_a_fixed_pin_in_a_moving_slot_is_told_by_the_links_that_coincide():
    said = " ".join(_reasons(FIXED_PIN, "en").values())
    assert "$C_{2}$ and $C_{0}$ coincide at this moment; $C_{0}$ runs along a guide of link 2" in said
    assert "/2" not in said


def test_the_bar_that_stands_for_a_cam_has_its_reason():
    sheet = check("cam-offset-roller").sheet
    account = Account(sheet, notation_of(sheet, "chinese"))
    said = [str(why(account, equation, "en")) for equation in sheet.equations]
    reason = "B and O are the centres of curvature of the outlines that touch: their distance stays"
    assert [1, 3] == [number for number, sentences in enumerate(said) if reason in sentences]
