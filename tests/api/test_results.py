"""Results in a terminal and in a notebook."""

from __future__ import annotations

import pytest

import graphkin

pytestmark = pytest.mark.quick

COMMANDS = ["check", "solve", "draw", "centres", "audit", "handout", "sweep"]


@pytest.mark.parametrize("command", COMMANDS)
def test_a_result_prints_in_one_line_with_the_name_of_its_scene(command):
    shown = repr(getattr(graphkin, command)("sixbar-guide-40deg"))
    assert "sixbar-guide-40deg" in shown
    assert len(shown) < 120
