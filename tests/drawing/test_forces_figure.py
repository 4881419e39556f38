"""The figures of forces: lengths are those stated, polygons close on paper, every letter has its place."""

from __future__ import annotations

import math
import re
import xml.etree.ElementTree as ET
from collections.abc import Callable
from decimal import Decimal
from pathlib import Path
from typing import Any

import pytest

import graphkin
from graphkin.account.forces import ForceStage, balance, force_stages
from graphkin.account.notation import force_letters, notation_of
from graphkin.account.voice import Account
from graphkin.construction.forces.steps import MomentStep
from graphkin.drawing import svg_bytes
from graphkin.scene.symbol import Symbol
from graphkin.words import rich_text
from graphkin.words.written import amount, is_quotient
from tests.construction.test_forces import DRIVEN_AGAINST_A_BLOCK
from tests.mechanisms import floating_cylinder, random_scene
from tests.solver.test_forces import loaded, scene_of

SHAPER, ENGINE = scene_of("shaper-scheme-2"), scene_of("engine")
FIGURES = ["forces", "lever"]
LABELLED = [
    (SHAPER, 14.9, "zh", "chinese"), (SHAPER, 104.9, "both", "russian"), (ENGINE, 60, "en", "us"),
    (ENGINE, 180, "zh", "british"), (scene_of("fourbar-moment"), 150, "en", "chinese"),
    *((loaded(graphkin.read(name).to_dict(), 4), at, "both", convention) for name, at, convention in (
        ("disc-on-disc", 50, "us"), ("cam-flat-face", 70, "chinese"), ("geared-five-bar", 40, "russian"),
        ("wheel-on-rail", 30, "british"),
    )),
]
BLOCK_ON_THE_CRANK = {
    "frame": {"points": {"A": [0, 0], "D": [0, -150]}},
    "links": {
        "2": {"points": ["A"], "guides": {"s": {"through": [0, 0], "angle": 0}}},
        "3": {"points": ["C"], "on": "2.s"},
        "4": {"points": ["C", "D"], "length": 200},
    },
    "driver": {"link": "2", "angle": 20, "omega": 2},
    "sketch": {"C": [120, 40]},
    "loads": {"M": {"on": "3", "moment": 7}},
}
SVG = "{http://www.w3.org/2000/svg}"


def stages_of(name: Any) -> tuple[ForceStage, ...]:
    sheet = graphkin.check(name).sheet
    return tuple(force_stages(Account(sheet, notation_of(sheet, "chinese"))))


def lines_of(scene: Any) -> list[str]:
    """The sums of all steps in English."""
    return [repr(line) for stage in stages_of(scene) for step in stage.steps for line in step.work_in("en")]


def vectors(svg: bytes) -> dict[str, complex]:
    """Every vector of a figure by its id, mm with y up."""
    found = {}
    for group in ET.fromstring(svg).iter(f"{SVG}g"):
        if "vector" in group.get("class", "").split():
            line = next(iter(group.iter(f"{SVG}line")))
            x1, y1, x2, y2 = (float(line.get(key, "0")) for key in ("x1", "y1", "x2", "y2"))
            found[group.get("id", "")] = complex(x2 - x1, y1 - y2)
    return found


def test_the_sketch_of_a_larger_group_shows_forces_of_pairs_from_outside_alone() -> None:
    # link 3 pushes the pin Q of link 2, both of the group
    drawn = graphkin.draw(loaded(floating_cylinder(3), 3), figures=["forces"])
    texts = [text for page in drawn.figures.values() for text in ET.fromstring(svg_bytes(page)).iter(f"{SVG}text")]
    acting = {"".join(text.itertext()) for text in texts if text.get("id", "").startswith("label-acts-1-2-3-")}
    assert {"FR01", "FR02"} == {name for name in acting if name.startswith("FR")}


def test_a_vector_is_as_long_as_the_scale_says_in_its_direction() -> None:
    drawn = graphkin.draw(SHAPER, figures=["forces"])
    pages = drawn.figures
    found = {name: v for page in pages.values() for name, v in vectors(svg_bytes(page)).items()}
    per = drawn.checked.data["scales"]["force"]
    for name, key in (("F_4-5", "F_4/5"), ("F_1-6", "F_1/6"), ("F_2-3", "F_2/3"), ("F_1-4", "F_1/4"), ("P_P", "P_P")):
        assert drawn[key].exact / per == pytest.approx(found[name], abs=2e-3), name


