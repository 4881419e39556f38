"""Mobility and its traps, Assur groups, order of solution."""

from graphkin.structure.analysis import analyse, mobility_of, regrouped, started
from graphkin.structure.assembly import Choice, pick
from graphkin.structure.model import (
    Body,
    Cluster,
    Driven,
    DrivenTriangle,
    Dyad,
    DyadKind,
    Element,
    Mobility,
    Pair,
    Rolled,
    RollingRelation,
    Structure,
    Weld,
    driver_pair,
    links_of,
    outside_of,
)
from graphkin.structure.needed_elements import by_drivers_alone, greatest_before, in_stages, links_for, needed, part_of
from graphkin.structure.replacement import named_with_contact, pins_on_circles, replacement_told
from graphkin.structure.rolling import Mesh, meshes_of, unrolled

__all__ = [
    "Body",
    "Choice",
    "Cluster",
    "Driven",
    "DrivenTriangle",
    "Dyad",
    "DyadKind",
    "Element",
    "Mesh",
    "Mobility",
    "Pair",
    "Rolled",
    "RollingRelation",
    "Structure",
    "Weld",
    "analyse",
    "by_drivers_alone",
    "driver_pair",
    "greatest_before",
    "in_stages",
    "links_for",
    "links_of",
    "meshes_of",
    "mobility_of",
    "named_with_contact",
    "needed",
    "outside_of",
    "part_of",
    "pick",
    "pins_on_circles",
    "regrouped",
    "replacement_told",
    "started",
    "unrolled",
]
