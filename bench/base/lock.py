"""One run at a time in a folder: a lock that the kernel holds on the folder itself until the process ends.

No file is left behind, however a run ends. Some network file systems lock no folder; there a run goes on without.
"""

import contextlib
import fcntl
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.base.errors import BadResults


@contextlib.contextmanager
def held(folder: Path, waits: bool = False, flock: Callable = fcntl.flock) -> Iterator[None]:
    """Hold a folder, or say that it cannot be locked; BadResults if another process holds it, unless it `waits`."""
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
