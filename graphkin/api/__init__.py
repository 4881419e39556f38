"""The public functions, one for each command, and the results they return."""

from graphkin.api.audited import Audited, audit
from graphkin.api.centred import Centred, centres
from graphkin.api.centroded import Centroded, centrodes
from graphkin.api.checked import Checked, check
from graphkin.api.drawn import Drawn, draw
from graphkin.api.handouts import Handout, handout
from graphkin.api.prepared import Prepared, Samples, prepare
from graphkin.api.problem_sets import ProblemSet, problem_set
from graphkin.api.scene_list import Listed, scenes
from graphkin.api.solved import Solved, solve
from graphkin.api.studied import SpeedAccuracy, Stability, speed_accuracy, stability
from graphkin.api.swept import Swept, sweep

__all__ = [
    "Audited",
    "Centred",
    "Centroded",
    "Checked",
    "Drawn",
    "Handout",
    "Listed",
    "Prepared",
    "ProblemSet",
    "Samples",
    "Solved",
    "SpeedAccuracy",
    "Stability",
    "Swept",
    "audit",
    "centres",
    "centrodes",
    "check",
    "draw",
    "handout",
    "prepare",
    "problem_set",
    "scenes",
    "solve",
    "speed_accuracy",
    "stability",
    "sweep",
]
