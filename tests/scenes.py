"""Scenes of the tests: as texts of files, and a four-bar of any lengths as a mapping."""

from __future__ import annotations

from typing import Any


def four_bar(crank: float, coupler: float, rocker: float, ground: float, **more: Any) -> dict[str, Any]:
    """A four-bar whose crank stands at 60 deg and turns at 10 rad/s, unless ``more`` says otherwise (mm)."""
    return {
        "frame": {"name": "4", "points": {"A": [0, 0], "D": [ground, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": crank},
            "2": {"points": ["B", "C"], "length": coupler},
            "3": {"points": ["D", "C"], "length": rocker},
        },
        "driver": {"link": "1", "angle": 60, "omega": 10},
    } | more


def slider_crank(crank: float, rod: float, **more: Any) -> dict[str, Any]:
    """An in-line slider-crank, the crank at 50 deg with 10 rad/s, unless ``more`` says otherwise (mm)."""
    return {
        "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": "A", "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": crank},
            "2": {"points": ["B", "C"], "length": rod},
            "3": {"points": ["C"], "on": "0.h"},
        },
        "driver": {"link": "1", "angle": 50, "omega": 10},
    } | more


FOUR_BAR = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 150
[links.2]
points = ["B", "C"]
length = 500
at = { E = [200, 100] }
[links.3]
points = ["C", "D"]
length = 300
[driver]
link = "1"
angle = 60
omega = 10
alpha = -30
"""

PARALLELOGRAM = """
[frame]
points = { A = [0, 0], D = [300, 0] }
[links.1]
points = ["A", "B"]
length = 100
[links.2]
points = ["B", "C"]
length = 300
[links.3]
points = ["D", "C"]
length = 100
[driver]
link = "1"
angle = 60
omega = 10
[sketch]
C = [350, 87]
"""

DOUBLE_PARALLELOGRAM = """
[frame]
points = { A = [0, 0], D = [300, 0], F = [150, 20] }
[links.1]
points = ["A", "B"]
length = 100
[links.2]
points = ["B", "C"]
length = 300
at = { E = [150, 20] }
[links.3]
points = ["D", "C"]
length = 100
[links.4]
points = ["F", "E"]
length = 100
redundant = true
[driver]
link = "1"
angle = 60
omega = 10
alpha = 5
[sketch]
C = [350, 87]
"""

# an inclined guide off the pivot, the slider held at an angle to it, its pin off its own origin
OFFSET_SLIDER = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [10, 25], angle = 12 } }
[links.1]
points = ["A", "B"]
length = 40
[links.2]
points = ["B", "C"]
length = 130
[links.3]
on = "0.h"
angle_on = 35
at = { C = [8, -14] }
[driver]
link = "1"
angle = 75
omega = 4
alpha = 9
"""

# the guide is carried by the floating link and runs over a block on a known crank
OFFSET_SWING = """
[frame]
points = { A = [0, 0], C = [90, -20] }
[links.1]
points = ["A", "B"]
length = 40
[links.2]
points = ["B"]
on = "3.s"
angle_on = 25
[links.3]
points = ["C", "D"]
length = 50
guides = { s = { through = [5, 12], angle = 140 } }
[driver]
link = "1"
angle = 75
omega = 4
alpha = 9
"""

# the guide is on the floating body and runs over a known crank, its other joint is a rod's
GUIDE_OVER_CRANK = """
[frame]
points = { A = [0, 0], F = [70, -60] }
[links.1]
points = ["A"]
on = "5.s"
angle_on = 25
[links.2]
points = ["F", "C"]
length = 120
[links.5]
points = ["C"]
guides = { s = { through = [5, 12], angle = 140 } }
[driver]
link = "1"
angle = 75
omega = 4
alpha = 9
"""

# two guides, one of a moving crank: a pin in both slots, then a link on two guides
TWO_SLOTS = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 60], angle = 15 } }
[links.1]
points = ["A"]
guides = { s = { through = [10, 8], angle = 70 } }
[links.2]
on = "0.h"
angle_on = 20
at = { P = [12, 9] }
[pins.P]
of = "2"
in = "1.s"
[driver]
link = "1"
angle = 25
omega = 4
alpha = 9
"""

OLDHAM = """
[frame]
points = { A = [0, 0], C = [40, 15] }
[links.1]
points = ["A"]
[links.2]
on = ["1", "3"]
angle_on = [0, 90]
at = { E = [5, 8] }
[links.3]
points = ["C"]
[driver]
link = "1"
angle = 25
omega = 4
alpha = 9
"""

TRAMMEL = """
[frame]
guides = { x = { through = [0, 0], angle = 0 }, y = { through = [0, 0], angle = 90 } }
[links.1]
points = ["P", "Q"]
length = 100
at = { E = [150, 0] }
[pins.P]
of = "1"
in = "0.x"
[pins.Q]
of = "1"
in = "0.y"
[driver]
link = "1"
angle = 130
omega = 3
alpha = 1
"""

CYLINDER = """
[frame]
points = { A = [0, 0], C = [300, 0] }
[links.1]
points = ["A", "B"]
length = 200
at = { E = [300, 40] }
[links.2]
points = ["B"]
on = "3"
[links.3]
points = ["C"]
[driver]
slide = "2"
travel = 250
velocity = 60
acceleration = 20
"""

ARM = """
[frame]
points = { A = [0, 0] }
[links.1]
points = ["A", "B"]
length = 300
[links.2]
points = ["B", "C"]
length = 200
[[driver]]
link = "1"
angle = 30
omega = 2
alpha = 1
[[driver]]
link = "2"
relative_to = "1"
angle = 60
omega = -3
alpha = 4
"""

FIVE_BAR = """
[frame]
points = { A = [0, 0], E = [300, 0] }
[links.1]
points = ["A", "B"]
length = 120
[links.2]
points = ["B", "C"]
length = 250
[links.3]
points = ["D", "C"]
length = 260
[links.4]
points = ["E", "D"]
length = 110
[[driver]]
link = "1"
angle = 80
omega = 5
alpha = 3
[[driver]]
link = "4"
angle = 40
omega = -4
alpha = 2
"""
# a coupler driven: no crank has a given motion; a group of class III
FLOATING = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 150
[links.2]
points = ["B", "C"]
length = 500
at = { E = [200, 100] }
[links.3]
points = ["C", "D"]
length = 300
[driver]
link = "2"
angle = 20
omega = 2
alpha = 3
[sketch]
B = [75, 130]
C = [550, 260]
"""

