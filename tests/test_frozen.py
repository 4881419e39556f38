"""Frozen dataclasses made by `graphkin.frozen` are those that `dataclasses` makes, held against each other."""

import dataclasses
import inspect
import pickle
from collections.abc import Callable
from dataclasses import FrozenInstanceError, field, fields, replace
from typing import Any

import pytest

from graphkin import frozen

pytestmark = pytest.mark.quick


def one_of_each(dataclass: Callable[..., Any]) -> tuple[type, type]:
    @dataclass(frozen=True)
    class Part:
        """A part."""

        name: str
        mass: float = 1.0
        marks: list[str] = field(default_factory=list, hash=False)
        note: str = field(default="", compare=False, repr=False)
        size: float = field(init=False, default=2.0)
        seen: list[int] = field(init=False, default_factory=list, compare=False)

        def __post_init__(self) -> None:
            self.__dict__["twice"] = 2 * self.mass

    @dataclass(frozen=True, kw_only=True)
    class Whole(Part):
        """A part with parts."""

        name: str = "whole"
        parts: tuple[Any, ...] = ()

        def __repr__(self) -> str:
            return f"<{self.name}>"

    return Part, Whole


OWN, KNOWN = one_of_each(frozen.dataclass), one_of_each(dataclasses.dataclass)


@frozen.dataclass(frozen=True)
class Pair:
    """On the module, where pickle finds it."""

    a: float
    b: object = None


@frozen.dataclass(frozen=True)
class Alone:
    """Of one value, which may be an array."""

    value: object


@pytest.mark.parametrize(("own", "known"), list(zip(OWN, KNOWN, strict=True)))
def test_they_take_the_same_values_in_the_same_way(own: type, known: type) -> None:
    assert str(inspect.signature(known)) == str(inspect.signature(own))
    assert [f.name for f in fields(known)] == [f.name for f in fields(own)]


def test_they_hold_the_same_values() -> None:
    part, whole = (kinds[0]("a", 3.0, note="n") for kinds in (KNOWN, OWN))
    assert vars(part) == vars(whole)
    assert vars(KNOWN[1]("b", parts=(1,))) == vars(OWN[1]("b", parts=(1,)))


def test_every_one_has_a_list_of_its_own() -> None:
    one, other = OWN[0]("a"), OWN[0]("a")
    assert one.marks is not other.marks
    assert one.seen is not other.seen


@pytest.mark.parametrize("args", [(), ("a", 1.0, [], "", 3.0)])
def test_a_value_missing_or_too_many_is_a_type_error(args: tuple[object, ...]) -> None:
    with pytest.raises(TypeError, match=r"Part.__init__\(\)"):
        OWN[0](*args)


def test_they_are_shown_alike() -> None:
    assert repr(KNOWN[0]("a", note="unseen")) == repr(OWN[0]("a", note="unseen"))
    assert "<whole>" == repr(OWN[1]())


def test_they_are_equal_by_what_is_compared_and_within_one_class_only() -> None:
    assert OWN[0]("a", note="one") == OWN[0]("a", note="other")
    assert OWN[0]("a", 2.0) != OWN[0]("a")
    assert OWN[1]("a") != OWN[0]("a")
    assert Pair(1.0) != (1.0, None)


def test_what_is_one_value_is_equal_though_nothing_equals_it() -> None:
    nan = float("nan")
    assert Alone(nan) == Alone(nan)


def test_equal_ones_have_one_hash() -> None:
    assert hash(OWN[0]("a", marks=["m"], note="one")) == hash(OWN[0]("a", note="other"))
    assert 2 == len({Pair(1.0), Pair(1.0), Pair(1.0, 2)})


def test_nothing_of_them_can_be_changed() -> None:
    part = OWN[0]("a")
    for name in ("name", "further"):
        with pytest.raises(FrozenInstanceError, match=name):
            setattr(part, name, "b")
    with pytest.raises(FrozenInstanceError, match="name"):
        del part.name
    assert part.name == "a"


def test_replaced_and_pickled_they_are_the_same_kind() -> None:
    assert Pair(1.0, "c") == replace(Pair(1.0, "b"), b="c")
    assert Pair(1.0, "b") == pickle.loads(pickle.dumps(Pair(1.0, "b")))


def test_a_class_that_compares_by_itself_keeps_its_way() -> None:
    @frozen.dataclass(frozen=True)
    class Near:
        value: float

        def __eq__(self, other: object) -> bool:
            return isinstance(other, Near) and abs(self.value - other.value) < 0.1

    assert Near(1.0) == Near(1.05)
    assert hash(Near(1.0)) == hash(Near(1.0))


def test_what_compares_by_identity_does_so() -> None:
    @frozen.dataclass(frozen=True, eq=False)
    class Found:
        value: float

    assert Found(1.0) != Found(1.0)


def test_those_that_change_or_are_ordered_are_left_to_dataclasses() -> None:
    @frozen.dataclass
    class Count:
        value: int = 0

    @frozen.dataclass(frozen=True, order=True)
    class Place:
        value: int

    count = Count()
    count.value += 1
    assert count == Count(1)
    assert Place(1) < Place(2)