def test_the_scale_stands_in_the_facts_of_the_figure() -> None:
    facts = graphkin.draw(SHAPER, figures=["forces"]).figures["forces"].metadata
    assert 200.0 == facts["scales"]["force"]  # type: ignore[index]


def test_a_wished_scale_is_kept() -> None:
    scene = graphkin.read(SHAPER).replace("sheet", {"force_scale": 100})
    assert 127.66 == pytest.approx(graphkin.check(scene)["F_4/3"].on_paper, abs=5e-3)


@pytest.mark.parametrize("per_mm", [100, 25])
def test_polygons_at_a_wished_scale_stand_inside_their_panels(
    per_mm: float, violations: Callable[[bytes], list[str]]
) -> None:
    scene = graphkin.read(SHAPER).replace("sheet", {"force_scale": per_mm})
    pages = graphkin.draw(scene, figures=["forces"]).figures
    assert {name: [] for name in pages} == {name: violations(svg_bytes(page)) for name, page in pages.items()}


@pytest.mark.parametrize(("scene", "at", "language", "convention"), LABELLED)
def test_no_label_of_a_force_is_overlapped_crossed_or_cut(
    scene: Path | dict[str, object], at: float, language: str, convention: str, violations: Callable[[bytes], list[str]]
) -> None:
    drawn = graphkin.draw(scene, at=at, figures=FIGURES, language=language, convention=convention).figures
    assert {name: [] for name in drawn} == {name: violations(svg_bytes(page)) for name, page in drawn.items()}


def test_a_scene_with_loads_has_both_figures_by_itself() -> None:
    wanted = ("mechanism", "velocity", "acceleration", "sheet", "centres", "forces", "lever")
    assert wanted == graphkin.draw(SHAPER).wanted


def test_without_loads_there_is_nothing_to_draw() -> None:
    assert {} == graphkin.draw("shaper-scheme-2", figures=FIGURES).figures


@pytest.mark.parametrize(
    ("convention", "letters"),
    [("chinese", "F_{R56}"), ("us", "F_{56}"), ("british", "F_{56}"), ("russian", "R_{56}")],
)
def test_each_school_writes_a_joint_force_in_its_way(convention: str, letters: str) -> None:
    assert f"${letters}$" == repr(force_letters(convention, Symbol.parse("F_5/6")))  # type: ignore[arg-type]


def test_a_larger_group_is_drawn_link_by_link() -> None:
    scene = loaded(graphkin.read("double-butterfly").to_dict(), 5)
    pages = graphkin.draw(scene, figures=["forces"]).figures
    text = " ".join("".join(ET.fromstring(svg_bytes(page)).itertext()) for page in pages.values())
    assert "are one system" in re.sub(r"\s+", " ", text)


def test_both_polygons_stand_where_a_load_ends() -> None:
    pages = graphkin.draw(ENGINE, at=180, figures=["forces"]).figures
    found = {name for page in pages.values() for name in vectors(svg_bytes(page))}
    assert {"F_2-3", "F_2-3-with"} <= found


def test_the_lever_tells_both_values() -> None:
    page = graphkin.draw(SHAPER, figures=["lever"]).figures["lever"]
    text = "".join(ET.fromstring(svg_bytes(page)).itertext())
    assert 2 == text.count("−539.79")


@pytest.mark.parametrize("name", ["rocker-return-spring", "toggle-press-force", "engine-gas-force", "shaper-forces"])
def test_the_sum_on_a_lever_is_that_of_its_rows_and_gives_the_balance_as_they_are_written(name: str) -> None:
    figure = ET.fromstring(svg_bytes(graphkin.draw(name, figures=["lever"], language="en").figures["lever"]))
    words = ["".join(text.itertext()).replace("−", "-") for text in figure.iter("{http://www.w3.org/2000/svg}text")]
    arm, sense, total = re.search(r"·([\d.]+) ([+-]) ([\d.]+) = 0", " ".join(words)).groups()  # type: ignore[union-attr]
    (head,) = (k for k, text in enumerate(words) if text.startswith("moment about the pole, "))
    moments = [Decimal(row) for row in words[head + 4 :: 4] if re.fullmatch(r"-?[\d.]+", row)]
    balance = re.search(r"(-?[\d.]+) k?N·m by the lever", " ".join(words))
    coarsest = max((moment for moment in moments if moment), key=lambda moment: moment.as_tuple().exponent)
    assert Decimal(f"{sense}{total}") == sum(moments).quantize(coarsest)
    assert balance is not None
    assert balance[1].strip("-") == amount(float(Decimal(total) / Decimal(arm)), 5)


