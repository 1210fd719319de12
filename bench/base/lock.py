"""Keep a folder to one run at a time: the kernel locks the folder itself until the process ends."""

import contextlib
import fcntl
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.base.errors import BadResults


@contextlib.contextmanager
def held(folder: Path, waits: bool = False, flock: Callable = fcntl.flock) -> Iterator[None]:
    """Hold a folder; wait for another process that holds it, or raise BadResults.

    Some network file systems lock no folder: this is printed, and the run goes on.
    """
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)  # not inherited by the programs that a run starts
    try:
        try:
            flock(handle, fcntl.LOCK_EX if waits else fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            cure = "wait for its end, stop it, or choose another folder with --out"
            raise BadResults(f"{folder}: another run is writing into it; {cure}") from None
        except OSError as error:
            result = "so that nothing keeps a second run out of it; start none there"
            print(f"{folder}: cannot be locked ({error.strerror or error}), {result}", file=sys.stderr)
        yield
    finally:
        os.close(handle)
