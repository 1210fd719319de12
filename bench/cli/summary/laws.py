"""The table of laws on the free body: what each settles, how fast, where it fails, and what a control step takes."""

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np
import pandas as pd

from bench.cli.summary.lines import HEAD, write_percent, write_seconds
from bench.experiments.tables.run import FREE_BODY, MAIN_ENGINE, Run, converged
from bench.experiments.tables.statistics import quantile
from bench.findings.answer import attribute
from bench.findings.claims.adequacy import tallied
from bench.findings.claims.tables import CHECK_ENGINES, settled, settling_times, share
from bench.findings.failure_places import describe_failures, least_trapping_noise
from bench.findings.perturbed import DETOUR
from bench.findings.replication import AT_REST, NEARLY_ALL
from bench.law.attribution import ADAPTED, OURS, PUBLISHED, YOURS
from bench.law.contenders.registry import papers_coordinates

NONE_FOUND = "none found"
TRAPPED = "trapped by noise"
UNWINDS = "turns the long way"
NOT_TRIED = "*"
"""Behind a law on which noise was not tried."""

GROUPS = {
    YOURS: "yours",
    PUBLISHED: "since 1988, published",
    ADAPTED: "since 1988, adapted (published parts, combined or changed here)",
    OURS: "since 1988, ours (not reviewed, not advised)",
}
"""Attribution -> the heading of such laws."""


class Row(NamedTuple):
    """A law of the table.

    settles: share with its interval, or a count where no start is uniform. times: 50 % and 99 % settle within these
    [s]. fails: places. noise: least sensor error that traps it [rad], infinite for none, None where it was not tried.
    operations: flops and calls, None if they were not counted. nanoseconds: of a step, NaN if it was not timed. effort,
    peak: medians and maxima of the uniform starts, NaN if they are not there.
    """

    law: str
    engine: str
    starts: int
    settles: str
    times: tuple[float, float]
    fails: tuple[str, ...]
    noise: float | None
    operations: tuple[int, int] | None
    nanoseconds: float
    peak: float
    effort: float


def list_laws(run: Run) -> list[str]:
    """Return the laws of the free body in a run, in the order of its rows."""
    rows = run.table("episodes", **FREE_BODY, task="free-body")
    return [str(law) for law in rows["contender"].unique()]


def name_law(law: str) -> str:
    """Return a law as the command line names it, without the paper's own coordinates."""
    return law.removesuffix(f"/{papers_coordinates().name}")


def measure_law(run: Run, law: str) -> Row:
    """Return the row of a law that is in the run."""
    rows = run.table("episodes", **FREE_BODY, task="free-body")
    rows = rows[rows["contender"].astype(str) == law]
    engine = next(
        name
        for name in (MAIN_ENGINE, *CHECK_ENGINES, *rows["engine"].astype(str))
        if (rows["engine"] == name).any()
    )
    rows = converged(rows[rows["engine"] == engine])
    at_rest = rows[rows["start_set"].isin(AT_REST)]
    uniform = rows[rows["start_set"] == "uniform"]
    timed = uniform if len(uniform) else rows
    noise = least_trapping_noise(run, law)
    return Row(
        law,
        engine,
        len(timed),
        _write_share(uniform, rows),
        _find_times(timed),
        tuple(_list_failures(at_rest, noise)),
        noise,
        _count_operations(run, law),
        _find_nanoseconds(run, law),
        float(timed["peak_u"].max()),
        float(timed["effort"].median()),
    )


def _write_share(uniform: pd.DataFrame, rows: pd.DataFrame) -> str:
    """Write the share of uniform starts that settle with its Wilson interval; of other starts their count."""
    if len(uniform):
        one = share(settled(uniform))
        return f"{write_percent(one.value)} ({write_percent(one.low)}-{write_percent(one.high)})"
    return f"{int(settled(rows).sum())} of {len(rows)}"


def _find_times(rows: pd.DataFrame) -> tuple[float, float]:
    if rows.empty:
        return math.nan, math.nan
    times = settling_times(rows)
    return float(quantile(times, 0.5)), float(quantile(times, NEARLY_ALL))


def _list_failures(at_rest: pd.DataFrame, noise: float | None) -> Iterator[str]:
    """Yield where a law fails; a law that fails nowhere may be trapped by noise, or turn the long way."""
    if at_rest.empty:
        yield "not tested"
        return
    places = describe_failures(at_rest)
    yield from places
    if not places and noise is not None and math.isfinite(noise):
        yield TRAPPED
    elif not places:
        plain = at_rest[at_rest["start_set"].isin(("uniform", "half-turn"))]
        is_long = bool((plain["path_ratio"] > DETOUR).any())
        yield UNWINDS if is_long else NONE_FOUND


def _count_operations(run: Run, law: str) -> tuple[int, int] | None:
    """Return flops and calls of a typical step, the goal given as a matrix; None if the run did not count them."""
    costs = run.table("costs", **FREE_BODY, branch="typical")
    costs = costs[costs["contender"].astype(str) == law]
    if costs.empty:
        return None
    spent = tallied(costs, with_goal=True)
    return spent.flops, spent.calls


