"""Compiled code on disk: one file for each function and signature, in place of numba's index with numbered files.

numba keeps an index of all signatures of a function, and the index names the files of code by
counting. Two processes that write such an index at once must wait for one another, or a third finds
the code of one function under the name of another. Here the name of a file follows from what the
file holds. Nobody waits, so nobody can be made to wait by a process that holds a lock or was
stopped.

A process that runs a user's law reads these files and writes none. The law may have changed a
constant of a module of ours, on purpose or not. numba compiles constants into the code, and its key
does not name them: code compiled in such a process would look like ours to every other process.
"""

import contextlib
import hashlib
import os
import pickle  # noqa: TID251  numba gives objects of its own, which go to the folder of compiled code and to no results
import secrets
import sys
from pathlib import Path
from typing import Any

import numba
from numba.core.serialize import dumps

from bench.base.processes import RUNS_A_LAW

DIGITS = 16
"""Hex digits in the name of a file: 64 bits for some hundred signatures. The file holds the whole key all the same."""

DAMAGED = (EOFError, pickle.UnpicklingError, AttributeError, ImportError, IndexError, ValueError, TypeError)
"""What pickle raises for a file that is cut off or of other sources; such code is compiled again."""


class KeptCode:
    """The files of one function; numba makes it, as its own IndexDataCacheFile, whose place it takes.

    Args:
        cache_path: Folder of the file that the function is in.
        filename_base: The function's name with a digest, as numba writes it.
        source_stamp: Time and size of the function's file; code of another stamp is removed.
    """

    has_said = False
    """Whether it was said that nothing can be kept: once a process."""

    def __init__(self, cache_path: str, filename_base: str, source_stamp: object) -> None:
        self._folder = Path(cache_path)
        self._begin = f"{filename_base}.{_digest((numba.__version__, source_stamp))}"
        self._function = filename_base

    def load(self, key: tuple) -> Any:
        """Return what was saved by this key; None if nothing was, or it is damaged."""
        try:
            content = self._path(key).read_bytes()
        except OSError:
            return None
        try:
            saved_key, data = pickle.loads(content)
        except DAMAGED:
            return None
        return data if saved_key == key else None

    def save(self, key: tuple, data: Any) -> None:
        """Keep code for other processes, unless this process runs a user's law."""
        if RUNS_A_LAW:
            return
        path = self._path(key)
        temporary = path.with_name(f"{path.name}.tmp.{secrets.token_hex(8)}")
        try:
            self._remove_older()
            temporary.write_bytes(dumps((key, data)))
            os.replace(temporary, path)
        except OSError as error:
            _say_once(path.parent, error)
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)

    def flush(self) -> None:
        """Remove all code of this function."""
        for path in self._folder.glob(f"{self._function}.*.nbc"):
            path.unlink(missing_ok=True)

    def _path(self, key: tuple) -> Path:
        return self._folder / f"{self._begin}.{_digest(key)}.nbc"

    def _remove_older(self) -> None:
        """Remove code of an earlier state of the function's file, which nobody will ask for again."""
        for path in self._folder.glob(f"{self._function}.*.nbc"):
            if not path.name.startswith(self._begin):
                path.unlink(missing_ok=True)


def _digest(words: tuple) -> str:
    """Return a digest of the words' texts: types are named alike in every process, but pickled in various ways."""
    return hashlib.sha256(repr(words).encode()).hexdigest()[:DIGITS]


def _say_once(folder: Path, error: OSError) -> None:
    if not KeptCode.has_said:
        KeptCode.has_said = True
        reason = error.strerror or error
        print(f"{folder}: compiled code cannot be kept ({reason}); every process compiles it again", file=sys.stderr)
