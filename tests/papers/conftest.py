"""Handouts made once for all tests that look at them."""

from __future__ import annotations

import pytest

from graphkin.api.classroom.handouts import handout


@pytest.fixture(scope="session")
def shaper():
    return handout("shaper-scheme-2", language="en", positions=4)


@pytest.fixture(scope="session")
def six_bar():
    return handout("sixbar-guide-40deg", language="zh", formats=("pdf",))


@pytest.fixture(scope="session")
def shaper_forces():
    return handout("shaper-forces", language="en", formats=("html",), positions=1)
