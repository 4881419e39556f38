"""``graphkin cam``: what is found of cams, their points, figures and files."""

from __future__ import annotations

import cmath
import io
import json
import math
import re
from dataclasses import replace

import numpy as np
import pytest
import shapely

import graphkin
from graphkin.checking.closed_form import compare_cam
from graphkin.construction import cam_sheet as cam_module
from graphkin.construction.board.steps import Curve
from graphkin.construction.cam_sheet import cam_sheet
from graphkin.drawing.box import Box
from graphkin.drawing.figures.constructions import cam_pictures
from graphkin.drawing.ink.primitives import Line, Polyline, Text, walk
from graphkin.drawing.text import text_box
from graphkin.errors import CallError, Disagreement
from graphkin.scene import mechanism_of
from graphkin.solver.cams import cam_at, cam_with, study_cam
from tests.command import run
from tests.solver.test_cams import LIBRARY, random_cam


@pytest.mark.quick
@pytest.mark.parametrize("seed", range(6))
def test_extremes_are_those_of_many_positions(seed):
    cam = mechanism_of(random_cam(seed)).cams[0]
    study, at = study_cam(cam), cam_at(cam, np.linspace(0, math.tau, 8001)[:-1])
    rising, falling = at.slope > 1e-9, at.slope < -1e-9
    assert study.rise.value == pytest.approx(at.pressure[rising].max(), abs=5e-3)
    assert study.rise.value >= at.pressure[rising].max() - 1e-13
    assert study.fall.value >= at.pressure[falling].max() - 1e-13
    assert abs(study.velocity.value) == pytest.approx(np.abs(at.slope).max(), rel=5e-3)
    convex = at.radius if cam.flat else at.radius[at.radius + cam.roller > 0]
    assert study.radius.value == pytest.approx(convex.min(), abs=3e-4)


@pytest.mark.parametrize("seed", range(6))
def test_the_cam_drawn_by_inversion_is_the_computed_one(seed):
    (cam,) = mechanism_of(random_cam(seed)).cams
    assert compare_cam(cam, cam_sheet(cam, 1e-3)).ok


@pytest.mark.parametrize(("ground", "bar", "base", "begins"), [
    (106.7, 256.94, 150.24, 0.0), (80, 120, 40, 0.0), (100, 52.3, 152.3, math.pi),
])
def test_a_swinging_follower_may_begin_in_line_with_the_axis_of_its_cam(ground, bar, base, begins):
    scene = graphkin.read("cam-swinging-roller").replace("cams.1.base", {"r": base, "of": "pitch"})
    scene = scene.replace("frame.points.C", [ground, 0]).replace("links.2.length", bar)
    (cam,) = mechanism_of(scene).cams
    assert cam.beginning() == begins
    assert compare_cam(cam, cam_sheet(cam, 1e-3)).ok


@pytest.mark.parametrize("angle", [40.1, 126, -168.72])
def test_the_offset_of_a_follower_may_be_the_radius_of_the_base_circle(angle):
    through = 11.2j * cmath.exp(1j * math.radians(angle))
    scene = graphkin.read("cam-offset-roller").replace("cams.1.base", {"r": 11.2, "of": "pitch"})
    guide = {"through": [through.real, through.imag], "angle": angle}
    (cam,) = mechanism_of(scene.replace("cams.1.offset", None).replace("frame.guides.g", guide)).cams
    assert cam.beginning() == 0.0
    assert compare_cam(cam, cam_sheet(cam, 1e-3)).ok


def test_a_roller_that_is_too_large_is_told_with_the_largest_that_would_do():
    scene = graphkin.read("cam-offset-roller").replace("cams.1.base", {"r": 41, "of": "pitch"})
    found = graphkin.cam(scene.replace("cams.1.roller", 40.5))
    one = found["1"]
    assert not found.ok
    assert len(one.study.undercut) == 1
    (said,) = [text for text in one.sentences("en") if "undercut" in text]
    most = float(re.search(r"at most ([\d.]+) mm", said)[1])
    held = graphkin.cam(scene.replace("cams.1.roller", most))
    assert () == held["1"].study.undercut


