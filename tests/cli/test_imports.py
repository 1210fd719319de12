"""A command imports what it needs: each of these packages takes from a fifth of a second to a whole one."""

import subprocess
import sys
from pathlib import Path

import pytest
from support.user_law import spring_text

from bench.base.provenance import ROOT

SLOW = {"dm_control.mujoco", "matplotlib", "mujoco", "numba", "pandas", "pyarrow", "scipy"}
COMMAND = "from bench.cli import main; code = main({words})"
LAW = """
from bench.law.contenders.registry import find_contender
from bench.engines.simulate import evaluation
evaluation(find_contender("rotation-matrix"))
code = 0
"""
ONE = "run --regulator rotation-matrix --starts paper --engine ideal-held --count 1"


def imported(code: str) -> set[str]:
    """Modules that Python code has imported at its end."""
    told = f"import sys\n{code}\nprint(*sys.modules, file=sys.stderr)\nsys.exit(code)"
    ended = subprocess.run([sys.executable, "-c", told], capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return set(ended.stderr.split())


AUDIT = """
from bench.audit import audit
def columns(R, R_d):
    return [0.5 * sum(R[j, i] * R_d[k, i] - R[k, i] * R_d[j, i] for i in range(3)) for j, k in ((1, 2), (2, 0), (0, 1))]
code = len(audit(columns, allow=["dead-at-180"]).faults)
"""
NAMES = "import tasks; tasks.names(); tasks.pairs(); tasks.start_set('poles'); code = 0"
QUIET = ("--help", "run --help", "show --help", "list regulators", "list claims", f"{ONE} --dry-run")
ON_IDEAL = {"mujoco", "dask", "distributed", "numba", "pandas"}


@pytest.mark.parametrize(
    ("code", "watched", "needed"),
    [
        *((COMMAND.format(words=words.split()), SLOW, set()) for words in QUIET),
        (COMMAND.format(words=["--help"]), {"numpy", "pytest", "tasks"}, set()),
        (AUDIT, SLOW, set()),
        (NAMES, SLOW, set()),
        (COMMAND.format(words=["list"]), SLOW, {"mujoco"}),  # it reads files of arms
        (COMMAND.format(words=[*ONE.split(), "--out", "OUT"]), ON_IDEAL, {"numba", "pandas"}),
        (LAW, {"numba", "scipy.linalg"}, {"numba"}),  # compiled without linear algebra
    ],
)
def test_command_imports_of_what_is_slow_what_it_needs(code, watched, needed, tmp_path):
    assert watched & imported(code.replace("OUT", str(tmp_path / "out"))) == needed


def test_plugin_of_pytest_imports_no_more_than_what_starts_an_audit():
    found = imported("import bench.audit.plugin; code = 0")
    ours = {"", ".audit", ".audit.plugin", ".audit.apart", ".base", ".base.errors", ".base.isolated", ".base.processes"}
    assert {one for one in found if one.startswith(("bench", "tasks", "numpy"))} == {f"bench{one}" for one in ours}


@pytest.mark.parametrize(
    ("code", "ours"),
    [
        ("import bench; dir(bench); bench.audit; code = 0", {"bench", "bench.audit"}),
        ("import bench; hasattr(bench, 'nothing'); code = 0", {"bench"}),
    ],
)
def test_package_imports_no_room_of_its_own_and_no_other_package(code, ours):
    found = imported(code)
    assert {one for one in found if one.partition(".")[0] in ("bench", "tasks")} == ours
    assert not {one.partition(".")[0] for one in found} & (SLOW | {"numpy", "click", "rich"})


def test_python_without_our_packages_says_the_cure():
    ended = subprocess.run([sys.executable, "-S", "-m", "bench"], capture_output=True, text=True, cwd=ROOT)
    assert ended.returncode == 2
    assert ended.stderr == "error: the package rich_click is not installed (try: make setup)\n"


@pytest.mark.parametrize("words", ["--help", f"{ONE} --out ran --law mine.py", "audit sine.py:e --allow dead-at-180"])
def test_nothing_in_the_working_folder_runs(tmp_path, words):
    (tmp_path / "bench").mkdir()
    for name in ("bench/__init__", "tasks", "numpy", "pandas"):
        (tmp_path / f"{name}.py").write_text(f"open({str(tmp_path / 'found')!r}, 'w')")
    (tmp_path / "mine.py").write_text(spring_text())
    (tmp_path / "sine.py").write_text("def e(R, R_d): return (R_d @ R.T - R @ R_d.T)[[2, 0, 1], [1, 2, 0]] / 2")
    for command in (words, "show ran free-body")[: 1 + ("--out" in words)]:
        subprocess.run([Path(sys.executable).with_name("bench"), *command.split()], cwd=tmp_path, check=True)
    assert not (tmp_path / "found").exists()


def test_process_of_multiprocessing_imports_nothing_from_the_working_folder(tmp_path):
    (tmp_path / "multiprocessing.py").write_text("open('found', 'w')")
    here = "import sys; sys.path.pop(0); import multiprocessing as m, bench.__main__ as b; b.main()"
    command = [sys.executable, "-c", f"{here}; m.get_context('spawn').Process(target=int).start()", "--version"]
    subprocess.run(command, cwd=tmp_path, check=True, capture_output=True)
    assert not (tmp_path / "found").exists()
