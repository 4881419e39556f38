"""``graphkin scenes``: what comes along, new ones, and the schema of scene files; what is done with the file of a
scene: ``explain``, what was understood of it, ``convert``, from and for other programs, ``open``, on the drawing board
as a local page."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import JsonOption, LangOption, QuietOption, SceneArgument
from graphkin.cli.output import complain, print_json, print_paths, print_table, tell
from graphkin.errors import CallError, Problem
from graphkin.words import Phrase, from_others

__all__ = ["convert", "explain", "open_page", "scenes"]


def scenes(
    name: Annotated[str | None, typer.Argument(help="A scene that comes along: print its text.")] = None,
    file: Annotated[
        Path | None, typer.Argument(help="With --copy: where to write it; NAME.toml here if not given.")
    ] = None,
    copy: Annotated[bool, typer.Option("--copy", help="Write the scene out to start from.")] = False,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print the JSON schema of scene files, for editors.")
    ] = False,
    new: Annotated[
        str | None,
        typer.Option(
            "--new", metavar="KIND", help="A new commented scene: four-bar, slider-crank, guide-bar, ..."
        ),
    ] = None,
    given: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="NAME=VALUE", help="With --new: a length (crank=150); asked for otherwise."),
    ] = None,
    lang: LangOption = None,
    as_json: JsonOption = False,
) -> None:
    """List the scenes that come along, print one, copy one out, or begin a new one."""
    from graphkin import scene as room

    if new is not None:
        # the one name that is given is that of the file
        _begin(new, given or [], Path(name) if name is not None else file)
    elif schema:
        typer.echo(json.dumps(room.schema(), ensure_ascii=False, indent=2))
    elif name is not None:
        text = room.library_text(name)
        if copy:
            _write_new(file or Path(f"{name}.toml"), text)
        else:
            typer.echo(text, nl=False)
    elif copy:
        raise CallError(Problem("--copy", Phrase("no scene is named"), Phrase("write graphkin scenes name copy")))
    else:
        _list(lang, as_json)


def _begin(kind: str, given: list[str], file: Path | None) -> None:
    """A new scene: what is not given is asked for in a terminal, and the usual elsewhere."""
    from graphkin.scene.files import NEW, new_scene

    values: dict[str, float] = {}
    for text in given:
        name, _, number = text.partition("=")
        try:
            values[name.strip()] = float(number)
        except ValueError:
            raise CallError(
                Problem(f"--set {text}", Phrase("is no number", number=number), Phrase("write set crank 150"))
            ) from None
    new_scene(kind, values)
    if sys.stdin is not None and sys.stdin.isatty():
        for name, usual in NEW[kind].items():
            if name not in values:
                values[name] = typer.prompt(name, default=usual, type=float, err=True)
    made = new_scene(kind, values)
    if file is None:
        typer.echo(made, nl=False)
    else:
        _write_new(file, made)


def _list(lang: str | None, as_json: bool) -> None:
    from graphkin.api.arguments import known_words
    from graphkin.api.scene_list import scenes as listed
    from graphkin.words import word

    known_words(language=lang)
    found, language = listed(), lang or _spoken_here()
    if as_json:
        print_json(found.data)
        return
    heads = [word(head, language) for head in ("scene in a list", "title in a list")]
    rows = [[n, z if language == "zh" else t, str(f)] for n, t, z, f in found.rows]
    print_table([*heads, "F"], rows, right=(2,))


def _spoken_here() -> str:
    """The language of the terminal: Chinese where its locale is, else English."""
    locale = next((value for name in ("LC_ALL", "LC_MESSAGES", "LANG") if (value := os.environ.get(name))), "")
    return "zh" if locale.lower().startswith("zh") else "en"


def _write_new(path: Path, text: str) -> None:
    if path.exists():
        raise CallError(Problem(str(path), Phrase("a file of that name is there already"), Phrase("name another file")))
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CallError(
            Problem(str(path), Phrase("cannot be written", reason=from_others(error.strerror or str(error))))
        ) from None
    print_paths([path])


def explain(scene: SceneArgument, lang: LangOption = None, as_json: JsonOption = False) -> None:
    """Say in words what was understood: links, joints, mobility, drivers, groups, assembly, units."""
    from graphkin.api.explained import explain as explaining

    explained = explaining(scene, lang)
    if as_json:
        print_json(explained.data)
    else:
        tell(explained.text)
    if not explained.ok:
        complain(explained.why)
        raise typer.Exit(explained.exit_code)


def convert(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE", help="A file of Linkage, pyslvs, pylinkage, GeoGebra or PMKS, a link of PMKS+, or a scene."
        ),
    ],
    out: Annotated[
        Path | None,
        typer.Option(
            "-o", "--out", metavar="FILE", help="What to write: .toml, .linkage2, .pyslvs, .json; printed if not given."
        ),
    ] = None,
    lossy: Annotated[bool, typer.Option("--lossy", help="Leave out what cannot be carried over, and name it.")] = False,
    as_json: JsonOption = False,
    quiet: QuietOption = False,
) -> None:
    """Make a scene of another program's mechanism, or give a scene to another program."""
    from graphkin.api.converted import convert as converting

    if out is not None and out.exists():
        raise CallError(Problem(str(out), Phrase("a file of that name is there already"), Phrase("name another file")))
    made = converting(source, out, lossy)
    if as_json:
        print_json(made.data)
    elif out is None:
        typer.echo(made.text, nl=False)
    elif not quiet:
        print_paths([out])
    for thing in made.left:
        tell(f"graphkin: not carried over: {thing}", err=True)


def open_page(
    scene: Annotated[str, typer.Argument(help="A scene file, a folder of them, a scene that comes along, or a link.")]
    = "",
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port to listen on; a free one if 0.")] = 0,
    browser: Annotated[bool, typer.Option(help="Open the page in the browser.")] = True,
) -> None:
    """Edit a mechanism in the browser: text, form and figures together; drag points, build from nothing, print papers.

    The page is for this machine alone and lives until it is interrupted (Ctrl-C).
    """
    from graphkin.board.answers import LINK, Desk, text_of_link
    from graphkin.board.server import Address, needs_live, serve
    from graphkin.board.shelf import Shelf

    needs_live()
    if scene.startswith(LINK):
        desk = Desk(text=text_of_link(scene))
    else:
        shelf, first = Shelf.of(scene)
        desk = Desk(shelf, first)

    def ready(address: Address) -> None:
        tell(f"{address.url}\nCtrl-C ends it")
        if browser:
            import webbrowser

            webbrowser.open(address.url)

    with suppress(KeyboardInterrupt):  # which is how it ends
        serve(desk, port, ready)
