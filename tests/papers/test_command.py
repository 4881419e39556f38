from __future__ import annotations

import json

import pytest
from pypdf import PdfReader

import graphkin
from tests import command
from tests.scenes import four_bar


def run(*args, cwd):
    return command.run("handout", *args, cwd=cwd)


def test_the_command_writes_eight_files_and_nothing_else(tmp_path):
    done = run("slotter-75-150", "-o", "out", "--lang", "both", "--positions", "2", cwd=tmp_path)
    names = {str(p.relative_to(tmp_path)) for p in tmp_path.rglob("*") if p.is_file()}
    expected = {"problem.html", "handout.html", "problem.pdf", "solution.pdf", "key.html", "key.pdf", "key.csv"}
    expected |= {"answers_template.csv"}
    assert {f"out/{name}" for name in expected} == names
    assert 0 == done.returncode, done.stderr


def test_the_key_is_printed_for_programs(tmp_path):
    done = run("slotter-75-150", "--format", "pdf", "--json", cwd=tmp_path)
    assert "v_B" in {row["symbol"] for row in json.loads(done.stdout)["key"]}


def test_every_wrong_word_of_a_call_is_said(tmp_path):
    done = run("slotter-75-150", "--format", "doc", "--lang", "fr", "--convention", "x", cwd=tmp_path)
    assert 2 == done.returncode
    assert 3 == done.stderr.count("graphkin: ")


def test_a_set_has_a_sheet_and_a_key_for_each_problem_and_one_table(tmp_path):
    done = run("slotter-75-150", "--variants", "2", "--seed", "7", "--workers", "1", "-o", "set", cwd=tmp_path)
    names = sorted(p.name for p in (tmp_path / "set").iterdir())
    assert 0 == done.returncode, done.stderr
    assert 2 == sum(name.endswith("problem.pdf") for name in names) == sum(name.endswith("key.pdf") for name in names)
    assert "answers.csv" in names
    for paper in ("problem", "key"):  # all of them, to print at once
        pages = [len(PdfReader(path).pages) for path in sorted((tmp_path / "set").glob(f"*-{paper}.pdf"))]
        assert sum(pages) == len(PdfReader(tmp_path / "set" / f"{paper}s" / f"all-{paper}s.pdf").pages)


def test_another_position_gives_another_key():
    one, two = (graphkin.handout("slotter-75-150", at=at, formats=("pdf",)).key for at in (30, 60))
    assert [r.symbol for r in one] == [r.symbol for r in two]
    assert [r.exact for r in one] != [r.exact for r in two]


def test_the_room_is_called_as_its_function():
    import graphkin.papers.blocks

    assert graphkin.handout("slotter-75-150", formats=("pdf",)).ok


def test_a_mechanism_that_cannot_be_assembled_is_refused():
    apart = four_bar(150, 100, 100, 400, driver={"link": "1", "angle": 120, "omega": 10})
    with pytest.raises(graphkin.Unsolvable, match="2, 3"):
        graphkin.handout(apart)
