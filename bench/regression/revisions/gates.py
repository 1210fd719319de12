"""Compare gate after gate: two runs' folders (`compare_folders`), or two states of the code (`compare_revisions`)."""

import contextlib
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import pandas as pd

from bench.base.errors import BadLaw, BadResults
from bench.experiments.tables.run import Run
from bench.findings.judge_law import judge_laws
from bench.findings.judgement import Judgement
from bench.law.contenders.described_law import described
from bench.regression.revisions import commits, exact
from bench.regression.revisions.summary import IMPROVEMENT, REGRESSION, Comparison, Finding
from bench.regression.revisions.times import SAME, SLOWER, Timed, compare_times
from bench.regression.timer import ROUNDS, Side, SideFailed

EXACT, TIME, FAULTS = exact.EXACT, "time", "faults"
ROWS = (EXACT, exact.OPERATIONS)

ENGINE = "ideal-rk4"
MEDIANS = {
    "settling_time_s": "settling time, median [s]",
    "effort": "effort, median",
    "peak_u": "peak command, median [rad/s²]",
}
STIFFNESS = "stiffness near the goal [kp]"


class GateFunctions(NamedTuple):
    """The functions that run, time and judge a side, so that tests can give others; rounds: 0 leaves time out."""

    run_side: Callable = commits.run_side
    compare_times: Callable = compare_times
    judge: Callable[..., list[Judgement]] = judge_laws
    rounds: int = ROUNDS


def compare_folders(base: Path, head: Path) -> Comparison:
    """Compare two folders of finished runs row by row; nothing is run."""
    comparison = Comparison(str(base), str(head))
    comparison.add(ROWS, exact.compare_runs(base, head))
    return comparison


def compare_revisions(
    base: str,
    head: str | None,
    laws: tuple[Path, ...] = (),
    report: Callable = lambda *_: None,
    *,
    functions: GateFunctions,
) -> Comparison:
    """Compare two revisions, or a revision and the files in the checkout (head None), through every gate."""
    with commits.check_out_both(base, head, laws) as (old, new):
        if new.is_new:
            raise BadResults(f"{new.name}: none of the --law files is there")
        comparison = Comparison(old.name, new.name)
        _compare_rows(comparison, old, new, report, functions)
        if new.only:
            report("judging")
            _compare_faults(comparison, old, new, functions.judge)
        _compare_times(comparison, old, new, report, functions)
    comparison.findings.sort(key=lambda one: one.verdict != REGRESSION)
    return comparison


def _compare_rows(
    comparison: Comparison, old: Side, new: Side, report: Callable, functions: GateFunctions
) -> None:
    """Compare outcomes and operations, and measure a user's laws too."""
    if old.is_new:
        return comparison.skip(
            ROWS, "base has no such law, or it does not load: there is nothing to compare with"
        )
    if old.digest == new.digest and not new.only:
        same = "both sides have the same sources and versions, so a run would be the same"
        return comparison.skip(ROWS, same, "passed")
    with functions.run_side(old, report) as before, functions.run_side(new, report) as after:
        try:
            found = exact.compare_runs(before, after)
            comparison.measures = compare_measures(before, after) if new.only else []
        except BadResults as error:  # each program has just written its own run, so the schema differs
            found = [Finding(EXACT, REGRESSION, "", f"the schema differs: {error}")]
    return comparison.add(ROWS, found)