def test_the_nearest_base_circle_keeps_the_allowed_pressure_angle():
    scene = graphkin.read("cam-offset-roller").replace("cams.1.allow.fall", 25)
    one = graphkin.cam(scene)["1"]
    assert (True, False) == one.study.judged
    better = scene.replace("cams.1.base.r", one.wanted_base * 1e3)
    assert 25 == pytest.approx(math.degrees(graphkin.cam(better)["1"].study.fall.value), abs=1e-4)


def test_the_nearest_base_circle_as_it_is_told_keeps_the_allowed_pressure_angles():
    # to six figures it was rounded to the nearest, with which the rise exceeded its 14 degrees
    scene = graphkin.read("cam-offset-roller").replace("cams.1.allow", {"rise": 14, "fall": 60})
    (said,) = [text for text in graphkin.cam(scene)["1"].sentences("en") if "nearest base" in text]
    better = scene.replace("cams.1.base.r", float(re.search(r"r = ([\d.]+) mm", said)[1]))
    assert graphkin.cam(better)["1"].study.ok


def test_velocity_and_acceleration_that_jump_are_told():
    law = [{"to": 120, "rise": 24, "by": "uniform"}, {"to": 360, "fall": 24, "by": "harmonic"}]
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", law)
    assert [0, 120] == [round(math.degrees(jump.degree)) for jump in graphkin.cam(scene)["1"].study.impacts]


def test_where_the_velocity_jumps_no_jump_of_the_acceleration_is_told():
    law = [{"to": 120, "rise": 24, "by": "uniform"}, {"to": 360, "fall": 24, "by": "harmonic"}]
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", law)
    assert () == graphkin.cam(scene)["1"].study.soft_impacts


HALF = [{"to": 180, "rise": 24, "by": ""}, {"to": 360, "fall": 24, "by": ""}]
"""Rise and fall of 24 mm, each in half a turn."""
ALONE = [{"to": 30}, {"to": 150, "rise": 24, "by": ""}, {"to": 200}, {"to": 320, "fall": 24, "by": ""}, {"to": 360}]
"""The same in 120 degrees each, between dwells."""


def with_law(pieces, by, **changed):
    law = [{**piece, "by": by} if "by" in piece else piece for piece in pieces]
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", law)
    for key, value in changed.items():
        scene = scene.replace(key.replace("_", "."), value)
    return graphkin.cam(scene)["1"]


@pytest.mark.quick
@pytest.mark.parametrize(
    ("pieces", "by", "impacts", "soft"),
    [
        (ALONE, "uniform", [30, 150, 200, 320], []),
        (ALONE, "parabolic", [], [30, 90, 150, 200, 260, 320]),
        (ALONE, "harmonic", [], [30, 150, 200, 320]),
        *((pieces, by, [], []) for pieces in (ALONE, HALF) for by in ("cycloidal", "345", "4567")),
        (HALF, "uniform", [0, 180], []),
        (HALF, "parabolic", [], [90, 270]),
        (HALF, "harmonic", [], []),
    ],
)
def test_every_law_jumps_where_textbooks_say_and_nowhere_else(pieces, by, impacts, soft):
    said = with_law(pieces, by).sentences("en")
    jumps = {word: [float(re.search(r"φ = ([-\d.]+)", s)[1]) for s in said if f"{word} jumps" in s]
             for word in ("velocity", "acceleration")}
    assert {"velocity": impacts, "acceleration": soft} == jumps


@pytest.mark.quick
@pytest.mark.parametrize(
    ("by", "velocity", "at", "acceleration", "bent"),
    [
        ("uniform", 1, 30, 0, 0),
        ("parabolic", 2, 90, 4, 30),
        ("harmonic", math.pi / 2, 90, math.pi**2 / 2, 30),
        ("cycloidal", 2, 90, math.tau, 60),
        ("345", 1.875, 90, 10 / math.sqrt(3), 30 + 120 * (0.5 - math.sqrt(1 / 12))),
        ("4567", 2.1875, 90, 84 / 25 * math.sqrt(5), 30 + 120 * (0.5 - math.sqrt(1 / 20))),
    ],
)
def test_the_greatest_velocity_and_acceleration_are_those_of_the_law_at_its_own_angle(
    by, velocity, at, acceleration, bent
):
    study, wide = with_law(ALONE, by).study, math.radians(120)
    assert (0.024 * velocity / wide, at) == pytest.approx((study.velocity.value, math.degrees(study.velocity.degree)))
    assert (0.024 * acceleration / wide**2, bent) == pytest.approx(
        (study.acceleration.value, math.degrees(study.acceleration.degree))
    )


