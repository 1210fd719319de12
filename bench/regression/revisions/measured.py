"""The gates of instructions and of time: two processes, compiled, against each other; or one that is new, by itself."""

from collections.abc import Callable
from typing import NamedTuple

from bench.errors import MissingTool
from bench.regression.revisions import alternating, instructions, rule, self_measure
from bench.regression.revisions.comparison import (
    FAILED,
    FASTER,
    IMPROVEMENT,
    INSTRUCTIONS,
    PASSED,
    REGRESSION,
    SAME,
    SKIPPED,
    SLOWER,
    TIME,
    Benchmark,
    Finding,
    Gate,
    Timed,
)
from bench.regression.revisions.measurement import LAW, Measurement
from bench.regression.revisions.process import Process, running

Operations = tuple[self_measure.Operations, self_measure.Operations]
"""Of base and head."""


class Wanted(NamedTuple):
    """What a comparison of revisions is to do.

    same_code: whether a law whose machine code is the same on both sides is taken to be as fast, and not timed. The
    same instructions on the same processor differ only by where they lie in memory, which is no property of the law.
    """

    timing: bool = True
    rounds: int = alternating.ROUNDS
    seed: int = 0
    same_code: bool = True


def left_out(why: str) -> list[Gate]:
    """Both gates, skipped."""
    return [Gate(name, SKIPPED, why) for name in (INSTRUCTIONS, TIME)]


def measured(
    processes: list[Process], operations: Operations, wanted: Wanted, report: Callable[[str], None]
) -> tuple[list[Gate], list[Finding], list[Benchmark]]:
    """Both gates.

    Args:
        processes: base's and head's; head's alone if there is no base.
    """
    head, base = processes[-1], processes[0]
    counts, why = _counts(processes, report)
    laws = counts[0].keys() & counts[-1].keys() if len(processes) > 1 else set()
    found = [one for name in sorted(laws) if (one := _more(name, counts[0][name], counts[-1][name]))]
    gates = [Gate(INSTRUCTIONS, SKIPPED, why) if why else _gate(INSTRUCTIONS, found, f"{len(laws)} laws")]
    if len(processes) == 1:
        gates[0] = gates[0] if why else Gate(INSTRUCTIONS, SKIPPED, "there is no base to compare with")
    times: dict[str, Timed] = {}
    rounds: list[dict[str, alternating.Rounds]] = [{} for _ in processes]
    if not wanted.timing:
        gates.append(Gate(TIME, SKIPPED, "left out on request"))
    elif len(processes) == 1:
        rounds = alternating.take(processes, self_measure.timed(head), wanted.rounds, wanted.seed, report)
        gates.append(Gate(TIME, SKIPPED, "there is no base to compare with"))
    else:
        names = _to_time(base, head, wanted.same_code)
        rounds, first = timed_once(processes, names, wanted, report)
        times = first | second_run(processes, first, wanted, report)
        slower = [_slower(name, one) for name, one in times.items() if one.verdict != SAME]
        untimed = len(self_measure.timed(head)) - len(names)
        gates.append(_gate(TIME, slower, f"{len(names)} timed, {untimed} not: the same machine code, or new"))
        found += slower
    each = [
        self_measure.measurements(side, counted, taken, of)
        for side, counted, taken, of in zip(processes, counts, rounds, operations[-len(processes) :], strict=True)
    ]
    return gates, found, _benchmarks(each, times)


def _counts(processes: list[Process], report: Callable[[str], None]) -> tuple[list[dict[str, float]], str]:
    """Instructions of every law, side by side, or why there are none; the same code is counted once."""
    head, base = processes[-1], processes[0]
    report("counting instructions")
    try:
        of_head = instructions.count(head, self_measure.timed_laws(head))
        if base is head:
            return [of_head], ""
        same = {name for name in self_measure.timed_laws(base) if _same_code(base, head, name)}
        of_base = instructions.count(base, [name for name in self_measure.timed_laws(base) if name not in same])
    except MissingTool as error:
        return [{} for _ in processes], str(error)
    return [{**of_base, **{name: of_head[name] for name in same}}, of_head], ""


def _same_code(base: Process, head: Process, name: str) -> bool:
    """Whether a law compiles to the same machine code on both sides."""
    was, now = base.benchmarks.get(name), head.benchmarks.get(name)
    return was is not None and now is not None and bool(was.code) and was.code == now.code


def _to_time(base: Process, head: Process, same_code: bool) -> list[str]:
    both = [name for name in self_measure.timed(base) if name in set(self_measure.timed(head))]
    return [name for name in both if not (same_code and _same_code(base, head, name))]


def timed_once(
    processes: list[Process], names: list[str], wanted: Wanted, report: Callable[[str], None] = lambda _: None
) -> tuple[list[dict[str, alternating.Rounds]], dict[str, Timed]]:
    """The rounds of both sides, and the verdicts of this one run."""
    if not names:
        return [{} for _ in processes], {}
    rounds = alternating.take(processes, names, wanted.rounds, wanted.seed, report)
    return rounds, {name: rule.judge(rounds[0][name].ticks, rounds[1][name].ticks) for name in names}


def second_run(
    processes: list[Process], times: dict[str, Timed], wanted: Wanted, report: Callable[[str], None] = lambda _: None
) -> dict[str, Timed]:
    """What is left of verdicts other than "same", after a run of these alone in processes of their own."""
    suspects = [name for name, one in times.items() if one.verdict != SAME]
    if not suspects:
        return {}
    report(f"timing {len(suspects)} once more")
    with running([(side.checkout, side.laws) for side in processes]) as anew:
        _, again = timed_once(anew, suspects, wanted._replace(seed=wanted.seed + 1), report)
    return {name: rule.confirmed(times[name], again[name]) for name in suspects}


def _more(name: str, was: float, now: float) -> Finding | None:
    change = now / was - 1.0
    if abs(change) <= instructions.TOLERANCE:
        return None
    says = f"{name}: instructions a tick {was:.1f} -> {now:.1f} ({change:+.1%})"
    verdict = REGRESSION if change > 0 else IMPROVEMENT
    return Finding(INSTRUCTIONS, verdict, name, "instructions", f"{was:.1f}", f"{now:.1f}", says)


def _slower(name: str, one: Timed) -> Finding:
    says = (
        f"{name} is {one.verdict}: a tick takes {one.ratio:.2f} times as long [{one.low:.2f}, {one.high:.2f}], "
        f"p = {one.p:.1g}, {one.rounds} rounds of each, confirmed by a second run"
    )
    verdict = {SLOWER: REGRESSION, FASTER: IMPROVEMENT}[one.verdict]
    return Finding(TIME, verdict, name, "time a tick", "1", f"{one.ratio:.3f}", says)


def _gate(name: str, found: list[Finding], of: str) -> Gate:
    bad = sum(one.verdict == REGRESSION for one in found)
    return Gate(name, FAILED if bad else PASSED, f"{of}: {bad} regressions, {len(found) - bad} other changes")


def _benchmarks(each: list[dict[str, Measurement]], times: dict[str, Timed]) -> list[Benchmark]:
    was, now = each[0] if len(each) > 1 else {}, each[-1]
    found = []
    for name in (*now, *(name for name in was if name not in now)):
        old, new = was.get(name), now.get(name)
        known = new or old
        assert known is not None
        same = bool(old and new and known.what == LAW and old.code == new.code)
        found.append(Benchmark(name, known.what, old, new, times.get(name), same))
    return found
