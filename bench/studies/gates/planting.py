"""Copies of the sources with something planted in them."""

import contextlib
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path

from bench.errors import BadResults
from bench.provenance import ROOT

COPIED = ("bench", "tasks", "requirements", "pyproject.toml")

Edit = Callable[[Path], None]
"""Changes a copy."""


@contextlib.contextmanager
def copy_with(edit: Edit) -> Iterator[Path]:
    """A copy of the sources, edited; gone when the block ends."""
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder:
        copy = Path(folder) / "checkout"
        for name in COPIED:
            source = ROOT / name
            if source.is_dir():
                shutil.copytree(source, copy / name, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy2(source, copy / name)
        edit(copy)
        yield copy


def unchanged(copy: Path) -> None:
    """Plants nothing."""


def replaced(file: str, old: str, new: str) -> Edit:
    """Replaces a piece of a file that occurs once.

    Errors, when it is called:
        BadResults: it does not occur once, so the sources have moved on and the study must follow.
    """

    def edit(copy: Path) -> None:
        path = copy / file
        text = path.read_text(encoding="utf-8")
        if text.count(old) != 1:
            raise BadResults(
                f"{file}: '{old.strip()}' occurs {text.count(old)} times, not once; mend bench/studies/gates"
            )
        path.write_text(text.replace(old, new), encoding="utf-8")

    return edit


def removed(file: str) -> Edit:
    """Takes a file away."""
    return lambda copy: (copy / file).unlink()
