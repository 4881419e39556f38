"""The scenes that a page may open and the files that it may write: those of one folder, one file, or none.

A file is written whole or not at all, the version before it is kept as ``name.toml~``, and a file that somebody else
has changed in the meantime is not overwritten unasked.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from hashlib import sha256
from pathlib import Path

from graphkin.errors import CallError, GraphkinError, did_you_mean
from graphkin.files import Json, whole_file, writing_to
from graphkin.scene.scene import LARGEST_FILE, file_text, library, library_text
from graphkin.words import Phrase

_NAME = re.compile(r"[^\W_][\w .-]{0,80}\.toml")


def mark_of(text: str) -> str:
    """The mark of a version of a text."""
    return sha256(text.encode()).hexdigest()[:16]


@dataclass(frozen=True)
class Shelf:
    """The scenes of a page: the bundled ones, and the scene files of a folder or one file.

    folder : the folder of the files; None without files
    only : the single file of it that may be opened and written; any scene file of the folder if empty
    first : the scene that is opened first
    draft : the text that the page begins with instead
    """

    folder: Path | None = None
    only: str = ""
    first: str = ""
    draft: str = ""

    @classmethod
    def of(cls, place: str | None) -> Shelf:
        """The shelf of a file, a folder, or the name of a bundled scene, which is opened first.

        Raises
        ------
        SceneError : there is no such file or scene
        """
        if not place:
            return cls()
        path = Path(place)
        if path.is_dir():
            return cls(path.resolve())
        if place in library() and not path.is_file():
            return cls(first=place)
        file_text(place)  # or a sentence
        return cls(path.resolve().parent, path.name, path.name)

    def files(self) -> list[str]:
        """Names of the scene files, sorted."""
        if self.folder is None:
            return []
        if self.only:
            return [self.only]
        return sorted(p.name for p in self.folder.glob("*.toml") if _NAME.fullmatch(p.name) and p.is_file())[:500]

    def listing(self) -> list[dict[str, Json]]:
        """The scenes that can be opened: own files first, then the bundled ones."""
        files: list[dict[str, Json]] = [{"name": name, "own": True} for name in self.files()]
        return files + [{"name": name, "own": False} for name in library()]

    def text(self, name: str) -> str:
        """The text of a scene.  Raises SceneError, CallError for an unknown one."""
        if name in self.files():
            return file_text(str(self._path(name)))
        if name in library():
            return library_text(name)
        known = [*self.files(), *library()]
        raise CallError.of(f'"{name[:60]}"', "there is no such scene here", did_you_mean(name[:60], known))

    def save(self, name: str, text: str, mark: str) -> str:
        """Write a file, and return the mark of its new version.

        Parameters
        ----------
        mark : of the version that was opened; "" for a new file

        Raises
        ------
        CallError : a file that may not be written, that has changed since, or that cannot be saved
        """
        path = self._path(name)
        if len(text) > LARGEST_FILE:
            raise CallError.of(name, "is larger than kb", largest=LARGEST_FILE // 1000)
        with writing_to(name):
            if path.is_file():
                before = path.read_bytes()
                if mark_of(before.decode("utf-8-sig", "replace")) != mark:
                    raise CallError.of(name, "has been changed by somebody else since it",
                                       "open it again or save under another name")
                with whole_file(path.with_name(f"{path.name}~")) as kept:
                    kept.write(before)
            with whole_file(path) as out:
                out.write(text.encode())
        return mark_of(text)

    def changed(self, name: str, mark: str) -> str | None:
        """The text of a file that somebody else has changed since the version of a mark; None if it is unchanged."""
        try:
            text = self.text(name)
        except GraphkinError:
            return None
        return None if mark_of(text) == mark else text

    def _path(self, name: str) -> Path:
        if self.folder is None:
            raise CallError.of(name[:60] or Phrase("the file"), "no file was opened that could be written",
                               "start with a folder graphkin open folder")
        if name != self.only and (self.only or not _NAME.fullmatch(name)):
            only = Phrase("only may be written here", names=self.only)
            wanted = only if self.only else "a name like four-bar.toml is wanted"
            raise CallError.of(f'"{name[:60]}"', "cannot be written of nothing", wanted)
        path = self.folder / name
        if path.is_symlink() and self.only != name:
            raise CallError.of(name, "is a link to another place", "open that file itself")
        return path
