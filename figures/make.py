"""Redraw the gallery: each folder holds a scene, or a design file, and the figures drawn from it; ``examples`` Python
and its pictures.

    python figures/make.py            all of them
    python figures/make.py NAME ...   some of them, folders or examples

The tests redraw all of them too; any difference from what is committed fails.
"""

from __future__ import annotations

import io
import runpy
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent

POLYGONS = ("mechanism", "velocity", "acceleration")
GALLERY: dict[str, tuple[str, ...]] = {
    # each dyad, its polygons
    "four-bar": POLYGONS,  # RRR, with a coupler point by image
    "slider-crank": POLYGONS,  # RRP, US letters
    "rotating-guide": POLYGONS,  # RPR with Coriolis, British letters
    "scotch-yoke": POLYGONS,  # RPP, Russian letters
    "elliptic-trammel": POLYGONS,  # RRP with a driven slide
    "swinging-block": POLYGONS,
    "oldham": POLYGONS,  # a block on two guides
    "hydraulic-cylinder": POLYGONS,
    "eccentric-cam": POLYGONS,  # a pin in an offset slot
    # whole problems, one sheet each
    "two-coriolis": ("velocity", "acceleration", "sheet"),  # RPR and PRP
    "two-coriolis-zh": ("sheet",),
    "shaper-zh": ("sheet",),
    "bell-crank": ("sheet",),
    "coupler-six-bar": ("sheet",),
    "toggle-press-us": ("sheet",),
    "slotter-british": ("sheet",),
    "six-bar-russian": ("sheet",),
    # forces
    "forces-shaper-zh": ("forces", "forces-2", "lever"),
    "forces-engine-us": ("forces", "lever"),
    # instant centres
    "centres-four-bar": ("centres",),
    "centres-slider-crank": ("centres",),
    "centres-shaper": ("centres",),
    "centres-six-bar-us": ("centres",),
    "centres-double-butterfly": ("centres",),
    # a train of wheels
    "gear-train-epicyclic": ("mechanism", "plan"),
    # cams by their law
    "cam-offset-roller": ("mechanism", "cam"),
    "cam-swinging-zh": ("cam",),
    "cam-flat-face": ("cam",),
    # mechanisms found for what they shall do
    "design-slider-crank": ("design", "choice"),
    "design-crank-rocker-zh": ("design",),
    "design-guide-bar": ("design",),
    "design-three-places": ("design",),
    "design-function": ("design",),
}

# charts of one machine on one day: kept as examples, not compared
STUDIES = ("speed-accuracy", "stability")

EXAMPLES = tuple(path.stem for path in sorted((HERE / "examples").glob("*.py")))


def redraw(name: str) -> dict[str, bytes]:
    """The figures of a folder, as they should be: SVG by file name."""
    from graphkin import design, draw
    from graphkin.drawing import svg_bytes

    if (HERE / name / "design.toml").exists():
        pages = design(HERE / name / "design.toml").figures
        return {f"{figure}.svg": pages[figure].content("svg") for figure in GALLERY[name]}
    figures = draw(HERE / name / "scene.toml").figures
    return {f"{figure}.svg": svg_bytes(figures[figure]) for figure in GALLERY[name]}


def run(example: str) -> tuple[dict[str, Any], bytes]:
    """What an example has found, by name, and its picture as SVG."""
    found = runpy.run_path(str(HERE / "examples" / f"{example}.py"))
    picture = found["picture"]
    if hasattr(picture, "content"):
        return found, picture.content("svg")
    import matplotlib

    stream = io.BytesIO()
    with matplotlib.rc_context({"svg.hashsalt": "graphkin", "svg.fonttype": "none"}):
        picture.savefig(stream, format="svg", metadata={"Date": None})
    return found, stream.getvalue()


def pictures(example: str) -> dict[str, bytes]:
    """The picture of an example, and that in Chinese where it has one, by the names of their files."""
    found, picture = run(example)
    made = {f"examples/{example}.svg": picture}
    if "picture_zh" in found:
        made[f"examples/{example}_zh.svg"] = found["picture_zh"].content("svg")
    return made


def main(names: list[str]) -> None:
    for name in names or [*GALLERY, *EXAMPLES]:
        made = pictures(name) if name in EXAMPLES else {
            f"{name}/{file}": content for file, content in redraw(name).items()
        }
        for file, content in made.items():
            path = HERE / file
            if not path.exists() or path.read_bytes() != content:
                path.write_bytes(content)
                print(path.relative_to(HERE))


if __name__ == "__main__":
    main(sys.argv[1:])
