"""Mechanisms of other programs: the files say one crank-rocker and one slider-crank, and all of them move alike."""

from __future__ import annotations

import io
import json
import math
import zipfile
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import graphkin
from graphkin.api.converted import convert
from graphkin.api.solved import Solved
from graphkin.errors import CallError
from graphkin.exchange import Bodies, read_bodies

from ..command import run

pytestmark = pytest.mark.quick

# a crank-rocker A B C D with the coupler point E, drawn by hand at a crank of 60 degrees
A, D, B = 0j, 400 + 0j, 150 * np.exp(1j * math.pi / 3)
C = complex(470.0, 300.0)
E = complex(260.0, 330.0)
PLACES = {"A": A, "B": B, "C": C, "D": D, "E": E}
RATES = {"omega_3": 1.0}
DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"


def in_base_64(value: float) -> str:
    """A number as PMKS+ writes it: thousandths, the minus sign is a leading 0."""
    whole, text = abs(round(value * 1000)), ""
    while whole or not text:
        whole, digit = divmod(whole, 64)
        text = DIGITS[digit] + text
    return f"0{text}" if value < 0 and text != "0" else text


def address(joints: list[str], links: list[str], flags: int = 0) -> str:
    head = f"{DIGITS[flags >> 6 & 63]}{DIGITS[flags & 63]}.Fe,{in_base_64(5)}.{in_base_64(0.02)},0.1011"
    return f"https://app.pmksplus.com/?{head}.{'.'.join(joints)}..{'.'.join(links)}...N_0"


def shared_joint(name: str, flags: int, place: complex, more: str = "0") -> str:
    return f"{DIGITS[flags]}{name},{name},{in_base_64(place.real)},{in_base_64(place.imag)},{more}"


def shared_link(points: str, kind: str = "R") -> str:
    return f"Y{kind}{points},{points},0,0,0,0,c5cae9,{','.join(points)},,"


PMKS_PLUS = address(
    [shared_joint("A", 6, A), shared_joint("B", 0, B), shared_joint("C", 0, C), shared_joint("D", 4, D),
     shared_joint("E", 16, E)],
    [shared_link("AB"), shared_link("BCE"), shared_link("CD")],
)
TABLE = f"""link ids, type, x, y
ground,input R {A.real} {A.imag}
input,coupler R {float(B.real)!r} {float(B.imag)!r}
coupler,rocker R {C.real} {C.imag}
ground,rocker R {D.real} {D.imag}
coupler R {E.real} {E.imag}
"""
LINKAGE = f"""<linkage2>
\t<program zoom="1.0" units="Millimeters" scalefactor="1"/>
\t<connector id="0" name="A" layer="4" x="0" y="0" anchor="true" input="true" rpm="{60 / math.tau!r}"/>
\t<connector id="1" name="B" layer="4" x="{float(B.real)!r}" y="{float(B.imag)!r}"/>
\t<connector id="2" name="C" layer="4" x="470" y="300"/>
\t<connector id="3" name="D" layer="4" x="400" y="0" anchor="true"/>
\t<connector id="4" name="E" layer="4" x="260" y="330" draw="true"/>
\t<connector id="5" name="F" layer="4" x="1" y="1"/>
\t<element id="0" layer="4"><connector id="0"/><connector id="1"/></element>
\t<element id="1" layer="4" solid="true"><connector id="1"/><connector id="2"/><connector id="4"/></element>
\t<element id="2" layer="4"><connector id="2"/><connector id="3"/></element>
</linkage2>
"""
PYSLVS = f"""pyslvs_ver: '21.12.0'
mechanism: "M[J[R, color[green], P[0, 0], L[ground, crank]], # the pivot
 J[R, color[(1, 2, 3)], P[{float(B.real)!r}, {float(B.imag)!r}], L[crank, coupler]],
 J[R, P[470.0, 300.0], L[coupler, rocker]], J[R, P[400.0, 0.0], L[ground, rocker]], J[R, P[260, 330], L[coupler]]]"
input:
- base: 0
  drive: 1
"""
PYLINKAGE = {
    "name": "crank-rocker",
    "joints": [
        {"id": "A", "type": "ground", "position": [0.0, 0.0]},
        {"id": "B", "type": "revolute", "position": [B.real, B.imag]},
        {"id": "C", "type": "revolute", "position": [C.real, C.imag]},
        {"id": "D", "type": "ground", "position": [400.0, 0.0]},
        {"id": "E", "type": "tracker", "position": [E.real, E.imag], "ref_joint1_id": "B", "ref_joint2_id": "C",
         "distance": 1.0, "angle": 0.0},
    ],
    "links": [
        {"id": "ground", "type": "ground", "joints": ["A", "D"]},
        {"id": "crank", "type": "driver", "joints": ["A", "B"], "motor_joint": "A", "angular_velocity": 1.0,
         "initial_angle": 1.0},
        {"id": "coupler", "type": "link", "joints": ["B", "C"]},
        {"id": "rocker", "type": "link", "joints": ["C", "D"]},
    ],
    "ground": "ground",
}
OLDER = {
    "name": "crank-rocker",
    "joints": [
        {"type": "Static", "name": "A", "x": 0.0, "y": 0.0},
        {"type": "Static", "name": "D", "x": 400.0, "y": 0.0},
        {"type": "Crank", "name": "B", "x": B.real, "y": B.imag, "joint0": {"ref": "A"}, "distance": 150.0,
         "angle": 1.0},
        {"type": "Revolute", "name": "C", "x": C.real, "y": C.imag, "joint0": "B", "joint1": "D",
         "distance0": abs(C - B), "distance1": abs(C - D)},
        {"type": "Fixed", "name": "E", "joint0": "B", "joint1": "C", "distance": abs(E - B),
         "angle": float(np.angle((E - B) / (C - B)))},
    ],
}
GEOGEBRA = """<?xml version="1.0"?><geogebra format="5.0"><construction title="">
{points}
<command name="Circle"><input a0="A" a1="150"/><output a0="c"/></command>
<command name="Point"><input a0="c"/><output a0="B"/></command>
<command name="Circle"><input a0="B" a1="r"/><output a0="d"/></command>
<command name="Circle"><input a0="D" a1="s"/><output a0="e"/></command>
<command name="Intersect"><input a0="d" a1="e" a2="1"/><output a0="C"/></command>
<command name="Segment"><input a0="A" a1="B"/><output a0="f"/></command>
<command name="Segment"><input a0="B" a1="C"/><output a0="g"/></command>
<command name="Circle"><input a0="B" a1="t"/><output a0="h"/></command>
<command name="Circle"><input a0="C" a1="u"/><output a0="k"/></command>
<command name="Intersect"><input a0="h" a1="k"/><output a0="E"/></command>
<command name="Bezier"><input a0="A"/><output a0="q"/></command>
</construction></geogebra>"""


