"""The tables of a scene file that say what a mechanism weighs and carries: masses, loads, springs, gravity,
balance, flywheel.

Forces are in the file's force unit, moments in it times metre, masses in its mass unit, angles in degrees.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal

from graphkin.scene.file_table import FileTable, about

if TYPE_CHECKING:
    from collections.abc import Sequence

    Number = float
    Magnitude = float
    NotNegative = float
    LinkName = str
    SlideRef = str
    Place = Sequence[float]
    PointNames = Sequence[str]
    LinkNames = Sequence[str]
    NameOrPlace = str | Sequence[float]
    NumberOrSquare = float | Literal["square"]

__all__ = ["STANDARD_GRAVITY", "Balance", "Flywheel", "Gravity", "Load", "LoadPhase", "Mass", "Spring"]

STANDARD_GRAVITY = 9.80665


@dataclass(frozen=True)
class Gravity(FileTable):
    """Where weights pull, and how much."""

    g: Magnitude = field(default=STANDARD_GRAVITY, metadata=about("Acceleration of gravity, m/s2."))
    angle: Number = field(default=-90.0, metadata=about("Its direction in degrees in the frame."))


@dataclass(frozen=True)
class Mass(FileTable):
    """Mass of a moving link."""

    at: NameOrPlace = field(metadata=about("The centre of mass: a point of the link, or [x, y] in its own axes."))
    mass: Magnitude | None = field(default=None, metadata=about("Its mass."))
    weight: Magnitude | None = field(default=None, metadata=about("Instead of mass: its weight, a force."))
    inertia: NotNegative = field(default=0.0, metadata=about("Moment of inertia about the centre of mass."))


@dataclass(frozen=True)
class LoadPhase(FileTable):
    """When a load acts: on a part of a stroke, or between two values of the driver."""

    stroke: SlideRef | None = field(default=None, metadata=about("The sliding pair on whose stroke it acts."))
    sense: Number = field(default=1.0, metadata=about("1: while it slides along the guide's sense; -1: against it."))
    start: NotNegative = field(default=0.0, metadata=about("Part of that stroke at which it begins.", alias="from"))
    end: NotNegative = field(default=1.0, metadata=about("Part of that stroke at which it ends.", alias="to"))
    driver: Place | None = field(
        default=None, metadata=about("Instead of stroke: two values of the first driver, growing between them.")
    )


@dataclass(frozen=True)
class Load(FileTable):
    """A force or a moment on a moving link."""

    on: LinkName = field(metadata=about("The link."))
    at: NameOrPlace | None = field(
        default=None, metadata=about("Where a force acts: a point of the link, or [x, y] in its own axes.")
    )
    force: Number | None = field(default=None, metadata=about("Size of a force."))
    moment: Number | None = field(
        default=None, metadata=about("Instead of force: a moment, counter-clockwise positive.")
    )
    angle: Number | None = field(
        default=None, metadata=about("Direction of a force in degrees in the frame, or from the axis of follows.")
    )
    follows: LinkName | None = field(default=None, metadata=about("The link with whose own axis the force turns."))
    against: SlideRef | None = field(
        default=None, metadata=about("Instead of angle: along this pair's guide, opposite to its sliding velocity.")
    )
    when: LoadPhase | None = field(default=None, metadata=about("When it acts; always if left out."))


@dataclass(frozen=True)
class Spring(FileTable):
    """A spring between points of two links; its force is preload + rate * (length - free), a pull where positive."""

    between: PointNames = field(metadata=about("The two points that it joins, of two links."))
    rate: Magnitude = field(metadata=about("Its rate: force unit per length unit of the scene."))
    free: NotNegative = field(metadata=about("Its free length."))
    preload: Number = field(default=0.0, metadata=about("Its pull at the free length (wound-in tension)."))
    links: LinkNames | None = field(
        default=None, metadata=about("The links of the two points, where several have them; the first that has it.")
    )


@dataclass(frozen=True)
class Balance(FileTable):
    """What keeps the mechanism in its motion: a moment, or a force through a point along a known line."""

    on: LinkName = field(metadata=about("The link."))
    at: NameOrPlace | None = field(
        default=None, metadata=about("Where a balancing force acts; a moment balances if left out.")
    )
    angle: NumberOrSquare | None = field(
        default=None, metadata=about('Its line in degrees in the frame, or "square" to the link\'s own axis.')
    )


@dataclass(frozen=True)
class Flywheel(FileTable):
    """A flywheel for a wished evenness of the turn."""

    on: LinkName = field(metadata=about("The link that carries it."))
    delta: Magnitude = field(metadata=about("Coefficient of speed fluctuation."))
    driving: Literal["constant"] = field(default="constant", metadata=about("The driving moment over the turn."))
