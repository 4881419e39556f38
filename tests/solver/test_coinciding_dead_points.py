"""Two groups at their dead points together: what each gives is within the bound, however near."""

import cmath
import math

import mpmath
import pytest

import graphkin

SPEED, PUSH = 7, 3


def chain(distance, side=-1):
    """A block that drives a rod to a vertical guide, and another rod from there to a horizontal one: at 30 mm both are
    square to their guides."""
    guides = {
        "x": {"through": [0, 0], "angle": 0},
        "v": {"through": [80, 0], "angle": 90},
        "w": {"through": [0, 40 * side], "angle": 0},
    }
    return {
        "frame": {"guides": guides},
        "links": {
            "1": {"points": ["P"], "on": "0.x"},
            "2": {"points": ["P", "Q"], "length": 50},
            "3": {"points": ["Q"], "on": "0.v"},
            "4": {"points": ["Q", "R"], "length": 40},
            "5": {"points": ["R"], "on": "0.w"},
        },
        "driver": {
            "slide": "1", "from": "dead point", "travel": distance, "near": 30, "velocity": SPEED, "acceleration": PUSH,
        },
        "sketch": {"Q": [80, 30 * side], "R": [115, 40 * side]},
    }


def exact(distance):
    """Q's and R's coordinates along their guides, and their rates, in 60 digits."""
    with mpmath.workdps(60):
        d = 50 - mpmath.mpf(repr(distance))
        y = -mpmath.sqrt(2500 - d * d)
        v = d * SPEED / y
        a = (d * PUSH - SPEED**2 - v * v) / y
        h = y + 40
        w = mpmath.sqrt(1600 - h * h)
        s = -h * v / w
        return y, v, a, 80 + w, s, (-v * v - h * a - s * s) / w


@pytest.mark.parametrize("distance", [1e-2, 1e-6, 1e-9, 1e-12, 1e-14, 1e-16, 1e-18, 1e-20, 1e-24])
def test_a_group_that_hangs_on_one_beside_its_dead_point_knows_the_bound_of_it(distance):
    solved = graphkin.solve(chain(distance))
    assert "ok" == solved.motion.status[0]
    bound = [float(b[0]) * 1e3 for b in solved.motion.bound.of_point]
    found = [solved[n][0] for n in ("Q", "v_Q", "a_Q", "R", "v_R", "a_R")]
    along = [z.imag for z in found[:3]] + [z.real for z in found[3:]]
    for value, got, allowed in zip(exact(distance), along, bound * 2, strict=True):
        with mpmath.workdps(60):
            assert abs(mpmath.mpf(float(got)) - value) <= allowed


def test_a_sketch_tells_assemblies_apart_that_lie_close_together_beside_a_dead_point():
    for side in (1, -1):
        assert side * graphkin.solve(chain(1e-20, side))["Q"][0].imag > 0


def tongs(cells, angle):
    """Lazy tongs of bars of 60 mm, crossed in their middles, whose first bar turns about L0; and their points."""
    bar = cmath.rect(30, math.radians(angle))
    points = {}
    for i in range(cells + 1):
        foot = 2 * i * bar.real
        points |= {f"L{i}": foot, f"M{i}": foot + bar, f"U{i}": foot + 2j * bar.imag}
    links = {}
    for i in range(cells):
        for low, high in ((f"L{i}", f"U{i + 1}"), (f"U{i}", f"L{i + 1}")):
            links[f"{len(links) + 1}"] = {"points": [low, f"M{i}"], "length": 30, "at": {high: [60, 0]}}
    links[f"{len(links) + 1}"] = {"points": ["U0"], "on": "0.v"}
    moving = {p: [complex(z).real, complex(z).imag] for p, z in points.items() if p not in ("L0", f"M{cells}")}
    return points, {
        "frame": {"points": {"L0": [0, 0]}, "guides": {"v": {"through": [0, 0], "angle": 90}}},
        "links": links,
        "driver": {"link": "1", "angle": angle, "omega": 2},
        "sketch": moving,
    }


