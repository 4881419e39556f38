"""A scene built in Python says what its file says."""

from __future__ import annotations

import copy
import math
import pickle
from dataclasses import FrozenInstanceError, replace
from pathlib import Path

import numpy as np
import pytest

import graphkin
import graphkin.scene as tables_of_scenes
from graphkin.errors import SceneError
from graphkin.scene import (
    DrivenSlide,
    Driver,
    Frame,
    Guide,
    Link,
    Load,
    LoadPhase,
    Mass,
    Pin,
    Polar,
    Scene,
    Spring,
    Units,
    library,
)
from graphkin.scene.tables import keys_of


def crank(**other: object) -> Scene:
    wanted: dict[str, object] = {
        "frame": Frame(points={"A": (0, 0)}, guides={"h": Guide(through=(0, -16), angle=0)}),
        "links": {
            "1": Link(points=["A", "B"], length=23.8),
            "2": Link(points=["B", "C"], length=58.4, at={"E": Polar("B", 20, 30)}),
            "3": Link(points=["C"], on="0.h"),
        },
        "driver": Driver("1", angle=60, omega=10),
    }
    return Scene(**{**wanted, **other})  # type: ignore[arg-type]


@pytest.mark.parametrize("name", library())
def test_a_saved_scene_reads_as_the_same(name: str, tmp_path: Path) -> None:
    scene = graphkin.read(name)
    again = graphkin.read(scene.save(tmp_path / f"{name}.toml"))
    assert (scene, scene.mechanism) == (again, again.mechanism)


def test_a_built_scene_is_that_of_its_mapping() -> None:
    assert crank().mechanism == graphkin.read(crank().to_dict()).mechanism


@pytest.mark.parametrize("name", library())
def test_every_table_of_a_file_has_a_builder_among_the_public_names(name: str) -> None:
    scene = graphkin.read(name)
    public = {name: getattr(tables_of_scenes, name) for name in tables_of_scenes.__all__}
    tables = {key.name: eval(repr(getattr(scene, key.name)), public) for key in keys_of(scene)}
    assert scene == Scene(**tables)


def test_masses_loads_and_springs_are_built_and_checked_as_in_a_file() -> None:
    when, spring = {"stroke": "3/0", "to": 0.5}, {"between": ["C", "A"], "rate": 1.6, "free": 20}
    built = crank(
        masses={"3": Mass(at="C", weight=8)},
        loads={"P": Load(on="3", at="C", force=90, against="3/0", when=LoadPhase(stroke="3/0", end=0.5))},
        springs={"R": Spring(between=["C", "A"], rate=1.6, free=20)},
    )
    mapping = {
        **crank().to_dict(),
        "masses": {"3": {"at": "C", "weight": 8}},
        "loads": {"P": {"on": "3", "at": "C", "force": 90, "against": "3/0", "when": when}},
        "springs": {"R": spring},
    }
    assert graphkin.read(mapping) == built
    with pytest.raises(SceneError, match=r"masses\.9"):
        crank(masses={"9": Mass(at="C", mass=1)})


def test_every_public_function_takes_a_built_scene() -> None:
    scene = crank()
    assert all(f(scene).ok for f in (graphkin.check, graphkin.solve, graphkin.centres, graphkin.draw))


def test_everything_wrong_with_a_built_scene_is_said_at_once() -> None:
    with pytest.raises(SceneError) as error:
        crank(links={"1": Link(points=["A", "b"], length=-5), "2": Link(points=["A", "D"])}, driver=Driver("7"))
    wrong = {p.where for p in error.value.problems}
    assert {"links.1.points.2", "links.1.length", "links.2.length", "driver.link", "driver.omega"} == wrong


def test_a_replaced_entry_leaves_the_scene_before_as_it_was() -> None:
    scene = crank()
    assert (30.0, 23.8) == (scene.replace("links.1.length", 30).links["1"].length, scene.links["1"].length)


