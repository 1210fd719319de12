"""The command line as the tests call it: in this process, with its exit code and its two streams."""

import hashlib
import os
import subprocess
import sys
from pathlib import Path
from typing import NamedTuple

from bench.base.provenance import ROOT
from bench.cli import main

ALONE = ("--experiment", "free-body")
"""Without the counting of all laws, which takes seconds."""

TINY = ("--suite", "quick", "--starts", "paper", "--regulator", "rotation-matrix", "--horizon", "0.1", *ALONE)
"""Three episodes of a hundred ticks on every engine that is named."""


def started(*words, variables: dict | None = None, **options) -> subprocess.Popen:
    """Start Python, which finds the modules of our tests, with these variables and without those of None."""
    usual = {**os.environ, "PYTHONPATH": os.pathsep.join(map(str, (ROOT, ROOT / "tests")))}
    given = {name: str(value) for name, value in (usual | (variables or {})).items() if value is not None}
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    command = [sys.executable, *map(str, words)]
    return subprocess.Popen(command, env=given, text=True, **{"cwd": ROOT, **pipes, **options})


def python(*words, cwd=ROOT, code: int = 0, **variables: str | None) -> str:
    """What Python prints in a process of its own, with these variables of the environment and without those of None."""
    process = started(*words, variables={"PYTHONPATH": os.environ.get("PYTHONPATH"), **variables}, cwd=cwd)
    out, err = process.communicate()
    assert process.returncode == code, out + err
    return out


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
