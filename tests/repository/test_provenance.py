"""A checkout: its version, the digest of its sources, and a HOME that cannot be written."""

import os
import re
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
from support.command_line import TINY, python

from bench.base.provenance import DECIDING, ROOT, kept_in

READ_ONLY = {"bench/__init__.py"}
MODULES = """
import sys
from bench.experiments.experiment import known_experiments
from bench.experiments.jacobians import pose_sets
from bench.engines import simulate, simulate_arms, simulate_contact, simulate_bodies
from bench.experiments.tables import store
known_experiments()
from bench.engines.counting import in_contact, on_arms
for name, module in list(sys.modules.items()):
    if name.partition(".")[0] in ("bench", "tasks"):
        print(module.__file__)
"""


@pytest.mark.parametrize("name", DECIDING)
def test_what_decides_rows_is_there(name):
    assert (ROOT / name).exists()


def test_digest_is_over_every_module_that_makes_rows():
    files = {Path(line).relative_to(ROOT) for line in python("-c", MODULES).splitlines()}
    left = {one.as_posix() for one in files if not any(one.is_relative_to(name) for name in DECIDING)}
    assert left <= READ_ONLY


def test_nothing_that_makes_rows_reads_docstrings():
    """The digest leaves them out.

    The audit reads those of its faults, for its report alone, and the translator those of functions, for a comment.
    """
    words = ("__doc__", "getdoc", "get_docstring", "getsource", "findsource", "getcomments")
    paths = [path for name in DECIDING for path in sorted((ROOT / name).rglob("*.py"))]
    found = {path.relative_to(ROOT).as_posix() for path in paths if any(word in path.read_text() for word in words)}
    kept_code = {"bench/engines/kept_code.py", "bench/engines/dependencies.py"}
    translator = {"bench/translation/dialect.py", "bench/translation/source.py"}
    assert found == {"bench/audit/faults/__init__.py", *translator, *kept_code}


def test_release_is_the_same_everywhere():
    version = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["version"]
    cited = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    date = re.search(r'^date-released: "(\d{4}-\d\d-\d\d)"$', cited, re.MULTILINE)[1]
    headings = re.findall(r"^## (.*)$", (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), re.MULTILINE)
    # What is not released yet stands above the releases.
    newest = next(heading for heading in headings if heading != "[Unreleased]")
    assert f"\nversion: {version}\n" in cited
    assert newest == f"[{version}] - {date}"


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
