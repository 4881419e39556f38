"""Where methods fail and how fast: the error of each beside each kind of singular position."""

from graphkin.study.stability.chart import stability_pages
from graphkin.study.stability.laws import ErrorLaw, Singularity
from graphkin.study.stability.run import KINDS, laws_table, run_singularities, to_json

__all__ = ["KINDS", "ErrorLaw", "Singularity", "laws_table", "run_singularities", "stability_pages", "to_json"]
