"""Functions that would take the audit with them, and projects whose packages have the names of ours."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from bench.audit.apart import NotAudited, audit_apart
from bench.base.provenance import ROOT

ERRORS = Path(__file__).with_name("errors.python").read_text(encoding="utf-8")
PLUGIN = "orientation_audit_plugin"


@pytest.mark.parametrize(
    ("name", "faults", "said"),
    [
        ("exits", ["ends-process"], "it exits (SystemExit: bye)"),
        ("ends", ["ends-process"], "ended the process (exit code 0)"),
        ("reads_nowhere", ["ends-process"], "ended the process (SIGSEGV)"),
        ("loops", ["hangs"], "had not returned after"),
        ("prints", [], "no fault found"),
        ("cached", ["memory"], "another answer"),
        ("cached_by_rounding", ["memory"], "another answer"),
    ],
)
def test_function_is_named_for_what_it_does_and_for_nothing_else(tmp_path, capfd, name, faults, said):
    file = tmp_path / "mine.py"
    file.write_text(ERRORS)
    answer = audit_apart(f"{file}:{name}", {}, limit_s=15.0 if name == "loops" else 60.0)
    assert answer["report"]["faults"] == faults
    assert said in answer["text"]
    assert capfd.readouterr() == ("", "")


def test_function_that_is_too_slow_is_not_audited_and_the_limit_that_it_needs_is_said(tmp_path):
    (tmp_path / "mine.py").write_text(ERRORS)
    calls = []
    with pytest.raises(NotAudited, match=r"too slow: .* calls were done in 4 s; give --limit \d+"):
        audit_apart(f"{tmp_path / 'mine.py'}:sleeps", {}, limit_s=4.0, progress=calls.append)
    assert calls == sorted(calls) != []


def test_file_that_ends_the_process_when_it_is_loaded_is_refused(tmp_path):
    (tmp_path / "mine.py").write_text("import os; os._exit(0)")
    with pytest.raises(NotAudited, match=r"the import of .* ended the process \(exit code 0\)"):
        audit_apart(f"{tmp_path / 'mine.py'}:f", {})


@pytest.mark.parametrize(("words", "code"), [([], 0), (["--orientation-error", "bench.mine:half"], 1)])
def test_plugin_leaves_a_project_with_packages_of_our_names_alone(tmp_path, words, code):
    site, project = tmp_path / "site", tmp_path / "project"
    site.mkdir()
    for name in ("bench", "tasks"):
        (site / name).symlink_to(ROOT / name)
        (project / name).mkdir(parents=True)
        (project / name / "__init__.py").write_text("OURS = False")
    shutil.copy(ROOT / "bench" / "audit" / "installed" / f"{PLUGIN}.py", site)
    (project / "bench" / "mine.py").write_text(f"from bench import OURS\n{ERRORS}")
    (project / "test_it.py").write_text("import bench, tasks\ndef test_it(): assert not (bench.OURS or tasks.OURS)")
    environment = os.environ | {"PYTHONPATH": str(site), "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"}
    command = [sys.executable, "-m", "pytest", "-p", PLUGIN, "-p", "no:cacheprovider", *words]
    ended = subprocess.run(command, cwd=project, env=environment, capture_output=True, text=True)
    assert ended.returncode == code, ended.stdout + ended.stderr
    assert ("fault stiffness" in ended.stdout) == bool(words)
    assert f"{code} failed" in ended.stdout or not code