def coordinates(name: str, place: complex) -> str:
    at = f'x="{2 * place.real!r}" y="{2 * place.imag!r}" z="2"'
    return f'<element type="point" label="{name}"><coords {at}/></element>'


def geogebra() -> bytes:
    packed = io.BytesIO()
    text = GEOGEBRA.format(points="\n".join(coordinates(n, complex(z)) for n, z in PLACES.items()))
    with zipfile.ZipFile(packed, "w") as archive:
        archive.writestr("geogebra.xml", text)
    return packed.getvalue()


FILES: dict[str, str | bytes] = {
    "a.txt": PMKS_PLUS, "b.csv": TABLE, "c.linkage2": LINKAGE, "d.pyslvs": PYSLVS, "e.json": json.dumps(PYLINKAGE),
    "f.json": json.dumps(OLDER), "g.ggb": geogebra(),
}
LEFT = {"c.linkage2": ("connector F (no link has it)",), "g.ggb": ("Bezier q",)}
RATE = {"a.txt": math.tau / 3}


@pytest.fixture(params=FILES)
def file(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    content, path = FILES[request.param], tmp_path / request.param
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return path


@pytest.fixture(scope="module")
def turned() -> dict[str, np.ndarray]:
    """Where the coupler point goes, and how fast the rocker turns, at the same mechanism written as a scene."""
    local = (E - B) / ((C - B) / abs(C - B))
    scene = {
        "frame": {"name": "0", "points": {"A": [0, 0], "D": [400, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 150},
            "2": {"points": ["B", "C"], "length": abs(C - B), "at": {"E": [local.real, local.imag]}},
            "3": {"points": ["C", "D"], "length": abs(C - D)},
        },
        "driver": {"link": "1", "angle": 60, "omega": 1},
        "sketch": {"C": [470, 300]},
    }
    found = graphkin.solve(scene, sweep=24)
    return {"E": found["E"], "omega": found["omega_3"]}


def points_of(scene: graphkin.Scene) -> list[str]:
    """The points of a crank-rocker in the order A, B, C, D, E, whatever a program calls them."""
    places = {p: complex(*xy) for p, xy in scene.frame.points.items()}
    solved = graphkin.solve(scene)
    for name in {p for link in scene.links.values() for p in (*link.points, *link.at)} - set(places):
        places[name] = complex(solved[name][0])
    scale = 1 / max(abs(z) for z in PLACES.values())
    return [min(places, key=lambda p: abs(places[p] - z) * scale) for z in PLACES.values()]


def test_every_point_lies_where_the_file_has_it(file: Path) -> None:
    scene = convert(file).scene
    solved = graphkin.solve(scene)
    found = [complex(solved[p][0]) if p not in scene.frame.points else complex(*scene.frame.points[p])
             for p in points_of(scene)]
    close = 1e-3 if file.name == "a.txt" else 1e-9
    assert [pytest.approx(z, abs=close) for z in PLACES.values()] == found


def test_the_mechanism_moves_as_there(file: Path, turned: dict[str, np.ndarray]) -> None:
    scene = convert(file).scene
    solved = graphkin.solve(scene, sweep=24)
    ends = set(points_of(scene)[2:4])
    rocker = next(name for name, link in scene.links.items() if ends == set(link.points))
    close = 1e-4 if file.name == "a.txt" else 1e-9
    assert turned["E"] == pytest.approx(solved[points_of(scene)[4]], abs=close * 1000)
    assert turned["omega"] * RATE.get(file.name, 1.0) == pytest.approx(solved[f"omega_{rocker}"], abs=close)


def test_what_is_not_carried_over_is_named(file: Path) -> None:
    assert LEFT.get(file.name, ()) == (*map(str, convert(file).left),)


def moving(solved: Solved) -> list[complex]:
    """Where the points lie that move and are no ends of slots, from left to right, in mm to a millionth."""
    scene = solved.motion.scene
    names = [p for p in scene.holders if p not in scene.frame.points and not p.startswith("Slot")]
    places = {complex(*np.round([z.real, z.imag], 6)) for z in (solved[p][0] * scene.units.metres * 1e3 for p in names)}
    return sorted(places, key=lambda z: (round(z.real, 3), z.imag))


@pytest.mark.parametrize("ending", [".linkage2", ".pyslvs", ".json"])
@pytest.mark.parametrize("name", ["fourbar-150-500-300-400", "four-bar-coupler-point", "sixbar-coupler-1A"])
def test_a_scene_comes_back_from_another_program(name: str, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"there{ending}"
    convert(name, out=path, lossy=True)
    back = convert(path).scene
    there, here = graphkin.solve(name), graphkin.solve(back)
    assert moving(there) == pytest.approx(moving(here), abs=1e-6)
    assert here.data["mobility"] == there.data["mobility"]


@pytest.mark.parametrize("ending", [".linkage2", ".pyslvs"])
@pytest.mark.parametrize("name", ["whitworth", "slotter-75-150"])
def test_the_slot_of_a_moving_link_lies_in_it_as_before(name: str, ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"there{ending}"
    convert(name, out=path, lossy=True)
    assert moving(graphkin.solve(name)) == pytest.approx(moving(graphkin.solve(convert(path).scene)), abs=1e-6)


SLIDER = address(
    [shared_joint("A", 6, 0j), shared_joint("B", 0, 3 + 4j), shared_joint("C", 0, 15 + 1j),
     shared_joint("D", 21, 15 + 1j, in_base_64(0))],
    [shared_link("AB"), shared_link("BC"), shared_link("CD", "P")],
)
SLOT = address(
    [shared_joint("A", 6, 0j), shared_joint("B", 0, 3 + 4j), shared_joint("C", 4, 10 + 0j),
     shared_joint("D", 0, -4 + 8j), shared_joint("P", 17, 3 + 4j, "0,CD,C,D")],
    [shared_link("AB"), shared_link("CD"), shared_link("BP", "P")],
)
RAM = address(
    [shared_joint("O", 4, 0j), shared_joint("C", 0, 4j), shared_joint("G", 4, 3 + 0j), shared_joint("N", 0, 2 + 1.5j),
     shared_joint("P", 8, 1.5 + 2j), shared_joint("S", 51, 1.5 + 2j, "0,GN,G,N")],
    [shared_link("OC"), shared_link("GN"), shared_link("PC"), shared_link("PS", "P")],
)


@pytest.mark.parametrize(("shared", "kinds"), [(SLIDER, ["RRP"]), (SLOT, ["RPR"]), (RAM, ["RPR"])])
def test_slides_slots_and_cylinders_of_pmks_are_sliding_pairs(shared: str, kinds: list[str]) -> None:
    solved = graphkin.solve(convert(shared).scene)
    assert (1, "ok") == (solved.data["mobility"], solved.data["positions"][0]["status"])
    assert len(solved.data["positions"][0]["slides"]) == 1
    assert kinds == [g["kind"] for g in solved.data["groups"]] or solved.data["groups"][0]["class"] == 2


SLIDER_IN_ITS_RECORD = address(
    [shared_joint("A", 6, 0j), shared_joint("B", 0, 3 + 4j), shared_joint("C", 5, 15 + 1j, "0,,,,,0")],
    [shared_link("AB"), shared_link("BC")],
)


def test_a_slider_of_pmks_that_no_block_names_is_refused_by_name():
    with pytest.raises(CallError, match=r"slider C \(no block has it\): would be lost"):
        convert(SLIDER_IN_ITS_RECORD)


def test_a_link_of_pmks_with_a_check_sum_is_refused():
    with pytest.raises(CallError, match="with a check sum after the"):
        convert(f"{PMKS_PLUS}*1x1bjb")


def test_a_number_of_400_digits_in_a_link_of_pmks_is_refused():
    with pytest.raises(CallError, match=r'"1111.*" is no number of PMKS'):
        convert(PMKS_PLUS.replace(in_base_64(C.real), "1" * 400))


def test_a_joint_of_pmks_without_a_name_is_refused():
    with pytest.raises(CallError, match="is no joint of PMKS"):
        convert(PMKS_PLUS.replace("4D,D", "4,"))


def test_a_block_of_pmks_whose_line_has_an_unknown_end_slides_on_nothing():
    with pytest.raises(CallError, match=r"block BP \(it slides on nothing\): would be lost"):
        convert(SLOT.replace("0,CD,C,D", "0,CD,C,Z"))


def test_a_body_is_driven_once_and_a_second_rate_is_named_as_lost():
    bodies = Bodies("", bodies={"1": []})
    bodies.drive("1", 2.0)
    bodies.drive("1", 3.0)
    assert {("1", ""): 2.0} == bodies.drives
    assert ["driver of 1"] == [str(lost) for lost in bodies.lost]


def test_the_driver_of_a_slide_that_is_lost_is_lost_with_it():
    without_cylinder = RAM.replace("c5cae9,G,N", "c5cae9,,N")
    assert ("slide of PC on GN", "driver of PC") == (*map(str, convert(without_cylinder, lossy=True).left),)


@pytest.mark.parametrize("rate", ["NaN", "1e400"])
def test_a_rate_that_is_no_finite_number_is_refused(rate: str, tmp_path: Path):
    crank = json.dumps(OLDER).replace('"angle": 1.0', f'"angle": {rate}')
    (tmp_path / "a.json").write_text(crank)
    with pytest.raises(CallError, match="a finite number is wanted"):
        convert(tmp_path / "a.json")


def test_a_number_of_400_digits_in_a_file_of_pylinkage_is_refused(tmp_path: Path):
    (tmp_path / "a.json").write_text('{"joints": [{"type": "Static", "x": 1%s, "y": 0}]}' % ("0" * 400))
    with pytest.raises(CallError, match="is no mechanism of pylinkage"):
        convert(tmp_path / "a.json")


WHITWORTH = {
    "frame": {"points": {"A": [0, 100], "C": [0, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 150},
        "2": {"points": ["B"], "on": "3"},
        "3": {"points": ["C"], "at": {"D": [300, 0]}},
    },
    "driver": {"link": "1", "angle": 30, "omega": 2},
}
LOADED = WHITWORTH | {
    "masses": {"1": {"at": [0, 0], "mass": 2}},
    "loads": {"P": {"on": "3", "at": "D", "force": 9, "angle": 0}},
}
FOUR_BAR = {
    "frame": {"points": {"A": [0, 0], "D": [100, 0]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B", "C"], "length": 80},
        "3": {"points": ["D", "C"], "length": 70},
        "4": {"points": ["D", "E"], "length": 20},
    },
    "driver": [{"link": "1", "angle": 60, "omega": 2}, {"link": "4", "angle": 10, "omega": 1}],
}
FASTER = WHITWORTH | {"driver": {"link": "1", "angle": 30, "omega": 2, "alpha": 5}}
BY_LAW = WHITWORTH | {"driver": {"link": "1", "time": 0.1, "law": {"from": 0, "to": 90, "duration": 1, "by": "345"}}}


@pytest.mark.parametrize(
    ("scene", "ending", "lost"),
    [
        (FOUR_BAR, ".pyslvs", ["driver of 4"]),
        (FOUR_BAR, ".linkage2", ["driver of 4"]),
        (BY_LAW, ".linkage2", ["law of driver 1"]),
        (FASTER, ".linkage2", ["acceleration of 1"]),
        (WHITWORTH, ".json", ["slide of 1 on 3 (its line moves)"]),
        (LOADED, ".pyslvs", ["mass of 1", "load P"]),
        ("cam-eccentric-flat-rocker", ".linkage2", ["contact K of 1 and 2"]),
    ],
)
def test_what_moves_or_loads_is_only_lost_where_that_is_asked_for(scene, ending: str, lost: list[str], tmp_path: Path):
    with pytest.raises(CallError) as stop:
        convert(scene, out=tmp_path / f"a{ending}")
    assert lost == [str(problem.where) for problem in stop.value.problems]
    assert [] == list(tmp_path.iterdir())
    assert set(lost) <= set(map(str, convert(scene, out=tmp_path / f"a{ending}", lossy=True).left))


def test_what_would_be_lost_is_told_in_the_reader_s_language(tmp_path: Path):
    with pytest.raises(CallError) as stop:
        convert(LOADED, out=tmp_path / "a.pyslvs")
    assert "构件 1 的质量：会丢失；加 --lossy（lossy=True）则略去" == stop.value.text("zh").partition("\n")[0]


def test_the_command_says_what_would_be_lost_and_leaves_it_out_where_it_may(tmp_path: Path):
    out = str(tmp_path / "a.toml")
    answer = run("convert", SLIDER_IN_ITS_RECORD, "-o", out)
    assert (2, []) == (answer.returncode, list(tmp_path.iterdir()))
    assert "slider C (no block has it): would be lost; with --lossy (lossy=True) it is left out" in answer.stderr


def test_a_slider_of_pyslvs_keeps_its_angle_and_a_pin_turns_in_its_slot(tmp_path: Path) -> None:
    path = tmp_path / "a.pyslvs"
    path.write_text(
        "M[J[R, P[0, 0], L[ground, 1]], J[R, P[3, 4], L[1, 2]], J[P, A[0], P[15, 1], L[ground, 3]],"
        "J[R, P[15, 1], L[2, 3]], J[RP, A[90], P[3, 4], L[4, 1]], J[R, P[3, -2], L[ground, 4]]]"
    )
    slides = graphkin.solve(convert(path).scene).data["positions"][0]["slides"]
    assert ["3/0", "P4/4"] == list(slides)


def test_a_connector_of_linkage_slides_between_two_anchors(tmp_path: Path) -> None:
    (tmp_path / "a.linkage2").write_text(
        '<linkage2><connector id="0" x="0" y="0" anchor="true" input="true" rpm="30"/><connector id="1" x="3" y="4"/>'
        '<connector id="2" x="15" y="1" slider="true"><slidelimit id="3"/><slidelimit id="4"/></connector>'
        '<connector id="3" x="5" y="1" anchor="true"/><connector id="4" x="25" y="1" anchor="true"/>'
        '<element id="0"><connector id="0"/><connector id="1"/></element>'
        '<element id="1"><connector id="1"/><connector id="2"/></element>'
        '<element id="2"><connector id="3"/><connector id="4"/></element></linkage2>'
    )
    solved = graphkin.solve(convert(tmp_path / "a.linkage2").scene)
    own = solved.data["positions"][0]
    assert {"C2/0": pytest.approx(10.0)} == {k: s["travel"] for k, s in own["slides"].items()}
    assert [pytest.approx(math.pi)] == [k["omega"] for n, k in own["links"].items() if n == "L0"]


@pytest.mark.parametrize(
    ("name", "text", "said"),
    [
        ("a.linkage2", "<linkage2>", "a: is not XML"),
        ("a.linkage2", "<svg/>", "a: begins with <svg>"),
        ("a.linkage2", '<linkage2><connector id="0" x="q"/><element><connector id="0"/></element></linkage2>',
         'connector 0.x: "q"; a number is wanted'),
        ("a.json", "[1]", "a: has no list of joints"),
        ("a.json", '{"joints": [{"type": "Crank"}]}', "a: is no mechanism of pylinkage"),
        ("a.pyslvs", "M[J[R, P[0, 0], L[ground]", "a: a bracket is not closed"),
        ("a.pyslvs", "M[J[Q, P[0, 0], L[ground]]]", 'a: "J[Q, P[0, 0], L[ground]]" is no joint'),
        ("a.csv", "ground,input R 0\n", 'a, row 1: "ground,input R 0" is no joint'),
        ("a.ggb", "PK", "a: is no file of GeoGebra"),
        ("a.dwg", "", 'a.dwg: ".dwg" is of no program known here'),
        ("a.json", '{"joints": [], "links": []}', "a: holds no moving link"),
        ("a.json", "[" * 100_000, "a: is nested too deeply"),
        ("a.json", '{"joints": [{"id": "b"}], "links": []}',
         "a: is no mechanism of pylinkage: joint b has no place; save it anew"),
        ("a.json", '{"joints": [{"type": "Spiral", "name": "C", "joint0": "B"}]}',
         "a: is no mechanism of pylinkage: joint B is not there"),
        ("a.pyslvs", "J[]", "a: holds no expression M[...]"),
        ("a.pyslvs", "M[J[R, P[0, 5], L[]]]", "a: the joint at 0, 5 has no link; write L[ground, link_1]"),
        ("a.pyslvs", "SQLite format 3", "a.pyslvs: is a data base of an early pyslvs"),
        ("a.txt", "input ground R 1e300 0\n", "point A: lies at (1e+300, 0); its coordinates are finite numbers"),
        ("a.txt", "1 2 R 0 0\n2 3 R 1 0\n1 4 P 0 0 0\n2 4 P 0 1 0\n3 4 P 0 2 90\n",
         "link 4: slides on more than two others"),
    ],
)
def test_a_file_that_is_none_is_told_in_a_sentence(name: str, text: str, said: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(text)
    answer = run("convert", str(tmp_path / name))
    assert 2 == answer.returncode
    assert f"graphkin: {said}" in answer.stderr


def test_the_command_writes_the_scene_and_names_what_is_left(tmp_path: Path) -> None:
    (tmp_path / "c.linkage2").write_text(LINKAGE)
    answer = run("convert", str(tmp_path / "c.linkage2"), "-o", str(tmp_path / "scene.toml"))
    assert 0 == answer.returncode
    assert "graphkin: not carried over: connector F (no link has it)\n" == answer.stderr
    chinese = run("convert", str(tmp_path / "c.linkage2"), "--lang", "zh")
    assert "graphkin: 未能转换：连接点 F（不属于任何构件）\n" == chinese.stderr
    assert graphkin.read(tmp_path / "scene.toml") == convert(tmp_path / "c.linkage2").scene


def test_what_runs_on_the_line_of_a_link_of_pylinkage_is_a_pin_in_its_slot(tmp_path: Path) -> None:
    joints = [
        *OLDER["joints"][:4],
        {"type": "Fixed", "name": "F", "joint0": "B", "joint1": "C", "distance": 100.0, "angle": 0.5},
        {"type": "Linear", "name": "S", "joint0": "F", "joint1": "D", "joint2": "C", "x": 435.0, "y": 150.0},
    ]
    (tmp_path / "a.json").write_text(json.dumps({"joints": joints}))
    made = read_bodies(str(tmp_path / "a.json"))
    assert {"0": [*"AD"], "AB": [*"AB"], "BCF": [*"BCF"], "DC": [*"DC"], "FS": [*"FS"]} == made.bodies
    assert {"S": {"of": "FS", "in": "DC.s1"}} == made.scene()["pins"]


@pytest.mark.parametrize("ending", [".linkage2", ".json", ".pyslvs"])
def test_a_pin_in_two_slots_is_not_written_with_the_first_of_them_alone(tmp_path, ending):
    scene = {
        "frame": {"points": {"A": [0, 0]}, "guides": {
            "v": {"through": [100, 0], "angle": 80}, "u": {"through": [0, 20], "angle": 0}}},
        "links": {
            "1": {"points": ["A"]}, "2": {"points": ["P", "Q"], "length": 60}, "3": {"points": ["Q"], "on": "0.u"},
        },
        "pins": {"P": {"of": "2", "in": ["1", "0.v"]}},
        "driver": {"link": "1", "angle": 30, "omega": 2},
    }
    with pytest.raises(CallError, match="slide of 2 on 0: would be lost"):
        convert(scene, out=tmp_path / f"a{ending}")


def save(path: Path, places: dict[str, complex], commands: Sequence[tuple[str, str, str]]) -> None:
    """Write a construction of GeoGebra: its points, and commands with what they are given and what they make."""
    text = "".join(coordinates(*place) for place in places.items())
    for name, *both in commands:
        ends = (" ".join(f'a{k}="{x}"' for k, x in enumerate(some.split())) for some in both)
        text += '<command name="{}"><input {}/><output {}/></command>'.format(name, *ends)
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("geogebra.xml", f"<geogebra><construction>{text}</construction></geogebra>")


MOVED = [("Circle", "A 2", "c"), ("Point", "c", "B"), ("Circle", "B 4.5", "d"), ("Circle", "D 4.1", "e"),
         ("Intersect", "d e", "C")]


@pytest.mark.parametrize(
    ("command", "bodies"),
    [
        (("Polygon", "B C E", "q f g h"), {"0": "AD", "AB": "AB", "BCE": "BCE", "DC": "DC"}),
        (("Polygon", "B C 3", "q f g E h"), {"0": "AD", "AB": "AB", "BCE": "BCE", "DC": "DC"}),
        (("Midpoint", "B C", "E"), {"0": "AD", "AB": "AB", "BCE": "BCE", "DC": "DC"}),
        (("Midpoint", "A D", "E"), {"0": "ADE", "AB": "AB", "BC": "BC", "DC": "DC"}),
        (("Midpoint", "B D", "E"), {"0": "AD", "AB": "AB", "BC": "BC", "DC": "DC"}),
        (("Point", "m", "E"), {"0": "AD", "AB": "AB", "BCE": "BCE", "DC": "DC"}),
        (("Point", "n", "E"), {"0": "AD", "AB": "AB", "BC": "BC", "DC": "DC"}),  # of no body: it slides
    ],
)
def test_corners_midpoints_and_points_on_segments_of_geogebra_are_points_of_the_body_that_holds_them(
    command, bodies, tmp_path: Path
):
    corner = "E" in command[1] and command[0] == "Polygon"
    made = [("Circle", "B 3", "u"), ("Circle", "C 3", "w"), ("Intersect", "u w", "E")] if corner else []
    places = {"A": 0j, "B": 1 + 2j, "C": 5 + 4j, "D": 6 + 0j, "E": 3 + 6j}
    save(tmp_path / "a.ggb", places, [*MOVED, ("Segment", "B C", "m"), ("Line", "B D", "n"), *made, command])
    assert bodies == {name: "".join(points) for name, points in read_bodies(str(tmp_path / "a.ggb")).bodies.items()}


def test_a_point_of_geogebra_that_is_pulled_along_a_fixed_line_drives(tmp_path: Path):
    trammel = [("Segment", "A B", "f"), ("Line", "A D", "g"), ("Point", "f", "C"), ("Circle", "C 5", "c"),
               ("Intersect", "g c", "E"), ("Segment", "C E", "h"), ("Point", "f", "F")]
    save(tmp_path / "a.ggb", {"A": 0j, "B": 9, "D": 9j, "C": 4, "E": 3j, "F": 8}, trammel)
    read = convert(tmp_path / "a.ggb")
    assert ("point F (nothing holds it)",) == tuple(map(str, read.left))
    assert {"slide": "C/0", "travel": 4, "velocity": 1} == read.scene.to_dict()["driver"]
    # of a rod of 5 with C at 4 that goes at 1
    moved = graphkin.solve(read.scene).data["positions"][0]["points"]["E@CE"]
    assert ([0, -4 / 3], [0, -25 / 27]) == (pytest.approx(moved["velocity"]), pytest.approx(moved["acceleration"]))


def test_a_static_joint_of_pylinkage_that_stands_alone_takes_no_other_joint_s_name(tmp_path: Path) -> None:
    crank = {"type": "Crank", "name": "B", "joint0": {"x": 0, "y": 0}, "distance": 2, "angle": 0.3, "x": 1, "y": 2}
    dyad = {"type": "Revolute", "name": "S0", "joint0": "B", "joint1": {"x": 6, "y": 0}, "distance0": 4, "distance1": 4}
    (tmp_path / "a.json").write_text(json.dumps({"joints": [crank, dyad]}))
    made = read_bodies(str(tmp_path / "a.json"))
    assert [["S0", "S2"], ["S0", "B"], ["B", "S0x2"], ["S2", "S0x2"]] == [*made.bodies.values()]


SLIDER = """<linkage2><connector id="0" x="0" y="0" anchor="true" input="true"/><connector id="1" x="30" y="40"/>
<connector id="2" x="100" y="0" slider="true" {radius}>{limits}</connector>
<connector id="3" x="-9" y="0" anchor="true"/>
<connector id="4" x="200" y="0" anchor="true"/><Link id="0"><connector id="0"/><connector id="1"/></Link>
<Link id="1"><connector id="1"/><connector id="2"/></Link><Link id="2"><connector id="3"/><connector id="4"/></Link>
</linkage2>"""


@pytest.mark.parametrize(
    ("radius", "limits", "lost"),
    [
        ("", "3", "slider 2 (it has no two limits)"),
        ('slideradius="50"', "34", "slider 2 (its slot is round)"),
        ("", "31", "slider 2 (its limits lie on two links)"),
        ("", "12", "slider 2 (it is a point of the link that guides it)"),
    ],
)
def test_a_slider_of_linkage_that_no_straight_slot_holds_is_lost_by_name(radius, limits, lost, tmp_path: Path):
    ends = "".join(f'<slidelimit id="{k}"/>' for k in limits)
    (tmp_path / "a.linkage2").write_text(SLIDER.format(radius=radius, limits=ends))
    assert [lost] == [*map(str, read_bodies(str(tmp_path / "a.linkage2")).lost)]


def test_a_driven_cylinder_of_linkage_goes_out_and_in_once_a_cycle(tmp_path: Path) -> None:
    (tmp_path / "a.linkage2").write_text("""<linkage2><connector id="0" x="0" y="0" anchor="true"/>
<connector id="1" x="60" y="0"/><connector id="2" x="60" y="-80" anchor="true"/>
<Link id="0" name="L"><connector id="0"/><connector id="1"/></Link>
<Link id="1" name="Z" actuator="true" throw="30" cpm="10"><connector id="2"/><connector id="1"/></Link></linkage2>""")
    driver = {"slide": "Zr/Zc", "travel": 80, "velocity": pytest.approx(2 * 30 * 10 / 60)}
    assert driver == convert(tmp_path / "a.linkage2").scene.to_dict()["driver"] | driver


PRISMATIC = {
    "joints": [
        {"id": "a", "type": "ground", "position": [0, 0]}, {"id": "b", "type": "revolute", "position": [1, 2]},
        {"id": "c", "type": "prismatic", "position": [5, 0], "line_point": [0, 0], "axis": [1, 0]},
    ],
    "links": [{"id": "l1", "type": "arc_driver", "joints": ["a", "b"], "angular_velocity": 2}],
}


def test_a_prismatic_joint_of_pylinkage_runs_on_its_line_or_is_lost(tmp_path: Path) -> None:
    (tmp_path / "a.json").write_text(json.dumps(PRISMATIC))
    assert ["slide of joint c (no link has it)"] == [*map(str, read_bodies(str(tmp_path / "a.json")).lost)]
    rod = {"id": "l2", "joints": ["b", "c"]}
    (tmp_path / "a.json").write_text(json.dumps(PRISMATIC | {"links": [*PRISMATIC["links"], rod]}))
    made = convert(tmp_path / "a.json")
    assert ("ends of the arc of l1",) == (*map(str, made.left),)
    assert {"C": {"of": "l2", "in": "0.s1"}} == made.scene.to_dict()["pins"]
    assert ["A B", "B C"] == made.table["points"].tolist()


def test_a_joint_of_pylinkage_fixed_to_two_of_the_frame_is_a_point_of_the_frame(tmp_path: Path) -> None:
    joints = [
        {"type": "Static", "name": "A", "x": 0, "y": 0}, {"type": "Static", "name": "D", "x": 6, "y": 0},
        {"type": "Fixed", "name": "F", "joint0": "A", "joint1": "D", "distance": 3, "angle": math.pi / 2},
        {"type": "Crank", "name": "B", "joint0": "A", "distance": 2, "angle": 0.3, "x": 1, "y": 2},
        {"type": "Revolute", "name": "C", "joint0": "B", "joint1": "F", "distance0": 4, "distance1": 4},
    ]
    (tmp_path / "a.json").write_text(json.dumps({"joints": joints}))
    assert [0.0, 3.0] == pytest.approx(convert(tmp_path / "a.json").scene.to_dict()["frame"]["points"]["F"])
