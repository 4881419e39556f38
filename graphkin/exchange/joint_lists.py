"""Files that list joints, each with the links that it joins: PMKS, PMKS+ and pyslvs.

- A row of the table of PMKS names the links of a joint, its kind (R, P or RP), x, y and, of a slide, the angle of its
  line in degrees; rows are lines, or parted by "|" in an address.  The link called ``ground`` is fixed, one called
  ``input`` drives.
- The address of PMKS+ holds, parted by points, its settings, joints, links and forces in a numeral system of base 64,
  lengths in thousandths (``string-transcoder.ts``).
- An expression of pyslvs, ``M[J[R, P[0, 0], L[ground, link_1]], ...]``, stands alone or in a project, which also names
  the driver.  A joint has its kind (R, P, RP), of a slide the angle ``A[90]`` of its line in degrees on the first of
  its links, any colour, its place and its links (grammar of ``pyslvs.expression_parser``).
"""

from __future__ import annotations

import cmath
import math
import re
from collections.abc import Iterable, Sequence
from urllib.parse import unquote, unquote_plus

from graphkin.errors import CallError, Problem
from graphkin.exchange.bodies import FRAME, Bodies, BodySlide, number
from graphkin.words import Phrase

DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_-"
UNITS = ("in", "cm", "m")
MOST_DIGITS = 12
HALF_A_THOUSANDTH = 6e-4
"""rad, with some room: the rounding of an angle in an address."""
INPUT_SPEED = 1.0
"""rad/s, where a table or an expression says none."""
_NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
_JOINT = re.compile(
    rf"J\[\s*(RP|R|P)\s*(?:,\s*A\[\s*({_NUMBER})\s*\])?\s*(?:,\s*color\[[^\]]*\])?\s*,\s*"
    rf"P\[\s*({_NUMBER})\s*,\s*({_NUMBER})\s*\]\s*,\s*L\[([^\]]*)\]\s*\]"
)


def _join(
    made: Bodies, known: dict[str, str], name: str, kind: str, place: complex, links: Sequence[str], angle: float
) -> None:
    """Add a joint of some links, of which ``ground`` is the frame.

    Parameters
    ----------
    known : the bodies of links by the file's names
    kind : "R" turning; "P" the other links slide on a line of the first link at a fixed angle; "RP" a pin of the other
        links runs on a line of the first link
    angle : the line's angle in the world (rad)
    """
    for link in links:
        if link not in known:
            known[link] = made.body(FRAME if link.lower() == "ground" else link, ())
    first, *others = (known[link] for link in links)
    point = made.point(name, place)
    if kind == "P" and others and others[0] == FRAME:
        first, others = others[0], [first]  # who slides on whom makes no difference where neither turns
    holding = [first, *others] if kind == "R" or not others else others
    for link in holding:
        made.bodies[link].append(point)
    if holding is others:
        made.slides.append(BodySlide(others[0], point, first, place, angle, kind == "RP"))


def _letter(number: int) -> str:
    """A, B, ... Z, A1, B1, ..."""
    turn, letter = divmod(number, 26)
    return chr(65 + letter) + (str(turn) if turn else "")


# PMKS and PMKS+


def is_address(text: str) -> bool:
    """Whether a text is a shared link of PMKS+, or the part of it behind the question mark."""
    body = _payload(text)
    return body.count(".") > 6 and re.fullmatch(r"[0-9A-Za-z_\-.,# %+*]+", body) is not None and ".." in body


def _payload(text: str) -> str:
    text = unquote(text.strip())
    return text.partition("?")[2] if "?" in text else text


def read_table(text: str, title: str) -> Bodies:
    """The bodies of a table of joints.  Raises CallError naming every wrong row."""
    shared = re.search(r"[?&]mech=([^&#\s]+)", text)
    rows = (unquote_plus(shared[1]) if shared else text).replace("|", "\n").splitlines()
    made, known, problems = Bodies(title), dict[str, str](), []
    for count, row in enumerate(rows, 1):
        cells = [c for c in re.split(r"[,\t; ]+", row.strip()) if c]
        if not cells or row.lstrip().startswith("#"):
            continue
        at = next((k for k, c in enumerate(cells) if c.upper() in ("R", "P", "RP")), None)
        numbers = [float(c) for c in cells[at + 1 :] if _is_number(c)] if at is not None else []
        if at is None and not any(map(_is_number, cells)):
            continue  # the head
        if not at or len(numbers) < 2 or (cells[at].upper() != "R" and len(numbers) < 3):
            where, fault = Phrase("row", name=title, number=count), Phrase("is no joint", joint=row.strip()[:60])
            problems.append(Problem(where, fault, "write links r p or rp x y"))
            continue
        angle = math.radians(numbers[2]) if cells[at].upper() != "R" else 0.0
        _join(made, known, _letter(len(made.places)), cells[at].upper(), complex(*numbers[:2]), cells[:at], angle)
    if problems:
        raise CallError(*problems)
    made.bodies.setdefault(FRAME, [])
    moved = next((n for n in made.bodies if n.lower() == "input"), None)
    if moved is not None:
        made.drive(moved, INPUT_SPEED)
    return made


