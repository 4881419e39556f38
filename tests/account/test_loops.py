"""Vector loops as lines for terminals and for papers."""

import pytest

import graphkin
from graphkin.account.loops import as_latex
from graphkin.account.notation import as_vector
from graphkin.words.symbols import RichText, sign
from tests.scenes import four_bar

SLOW = graphkin.read("sixbar-420rpm").to_dict()
SLOW = SLOW | {"driver": {"link": "1", "angle": SLOW["driver"]["angle"], "omega": 1e-7}}


def test_a_power_of_ten_is_no_index_for_a_terminal():
    lines = graphkin.solve(SLOW).loops().plain
    assert "ω_2 = −2.027" in lines
    assert "·10⁻⁸ rad/s" in lines
    assert "|  7.07107·10⁻⁹ |" in lines
    assert [] == [sign for sign in ("10_", "$", "{") if sign in lines]


def test_vectors_of_loops_bear_the_mark_of_the_convention_that_is_asked_for():
    loops = graphkin.solve("sixbar-420rpm").loops(convention="russian")
    assert r"\[ \vec{l}_{AB} + \vec{l}_{BC} + \vec{l}_{CD} + \vec{l}_{DA} = 0 \]" == loops.latex.split("\n")[0]


@pytest.mark.parametrize(("latex", "line"), [
    (r"0.34 \cos \theta_{2} - 3\cdot 10^{-7} = 0", "0.34 cos " + sign("θ", "2") + " − 3·10⁻⁷ = 0"),
    (r"150 \sin (\theta_{3} + 20^{\circ})", "150 sin (" + sign("θ", "3") + " + 20°)"),
    (r"\mathbf{l}_{AB} + \vec{s}_{61}",
     as_vector("us", sign("l", "AB")) + " + " + as_vector("russian", sign("s", "61"))),
])
def test_a_line_is_set_in_latex_symbol_by_symbol(latex: str, line: RichText):
    assert latex == as_latex(line)


@pytest.mark.parametrize("scene", ["geared-five-bar", "cam-flat-face"])
def test_where_gears_or_cams_move_links_it_is_not_said_that_nothing_but_the_driver_moves(scene: str):
    said = graphkin.solve(scene).loops().plain
    assert "cams, gears or rolling contacts move what no loop of bars and guides alone gives" == said


def test_a_chosen_loop_goes_along_guides_to_the_pins_on_them() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [0, -150]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B"], "on": "3.s"},
            "3": {"points": ["C"], "guides": {"s": {"through": [0, 20], "angle": 10}}},
        },
        "driver": {"link": "1", "angle": 30, "omega": 5},
        "loops": {"I": ["A", "B", "C"]},
    }
    solved = graphkin.solve(scene)
    (block,), position = solved.loops().data, solved.data["positions"][0]
    link, slide = position["links"]["3"], position["slides"]["2/3"]
    assert [link["omega"], slide["velocity"]] == pytest.approx(block["rates"])
    assert [link["alpha"], slide["acceleration"]] == pytest.approx(block["second_rates"])


@pytest.mark.parametrize(("root", "scene"), [
    ("s_34 = −25 + √(25057.0508) = 133.2942 mm", "slider-crank-offset"),
    ("θ_1 = 2 atan2(B − √(A² + B² − C²), A + C) = 29.79377° with A = −160000, B = 240000, C = −19600",
     "hydraulic-cylinder"),
])
def test_the_root_of_a_loop_stands_in_the_units_of_the_file(root: str, scene: str) -> None:
    assert root in [line.strip() for line in graphkin.solve(scene).loops().plain.split("\n")]


def test_the_rates_of_what_stands_on_two_links_that_turn_alike_are_0() -> None:
    scene = {
        "frame": {"points": {"A": [0, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 100, "guides": {"s": {"through": [0, 40], "angle": 10}}},
            "2": {"points": ["C"], "on": "1.s"},
            "3": {"points": ["A", "C"], "length": 90, "guides": {"g": {"through": [20, 5], "angle": 70}}},
            "4": {"on": "3.g", "guides": {"k": {"through": [0, 10], "angle": 50}}},
            "5": {"points": ["B"], "on": "4.k"},
        },
        "driver": {"link": "1", "angle": 30, "omega": 5},
    }
    loops = graphkin.solve(scene).loops()
    last = loops.data[-1]
    assert [0.0] * 8 == [x for key in ("velocity", "rates", "acceleration", "second_rates") for x in last[key]]
    assert "v_43 = 0 mm/s, v_54 = 0 mm/s" in loops.plain


def test_a_rate_that_is_small_near_a_dead_point_is_more_than_rounding() -> None:
    solution = graphkin.solve(four_bar(60, 100, 60, 100, driver={"link": "1", "angle": 0, "omega": 1}), at=-1e-5)
    links = solution.data["positions"][0]["links"]
    assert pytest.approx([links[n]["alpha"] for n in "23"], rel=0.01) == solution.loops().data[-1]["second_rates"]
