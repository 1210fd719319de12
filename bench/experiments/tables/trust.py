"""Which law files may run: those that this user has run, or said that they may.

A results folder keeps its user's laws as Python files. They are code, and a folder may come from anywhere: a law that
is found in one runs only if this user gave the same text to `bench run --law`, or to `bench trust`, before.
"""

import hashlib
from pathlib import Path

from bench.base.provenance import kept_in


def home() -> Path:
    """Return the folder that holds an empty file for each text, named by its SHA-256."""
    return kept_in("XDG_STATE_HOME", ".local/state") / "laws"


def mark(text: bytes) -> Path:
    """Return the file that is there if this user has run the text, or said that it may run."""
    return home() / hashlib.sha256(text).hexdigest()


def remember(text: bytes) -> None:
    """Remember this text as this user's own; OSError if the user's state cannot be written."""
    mark(text).parent.mkdir(parents=True, exist_ok=True)
    mark(text).touch()


def is_own(text: bytes) -> bool:
    """Tell whether this user has run the text, or said that it may run."""
    return mark(text).is_file()
