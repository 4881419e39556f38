"""The scene: its file format and how it is read.

Where the format leaves something open, the reader decides as follows.

- ``title`` may be left out (the scene's name stands for it), so may ``[units]`` (mm), ``[frame]`` (named "0",
  nothing but its own axis) and ``[driver]``: how many drivers are needed is asked of the mobility, not of the file.
- A driver needs ``omega`` or ``rpm``, a driven slide needs ``velocity``; 0 is written out.  ``alpha`` and
  ``acceleration`` are 0 if left out.  ``relative_to`` of a driven slide names the guiding link, which chooses the
  pair where a link slides on two.  ``slide`` may also name a pin in a slot ("B/3").
- A link is driven once; a second angle at it is written from the other link.
- A moving link has own points or ``on``; without both nothing says where its own axes are.
- ``at`` may place an own point again; both must agree.  Points in ``at`` may refer to one another in any order.
  Points of the frame may be given from others too.  ``angle`` in a polar entry is 0 if left out.  Arcs that miss
  each other by rounding touch.
- A guide with ``angle`` and ``toward`` is given twice; both must agree.
- Between the same two links there is one sliding pair at most, and none where a common point pins them.
- A length may be left out between drawn or fixed points only, never between points that follow from a driver.
- Where a drawn position leaves the direction of a swinging guide open, what slides on it (the first in the file)
  lies on its positive side.  A link with one own point, all else of which is drawn and nothing measured from its
  axis, has its x axis toward the first drawn point.
- A guide with ``centre`` and ``r`` is a slot along a circle: a pin in it is moved by a bar from the centre, a link by
  the guide's name (counted as a higher pair); a link with ``on`` turns about the centre, which lies to the left of the
  guide's sense, and ``angle_on`` counts from that sense.  ``ends`` only say how far it is drawn.
- Two statements of one quantity are compared by their effect: an angle by the distance that it moves the points that
  gave it.
- Of a driver written as ``[[driver]]``, ``driver.2`` in a message is the second; so are items of lists.
- ``[printed]`` and ``[[printed_rows]]`` take names as people write them too (``ω₃``, ``omega3``, ``v_B3``),
  and texts with unit, sense and direction (``"0.483 m/s ←"``, ``"2.82 cw"``).
- ``[printed]`` takes negative numbers for vectors too (a signed velocity of a slider); one number is a magnitude.
- A misspelt key is reported, and read as the key that was meant, so that the other messages stay true.
- Limits: 1 MB, 200 moving links, 100 points and guides a link, names of 40 and titles of 300 characters, numbers
  up to 1e15, lengths from 1e-15.
- A file with a byte order mark is read.  A file goes before a bundled scene of the same name.
"""

from __future__ import annotations

from graphkin.files import Json
from graphkin.scene.scene import Scene, library, library_text, mechanism_of, mechanism_of_text, read
from graphkin.scene.scene_tables import (
    SCENE,
    AllowedPressure,
    Background,
    Balance,
    BaseCircle,
    Cam,
    Compass,
    Contact,
    Disc,
    DrivenSlide,
    Driver,
    Flywheel,
    Frame,
    Gear,
    Gravity,
    Guide,
    LawPiece,
    Link,
    Load,
    LoadPhase,
    Mass,
    Pin,
    Polar,
    Positions,
    PrintedTable,
    SheetWishes,
    Spring,
    StrokeStart,
    Tools,
    Vary,
)
from graphkin.scene.tables import Units

__all__ = [
    "AllowedPressure", "Background", "Balance", "BaseCircle", "Cam", "Compass", "Contact", "Disc", "DrivenSlide",
    "Driver", "Flywheel", "Frame", "Gear", "Gravity", "Guide", "LawPiece", "Link", "Load", "LoadPhase", "Mass",
    "Pin", "Polar", "Positions", "PrintedTable", "Scene", "SheetWishes", "Spring", "StrokeStart", "Tools", "Units",
    "Vary", "library", "library_text", "mechanism_of", "mechanism_of_text", "read", "schema",
]


def schema() -> dict[str, Json]:
    """The JSON schema of a scene file, for editors that complete and check TOML."""
    return SCENE.schema()