def _compare_faults(
    comparison: Comparison, old: Side, new: Side, judge: Callable[..., list[Judgement]]
) -> None:
    """Judge a user's laws on both sides by this program: a fault that base has not is a regression."""
    judgements: list[list[Judgement]] = [[], []]
    for at, side in enumerate((old, new)):
        try:
            judgements[at] = judge([described(law) for law in side.laws]) if side.laws else []
        except BadLaw as error:
            if side is new:
                return comparison.fail(FAULTS, str(error))
    comparison.judgements = judgements[1]
    before, now = ({one.name: one.faults + ["lost"] * one.is_lost for one in each} for each in judgements)
    found, kept = [], []
    for name, faults in now.items():
        was = before.get(name, [])
        kept += [fault for fault in faults if fault in was]
        new_ones, mended = [each for each in faults if each not in was], [each for each in was if each not in faults]
        found += [Finding(FAULTS, REGRESSION, name, f"{name}: new fault: {each}") for each in new_ones]
        found += [Finding(FAULTS, IMPROVEMENT, name, f"{name}: no more: {each}") for each in mended]
    return comparison.add([FAULTS], found, f"as in base: {', '.join(kept) or 'no fault'}")


def _compare_times(
    comparison: Comparison, old: Side, new: Side, report: Callable, functions: GateFunctions
) -> None:
    """Time both sides in turns; equal sources only if somebody compares a commit with itself."""
    if not functions.rounds:
        return comparison.skip([TIME], "left out on request")
    if old.is_new:
        return comparison.skip([TIME], "there is no base")
    has_same_sources = old.digest == new.digest and not new.only
    if has_same_sources and old.name != new.name:
        return comparison.skip([TIME], "the same sources")
    try:
        comparison.files, times = functions.compare_times(old, new, report, functions.rounds)
    except SideFailed as error:
        if error.at == 0:
            return comparison.skip([TIME], f"base is too old for it: {error}")
        if not new.only:
            raise
        return comparison.fail(TIME, f"the law cannot be timed: {error}")
    comparison.times = list(times.values())
    differences = [describe_time(timed) for timed in comparison.times if timed.verdict != SAME]
    return comparison.add([TIME], differences, f"{len(times)} timed")


def describe_time(one: Timed) -> Finding:
    """Return the finding of a benchmark that is slower or faster."""
    says = (
        f"{one.name} is {one.verdict}: a tick takes {one.ratio:.2f} times as long [{one.low:.2f}, {one.high:.2f}], "
        f"p = {one.p:.1g}, {one.rounds} rounds of each, confirmed by a second run"
    )
    return Finding(TIME, REGRESSION if one.verdict == SLOWER else IMPROVEMENT, one.name, says)


def compare_measures(base: Path, head: Path) -> list[dict[str, str]]:
    """Return how a user's laws end on the free body, how fast, at what cost and how stiff: base, head, the change."""
    was, now, lines = _measure(base), _measure(head), []
    for law, what in now | was:
        before, after = (side.get((law, what), "none") for side in (was, now))
        lines.append({"law": law, "": what, "base": before, "head": after, "change": _change(before, after)})
    return lines


def _measure(folder: Path) -> dict[tuple[str, str], str]:
    """Return the measures of every law by its name and theirs, as text."""
    episodes, field = (Run(folder).table(name) for name in ("episodes", "command-field"))
    episodes = episodes[(episodes["arm"] == "") & (episodes["engine"] == ENGINE)]
    stiffness = field[field["finding"] == "stiffness"]
    found = {}
    for law, rows in episodes.groupby(episodes["contender"].astype(str), sort=False):
        settled = rows[rows["outcome"] == "settled"]
        for outcome, count in rows["outcome"].astype(str).value_counts().items():
            found[law, str(outcome)] = f"{count} of {len(rows)}"
        for column, name in MEDIANS.items():
            found[law, name] = _write(settled[column].median())
        for value in stiffness.loc[stiffness["contender"].astype(str) == law, "value"]:
            found[law, STIFFNESS] = _write(value)
    return found


def _write(value: float) -> str:
    return "none" if pd.isna(value) else f"{value:.4g}"


def _change(before: str, after: str) -> str:
    """Return by how many percent a number changed; empty where it did not, or where there is none."""
    with contextlib.suppress(ValueError, ZeroDivisionError):
        return f"{float(after) / float(before) - 1.0:+.1%}" if before != after else ""
    return ""