@pytest.mark.parametrize("by", ["harmonic", "4567"])
def test_the_chords_of_a_short_steep_rise_are_seen_neither_in_the_diagram_nor_in_the_profile(by):
    made = with_law([{"to": 30, "rise": 24, "by": ""}, {"to": 360, "fall": 24, "by": ""}], by)
    page, _ = cam_pictures(made.mechanism, made.cam, made.sheet, "en")
    (shape,) = (part for part in walk(page.children) if getattr(part, "id", "") == "displacement")
    (diagram,) = (np.array(part.points) for part in shape.children if isinstance(part, Polyline))
    high = np.ptp(diagram.imag)
    middle = (diagram[1:] + diagram[:-1]) / 2
    degree = math.tau * (middle.real - diagram.real.min()) / np.ptp(diagram.real)
    lift = np.array([made.cam.law.at(float(at)).lift for at in degree]) / 0.024
    assert np.abs(diagram.imag.max() - high * lift - middle.imag).max() < 0.03
    (_, profile) = (stroke.curve for step in made.sheet.steps for stroke in step.strokes if isinstance(stroke, Curve))
    drawn = shapely.LineString([(z.real, z.imag) for z in profile])
    exact = cam_at(made.cam, np.linspace(0, math.radians(30), 300)[1:-1]).profile / made.sheet.scales.length
    assert max(drawn.distance(shapely.Point(z.real, z.imag)) for z in exact) < 0.05


@pytest.mark.parametrize(("omega", "velocity"), [(10, "152.789 mm/s"), (-10, "−152.789 mm/s")])
def test_the_velocity_has_the_sign_with_which_the_lift_changes(omega, velocity):
    said = with_law(HALF, "cycloidal", driver_omega=omega).sentences("en")
    assert f"greatest velocity: {velocity} at φ = 90°" in said


@pytest.mark.parametrize(("omega", "told"), [
    (10, "the cam turns counter-clockwise"), (0, "the cam turns counter-clockwise"),
    (-10, "φ grows counter-clockwise, against the rotation of the cam"),
])
def test_a_cam_is_not_said_to_turn_with_its_degrees_where_its_driver_turns_it_back(omega, told):
    scene = graphkin.read("cam-flat-face").to_dict()
    scene["driver"] = {"link": "1", "angle": 0, "omega": omega}
    figure = graphkin.draw(scene, figures=["cam"]).figures["cam"]
    assert any(text.string.endswith("; " + told) for text in walk(figure.children) if isinstance(text, Text))


def test_a_cam_whose_speed_changes_has_its_rates_by_the_angle():
    said = with_law(HALF, "harmonic", driver_alpha=4).sentences("en")
    assert "greatest velocity: 12 mm/rad at φ = 90°" in said  # half the rise


def test_beside_impacts_the_greatest_acceleration_is_not_called_the_greatest():
    said = with_law(ALONE, "uniform").sentences("en")
    assert "greatest acceleration beside the impacts: 0 mm/s² at φ = 0°" in said
    assert not [s for s in said if s.startswith("greatest acceleration:")]


@pytest.mark.parametrize(("roller", "corner"), [(8, False), (None, True)])
def test_a_velocity_that_jumps_makes_a_corner_under_a_knife_edge_only(roller, corner):
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", [{**p, "by": "uniform"} for p in HALF])
    if roller is None:
        made = scene.to_dict()
        del made["cams"]["1"]["roller"]
        scene = made
    said = [s for s in graphkin.cam(scene).sentences("en") if "velocity jumps" in s]
    assert (2, 2 * corner) == (len(said), sum("a corner" in s for s in said))


@pytest.mark.quick
def test_the_table_has_a_row_a_degree_with_the_heads_of_the_contract(tmp_path):
    graphkin.draw("cam-offset-roller", out=tmp_path, figures=["cam"])
    lines = (tmp_path / "cam.csv").read_text().splitlines()
    assert "cam,angle_deg,lift,pitch_x,pitch_y,profile_x,profile_y,pressure_deg" == lines[0]
    assert 361 == len(lines)
    rows = np.array([[float(x) for x in line.split(",")] for line in lines[1:]])
    assert rows[:, 1].tolist() == list(range(360))
    pitch, profile = rows[:, 3] + 1j * rows[:, 4], rows[:, 5] + 1j * rows[:, 6]
    assert np.full(360, 9.0) == pytest.approx(np.abs(pitch - profile), abs=1e-9)


