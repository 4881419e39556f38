"""Sweeps: the motion of a whole turn, limit positions, transmission, classes, diagrams; and the same over designs."""

from graphkin.study.chunks import Plan
from graphkin.study.course import Course, course_of
from graphkin.study.designs import Designs, designs_of
from graphkin.study.diagrams import diagrams
from graphkin.study.kept import Swept
from graphkin.study.summary import to_json
from graphkin.study.sweeping import Progress, have_parquet, run, scheduler
from graphkin.study.trace import Extreme, Traced
from graphkin.study.turn import Output, Turn, study_turn

__all__ = [
    "Course",
    "Designs",
    "Extreme",
    "Output",
    "Plan",
    "Progress",
    "Swept",
    "Traced",
    "Turn",
    "course_of",
    "designs_of",
    "diagrams",
    "have_parquet",
    "run",
    "scheduler",
    "study_turn",
    "to_json",
]
