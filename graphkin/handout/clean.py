"""Words from a scene made fit to be shown: nothing that hides, turns or breaks a line of text."""

from __future__ import annotations

import re

__all__ = ["clean"]

# control characters, halves of surrogates, what no file may hold, and marks that turn the direction of writing
_UNFIT = re.compile(
    "[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069\ud800-\udfff\ufeff\ufffe\uffff]"
)


def clean(text: str) -> str:
    """The words without characters that could hide what stands beside them.

    >>> clean("sheet\\u202egpj.exe")
    'sheetgpj.exe'
    """
    return _UNFIT.sub("", text)
