"""Scenes written to the contract of scene files, each with what it must give.

The values beside the scenes were made by another solver than graphkin's, written from the contract alone: three
coordinates for every link, an equation for every joint, guide and driver, Newton's method at 30 digits from the
assembly that the contract's rules name, velocity and acceleration from the derivatives of the same equations.  The
scenes of ``refused`` begin with the exit status, what must be said (a pattern) and how many problems there are.
"""

from __future__ import annotations

import cmath
import json
import re
from functools import cache
from pathlib import Path

import pytest

import graphkin
from graphkin.errors import GraphkinError

HERE = Path(__file__).parent / "contract"
SCENES = sorted(p.stem for p in HERE.glob("*.toml"))
REFUSED = sorted(p.stem for p in (HERE / "refused").glob("*.toml"))
POSITIONS = [(n, k) for n in SCENES for k in range(len(json.loads((HERE / f"{n}.json").read_text())["positions"]))]

TOLERANCE = 1e-9
NO_SIZE = 1e-12


@cache
def expected(name):
    return json.loads((HERE / f"{name}.json").read_text())


@cache
def _solved(name, at):
    return graphkin.solve(HERE / f"{name}.toml", at=dict(at)).data


def solved(name, at):
    return _solved(name, tuple((at or {}).items()))


def value(entry):
    return complex(*entry) if isinstance(entry, list) else entry


def largest(position, what):
    """The largest value of a kind: vectors of points, slides and Coriolis terms are measured against each other."""
    kind = {"travel": "position", "coriolis": "acceleration"}.get(what, what)
    rows = [*position["links"].values(), *position["points"].values(), *position["slides"].values()]
    return max(abs(value(row[w])) for row in rows for w in (kind, what) if w in row)


def differences(position, got):
    for part in ("links", "points", "slides"):
        for name, row in position[part].items():
            for what, exact in row.items():
                found = value(got[part][name][what])
                off = abs(found - value(exact))
                if what == "angle":
                    off = abs(cmath.exp(1j * found) - cmath.exp(1j * exact))
                if not off <= TOLERANCE * max(largest(position, what), 1e-3 if what == "angle" else 0.0) + NO_SIZE:
                    yield f"{part} {name} {what}: {exact} expected, {found} found"


@pytest.mark.parametrize(("name", "k"), POSITIONS)
def test_every_link_point_and_slide_moves_as_in_the_other_solver(name, k):
    position = expected(name)["positions"][k]
    assert [] == list(differences(position, solved(name, position["at"])["positions"][0]))


@pytest.mark.parametrize("name", SCENES)
def test_just_the_links_points_and_slides_of_the_contract_are_listed(name):
    position, got = expected(name)["positions"][0], solved(name, None)["positions"][0]
    assert [set(position[p]) for p in ("links", "points", "slides")] == [
        set(got[p]) for p in ("links", "points", "slides")
    ]


@pytest.mark.parametrize("name", SCENES)
def test_mobility_and_groups_are_found(name):
    wanted, got = expected(name), solved(name, None)
    groups = [[g["class"], g["kind"], g["links"]] for g in got["groups"]]
    assert [wanted["mobility"], wanted.get("groups", groups)] == [got["mobility"], groups]


@pytest.mark.parametrize("name", SCENES)
def test_every_reading_of_the_drawing_agrees_with_the_solver(name):
    result = graphkin.check(HERE / f"{name}.toml")
    assert result.complete
    assert [] == [str(row.symbol) for row in result.report.rows if not row.ok]


@pytest.mark.parametrize("name", REFUSED)
def test_what_is_no_scene_or_cannot_be_solved_is_refused_by_name(name):
    path = HERE / "refused" / f"{name}.toml"
    text = path.read_text(encoding="utf-8")
    (status,) = re.findall(r"(?m)^# exit (\d)$", text)
    said, problems = re.findall(r"(?m)^# says (.*)$", text), re.findall(r"(?m)^# problems (\d+)$", text)
    with pytest.raises(GraphkinError) as refusal:
        graphkin.check(path)
    assert int(status) == refusal.value.exit_code
    assert [] == [pattern for pattern in said if not re.search(pattern, str(refusal.value))]
    assert problems in ([], [str(len(refusal.value.problems))])
