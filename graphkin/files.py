"""Files that appear whole or not at all, and folders into which one program writes at a time."""

from __future__ import annotations

import errno
import json
import os
import re
import stat
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import AbstractContextManager, contextmanager, nullcontext, suppress
from pathlib import Path
from typing import IO, Any

from graphkin.errors import CallError, unfit
from graphkin.words import Phrase, from_others

Json = str | float | bool | None | Sequence["Json"] | Mapping[str, "Json"]
"""What stands in a file of JSON or TOML."""
Tables = Mapping[str, Any]
"""Tables of a file (a scene's, above all) in its keys and units, as the parser gives them: nothing is checked."""
OwnTables = dict[str, Any]
"""The same, to be changed."""

_LOCK = ".graphkin-writes-here"
_HANDED_OVER = re.compile(r"/dev/stdin|/dev/fd/[0-9]+")
"""Names of what a shell has opened already for the program."""
_WORD_OR_ZERO = re.compile(r'"(?:[^"\\]|\\.)*"|-0\.0(?![0-9e])')


def json_text(data: object) -> str:
    """Data as the text of JSON on one line: control characters are escaped, and 0 has no sign.

    >>> json_text({"v": -0.0, "w": [-0.05, "-0.0"]})
    '{"v": 0.0, "w": [-0.05, "-0.0"]}'
    """
    text = json.dumps(data, ensure_ascii=False, allow_nan=False, default=str)
    if "-0.0" in text:
        text = _WORD_OR_ZERO.sub(lambda match: "0.0" if match[0] == "-0.0" else match[0], text)
    return re.sub("[\x7f-\x9f]", lambda match: f"\\u{ord(match[0]):04x}", text)


def path_of(place: str | os.PathLike[str]) -> Path:
    """A caller's path.  Raises CallError for a value that is no path."""
    path: object = None
    with suppress(TypeError, UnicodeEncodeError):
        os.fsencode(place)  # half a pair of UTF-16 is in no name
        path = os.fspath(place)
    if not isinstance(path, str) or "\0" in path:
        raise unfit("path", place, "give the name of a file or folder")
    return Path(path)


def opened(path: str | os.PathLike[str]) -> IO[bytes]:
    """Open a file for reading, but no device, which may never end, and no pipe without a writer, unless the shell hands
    it over open.

    Raises
    ------
    OSError : there is no such file, or it cannot be read
    ValueError : no file can have this name
    """
    mode = os.stat(path).st_mode
    if not (stat.S_ISREG(mode) or stat.S_ISDIR(mode) or _HANDED_OVER.fullmatch(os.fspath(path))):
        raise OSError(errno.EINVAL, Phrase("it is a pipe or a device no"))
    return open(path, "rb")


@contextmanager
def whole_file(path: Path, beside: Path | None = None) -> Iterator[IO[bytes]]:
    """Open a file that gets its name only when it is whole; a file of that name is replaced.  Until then it is in its
    own folder, or in ``beside``.  Its permissions follow the user's rule for new files.  Raises OSError."""
    temporary = (beside or path.parent) / f".{path.name}.{os.urandom(4).hex()}"
    handle = os.open(temporary, os.O_CREAT | os.O_EXCL | os.O_WRONLY | getattr(os, "O_BINARY", 0), 0o666)
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
            # else a name may outlive a loss of power, and what it names may not
            stream.flush()
            os.fsync(stream.fileno())
        os.replace(temporary, path)
    except BaseException:
        with suppress(OSError):
            os.unlink(temporary)
        raise


@contextmanager
def writing_to(where: str, wanted: str = "") -> Iterator[None]:
    """Write to a file or a folder, whose name a CallError tells where the system cannot."""
    try:
        yield
    except OSError as error:
        raise CallError.of(where, "cannot be written", wanted, reason=from_others(error)) from None


@contextmanager
def folder_alone(folder: Path) -> Iterator[None]:
    """Hold a folder of results for one long job: a second program that wants it gets an error that names the first.

    A file in it is locked; the system unlocks it when the program ends, however it ends.

    Raises
    ------
    CallError : another program is writing into the folder
    OSError : the folder cannot be written
    """
    import platform

    from filelock import FileLock, Timeout

    path = folder / _LOCK
    try:
        held: AbstractContextManager[object] = FileLock(path, blocking=False).acquire()
    except Timeout:
        who = ""
        with suppress(OSError):
            who = path.read_text(encoding="utf-8").strip()
        raise CallError.of(str(folder), "another graphkin is writing into it", "wait until it has done or give another",
                           by=f' ({who})' if who else '') from None
    except OSError as error:
        if error.errno not in (errno.ENOLCK, errno.ENOTSUP):
            raise
        held = nullcontext()  # a file system that knows no locks: as if nobody were there
    with held:
        with suppress(OSError):  # a full disk: then nobody is named
            path.write_text(f"process {os.getpid()} on {platform.node()}\n", encoding="utf-8")
        try:
            yield
        finally:
            with suppress(OSError):
                path.unlink()


def write_files(folder: Path, files: Mapping[str, bytes | Iterable[bytes]]) -> list[Path]:
    """Write files by name, each from one piece or many, into a folder, which is made if it is missing, each whole or
    not at all; returns their paths.

    Raises
    ------
    CallError : the folder cannot be written
    """
    with writing_to(str(folder), "give another folder with o"):
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in files.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            with whole_file(folder / name) as out:
                out.writelines([content] if isinstance(content, bytes) else content)
    return [folder / name for name in files]