# a plate on three bars, one of them driven by a crank: class III
TRIAD = """
[frame]
points = { A = [0, 0], G = [260, 40], H = [60, 260] }
[links.1]
points = ["A", "B"]
length = 30
[links.2]
points = ["B", "C"]
length = 110
[links.3]
points = ["C", "D"]
length = 90
at = { E = [30, 70] }
[links.4]
points = ["G", "D"]
length = 90
[links.5]
points = ["H", "E"]
length = 120
[driver]
link = "1"
angle = 50
omega = 6
alpha = 2
[sketch]
C = [110, 90]
D = [200, 100]
E = [130, 170]
"""

TRUSS = """
[frame]
points = { A = [0, 0], D = [400, 0] }
[links.1]
points = ["A", "B"]
length = 150
[links.2]
points = ["B", "C"]
length = 500
[links.3]
points = ["C", "D"]
length = 300
[links.4]
points = ["A", "C"]
length = 420
[driver]
link = "1"
angle = 60
omega = 10
"""

PISTON = """
[frame]
points = { A = [0, 0] }
guides = { h = { through = [0, 0], angle = 0 } }
[links.1]
points = ["A", "B"]
length = 50
[links.2]
points = ["B", "C"]
length = 120
[links.3]
points = ["C"]
on = "0.h"
[driver]
slide = "3"
travel = 150
velocity = 40
"""

WEDGES = """
[frame]
guides = { h = { through = [0, 0], angle = 0 }, v = { through = [100, 0], angle = 90 } }
[links.1]
on = "0.h"
guides = { w = { through = [0, 20], angle = 30 } }
[links.2]
on = ["0.v", "1.w"]
angle_on = [0, 60]
[driver]
slide = "1"
travel = 20
velocity = 5
"""

EQUAL_GUIDE = """
[frame]
points = { A = [0, 100], C = [0, 0] }
[links.1]
points = ["A", "B"]
length = 100
[links.2]
points = ["B"]
on = "3"
[links.3]
points = ["C"]
at = { D = [150, 0] }
[driver]
link = "1"
angle = 10
omega = 2
"""

# a parallelogram whose plate is moved through a rod by a slider: one group of four links, in line at travel 392.25
MOVED_PARALLELOGRAM = """
[frame]
points = { A = [0, 0], D = [300, 0] }
guides = { v = { through = [500, 0], angle = 90 } }
[links.1]
points = ["A", "B"]
length = 100
[links.2]
points = ["B", "C"]
length = 300
at = { E = [150, 80] }
[links.3]
points = ["D", "C"]
length = 100
[links.5]
points = ["E", "F"]
length = 400
[links.6]
points = ["F"]
on = "0.v"
[driver]
slide = "6"
travel = 421.5263726893667
velocity = 30
[sketch]
B = [95, 30]
C = [395, 30]
E = [245, 110]
F = [500, 421]
"""


# a four-bar with a dyad on its coupler, driven by the dyad: the driver's range is 445 degrees
WIDE_SWINGING = """
[frame]
points = { A = [0, 0], D = [102, -45], G = [41, 151] }

[links.1]
points = ["A", "B"]
length = 64.5

[links.2]
points = ["B", "C"]
length = 120.6
at = { E = [37.4, 108.1] }

[links.3]
points = ["D", "C"]
length = 84.4

[links.4]
points = ["E", "F"]
length = 68.1

[links.5]
points = ["G", "F"]
length = 56

[driver]
link  = "5"
angle = -92
omega = 1

[sketch]
B = [-8, 64]
C = [110, 39]
E = [51, 162]
F = [39, 95]
"""

FIXED_PIN: dict[str, Any] = {  # a bar is pushed along a pin of the frame in its slot
    "frame": {"points": {"A": [0, 0], "C": [80, 10]}},
    "links": {
        "1": {"points": ["A", "B"], "length": 40},
        "2": {"points": ["B", "E"], "length": 120, "guides": {"s": {"through": "B", "angle": 0}}},
    },
    "pins": {"C": {"of": "0", "in": "2.s"}},
    "driver": {"slide": "C/2", "travel": 60, "velocity": 20},
    "sketch": {"B": [20, 35]},
}

YOKE = {
    "frame": {"points": {"A": [0, 0]}, "guides": {"h": {"through": [0, 0], "angle": 0}}},
    "links": {
        "1": {"points": ["A", "B"], "length": 30},
        "2": {"points": ["B"]},
        "3": {"points": ["D"], "on": ["2", "0.h"], "angle_on": [90, 0]},
    },
    "driver": {"slide": "3/2", "travel": 10, "velocity": 1},
}
"""A yoke that slides on the frame and is driven along a block on a crank."""