def _is_number(text: str) -> bool:
    try:
        return math.isfinite(float(text))
    except ValueError:
        return False


def _whole(text: str, title: str) -> int:
    """A whole number of the address: a leading 0 is its minus sign."""
    value = 0
    for sign in text:
        if sign not in DIGITS or len(text) > MOST_DIGITS:
            raise CallError.of(title, "is no number of pmks", "copy the whole link", text=text[:20])
        value = value * 64 + DIGITS.index(sign)
    return -value if text.startswith("0") else value


def read_address(text: str, title: str) -> Bodies:
    """The bodies of a shared link of PMKS+. Raises CallError for a text that is none."""
    body = _payload(text)
    if "*" in body:
        raise CallError.of(title, "is a link of today's pmks with a", "draw it anew as a scene")
    parts = body.split(".")
    heads, rest = parts[:4], parts[4:]
    sections: list[list[str]] = [[]]
    for part in rest:
        if part:
            sections[-1].append(part)
        else:
            sections.append([])
    if len(sections) < 3 or not sections[0] or not sections[1]:
        raise CallError.of(title, "is no link of pmks with joints and", "copy the whole link")
    flags = _whole(heads[0], title)
    decimals, speeds = heads[1].split(","), heads[2].split(",")
    made = Bodies(title, unit=UNITS[min(_whole(heads[3][:1], title), 2)] if heads[3] else "cm")
    turning = (-1.0 if flags & 1 else 1.0) * _whole(speeds[0], title) * math.tau / 60
    sliding = _whole(decimals[1], title) / 1000 if len(decimals) > 1 else 1.0
    joints = {j.id: j for j in (_SharedJoint(text, title) for text in sections[0])}
    for key, j in joints.items():
        if not j.slides:
            made.point(j.name or key, j.place, key)
    made.body(FRAME, [key for key, j in joints.items() if j.grounded])
    links: dict[str, str] = {}
    blocks: list[list[str]] = []
    for piece in sections[1]:
        cells = piece.split(",")
        ends = cells[7:]
        if not ends or len(piece) < 2:
            raise CallError.of(title, "is no link of pmks", "copy the whole address", piece=piece[:30])
        ends = ends[: ends.index("")] if "" in ends else ends
        if piece[:2] == "NR":
            continue  # a part of a welded link, which is there as a whole
        if piece[1] == "P":
            blocks.append(ends)
        else:
            links[cells[0][2:]] = made.body(cells[1] or cells[0][2:], ends)
    made.lost += [Phrase("lost force", name=piece.split(",")[2]) for piece in sections[2] if piece.count(",") > 5]
    held = {key for ends in blocks for key in ends}
    loose = [j for key, j in joints.items() if j.slides and key not in held]
    made.lost += [Phrase("lost slider", name=j.name or j.id) for j in loose]
    for ends in blocks:
        _block(made, ends, joints, links, sliding)
    for key, joint in joints.items():
        if joint.driven and not joint.slides:
            lost = Phrase("lost input at", name=joint.name or key)
            if joint.grounded:
                made.turn((key,), turning, lost)
            else:
                made.lost.append(lost)
    return made


class _SharedJoint:
    """A joint of the address: flags (slides, driven, grounded, welded), name, place, angle of its line and its
    carrier."""

    def __init__(self, text: str, title: str) -> None:
        cells = text[1:].split(",")
        if len(cells) < 5 or not cells[0]:
            raise CallError.of(title, "is no joint of pmks", "copy the whole link", text=text[:30])
        flags = _whole(text[:1], title)
        self.slides, self.driven, self.grounded, self.welded = (bool(flags >> k & 1) for k in range(4))
        self.id, self.name = cells[0], cells[1]
        self.place = complex(_whole(cells[2], title), _whole(cells[3], title)) / 1000
        self.angle = _whole(cells[4], title) / 1000
        self.carrier, self.ends = (cells[5], cells[6:8]) if len(cells) > 7 else ("", [])


def _block(made: Bodies, ends: list[str], joints: dict[str, _SharedJoint], links: dict[str, str], rate: float) -> None:
    """Add a block that slides on a line of the frame or of its carrier; a welded block is part of its link."""
    line = next((joints[k] for k in ends if k in joints and joints[k].slides), None)
    pin = next((joints[k] for k in ends if k in joints and not joints[k].slides), None)
    carried = line is not None and line.carrier in links and len([end for end in line.ends if end in made.names]) == 2
    if line is None or pin is None or not (line.grounded or carried):
        made.lost.append(Phrase("lost block on nothing", name="".join(ends)))
        return
    angle, through, on = line.angle, line.place, FRAME
    if not line.grounded:
        start, end = map(made.place, line.ends)
        angle, through, on = cmath.phase(end - start), start, links[line.carrier]
    else:  # in thousandths of a radian: it is taken for the whole degrees that it may be
        whole = math.radians(round(math.degrees(angle)))
        angle = whole if abs(whole - angle) <= HALF_A_THOUSANDTH else angle
    point = made.names[pin.id]
    holders = [name for name in made.having(point) if name not in (FRAME, on)]
    block = holders[0] if pin.welded and holders else made.body("".join(ends), [pin.id])
    made.slides.append(BodySlide(block, point, on, through, angle))
    if line.driven:
        made.drive(block, rate, point)


