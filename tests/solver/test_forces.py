"""Forces in all pairs: against an independent reference, in equilibrium link by link, in balance of powers."""

from __future__ import annotations

import json
import math
import random
import tomllib
from dataclasses import replace
from pathlib import Path
from unittest.mock import patch

import numpy as np
import pytest

import graphkin
from graphkin.scene import library, mechanism_of
from graphkin.scene.symbol import Symbol
from graphkin.solver import forces as kinetostatics
from graphkin.solver.cams import cam_angle, cam_at
from graphkin.solver.touching import pitch_point
from tests import with_tables
from tests.command import run
from tests.mechanisms import KINDS, random_scene, redriven

VALIDATION = Path(__file__).parent.parent / "validation"
CASES = json.loads((VALIDATION / "truth_forces.json").read_text())["cases"]
PLACES = [(name, at) for name, case in CASES.items() for at in case["positions"]]


def scene_of(name):
    return VALIDATION / CASES[name]["scene"]


def number(value):
    return complex(*value) if isinstance(value, list) else value


@pytest.mark.parametrize(("name", "at"), PLACES)
def test_forces_are_those_of_the_reference(name, at):
    true = CASES[name]["positions"][at]
    here = graphkin.solve(scene_of(name), at=true["driver_deg"]).data["positions"][0]
    found = {**here["forces"], **here["moments"]}
    most = max(abs(number(v)) for v in true["forces"].values())
    for key, exact in {**true["forces"], **true["moments"]}.items():
        mine = number(found[key]) if key in found else -number(found[str(Symbol.parse(key).opposite)])
        assert abs(number(exact) - mine) <= 1e-11 * most, key


def loaded(scene, seed):
    """A scene with masses on all links, weights and loads of every sort."""
    rng = random.Random(seed)
    made = json.loads(json.dumps(scene))
    made["gravity"] = {"g": 9.8, "angle": rng.uniform(-180, 180)}
    links = [name for name, link in made["links"].items() if not link.get("redundant")]
    made["masses"] = {
        name: {"at": [rng.uniform(-50, 50), rng.uniform(-50, 50)], "mass": rng.uniform(0.1, 5),
               "inertia": rng.uniform(0, 0.1)}
        for name in links
    }
    made["loads"] = {
        "A": {"on": rng.choice(links), "at": [10, -5], "force": 300, "angle": 30},
        "B": {"on": rng.choice(links), "at": [0, 20], "force": 200, "follows": rng.choice(links), "angle": -50},
        "C": {"on": rng.choice(links), "moment": -7},
    }
    return made


def shares(mechanism, solved, symbol):
    """The link on which a force or couple of a pair acts, the one that it comes from, and where it acts."""
    motion, letter, first, second = solved.motion, symbol.kind, symbol.link, symbol.other
    point = symbol.of.point if symbol.of else ""
    sliding = next((s for s in mechanism.slidings if (s.a, s.b) == (second, first) and point in ("", s.pin)), None)
    pin = next((p for p in mechanism.slides if (p.of, p.b) == (second, first) and point in ("", p.pin)), None)
    cam = next((c for c in mechanism.cams if (c.link, c.follower) == (first, second)), None)
    gear = next((g for g in mechanism.gears if g.bodies == (first, second)), None)
    if gear is not None:
        return second, first, pitch_point(motion, gear)[0]
    if cam is not None:
        return second, first, cam.axis + cam_at(cam, cam_angle(cam, motion.poses[first].u)).contact
    mesh = next((g for g in mechanism.gears if g.bodies == (first, second)), None)
    if mesh is not None:
        return second, first, pitch_point(motion, mesh)[0]
    touch = next((c for c in mechanism.contacts if c.bodies == (first, second)), None)
    if touch is not None:
        return second, first, motion.position(touch.name)
    common = [p for p, holders in mechanism.holders.items() if {first, second} <= set(holders) and point in ("", p)]
    if sliding is not None and not (letter == "F" and common and point):
        pose = motion.poses[second]
        own = mechanism.by_name[second].points[sliding.pin] if sliding.pin else 0j
        return second, first, pose.z + pose.u * own
    name = pin.pin if pin is not None else common[0]
    return second, first, motion.point(name).z


