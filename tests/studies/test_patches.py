"""A patch for a library applies to the installed one, and its test fails before and passes after."""

import importlib.util
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from bench.base.provenance import ROOT

PATCHES = sorted((ROOT / "bench" / "studies" / "libraries" / "patches").glob("*.patch"))
PACKAGES = {"mink": ("mink", "."), "numpy-quaternion": ("quaternion", "src")}
"""Patch -> the package, and its folder in the library's repository."""


def outcome(folder: Path, source: str) -> int:
    """Return the exit code of the patch's test, run in its own process."""
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c", "/dev/null", "tests"]
    environment = {"PYTHONPATH": str(folder / source), "PATH": "/usr/bin:/bin"}
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=False).returncode


@pytest.mark.parametrize("patch", PATCHES, ids=lambda path: path.stem)
def test_patch_cures_the_installed_library(patch, tmp_path):
    package, source = PACKAGES[patch.stem]
    spec = importlib.util.find_spec(package)
    if spec is None or spec.origin is None:
        pytest.skip(f"{package} is not installed here")
    shutil.copytree(Path(spec.origin).parent, tmp_path / source / package)
    (added,) = re.findall(r"^\+\+\+ b/(tests/\S+)", patch.read_text(), re.MULTILINE)
    for part, expected in ((["--include", added], 1), (["--exclude", added], 0)):
        subprocess.run(["git", "apply", *part, patch], cwd=tmp_path, check=True)
        assert outcome(tmp_path, source) == expected
