"""``graphkin explain``: what was understood of a scene, in words."""

from __future__ import annotations

import typer

from graphkin.cli.options import JsonOption, LangOption, SceneArgument
from graphkin.cli.output import print_json, tell

__all__ = ["explain"]


def explain(scene: SceneArgument, lang: LangOption = None, as_json: JsonOption = False) -> None:
    """Say in words what was understood: links, joints, mobility, drivers, groups, assembly, units."""
    from graphkin.api.explained import explain as explaining

    explained = explaining(scene, lang)
    if as_json:
        print_json(explained.data)
    else:
        tell(explained.text)
    if not explained.ok:
        tell(f"graphkin: {explained.why}", err=True)
        raise typer.Exit(3)
