"""Compiling ahead: what a second process compiles and counts is in the cache, and no process is left behind."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from bench.running import precompile


def cached(folder: Path) -> int:
    return len(list(folder.rglob("*.nbi")))


@pytest.mark.slow
def test_it_leaves_laws_controllers_of_arms_and_of_contact_in_the_cache(tmp_path):
    names = ["rotation-matrix", "rotation-matrix@geometric+solve", "impedance-geometric"]
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    words = [sys.executable, "-m", "bench.running.precompile", *names]
    subprocess.run(words, env=environment, check=True, capture_output=True)
    kept = {path.name.split(".")[0] for path in tmp_path.rglob("*.nbi")}
    assert {"binding", "resolved_acceleration"} <= kept
    assert cached(tmp_path) >= len(names)
    assert [path.name.partition("-")[2] for path in (tmp_path / "costs").iterdir()] == ["rotation-matrix.json"]


def started(monkeypatch):
    """The processes that are begun from here on."""
    begun, usual = [], subprocess.Popen

    def popen(*words, **options):
        begun.append(usual(*words, **options))
        return begun[-1]

    monkeypatch.setattr(precompile.subprocess, "Popen", popen)
    return begun


def test_a_few_contenders_are_not_worth_a_process(monkeypatch):
    begun = started(monkeypatch)
    with precompile.compiling_ahead(["hybrid"] * 100):
        assert begun == []


def interrupted(begun):
    with precompile.compiling_ahead(["rotation-matrix", *map(str, range(precompile.WORTH))]):
        assert begun[0].poll() is None
        raise KeyboardInterrupt


def test_the_process_ends_with_the_run_even_if_that_fails(monkeypatch):
    begun = started(monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        interrupted(begun)
    assert begun[0].poll() is not None
