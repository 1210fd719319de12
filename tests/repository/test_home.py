"""A HOME that cannot be written: caches go elsewhere, and a run is one all the same. Here it is a file."""

import os
import subprocess
import sys

import pytest
from support.command_line import TINY

from bench.home import folder
from bench.provenance import ROOT

WHERE = "where:\n\t@echo $$HOME"


@pytest.fixture
def homeless(tmp_path, monkeypatch):
    """A folder; HOME is a file in it."""
    (tmp_path / "home").touch()
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("XDG_CACHE_HOME", "XDG_STATE_HOME", "NUMBA_CACHE_DIR"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


def test_folder_is_in_the_checkout_or_a_new_one_that_stays(homeless):
    assert folder("XDG_CACHE_HOME", "cache", homeless / "there") == homeless / "there" / "cache" / "orientation-bench"
    new = folder("XDG_STATE_HOME", "state", homeless / "home")
    assert str(new.parent) == os.environ["XDG_STATE_HOME"]  # for processes that this one starts
    assert new == folder("XDG_STATE_HOME", "state", homeless / "home")


def test_run_without_a_home_says_nothing_of_it(homeless):
    words = [sys.executable, "-m", "bench", "run", *TINY, "--engine", "native", "--out", str(homeless / "out")]
    done = subprocess.run(words, cwd=ROOT, capture_output=True, text=True)
    assert (done.returncode, done.stderr) == (0, "")
    assert (ROOT / ".home" / ".cache" / "orientation-bench").is_dir()


def test_tools_that_make_calls_have_a_home(homeless):
    said = subprocess.run(["make", "-s", "--eval", WHERE, "where"], cwd=ROOT, capture_output=True, text=True)
    assert said.stdout.strip() == str(ROOT / ".home")