def test_the_sum_on_a_lever_is_told_before_its_result() -> None:
    (stage,) = (stage for stage in stages_of("shaper-forces") if stage.figure == "lever")
    said = [repr(rich_text(line, "en")) for line in stage.told("lever", "on lever", "all moments")]
    assert [False, False, True, False] == ["All moments together" in line for line in said]
    assert "by the lever" in said[-1]


@pytest.mark.parametrize("name", ["rocker-return-spring", "boom-lifted", "engine-gas-force", "shaper-forces"])
def test_what_a_sum_of_moments_gives_is_laid_off_as_it_stands_there(name: str) -> None:
    compared = 0
    for stage in stages_of(name):
        lines = [line for step in stage.steps for line in map(repr, step.work_in("en"))]
        sums = [re.search(r"(\$F[^$]*\$) = ([\d.e-]+) k?N$", line) for line in lines if "ΣM" in line]
        given = {m[1]: m[2] for m in sums if m}
        for line in lines:
            laid = re.search(r"(\$F[^$]*\$) = ([\d.e-]+) k?N ÷ ([\d.]+) \S+ = ([\d.]+) mm", line)
            if laid and laid[1] in given:
                assert given[laid[1]] == laid[2]
                assert is_quotient(laid[4], laid[2], laid[3])
                compared += 1
    assert compared


@pytest.mark.parametrize("name", ["rocker-return-spring", "boom-lifted", "engine-gas-force", "shaper-forces"])
def test_a_sum_of_moments_gives_in_figures_what_is_drawn(name: str) -> None:
    checked = graphkin.check(name)
    newtons, found = checked.mechanism.units.newtons, []
    for state in checked.sheet.forces:
        for one in (s for group in state.groups for s in group.steps if isinstance(s, MomentStep) and s.value):
            terms, arm, value = balance(checked.sheet, one)
            total = sum(float(f"{sign}1") * math.prod(map(float, factors)) for sign, factors in terms)
            assert -total / float(arm or 1) == pytest.approx(float(value), rel=1e-12)
            found.append((amount(abs(one.value) / newtons, 5), amount(abs(float(value)), 5)))
    assert [drawn for drawn, _ in found] == [written for _, written in found]


@pytest.mark.parametrize("name", ["rocker-return-spring", "boom-lifted", "engine-gas-force", "shaper-forces"])
def test_a_sum_of_moments_comes_to_nought_as_it_is_written(name: str) -> None:
    lines = [line for line in lines_of(name) if "ΣM" in line]
    whole = [m for line in lines if (m := re.fullmatch(r"\S+ = (.*) = 0;  (\$\S+\$) = (\S+) k?N(?:·m)?", line))]
    assert whole
    for terms, unknown, value in (m.groups() for m in whole):
        signed = terms if terms.startswith("−") else f"+ {terms}"
        products = re.findall(r"([+−]) (\S+)", signed.replace(unknown, value))
        moments = [(-1.0 if sign == "−" else 1.0) * math.prod(float(x.replace("−", "-")) for x in factors.split("·"))
                   for sign, factors in products]
        assert sum(moments) == pytest.approx(0.0, abs=2e-4 * max(map(abs, moments)))


def test_a_force_through_the_point_of_moments_is_named_as_such_and_left_out_of_the_sum() -> None:
    lines = lines_of("boom-lifted")
    at = lines.index("through that point, without an arm: $F_{I2}$,  $G_{2}$")
    assert lines[at - 1] == "arms on paper: $G_{3}$ 14.71 mm,  $F^{t}_{R43}$ 52.00 mm; in m: × 0.01 m/mm"
    assert lines[at + 1] == "$ΣM_{B}$ = 0.24525·0.147128 − $F^{t}_{R43}$·0.52 = 0;  $F^{t}_{R43}$ = 0.069391 kN"


def test_a_driving_moment_is_told_with_its_own_sense_on_the_link_from_which_it_is_measured() -> None:
    # link 3 is cut free: the moment of the driver on it is the opposite of that on link 2
    lines = lines_of(DRIVEN_AGAINST_A_BLOCK)
    (told,) = (line for line in lines if "$M_{2}$" in line and "ΣM" in line)
    assert told.endswith("− $M_{2}$ = 0;  $M_{2}$ = −10.069 N·m")


