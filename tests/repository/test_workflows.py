"""Workflow files: what they run can be run by hand, nobody's text reaches a shell, no token can do more than asked."""

import importlib.util
import json
import os
import re
import shutil
import subprocess
from pathlib import Path

import pytest
import yaml

from bench.base.provenance import ROOT

FILES = sorted((ROOT / ".github" / "workflows").glob("*.yml"))
TARGETS = set(re.findall(r"^([a-z-]+):", (ROOT / "Makefile").read_text(), re.MULTILINE))
SYSTEM = ("sudo apt-get", "git config", "echo ")


def steps(path: Path) -> list[dict]:
    content = yaml.safe_load(path.read_text())
    return [step for job in content["jobs"].values() for step in job["steps"]]


@pytest.mark.parametrize("path", FILES)
def test_what_a_workflow_runs_is_a_target_or_a_script_of_ours(path):
    for step in steps(path):
        for line in step.get("run", "").splitlines():
            word, _, rest = line.strip().partition(" ")
            is_ours = (word == "make" and rest.split()[0] in TARGETS) or (ROOT / word).is_file()
            assert is_ours or line.strip().startswith(SYSTEM), line


@pytest.mark.parametrize("path", FILES)
def test_workflow_shells_no_text_of_others_names_permissions_keeps_no_credentials_and_pins_actions(path):
    assert [step["run"] for step in steps(path) if "${{" in step.get("run", "")] == []
    content = yaml.safe_load(path.read_text())
    assert "pull_request_target" not in content.get(True, {})
    assert all("permissions" in content or "permissions" in job for job in content["jobs"].values())
    used = re.findall(r"uses: (.*)", path.read_text())
    assert [one for one in used if not re.fullmatch(r"actions/[a-z-]+@[0-9a-f]{40}  # v\d+\.\d+\.\d+", one)] == []
    checkouts = [step for step in steps(path) if step.get("uses", "").startswith("actions/checkout@")]
    assert [step["with"]["persist-credentials"] for step in checkouts] == [False] * len(checkouts)


def test_job_that_runs_a_strangers_law_may_only_read_and_none_of_its_files_is_run_by_the_other():
    judge, comment = yaml.safe_load((ROOT / ".github/workflows/judge.yml").read_text())["jobs"].values()
    assert judge["permissions"] == {"contents": "read"}
    assert not any("GH_TOKEN" in step.get("env", {}) for step in judge["steps"])
    taken, script, said = comment["steps"]
    assert taken["with"]["path"] != script["with"]["path"] == said["working-directory"]


GH = """#!/bin/sh
echo "$@" >>said
for last; do case $last in body=@*) cp "${last#body=@}" body ;; esac; done
case "$*" in *--jq*) jq -r "$last" comments.json ;; esac
"""


@pytest.mark.skipif(not shutil.which("jq"), reason="jq is not installed (cure: apt install jq)")
@pytest.mark.parametrize(("law", "does"), [("b.py", "PATCH repos/o/n/issues/comments/11"), ("c.py", "POST ")])
def test_comment_on_a_law_takes_the_place_of_its_own_and_of_no_other(tmp_path, law, does):
    (tmp_path / "gh").write_text(GH)
    (tmp_path / "gh").chmod(0o755)
    (tmp_path / "judge.md").symlink_to(ROOT / "LICENSE")
    bot, marker = "github-actions[bot]", "<!-- orientation-bench judge: {} -->"
    there = [(10, bot, "a.py"), (11, bot, "b.py"), (12, "somebody", "b.py"), (13, bot, "a.py")]
    comments = [{"id": n, "user": {"login": who}, "body": f"{marker.format(of)}\nold"} for n, who, of in there]
    (tmp_path / "comments.json").write_text(json.dumps(comments))
    given = {"PATH": f"{tmp_path}:{os.environ['PATH']}", "LAW": law, "GH_REPO": "o/n", "NUMBER": "7"}
    subprocess.run([ROOT / ".ci/comment", "judge.md"], cwd=tmp_path, env=os.environ | given, check=True)
    assert f"--method {does}" in (tmp_path / "said").read_text().splitlines()[-1]
    assert (tmp_path / "body").read_text().startswith(f"{marker.format(law)}\n### Not judged: {law} left no table")


@pytest.fixture
def audit(monkeypatch):
    """The script .ci/audit.py as a module."""
    made = importlib.util.spec_from_file_location("audit", ROOT / ".ci" / "audit.py")
    module = importlib.util.module_from_spec(made)
    made.loader.exec_module(module)
    return module


PACKAGE = {"name": "numpy", "version": "1.0"}
FLAW = {"id": "CVE-1", "fix_versions": ["1.1"]}


@pytest.mark.parametrize(
    ("known", "code", "words"),
    [
        ([PACKAGE | {"vulns": []}], 0, "1 of 1 packages audited, 0 known vulnerabilities"),
        ([PACKAGE | {"vulns": [FLAW]}, PACKAGE | {"skip_reason": "x"}], 1, "numpy 1.0 has CVE-1, fixed in 1.1"),
        ([PACKAGE | {"skip_reason": "not found"}], 2, "not audited, the index knows nothing"),
        ("no route to host", 2, "not audited, no answer (no route to host)"),
    ],
)
def test_audit_fails_for_a_vulnerability_and_says_what_it_could_not_ask(audit, monkeypatch, capsys, known, code, words):
    monkeypatch.setattr(audit, "audit", lambda lock: known)
    assert audit.main(["a.txt"]) == code
    assert words in capsys.readouterr().out


def test_audit_without_its_tool_is_no_vulnerability(audit, monkeypatch):
    monkeypatch.setattr(audit, "AUDIT", ("-c", "import sys; sys.exit('no network')"))
    assert audit.audit("a.txt") == "no network"


@pytest.mark.parametrize("name", ["base", "report", "dev", "libraries", "arrays", "audit"])
def test_lock_holds_names_versions_and_hashes_only(name):
    line = re.compile(r"[a-z0-9._\[\],-]+==[\w.!+-]+(?: ; [^\\]+)?(?: \\)?|    --hash=sha256:[0-9a-f]{64}(?: \\)?")
    lines = (ROOT / "requirements" / f"{name}.txt").read_text().splitlines()
    assert [one for one in lines if not line.fullmatch(one)] == []
