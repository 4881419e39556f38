"""Readings off a drawing, and their comparison with exact values."""

from graphkin.checking.advice import Advice, advise
from graphkin.checking.readings import Reading, read_off
from graphkin.checking.report import Compared, Report, compare
from graphkin.checking.uncertainty import COVERAGE, Uncertainty, predict

__all__ = [
    "COVERAGE",
    "Advice",
    "Compared",
    "Reading",
    "Report",
    "Uncertainty",
    "advise",
    "compare",
    "predict",
    "read_off",
]