def residues(scene):
    """What is left of the forces on each link, of the moments about its origin, and of the powers; with the largest."""
    mechanism = mechanism_of(scene)
    solved = graphkin.solve(scene)
    motion, forces = solved.motion, solved.forces
    if not forces.ok.all():
        return None
    sums = {link.name: [0j, 0.0] for link in mechanism.links}
    most, power, powers = 0.0, 0.0, []
    balances = {d.key.split("/")[0] for d in mechanism.drivers}

    def act(link, force, at, moment=0.0, external=True):
        nonlocal power
        if link not in sums:
            return
        pose = motion.poses[link]
        arm = at - pose.z if at is not None else 0j
        sums[link][0] += force
        sums[link][1] += (np.conj(arm) * force).imag + moment
        if external:
            velocity = pose.v + 1j * pose.omega * arm
            powers.append((np.conj(velocity) * force).real + pose.omega * moment)
            power += powers[-1]

    for mass in mechanism.loading.masses:
        centre = motion.poses[mass.link].fixed(mass.at)
        for key in (f"Fi_{mass.link}", f"G_{mass.link}"):
            act(mass.link, forces.value(Symbol.parse(key)), centre.z)
        act(mass.link, 0j, None, forces.value(Symbol.parse(f"Mi_{mass.link}")))
    for load in mechanism.loading.loads:
        pose = motion.poses[load.link]
        if load.is_force:
            act(load.link, forces.value(Symbol.parse(f"P_{load.name}")), pose.z + pose.u * load.at)
        else:
            act(load.link, 0j, None, forces.value(Symbol.parse(f"P_{load.name}")))
    for spring in mechanism.loading.springs:
        for (link, own), sign in zip(spring.ends, (1, -1), strict=True):
            pose = motion.poses[link]
            act(link, sign * forces.value(Symbol.parse(f"P_{spring.name}")), pose.z + pose.u * own)
    for driver in mechanism.drivers:
        angle = driver.turns
        link = driver.key.split("/")[0]
        if angle:
            moment = forces.value(Symbol.parse(f"M_{link}"))
            act(link, 0j, None, moment)
            act(driver.relative_to, 0j, None, -moment)
            continue
        slide = next(s for s in mechanism.slides if s.key == driver.key)
        link, on = slide.bodies
        balances.add(link)
        own = mechanism.by_name[link].points
        foot = own[slide.pin] if slide.pin else 0
        at = motion.poses[link].z + motion.poses[link].u * foot
        act(link, forces.value(Symbol.parse(f"F_{link}")), at)
        act(on, -forces.value(Symbol.parse(f"F_{link}")), at)
    for symbol, value in forces.values.items():
        if not symbol.other:
            continue
        second, first, at = shares(mechanism, solved, symbol)
        for link, sign in ((second, 1), (first, -1)):
            if symbol.kind == "F":
                act(link, sign * value, at, external=False)
            else:
                act(link, 0j, None, sign * value, external=False)
        most = max(most, float(np.abs(value).max()))
    worst = max(max(abs(complex(f[0])) if np.ndim(f) else abs(f), abs(float(np.ravel(m)[0])) / mechanism.size)
                for f, m in sums.values())
    turning = max(abs(float(np.ravel(p)[0])) for p in powers)
    return worst, most, abs(float(np.ravel(power)[0])), turning


@pytest.mark.parametrize("seed", range(10))
def test_every_link_is_in_equilibrium_and_the_powers_balance(seed):
    rng = random.Random(seed)
    drive = rng.choice(("crank", "slider", "cylinder", "slot"))
    scene = loaded(random_scene(seed, tuple(rng.choices(KINDS, k=2)), drive), seed)
    found = residues(scene)
    if found is None:
        pytest.skip("this one stands in a dead point of its balance")
    worst, most, power, largest = found
    assert worst <= 1e-10 * max(most, 1.0)
    assert power <= 1e-9 * max(largest, 1e-3)


@pytest.mark.parametrize("name", [n for n in library() if n not in ("double-butterfly", "single-flier")][::3])
def test_scenes_that_come_along_are_in_equilibrium_under_loads(name):
    if mechanism_of(name).gears or mechanism_of(name).contacts:
        pytest.skip("what acts at teeth and between discs has tests of its own")
    worst, most, power, largest = residues(loaded(graphkin.read(name).to_dict(), 5))
    assert worst <= 1e-10 * most
    assert power <= 1e-9 * largest


