"""Where a scene comes from, and that nothing which is no scene gives more than a sentence."""

from __future__ import annotations

import os
import sys
import tomllib
from pathlib import Path

import pytest

from graphkin.errors import SceneError
from graphkin.scene import library, library_text, mechanism_of, mechanism_of_text
from graphkin.scene import scene as texts
from tests.command import run

from .scenes import FOUR_BAR

pytestmark = pytest.mark.quick


def sentence(source: object) -> str:
    with pytest.raises(SceneError) as error:
        mechanism_of(source)  # type: ignore[arg-type]
    return str(error.value)


def sentence_of_text(text: str) -> str:
    with pytest.raises(SceneError) as error:
        texts.parsed(text)
    return str(error.value)


def test_a_file_is_named_by_its_stem(tmp_path: Path) -> None:
    (tmp_path / "my bar.toml").write_text(FOUR_BAR)
    assert mechanism_of(tmp_path / "my bar.toml").name == "my-bar"


def test_a_path_may_be_a_text(tmp_path: Path) -> None:
    (tmp_path / "bar.toml").write_text(FOUR_BAR)
    assert mechanism_of(str(tmp_path / "bar.toml")) == mechanism_of_text(FOUR_BAR, "bar")


def test_a_mapping_is_what_the_parser_gives() -> None:
    assert mechanism_of(tomllib.loads(FOUR_BAR)) == mechanism_of_text(FOUR_BAR, "scene")


def test_links_of_a_mapping_may_be_named_by_integers() -> None:
    raw = tomllib.loads(FOUR_BAR)
    raw["links"] = {int(name): link for name, link in raw["links"].items()}
    assert mechanism_of(raw) == mechanism_of_text(FOUR_BAR, "scene")


def test_the_mapping_is_not_changed() -> None:
    raw = tomllib.loads(FOUR_BAR + "[nonsense]\n")
    sentence(raw)
    assert raw == tomllib.loads(FOUR_BAR + "[nonsense]\n")


@pytest.mark.parametrize("name", library())
def test_every_scene_that_comes_along_is_read(name: str) -> None:
    assert mechanism_of(name).name == name


def test_the_library_is_sorted_and_has_the_worked_example() -> None:
    assert list(library()) == sorted(library())
    assert "sixbar-guide-40deg" in library()


def test_a_directory_of_the_same_name_does_not_hide_a_scene(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "scotch-yoke").mkdir()
    monkeypatch.chdir(tmp_path)
    assert mechanism_of("scotch-yoke").name == "scotch-yoke"


def test_a_misspelt_scene_is_answered_with_the_nearest() -> None:
    assert 'did you mean "scotch-yoke"?' in sentence("scoth-yoke")


def test_a_misspelt_scene_has_no_text() -> None:
    with pytest.raises(SceneError, match="scotch-yoke"):
        library_text("scoth-yoke")


@pytest.mark.parametrize("name", ["../secret", "a/b", "", "..", "/etc/passwd"])
def test_only_names_of_the_library_are_texts_of_the_library(name: str) -> None:
    with pytest.raises(SceneError):
        library_text(name)


def test_a_file_that_is_not_there_is_named(tmp_path: Path) -> None:
    assert "gone.toml: there is no such file" in sentence(str(tmp_path / "gone.toml"))


def test_a_directory_is_no_scene(tmp_path: Path) -> None:
    assert "is a directory" in sentence(str(tmp_path))


