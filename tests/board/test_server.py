"""Who may talk to the page's server: nobody of another origin, without the secret, or with tricks in the path."""

from __future__ import annotations

import asyncio
import http.client
import json
import logging
import random
import socket
import threading
from concurrent.futures import ThreadPoolExecutor
from urllib.parse import urlsplit

import pytest

from graphkin.board.server import _FILES, LARGEST_MESSAGE, STATIC, Address, _answered, _run, application
from graphkin.board.shelf import Shelf
from graphkin.scene.scene import library_text
from tests.board.served import served, talking
from tests.command import run

pytest.importorskip("uvicorn", reason="the extra live is not installed")


@pytest.fixture(scope="module")
def url(tmp_path_factory):
    folder = tmp_path_factory.mktemp("board")
    (folder / "mine.toml").write_text(library_text("sixbar-420rpm"), encoding="utf-8")
    with served("mine.toml", cwd=folder) as (address, process):
        yield address
        assert process.poll() is None, "the server ended before its time"


def get(url: str, path: str, method: str = "GET", **headers: str) -> http.client.HTTPResponse:
    place = urlsplit(url)
    line = http.client.HTTPConnection(place.hostname, place.port, timeout=10)
    line.request(method, path, headers=headers)
    return line.getresponse()


def test_the_page_and_what_it_loads_come_from_this_machine_alone(url: str) -> None:
    found = get(url, urlsplit(url).path)
    policy = found.headers["Content-Security-Policy"]
    assert 200 == found.status
    assert "127.0.0.1" == urlsplit(url).hostname
    assert policy.startswith("default-src 'none'; script-src 'self'; ")
    assert "http:" not in policy.replace(f"http://{urlsplit(url).netloc}", "")
    for name in ("board.js", "board.css", "regular.ttf"):
        assert 200 == get(url, urlsplit(url).path + name).status


@pytest.mark.parametrize(
    ("path", "status"),
    [("{own}", 200), ("{own}board.js", 200), ("{own}no.js", 404), ("/wrong/", 403), ("/", 403)],
)
def test_no_answer_may_be_kept_guessed_at_or_shown_elsewhere(url: str, path: str, status: int) -> None:
    found = get(url, path.format(own=urlsplit(url).path))
    wanted = {
        "X-Content-Type-Options": "nosniff", "Cache-Control": "no-store", "Referrer-Policy": "no-referrer",
        "Cross-Origin-Resource-Policy": "same-origin", "Cross-Origin-Opener-Policy": "same-origin",
    }
    assert status == found.status
    assert wanted == {name: found.headers[name] for name in wanted}
    assert "frame-ancestors 'none'" in found.headers["Content-Security-Policy"]


@pytest.mark.parametrize("headers", [
    {"Origin": "http://evil.example"}, {"Host": "evil.example"}, {"Origin": "null"}, {"Host": "127.0.0.1"},
])
def test_calls_of_another_origin_or_host_are_refused(url: str, headers: dict[str, str]) -> None:
    assert 403 == get(url, urlsplit(url).path, **headers).status


@pytest.mark.parametrize("path", [
    "/", "/wrong/", "/wrong/board.js", "/..", "/favicon.ico", "/%2e%2e/%2e%2e/etc/passwd", "/" + "a" * 4000 + "/",
])
def test_without_the_secret_nothing_is_served(url: str, path: str) -> None:
    assert get(url, path).status in (403, 404)


@pytest.mark.parametrize("path", [
    "../server.py", "%2e%2e/server.py", "..%2fserver.py", "board.js/x", "x", "web/src/board.js",
])
def test_tricks_in_the_path_find_no_file(url: str, path: str) -> None:
    found = get(url, urlsplit(url).path + path)
    assert found.status in (403, 404)
    assert b"import" not in found.read()


@pytest.mark.parametrize("method", ["POST", "PUT", "DELETE"])
def test_nothing_is_posted(url: str, method: str) -> None:
    assert get(url, urlsplit(url).path, method).status in (403, 405)


@pytest.mark.parametrize(("path", "origin"), [
    ("talk", "http://evil.example"), ("talk", None), ("../wrong/talk", "own"),
])
def test_sockets_of_others_are_refused(url: str, path: str, origin: str | None) -> None:
    from websockets.exceptions import InvalidStatus
    from websockets.sync.client import connect

    place = urlsplit(url)
    own = f"http://{place.netloc}" if origin == "own" else origin
    address = f"ws://{place.netloc}/wrong/talk" if path.startswith("..") else f"ws://{place.netloc}{place.path}{path}"
    with pytest.raises(InvalidStatus), connect(address, origin=own, proxy=None):
        pass


