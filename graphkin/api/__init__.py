"""The public functions, one for each command, and the results they return."""

from graphkin.api.checked import Checked, check
from graphkin.api.drawn import Drawn, draw
from graphkin.api.listed import Listed, scenes
from graphkin.api.solved import Solved, solve

__all__ = ["Checked", "Drawn", "Listed", "Solved", "check", "draw", "scenes", "solve"]