@pytest.mark.parametrize(
    ("key", "value", "error"),
    [
        ("links.1.lenght", 3, 'did you mean "length"'),
        ("links.1.length", -3, "a length must be positive"),
        ("links.1.length", "3", "a number is written without quotation marks"),
        ("links.1.length", None, "is missing"),
        ("frame.points.A", 3, "is a table or a list"),
        ("links.9.length", 3, 'has no "9"'),
        ("", 3, 'has no ""'),
    ],
)
def test_what_cannot_be_replaced_is_told(key: str, value: object, error: str) -> None:
    with pytest.raises(graphkin.GraphkinError, match=error):
        crank().replace(key, value)


def test_a_whole_entry_can_be_replaced_by_a_table() -> None:
    assert 31.0 == crank().replace("links.1", Link(points=["A", "B"], length=31)).links["1"].length


def test_drivers_may_be_slides_several_and_in_any_unit() -> None:
    cylinder = Scene(
        units=Units("cm"),
        frame=Frame(points={"A": (0, 0), "C": (40, 0)}),
        links={"1": Link(points=["A", "B"], length=20), "2": Link(points=["B"], on="3"), "3": Link(points=["C"])},
        driver=[DrivenSlide("2", travel=30.0, velocity=5)],
    )
    assert pytest.approx(0.3) == cylinder.mechanism.drivers[0].values[0]


def test_numbers_and_arrays_of_numpy_are_numbers() -> None:
    points = {"A": np.zeros(2)}
    scene = crank(frame=Frame(points=points, guides={"h": Guide(np.array([0, -16.0]), np.float64(0))}))
    assert crank() == scene


def test_pins_stand_as_in_the_file() -> None:
    assert {"of": "1", "in": "3.s"} == crank_with_pin().to_dict()["pins"]["B"]


def crank_with_pin() -> Scene:
    return Scene(
        frame=Frame(points={"A": (0, 0), "C": (0, -40)}),
        links={"1": Link(points=["A", "B"], length=10), "3": Link(points=["C"], guides={"s": Guide("C", 0)})},
        pins={"B": Pin(of="1", slots="3.s")},
        driver=Driver("1", angle=10, rpm=60),
    )


def test_a_scene_can_be_pickled_copied_and_compared() -> None:
    scene = crank()
    assert scene == pickle.loads(pickle.dumps(scene)) == copy.deepcopy(scene) != scene.replace("driver.omega", 5)


@pytest.mark.quick
def test_a_key_of_a_table_is_set_once() -> None:
    link = Link(points=["A", "B"], length=120)
    with pytest.raises(FrozenInstanceError, match="length"):
        link.length = 130  # type: ignore[misc]
    with pytest.raises(FrozenInstanceError, match="length"):
        del link.length
    assert 120 == link.length


@pytest.mark.quick
def test_tables_are_equal_by_kind_and_values() -> None:
    assert {Units(length="cm"): 1} == {Units(length="cm"): 1}
    assert Units(length="cm") != Units(length="cm", mass="g")
    assert Driver(link="1", angle=60, omega=1) != DrivenSlide(slide="1", travel=60, velocity=1)


@pytest.mark.quick
def test_a_table_is_shown_with_its_keys() -> None:
    assert "Units(length='cm', speed=None, force='N', mass='kg')" == repr(Units(length="cm"))


def test_a_place_that_cannot_be_written_is_told(tmp_path: Path) -> None:
    with pytest.raises(graphkin.CallError, match="cannot be written"):
        crank().save(tmp_path / "no" / "x.toml")


def test_a_mechanism_that_was_changed_is_said_as_it_is_and_not_as_its_file() -> None:
    scene = crank()
    turned = replace(scene.mechanism, drivers=(scene.mechanism.drivers[0].at_value(1.0),))
    assert math.degrees(1.0) == pytest.approx(Scene.saying(turned).to_dict()["driver"][0]["angle"], abs=1e-9)
    assert scene.to_dict() == Scene.saying(scene.mechanism).to_dict()


def test_inertias_are_in_pounds_and_square_feet_beside_pounds() -> None:
    crank_with_mass = crank(
        units=Units(mass="lb"), masses={"2": Mass(at=(0, 0), mass=1, inertia=1)}
    ).mechanism.loading.masses[0]
    assert (pytest.approx(0.45359237), pytest.approx(0.0421401101)) == (crank_with_mass.mass, crank_with_mass.inertia)
