"""Handouts: problem sheet, worked solution and answer key, as HTML and typeset PDF, in one language or two.

The room bears the name of its public function, so it can be called as that function: ``graphkin.handout("slotter")``.
"""

from __future__ import annotations

import sys
from importlib import import_module
from types import ModuleType
from typing import Any


class _Room(ModuleType):
    def __call__(self, *args: Any, **options: Any) -> Any:
        # the function stands a layer above; it is looked up when it is called, so that this room does not lean on it
        return import_module("graphkin.api").handout(*args, **options)


sys.modules[__name__].__class__ = _Room
