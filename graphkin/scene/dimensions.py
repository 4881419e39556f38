"""The numbers in which the designs of one mechanism differ: places, guides, angles between them, and the drivers'."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from graphkin.scene.model import Driver, Mechanism, PlacedLink

__all__ = ["Dimension", "changed_beside", "dimensions", "same_but_for_dimensions", "with_dimensions"]

Dimension = tuple[str | int, ...]
"""("point", link, point), ("through", link, guide), ("direction", link, guide), ("turn", sliding pair), and of the
driver k ("value", k), ("rate", k), ("second", k)."""


def dimensions(mechanism: Mechanism) -> dict[Dimension, complex]:
    """The numbers of a mechanism by name (SI)."""
    found: dict[Dimension, complex] = {}
    for link in (mechanism.frame, *mechanism.links):
        found |= {("point", link.name, point): z for point, z in link.points.items()}
        for name, guide in link.guides.items():
            found["through", link.name, name], found["direction", link.name, name] = guide.through, guide.direction
    found |= {("turn", pair.key): pair.turn for pair in mechanism.slidings}
    for k, driver in enumerate(mechanism.drivers):
        found |= {(what, k): complex(x) for what, x in zip(("value", "rate", "second"), driver.values, strict=True)}
    return found


def with_dimensions(mechanism: Mechanism, changed: Mapping[Dimension, complex]) -> Mechanism:
    """The mechanism with some of its numbers changed; what was drawn is then a sketch."""

    def link(old: PlacedLink) -> PlacedLink:
        points = {p: changed.get(("point", old.name, p), z) for p, z in old.points.items()}
        guides = {
            n: replace(
                g,
                through=changed.get(("through", old.name, n), g.through),
                direction=changed.get(("direction", old.name, n), g.direction),
            )
            for n, g in old.guides.items()
        }
        return replace(old, points=points, guides=guides)

    def driver(k: int, old: Driver) -> Driver:
        value, rate, second = (
            changed.get((what, k), complex(x)).real
            for what, x in zip(("value", "rate", "second"), old.values, strict=True)
        )
        return replace(old, value=value, rate=rate, second=second, rpm=None if ("rate", k) in changed else old.rpm)

    return replace(
        mechanism,
        frame=link(mechanism.frame),
        links=tuple(map(link, mechanism.links)),
        slidings=tuple(replace(s, turn=changed.get(("turn", s.key), s.turn)) for s in mechanism.slidings),
        drivers=tuple(driver(k, d) for k, d in enumerate(mechanism.drivers)),
        sketch={**mechanism.drawn, **mechanism.sketch},
        drawn={},
    )


_MOVING = ("frame", "links", "slidings", "pins", "drivers", "cams", "contacts", "gears", "starts", "slots")
"""The parts of a mechanism on which its motion depends."""


def changed_beside(one: Mechanism, other: Mechanism) -> tuple[str, ...]:
    """The parts in which two mechanisms move otherwise for something else than these numbers: where a cam stands, the
    radius of a disc, teeth."""
    own = dimensions(one)
    alike = [with_dimensions(mechanism, own) for mechanism in (one, other)]
    return tuple(part for part in _MOVING if getattr(alike[0], part) != getattr(alike[1], part))


def same_but_for_dimensions(one: Mechanism, other: Mechanism) -> bool:
    """Whether two mechanisms differ in nothing but these numbers, and in what was drawn."""
    own = dimensions(one)
    return with_dimensions(one, own) == with_dimensions(other, own)
