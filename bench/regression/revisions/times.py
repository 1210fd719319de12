"""Time base and head in turns, and judge: slower by more than a tenth, beyond chance, twice.

Two conditions must hold: the Mann-Whitney test of the rounds rejects "not slower" at P, and the
median ratio of neighbouring rounds is above RATIO, which keeps out what is real but small. A second
run of the suspects, in new processes, must agree.

Limitations: a law that is slower by less than a tenth is not found, unless it has more operations.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bench.regression.timer import ROUNDS, Progress, Side, run_benchmarks

P = 0.002
"""Without a change, one comparison of thirty laws in seventeen has a p below P by chance."""

RATIO = 1.10

SAME = "same"
SLOWER = "slower"
FASTER = "faster"


class Timed(NamedTuple):
    """The verdict of a benchmark, of head over base.

    Attributes:
        name: Name of the benchmark.
        ratio: Median ratio of neighbouring rounds.
        low: Low end of its 95 % interval.
        high: High end of the interval.
        p: One-sided p-value of Mann and Whitney's test.
        rounds: Rounds of each side.
        verdict: SAME, SLOWER or FASTER.
        confirmed: Whether a second run agreed with a first verdict other than SAME; None if there
            was no second run.
    """

    name: str
    ratio: float
    low: float
    high: float
    p: float
    rounds: int
    verdict: str
    confirmed: bool | None = None


def judge_rounds(name: str, base: np.ndarray, head: np.ndarray) -> Timed:
    """Return the verdict of one run, of one time a round in the order of the rounds."""
    from scipy.stats import mannwhitneyu

    from bench.experiments.tables.statistics import order_interval  # both are slow to import

    ratios = np.sort(head / base)
    low, high = order_interval(len(ratios), 0.5)
    ratio = float(np.median(ratios))
    p_slower = float(mannwhitneyu(head, base, alternative="greater").pvalue)
    p_faster = float(mannwhitneyu(head, base, alternative="less").pvalue)
    verdict = SAME
    if p_slower < P and ratio > RATIO:
        verdict = SLOWER
    elif p_faster < P and ratio < 1.0 / RATIO:
        verdict = FASTER
    return Timed(
        name=name,
        ratio=ratio,
        low=float(ratios[low]),
        high=float(ratios[high]),
        p=min(p_slower, p_faster),
        rounds=len(base),
        verdict=verdict,
    )


def list_ticks(file: dict[str, Any]) -> dict[str, np.ndarray]:
    """Return the seconds of a tick in each round, by name, of a file of pytest-benchmark."""
    times = {}
    for benchmark in file["benchmarks"]:
        seconds = np.array(benchmark["stats"]["data"])
        times[benchmark["param"]] = seconds / benchmark["extra_info"]["ticks"]
    return times


def judge_files(base: dict[str, Any], head: dict[str, Any]) -> dict[str, Timed]:
    """Return the verdict of one run by name, of base's and head's files of pytest-benchmark."""
    base_ticks = list_ticks(base)
    head_ticks = list_ticks(head)
    verdicts = {}
    for name, ticks in base_ticks.items():
        verdicts[name] = judge_rounds(name, ticks, head_ticks[name])
    return verdicts


def confirm(first: Timed, second: Timed) -> Timed:
    """Return the first verdict if the second agrees, else "same".

    The numbers are the second's, which nobody picked.
    """
    agrees = second.verdict == first.verdict
    return second._replace(verdict=first.verdict if agrees else SAME, confirmed=agrees)


def compare_times(
    base: Side,
    head: Side,
    report: Callable[[str], None] = lambda _: None,
    rounds: int = ROUNDS,
) -> tuple[list[dict[str, Any]], dict[str, Timed]]:
    """Time both sides, and once more what differs.

    Return the two files of the first run, and verdicts by name.
    """

    def say(progress: Progress) -> None:
        report(f"timed {progress.name}, {progress.done} of {progress.total}")

    report("compiling and timing")
    files = run_benchmarks([base, head], rounds=rounds, report=say)
    times = judge_files(*files)
    suspects = []
    for benchmark in files[0]["benchmarks"]:
        if times[benchmark["param"]].verdict != SAME:
            suspects.append(benchmark["fullname"])
    if suspects:
        report("timing once more what differs")
        again = [side._replace(benchmarks=tuple(suspects)) for side in (base, head)]
        second_times = judge_files(*run_benchmarks(again, rounds=rounds, report=say))
        for name, second in second_times.items():
            times[name] = confirm(times[name], second)
    return files, times
