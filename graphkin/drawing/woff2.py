"""Glyphs as a WOFF2 file (W3C, WOFF File Format 2.0: sections 4 and 5): outlines as triplets, without what a reader of
the file can put together again, packed."""

from __future__ import annotations

import struct
from collections.abc import Mapping, Sequence
from functools import lru_cache

from graphkin.drawing.brotli_literals import PrefixCode, as_brotli
from graphkin.frozen import dataclass

__all__ = ["Streams", "streams", "woff2"]

_KNOWN = {
    "cmap": 0, "head": 1, "hhea": 2, "hmtx": 3, "maxp": 4, "name": 5, "OS/2": 6, "post": 7, "glyf": 10, "loca": 11,
}  # fmt: skip
_ON, _SHORT_X, _SHORT_Y, _REPEAT, _SAME_X, _SAME_Y = 1, 2, 4, 8, 16, 32  # flags of a point of a glyf table
_LOSSLESS = 0x0800  # flag of a head table: the outlines have been through a packer


@dataclass(frozen=True)
class Streams:
    """The bytes of a face by their kind: tables and counts, flags of points, ways between them; its directory, the
    number of its tables, its size as a plain file."""

    tables: bytes
    flags: bytes
    ways: bytes
    directory: bytes
    count: int
    unpacked: int

    @property
    def parts(self) -> tuple[bytes, ...]:
        return self.tables, self.flags, self.ways


def streams(tables: Mapping[str, bytes], outlines: Sequence[bytes], advances: Sequence[int]) -> Streams:
    """A face as WOFF2 wants it before it is packed.

    Parameters
    ----------
    tables : the finished tables besides glyf, loca and hmtx
    outlines : simple glyphs of a glyf table, empty for a blank
    advances : of each
    """
    count = wide = len(outlines)
    while wide > 1 and advances[wide - 1] == advances[wide - 2]:  # the last advance stands for all that follow
        wide -= 1
    hhea, head = bytearray(tables["hhea"]), bytearray(tables["head"])
    hhea[34:36] = struct.pack(">H", wide)
    head[16:18] = struct.pack(">H", int.from_bytes(head[16:18], "big") | _LOSSLESS)
    head[50:52] = b"\0\1"  # long places in loca
    contours, ends, flags, ways = (b"".join(column) for column in zip(*map(_triplets, outlines), strict=True))
    boxes = bytes(4 * ((count + 31) >> 5))  # each is found from its points
    sizes = (len(contours), len(ends), len(flags), len(ways), 0, len(boxes), 0)
    glyf = struct.pack(">4H7I", 0, 0, count, 1, *sizes) + contours + ends
    bodies = {
        **tables, "head": bytes(head), "hhea": bytes(hhea), "hmtx": b"\3" + struct.pack(f">{wide}H", *advances[:wide]),
    }  # fmt: skip
    plain = {tag: len(body) for tag, body in bodies.items()}
    plain |= {"hmtx": 2 * wide + 2 * count, "glyf": sum(len(o) + -len(o) % 4 for o in outlines), "loca": 4 * count + 4}
    packed = {"hmtx": len(bodies["hmtx"]), "glyf": len(glyf) + len(flags) + len(ways) + len(boxes), "loca": 0}
    order = (*sorted(tables), "glyf", "loca", "hmtx")  # the last takes what it lacks from glyf
    return Streams(
        b"".join(bodies[tag] for tag in sorted(tables)) + glyf, flags, ways + boxes + bodies["hmtx"],
        b"".join(_entry(tag, plain[tag], packed.get(tag)) for tag in order),
        len(order),
        12 + 16 * len(plain) + sum(size + -size % 4 for size in plain.values()),
    )  # fmt: skip


def woff2(face: Streams, codes: Sequence[PrefixCode]) -> bytes:
    """A face as WOFF2, each kind of bytes in its code."""
    packed = as_brotli(zip(face.parts, codes, strict=True))
    long = 48 + len(face.directory) + len(packed)
    first = struct.pack(
        ">4sIIHHIIHH5I",
        b"wOF2", 0x00010000, long + -long % 4, face.count, 0, face.unpacked, len(packed), 1, 0, *(0,) * 5,
    )  # fmt: skip
    return first + face.directory + packed + b"\0" * (-long % 4)


