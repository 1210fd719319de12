"""Compare gate after gate: two runs' folders (`compare_folders`), or two states of the code (`compare_revisions`)."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.base.errors import BadLaw, BadResults
from bench.findings.judged import judged
from bench.findings.judgement import Judgement
from bench.law.contenders.described_law import described
from bench.regression.revisions import commits, exact
from bench.regression.revisions.comparison import IMPROVEMENT, REGRESSION, Comparison, Finding, Gate, make_gate
from bench.regression.revisions.measures import compare_measures
from bench.regression.revisions.timing import ROUNDS, SAME, SLOWER, Side, SideFailed, Timed, compare_times

EXACT, OPERATIONS, TIME, FAULTS = exact.EXACT, exact.OPERATIONS, "time", "faults"


class Means(NamedTuple):
    """The functions that run, time and judge a side, so that tests can give others; rounds: 0 leaves time out."""

    run_side: Callable = commits.run_side
    compare_times: Callable = compare_times
    judge: Callable[..., list[Judgement]] = judged
    rounds: int = ROUNDS


def compare_folders(base: Path, head: Path) -> Comparison:
    """Compare two folders of finished runs row by row; nothing is run."""
    found = exact.compare_runs(base, head)
    return Comparison(str(base), str(head), tuple(make_gate(name, found) for name in (EXACT, OPERATIONS)), tuple(found))


def compare_revisions(
    base: str, head: str | None, laws: tuple[Path, ...] = (), report: Callable = lambda *_: None, *, means: Means
) -> Comparison:
    """Compare two revisions, or a revision and the files in the checkout (head None), through every gate."""
    judgements: tuple[Judgement, ...] = ()
    with commits.check_out_both(base, head, laws) as (old, new):
        if new.is_new:
            raise BadResults(f"{new.name}: none of the --law files is there")
        gates, found, measures = _compare_rows(old, new, report, means)
        if new.only:
            report("judging")
            gate, faults, judgements = _compare_faults(old, new, means.judge)
            gates, found = [*gates, gate], [*found, *faults]
        gate, slower, times, files = _compare_times(old, new, report, means)
    found = sorted([*found, *slower], key=lambda one: one.verdict != REGRESSION)
    made = (*gates, gate), tuple(found), tuple(times), judgements, tuple(files), tuple(measures)
    return Comparison(old.name, new.name, *made)


def _compare_rows(
    old: Side, new: Side, report: Callable, means: Means
) -> tuple[list[Gate], list[Finding], list[dict[str, str]]]:
    """Compare outcomes and operations; return the measures of a user's laws too."""
    state, says = "passed", "both sides have the same sources and versions, so a run would be the same"
    if old.is_new:
        state, says = "skipped", "base has no such law, or it does not load: there is nothing to compare with"
    if old.is_new or (old.digest == new.digest and not new.only):
        return [Gate(name, state, says) for name in (EXACT, OPERATIONS)], [], []
    measures: list[dict[str, str]] = []
    with means.run_side(old, report) as before, means.run_side(new, report) as after:
        try:
            found = exact.compare_runs(before, after)
            measures = compare_measures(before, after) if new.only else []
        except BadResults as error:  # each program has just written its own run, so the schema differs
            found = [Finding(EXACT, REGRESSION, "", f"the schema differs: {error}")]
    return [make_gate(name, found) for name in (EXACT, OPERATIONS)], found, measures


def _compare_faults(
    old: Side, new: Side, judge: Callable[..., list[Judgement]]
) -> tuple[Gate, list[Finding], tuple[Judgement, ...]]:
    """Judge a user's laws on both sides by this program: a fault that base has not is a regression."""
    judgements: list[list[Judgement]] = [[], []]
    for at, side in enumerate((old, new)):
        try:
            judgements[at] = judge([described(law) for law in side.laws]) if side.laws else []
        except BadLaw as error:
            if side is new:
                return Gate(FAULTS, "failed", str(error)), [Finding(FAULTS, REGRESSION, "", str(error))], ()
    before, now = ({one.name: one.faults + ["lost"] * one.is_lost for one in each} for each in judgements)
    found, kept = [], []
    for name, faults in now.items():
        was = before.get(name, [])
        kept += [fault for fault in faults if fault in was]
        new_ones, mended = [each for each in faults if each not in was], [each for each in was if each not in faults]
        found += [Finding(FAULTS, REGRESSION, name, f"{name}: new fault: {each}") for each in new_ones]
        found += [Finding(FAULTS, IMPROVEMENT, name, f"{name}: no more: {each}") for each in mended]
    says = f"as in base: {', '.join(kept) or 'no fault'}"
    return make_gate(FAULTS, found, says), found, tuple(judgements[1])


def _compare_times(
    old: Side, new: Side, report: Callable, means: Means
) -> tuple[Gate, list[Finding], list[Timed], list[dict]]:
    is_same = old.digest == new.digest and not new.only
    if old.is_new or is_same or not means.rounds:
        says = "left out on request" if not means.rounds else "the same sources" if is_same else "there is no base"
        return Gate(TIME, "skipped", says), [], [], []
    try:
        files, times = means.compare_times(old, new, report, means.rounds)
    except SideFailed as error:
        if error.at == 0:
            return Gate(TIME, "skipped", f"base is too old for it: {error}"), [], [], []
        if not new.only:
            raise
        says = f"the law cannot be timed: {error}"
        return Gate(TIME, "failed", says), [Finding(TIME, REGRESSION, "", says)], [], []
    slower = [describe_time(one) for one in times.values() if one.verdict != SAME]
    return make_gate(TIME, slower, f"{len(times)} timed"), slower, list(times.values()), files


def describe_time(one: Timed) -> Finding:
    """Return the finding of a benchmark that is slower or faster."""
    says = (
        f"{one.name} is {one.verdict}: a tick takes {one.ratio:.2f} times as long [{one.low:.2f}, {one.high:.2f}], "
        f"p = {one.p:.1g}, {one.rounds} rounds of each, confirmed by a second run"
    )
    return Finding(TIME, REGRESSION if one.verdict == SLOWER else IMPROVEMENT, one.name, says)