def test_malformed_messages_get_a_sentence_and_the_server_lives_on(url: str) -> None:
    draw = random.Random(5)
    text = library_text("fourbar-150-500-300-400")
    whole = json.dumps({"do": "show", "text": text, "figures": [], "id": 1})
    with talking(url) as ask:
        for _ in range(200):
            kind = draw.randrange(4)
            if kind == 0:
                message = "".join(chr(draw.randrange(32, 0x2FF)) for _ in range(draw.randrange(60)))
            elif kind == 1:
                cut = draw.randrange(len(whole))
                message = whole[:cut] + chr(draw.randrange(32, 127)) + whole[cut + draw.randrange(3) :]
            elif kind == 2:
                message = json.dumps({"do": draw.choice(["show", "pull", "build", "change", "keep"]),
                                      "text": draw.choice([text, None, 5, "", "["]), "at": draw.choice([5, {"1": "x"}]),
                                      "step": [], "changes": {"a.b.c": {"d": [None]}}})
            else:
                message = "[" * draw.randrange(2000)
            told = ask(message)
            assert told["ok"] or all(problem["text"] for problem in told["problems"])
            assert "Defect" != told.get("kind")
        assert ask({"do": "show", "text": text, "figures": ["velocity"]})["ok"]


def test_a_message_that_is_too_long_ends_only_its_own_line(url: str) -> None:
    from websockets.exceptions import ConnectionClosed

    with pytest.raises(ConnectionClosed), talking(url) as ask:
        ask("x" * (LARGEST_MESSAGE + 1))
    with talking(url) as ask:
        assert ask({"do": "names"})["ok"]


def test_two_pages_on_one_file_lose_nothing(url: str) -> None:
    with talking(url) as one, talking(url) as other:
        first, second = one({"do": "open"}), other({"do": "open"})
        mine = {"do": "save", "name": "mine.toml", "text": first["text"] + "# one\n", "mark": first["mark"]}
        assert one(mine)["ok"]
        refused = other({"do": "save", "name": "mine.toml", "text": "# other\n", "mark": second["mark"]})
        assert "changed by somebody else" in refused["problems"][0]["text"]
        theirs = other({"do": "watch", "name": "mine.toml", "mark": second["mark"]})
        assert mine["text"] == theirs["changed"]


def test_the_served_script_is_built_from_the_sources_beside_it() -> None:
    from hashlib import sha256

    web = STATIC.parent / "web"
    if not web.is_dir():
        pytest.skip("the sources of the page are not installed")
    whole = sha256()
    for path in sorted((web / "src").iterdir(), key=lambda p: p.name):
        whole.update(path.name.encode() + path.read_bytes())
    whole.update((web / "package-lock.json").read_bytes())
    assert whole.hexdigest() in (STATIC / "board.js").read_text(encoding="utf-8")[:200]


def test_a_file_that_is_not_there_is_said_before_anything_is_served(tmp_path) -> None:
    found = run("open", "nothing.toml", cwd=tmp_path)
    assert (2, "") == (found.returncode, found.stdout)
    assert "there is no such file" in found.stderr


def test_a_port_that_is_taken_is_said(url: str, tmp_path) -> None:
    found = run("open", "--port", str(urlsplit(url).port), "--no-browser", cwd=tmp_path)
    assert 2 == found.returncode
    assert "cannot be used" in found.stderr


def test_a_server_tells_its_defects_but_nothing_of_answers_that_its_end_cuts_off(monkeypatch, capsys) -> None:
    def ask() -> None:
        call = http.client.HTTPConnection("127.0.0.1", address.port)
        call.request("GET", f"/{address.secret}/board.css")
        call.getresponse()

    monkeypatch.setitem(_FILES, "board.css", (STATIC / "nowhere", "text/css"))
    monkeypatch.setattr("uvicorn.Server.main_loop", lambda _: asyncio.to_thread(ask))
    # the loop of a browser runs in this thread
    with socket.create_server(("127.0.0.1", 0)) as listening, ThreadPoolExecutor(1) as alone:
        address = Address(listening.getsockname()[1])
        alone.submit(asyncio.run, _run(application(Shelf(), address), listening, lambda: None)).result()
    assert "FileNotFoundError" in capsys.readouterr().err
    assert not logging.getLogger("uvicorn.error").isEnabledFor(logging.ERROR)


def test_a_defect_is_told_on_the_page_and_in_the_terminal_but_not_after_the_end(monkeypatch, capsys) -> None:
    monkeypatch.setattr("graphkin.board.server.answer", lambda *_: 1 / 0)
    told = json.loads(_answered(Shelf(), '{"id": 3}'))
    assert (3, False, "Defect") == (told["id"], told["ok"], told["kind"])
    assert "ZeroDivisionError" in capsys.readouterr().err
    monkeypatch.setattr(threading, "main_thread", threading.Thread)  # which does not run
    _answered(Shelf(), '{"id": 3}')
    assert "" == capsys.readouterr().err


def test_the_page_speaks_no_unknown_language() -> None:
    done = run("open", "--no-browser", "--lang", "fr")
    assert (2, 'graphkin: lang: "fr"; known here: en, zh\n') == (done.returncode, done.stderr)