def test_a_flat_face_has_no_pitch_curve_in_the_table():
    table = graphkin.cam("cam-flat-face").table
    assert np.isnan(table["pitch_x"]).all()
    assert ",,," in table.csv().splitlines()[1] or ",," in table.csv().splitlines()[1]


@pytest.mark.parametrize("name", LIBRARY)
def test_the_profile_for_the_mill_keeps_within_a_millionth_of_a_millimetre(name):
    one = graphkin.cam(name)["1"]
    ezdxf = pytest.importorskip("ezdxf")
    document = ezdxf.read(io.StringIO(one.profile_dxf().decode()))
    (curve,) = document.modelspace().query("LWPOLYLINE")
    assert curve.closed
    vertices = [(complex(x, y), bulge) for x, y, bulge in curve.get_points("xyb")]
    ends = [z for z, _ in vertices[1:]] + [vertices[0][0]]
    points = cam_at(one.cam, np.linspace(0, math.tau, 1000)).profile * 1e3
    off = np.full(len(points), np.inf)
    for (p, bulge), q in zip(vertices, ends, strict=True):
        chord = q - p
        near = np.abs(points - (p + q) / 2) <= abs(chord) * 0.75 + 1e-9
        if abs(chord) < 1e-12 or not near.any():
            continue
        if abs(bulge) < 1e-12:
            far = np.abs(((points[near] - p) * np.conj(chord)).imag) / abs(chord)
        else:
            centre = (p + q) / 2 + 1j * chord * (1 - bulge**2) / (4 * bulge)
            far = np.abs(np.abs(points[near] - centre) - abs(p - centre))
        off[near] = np.minimum(off[near], far)
    assert off.max() < 1e-6


@pytest.mark.parametrize("language", ["en", "zh", "both"])
def test_the_figure_names_every_division(language):
    found = graphkin.cam("cam-offset-roller", language=language)
    svg = found.figures["cam"].content("svg").decode()
    assert all(f'id="label-division-{k}"' in svg for k in range(18))
    assert 'id="cam-1"' in svg


def test_the_command_writes_its_files_and_says_what_it_found(tmp_path):
    done = run("cam", "cam-swinging-roller", "-o", str(tmp_path), "--format", "svg,dxf", "--step", "0.5")
    assert 0 == done.returncode
    assert {"cam.svg", "cam.dxf", "cam.csv", "profile-1.dxf"} == {path.name for path in tmp_path.iterdir()}
    assert 721 == len((tmp_path / "cam.csv").read_text().splitlines())
    assert "greatest pressure angle of the rise: 28.8087°" in done.stdout


def test_a_flat_face_has_no_greatest_pressure_angle_but_none_at_all():
    said = [str(phrase) for phrase in graphkin.cam("cam-flat-face").made[0].phrases()]
    assert ["the pressure angle is 0° all the time"] == [sentence for sentence in said if "pressure" in sentence]


def test_the_command_s_json_has_each_cam(tmp_path):
    done = run("cam", "cam-flat-face", "--json", "-o", str(tmp_path))
    data = json.loads(done.stdout)
    assert (True, 20) == (data["ok"], pytest.approx(data["cams"]["1"]["rise"]))


def test_a_scene_without_a_cam_is_told_so():
    with pytest.raises(CallError, match="has no cam"):
        graphkin.cam("shaper-scheme-2")


EXERCISE = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"g": {"through": "A", "angle": 90}}},
    "links": {
        "1": {"points": ["A", "O"], "length": 11.5, "discs": {"k": {"centre": "O", "r": 16.5}}},
        "2": {"points": ["B"], "on": "0.g", "discs": {"w": {"centre": "B", "r": 5}}},
    },
    "contacts": {"K": {"between": ["1.k", "2.w"]}},
    "driver": {"link": "1", "angle": 0, "omega": 10},
}