@pytest.mark.parametrize("name", with_tables("contacts", "gears"))
def test_what_touches_and_what_rolls_is_in_equilibrium(name):
    worst, most, power, largest = residues(loaded(graphkin.read(name).to_dict(), 7))
    assert worst <= 1e-10 * most
    assert power <= 1e-9 * largest


def test_a_larger_group_is_in_equilibrium():
    worst, most, power, largest = residues(loaded(graphkin.read("double-butterfly").to_dict(), 3))
    assert worst <= 1e-10 * most
    assert power <= 1e-9 * largest


SHAPER = scene_of("shaper-scheme-2")


def test_the_power_balance_holds_over_a_turn():
    solved = graphkin.solve(SHAPER, sweep=72)
    motion, forces = solved.motion, solved.forces
    power = forces.value(Symbol.parse("M_2")) * motion.omega("2")
    for link in ("4", "6"):
        mass = next(m for m in motion.scene.loading.masses if m.link == link)
        velocity = motion.poses[link].fixed(mass.at).v
        for key in (f"Fi_{link}", f"G_{link}"):
            power = power + (np.conj(velocity) * forces.value(Symbol.parse(key))).real
        power = power + motion.omega(link) * forces.value(Symbol.parse(f"Mi_{link}"))
    power = power + (np.conj(motion.point("C").v) * forces.value(Symbol.parse("P_P"))).real
    most = np.abs(forces.value(Symbol.parse("M_2")) * motion.omega("2")).max()
    assert 0 == pytest.approx(np.abs(power).max(), abs=1e-10 * most)
    left, greatest = forces.power
    assert 0 == pytest.approx(np.abs(left).max(), abs=1e-10 * most)
    assert most == pytest.approx(greatest.max(), rel=0.2)


@pytest.mark.parametrize("name", sorted(CASES))
def test_what_a_load_forgotten_leaves_of_the_powers_is_seen(name):
    solved = graphkin.solve(scene_of(name))
    left, greatest = solved.forces.power
    assert 0 == pytest.approx(left[0], abs=1e-12 * greatest[0])
    wrong = replace(solved.forces, acting=solved.forces.acting[:-1])
    assert abs(wrong.power[0][0]) > 1e-4 * greatest[0]


@pytest.mark.parametrize("seed", [12, 102])
def test_a_driver_between_two_moving_links_has_the_power_of_its_moment_or_force_on_both(seed):
    left, greatest = graphkin.solve(loaded(redriven(seed), seed)).forces.power
    assert 0 == pytest.approx(left[0], abs=1e-12 * greatest[0])


@pytest.mark.parametrize("at", [167.3708882, 12.2936947])
def test_both_values_stand_where_the_cut_begins_and_ends(at):
    # the edges lie where the ram has done 0.05 and 0.95 of its stroke
    low, high = sorted(graphkin.solve(SHAPER, at=crank)["s_6/1"][0] for crank in (194.90059668782988, 345.09940331217))
    wanted = high - (high - low) * (0.05 if at > 90 else 0.95)
    for _ in range(60):
        value = graphkin.solve(SHAPER, at=at)
        rate = value["v_C"][0].real / -math.copysign(64 * math.tau / 60, 1)
        at += math.degrees(-(value["s_6/1"][0] - wanted) / -rate)
        if abs(value["s_6/1"][0] - wanted) < 1e-12 * (high - low):
            break
    here = graphkin.solve(SHAPER, at=at).data["positions"][0]
    assert [0.0, 0.0] == here["forces"]["P_P"]
    assert [-9000.0, 0.0] == pytest.approx(here["forces"]["P_P+"], abs=1e-9)
    assert "M_2+" in here["moments"]
    assert "Fi_6+" not in here["forces"]


def test_both_values_stand_where_a_load_begins_by_the_drivers_value():
    scene = graphkin.read(SHAPER).to_dict()
    scene["loads"]["P"] = {"on": "6", "at": "C", "force": 100, "angle": 0, "when": {"driver": [40, 60]}}
    for at, edge in ((40, True), (60, True), (50, False)):
        here = graphkin.solve(scene, at=at).data["positions"][0]["forces"]
        assert edge == ("P_P+" in here)
        assert [0.0 if edge else 100.0, 0.0] == pytest.approx(here["P_P"])


