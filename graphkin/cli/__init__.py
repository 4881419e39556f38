"""The command line: every command is a thin call of the public function of the same name."""

from __future__ import annotations

from graphkin.cli.commands import app, main

__all__ = ["app", "main"]
