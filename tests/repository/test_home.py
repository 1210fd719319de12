"""A HOME that cannot be written: caches go elsewhere, and a run is one all the same. Here it is a file."""

import os
import subprocess
import sys

import pytest
from support.command_line import TINY

from bench.base.provenance import ROOT, kept_in


@pytest.fixture
def homeless(tmp_path, monkeypatch):
    """A folder; HOME is a file in it."""
    (tmp_path / "home").touch()
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    for name in ("XDG_CACHE_HOME", "XDG_STATE_HOME", "NUMBA_CACHE_DIR"):
        monkeypatch.delenv(name, raising=False)
    return tmp_path


def test_folder_is_in_the_checkout_or_a_new_one_that_stays(homeless):
    assert kept_in("XDG_CACHE_HOME", "cache", homeless / "there") == homeless / "there" / "cache" / "orientation-bench"
    new = kept_in("XDG_STATE_HOME", "state", homeless / "home")
    assert str(new.parent) == os.environ["XDG_STATE_HOME"]  # for processes that this one starts
    assert (new.parent.stat().st_uid, new.parent.stat().st_mode & 0o777) == (os.getuid(), 0o700)
    assert new == kept_in("XDG_STATE_HOME", "state", homeless / "home")


def test_run_needs_no_home_and_makes_tools_have_one(homeless):
    words = [sys.executable, "-m", "bench", "run", *TINY, "--engine", "native", "--out", str(homeless / "out")]
    assert "rror" not in subprocess.run(words, cwd=ROOT, capture_output=True, text=True, check=True).stderr
    assert (ROOT / ".home" / ".cache" / "orientation-bench").is_dir()
    make = ["make", "-s", "--eval", "where:\n\t@echo $$HOME", "where"]
    assert subprocess.run(make, cwd=ROOT, capture_output=True, text=True).stdout.strip() == str(ROOT / ".home")