def _find_nanoseconds(run: Run, law: str) -> float:
    """Return the time of a step, the median over the machines that were timed; NaN if none timed the law."""
    timings = run.timings()
    return (
        float(np.median(own))
        if len(own := timings.loc[timings["contender"] == law, "ns_per_tick"])
        else math.nan
    )


HEADS = f"{'':{HEAD}} {'settles %':14} {'50 %':>5} {'99 %':>6}  {'fails at':17} {'ops':>5} {'ns':>4}"
MEDIAN_END = HEAD + 21
"""Column in which the median time ends."""

WITH_EFFORT = f"{'':{HEAD}} {'settles %':14} {'50 %':>5} {'99 %':>6} {'peak/kp':>7} {'effort':>8} {'ops':>6} {'ns':>5}"
"""Heads of the table: of many laws, and of few laws with their commands."""


UNITS_WITH_EFFORT = (
    "peak/kp: greatest command over kp [rad]; "
    "effort: integral of the squared command, median start [rad2/s3]."
)


def format_row(row: Row) -> list[str]:
    """Return the lines of a law: a long name and a second place of failure have lines of their own.

    A name stays in the line of its numbers if it and the share fit before the median time.
    """
    name = name_law(row.law)
    median, nearly_all = map(write_seconds, row.times)
    first = []
    start = f"{name} {row.settles}" if len(name) > HEAD else f"{name:{HEAD}} {row.settles}"
    if len(start) + 1 + len(median) > MEDIAN_END:
        first = [name]
        start = f"{'':{HEAD}} {row.settles}"
    places = _list_places(row)
    lines = [
        *first,
        f"{start}{median:>{MEDIAN_END - len(start)}} {nearly_all:>6}  {places[0]:17} {_write_operations(row):>5} "
        f"{_write_nanoseconds(row):>4}",
    ]
    return [*lines, *(f"{'':{HEAD + 30}}{place}" for place in places[1:])]


def _list_places(row: Row) -> list[str]:
    """Return the places, with a comma between two, and a star where noise was not tried."""
    star = NOT_TRIED if row.noise is None and row.fails == (NONE_FOUND,) else ""
    return [f"{place}," for place in row.fails[:-1]] + [f"{row.fails[-1]}{star}"]


def format_with_effort(row: Row, kp: float) -> list[str]:
    """Return the lines of a law with the greatest command over kp, the effort, and where it fails below."""
    name, first = _split_name(row.law)
    median, nearly_all = map(write_seconds, row.times)
    return [
        *first,
        f"{name:{HEAD}} {row.settles:14} {median:>5} {nearly_all:>6} {row.peak / kp:>7.3g} {row.effort:>8,.0f} "
        f"{_write_operations(row):>6} {_write_nanoseconds(row):>5}",
        f"{'':{HEAD}} fails at: {' '.join(_list_places(row))}",
    ]


def _split_name(law: str) -> tuple[str, list[str]]:
    name = name_law(law)
    return (name, []) if len(name) <= HEAD else ("", [name])


def _write_operations(row: Row) -> str:
    if row.operations is None:
        return "-"
    flops, calls = row.operations
    return f"{flops}+{calls}" if calls else str(flops)


def _write_nanoseconds(row: Row) -> str:
    return "-" if math.isnan(row.nanoseconds) else f"{row.nanoseconds:.0f}"


def format_groups(rows: Sequence[Row]) -> Iterator[str]:
    """Yield the lines of later laws under the word of their attribution, each group in the order given."""
    for attribution, heading in GROUPS.items():
        group = [row for row in rows if attribute(row.law) == attribution]
        if group:
            yield heading
            for row in group:
                yield from format_row(row)


def describe_columns(rows: Sequence[Row], run: Run) -> list[str]:
    """Say what the columns are, of how many starts, and what was not tested."""
    counts = sorted({row.starts for row in rows}, reverse=True)
    starts = " or ".join(f"{count:,}" for count in counts)
    notes = [
        f"settles: of {starts} uniform starts, 95 % interval; 50 %, 99 %: within [s]."
    ]
    if any(row.fails and row.fails[0] == TRAPPED for row in rows):
        least = min(row.noise for row in rows if row.noise is not None)
        notes.append(f"{TRAPPED}: a sensor error of {least:g} rad holds it at 180 deg.")
    if any(NOT_TRIED in place for row in rows for place in _list_places(row)):
        notes.append(f"{NOT_TRIED} sensor noise at 180 deg was not tested in this run.")
    notes.append(_describe_costs(rows, run))
    engines = sorted({row.engine for row in rows} - {MAIN_ENGINE})
    if engines:
        which = [name_law(row.law) for row in rows if row.engine != MAIN_ENGINE]
        notes.append(f"By the engine {' and '.join(engines)}: {', '.join(which)}.")
    return notes


def _describe_costs(rows: Sequence[Row], run: Run) -> str:
    timings = run.timings()
    machines = (
        ", ".join(sorted(set(timings["machine"].astype(str)))) if len(timings) else ""
    )
    is_untimed = [math.isnan(row.nanoseconds) for row in rows]
    if not machines or all(is_untimed):
        return "ops: flops + calls a step (not timed)."
    untimed = " (-: not timed)" if any(is_untimed) else ""
    return f"ops: flops + calls a step; ns: its time on {machines}{untimed}."
