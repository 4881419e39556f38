"""``graphkin scenes``: what comes along, and the schema of scene files."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Annotated

import typer

from graphkin.cli.options import JsonOption
from graphkin.cli.output import print_json, print_paths, print_table
from graphkin.errors import CallError, Problem

__all__ = ["scenes"]


def scenes(
    name: Annotated[str | None, typer.Argument(help="A scene that comes along: print its text.")] = None,
    file: Annotated[
        Path | None, typer.Argument(help="With --copy: where to write it; NAME.toml here if not given.")
    ] = None,
    copy: Annotated[bool, typer.Option("--copy", help="Write the scene out to start from.")] = False,
    schema: Annotated[
        bool, typer.Option("--schema", help="Print the JSON schema of scene files, for editors.")
    ] = False,
    as_json: JsonOption = False,
) -> None:
    """List the scenes that come along, print one, or copy one out."""
    from graphkin import scene as room

    if schema:
        typer.echo(json.dumps(room.schema(), ensure_ascii=False, indent=2))
    elif name is not None:
        text = room.library_text(name)
        if copy:
            _write_new(file or Path(f"{name}.toml"), text)
        else:
            typer.echo(text, nl=False)
    elif copy:
        raise CallError(Problem("--copy", "no scene is named", "write graphkin scenes NAME --copy"))
    else:
        _list(as_json)


def _list(as_json: bool) -> None:
    from graphkin.api import scenes as listed

    found = listed()
    if as_json:
        print_json(found.data)
    else:
        print_table(["scene", "title", "", "F"], [[n, t, z, str(f)] for n, t, z, f in found.rows])


def _write_new(path: Path, text: str) -> None:
    if path.exists():
        raise CallError(Problem(str(path), "a file of that name is there already", "name another file"))
    try:
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        raise CallError(Problem(str(path), f"cannot be written: {error.strerror}")) from None
    print_paths([path])
