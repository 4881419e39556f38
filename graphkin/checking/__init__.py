"""Readings off a drawing, their comparison with exact values, and the judging of values that others state."""

from graphkin.checking.audit import Judged, Verdict, judge
from graphkin.checking.printed import Printed, printed_values, stated
from graphkin.checking.readings import COVERAGE, Advice, Reading, Uncertainty, advise, predict, read_off
from graphkin.checking.report import Compared, Report, compare
from graphkin.checking.slips import Case

__all__ = [
    "COVERAGE",
    "Advice",
    "Case",
    "Compared",
    "Judged",
    "Printed",
    "Reading",
    "Report",
    "Uncertainty",
    "Verdict",
    "advise",
    "compare",
    "judge",
    "predict",
    "printed_values",
    "read_off",
    "stated",
]
