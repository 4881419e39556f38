"""What was understood of a scene is said in words, in both languages."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest

import graphkin
from graphkin.account.account import telling
from graphkin.account.notation import notation_of
from graphkin.account.voice import Account
from graphkin.api.report_text import report_text
from graphkin.scene.scene import toml_text

from ..command import run

CONTRACT = Path(__file__).parent.parent / "validation" / "contract"


def test_a_six_bar_is_explained_joint_by_joint() -> None:
    data = graphkin.explain("sixbar-guide-40deg").data
    assert data["joints"] == [
        "A joins the links 6, 1: a turning pair",
        "C joins the links 6, 3: a turning pair",
        "B joins the links 1, 2: a turning pair",
        "D joins the links 4, 5: a turning pair",
        "link 2 slides on the guide 3 with its point B, its own axis at 0° to it: a sliding pair",
        "link 4 slides on the guide 3 with its point D, its own axis at 0° to it: a sliding pair",
        "link 5 slides on the guide 6.h with its point D, its own axis at 0° to it: a sliding pair",
    ]
    assert data["mobility"] == ["F = 3·5 − 2·7 − 0 = 1: as many as there are drivers"]
    assert data["drivers"] == ["link 1 turns relative to link 6, now at 50°, clockwise with 10 rad/s (95.493 rpm)"]
    assert data["groups"][:2] == [
        "links 2, 3: RPR, class II", "its assembly: B on the positive side of the guide of 2/3"
    ]


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"driver.alpha": 20}, "clockwise with 10 rad/s (95.493 rpm), accelerated counter-clockwise with 20 rad/s2"),
        ({"driver.alpha": -3, "driver.omega": 0}, "and stands still, accelerated clockwise with 3 rad/s2"),
    ],
)
def test_the_acceleration_of_a_turning_driver_is_told(changes: dict[str, float], said: str) -> None:
    scene = graphkin.read("sixbar-guide-40deg")
    for key, value in changes.items():
        scene = scene.replace(key, value)
    (driver,) = graphkin.explain(scene).data["drivers"]
    assert f"link 1 turns relative to link 6, now at 50°, {said}" == driver


def test_the_acceleration_of_a_driven_slide_is_told_along_its_guide() -> None:
    scene = graphkin.read("boom-lifted").replace("driver.acceleration", -7)
    (driver,) = graphkin.explain(scene).data["drivers"]
    assert driver.endswith("along the guide's sense with 60 mm/s, accelerated against the guide's sense with 7 mm/s2")


@pytest.mark.parametrize(
    ("name", "group"),
    [
        ("geneva-step", "link 2 and the block at B: RPR, class II"),
        ("disc-on-disc", "link 2 and the bar OB: RRR, class II"),
        (str(CONTRACT / "trammel-on-pins.toml"), "link 2 and the blocks at B, C: a larger group, class III"),
        (str(CONTRACT / "pin-in-two-guides.toml"), "the blocks at P: PRP, class II"),
    ],
)
def test_a_group_is_named_with_what_stands_in_it_for_pins_and_contacts(name: str, group: str) -> None:
    assert group == graphkin.explain(name).data["groups"][0]


@pytest.mark.parametrize(
    ("language", "group"), [("en", "the blocks at P: PRP, class II; "), ("zh", "P 处各滑块：Ⅱ级杆组 PRP；")]
)
def test_a_group_without_a_link_of_the_file_is_solved_by_name(language: str, group: str) -> None:
    assert group in run("solve", str(CONTRACT / "pin-in-two-guides.toml"), "--lang", language).stdout


@pytest.mark.parametrize(
    ("language", "group"), [("en", "Group of the blocks at P: "), ("zh", "由 P 处各滑块组成的杆组：")]
)
def test_a_group_without_a_link_of_the_file_stands_in_the_report(language: str, group: str) -> None:
    assert group in report_text(graphkin.check(str(CONTRACT / "pin-in-two-guides.toml")), language)


@pytest.mark.parametrize("name", ["double-butterfly", "oldham-coupling", "hydraulic-cylinder", "hit16-double-guide"])
def test_every_link_and_every_sliding_pair_is_named(name: str) -> None:
    explained = graphkin.explain(name)
    scene = explained.mechanism
    said = explained.data
    assert [] == [n for n in scene.order if not any(f"link {n} " in s for s in said["links"])]
    assert len(scene.slides) == sum("slides on" in s or "runs in" in s for s in said["joints"])
    assert explained.ok


def test_a_hinge_of_three_links_is_two_turning_pairs() -> None:
    scene = graphkin.read("fourbar-150-500-300-400").to_dict()
    scene["links"]["5"] = {"points": ["C", "F"], "length": 100}
    explained = graphkin.explain(scene)
    assert "C joins the links 2, 3, 5: 2 turning pairs" in explained.data["joints"]
    assert "F = 3·4 − 2·5 − 0 = 2, but the number of drivers is 1: it moves, but its motion is not determined" in (
        explained.data["mobility"]
    )
    assert not explained.ok


@pytest.mark.parametrize(
    ("extra", "said"),
    [
        ({}, "= 1, but the number of drivers is 2: by this count it cannot move as it is driven"),
        ({"5": {"points": ["B", "D"], "length": 300}}, "= 0, but the number of drivers is 2: by this count it cannot"),
    ],
)
def test_more_drivers_than_freedoms_are_told_to_hold_it(extra, said) -> None:
    scene = graphkin.read("fourbar-150-500-300-400").to_dict()
    crank = scene["driver"] if isinstance(scene["driver"], dict) else scene["driver"][0]
    scene["driver"] = [crank, {"link": "3", "angle": 80, "omega": 1}]
    scene["links"] |= extra
    (counted,) = graphkin.explain(scene).data["mobility"]
    assert said in counted


def test_the_command_says_it_in_chinese_and_leaves_with_3_where_nothing_moves(tmp_path) -> None:
    assert "构件 1 为杆 AB，长 122 mm" in run("explain", "sixbar-guide-40deg", "--lang", "zh").stdout
    scene = graphkin.read("fourbar-150-500-300-400").to_dict()
    scene["links"]["5"] = {"points": ["C", "F"], "length": 100}
    path = tmp_path / "a.toml"
    path.write_text(toml_text(scene), encoding="utf-8")
    answer = run("explain", str(path))
    assert 3 == answer.returncode
    assert "a mechanism of mobility 2 needs as many" in answer.stderr


@pytest.mark.parametrize(("name", "what"), [("cam-offset-roller", "cam"), ("gears-epicyclic", "wheel")])
def test_a_cam_and_a_wheel_are_told_as_what_they_are(name: str, what: str) -> None:
    lines = graphkin.explain(name).text.splitlines()
    assert f"link 1 is a {what} about A" in [line.strip() for line in lines]
    assert not any("no fixed length" in line for line in lines)


def test_a_spring_is_explained_with_its_ends_and_its_numbers_in_the_units_of_the_file() -> None:
    spring = {"between": ["A", "C"], "rate": 2, "free": 12, "preload": 0.5}
    sprung = graphkin.read("four-bar-coupler-point").to_dict() | {"springs": {"s": spring}}
    sprung["units"] = {"length": "cm", "force": "kN"}
    assert ("spring s between A of link 4 and C of link 2: rate 2 kN/cm, free length 12 cm, preload 0.5 kN; "
            "P_s is its force on link 4") in graphkin.explain(sprung).text


def test_a_load_is_told_with_its_place_its_direction_and_when_it_acts_and_a_flywheel_with_its_link():
    gas = graphkin.explain("engine-gas-force").data["loads"]
    assert "load gas: a force of 6000 N on link 4 at B, direction 180°, while the driver goes from 0° to 180°" in gas
    press = graphkin.explain("toggle-press-force").data["loads"]
    delta = "keeps the coefficient of speed fluctuation to 0.1, with a constant driving moment"
    assert f"a flywheel on link 1 {delta}" == press[-1]


def test_forces_are_asked_too_where_something_loads_the_mechanism():
    loaded = graphkin.read("four-bar-coupler-point").to_dict() | {"loads": {"P": {"on": "3", "moment": 2}}}
    assert "all velocities, accelerations and forces" in graphkin.explain(loaded).text
    assert "all velocities and accelerations" in graphkin.explain("four-bar-coupler-point").text


CIRCULAR: dict[str, Any] = {
    "frame": {"points": {"A": [0, 0], "M": [60, 0]}, "guides": {"s": {"centre": "M", "r": 80}}},
    "links": {"1": {"points": ["A", "B"], "length": 30}, "2": {"points": ["B", "C"], "length": 90}},
    "driver": {"link": "1", "angle": 70, "omega": 3},
    "sketch": {"C": [60, 80]},
}


def test_a_pin_in_a_circular_slot_is_told_as_such_with_the_bar_that_stands_in_its_place() -> None:
    data = graphkin.explain(CIRCULAR | {"pins": {"C": {"of": "2", "in": "0.s"}}}).data
    assert "it has the circular slot 0.s about M, of radius 80 mm" in data["links"]
    assert [
        "A joins the links 0, 1: a turning pair",
        "B joins the links 1, 2: a turning pair",
        "the pin C of link 2 runs in the circular slot 0.s about M: a higher pair; "
        "bar s from M to C stands in its place",
    ] == data["joints"]
    assert ["F = 3·2 − 2·2 − 1 = 1: as many as there are drivers"] == data["mobility"]


def test_a_block_in_a_circular_slot_is_a_block_and_its_centre_joins_nothing() -> None:
    scene = CIRCULAR | {"links": CIRCULAR["links"] | {"3": {"points": ["C"], "on": "0.s"}}}
    data = graphkin.explain(scene).data
    assert "link 3 is a block with the point C" in data["links"]
    assert [
        "A joins the links 0, 1: a turning pair",
        "B joins the links 1, 2: a turning pair",
        "C joins the links 2, 3: a turning pair",
        "link 3 slides with its point C in the circular slot 0.s, and so turns about M: counted as a turning pair",
    ] == data["joints"]


def test_no_dash_stands_for_a_point_that_is_not_there() -> None:
    scenes = ("wheel-on-rail", "scotch-yoke", "cam-eccentric-flat-slider", "oldham-coupling")
    said = [text for name in scenes for part in ("links", "joints") for text in graphkin.explain(name).data[part]]
    assert [] == [text for text in said if " - " in f"{text.replace(',', '')} "]


def test_all_that_is_wrong_stands_in_sentences_of_their_own() -> None:
    links = CIRCULAR["links"] | {"4": {"points": ["B"]}, "5": {"points": ["B"]}}
    why = str(graphkin.explain(CIRCULAR | {"links": links}).why)
    assert "as many drivers. links." in why


def test_internal_teeth_are_counted_without_a_sign() -> None:
    said = graphkin.explain("gears-epicyclic")
    assert "mesh with 20 and 70 internal teeth" in said.text
    assert "齿数 20 与 70（内齿）" in graphkin.explain("gears-epicyclic", language="zh").text


@pytest.mark.parametrize(("scene", "told"), [
    ("gears-epicyclic", "the frame, with the point A (0, 0)"), ("whitworth", "the frame, with the points "),
    ("scissor-lift", "has the further point M (800, 0)"), ("scissor-lift", "has the further points M (800, 0), P"),
])
def test_one_point_is_a_point_and_several_are_points(scene: str, told: str) -> None:
    assert told in graphkin.explain(scene).text


def test_a_chinese_list_has_chinese_marks() -> None:
    assert "A 连接构件 0、1、2：" in graphkin.explain("gears-epicyclic", language="zh").text
    assert "固定点和导路：O2、O4" in report_text(graphkin.check("shaper-forces"), "zh")


def test_a_rate_bears_its_letter_in_every_sentence_of_a_report() -> None:
    lines = report_text(graphkin.check("contour-four-bars"), "en").split("\n")
    steps = " ".join(line for line in lines if re.match(r" *\d+  ", line))
    assert "ω_3 = −6 rad/s" in steps
    assert "omega_" not in steps


def test_the_columns_of_a_chinese_report_stand_under_each_other() -> None:
    lines = [columns(line) for line in report_text(graphkin.check("four-bar-coupler-point"), "zh").split("\n")]
    at = next(i for i, line in enumerate(lines) if "大" in line)
    assert lines[at - 1].index("v_B") == lines[at].index("ω_1")
    head = next(i for i, line in enumerate(lines) if line.startswith("量量 "))
    ends = [[m.end() for m in re.finditer(r"\S+", line)][1:4] for line in lines[head : head + 2]]
    assert ends[0] == ends[1]


def columns(text: str) -> str:
    """The text with Chinese characters twice, as wide as a terminal shows them."""
    return "".join(c * 2 if ord(c) > 0x2E7F else c for c in text)


def test_a_hollow_outline_has_a_radius_above_0_and_a_body_with_an_outline_elsewhere_is_not_called_round():
    ring = graphkin.explain({
        "frame": {"points": {"A": [0, 0], "C": [120, 0]}},
        "links": {
            "1": {"points": ["A", "O"], "length": 15, "discs": {"k": {"centre": "O", "r": 35}}},
            "2": {"points": ["C"], "at": {"R": [-125, 30]}, "discs": {"h": {"centre": "R", "r": -50}}},
        },
        "contacts": {"K": {"between": ["1.k", "2.h"]}},
        "driver": {"link": "1", "angle": 70, "omega": 9},
    })
    assert "it has the hollow round outline h about R, of radius 50 mm, inside which others touch it" in ring.text
    assert "link 2 is a body with the point C\n" in ring.text


PIN_AT_A_CROSSING: dict[str, Any] = {
    "frame": {"points": {"A": [0, 0]}, "guides": {
        "v": {"through": [100, 0], "angle": 80}, "u": {"through": [0, 20], "angle": 0}}},
    "links": {"1": {"points": ["A"]}, "2": {"points": ["P", "Q"], "length": 60}, "3": {"points": ["Q"], "on": "0.u"}},
    "pins": {"P": {"of": "2", "in": ["1", "0.v"]}},
    "driver": {"link": "1", "angle": 30, "omega": 2},
}


@pytest.mark.parametrize(("scene", "mark"), [(PIN_AT_A_CROSSING, "mark P"), ("wheel-on-rail", "mark C, K")])
def test_a_step_calls_no_block_a_link_that_only_stands_for_a_pin_or_a_contact(scene, mark):
    checked = graphkin.check(scene)
    steps = [line.strip() for line in report_text(checked, "en").splitlines() if re.match(r" +\d+  ", line)]
    assert mark in [step.split(maxsplit=1)[1] for step in steps]
    assert [] == [step for step in steps if re.search(r"link \w+/", step)]
    account = Account(checked.sheet, notation_of(checked.sheet, "us"))
    told = [str(telling(account, step).sentence("en")) for step in checked.sheet.steps]
    assert [] == [sentence for sentence in told if re.search(r"link \w+/", sentence)]


def test_the_joints_of_a_link_that_repeats_what_others_hold_are_told_as_not_counted():
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [300, 0], "E": [150, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100},
            "2": {"points": ["B", "C"], "length": 300, "at": {"F": [150, 0]}},
            "3": {"points": ["D", "C"], "length": 100},
            "4": {"points": ["E", "F"], "length": 100, "redundant": True},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
    }
    told = graphkin.explain(scene).text
    assert ["E joins the links 0, 4", "F joins the links 2, 4"] == re.findall(r"(\w joins .*): not counted", told)
