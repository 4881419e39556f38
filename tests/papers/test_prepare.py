from __future__ import annotations

import pytest

from graphkin.construction.centres import find_centres
from graphkin.papers.prepare import usual_count
from graphkin.scene import mechanism_of

pytestmark = pytest.mark.quick


def test_centres_followed_from_a_neighbour_are_those_found_afresh():
    scene = mechanism_of("double-butterfly")
    key = scene.drivers[0].key
    start = scene.drivers[0].values[0]
    one = find_centres(scene, {key: start + 0.1})
    two = find_centres(scene, {key: start + 0.2}, near=one)
    afresh = find_centres(scene, {key: start + 0.2})
    for pair, centre in afresh.table.items():
        if centre.point is not None:
            assert centre.point == pytest.approx(two.table[pair].point, abs=1e-6)


def test_a_mechanism_of_many_links_is_shown_in_fewer_positions():
    assert 12 == usual_count(mechanism_of("double-butterfly"))
