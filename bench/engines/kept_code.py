"""Compiled code on disk: one file for each function and signature, in place of numba's index with numbered files.

numba keeps an index of all signatures of a function, and the index names the files of code by
counting. Two processes that write such an index at once must wait for one another, or a third finds
the code of one function under the name of another. Here the name of a file follows from what the
file holds. Nobody waits, so nobody can be made to wait by a process that holds a lock or was
stopped.

For a function of ours the name follows from all on which its code depends (dependencies.py). numba itself looks only
at the file of the function, and at its line. So code is taken by any checkout that has the same, and a folder holds
code of several states of the sources; what was not used for longest is removed.

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
from numba.core.caching import UserProvidedCacheLocator
from numba.core.serialize import dumps

from bench.base.processes import RUNS_A_LAW
from bench.base.provenance import ROOT
from bench.base.sources import PACKAGES, reader
from bench.engines.dependencies import Stamp, describe_code, stamp_of

DIGITS = 16
"""Hex digits in the name of a file: 64 bits for some hundred signatures. The file holds the whole key all the same."""

DAMAGED = (EOFError, pickle.UnpicklingError, AttributeError, ImportError, IndexError, ValueError, TypeError)
"""What pickle raises for a file that is cut off or of other sources; such code is compiled again."""


MOST_BYTES = 150_000_000
"""Size of a folder from which on the oldest code is removed: some ten states of the sources."""

CUT_BYTES = 100_000_000
"""What is left then."""


class PlaceOfCode(UserProvidedCacheLocator):
    """Name the place of the code of our functions and its stamp; numba makes one for each function."""

    def __init__(self, function: Any, file: str) -> None:
        super().__init__(function, file)
        self._function = function
        folder = Path(file).resolve().relative_to(ROOT).with_suffix("")
        self._cache_path = str(Path(numba.config.CACHE_DIR, "code", *folder.parts))

    def get_source_stamp(self) -> Stamp:
        """Return a digest of all on which the code depends."""
        return stamp_of(self._function)

    def get_disambiguator(self) -> str:
        """Return what tells functions of one name in one file apart, and stays the same when lines move."""
        return describe_code(self._function.__code__, self._function.__doc__)[:DIGITS]

    @classmethod
    def from_function(cls, function: Any, file: str) -> Any:
        """Return a place for a function of a file of ours, if there is a folder for compiled code."""
        path = Path(file).resolve()
        is_ours = any(path.is_relative_to(ROOT / name) for name in PACKAGES)
        return super().from_function(function, file) if is_ours else None


class KeptCode:
    """The files of one function; numba makes it, as its own IndexDataCacheFile, whose place it takes.

    Args:
        cache_path: Folder of the code of the file that the function is in.
        filename_base: The function's name with a digest, as numba writes it.
        source_stamp: What the code depends on: a `Stamp`; of a function that is not ours, a digest of its file.
    """

    has_said = False
    """Whether it was said that nothing can be kept: once a process."""

    has_pruned = False
    """Whether the folder's size was looked at: once a process."""

    def __init__(self, cache_path: str, filename_base: str, source_stamp: object) -> None:
        self._folder = Path(cache_path)
        self._begin = f"{filename_base}.{_digest((numba.__version__, source_stamp))}"
        self._function = filename_base
        self._stamp = source_stamp

    def load(self, key: tuple) -> Any:
        """Return what was saved by this key; None if nothing was, or it is damaged."""
        path = self._path(key)
        try:
            content = path.read_bytes()
        except OSError:
            return None
        try:
            saved_key, data = pickle.loads(content)
        except DAMAGED:
            return None
        if saved_key != self._whole(key):
            return None
        if not RUNS_A_LAW:
            with contextlib.suppress(OSError):
                os.utime(path)  # it was used: what was not for longest is removed first
        return data

    def save(self, key: tuple, data: Any) -> None:
        """Keep code for other processes.

        A process that runs a user's law keeps none, nor does one whose files have changed since they were read.
        """
        if RUNS_A_LAW or not reader().is_unchanged():
            return
        path = self._path(key)
        temporary = path.with_name(f"{path.name}.tmp.{secrets.token_hex(8)}")
        try:
            temporary.write_bytes(dumps((self._whole(key), data)))
            os.replace(temporary, path)
        except OSError as error:
            _say_once(path.parent, error)
            with contextlib.suppress(OSError):
                temporary.unlink(missing_ok=True)
        if not KeptCode.has_pruned:
            KeptCode.has_pruned = True
            prune(Path(numba.config.CACHE_DIR))

    def flush(self) -> None:
        """Remove all code of this function."""
        for path in self._folder.glob(f"{self._function}.*.nbc"):
            path.unlink(missing_ok=True)

    def _path(self, key: tuple) -> Path:
        return self._folder / f"{self._begin}.{_digest(self._whole(key))}.nbc"

    def _whole(self, key: tuple) -> tuple:
        """Return the stamp, the types and the processor; of a function that is not ours also numba's two digests of it.

        numba's digest of a closure has the lines of the functions in it. The stamp has all of them without lines.
        """
        signature, processor, _ = key
        return (self._stamp, signature, processor) if isinstance(self._stamp, Stamp) else (self._stamp, *key)


def prune(folder: Path, most_bytes: int = MOST_BYTES, cut_bytes: int = CUT_BYTES) -> None:
    """Remove what was not used for longest, if the files of a folder have more bytes than allowed.

    A process that wants one of them compiles it again.
    """
    states = {}
    for path in folder.rglob("*"):
        with contextlib.suppress(OSError):
            if path.is_file():
                states[path] = path.stat()
    left = sum(state.st_size for state in states.values())
    if left <= most_bytes:
        return
    for path in sorted(states, key=lambda path: states[path].st_mtime_ns):
        if left <= cut_bytes:
            break
        with contextlib.suppress(OSError):
            path.unlink()
        left -= states[path].st_size


def _digest(words: tuple) -> str:
    """Return a digest of the words' texts: types are named alike in every process, but pickled in various ways."""
    return hashlib.sha256(repr(words).encode()).hexdigest()[:DIGITS]


def _say_once(folder: Path, error: OSError) -> None:
    if not KeptCode.has_said:
        KeptCode.has_said = True
        reason = error.strerror or error
        print(f"{folder}: compiled code cannot be kept ({reason}); every process compiles it again", file=sys.stderr)
