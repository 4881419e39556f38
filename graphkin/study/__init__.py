"""Sweeps: the motion of a whole turn, limit positions, transmission, classes, diagrams; and the same over designs."""

from graphkin.study.course import Course, course_of
from graphkin.study.designs import Designs, designs_of
from graphkin.study.diagrams import diagrams
from graphkin.study.summary import to_json
from graphkin.study.sweeps import Sweep, collect, write_tables
from graphkin.study.trace import Extreme, Traced
from graphkin.study.turn import Output, Turn, study_turn

__all__ = [
    "Course",
    "Designs",
    "Extreme",
    "Output",
    "Sweep",
    "Traced",
    "Turn",
    "collect",
    "course_of",
    "designs_of",
    "diagrams",
    "study_turn",
    "to_json",
    "write_tables",
]
