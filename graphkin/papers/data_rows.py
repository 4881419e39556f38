"""Tables of data as course exercises give them: a row for each group, scheme or student, with the usual names as heads,
cells also by formulas of other columns ("0.3 O4B", "O4B*(1 + cos(asin(O2A/O2O4)))/2").

A head is a key of the scene file with dots (``links.2.length``, ``frame.guides.h.through.y``, ``driver.angle``), two
points whose distance is given (``O4B``, ``lO4B``, ``l_O2A``), the driver's speed (``n2`` in r/min, ``omega1``), or its
angle (``phi1``, ``theta1``).  A length between fixed points moves the second away from the first.  Any other head is no
datum: the first names the row, the rest is unused.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from itertools import permutations, product

from graphkin.files import Tables
from graphkin.papers.fresh_numbers import drivers_of
from graphkin.words import Phrase, listed

LONGEST = 200
_OPERATORS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
}
_FUNCTIONS: Mapping[str, Callable[[float], float]] = {
    "sqrt": math.sqrt,
    "sin": lambda d: math.sin(math.radians(d)),
    "cos": lambda d: math.cos(math.radians(d)),
    "tan": lambda d: math.tan(math.radians(d)),
    "asin": lambda x: math.degrees(math.asin(x)),
    "acos": lambda x: math.degrees(math.acos(x)),
    "atan": lambda x: math.degrees(math.atan(x)),
}
_PRODUCT = re.compile(r"(?<![A-Za-z0-9_])(\d+(?:\.\d+)?)\s*(?=[A-Za-z(])")
Setting = tuple[str, float]
_UNIT = re.compile(r"[（(\[].*?[）)\]]|/\s*(?:mm|m|cm|rpm|r/min|deg|rad/s|°)\s*$")
_WORDS = re.compile("[\u3000-\u9fff\uff00-\uffef]+")
_LETTERS = {"rpm": "n", "omega": "omega ω w", "angle": "phi theta φ θ ϕ"}
"""How tables call the speed, the rate and the angle of a driver."""


# a row of data


def value_of(text: str, known: Mapping[str, float]) -> float:
    """The number of a cell: plain, or a formula of names with + - * / and functions; angles in degrees.

    Raises
    ------
    ValueError : it is no number and no such formula, or has an unknown name

    >>> value_of("0.3 O4B", {"O4B": 580.0})
    174.0
    """
    value = _plain(text)
    if value is None:
        value = _evaluated(_tree(text.replace("\u2212", "-")), known)
    if not math.isfinite(value):
        raise ValueError(Phrase("is no number", number=text.strip()[:40]))
    return value


def _plain(text: str) -> float | None:
    """The number of a cell; None for a formula."""
    try:
        return float(text.strip().replace("\u2212", "-"))
    except ValueError:
        return None


def _names_in(text: str) -> set[str]:
    """The names in a cell's formula; none for a plain number or another text."""
    try:
        tree = None if _plain(text) is not None else _tree(text)
    except ValueError:
        return set()
    return set() if tree is None else {n.id for n in ast.walk(tree) if isinstance(n, ast.Name)} - set(_FUNCTIONS)


def _tree(text: str) -> ast.expr:
    if len(text) > LONGEST:
        raise ValueError(Phrase("a formula of signs is too long", count=len(text)))
    try:
        return ast.parse(_PRODUCT.sub(r"\1*", text.strip()), mode="eval").body
    except (SyntaxError, RecursionError, MemoryError, ValueError):
        raise ValueError(Phrase("is no number", number=text[:40])) from None


def _evaluated(node: ast.expr, known: Mapping[str, float]) -> float:
    match node:
        case ast.Constant(value=int() | float() as number) if not isinstance(number, bool):
            return float(number)
        case ast.Name(id=name) if name in known:
            return known[name]
        case ast.Name(id=name):
            raise ValueError(Phrase("is no column with a number", name=name))
        case ast.UnaryOp(op=ast.USub(), operand=inner):
            return -_evaluated(inner, known)
        case ast.BinOp(left=left, op=op, right=right) if type(op) in _OPERATORS:
            try:
                return _OPERATORS[type(op)](_evaluated(left, known), _evaluated(right, known))
            except ZeroDivisionError:
                raise ValueError(Phrase("divides by zero")) from None
        case ast.Call(func=ast.Name(id=name), args=[one], keywords=[]) if name in _FUNCTIONS:
            try:
                return _FUNCTIONS[name](_evaluated(one, known))
            except ValueError:
                raise ValueError(Phrase("has no value there", name=name)) from None
    raise ValueError(Phrase("only these signs are possible"))


def columns_of(source: Tables, heads: Sequence[str]) -> tuple[dict[int, str], list[int]]:
    """The columns of a table that are data of the scene, by short names; the others, the first with the row's name."""
    known = _known_names(source)
    shorts = {i: _short(head) for i, head in enumerate(heads)}
    data = {i: short for i, short in shorts.items() if "." in short or _bare(short) in known}
    return data, [i for i in shorts if i not in data]


