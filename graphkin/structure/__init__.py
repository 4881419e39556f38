"""Mobility and its traps, Assur groups, order of solution."""

from graphkin.structure.analysis import analyse, mobility_of, regrouped, started
from graphkin.structure.assembly import pick
from graphkin.structure.model import (
    Body,
    Driven,
    DrivenJoint,
    DrivenTriangle,
    Dyad,
    DyadKind,
    Element,
    LargerGroup,
    Mobility,
    Mover,
    RollingRelation,
    Structure,
    by_drivers_alone,
    driver_pair,
    greatest_before,
    kept_with,
    leading,
    links_for,
    named_with_contact,
    needed,
    part_of,
    without,
)
from graphkin.structure.replacement import cams_replaced, pin_in_guide, pins_on_circles, replacement_told
from graphkin.structure.rolling import meshes_of, unrolled

__all__ = [
    "Body", "Driven", "DrivenJoint", "DrivenTriangle", "Dyad", "DyadKind", "Element", "LargerGroup",
    "Mobility", "Mover", "RollingRelation", "Structure", "analyse", "by_drivers_alone",
    "cams_replaced", "driver_pair", "greatest_before", "kept_with", "leading", "links_for", "meshes_of", "mobility_of",
    "named_with_contact", "needed", "part_of", "pick", "pin_in_guide", "pins_on_circles", "regrouped",
    "replacement_told", "started", "unrolled", "without",
]