def test_an_eccentric_disc_is_measured_as_the_cam_that_it_is():
    disc = graphkin.cam(EXERCISE).data["discs"]["K"]
    assert (10, 5) == pytest.approx((disc["base"]["pitch"], disc["base"]["profile"]), abs=1e-12)
    assert (23, 0) == pytest.approx((disc["rise"], disc["offset"]), abs=1e-12)
    assert math.asin(11.5 / 21.5) == pytest.approx(disc["pressure"]["greatest"], rel=1e-12)
    assert 0 == pytest.approx(math.sin(disc["pressure"]["at"]), abs=1e-7)


def test_a_disc_under_a_flat_rocker_has_no_pressure_angle():
    disc = graphkin.cam("cam-eccentric-flat-rocker").data["discs"]["K"]
    assert 28 == pytest.approx(disc["base"]["profile"])
    assert 0 == disc["pressure"]["greatest"]
    assert "the pressure angle is 0° all the time" in graphkin.cam("cam-eccentric-flat-rocker").sentences("en")


def test_the_points_of_a_disc_are_written_in_its_own_axes_over_a_turn_of_the_driver(tmp_path):
    found = graphkin.cam(EXERCISE, out=tmp_path, formats=["svg", "dxf"])
    assert {"cam.csv", "profile-1.dxf"} == {path.name for path in tmp_path.iterdir()}
    table = found.table
    profile, pitch = (table[f"{name}_x"] + 1j * table[f"{name}_y"] for name in ("profile", "pitch"))
    assert np.full(360, 16.5) == pytest.approx(np.abs(profile - 11.5), abs=1e-9)
    assert np.full(360, 21.5) == pytest.approx(np.abs(pitch - 11.5), abs=1e-9)
    assert (0, 11.5 + 21.5 - 10, 0) == pytest.approx((table["lift"][270], table["lift"][90], table["pressure_deg"][90]))
    above = 90 - table["angle_deg"]  # of the follower's point in the axes of the cam
    assert np.abs(pitch) * np.exp(1j * np.radians(above)) == pytest.approx(pitch, abs=1e-9)
    assert (10 + table["lift"]) == pytest.approx(np.abs(pitch), abs=1e-9)
    leaning = np.degrees(np.abs(np.angle((pitch - profile) / pitch)))
    assert leaning == pytest.approx(table["pressure_deg"], abs=1e-6)


@pytest.mark.parametrize("name", ["disc-on-disc", "cam-eccentric-flat-rocker", "cam-eccentric-flat-slider"])
def test_the_command_writes_the_points_of_a_disc_and_says_so(name, tmp_path):
    done = run("cam", name, "-o", str(tmp_path))
    assert (0, True) == (done.returncode, "its points over a turn stand in cam.csv" in done.stdout)
    rows = np.genfromtxt(tmp_path / "cam.csv", delimiter=",", names=True)
    assert (360, True) == (len(rows), rows["lift"].min() > -1e-12)
    assert graphkin.cam(name).data["discs"]["K"]["rise"] == pytest.approx(
        np.ptp(rows["lift"]) * (1 if "slider" in name else math.pi / 180), rel=1e-3
    )


def test_the_offset_of_a_flat_follower_is_the_distance_of_its_guide_from_the_axis():
    beside = graphkin.read("cam-eccentric-flat-slider").replace("frame.guides.g.through", [7, 3])
    assert 7 == pytest.approx(graphkin.cam(beside).data["discs"]["K"]["offset"], abs=1e-12)


