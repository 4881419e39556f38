"""Speed against accuracy: all methods and other programs on the same work.  Nothing but ``graphkin study`` needs it."""

from graphkin.races.run import Race, race, race_page, race_table, to_json
from graphkin.races.timing import Entry

__all__ = ["Entry", "Race", "race", "race_page", "race_table", "to_json"]
