"""The way of one episode, from the command line to a page of the book: what CONTRIBUTING.md lists, and no more.

A file is on the way if one of its functions waits while the engine simulates, while the rows are written, while the
tables are joined, or while the page reads them. Laws, the judge and what they stand on are called, and return.
"""

import re
import shutil
import sys
import threading
from pathlib import Path

import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.base.provenance import ROOT
from bench.cli import main
from bench.engines import simulate as engine
from bench.experiments.tables import store
from report.figures.kit.page import contents, run_in, text_of
from report.figures.responses import settling_time

WORDS = (
    *("run", "--experiment", "free-body", "--starts", "paper"),
    *("--regulator", "rotation-matrix", "--engine", "native"),
)
STEPS = {engine.run.__code__, store.write_table.__code__, store.merge.__code__, store.read.__code__}
"""Functions at which the waiting callers are recorded."""

MOST = 15
REFERENCE = ROOT / "results" / "reference"


def listed() -> list[str]:
    """The files that CONTRIBUTING.md names in its section, in order."""
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    section = text.partition("## The way of one episode")[2].partition("\n## ")[0]
    return re.findall(r"^\d+\. `([^`]+)`", section, re.MULTILINE)


def test_way_of_an_episode_is_the_one_listed(tmp_path):
    waiting: set[Path] = set()
    shown = shutil.copytree(REFERENCE, tmp_path / "reference")  # of which no other test has read a table

    def look(frame, event, _):
        if event == "call" and frame.f_code in STEPS:
            while frame:
                waiting.add(Path(frame.f_code.co_filename))
                frame = frame.f_back

    threading.setprofile(look)
    sys.setprofile(look)
    try:
        assert main([*WORDS, "--out", str(tmp_path / "run"), "--workers", "1"]) == 0
        contents(settling_time, run_in(shown), text_of("responses.settling_time"))
    finally:
        sys.setprofile(None)
        threading.setprofile(None)
    ours = {path.relative_to(ROOT).as_posix() for path in waiting if path.is_relative_to(ROOT)}
    way = {name for name in ours if name.startswith(("bench/", "report/", "tasks/"))}
    assert "\n".join(sorted(way)) == "\n".join(sorted(listed()))
    assert len(way) <= MOST
