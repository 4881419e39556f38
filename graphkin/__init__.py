"""graphkin draws velocity and acceleration polygons of mechanisms as with ruler and compass, measures and checks them.

A four-bar, from a scene to a checked diagram.  A scene is a text file (TOML), the name of a scene that comes along, a
mapping of the same shape, or a `Scene` built of the tables of `graphkin.scene`:

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
    from graphkin.api.cams import cam
    from graphkin.api.centred import centres, centrodes
    from graphkin.api.checked import check
    from graphkin.api.classroom.audited import audit
    from graphkin.api.classroom.course_designs import course_design
    from graphkin.api.classroom.handouts import handout
    from graphkin.api.classroom.problem_sets import problem_set
    from graphkin.api.converted import convert
    from graphkin.api.designed import design
    from graphkin.api.drawn import draw
    from graphkin.api.explained import explain
    from graphkin.api.prepared import prepare
    from graphkin.api.scene_list import scenes
    from graphkin.api.solved import solve
    from graphkin.api.studied import speed_accuracy, stability
    from graphkin.api.sweep import sweep
    from graphkin.board.server import open_board
    from graphkin.errors import CallError, GraphkinError, SceneError, Unsolvable
    from graphkin.scene.scene import Scene, read

__all__ = [
    "CallError", "GraphkinError", "Scene", "SceneError", "Unsolvable", "__version__", "audit", "cam", "centres",
    "centrodes", "check", "convert", "course_design", "design", "draw", "explain", "handout", "open_board", "prepare",
    "problem_set", "read", "scenes", "solve", "speed_accuracy", "stability", "sweep",
]

_PLACES = {
    "api.classroom.audited": "audit",
    "api.cams": "cam",
    "api.centred": "centres centrodes",
    "api.checked": "check",
    "api.converted": "convert",
    "api.classroom.course_designs": "course_design",
    "api.designed": "design",
    "api.drawn": "draw",
    "api.explained": "explain",
    "api.classroom.handouts": "handout",
    "api.prepared": "prepare",
    "api.classroom.problem_sets": "problem_set",
    "api.scene_list": "scenes",
    "api.solved": "solve",
    "api.studied": "speed_accuracy stability",
    "api.sweep": "sweep",
    "board.server": "open_board",
    "errors": "CallError GraphkinError SceneError Unsolvable",
    "scene.scene": "Scene read",
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
