"""Two runs on one folder: the second is refused in one line, and nothing of the first stays when it ends."""

import errno
import os
import subprocess
import sys

import pytest
from support.command_line import TINY, bench, digest, refused
from support.user_law import law_text

from bench.base import lock
from bench.base.provenance import ROOT

RUN = ("run", *TINY, "--engine", "reference")
HOLD = """
import pathlib, sys
from bench.base import lock
with lock.held(pathlib.Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def holder(finished):
    """A process that holds the folder of a finished run."""
    words = [sys.executable, "-c", HOLD, str(finished)]
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen(words, cwd=ROOT, **pipes) as process:
        assert process.stdout.readline() == "held\n"
        yield process
        process.kill()


@pytest.mark.parametrize("words", [(), ("--replace", "--kp", "7")], ids=["same plan", "another plan"])
def test_folder_of_another_run_is_refused_and_left_alone(capsys, holder, finished, words):
    before = digest(finished)
    line = refused(capsys, *RUN, *words, "--out", finished)
    assert f"{finished}: another run (process {holder.pid}) is writing into it" in line
    assert "choose another folder" in line
    assert digest(finished) == before


def test_killed_run_leaves_no_lock(capsys, holder, finished):
    before = digest(finished)
    holder.kill()
    holder.wait()
    assert bench(capsys, *RUN, "--out", finished).code == 0
    assert digest(finished) == before


def test_folder_that_cannot_be_locked_is_used_and_said_so(finished, capsys):
    def unsupported(*_):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    with lock.held(finished, flock=unsupported):
        said = capsys.readouterr().err
    assert said.startswith(f"{finished}: cannot be locked (No locks available)")
    assert len(said.splitlines()) == 1


def test_refused_run_leaves_no_empty_folder(capsys, tmp_path):
    law = tmp_path / "own.py"
    law.write_text(law_text("return (float(str(omega[0])), 0.0, 0.0)"))
    words = ("--law", law, "--regulator", "mine", "--starts", "paper", "--engine", "ideal-rk4")
    assert "cannot be compiled" in refused(capsys, "run", *words, "--out", tmp_path / "new")
    assert not (tmp_path / "new").exists()