def test_bytes_that_are_no_text_are_named_by_line(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_bytes(b"title = 'x'\ntitle_zh = '\xff\xfe'\n")
    assert "line 2: is not UTF-8" in sentence(tmp_path / "x.toml")


def test_a_binary_file_is_one_sentence(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_bytes(bytes(range(256)) * 4)
    assert len(sentence(tmp_path / "x.toml").splitlines()) == 1


def test_a_file_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_bytes(b"\xef\xbb\xbf" + FOUR_BAR.encode())
    assert mechanism_of(tmp_path / "x.toml").question.title == "Four-bar"


def test_an_empty_file_has_no_links(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_text("")
    assert "links: is missing" in sentence(tmp_path / "x.toml")


def test_a_large_file_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "x.toml").write_bytes(b"# " + b"x" * 1_000_000)
    assert "larger than 1000 kB" in sentence(tmp_path / "x.toml")


@pytest.mark.parametrize("source", ["\0", "x" * 5000, "a\ud800.toml", None, 3, b"x", ["a"], "", ".", "title = 1\n"])
def test_what_cannot_be_a_scene_is_one_sentence(source: object) -> None:
    assert len(sentence(source).splitlines()) == 1


SYNTAX = {
    "title = \n": "line 1",
    'title = "a"\n[links\n': "line 2",
    "title = Four\n": "line 1",
    'a = 1\nb = "x\n': "line 2",
    "[links.1]\n[links.1]\n": "line 2",
    "[driver]\nomega = 1\nomega = 2\n": "line 3",
    "a = [1,\n": "line",
    "a = " + "[" * 3000: "nested",
    "a = " + "9" * 5000: "not TOML",
    "\x00": "line 1",
    "points = [A, B]": "quotation marks",
    "length = 12,5": "numbers with a point",
    'points = [“A”, “B”]': "not “",
    'a = 1\nframe = {\n  name = "6" }': "on one line",
}


@pytest.mark.parametrize("text", SYNTAX)
def test_what_is_not_toml_is_named_by_line(text: str) -> None:
    with pytest.raises(SceneError) as error:
        mechanism_of_text(text, "x")
    assert SYNTAX[text] in str(error.value)


def test_deep_tables_are_one_sentence() -> None:
    with pytest.raises(SceneError, match="nested"):
        mechanism_of_text("[" + ".".join("a" * 50) + "]", "x")


PIPE_SCENES = {
    "scene": "",
    "background": '[sheet]\nbackground = { file = "pipe", points = { A = [0, 0], D = [9, 9] } }\n',
    "scans": '[scans.velocity]\nfile = "pipe"\npoints = { a = [0, 0], b = [9, 9] }\nread = { c = [1, 1] }\n',
    "printed_table": '[printed_table]\nfile = "pipe"\n',
}


@pytest.mark.skipif(sys.platform == "win32", reason="pipes of POSIX")
@pytest.mark.parametrize("table", PIPE_SCENES)
def test_a_pipe_instead_of_a_file_is_told_and_not_waited_for(table: str, tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    path = tmp_path / ("pipe" if table == "scene" else "scene.toml")
    if table != "scene":
        path.write_text(FOUR_BAR + PIPE_SCENES[table])
    answer = run("audit", str(path))
    assert 2 == answer.returncode
    assert "cannot be read: it is a pipe or a device, no file" in answer.stderr


@pytest.mark.parametrize(
    "text",
    [
        f"x{'.a' * 40} = 1", f"x{' . a' * 40} = 1", f"[x{'.a' * 40}]",
        f"x = {{ y{'.a' * 40} = 1 }}", "x = " + "[" * 40,
        f"x = {'{ a = ' * 40}1{' }' * 40}", f's = """\n" ]] \'\n"""\nx{".a" * 40} = 1',
        f'x{"."}"a"' + '."a"' * 40 + " = 1",
    ],
)
def test_what_is_nested_deeply_is_not_parsed(text: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(texts.tomllib, "loads", None)
    assert "the file: is nested too deeply" in sentence_of_text(text)


@pytest.mark.parametrize(
    "text",
    [
        f'title = "{"a." * 40}{"[" * 40}"',
        f"title = '{'a.' * 40}'", f"# {'a.' * 40}{'[' * 40}", f"x = [{'1.5, ' * 40}1]",
        f"x = [\n{'  [1, 2],' * 40}\n]", f'x = """\n{"[" * 40}\\"""\n{"a." * 40}"""',
        "x = 'a\\'\ny = '" + "[" * 40 + "'",
        f"x = \"\\\"{'[' * 40}\"",
    ],
)
def test_dots_and_brackets_in_texts_and_remarks_are_no_depth(text: str) -> None:
    assert tomllib.loads(text) == texts.parsed(text)


def test_a_mapping_that_holds_itself_is_one_sentence() -> None:
    raw: dict[str, object] = {}
    raw["links"] = raw
    assert "nested" in sentence(raw)


def test_too_many_values_are_one_sentence() -> None:
    assert "more than 20000 values" in sentence({"find": ["v_B"] * 30000})


@pytest.mark.parametrize(("stem", "name"), [
    ("../x", "x"), ("a b", "a-b"), ("摆动导杆", "摆动导杆"), ("...", "scene"), ("a/../b", "a-..-b"),
    ("x" * 300, "x" * 60),
])
def test_a_scene_is_named_so_that_a_folder_can_be(stem: str, name: str) -> None:
    assert mechanism_of_text(FOUR_BAR, stem).name == name
