"""Older commits measured today: each in a checkout of its own that goes away, with today's packages.

It is how the history began, and how a machine that joins later gets a past of its own. Fails: on commits before
the laws lay in bench/contenders, and where today's packages do not run their sources.
"""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pandas as pd

from bench.errors import Incompatible
from bench.provenance import ROOT
from bench.regression.revisions import alternating, commits, instructions, self_measure
from bench.regression.revisions.checkouts import python_in
from bench.regression.revisions.process import Laws, running

COUNT = """
import json
from bench import counting
from bench.contenders.registry import all_contenders
print(json.dumps(counting.rows(all_contenders())))
"""
"""Run in the checkout: every row of operations of its laws."""


def measure(revision: str, report: Callable[[str], None] = lambda _: None) -> self_measure.SelfMeasure:
    """All benchmarks of a commit, as `self_measure.measure` does of this checkout.

    Errors:
        UnknownWord: no such commit. Incompatible: its sources do not run. MissingTool: no valgrind.
    """
    commit = commits.commit_of(ROOT, revision)
    report(f"{commit[:10]}: compiling")
    with commits.worktree(ROOT, commit) as checkout, running([(checkout, Laws())]) as [side]:
        report(f"{commit[:10]}: counting")
        counted = instructions.count(side, self_measure.timed_laws(side))
        operations = self_measure.by_law(pd.DataFrame(_counts(checkout)))
        report(f"{commit[:10]}: timing")
        [rounds] = alternating.take([side], self_measure.timed(side))
        found = self_measure.measurements(side, counted, rounds, operations)
    return self_measure.SelfMeasure(commit, False, side.sources, self_measure.machine(), tuple(found.values()))


def _counts(checkout: Path) -> list[dict[str, Any]]:
    ended = python_in(checkout, "-P", "-c", COUNT)
    if ended.returncode:
        raise Incompatible(f"{checkout.name}: its laws cannot be counted ({ended.stderr.strip().splitlines()[-1]})")
    return json.loads(ended.stdout)