@pytest.mark.parametrize("name", ["cam-offset-roller", "cam-flat-face", "cam-swinging-roller"])
@pytest.mark.parametrize("part", ["point", "way", "lift"])
@pytest.mark.parametrize("draw", [graphkin.draw, graphkin.cam], ids=["draw", "cam"])
def test_a_cam_drawn_off_by_a_tenth_of_a_degree_or_a_thousandth_is_not_written(draw, part, name, monkeypatch, tmp_path):
    drawn = cam_module.division

    def off(*given):
        made = drawn(*given)
        value = getattr(made, part)
        return replace(made, **{part: value * (cmath.rect(1.0, math.radians(0.1)) if part != "lift" else 1.001)})

    monkeypatch.setattr(cam_module, "division", off)
    with pytest.raises(Disagreement, match=r"cams\.1: its drawing by inversion is off the computed cam"):
        draw(name).write(tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_a_face_on_a_profile_that_turns_back_is_told_the_base_circle_from_which_it_touches_it():
    law = [{"to": 60, "rise": 28, "by": "harmonic"}, {"to": 120, "fall": 28, "by": "harmonic"}, {"to": 360}]
    steep = graphkin.read("cam-flat-face").replace("cams.1.law", law).replace("cams.1.base.r", 30)
    (made,) = graphkin.cam(steep).made
    least = 28 / 2 * (180 / 60) ** 2 - 28  # base + lift + second derivative at the top of a harmonic rise
    (told,) = re.findall(r"turns back on itself.* from r = ([\d.]+) mm on", "\n".join(made.sentences("en")))
    assert pytest.approx(least, abs=1e-3) == float(told)


def test_a_cam_that_only_dwells_has_no_pressure_angle():
    (made,) = graphkin.cam(graphkin.read("cam-flat-face").replace("cams.1.law", [{"to": 360}])).made
    assert "pressure" not in "\n".join(made.sentences("en"))


def test_an_undercut_across_a_seam_of_the_law_is_one_stretch():
    scene = graphkin.read("cam-offset-roller").to_dict()
    law = [{"to": 60, "rise": 40, "by": "harmonic"}, {"to": 120, "fall": 40, "by": "harmonic"}, {"to": 360}]
    scene["cams"]["1"] |= {"roller": 60, "base": {"r": 62, "of": "pitch"}, "law": law}
    ((begin, end),) = graphkin.cam(scene).data["cams"]["1"]["undercut"]
    assert begin < 60 < end


@pytest.mark.parametrize(("base", "stretches"), [(98.0, 0), (97.9, 1)])
def test_a_flat_faced_cam_on_its_limit_circle_does_not_turn_back(base, stretches):
    # harmonic rise of 28 in 60 degrees: the radius at its end is base + 28 - 14 * 9
    law = [{"to": 60, "rise": 28, "by": "harmonic"}, {"to": 180}, {"to": 330, "fall": 28, "by": "345"}, {"to": 360}]
    scene = graphkin.read("cam-flat-face").to_dict()
    scene["cams"]["1"] |= {"base": {"r": base}, "law": law}
    assert stretches == len(graphkin.cam(scene).data["cams"]["1"]["undercut"])


def crosses_itself(cam) -> bool:
    """Whether the profile of a cam crosses itself: a polygon of its points."""
    parts = ((part, np.linspace(part.start, part.end, 400)) for part in cam.law.parts)
    places = np.concatenate([cam_with(cam, degree, part.at(degree, np)).profile for part, degree in parts])
    apart = np.abs(np.diff(places, prepend=places[-1])) > 1e-10
    return not shapely.LinearRing(np.column_stack([places.real, places.imag])[apart]).is_simple


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(
    ("name", "tip", "undercut"),
    [("cam-flat-face", {"flat": True}, True), ("cam-offset-roller", {"roller": 4}, True),
     ("cam-swinging-roller", {"roller": 4}, True), ("cam-offset-roller", {}, False),
     # the bar has swung past the line of the pivots: a drop of its velocity is a hollow
     ("cam-swinging-roller", {"roller": 4, "base": {"r": 160}}, False)],
    ids=["face", "roller", "swinging roller", "edge", "beyond the pivots"],
)
def test_a_profile_is_undercut_where_the_velocity_drops_under_a_face_or_a_roller(name, tip, undercut, sense):
    scene = graphkin.read(name).to_dict()
    law = [{"to": 30}, {"to": 120, "rise": 20, "by": "uniform"}, {"to": 180}, {"to": 350, "fall": 20, "by": "345"}]
    plain = {key: value for key, value in scene["cams"]["1"].items() if key not in ("roller", "flat", "allow")}
    scene["cams"]["1"] = plain | {"base": {"r": 60}} | tip | {"sense": sense, "law": [*law, {"to": 360}]}
    (made,) = graphkin.cam(scene).made
    assert undercut == crosses_itself(made.cam)
    assert ([[120, 120]] if undercut else []) == made.data["undercut"]
    told = [said for said in made.sentences("en") if said.startswith("at φ = 120° the velocity drops, and the profile")]
    assert undercut == bool(told)
    assert (not undercut, None) == (made.ok, made.wanted_base)


@pytest.mark.parametrize(("roller", "stretches"), [(12, 2), (6, 0)])
def test_a_profile_that_the_roller_cuts_away_from_another_flank_is_undercut(roller, stretches):
    law = [{"to": 40, "rise": 100, "by": "345"}, {"to": 70, "rise": 20, "by": "345"},
           {"to": 110, "fall": 120, "by": "345"}, {"to": 360}]
    scene = graphkin.read("cam-offset-roller").to_dict()
    scene["frame"]["guides"] = {"g": {"through": "A", "angle": 90}}
    scene["cams"]["1"] = {"follower": "2", "law": law, "base": {"r": 14, "of": "pitch"}, "roller": roller}
    (made,) = graphkin.cam(scene).made
    assert (stretches, stretches > 0) == (len(made.study.undercut), crosses_itself(made.cam))
    assert stretches == "\n".join(made.sentences("en")).count("the roller cuts it away from other angles of the cam")


def test_degrees_of_a_law_are_those_of_the_file():
    law = [{"to": 110, "rise": 24, "by": "uniform"}, {"to": 120}, {"to": 220, "fall": 24, "by": "parabolic"}]
    scene = graphkin.read("cam-offset-roller").replace("cams.1.law", [*law, {"to": 360}])
    data = graphkin.cam(scene).data["cams"]["1"]
    assert [0, 110, 120, 170, 220] == [jump["degree"] for jump in data["jumps"]]
    assert {0, 110, 120, 170, 220} <= {division["degree"] for division in data["divisions"]}
    assert 120 == data["acceleration"]["degree"]


def test_the_angle_of_a_piece_that_is_too_narrow_for_it_stands_below_the_marks_of_its_ends():
    law = [{"to": 100.123, "rise": 20, "by": "345"}, {"to": 112.456}, {"to": 124.789, "fall": 5, "by": "345"},
           {"to": 300, "fall": 15, "by": "345"}, {"to": 360}]
    things = list(walk(graphkin.cam(graphkin.read("cam-flat-face").replace("cams.1.law", law)).figures["cam"].children))
    angles = [text_box(t) for t in things if isinstance(t, Text) and "cell" in t.classes
              and re.match(r"[\d.]+°", "".join(run.text for run in t.runs))]
    marks = [Box.around((line.start, line.end)) for line in things if isinstance(line, Line)
             and (line.end - line.start) == pytest.approx(2.8j)]
    assert (4, 10) == (len(angles), len(marks))
    assert not [1 for angle in angles for other in (*angles, *marks) if angle is not other and angle.overlaps(other)]


def test_a_flat_face_square_to_a_slanting_line_has_no_pressure_angle():
    slanting = graphkin.read("cam-flat-face").replace("frame.guides.g.angle", 10.2)
    assert {"value": 0.0, "degree": 0.0} == graphkin.cam(slanting).data["cams"]["1"]["pressure"]["rise"]


LATE_FALL = [{"to": 239.4, "rise": 11.43, "by": "cycloidal"}, {"to": 240.1}, {"to": 267.6, "fall": 11.43, "by": "4567"}]
SLOW = [{"to": 150, "rise": 6, "by": "345"}, {"to": 180}, {"to": 340, "fall": 6, "by": "345"}]


@pytest.mark.parametrize(
    ("pivot", "bar", "law", "base", "allow", "sketch"),
    [([115.5, -8.0], 90.5, LATE_FALL, 30, (30, 25), [60, -80]),
     ([70, 0], 115, SLOW, 60, (56, 55.4), [30, 40])],  # the base circle goes round the pivot
)
def test_a_base_circle_between_others_that_do_not_do_is_found_for_a_swinging_follower(
    pivot, bar, law, base, allow, sketch
):
    made = graphkin.cam({
        "frame": {"points": {"A": [0, 0], "C": pivot}},
        "links": {"1": {"points": ["A"]}, "2": {"points": ["C", "B"], "length": bar}},
        "cams": {"1": {"follower": "2", "law": [*law, {"to": 360}], "sense": -1, "base": {"r": base},
                       "allow": {"rise": allow[0], "fall": allow[1]}}},
        "sketch": {"B": sketch}, "driver": {"link": "1", "angle": 0, "omega": 1},
    })["1"]
    assert made.wanted_base is not None
    kept = [study_cam(replace(made.cam, base=made.wanted_base * share)).ok for share in (0.99, 1 + 1e-6, 1.1)]
    assert [False, True, False] == kept
