"""Examples in docstrings and in the README do what they say."""

from __future__ import annotations

import doctest
import pkgutil
import re
from importlib import import_module
from pathlib import Path

import pytest

import graphkin

ROOT = Path(__file__).parent.parent
MODULES = ["graphkin", *(m.name for m in pkgutil.walk_packages(graphkin.__path__, "graphkin."))]
README = ROOT / "README.md"


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_are_true(name):
    found = doctest.testmod(import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert 0 == found.failed


def test_examples_in_the_readme_are_true(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = README.read_text(encoding="utf-8")
    blocks = "\n".join(re.findall(r"```pycon\n(.*?)```", text, flags=re.S))
    test = doctest.DocTestParser().get_doctest(blocks, {}, "README", str(README), 0)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert 0 == runner.run(test).failed


def test_files_named_in_the_readme_are_there():
    text = README.read_text(encoding="utf-8")
    links = [t for t in re.findall(r"\]\(([^)#]+)\)", text) if "://" not in t]
    assert [] == [t for t in links if not (ROOT / t).exists()]
