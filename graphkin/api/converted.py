"""``graphkin convert``: mechanisms of other programs as scenes, and scenes for them."""

from __future__ import annotations

import cmath
import os
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from graphkin.api.arguments import as_scene
from graphkin.api.results import Result
from graphkin.errors import CallError, Problem, Unsolvable
from graphkin.exchange import FRAME, READ, Bodies, BodySlide, is_address, read_bodies, write_bodies
from graphkin.files import Json, path_of, write_files
from graphkin.scene.model import Mechanism
from graphkin.scene.pairs import told
from graphkin.scene.scene import Scene, SceneLike, safe_name, toml_text, written
from graphkin.table import Table
from graphkin.words import Phrase, Wording


@dataclass(frozen=True, repr=False, eq=False)
class Converted(Result):
    """A mechanism in another form: ``files`` by name, the ``scene``, and the parts that could not be carried over
    (``left``)."""

    scene: Scene
    ending: str
    text: str
    left: tuple[Wording, ...]

    @property
    def ok(self) -> bool:
        """Whether all parts were carried over."""
        return not self.left

    @property
    def files(self) -> Mapping[str, bytes]:
        """The converted file by its name."""
        return {f"{safe_name(self.scene.name)}{self.ending}": self.text.encode()}

    @property
    def data(self) -> dict[str, Json]:
        """The scene as a mapping, and the parts left out."""
        return {"scene": self.scene.to_dict(), "left": list(map(str, self.left))}

    @cached_property
    def table(self) -> Table:
        """A row for each moving link: its points, its length, its guide."""
        rows = []
        for name, link in self.scene.links.items():
            on = [link.on] if isinstance(link.on, str) else list(link.on or ())
            rows.append((name, " ".join((*link.points, *link.at)), link.length, " ".join(on)))
        return Table.of(("link", "points", "length", "on"), rows)

    @property
    def name(self) -> str:
        return self.scene.name

    def __repr__(self) -> str:
        return f"<Converted {self.scene.name}: {len(self.scene.links)} moving links, {len(self.left)} left out>"


def convert(source: SceneLike, *, lossy: bool = False, out: str | os.PathLike[str] | None = None) -> Converted:
    """Make a scene of another program's mechanism, or give a scene to another program.

    Read are PMKS (its table of joints), PMKS+ (a shared link), Linkage (.linkage2), pyslvs (an expression, .pyslvs),
    pylinkage (.json) and GeoGebra (.ggb); written Linkage, pyslvs and pylinkage, at the scene's own position.

    Parameters
    ----------
    source : a file of another program, a shared link, or a scene in any of its forms
    out : the file to write, its form by the ending of its name: .toml, .linkage2, .pyslvs or .json
    lossy : leave out parts that move, drive or load and cannot be carried over

    Raises
    ------
    CallError : the file's program is unknown, it holds no mechanism, ``out`` cannot be written, or a part that moves,
        drives or loads would be lost
    SceneError : its content is no mechanism
    Unsolvable : a scene that cannot be assembled has no position to write

    Examples
    --------
    >>> four_bar = convert("fourbar-150-500-300-400")
    >>> four_bar.left
    ()
    """
    target = None if out is None else path_of(out)
    ending = ".toml" if target is None else target.suffix.lower()
    shown = os.fspath(source) if isinstance(source, str | os.PathLike) else ""
    kind = Path(shown[:200]).suffix.lower()
    foreign = kind in READ or "://" in shown or is_address(shown) or (kind != ".toml" and os.path.isfile(shown))
    if foreign:
        bodies = read_bodies(shown)
        _all_kept(bodies, lossy)
        mapping = bodies.scene()
        _all_kept(bodies, lossy)
        scene = Scene.of(mapping, safe_name(bodies.title))
    else:
        given = as_scene(source)
        scene = source if isinstance(source, Scene) else Scene.of(written(source)[0], given.name)
        bodies = Bodies(given.question.title) if ending == ".toml" else _bodies(given)
    text = toml_text(scene.to_dict()) if ending == ".toml" else write_bodies(bodies, ending)
    _all_kept(bodies, lossy)
    made = Converted(scene, ending, text, (*bodies.lost, *bodies.left))
    if target is not None:
        write_files(target.parent, {target.name: text.encode()})
    return made


def _all_kept(bodies: Bodies, lossy: bool) -> None:
    """Raises CallError naming the parts that move, drive or load and would be lost."""
    if bodies.lost and not lossy:
        said = "would be lost", "with lossy lossy true it is left out"
        raise CallError(*(Problem(part, *said) for part in bodies.lost))


def _bodies(scene: Mechanism) -> Bodies:
    """The bodies of a scene at its own position, in its length unit."""
    from graphkin import solver

    motion = solver.solve(scene)
    if not motion.ok[0]:
        raise Unsolvable(str(motion.status[0]), Problem(scene.question.title, motion.reasons[0]))
    unit = scene.units.metres
    made = Bodies(scene.question.title, unit=scene.units.length)
    for point, place in scene.frame.points.items():
        made.point(point, place / unit)
    for ref, name in solver.listed_points(scene, motion.slides):
        if not ref.link and ref.point not in made.places:
            made.point(ref.point, complex((motion.point(ref.point, name).z / unit)[0]))
    made.body(FRAME, scene.frame.points)
    poses = {scene.frame.name: (0j, 1 + 0j)}
    for link in scene.links:
        if not link.redundant:
            made.body(link.name, link.points)
        first, turn = next(iter(link.points), None), cmath.rect(1.0, float(motion.angle(link.name)[0]))
        poses[link.name] = (0j if first is None else made.places[first]), turn
    for pair in scene.slides:
        if not pair.pin:
            made.lost.append(Phrase("lost slide without point", link=pair.body, on=pair.b))
            continue
        line = pair.guide
        origin, turn = poses[pair.b]
        through, angle = origin + turn * line.through / unit, cmath.phase(turn * line.direction)
        body, base = (FRAME if link == scene.frame.name else link for link in (pair.body, pair.b))
        made.slides.append(BodySlide(body, pair.pin, base, through, angle, bool(pair.of)))
    made.lost += [told(pair, "left behind") for pair in scene.higher_pairs]
    made.lost += [Phrase("lost redundant link", link=link.name) for link in scene.links if link.redundant]
    made.lost += [Phrase("lost mass", link=mass.link) for mass in scene.loading.masses]
    made.lost += [Phrase("lost load", name=load.name) for load in scene.loading.loads]
    made.lost += [Phrase(f"lost {spring.kind}", name=spring.name) for spring in scene.loading.springs]
    for driver in scene.drivers:
        if driver.law is not None:
            made.lost.append(Phrase("lost law", name=driver.key))
        if driver.turns_about(scene.frame.name):
            made.drive(driver.link, driver.rate)
            if driver.second and driver.law is None:
                made.lost.append(Phrase("lost acceleration", link=driver.link))
        else:
            made.lost.append(Phrase("lost driver", name=driver.key))
    return made