def test_over_a_sweep_both_values_stand_only_where_a_load_begins_or_ends():
    scene = graphkin.read(SHAPER).to_dict()
    scene["loads"]["P"] = {"on": "6", "at": "C", "force": 100, "angle": 0, "when": {"driver": [40, 60]}}
    scene["driver"] |= {"angle": 40}
    turn = graphkin.solve(scene, sweep=36).data["positions"]
    edges = [round(math.degrees(here["driver"]["2"])) % 360 for here in turn if "P_P+" in here["forces"]]
    assert [40, 60] == sorted(edges)


def test_a_load_may_act_while_the_driver_passes_its_own_nought():
    scene = graphkin.read(SHAPER).to_dict()
    scene["loads"]["P"] = {"on": "6", "at": "C", "force": 100, "angle": 0, "when": {"driver": [300, 60]}}
    here = {at: graphkin.solve(scene, at=at).data["positions"][0]["forces"]["P_P"][0] for at in (10, 70, 290, 310)}
    assert {10: 100.0, 70: 0.0, 290: 0.0, 310: 100.0} == pytest.approx(here)


def test_forces_stand_in_the_units_of_the_scene():
    scene = graphkin.read(SHAPER).to_dict()
    other = json.loads(json.dumps(scene)) | {"units": {"force": "kN", "mass": "g"}}
    other["masses"]["4"] |= {"weight": 0.22, "inertia": 1200}
    other["masses"]["6"] |= {"weight": 0.8}
    other["loads"]["P"]["force"] = 9
    one, two = (graphkin.solve(s)["M_2"][0] for s in (scene, other))
    assert one / 1000 == pytest.approx(two, rel=1e-12)


def test_without_gravity_a_weight_gives_its_mass_and_does_not_pull():
    scene = graphkin.read(SHAPER).to_dict()
    del scene["gravity"]
    here = graphkin.solve(scene).data["positions"][0]
    assert "G_6" not in here["forces"]
    acceleration = graphkin.solve(scene)["a_C"][0].real / 1000
    assert -800 / 9.80665 * acceleration == pytest.approx(here["forces"]["Fi_6"][0], rel=1e-12)


def test_a_balancing_force_does_the_work_of_the_balancing_moment():
    scene = graphkin.read(SHAPER).to_dict()
    moment = graphkin.solve(scene)["M_2"][0]
    scene["balance"] = {"on": "2", "at": "A", "angle": "square"}
    force = graphkin.solve(scene)["F_2"][0]
    assert abs(moment) / 0.09 == pytest.approx(abs(force), rel=1e-11)
    angle = graphkin.solve(scene)["theta_2"][0]
    assert 0 == pytest.approx((force * np.exp(-1j * math.radians(angle))).real / abs(force), abs=1e-12)


def test_a_balance_that_does_no_work_is_refused_by_name(tmp_path):
    scene = graphkin.read(SHAPER)
    scene = scene.replace("driver.angle", 194.90059668782988).replace("balance", {"on": "4"})
    path = scene.save(tmp_path / "idle.toml")
    done = run("solve", str(path), "--json")
    assert 3 == done.returncode
    assert "balance does no work" in json.loads(done.stdout)["positions"][0]["why"]


