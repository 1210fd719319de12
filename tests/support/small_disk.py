"""A file system of its own that is small enough to fill: tmpfs, where mounting is allowed."""

import contextlib
import subprocess
from collections.abc import Iterator
from pathlib import Path

KILOBYTES = 1024


class NoDisk(Exception):
    """This process may not mount."""


@contextlib.contextmanager
def mounted(folder: Path) -> Iterator[Path]:
    """A disk of KILOBYTES, gone afterwards."""
    folder.mkdir()
    words = ["mount", "-t", "tmpfs", "-o", f"size={KILOBYTES}k", "tmpfs", str(folder)]
    try:
        done = subprocess.run(words, capture_output=True, text=True)
    except FileNotFoundError:
        raise NoDisk("there is no mount to make a small disk with") from None
    if done.returncode:
        raise NoDisk(f"no small disk can be mounted here ({done.stderr.strip()})")
    try:
        yield folder
    finally:
        # a write that failed may still hold its file
        subprocess.run(["umount", "--lazy", str(folder)], check=True)


def fill(disk: Path, left: int) -> Path:
    """Fill the disk but for so many kilobytes; the file to remove to make room."""
    filler = disk / "filler"
    filler.write_bytes(bytes((KILOBYTES - left) * 1024))
    return filler
