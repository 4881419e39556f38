"""Examples in docstrings, in the README and in the manual do what they say."""

from __future__ import annotations

import doctest
import pkgutil
import re
import tomllib
from functools import cache
from importlib import import_module
from pathlib import Path

import jsonschema
import pytest

import graphkin
from graphkin.scene import schema
from graphkin.scene.designs import design_of
from tests import command

ROOT = Path(__file__).parent.parent
MODULES = ["graphkin", *(m.name for m in pkgutil.walk_packages(graphkin.__path__, "graphkin."))]
PAGES = {str(page.relative_to(ROOT)): page.read_text(encoding="utf-8")
         for page in (ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md")))}


def blocks(language: str) -> list[tuple[str, str]]:
    """The blocks of a language in all pages, each with its page; what a list indents is moved out."""
    fence = re.compile(rf"(?ms)^( *)```{language}\n(.*?)^ *```")
    return [(page, re.sub(f"(?m)^{indent}", "", block)) for page, text in PAGES.items()
            for indent, block in fence.findall(text)]


def commands() -> set[str]:
    """Every command line of the pages: in blocks, and between backticks."""
    lines = [line for _, block in blocks("sh") for line in block.splitlines()]
    spans = [span for text in PAGES.values() for span in re.findall(r"`([^`\n]+)`", text)]
    return {found[0].partition(" #")[0] for line in lines + spans if (found := re.search(r"\bgraphkin [a-z].*", line))}


def anchors(text: str) -> set[str]:
    """What a link after # may name: the headings, as a page of the web writes them."""
    headings = re.findall(r"(?m)^#+ (.*)$", text)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@cache
def help_of(name: str) -> str:
    done = command.run(*name.split(), "--help")
    assert 0 == done.returncode, done.stderr
    return done.stdout


@pytest.mark.parametrize("name", MODULES)
def test_examples_in_docstrings_are_true(name):
    found = doctest.testmod(import_module(name), optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert 0 == found.failed


def test_a_parameter_that_is_as_of_another_function_is_told_there():
    strange = []
    for name in graphkin.__all__:
        told = re.findall(r"(?m)^ *([\w, ]+) : as for `(\w+)`", getattr(graphkin, name).__doc__ or "")
        strange += [f"{name}: {key}" for keys, other in told for key in keys.split(", ")
                    if not re.search(rf"(?m)^ *(\w+, )*{key}(, \w+)* : (?!as for)", getattr(graphkin, other).__doc__)]
    assert [] == strange


@pytest.mark.parametrize("page", sorted({page for page, _ in blocks("pycon")}))
def test_examples_in_python_are_true(page, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    text = "\n".join(block for where, block in blocks("pycon") if where == page)
    test = doctest.DocTestParser().get_doctest(text, {}, page, page, 0)
    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert 0 == runner.run(test).failed


@pytest.mark.parametrize(("page", "block"), blocks("toml"))
def test_every_key_in_an_example_of_a_scene_is_one_of_the_format(page, block):
    tables = tomllib.loads(block)
    if "design" in tables:
        assert design_of(tables)
    elif "title" in tables:
        assert tables["title"] == graphkin.read(tables).title
    else:  # a part of a scene: only links are missing, if anything
        jsonschema.validate({"links": {"1": {}}, **tables}, schema())


def test_every_option_of_a_command_line_is_one_of_its_command():
    called = commands()
    strange = []
    for line in called:
        words = line.split()
        name = " ".join(words[1:3]) if words[1] == "study" else words[1]
        strange += [line for word in words if word.startswith("--") and word != "--help" and word not in help_of(name)]
    assert [] == strange
    assert {"draw", "check", "solve", "centres", "audit", "sweep", "handout", "design", "cam", "convert", "explain",
            "open", "scenes", "study"} == {line.split()[1] for line in called}


@pytest.mark.parametrize("page", PAGES)
def test_what_a_page_links_to_is_there(page):
    links = [link for link in re.findall(r"\]\(([^)]+)\)", PAGES[page]) if "://" not in link]
    missing = []
    for link in links:
        file, _, anchor = link.partition("#")
        target = ((ROOT / page).parent / file).resolve() if file else ROOT / page
        if not target.exists() or (anchor and anchor not in anchors(target.read_text(encoding="utf-8"))):
            missing.append(link)
    assert [] == missing


def test_the_readme_leads_to_every_page_of_the_manual():
    assert {page for page in PAGES if page != "README.md"} <= set(re.findall(r"\]\(([^)#]+)\)", PAGES["README.md"]))


def test_the_readme_has_200_lines_at_most():
    assert 200 >= len(PAGES["README.md"].splitlines())
