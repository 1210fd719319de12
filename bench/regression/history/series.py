"""Lines as series: one value a build.

What is counted is the same on every machine, and one series across them; where two machines differ about a build, the
first that was measured stands. Times compare only on the machine where they were taken.
"""

from collections.abc import Iterable
from typing import NamedTuple

from bench.regression.history.record import Record

FLOPS, INSTRUCTIONS, TIME = "operations", "instructions", "time"
MEASURES = (FLOPS, INSTRUCTIONS, TIME)


class Point(NamedTuple):
    """One build's value.

    value: flops of the typical branch, instructions a tick, or time a tick over a step of the reference kernel.
    tally: all operations by branch and kind, of a series of operations. low, high: of a time. code: digest of the
    machine code, of instructions and of a law's time.
    """

    commit: str
    date: str
    value: float
    compiler: str
    tally: tuple[tuple[str, str, int], ...] = ()
    low: float = 0.0
    high: float = 0.0
    code: str = ""


class Series(NamedTuple):
    """One benchmark's measure over the builds; `machine` is empty unless it is a time."""

    what: str
    name: str
    measure: str
    machine: str
    points: tuple[Point, ...]


def series(lines: Iterable[Record]) -> list[Series]:
    """All series of these lines, which come in the order of their commits."""
    found: dict[tuple[str, str, str, str], dict[str, Point]] = {}
    for line in lines:
        for measure, point in points(line).items():
            machine = line.machine if measure == TIME else ""
            of_build = found.setdefault((line.benchmark.what, line.benchmark.name, measure, machine), {})
            of_build.setdefault(line.commit, point)
    return [Series(*key, tuple(points.values())) for key, points in found.items()]


def points(line: Record) -> dict[str, Point]:
    """What a line measured: a point of each measure."""
    one, about = line.benchmark, (line.commit, line.date)
    found = {}
    if "typical" in one.operations:
        tally = sorted((branch, kind, n) for branch, kinds in one.operations.items() for kind, n in kinds.items())
        flops = one.operations["typical"].get("flops", 0)
        found[FLOPS] = Point(*about, float(flops), line.compiler, tuple(tally))
    if one.instructions is not None:
        found[INSTRUCTIONS] = Point(*about, one.instructions, line.compiler, code=one.code)
    if one.kernel_steps is not None:
        median, low, high = one.kernel_steps
        found[TIME] = Point(*about, median, line.compiler, low=low, high=high, code=one.code)
    return found
