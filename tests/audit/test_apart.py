"""Functions that would take the audit with them."""

from pathlib import Path

import pytest

from bench.audit.apart import audit_apart
from bench.base.errors import BadFunction

ERRORS = Path(__file__).with_name("errors.python").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("name", "faults", "said"),
    [
        ("exits", ["ends-process"], "it exits (SystemExit: bye)"),
        ("ends", ["ends-process"], "ended the process (exit code 0)"),
        ("reads_nowhere", ["ends-process"], "ended the process (SIGSEGV)"),
        ("loops", ["hangs"], "had not returned after"),
        ("prints", ["dead-at-180"], "FAULTS: dead-at-180 ("),
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
    with pytest.raises(BadFunction, match=r"too slow: .* calls were done in 4 s; give --limit \d+"):
        audit_apart(f"{tmp_path / 'mine.py'}:sleeps", {}, limit_s=4.0, progress=calls.append)
    assert calls == sorted(calls) != []


def test_file_that_ends_the_process_when_it_is_loaded_is_refused(tmp_path):
    (tmp_path / "mine.py").write_text("import os; os._exit(0)")
    with pytest.raises(BadFunction, match=r"the import of .* ended the process \(exit code 0\)"):
        audit_apart(f"{tmp_path / 'mine.py'}:f", {})
