"""A DXF opened again: true to size, real entities on the layers of the SVG, the same bytes every time."""

from __future__ import annotations

import io
import json
import math
import os
import subprocess
import sys
import xml.etree.ElementTree as ET

import pytest

from graphkin import draw, read
from graphkin.drawing import Drawing, Text
from graphkin.drawing.ink.primitives import Arc, Circle, Group, Line, Polygon, Stroke
from graphkin.drawing.ink.strokes import texture
from graphkin.drawing.ink.symbols import circular_slot
from graphkin.drawing.text import rich, width
from graphkin.drawing.write.dxf import arcs_of_profile
from graphkin.errors import CallError
from graphkin.scene import mechanism_of
from tests.notation import noted

SVG = "{http://www.w3.org/2000/svg}"
THIN = Stroke(0.18)


def opened(content: bytes):
    ezdxf = pytest.importorskip("ezdxf")  # here, since it takes a second to load
    return ezdxf.read(io.StringIO(content.decode()))


@pytest.fixture(scope="module")
def velocity():
    drawn = draw("sixbar-guide-40deg", figures=["velocity"])
    figure = drawn.figures["velocity"]
    return drawn, opened(figure.content("dxf")), ET.fromstring(figure.content("svg"))


def test_it_opens_without_a_fault(velocity):
    assert [] == velocity[1].audit().errors


def test_its_unit_is_the_millimetre(velocity):
    from ezdxf.units import MM

    assert MM == velocity[1].units


def test_a_vector_measured_times_the_scale_is_its_value(velocity):
    drawn, document, svg = velocity
    scale = json.loads(svg.find(f"{SVG}metadata").text)["scales"]["velocity"]
    line = next(e for e in document.groups.get("v_B3") if e.dxftype() == "LINE")
    measured = scale * complex(*(line.dxf.end - line.dxf.start).vec2)
    assert drawn["v_B@3"].exact == pytest.approx(measured, rel=1e-5)


def test_its_layers_are_those_of_the_svg(velocity):
    _, document, svg = velocity
    label = "{http://www.inkscape.org/namespaces/inkscape}label"
    layers = {g.get(label) for g in svg.iter(f"{SVG}g") if g.get(label) and len(g)}
    assert layers == {e.dxf.layer for e in document.modelspace()} - {"paper"}


def test_every_primitive_is_an_entity_of_its_kind():
    things = (
        Line(1 + 1j, 4 + 5j, THIN),
        Circle(5 + 5j, 2.0, stroke=THIN),
        Arc(5 + 5j, 3.0, 0.0, 1.0, THIN),
        Polygon((1 + 1j, 2 + 1j, 2 + 2j)),
        Polygon((1 + 1j, 2 + 1j, 2 + 2j, 1 + 2j, 0.5 + 1.5j)),
        Polygon((1 + 1j, 9 + 1j, 9 + 9j), "", THIN),
    )
    space = opened(Drawing(10.0, 10.0, (Group(things, layer="mechanism"),)).content("dxf")).modelspace()
    assert ["LINE", "CIRCLE", "ARC", "SOLID", "HATCH", "LWPOLYLINE"] == [e.dxftype() for e in space]


def test_white_strokes_which_hide_lines_on_paper_are_no_lines_in_cad():
    things = (*circular_slot(9 + 9j, 5.0, 0.0, 1.0), Line(1 + 1j, 4 + 5j, texture(2)))
    space = opened(Drawing(20.0, 20.0, things).content("dxf")).modelspace()
    assert ["ARC"] * 4 == [e.dxftype() for e in space]  # the edges and the round ends of the slot


def test_an_arc_lies_where_it_lies_on_paper():
    arc = Arc(5 + 5j, 3.0, 0.3, 1.2, THIN)
    space = opened(Drawing(10.0, 12.0, (arc,)).content("dxf")).modelspace()
    ends = [complex(*p.vec2) for p in (space[0].start_point, space[0].end_point)]
    on_paper = [arc.at(arc.start), arc.at(arc.end)]
    assert pytest.approx(sorted(on_paper, key=lambda z: z.real)) == sorted(
        (complex(z.real, 12.0 - z.imag) for z in ends), key=lambda z: z.real
    )