def test_a_cylinder_carries_what_it_lifts():
    # a boom of 100 kg held by an upright cylinder: the cylinder carries its share of the weight by the lever's law
    scene = {
        "units": {"length": "m"},
        "frame": {"name": "0", "points": {"A": [0, 0], "B": [1, -1]}},
        "links": {
            "1": {"points": ["A", "C"], "length": 1.0, "at": {"S": [2, 0]}},
            "2": {"points": ["B"], "on": "3"},
            "3": {"points": ["C"]},
        },
        "driver": {"slide": "2/3", "travel": -1.0, "velocity": 0.0},
        "sketch": {"C": [1, 0]},
        "gravity": {"g": 10},
        "masses": {"1": {"at": "S", "mass": 100}},
    }
    here = graphkin.solve(scene).data["positions"][0]
    assert 2000 == pytest.approx(abs(number(here["forces"]["F_2"])), rel=1e-12)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"masses": {"9": {"at": "S4", "mass": 1}}}, 'there is no link "9"'),
        ({"masses": {"4": {"at": "S9", "mass": 1}}}, "S9 is nowhere placed on link 4"),
        ({"masses": {"4": {"at": "S4"}}}, "neither mass nor weight"),
        ({"masses": {"1": {"at": "O2", "mass": 1}}}, "is the frame"),
        ({"masses": {"4": {"at": "S4", "mass": -1}}}, "found -1"),
        ({"loads": {"P": {"on": "6", "at": "C", "force": 9}}}, "loads.P.angle: is missing"),
        ({"loads": {"P": {"on": "6", "force": 9, "angle": 0}}}, "loads.P.at: is missing"),
        ({"loads": {"P": {"on": "6", "at": "C", "force": 9, "against": "6/2"}}}, "no sliding pair"),
        ({"loads": {"P": {"on": "6", "moment": 9, "angle": 0}}}, "neither place nor direction"),
        ({"loads": {"P": {"on": "6", "moment": 9, "when": {"stroke": "6/1", "sense": 2}}}}, "1 along the guide"),
        ({"balance": {"on": "2", "at": "A"}}, "balance.angle: is missing"),
        ({"masses": {"4": {"at": "S4", "mass": 0}}}, "a zero mass; a mass must be positive"),
        ({"gravity": {"g": -9.8}}, "a negative gravity; a gravity must be positive"),
        ({"flywheel": {"on": "2", "delta": 2.5}}, "a part of the mean speed"),
        ({"flywheel": {"on": "1", "delta": 0.1}}, "link 1 is the frame"),
        ({"loads": {"P": {"on": "6", "moment": 9, "when": {"driver": [1]}}}}, "two values of the driver"),
        ({"loads": {"P": {"on": "6", "moment": 9, "when": {"driver": [40, 40]}}}}, "two different values"),
        ({"loads": {"P": {"on": "6", "moment": 9, "when": {"driver": [0, 800]}}}}, "at most a turn"),
        ({"loads": {"P": {"on": "6", "moment": 9, "when": {"driver": [0, 80], "sense": -1}}}}, "beside driver"),
    ],
)
def test_what_is_wrong_with_masses_and_loads_is_told_by_name(change, said):
    with pytest.raises(graphkin.SceneError, match=said):
        graphkin.read({**graphkin.read(SHAPER).to_dict(), **change})


def test_a_scene_with_loads_is_written_as_it_is_read():
    mechanism = mechanism_of(SHAPER)
    from graphkin.scene.scene import as_mapping

    again = mechanism_of(as_mapping(mechanism))
    assert mechanism.loading.loads == again.loading.loads
    for one, two in zip(mechanism.loading.masses, again.loading.masses, strict=True):
        assert one.mass == pytest.approx(two.mass, rel=1e-12)


def test_bounds_hold_what_a_solution_in_other_axes_differs_by():
    scene = graphkin.read(SHAPER).to_dict()
    moved = json.loads(json.dumps(scene))
    for place in moved["frame"]["points"].values():
        place[0] += 12345.678
    moved["frame"]["guides"]["ram"]["through"][0] += 12345.678
    one, two = graphkin.solve(scene), graphkin.solve(moved)
    bound = one.forces.bound[0][0] + two.forces.bound[0][0]
    assert abs(one["F_4/3"][0] - two["F_4/3"][0]) <= bound < 1e-6 * abs(one["F_4/3"][0])


def test_masses_and_loads_are_told_in_words():
    told = graphkin.explain(SHAPER).data["loads"]
    assert "link 4 has 22.449 kg, 1.2 kg m2 about its centre of mass, which lies at (290, 0) in its own axes" == told[0]
    stroke = "from 0.05 to 0.95 of the stroke of 6/1 against the guide's sense"
    assert f"load P: a force of 9000 N on link 6 at C, against the sliding of 6/1, {stroke}" in told
    assert "a moment M_2 on link 2 keeps the balance" == told[-1]