def test_a_balancing_force_at_an_angle_to_the_guide_is_not_told_to_lie_along_it() -> None:
    engine = graphkin.read("engine-gas-force").to_dict()
    scene = {**engine, "balance": {"on": "4", "at": "B", "angle": 30}, "find": ["F_4"]}
    driven = next(stage for stage in stages_of(scene) if stage.group.way == "driver")
    (told,) = (str(step.sentence("en")) for step in driven.steps if step.step.verb == "cross")
    assert "∥" not in told
    assert ["⊥h", ""] == [str(v.direction) for v in driven.group.polygon if not v.known][::-1]


def text_of(page: Any, own: str) -> str:
    """The text of a figure that bears an id."""
    return next("".join(e.itertext()) for e in ET.fromstring(svg_bytes(page)).iter() if e.get("id") == own)


def test_the_opposite_of_a_driving_moment_is_drawn_with_its_sign() -> None:
    page = graphkin.draw(DRIVEN_AGAINST_A_BLOCK, figures=["forces"]).figures["forces"]
    assert "−M2" == text_of(page, "label-acts-1-2-3-M_2")


def test_a_force_inside_a_group_is_not_told_to_be_known_on_it() -> None:
    step = stages_of(DRIVEN_AGAINST_A_BLOCK)[0].steps[0]
    assert "Cut links 1, 2, 3 free; known forces and couples: $P$." == repr(step.sentence("en"))


def test_a_couple_that_is_known_of_a_sliding_pair_is_told_and_drawn_where_it_loads_the_next_link() -> None:
    words = [repr(step.sentence("en")) for stage in stages_of(BLOCK_ON_THE_CRANK) for step in stage.steps]
    assert "Cut link 2 free; known forces and couples: $M_{32}$." in words
    page = graphkin.draw(BLOCK_ON_THE_CRANK, figures=["forces"]).figures["forces"]
    assert "M32" == text_of(page, "label-acts-2-M_3-2")


def test_a_part_of_a_force_that_is_nought_is_not_told_as_the_force() -> None:
    at_pin = graphkin.read("four-bar-coupler-point").to_dict()
    links = list(at_pin["links"])
    pin = at_pin["links"][links[-1]]["points"][-1]
    scene = {**at_pin, "loads": {"Q": {"on": links[-1], "at": pin, "force": 400, "angle": 200}},
             "balance": {"on": at_pin["driver"]["link"]}}
    lines = lines_of(scene)
    nought = {m[1] for line in lines if (m := re.search(r"(\$F[^$]*\$) = 0 k?N$", line))}
    read = {m[1] for line in lines if (m := re.search(r"(\$F[^$]*\$) = [\d.]+ mm × ", line))}
    assert nought
    assert set() == nought & read


@pytest.mark.parametrize(("seed", "drive"), [(40009, "slider"), (40019, "cylinder"), (40028, "crank")])
def test_what_rounding_leaves_of_forces_that_cancel_is_told_as_nought(seed, drive):
    scene = random_scene(seed, ("RPP",), drive, False)
    block = next(name for name, link in scene["links"].items() if "." in link.get("on", "") and link.get("points"))
    scene["loads"] = {"P": {"on": block, "at": scene["links"][block]["points"][0], "force": 31.7, "angle": 175}}
    told = lines_of(scene)
    assert any(line.endswith(" = 0") for line in told)
    assert [] == [line for line in told if "10^{" in line]


@pytest.mark.parametrize(("name", "links", "force"), [
    ("shaper-forces", "5-6", "F_1-6"), ("shaper-forces", "3-4", "F_1-4"), ("boom-lifted", "1-2-3", "F_4-1"),
])
def test_the_sketch_of_a_group_and_its_polygon_stand_on_one_page(name: str, links: str, force: str) -> None:
    pages = [page.content("svg").decode() for page in graphkin.draw(name, figures=["forces"]).figures.values()]
    (page,) = (page for page in pages if f'id="free-body-{links}"' in page)
    assert re.search(f'class="vector[^"]*" id="{force}', page)


def test_readings_of_forces_stand_on_the_page_that_has_room_for_their_three_columns() -> None:
    assert ["forces"] == [*graphkin.draw("engine-gas-force", figures=["forces"]).figures]
