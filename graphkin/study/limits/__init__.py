"""Where methods fail and how fast: the error of each beside each kind of singular position."""

from graphkin.study.limits.law import Law, Trial
from graphkin.study.limits.pages import pages
from graphkin.study.limits.run import KINDS, run_trials
from graphkin.study.limits.table import laws_csv, to_json

__all__ = ["KINDS", "Law", "Trial", "laws_csv", "pages", "run_trials", "to_json"]