def _entry(tag: str, size: int, packed: int | None = None) -> bytes:
    """One table in the directory: its size, and what it takes where it has another form."""
    return bytes((_KNOWN[tag] | (tag == "hmtx") << 6,)) + _base128(size) + (b"" if packed is None else _base128(packed))


def _base128(value: int) -> bytes:
    digits = [value & 127]
    while value := value >> 7:
        digits.append(value & 127 | 128)
    return bytes(reversed(digits))


def _few(value: int) -> bytes:
    """A number of up to 755 as 255UInt16: no letter has contours of more points."""
    return bytes((value,)) if value < 253 else bytes((255, value - 253)) if value < 506 else bytes((254, value - 506))


@lru_cache(maxsize=4096)
def _triplets(outline: bytes) -> tuple[bytes, bytes, bytes, bytes]:
    """Number of contours, their numbers of points, a flag for each point, and the ways from point to point of a simple
    glyph."""
    if not outline:
        return b"\0\0", b"", b"", b""
    (count,) = struct.unpack_from(">h", outline)
    ends = struct.unpack_from(f">{count}H", outline, 10)
    flags, ways = bytearray(), bytearray()
    for on, dx, dy in _points(outline, 10 + 2 * count, ends[-1] + 1):
        flag, way = _triplet(dx, dy)
        flags.append(flag if on else flag | 128)
        ways += way
    counts = (end - start for start, end in zip((-1, *ends), ends, strict=False))
    return outline[:2], b"".join(map(_few, counts)), bytes(flags), bytes(ways) + b"\0"  # no instructions


def _points(outline: bytes, at: int, count: int) -> list[tuple[bool, int, int]]:
    """On the curve or off it, and the way from the point before, of each point of a simple glyph."""
    at += 2 + int.from_bytes(outline[at : at + 2], "big")  # over the instructions
    flags: list[int] = []
    while len(flags) < count:
        flag = outline[at]
        times = outline[at + 1] + 1 if flag & _REPEAT else 1
        at += 2 if flag & _REPEAT else 1
        flags += [flag] * times
    columns: list[list[int]] = []
    for short, same in ((_SHORT_X, _SAME_X), (_SHORT_Y, _SAME_Y)):
        column = []
        for flag in flags:
            if flag & short:
                column.append(outline[at] if flag & same else -outline[at])
                at += 1
            elif flag & same:
                column.append(0)
            else:
                column.append(int.from_bytes(outline[at : at + 2], "big", signed=True))
                at += 2
        columns.append(column)
    return [(bool(flag & _ON), dx, dy) for flag, dx, dy in zip(flags, *columns, strict=True)]


def _triplet(dx: int, dy: int) -> tuple[int, bytes]:
    """The shortest form of a way (WOFF2, 5.2): a flag, and up to four bytes."""
    x, y = abs(dx), abs(dy)
    right, up = int(dx > 0), 2 * int(dy > 0)
    if not dx and y < 1280:
        return (y >> 8 << 1) + (up >> 1), bytes((y & 255,))
    if not dy and x < 1280:
        return 10 + (x >> 8 << 1) + right, bytes((x & 255,))
    signs = right + up
    if x < 65 and y < 65:
        return 20 + (x - 1 & 0x30) + (y - 1 >> 4 << 2) + signs, bytes(((x - 1 & 15) << 4 | y - 1 & 15,))
    if x < 769 and y < 769:
        return 84 + 12 * (x - 1 >> 8) + (y - 1 >> 8 << 2) + signs, bytes((x - 1 & 255, y - 1 & 255))
    if x < 4096 and y < 4096:
        return 120 + signs, bytes((x >> 4, (x & 15) << 4 | y >> 8, y & 255))
    return 124 + signs, struct.pack(">2H", x, y)