def replaced(source: Tables, data: Mapping[int, str], cells: Sequence[str]) -> list[Setting]:
    """Keys of the scene file with their values in a row.

    Parameters
    ----------
    data : the columns of data with their short names

    Raises
    ------
    ValueError : a cell that is no number, with the name of its column
    """
    texts = {short: cells[i] for i, short in data.items() if i < len(cells) and cells[i].strip()}
    known = _known_names(source)
    values = _values(texts).items()
    return [s for short, v in values for s in ([(short, v)] if "." in short else known[_bare(short)](v))]


def _short(head: str) -> str:
    """A head without unit, blanks and braces, and without the words that explain its symbol.

    >>> _short("曲柄转速 n2 (r/min)"), _short("l_{O2A}/mm")
    ('n2', 'l_O2A')
    """
    bare = _UNIT.sub("", head).replace(" ", "").replace("{", "").replace("}", "")
    return _WORDS.sub("", bare) or bare


def _values(texts: Mapping[str, str]) -> dict[str, float]:
    """The numbers of a row, formulas after the columns that they need."""
    plain = {_bare(short): short for short in texts}
    values: dict[str, float] = {}
    left = dict(texts)
    while left:
        needs = {s: {n: plain[_bare(n)] for n in _names_in(text) if _bare(n) in plain} for s, text in left.items()}
        ready = [s for s in left if not set(needs[s].values()) & left.keys()]
        if not ready:
            raise ValueError(Phrase("are given by one another", names=listed([*left])))
        for short in ready:
            known = {n: values[column] for n, column in needs[short].items()}
            try:
                values[short] = value_of(left.pop(short), known)
            except ValueError as error:
                raise ValueError(Phrase("where and what", where=short, found=error.args[0])) from None
    return values


def _bare(name: str) -> str:
    """A name of a length without its l: lO4B and O4B are one."""
    return re.sub(r"^[lL]_?(?=[A-Z])", "", name)


# what a file calls by short names

Setter = Callable[[float], list[Setting]]
"""From the value of a short name to the keys of the scene file with their values."""


def _known_names(source: Tables) -> dict[str, Setter]:
    """Every short name of a datum of the file: speeds and angles of drivers, distances of points."""
    known: dict[str, Setter] = {}
    for i, (path, driver) in enumerate(drivers_of(source)):
        where = ".".join(str(part + 1) if isinstance(part, int) else part for part in path)
        link = str(driver.get("link", ""))
        for key, letters in _LETTERS.items():
            for letter, index in product(letters.split(), (link, f"_{link}", *(("", "_") if i == 0 else ()))):
                known.setdefault(letter + index, partial(_driven, where, driver, key))
    for first, second, entries in _distances(source):
        known.setdefault(first + second, partial(_placed, entries))
    return known


def _driven(where: str, driver: Tables, key: str, value: float) -> list[Setting]:
    """A driver's angle, or its speed (r/min or rad/s), which tables give without its sense."""
    if key == "angle":
        return [(f"{where}.angle", value)]
    was = driver.get("rpm", driver.get("omega", 0.0))
    signed = math.copysign(value, was) if value > 0 and was else value
    if "rpm" in driver:
        return [(f"{where}.rpm", signed if key == "rpm" else signed * 30 / math.pi)]
    return [(f"{where}.omega", signed * math.pi / 30 if key == "rpm" else signed)]


Entries = Sequence[tuple[str, float, float]]
"""Keys of the file whose values follow from a distance: each with the value at nought, and what it gains for one."""


def _placed(entries: Entries, value: float) -> list[Setting]:
    return [(key, base + share * value) for key, base, share in entries]


def _distances(source: Tables) -> Iterator[tuple[str, str, Entries]]:
    """The entries of the file that give distances, by their two points in either order."""
    for name, link in source.get("links", {}).items():
        points = link.get("points", [])
        if len(points) == 2:
            yield from _both_ways(points[0], points[1], [(f"links.{name}.length", 0.0, 1.0)])
        for point, entry in link.get("at", {}).items():
            where = f"links.{name}.at.{point}"
            if isinstance(entry, Mapping):
                yield from _both_ways(point, str(entry.get("from")), [(f"{where}.r", 0.0, 1.0)])
            elif points and any(entry) and all(isinstance(c, int | float) for c in entry):
                size = math.hypot(*entry)
                shares = [(f"{where}.{axis}", 0.0, c / size) for axis, c in zip("xy", entry, strict=True)]
                yield from _both_ways(point, points[0], shares)
    fixed = source.get("frame", {}).get("points", {})
    for point, entry in fixed.items():
        if isinstance(entry, Mapping):
            yield from _both_ways(point, str(entry.get("from")), [(f"frame.points.{point}.r", 0.0, 1.0)])
    for first, second in permutations((p for p, xy in fixed.items() if isinstance(xy, list)), 2):
        # the point at the origin stays there
        still, moved = (first, second) if any(fixed[second]) else (second, first)
        span = [b - a for a, b in zip(fixed[still], fixed[moved], strict=True)]
        if size := math.hypot(*span):
            ends = zip("xy", fixed[still], span, strict=True)
            yield first, second, [(f"frame.points.{moved}.{axis}", a, c / size) for axis, a, c in ends]


def _both_ways(first: str, second: str, entries: Entries) -> Iterator[tuple[str, str, Entries]]:
    yield from ((first, second, entries), (second, first, entries))
