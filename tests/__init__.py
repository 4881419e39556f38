"""The tests.  With GRAPHKIN_ALL_POSITIONS in the environment they look at far more of the same, for minutes."""

import os

EVERYTHING = bool(os.environ.get("GRAPHKIN_ALL_POSITIONS"))
