"""Speed against accuracy of all methods on the same work."""

from graphkin.study.speed.pages import page
from graphkin.study.speed.run import Race, race
from graphkin.study.speed.table import race_csv, to_json

__all__ = ["Race", "page", "race", "race_csv", "to_json"]
