"""Write files of results whole or not at all, whatever kills the process; read no links, and no terminal escapes."""

import errno
import json
import os
import stat
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.base.errors import BadResults


def write_atomically(path: Path, write: Callable[..., object]) -> None:
    """Call write(temporary path), then put the file in its place; when this returns, it outlives a loss of power.

    BadResults if the folder cannot be made or written, the disk is full, or something else than a
    regular file is there already; no temporary file stays.
    """
    path = Path(path)
    refuse_irregular(path)
    try:
        make_folder(path.parent)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".tmp")
        os.close(handle)
    except OSError as error:
        raise refused(path.parent, error) from error
    try:
        write(temporary)
        with open(temporary, "rb") as file:
            os.fsync(file.fileno())
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
        _sync_folder(path.parent)
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError):
            raise refused(path, error) from error
        raise


def refuse_irregular(path: Path) -> None:
    """Raise BadResults if there is something at the path that is no regular file.

    The new file is renamed to the path. A rename replaces whatever is there: it would turn
    /dev/null into a text file. A link is refused too. Renaming would replace the link and not the
    file that it leads to, and to write through it would let a folder that came from elsewhere name
    any file of the user's.
    """
    try:
        mode = path.lstat().st_mode
    except (FileNotFoundError, NotADirectoryError):
        return  # nothing is there; if the folder cannot be made, making it says so
    except OSError as error:
        raise refused(path, error) from error
    if not stat.S_ISREG(mode):
        kind = next((word for is_kind, word in KINDS if is_kind(mode)), "no regular file")
        raise BadResults(f"{path}: it is {kind}, and only a regular file is replaced; name another file with --out")


KINDS = (
    (stat.S_ISLNK, "a link"),
    (stat.S_ISDIR, "a folder"),
    (stat.S_ISCHR, "a device"),
    (stat.S_ISBLK, "a device"),
    (stat.S_ISFIFO, "a pipe"),
    (stat.S_ISSOCK, "a socket"),
)
"""What may be at a path beside a regular file, in words."""

FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)
"""The disk, a share of it, or what one file may take."""


def refused(path: Path, error: OSError) -> BadResults:
    """Return the error for a file or folder that could not be written, with the cure."""
    is_full = error.errno in FULL
    reason = os.strerror(error.errno) if error.errno else error  # arrow's own text runs over lines
    cure = "make room and give the same command again" if is_full else "check its permissions"
    return BadResults(f"{path}: cannot be written ({reason}); {cure}, or choose another folder with --out")


def make_folder(folder: Path) -> None:
    """Make the folder and those above it, each known to the one that holds it before anything is put there."""
    new = [one for one in (folder, *folder.parents) if not one.exists()]
    folder.mkdir(parents=True, exist_ok=True)
    for one in new:
        _sync_folder(one.parent)


def _sync_folder(folder: Path) -> None:
    """Bring a folder's list of names to the disk: a rename alone may be lost with the power."""
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def is_leftover(path: Path) -> bool:
    """Tell whether this is the temporary file of a write that was killed."""
    return path.name.startswith(".") and path.name.endswith(".tmp")


def write_json(path: Path, content: dict) -> None:
    """Write a JSON file, whole or not at all."""
    text = json.dumps(content, indent=1, sort_keys=True) + "\n"
    write_atomically(path, lambda temporary: Path(temporary).write_text(text, encoding="utf-8"))


MOST_JSON_BYTES = 200_000_000
"""A plan of 10^9 episodes takes half of it."""


def refuse_link(path: Path) -> None:
    """Raise BadResults if the path is a symbolic link."""
    if path.is_symlink():
        raise BadResults(
            f"{path}: it is a link, and a results folder holds files of its own; put what it leads to in its place, "
            "if you trust it"
        )


def read_json(path: Path, most_bytes: int = MOST_JSON_BYTES) -> dict:
    """Return a JSON object of ours; BadResults if it is missing, a link, too large, or would steer a terminal."""
    path = Path(path)
    refuse_link(path)
    try:
        if path.stat().st_size > most_bytes:
            raise BadResults(f"{path}: it has more than {most_bytes:,} bytes, so it is none of ours; delete it")
        content = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise BadResults(f"{path}: there is no such file; the folder holds no run of ours") from None
    except (OSError, ValueError, RecursionError) as error:
        raise BadResults(f"{path}: cannot be read ({error}); delete the folder and run again") from error
    if not isinstance(content, dict):
        raise BadResults(f"{path}: it holds no JSON object, so it is none of ours; choose another folder with --out")
    if not all(text.isprintable() for text in _texts(content)):
        raise BadResults(f"{path}: a text in it holds signs that cannot be printed; delete the folder and run again")
    return content


def _texts(content: object) -> Iterator[str]:
    """Return every text of a JSON value, names of fields too."""
    if isinstance(content, str):
        yield content
    elif isinstance(content, dict):
        for name, value in content.items():
            yield name
            yield from _texts(value)
    elif isinstance(content, list):
        for value in content:
            yield from _texts(value)
