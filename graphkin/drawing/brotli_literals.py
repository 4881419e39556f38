"""Bytes in the format of Brotli, each by a Huffman code made beforehand, without references to earlier ones.

The libraries find references too, but not the same ones in every version, and take ten times as long; outlines of
letters hardly repeat.  Here the same bytes in give the same bytes out (RFC 7932: sections 3, 5 and 9).
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Mapping
from heapq import heapify, heappop, heappush

from graphkin.frozen import dataclass

__all__ = ["PrefixCode", "as_brotli", "code_for"]

_MOST = 1 << 16  # bytes of a block
_LONGEST, _LONGEST_OF_LENGTHS = 15, 5  # bits in a code of bytes, and in the code that tells how long those are
_LENGTHS = (1, 2, 3, 4, 0, 5, 17, 6, 16, 7, 8, 9, 10, 11, 12, 13, 14, 15)  # in the order of the format
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
    of_lengths = _lengths(Counter(lengths.values()), _LONGEST_OF_LENGTHS)
    bits, room = ["00"], 32
    for length in _LENGTHS:
        own = of_lengths.get(length, 0)
        bits.append(_LENGTHS_OF_LENGTHS[own])
        room -= 32 >> own if own else 0
        if not room:
            break
    codes = _codes(of_lengths) if len(of_lengths) > 1 else dict.fromkeys(of_lengths, "")
    return "".join(bits) + "".join(codes[lengths[byte]] for byte in range(256))


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
