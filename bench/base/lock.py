"""Keep a folder to one run at a time: the kernel locks the folder itself until the process ends."""

import contextlib
import fcntl
import os
import sys
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.base.errors import BadResults


@contextlib.contextmanager
def lock_folder(folder: Path, flock: Callable = fcntl.flock) -> Iterator[None]:
    """Lock a folder, without waiting; BadResults names the process that has locked it already.

    Some network file systems lock no folder: this is printed, and the run goes on.
    """
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)  # not inherited by the programs that a run starts
    try:
        try:
            flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            holder = find_holder(folder)
            who = f"another run (process {holder})" if holder else "another run"
            cure = "wait for its end, stop it, or choose another folder with --out"
            raise BadResults(f"{folder}: {who} is writing into it; {cure}") from None
        except OSError as error:
            result = "so that nothing keeps a second run out of it; start none there"
            print(f"{folder}: cannot be locked ({error.strerror or error}), {result}", file=sys.stderr)
        yield
    finally:
        os.close(handle)


LOCKS = Path("/proc/locks")
"""Every lock of the machine, a line each: "1: FLOCK ADVISORY WRITE 123 fd:01:456 0 EOF", with process and inode."""


def find_holder(folder: Path, locks: Path = LOCKS) -> int | None:
    """Return the process that holds a folder; None where the system does not say (only Linux does)."""
    inode = folder.stat().st_ino
    try:
        lines = locks.read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    for line in lines:
        words = line.split()
        is_held = len(words) == 8 and words[1] == "FLOCK"  # a line of a process that waits has one word more
        if is_held and words[5].rpartition(":")[2] == str(inode):
            # A process of another container has no number here; the system then gives 0 or -1.
            return int(words[4]) if int(words[4]) > 0 else None
    return None