def test_a_pair_that_no_load_passes_through_has_no_force_at_all():
    # the four-bar is loaded at its rocker: without weights the dyad that hangs on it carries just nothing
    scene = {
        "frame": {"points": {"A": [0, 0], "D": [100, 0], "G": [150, 90]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 40},
            "2": {"points": ["B", "C"], "length": 80},
            "3": {"points": ["C", "D"], "length": 70},
            "4": {"points": ["C", "E"], "length": 60},
            "5": {"points": ["E", "G"], "length": 60},
        },
        "sketch": {"C": [70, 60], "E": [120, 120]},
        "driver": {"link": "1", "angle": 50, "omega": 10},
        "loads": {"push": {"on": "3", "at": "C", "force": 1000, "angle": 200}},
    }
    forces = graphkin.solve(scene).data["positions"][0]["forces"]
    nothing = sorted(name for name, force in forces.items() if force == [0.0, 0.0])
    assert ["F_0/5", "F_2/4", "F_4/5"] == nothing


PIN_OF = tomllib.loads("""
gravity = {}
frame = { points = { A = [0, 0], C = [300, 50] } }
links.4 = { points = ["A", "H"], length = 80 }
links.2 = { points = ["C", "D"], length = 150 }
links.3 = { points = ["D", "E"], length = 200, guides = { g = { centre = [100, 50], r = 250 } } }
links.1 = { points = ["A", "B"], length = 100 }
driver = [{ link = "1", angle = 60, omega = 10, alpha = 0 }, { link = "2", angle = 100, omega = -3, alpha = 0 },
          { link = "4", angle = 200, omega = 5, alpha = 0 }]
masses.1 = { at = [50, 10], mass = 1 }
masses.3 = { at = [100, 20], mass = 2, inertia = 0.01 }
masses.4 = { at = [30, 5], mass = 0.7 }
""")


@pytest.mark.parametrize("of", ["1", "4"])
def test_the_link_of_a_pin_bears_the_force_of_a_circular_slot(of):
    here = graphkin.solve({**PIN_OF, "pins": {"A": {"of": of, "in": "3.g"}}}).data["positions"][0]
    forces = {name: number(value) for name, value in here["forces"].items()}
    # of the slot: radial, so that its moment about D holds weight, inertia and couple of link 3
    turned = here["links"]["3"]["angle"]
    axis = complex(math.cos(turned), math.sin(turned))
    hinge, pin = number(here["points"]["D@3"]["position"]) / 1000, 0j
    radial = pin - (hinge + (0.1 + 0.05j) * axis)
    arm = pin - hinge
    mass = (0.1 + 0.02j) * axis
    known = (mass.conjugate() * (forces["Fi_3"] + forces["G_3"])).imag + here["moments"]["Mi_3"]
    on_slot = radial * -known / (arm.conjugate() * radial).imag
    # what bears: the link of the pin alone, on its hinge of the frame
    for link in ("1", "4"):
        bears = on_slot if link == of else 0
        expected = bears - forces[f"Fi_{link}"] - forces[f"G_{link}"]
        assert expected == pytest.approx(forces[f"F_0/{link}"], abs=1e-9 * abs(on_slot))


def settled_values(motion, name, values):
    """What a quantity is settled to if it has these values."""
    found = []
    for value in values:
        with patch.object(kinetostatics, "value_of", lambda *_, value=value: np.full(1, value)):
            found += kinetostatics.settled_value(motion, Symbol.parse(name)).tolist()
    return found


@pytest.mark.parametrize(("name", "which"), [("F_5/6", 0), ("M_6/1", 1)])
def test_a_force_is_0_below_the_bound_of_forces_and_a_moment_below_that_of_moments(name, which):
    solved = graphkin.solve("shaper-forces")
    below, above = (part * float(solved.forces.bound[which][0]) for part in (0.9, 1.1))
    assert [0.0, above] == settled_values(solved.motion, name, (below, above))


@pytest.mark.parametrize(("name", "ends"), [("v_C/B", 2), ("C", 1), ("omega_4", 1)])
def test_a_velocity_seen_from_a_point_is_0_below_the_errors_of_both_and_a_place_below_its_alone(name, ends):
    motion = graphkin.solve("shaper-forces").motion
    bound = float(motion.bound.of(Symbol.parse(name).measure)[0])
    below, above = (part * ends * bound for part in (0.9, 1.1))
    assert [0.0, above] == settled_values(motion, name, (below, above))
