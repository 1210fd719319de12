"""One comparison, gate after gate: `of_folders` of two runs, `of_revisions` of two states of the code."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.errors import BadResults
from bench.files import read_json
from bench.findings.judged import judged
from bench.findings.judgement import Judgement
from bench.regression.revisions import checkouts, exact, faults, self_measure
from bench.regression.revisions.checkouts import Checkout
from bench.regression.revisions.comparison import (
    EXACT,
    FAILED,
    INSTRUCTIONS,
    OPERATIONS,
    PASSED,
    REGRESSION,
    SKIPPED,
    Benchmark,
    Comparison,
    Finding,
    Gate,
    Side,
)
from bench.regression.revisions.measured import Operations, Wanted, left_out, measured
from bench.regression.revisions.process import SideFailed, running
from bench.regression.rows import differences
from bench.regression.rows.difference import JUDGE
from bench.tables.store import read

Report = Callable[[str], None]
ALL = Wanted()


class Means(NamedTuple):
    """What the gates are carried out by: a finished run of a side, both's processes, what they measure, the judge."""

    finished_run: Callable = checkouts.finished_run
    running: Callable = running
    measured: Callable = measured
    judged: faults.Judge = judged


USUAL = Means()


def of_folders(base: Path, head: Path) -> Comparison:
    """Two runs' folders, row by row; nothing is run.

    Errors:
        BadResults: a folder holds no finished run.
    """
    found = _exact(base, head)
    was, now = (Side(str(one), **_origin(one)) for one in (base, head))
    return Comparison(was, now, self_measure.machine(), tuple(_gates(found, (EXACT, OPERATIONS))), tuple(found), ())


def _origin(folder: Path) -> dict[str, str]:
    about = read_json(folder / "provenance.json")
    return {"commit": about["commit"], "sources": about["sources"]}


def _exact(base: Path, head: Path) -> list[Finding]:
    found = differences(base, head)
    if any(one.kind == JUDGE for one in found):
        return [*exact.lost(head), *exact.findings(found)]
    return [*exact.lost(head), *exact.removed(found, head), *exact.basins(base, head), *exact.findings(found)]


def _gates(found: list[Finding], names: tuple[str, ...]) -> list[Gate]:
    """What came of gates that were not left out."""
    gates = []
    for name in names:
        of_gate = [one for one in found if one.gate == name]
        bad = sum(one.verdict == REGRESSION for one in of_gate)
        says = f"{bad} regressions, {len(of_gate) - bad} other changes" if of_gate else "nothing differs"
        gates.append(Gate(name, FAILED if bad else PASSED, says))
    return gates


def of_revisions(
    base: str,
    head: str | None,
    laws: tuple[Path, ...] = (),
    wanted: Wanted = ALL,
    report: Report = lambda _: None,
    by: Means = USUAL,
) -> Comparison:
    """Two revisions, or a revision and the files as they lie (head None), through every gate.

    Errors:
        UnknownWord, Incompatible: a revision. BadResults: a side does not run. BadLaw: a user's file.
    """
    with checkouts.checkouts(base, head, laws) as (old, new):
        if new.is_new:
            raise BadResults(f"{new.name}: none of the --law files is there")
        gates, found, operations = _by_rows(old, new, report, by)
        more_gates, more, benchmarks = _by_process(old, new, operations, wanted, report, by)
        judgements: tuple[Judgement, ...] = ()
        if new.own:
            report("judging")
            gate, of_laws, judgements = faults.compared(old, new, by.judged)
            more_gates, more = [gate, *more_gates], [*of_laws, *more]
        machine = self_measure.machine()
    was, now = (Side(one.name, one.commit, one.sources) for one in (old, new))
    return Comparison(was, now, machine, (*gates, *more_gates), (*found, *more), tuple(benchmarks), judgements)


def _by_rows(old: Checkout, new: Checkout, report: Report, by: Means) -> tuple[list[Gate], list[Finding], Operations]:
    """The exact gate and that of operations."""
    if old.is_new:
        with by.finished_run(new, report) as run:
            counted, found = self_measure.by_law(read(run, "costs")), exact.lost(run)
        says = f"base's does not load ({old.broken})" if old.broken else "the law is new"
        says += ": there is nothing to compare it with"
        gates = _gates(found, (EXACT,)) if found else [Gate(EXACT, SKIPPED, says)]
        return [*gates, Gate(OPERATIONS, SKIPPED, says)], found, ({}, counted)
    if old.sources == new.sources and not new.own:
        says = "both sides have the same sources and versions, so a run would be the same"
        return [Gate(name, PASSED, says) for name in (EXACT, OPERATIONS)], [], ({}, {})
    with by.finished_run(old, report) as before, by.finished_run(new, report) as after:
        try:
            found = _exact(before, after)
            operations = self_measure.by_law(read(before, "costs")), self_measure.by_law(read(after, "costs"))
        except BadResults as error:  # both have just been written by their own program: it is the schema that differs
            says = f"the schema differs: {error}"
            found, operations = [Finding(EXACT, REGRESSION, "", "schema", "", "", says)], ({}, {})
    return _gates(found, (EXACT, OPERATIONS)), found, operations


def _by_process(
    old: Checkout, new: Checkout, operations: Operations, wanted: Wanted, report: Report, by: Means
) -> tuple[list[Gate], list[Finding], list[Benchmark]]:
    """The gates of instructions and time, which need both sides compiled."""
    if not (old.is_new or checkouts.locks_agree(old, new)):
        return left_out(f"{checkouts.LOCK} differs, so base was made for other packages than are installed"), [], []
    report("compiling")
    both = [(new.path, new.asked)] if old.is_new else [(old.path, old.asked), (new.path, new.asked)]
    try:
        with by.running(both) as processes:
            return by.measured(processes, operations, wanted, report)
    except SideFailed as error:
        if error.at < len(both) - 1:
            return left_out(f"base is too old for it: {error}"), [], []
        if not new.own:
            raise
        found = Finding(INSTRUCTIONS, REGRESSION, "", "compiled", "", "", f"the law cannot be timed: {error}")
        return [Gate(INSTRUCTIONS, FAILED, str(error)), *left_out("")[1:]], [found], []
