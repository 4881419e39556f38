"""A photograph or scan under the mechanism: where it lies, what is refused, that every writer has it."""

from __future__ import annotations

import json
import re
from io import BytesIO

import numpy as np
import pytest
from PIL import Image

import graphkin
from graphkin.errors import SceneError
from graphkin.scene.scene import mechanism_of

pytestmark = pytest.mark.quick
A, D = (30, 200), (180, 150)


def scene(folder, file="scan.png", points=None, **changes):
    given = graphkin.read("fourbar-150-500-300-400").to_dict() | changes
    points = {"A": list(A), "D": list(D)} if points is None else points
    given["sheet"] = {**given.get("sheet", {}), "background": {"file": str(folder / file), "points": points}}
    return given


@pytest.fixture
def folder(tmp_path):
    picture = Image.new("RGB", (240, 260), (255, 255, 255))
    for x, y in (A, D):
        picture.paste((255, 0, 0), (x - 6, y - 6, x + 7, y + 7))
    picture.save(tmp_path / "scan.png")
    picture.save(tmp_path / "scan.jpg")
    return tmp_path


def test_two_points_lay_the_picture_at_its_scale_and_direction(folder) -> None:
    made = mechanism_of(scene(folder))
    under = made.question.background
    for point, (x, y) in {"A": A, "D": D}.items():
        assert pytest.approx(made.frame.points[point], abs=1e-12) == under.corner + under.step * complex(x, -y)
    assert (240, 260, "image/png") == (under.width, under.height, under.kind)
    assert "scan.png lies under the mechanism" in graphkin.explain(scene(folder)).text
    assert "scan.jpg" in graphkin.explain(scene(folder, "scan.jpg"), language="zh").text


@pytest.mark.parametrize("file", ["scan.png", "scan.jpg"])
def test_the_svg_holds_the_file_and_lays_its_points_on_those_drawn(folder, file) -> None:
    drawn = graphkin.draw(scene(folder, file))
    text = drawn.figures["mechanism"].content("svg").decode()
    place = [float(v) for v in re.search(r'<image[^>]*transform="matrix\(([^)]*)\)"', text)[1].split()]
    a, b, c, d, e, f = place
    for point, (x, y) in {"A": A, "D": D}.items():
        pivot = re.search(rf'id="point-{point}".*?<circle[^>]*?cx="([\d.]+)" cy="([\d.]+)"', text, re.DOTALL)
        assert pytest.approx([float(v) for v in pivot.groups()], abs=2e-3) == [a * x + c * y + e, b * x + d * y + f]
    assert 1 == text.count("<image") == drawn.figures["sheet"].content("svg").decode().count("<image")
    assert "<image" not in drawn.figures["velocity"].content("svg").decode()


def pixels(drawing) -> np.ndarray:
    return np.asarray(Image.open(BytesIO(drawing.content("png", dpi=60))).convert("RGB"), float)


def test_png_and_pdf_show_it_paled_and_dxf_leaves_it_out(folder) -> None:
    drawn, bare = (graphkin.draw(s).figures["mechanism"] for s in (scene(folder), "fourbar-150-500-300-400"))
    red = [int(np.all(np.abs(pixels(d) - (255, 127, 127)) < 12, axis=2).sum()) for d in (drawn, bare)]
    assert red[0] > 20 + 2 * red[1]
    assert (True, False) == (b"/Image" in drawn.content("pdf"), b"/Subtype /Image" in bare.content("pdf"))
    assert bare.content("dxf") == drawn.content("dxf")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"file": "none.png"}, "sheet.background.file: "),
        ({"file": "text.png"}, "text.png is no picture that can be read; a PNG or JPEG is wanted"),
        ({"file": "cut.png"}, "cut.png is damaged; a PNG or JPEG is wanted"),
        ({"file": "scan.gif"}, "scan.gif is no picture that can be read; a PNG or JPEG is wanted"),
        ({"file": "turned.jpg"}, "turned.jpg is stored turned"),
        ({"file": "large.png"}, "large.png is larger than 10 MB; save it smaller"),
        ({"points": {"A": [0, 0]}}, "sheet.background.points: found 1; two points whose pixels"),
        ({"points": {"A": [0, 0], "D": [0, 0]}}, "sheet.background.points: A and D lie at the same place"),
        ({"points": {"A": [0, 0], "C": [9, 0]}}, "sheet.background.points.C: is no point that stays where"),
        ({"points": {"A": [0, 0], "D": [9]}}, "sheet.background.points.D: found [9]; a place is [x, y]"),
    ],
)
def test_what_cannot_lie_under_the_mechanism_is_refused_by_name(folder, change, said) -> None:
    (folder / "text.png").write_text("no picture")
    (folder / "cut.png").write_bytes((folder / "scan.png").read_bytes()[:200])
    Image.new("RGB", (4, 4)).save(folder / "scan.gif")
    turned = Image.Exif()
    turned[0x0112] = 6
    Image.new("RGB", (4, 4)).save(folder / "turned.jpg", exif=turned)
    if change.get("file") == "large.png":
        (folder / "large.png").write_bytes(bytes(10_000_001))
    with pytest.raises(SceneError) as refusal:
        mechanism_of(scene(folder, **change))
    assert any(said in str(p) for p in refusal.value.problems), list(map(str, refusal.value.problems))


def test_the_picture_stands_beside_the_scene_file(folder, monkeypatch) -> None:
    given = scene(folder)
    given["sheet"]["background"]["file"] = str(folder / "scan.png")
    path = graphkin.read(given).save(folder / "own.toml")
    text = path.read_text().replace(json.dumps(str(folder / "scan.png")), '"scan.png"')
    path.write_text(text)
    assert '"scan.png"' in text
    assert "scan.png" == graphkin.read(path).mechanism.question.background.name
