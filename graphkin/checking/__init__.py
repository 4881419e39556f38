"""Readings off a drawing, and their comparison with exact values."""

from graphkin.checking.readings import Reading, read_off
from graphkin.checking.report import Compared, Report, compare

__all__ = ["Compared", "Reading", "Report", "compare", "read_off"]