def test_a_chinese_text_is_as_long_as_in_the_svg():
    entity = opened(Drawing(60.0, 20.0, (Text(5 + 8j, rich("速度多边形")),), lang="zh").content("dxf")).modelspace()[0]
    assert ("速度多边形", "chinese") == (entity.dxf.text, entity.dxf.style)
    assert width("速度多边形", 3.5) == pytest.approx(entity.dxf.align_point.x - entity.dxf.insert.x)


def test_the_same_drawing_has_the_same_bytes():
    page = Drawing(10.0, 10.0, (Line(1 + 1j, 4 + 5j, Stroke(0.2, (3.0, 1.0))),))
    assert page.content("dxf") == Drawing(10.0, 10.0, page.children).content("dxf")


def test_the_same_drawing_has_the_same_bytes_in_every_process():
    page = "Drawing(9.0, 9.0, (Line(1 + 1j, 4 + 5j, Stroke(0.2)),))"
    code = f"import sys; from graphkin.drawing import *; sys.stdout.buffer.write({page}.content('dxf'))"
    run = [sys.executable, "-c", code]
    seeded = ({**os.environ, "PYTHONHASHSEED": seed} for seed in "04")
    assert 1 == len({subprocess.run(run, env=env, capture_output=True, check=True).stdout for env in seeded})


def test_without_the_extra_it_is_said_how_to_have_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "ezdxf", None)
    with pytest.raises(CallError, match=r"graphkin\[cad\]"):
        Drawing(10.0, 10.0, ()).content("dxf")


def test_letters_as_outlines_are_paths_and_can_still_be_found():
    page = Drawing(30.0, 20.0, (Text(5 + 8j, rich(noted("ram $v_B$")), id="x"),))
    root = ET.fromstring(page.content("svg", text="outlines"))
    group = root.find(f".//{SVG}g[@id='x']")
    path, text = group
    assert (f"{SVG}path", f"{SVG}text", "none") == (path.tag, text.tag, text.get("fill"))
    assert "ramvB" == "".join(span.text for span in text)


def test_letters_as_outlines_need_no_font():
    svg = draw("four-bar-coupler-point", figures=["velocity"]).figures["velocity"].content("svg", text="outlines")
    assert b"@font-face" not in svg


@pytest.mark.parametrize(("name", "most"), [
    ("cam-offset-roller", 1000), ("cam-flat-face", 600), ("cam-swinging-roller", 900),
])
def test_the_profile_of_a_cam_has_no_more_arcs_than_its_bends_need(name: str, most: int) -> None:
    (cam,) = mechanism_of(name).cams
    assert most > len(arcs_of_profile(cam))


@pytest.mark.parametrize(("name", "roller"), [("cam-flat-face", 0.0), ("cam-offset-roller", 9.0)])
def test_where_the_speed_jumps_a_profile_runs_along_the_face_or_around_the_roller(name: str, roller: float) -> None:
    steady = [{"to": 120, "rise": 20, "by": "uniform"}, {"to": 180}, {"to": 300, "fall": 20, "by": "uniform"}]
    scene = read(name).to_dict()
    scene["cams"]["1"]["law"] = [*steady, {"to": 360}]
    (cam,) = mechanism_of(scene).cams
    found = arcs_of_profile(cam)
    (corner, bulge), begin = found[-1], found[0][0]
    if roller:  # of an arc with this bulge
        assert roller == pytest.approx(abs(begin - corner) * (1 + bulge**2) / (4 * abs(bulge)))
    else:  # by the jump of the reduced velocity
        assert (20 / math.radians(120), 0) == pytest.approx((abs(begin - corner), bulge))