# pyslvs


def read_pyslvs(text: str, title: str) -> Bodies:
    """The bodies of an expression or a project.  Raises CallError for a text without a readable one."""
    plain = re.sub(r"#\[[\s\S]*?#\][^\n]*|#[^\n]*", "", text)
    begin = re.search(r"\bM\s*\[", plain)
    if begin is None:
        raise CallError.of(title, "holds no expression m", "copy the expression from pyslvs")
    inner, end = _inside(plain, begin.end(), title)
    made, known = Bodies(title), dict[str, str]()
    rest = _JOINT.sub("", inner)
    if re.sub(r"[\s,]+", "", rest):
        raise CallError.of(title, "is no joint", "write j r p 0 0 l ground", joint=rest.strip(" ,")[:60])
    for kind, angle, x, y, links in _JOINT.findall(inner):
        names = tuple(filter(None, (n.strip() for n in links.split(","))))
        if not names:
            raise CallError.of(title, "the joint at has no link", "write l ground link_1", value=x, other=y)
        place, turn = complex(float(x), float(y)), math.radians(float(angle or 0))
        _join(made, known, f"P{len(made.places)}", kind, place, names, turn)
    made.bodies.setdefault(FRAME, [])
    points = list(made.places)
    driven = re.compile(r"base\W+(\d+)\D+?drive\W+(\d+)")
    pairs = driven.findall(plain, end) or driven.findall(plain, 0, begin.start())
    if not pairs and len(re.findall(r"\bM\s*\[", plain)) == 1:
        pairs = _first_crank(made)
    for base, drive in pairs:
        ends = [points[int(k)] for k in (base, drive) if int(k) < len(points)]
        lost = Phrase("lost input from", base=base, drive=drive)
        if len(ends) == 2:
            made.turn(ends, INPUT_SPEED, lost)
        else:
            made.lost.append(lost)
    return made


def _inside(text: str, begin: int, title: str) -> tuple[str, int]:
    """The content of the brackets that open before ``begin``, and the place where they close."""
    depth = 1
    for k in range(begin, len(text)):
        depth += {"[": 1, "]": -1}.get(text[k], 0)
        if not depth:
            return text[begin:k], k + 1
    raise CallError.of(title, "a bracket is not closed", "copy the whole expression")


def _first_crank(made: Bodies) -> list[tuple[str, str]]:
    """The first bar about a fixed pivot, the driver of a file that names none."""
    points = list(made.places)
    for name, held in made.bodies.items():
        fixed = [p for p in held if p in made.bodies[FRAME]]
        free = [p for p in held if p not in made.bodies[FRAME]]
        if name != FRAME and fixed and free:
            return [(str(points.index(fixed[0])), str(points.index(free[0])))]
    return []


def write_pyslvs(bodies: Bodies) -> str:
    """The expression of bodies; parts that it cannot hold are added to ``lost`` or ``left``."""
    joints = []

    def joint(kind: str, place: complex, names: Iterable[str], angle: float | None = None) -> None:
        turned = "" if angle is None else f", A[{number(math.degrees(angle))}]"
        links = ", ".join("ground" if n == FRAME else f"link_{n}" for n in names)
        joints.append(f"J[{kind}{turned}, P[{number(place.real)!r}, {number(place.imag)!r}], L[{links}]]")

    for point, place in bodies.places.items():
        holders = bodies.having(point)
        slots = [s for s in bodies.slides if s.point == point and s.turns]
        bodies.lost += [Phrase("lost slide", link=s.body, on=s.on) for s in slots[1:]]
        kept = [s for s in bodies.slides if s.point == point and not s.turns]
        if slots:
            joint("RP", place, [slots[0].on, *(n for n in holders if n != slots[0].on)], slots[0].angle)
        elif len(holders) > 1 or not kept:
            joint("R", place, holders)
        for slide in kept:
            joint("P", place, [slide.on, slide.body], slide.angle)
    bodies.left += [Phrase("lost unit", unit=bodies.unit)] if bodies.unit != "mm" else []
    text = "M[" + ", ".join(joints) + "]\n"
    driven = {body for body, _ in read_pyslvs(text, bodies.title).drives}  # it names no input
    bodies.lost += [Phrase("lost driver of", link=body) for body, _ in bodies.drives if f"link{body}" not in driven]
    bodies.left += [Phrase("lost speed", link=body) for body, _ in bodies.drives]
    return text
