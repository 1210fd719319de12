"""Ctrl-C: one line says what became of the work, and is true; no traceback, however early it comes."""

import pytest
from support.command_line import started

INTERRUPT = """
import builtins, os, signal, sys

# A job in a shell's background inherits that SIGINT is ignored.
signal.signal(signal.SIGINT, signal.default_int_handler)
import_as_usual = builtins.__import__

def interrupt_at(name, *rest):
    if name == {module!r}:
        builtins.__import__ = import_as_usual
        os.kill(os.getpid(), signal.SIGINT)
    return import_as_usual(name, *rest)

builtins.__import__ = interrupt_at
sys.argv = ["bench", *{words!r}]
from bench.__main__ import main
sys.exit(main())
"""
"""A Ctrl-C that comes when a module is first imported, and not at a time that depends on the machine."""


def interrupted(module: str, *words: str, cwd=None) -> tuple[int, str, str]:
    """Return exit code, stdout and stderr of a command that is stopped when it imports a module."""
    options = {"cwd": cwd} if cwd else {}
    process = started("-c", INTERRUPT.format(module=module, words=words), **options)
    out, err = process.communicate()
    return process.returncode, out, err


@pytest.mark.parametrize("module", ["os", "bench.base.signs", "rich_click", "bench.cli", "bench.base.errors"])
def test_early_interrupt_is_one_line(module):
    code, out, err = interrupted(module, "judge", "hybrid")
    assert (code, out) == (130, "")
    assert err == "stopped; nothing was begun\n"


NOT_WRITTEN = "stopped; nothing was written\n"


@pytest.mark.parametrize(
    ("module", "words", "said"),
    [
        ("bench.cli.paragraphs", ("judge", "hybrid"), NOT_WRITTEN),
        ("bench.findings.judge_law", ("judge", "hybrid"), NOT_WRITTEN),
        ("bench.findings.selection.advice", ("advise", "--run"), NOT_WRITTEN),
        ("bench.findings.claims.tables", ("claims", "results/reference"), NOT_WRITTEN),
        ("bench.running", ("run", "--suite", "quick"), "stopped; what was finished is kept, and the same command goes"),
        ("bench.running", ("map",), "stopped; what was finished is kept, and the same command goes on from there\n"),
        ("bench.regression", ("time", "--quick"), "stopped; this command keeps nothing of what was not finished"),
    ],
)
def test_interrupt_says_what_is_kept(tmp_path, module, words, said):
    given = ("--out", str(tmp_path / "out")) if words[0] in ("run", "map", "time") else ()
    code, _, err = interrupted(module, *words, *given)
    assert code == 130
    assert err.splitlines()[-1].startswith(said.rstrip("\n"))
    assert "Traceback" not in err
    assert not list(tmp_path.rglob("*.parquet"))
