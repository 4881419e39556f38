"""Commands on the files of scenes: ``scenes`` that come along, new ones, and the schema; ``explain``, what was
understood of one; ``convert``, from and for other programs; ``open``, on the drawing board as a local page."""

from __future__ import annotations

import json
import os
import sys
from contextlib import suppress
from pathlib import Path

import typer

from graphkin.cli.options import Given, command, named_numbers
from graphkin.cli.output import complain, print_json, print_paths, print_table, tell
from graphkin.errors import CallError, Problem
from graphkin.words import from_others

__all__ = ["convert", "explain", "open_page", "scenes"]


@command("name", "file", "copy", "schema", "new", "set of new", "lang", "json")
def scenes(given: Given) -> None:
    """List the scenes that come along, print one, copy one out, or begin a new one."""
    from graphkin import scene as room

    if given.new is not None:
        # the one name that is given is that of the file
        _begin(given.new, given.set or [], Path(given.name) if given.name is not None else given.file)
    elif given.schema:
        typer.echo(json.dumps(room.schema(), ensure_ascii=False, indent=2))
    elif given.name is not None:
        text = room.library_text(given.name)
        if given.copy:
            _write_new(given.file or Path(f"{given.name}.toml"), text)
        else:
            typer.echo(text, nl=False)
    elif given.copy:
        raise CallError.of("--copy", "no scene is named", "write graphkin scenes name copy")
    else:
        _list(given.lang, given.json)


def _begin(kind: str, lengths: list[str], file: Path | None) -> None:
    """A new scene: what is not given is asked for in a terminal, and the usual elsewhere."""
    from graphkin.scene.scene import NEW, new_scene

    def wrong(text: str, number: str) -> Problem:
        return Problem(f"--set {text}", "is no number", "write set crank 150", number=number)

    values = named_numbers(lengths, wrong)
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
    _must_be_new(path)
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CallError.of(str(path), "cannot be written", reason=from_others(error.strerror or str(error))) from None
    print_paths([path])


def _must_be_new(path: Path) -> None:
    """Raises CallError where a file of that name is there."""
    if path.exists():
        raise CallError.of(str(path), "a file of that name is there already", "name another file")


@command("scene", "lang", "json")
def explain(given: Given) -> None:
    """Say in words what was understood: links, joints, mobility, drivers, groups, assembly, units."""
    from graphkin.api.explained import explain as explaining

    explained = given.call(explaining)
    if given.json:
        print_json(explained.data)
    else:
        tell(explained.text)
    if not explained.ok:
        complain(explained.why)
        raise typer.Exit(explained.exit_code)


@command("source", "out of convert", "lossy", "json", "quiet")
def convert(given: Given) -> None:
    """Make a scene of another program's mechanism, or give a scene to another program."""
    from graphkin.api.converted import convert as converting

    if given.out is not None:
        _must_be_new(given.out)
    made = converting(given.source, out=given.out, lossy=given.lossy)
    if given.json:
        print_json(made.data)
    elif given.out is None:
        typer.echo(made.text, nl=False)
    elif not given.quiet:
        print_paths([given.out])
    for thing in made.left:
        tell(f"graphkin: not carried over: {thing}", err=True)


@command("scene of open", "port", "browser")
def open_page(given: Given) -> None:
    """Edit a mechanism in the browser: text, form and figures together; drag points, build from nothing, print papers.

    The page is for this machine alone and lives until it is interrupted (Ctrl-C).
    """
    from graphkin.board.answers import LINK, Desk, text_of_link
    from graphkin.board.server import Address, needs_live, serve
    from graphkin.board.shelf import Shelf

    needs_live()
    if given.scene.startswith(LINK):
        desk = Desk(text=text_of_link(given.scene))
    else:
        shelf, first = Shelf.of(given.scene)
        desk = Desk(shelf, first)

    def ready(address: Address) -> None:
        tell(f"{address.url}\nCtrl-C ends it")
        if given.browser:
            import webbrowser

            webbrowser.open(address.url)

    with suppress(KeyboardInterrupt):  # which is how it ends
        serve(desk, given.port, ready)
