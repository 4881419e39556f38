"""Linkages in which wheels and links move each other, as mappings (mm)."""

from __future__ import annotations

from typing import Any

Scene = dict[str, Any]


def wheel_at_its_rim() -> Scene:
    """A crank moves a rod that is pinned to the rim of a wheel on a rail."""
    return {
        "frame": {"points": {"A": [0, 60]}, "guides": {"rail": {"through": [0, 0], "angle": 0}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 30},
            "2": {"points": ["B", "P"], "length": 150},
            "3": {"points": ["C", "P"], "length": 25, "start": 60, "discs": {"w": {"centre": "C", "r": 40}}},
        },
        "contacts": {"K": {"between": ["3.w", "0.rail"], "rolling": True}},
        "driver": {"link": "1", "angle": 50, "omega": 10},
    }


def cylinder_and_wheel() -> Scene:
    """The same wheel, its rim pushed by a driven cylinder."""
    scene = wheel_at_its_rim()
    scene["links"]["1"] = {"points": ["A"]}
    scene["links"]["2"] = {"points": ["P"], "on": "1"}
    return scene | {"driver": {"slide": "2", "travel": 150, "velocity": 40, "acceleration": 15}}


def five_bar_by_its_middle() -> Scene:
    """A five-bar with meshing cranks, driven at one of the bars between."""
    return {
        "frame": {"points": {"A": [0, 0], "E": [100, 0]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 45},
            "2": {"points": ["B", "C"], "length": 105},
            "3": {"points": ["C", "D"], "length": 85},
            "4": {"points": ["E", "D"], "length": 45, "start": 75},
        },
        "gears": {"g": {"between": ["1", "4"], "teeth": [20, 40]}},
        "driver": {"link": "2", "angle": 45, "omega": 4},
        "sketch": {"B": [-20, 40], "C": [50, 110], "D": [110, 45]},
    }


def planet_by_a_rod() -> Scene:
    """A wheel in a ring, held by an arm, its rim moved by a crank and a rod."""
    return {
        "frame": {"points": {"O": [0, 0], "A": [150, 20]}, "discs": {"s": {"centre": "O", "r": -80}}},
        "links": {
            "1": {"points": ["A", "B"], "length": 20},
            "2": {"points": ["B", "P"], "length": 115},
            "3": {"points": ["C", "P"], "length": 18, "start": 40, "discs": {"w": {"centre": "C", "r": 25}}},
            "4": {"points": ["O", "C"], "length": 55},
        },
        "contacts": {"K": {"between": ["3.w", "0.s"], "rolling": True}},
        "driver": {"link": "1", "angle": 100, "omega": 6, "alpha": 2},
        "sketch": {"C": [20, 50]},
    }


def wheel_on_a_rocker() -> Scene:
    """A wheel rolls on a rocking face; a bar holds its centre, a crank and a rod move its rim."""
    return {
        "frame": {"points": {"F": [0, 0], "E": [70, 130], "A": [190, 70]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 10},
            "2": {"points": ["B", "P"], "length": 118},
            "3": {"points": ["C", "P"], "length": 20, "start": 80, "discs": {"w": {"centre": "C", "r": 28}}},
            "4": {"points": ["E", "C"], "length": 86},
            "5": {"points": ["F"], "guides": {"f": {"through": [0, 0], "angle": 0}}},
        },
        "contacts": {"K": {"between": ["3.w", "5.f"], "rolling": True}},
        "driver": {"link": "1", "angle": 30, "omega": 5},
        "sketch": {"C": [70, 40], "P": [70, 62]},
    }


def rack_on_a_rocker() -> Scene:
    """A rack slides on a rocker that carries its pinion; a bar holds a point of the pinion, a crank and a rod move the
    rack."""
    return {
        "frame": {"points": {"O": [0, 0], "F": [173, 29], "A": [100, 170]}},
        "links": {
            "1": {"points": ["A", "B"], "length": 14},
            "2": {"points": ["B", "Q"], "length": 88},
            "3": {"points": ["C", "P"], "length": 18, "start": 44},
            "4": {"points": ["O", "C"], "length": 88, "guides": {"s": {"through": [0, 25], "angle": 0}}},
            "5": {"points": ["Q"], "on": "4.s"},
            "6": {"points": ["F", "P"], "length": 103},
        },
        "gears": {"g": {"between": ["3", "5"], "teeth": [20, "rack"], "carrier": "4"}},
        "driver": {"link": "1", "angle": 208, "omega": 3.4},
        "sketch": {"C": [60, 60], "P": [80, 70], "Q": [120, 80]},
    }


ROLLING_LINKAGES = (
    wheel_at_its_rim, cylinder_and_wheel, five_bar_by_its_middle, planet_by_a_rod, wheel_on_a_rocker, rack_on_a_rocker,
)
