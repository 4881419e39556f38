"""graphkin draws velocity and acceleration polygons of mechanisms as with ruler and compass, measures and checks them.

A four-bar, from a scene to a checked diagram.  A scene is a text file (TOML), the name of a scene that comes along, a
mapping of the same shape, or a `Scene` built of `Frame`, `Link`, `Guide`, `Driver`:

>>> import graphkin
>>> four_bar = {
...     "title": "Four-bar linkage",
...     "frame": {"name": "4", "points": {"A": [0, 0], "D": [400, 0]}},
...     "links": {
...         "1": {"points": ["A", "B"], "length": 150},
...         "2": {"points": ["B", "C"], "length": 500},
...         "3": {"points": ["D", "C"], "length": 300},
...     },
...     "driver": {"link": "1", "angle": 60, "omega": 10},
...     "sketch": {"C": [500, 290]},
... }

The drawing board finds the position with arcs, then draws the velocity polygon and the acceleration polygon; every
value is measured on the drawing and held against the analytic solver, which the drawing never sees:

>>> result = graphkin.check(four_bar)
>>> result.ok
True
>>> reading = result["v_C"]
>>> f"{abs(reading.measured):.1f} {reading.unit}, from {reading.on_paper:.2f} mm on paper"
'1556.1 mm/s, from 155.61 mm on paper'

The solver alone, at other positions too:

>>> graphkin.solve(four_bar, at=90)["omega_3"]
array([5.64295172]) rad/s

The figures, as SVG, PDF or PNG by the name:

>>> figures = graphkin.draw(four_bar).figures
>>> sorted(figures)
['acceleration', 'centres', 'mechanism', 'sheet', 'velocity']
"""

from __future__ import annotations

from graphkin.version import __version__

TYPE_CHECKING = False  # that of typing, without waiting for typing
if TYPE_CHECKING:
    from graphkin.api.audited import Audited, audit
    from graphkin.api.cams import Cams, cam
    from graphkin.api.centred import Centred, centres
    from graphkin.api.centroded import Centroded, centrodes
    from graphkin.api.checked import Checked, check
    from graphkin.api.converted import Converted, convert
    from graphkin.api.course_designs import CourseDesigns, course_design
    from graphkin.api.designed import Designed, design
    from graphkin.api.drawn import Drawn, draw
    from graphkin.api.explained import Explained, explain
    from graphkin.api.handouts import Handout, handout
    from graphkin.api.prepared import Prepared, PreparedDesigns, Samples, prepare
    from graphkin.api.problem_sets import ProblemSet, problem_set
    from graphkin.api.scene_list import Listed, scenes
    from graphkin.api.solved import Solved, solve
    from graphkin.api.studied import SpeedAccuracy, Stability, speed_accuracy, stability
    from graphkin.api.sweep import Swept, sweep
    from graphkin.board.server import open_board
    from graphkin.errors import CallError, GraphkinError, SceneError, Unsolvable
    from graphkin.scene.asked import Positions, PrintedTable, StrokeStart
    from graphkin.scene.bodies import Compass, Disc, Frame, Guide, Link, Pin, Polar
    from graphkin.scene.cams import AllowedPressure, BaseCircle, Cam
    from graphkin.scene.drivers import DrivenSlide, Driver
    from graphkin.scene.laws import LawPiece
    from graphkin.scene.loads import Balance, Flywheel, Gravity, Load, LoadPhase, Mass, Spring
    from graphkin.scene.scene import Scene, read
    from graphkin.scene.sheet import Background, SheetWishes, Tools, Vary
    from graphkin.scene.tables import Units
    from graphkin.scene.touching import Contact, Gear

__all__ = [
    "AllowedPressure", "Audited", "Background", "Balance", "BaseCircle", "CallError", "Cam", "Cams", "Centred",
    "Centroded", "Checked", "Compass", "Contact", "Converted", "CourseDesigns", "Designed", "Disc", "Drawn",
    "DrivenSlide", "Driver", "Explained", "Flywheel", "Frame", "Gear", "GraphkinError", "Gravity", "Guide", "Handout",
    "LawPiece", "Link", "Listed", "Load", "LoadPhase", "Mass", "Pin", "Polar", "Positions", "Prepared",
    "PreparedDesigns", "PrintedTable", "ProblemSet", "Samples", "Scene", "SceneError", "SheetWishes", "Solved",
    "SpeedAccuracy", "Spring", "Stability", "StrokeStart", "Swept", "Tools", "Units", "Unsolvable", "Vary",
    "__version__", "audit", "cam", "centres", "centrodes", "check", "convert", "course_design", "design", "draw",
    "explain", "handout", "open_board", "prepare", "problem_set", "read", "scenes", "solve", "speed_accuracy",
    "stability", "sweep",
]  # fmt: skip

_PLACES = {
    "api.audited": "Audited audit",
    "api.cams": "Cams cam",
    "board.server": "open_board",
    "errors": "CallError GraphkinError SceneError Unsolvable",
    "api.centred": "Centred centres",
    "api.centroded": "Centroded centrodes",
    "api.checked": "Checked check",
    "api.converted": "Converted convert",
    "api.course_designs": "CourseDesigns course_design",
    "api.designed": "Designed design",
    "api.drawn": "Drawn draw",
    "api.explained": "Explained explain",
    "api.handouts": "Handout handout",
    "api.prepared": "Prepared PreparedDesigns Samples prepare",
    "api.problem_sets": "ProblemSet problem_set",
    "api.scene_list": "Listed scenes",
    "api.solved": "Solved solve",
    "api.studied": "SpeedAccuracy Stability speed_accuracy stability",
    "api.sweep": "Swept sweep",
    "scene.asked": "Positions PrintedTable StrokeStart",
    "scene.bodies": "Compass Disc Frame Guide Link Pin Polar",
    "scene.cams": "AllowedPressure BaseCircle Cam",
    "scene.drivers": "DrivenSlide Driver",
    "scene.laws": "LawPiece",
    "scene.loads": "Balance Flywheel Gravity Load LoadPhase Mass Spring",
    "scene.scene": "Scene read",
    "scene.sheet": "Background SheetWishes Tools Vary",
    "scene.tables": "Units",
    "scene.touching": "Contact Gear",
}


def __getattr__(name: str) -> object:
    # each public name is loaded when it is first used, so that importing graphkin costs next to nothing, and a program
    # that checks a scene does not wait for the papers
    from importlib import import_module

    for place, names in _PLACES.items():
        if name in names.split():
            value = globals()[name] = getattr(import_module(f"graphkin.{place}"), name)
            return value
    raise AttributeError(f"module 'graphkin' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
