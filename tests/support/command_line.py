"""The command line as the tests call it: in this process, with its exit code and its two streams."""

import hashlib
from pathlib import Path
from typing import NamedTuple

from bench.cli import main

ALONE = ("--experiment", "free-body")
"""Without the counting of all laws, which takes seconds."""

TINY = ("--suite", "quick", "--starts", "paper", "--regulator", "rotation-matrix", "--horizon", "0.1", *ALONE)
"""Three episodes of a hundred ticks on every engine that is named."""


class Said(NamedTuple):
    """What one command answered."""

    code: int
    out: str
    err: str


def bench(capsys, *words) -> Said:
    """`bench WORDS...`; what was printed before is dropped."""
    capsys.readouterr()
    code = main([str(word) for word in words])
    return Said(code, *capsys.readouterr())


def digest(folder: Path) -> dict[str, str]:
    """Every file and folder below, with a digest of the bytes: equal if and only if nothing was touched."""
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest() if path.is_file() else "folder"
        for path in sorted(folder.rglob("*"))
    }


def refused(capsys, *words) -> str:
    """The one line of a refused command."""
    said = bench(capsys, *words)
    lines = said.err.splitlines()
    assert (said.code, len(lines)) == (2, 1), said
    assert lines[0].startswith("error: ")
    return lines[0]


def refused_run(capsys, folder, *words) -> str:
    """The one line of a refused run into a folder, which must stay as it is."""
    before = digest(folder)
    line = refused(capsys, "run", "--replace", "--out", folder, *words)
    assert digest(folder) == before
    return line
