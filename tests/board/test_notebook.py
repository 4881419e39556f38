"""The board as a widget of a notebook."""

from __future__ import annotations

import pytest

import graphkin
from graphkin.scene.scene import library_text

pytest.importorskip("anywidget", reason="the extra live is not installed")
pytestmark = pytest.mark.quick


@pytest.fixture
def board():
    widget = graphkin.open_board("sixbar-420rpm")
    widget.told = []
    widget.send = widget.told.append
    return widget


def test_the_widget_begins_with_the_text_of_the_scene_and_answers_its_page(board) -> None:
    board._handle_custom_msg({"do": "open", "id": 1}, [])
    board._handle_custom_msg({"do": "show", "id": 2, "text": board.text, "figures": ["velocity"]}, [])
    assert library_text("sixbar-420rpm") == board.text == board.told[0]["text"]
    assert [1, 2] == [told["id"] for told in board.told]
    assert board.told[1]["agrees"]


def test_a_defect_of_an_answer_is_told_to_the_page_of_the_widget(board, monkeypatch) -> None:
    monkeypatch.setattr("graphkin.board.server.answer", lambda *_: 1 / 0)
    board._handle_custom_msg({"do": "open", "id": 1}, [])
    assert [(1, "Defect")] == [(told["id"], told["kind"]) for told in board.told]


def test_a_scene_in_any_of_its_forms_is_shown() -> None:
    assert "[links.2]" in graphkin.open_board(graphkin.read("whitworth")).text
    assert "" == graphkin.open_board().text


def test_a_scene_that_is_not_there_is_refused() -> None:
    with pytest.raises(graphkin.SceneError, match="no scene of this name"):
        graphkin.open_board("nothing")