@pytest.mark.parametrize("cells", [1, 2, 4])
@pytest.mark.parametrize("at", [-0.001, -20, 200])
def test_lazy_tongs_move_on_through_the_position_in_which_they_lie_flat(cells, at):
    _, scene = tongs(cells, 40)
    points, _ = tongs(cells, at)
    [position] = graphkin.solve(scene, at=at).data["positions"]
    places = {key: complex(*point["position"]) for key, point in position["points"].items()}
    assert {key: points[key.split("@")[0]] for key in places} == pytest.approx(places, abs=1e-9)
    assert graphkin.check(scene, at=at).ok


@pytest.mark.parametrize("at", [181, 200, -20, 560])
def test_coupled_parallelograms_pass_the_position_in_line_together(at):
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0], "F": [220, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["D", "C"], "length": 40},
            "4": {"points": ["C", "E"], "length": 120},
            "5": {"points": ["F", "E"], "length": 40},
        },
        "driver": {"link": "1", "angle": 60, "omega": 7},
        "sketch": {"C": [120, 35], "E": [240, 35]},
    }
    [position] = graphkin.solve(scene, at=at).data["positions"]
    assert [7] * 3 == pytest.approx([position["links"][name]["omega"] for name in "135"])


@pytest.mark.parametrize("travel", [40, -1e-3, -88])
def test_an_arm_moves_on_as_its_cylinder_passes_through_no_length(travel):
    scene = {
        "frame": {"points": {"A": [0, 0], "C": [80, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 80}, "2": {"points": ["B"], "on": "3"}, "3": {"points": ["C"]},
        },
        "driver": {"slide": "2", "travel": 60, "velocity": 10},
        "sketch": {"B": [60, 50]},
    }
    [position] = graphkin.solve(scene, at=travel).data["positions"]
    # the cylinder is a chord of the circle about A, on which C lies
    angle = 2 * math.asin(travel / 160)
    assert (angle, 10 / 80 / math.cos(angle / 2)) == pytest.approx(
        (position["links"]["1"]["angle"], position["links"]["1"]["omega"])
    )


def test_a_parallelogram_goes_on_turning_beside_a_kite_that_closes_after_two_turns():
    # the pin C passes through K in the position in which the last parallelogram is in line; lengths as programs round
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [69.2820323027551, 39.99999999999999], "K": [29.28203230275509, 40],
                             "G": [149.2820323027551, 39.99999999999999]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40.00000000000001},
            "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["D", "C"], "length": 40.00000000000001},
            "4": {"points": ["C", "E"], "length": 90},
            "5": {"points": ["K", "E"], "length": 89.99999999999999},
            "6": {"points": ["C", "F"], "length": 80},
            "7": {"points": ["G", "F"], "length": 39.99999999999999},
        },
        "driver": {"link": "1", "angle": 20, "omega": 3},
        "sketch": {"C": [107, 54], "E": [52, 124], "F": [187, 54]},
    }
    turn = graphkin.sweep(scene, positions=7, find=["omega_7"])
    assert [3] * 7 == pytest.approx(list(turn["omega_7"]))
    assert 2 == turn.data["driver"]["turns_to_close"]


def test_a_kite_whose_pins_meet_goes_on_over_several_turns_too():
    # C passes through K at 313.604 degrees, in the crossed position of B and C
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0], "K": [100, 40]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "C"], "length": 100},
            "3": {"points": ["D", "C"], "length": 40},
            "4": {"points": ["C", "E"], "length": 90},
            "5": {"points": ["K", "E"], "length": 90},
        },
        "driver": {"link": "1", "angle": 75, "omega": 1},
        "sketch": {"C": [79, -34], "E": [168, -19]},
    }
    turn = graphkin.sweep(scene, positions=360, find=["omega_4", "omega_5"])
    # it turns evenly where the pins meet, at 238.6 degrees from the start
    assert turn["omega_4"][238] == pytest.approx(turn["omega_4"][239], abs=0.05)
    assert turn["omega_5"][238] == pytest.approx(turn["omega_5"][239], abs=0.05)
