"""A command imports what it needs: each of these packages takes from a fifth of a second to a whole one."""

import subprocess
import sys

import pytest

SLOW = {"dm_control", "matplotlib", "mujoco", "numba", "pandas", "pyarrow", "scipy"}
CALLED = """
import sys
from bench.cli import main
code = main(sys.argv[1:])
print(*sys.modules, sep="\\n", file=sys.stderr)
sys.exit(code)
"""
ONE = "run --regulator rotation-matrix --starts paper --engine ideal-held --count 1"


def imported(*words) -> set[str]:
    """Modules that a command has imported at its end."""
    ended = subprocess.run([sys.executable, "-c", CALLED, *words], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return set(ended.stderr.split())


@pytest.mark.parametrize(
    "words", ["--help", "run --help", "show --help", "list regulators", "list claims", f"{ONE} --dry-run"]
)
def test_command_that_computes_nothing_imports_nothing_slow(words):
    assert not SLOW & imported(*words.split())


def test_list_imports_mujoco_alone_for_it_reads_files_of_arms():
    assert SLOW & imported("list") == {"mujoco"}


def test_run_on_the_ideal_plant_imports_neither_mujoco_nor_linear_algebra(tmp_path):
    found = imported(*ONE.split(), "--out", str(tmp_path / "out"))
    assert {"numba", "pandas", "pyarrow"} <= found
    assert not {"mujoco", "dm_control", "matplotlib", "scipy.linalg"} & found
