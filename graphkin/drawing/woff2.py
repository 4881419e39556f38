"""Glyphs as a WOFF2 file (W3C, WOFF File Format 2.0: sections 4 and 5): outlines as triplets, without what a reader of
the file can put together again, packed in the format of Brotli (RFC 7932: sections 3, 5 and 9).

Each byte is packed by a Huffman code made beforehand, without references to earlier ones.  The libraries find
references too, but not the same ones in every version, and take ten times as long; outlines of letters hardly repeat.
Here the same bytes in give the same bytes out.
"""

from __future__ import annotations

import struct
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from heapq import heapify, heappop, heappush
from itertools import groupby

__all__ = ["PrefixCode", "Streams", "as_brotli", "code_for", "streams", "woff2"]

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


_MOST = 1 << 16  # bytes of a block
_LONGEST, _LONGEST_OF_LENGTHS = 15, 5  # bits in a code of bytes, and in the code that tells how long those are
_LENGTHS = (1, 2, 3, 4, 0, 5, 17, 6, 16, 7, 8, 9, 10, 11, 12, 13, 14, 15)  # in the order of the format
_AGAIN = 16  # among lengths: the one before again, three times at least
_LENGTHS_OF_LENGTHS = ("00", "1110", "110", "01", "10", "1111")
# Of a command its least number of bytes, and in how many bits it says how many more.
_INSERTED = (
    0, 1, 2, 3, 4, 5, 6, 8, 10, 14, 18, 26, 34, 50, 66, 98, 130, 194, 322, 578, 1090, 2114, 6210, 22594,
)  # fmt: skip
_MORE = (0, 0, 0, 0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 7, 8, 9, 10, 12, 14, 24)
_COMMANDS = (128, 256, 448)  # the first for each eight of these


@dataclass(frozen=True)
class PrefixCode:
    """The bits of each byte, and those that tell a reader which they are."""

    of: tuple[str, ...]
    told: str


def code_for(sample: bytes) -> PrefixCode:
    """The best code for bytes as frequent as in a sample, with room for every other byte."""
    counts = Counter(sample)
    lengths = _lengths({byte: 1 + 4 * counts[byte] for byte in range(256)}, _LONGEST)
    codes = _codes(lengths)
    return PrefixCode(tuple(codes[byte] for byte in range(256)), _lengths_told(lengths))


def as_brotli(parts: Iterable[tuple[bytes, PrefixCode]]) -> bytes:
    """Parts one after the other as one stream, each in its code.

    >>> as_brotli([]).hex()
    '06'
    """
    bits = ["0"]  # the window is 64 kB
    for part, code in parts:
        for start in range(0, len(part), _MOST):
            bits += _block(part[start : start + _MOST], code)
    bits.append("11")  # the last block is empty
    stream = "".join(bits)
    return int(stream[::-1], 2).to_bytes(-(-len(stream) // 8), "little")


def _block(data: bytes, code: PrefixCode) -> list[str]:
    """One block as bits in the order of the stream: one command inserts all its bytes."""
    command = bisect_right(_INSERTED, len(data)) - 1
    symbol = _COMMANDS[command >> 3] + ((command & 7) << 3)
    return [
        "000", _number(len(data) - 1, 16), "0",  # not the last, not uncompressed
        "000", "000000", "00", "00",  # one kind of blocks, no direct distances, one code for all places
        code.told, _one(symbol, 10), _one(0, 6),
        _number(len(data) - _INSERTED[command], _MORE[command]),
        *map(code.of.__getitem__, data),
    ]  # fmt: skip


def _lengths_told(lengths: Mapping[int, int]) -> str:
    """Which byte has a code of which length."""
    told = [one for length, run in groupby(lengths[byte] for byte in range(256)) for one in _run(length, len([*run]))]
    of_lengths = _lengths(Counter(symbol for symbol, _ in told), _LONGEST_OF_LENGTHS)
    bits, room = ["00"], 32
    for length in _LENGTHS:
        own = of_lengths.get(length, 0)
        bits.append(_LENGTHS_OF_LENGTHS[own])
        room -= 32 >> own if own else 0
        if not room:
            break
    codes = _codes(of_lengths) if len(of_lengths) > 1 else dict.fromkeys(of_lengths, "")
    return "".join(bits) + "".join(codes[symbol] + more for symbol, more in told)


def _run(length: int, times: int) -> list[tuple[int, str]]:
    """A length so many times, each sign with the bits behind it: itself, then how often again, in digits to base 4."""
    left = times - 1
    if left < 3:
        return [(length, "")] * times
    digits = []
    left -= 3
    while True:
        digits.append((_AGAIN, _number(left & 3, 2)))
        left >>= 2
        if not left:
            break
        left -= 1
    return [(length, ""), *reversed(digits)]


def _lengths(counts: Mapping[int, int], longest: int) -> dict[int, int]:
    """How long the code of each symbol is (Huffman); rare ones count for more until none is too long."""
    least = 1
    while True:
        heap: list[tuple[int, int, tuple[int, ...]]]
        heap = [(max(count, least), symbol, (symbol,)) for symbol, count in sorted(counts.items())]
        heapify(heap)
        depth = dict.fromkeys(counts, 0)
        while len(heap) > 1:
            one, first, some = heappop(heap)
            other, _, more = heappop(heap)
            for symbol in (*some, *more):
                depth[symbol] += 1
            heappush(heap, (one + other, first, (*some, *more)))
        if max(depth.values()) <= longest:
            return depth if len(depth) > 1 else dict.fromkeys(depth, 1)
        least *= 2


def _codes(lengths: Mapping[int, int]) -> dict[int, str]:
    """The code of each symbol: those of a length follow each other (RFC 7932, 3.2)."""
    codes, code, before = {}, 0, 0
    for length, symbol in sorted((length, symbol) for symbol, length in lengths.items()):
        code <<= length - before
        codes[symbol] = f"{code:0{length}b}"
        code, before = code + 1, length
    return codes


def _one(symbol: int, width: int) -> str:
    """A code of one symbol, which takes no bits."""
    return "10" + "00" + _number(symbol, width)


def _number(value: int, width: int) -> str:
    return f"{value:0{width}b}"[::-1] if width else ""
