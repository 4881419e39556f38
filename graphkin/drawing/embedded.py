"""The used glyphs of the family as a rule of a style sheet, so that a figure looks the same wherever it is opened."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable, Mapping
from zlib import crc32

from graphkin.drawing.font import FAMILY, Style, part

__all__ = ["FALLBACK", "face_rules", "families"]

# Where a program passes over embedded faces, as Inkscape does: Times and its twins, then faces that have the signs of
# mathematics, then Chinese serif faces of Linux, macOS, Windows.
FALLBACK = (
    "'Times New Roman', 'Liberation Serif', Times, 'STIX Two Text', STIXGeneral, 'Cambria Math', 'DejaVu Serif', "
    "'Noto Serif CJK SC', 'Source Han Serif SC', 'Songti SC', SimSun, serif"
)
_LOOK: Mapping[Style, str] = {"regular": "", "italic": ";font-style:italic", "bold": ";font-weight:bold"}


def face_rules(used: Mapping[Style, Iterable[str]]) -> tuple[str, str]:
    """The name of a family with the used characters of each style, and the rules that hold it.

    The name tells the glyphs, since several figures with different ones may stand in one page.
    """
    parts = {style: part(style, "".join(sorted(set(used[style])))) for style in _LOOK if used.get(style)}
    if not parts:
        return FAMILY, ""
    name = f"{FAMILY} {crc32(b''.join(parts.values())):08x}"
    rules = (
        f"@font-face{{font-family:'{name}'{_LOOK[style]};"
        f"src:url(data:font/woff2;base64,{b64encode(data).decode()}) format('woff2')}}"
        for style, data in parts.items()
    )
    return name, "".join(rules)


def families(name: str) -> str:
    """A list of faces that begins with an embedded one."""
    return f"'{name}', {FALLBACK}"
