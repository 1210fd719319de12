"""The interleaved run: passes over all benchmarks, each in an order of its own, timed by pytest-benchmark.

CPU time of the measuring thread is taken (time.thread_time), not the clock on the wall: on a shared machine that
leaves out the time in which others ran, and a progress bar's thread. No benchmark uses a second thread. A sample is two
rounds on end and counts with the fastest, for a disturbance only ever adds; the first also warms the caches.
"""

import contextlib
import io
import os
import random
import sys
from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

from bench.running.timing.benchmark import Benchmark
from bench.running.timing.benchmarks import Progress

ROUNDS = 2
TIMER = "time.thread_time"


class Sample(NamedTuple):
    """One benchmark in one pass, and where its seconds go."""

    benchmark: Benchmark
    pass_number: int
    taken: Callable


def test_sample(benchmark: Any, sample: Sample) -> None:
    """Take one sample, in two rounds on end; pytest collects it here. `make test` does not collect this file."""
    benchmark.pedantic(sample.benchmark.call, rounds=ROUNDS, iterations=1)
    sample.taken(benchmark.stats.stats.data)


def order(count: int, passes: int, seed: int) -> list[list[int]]:
    """Return a new shuffle of 0..count-1 for every pass."""
    shuffled = random.Random(seed)
    return [shuffled.sample(range(count), count) for _ in range(passes)]


def measure(benchmarks: list[Benchmark], passes: int, seed: int = 0, report: Callable = lambda _: None) -> np.ndarray:
    """Seconds of the fastest round: one row a pass, one column a benchmark.

    Errors:
        KeyboardInterrupt: after Ctrl-C; there is nothing to keep.
    """
    seconds = np.full((passes, len(benchmarks)), np.nan)
    total = passes * len(benchmarks)

    def sample(number: int, place: int) -> Sample:
        def taken(rounds: Sequence[float]) -> None:
            seconds[number, place] = min(rounds)
            report(Progress(benchmarks[place].name, int(np.isfinite(seconds).sum()), total))

        return Sample(benchmarks[place], number, taken)

    samples = [sample(number, at) for number, row in enumerate(order(len(benchmarks), passes, seed)) for at in row]
    _benchmark(samples)
    return seconds


class _Visits:
    """The plugin that gives the samples to `test_sample` and pytest's own report to a buffer.

    Reporters keep the streams they find while pytest configures itself: a buffer, then. Whatever is written later, a
    progress bar say, has the real ones.
    """

    def __init__(self, samples: list[Sample]):
        self.samples = samples
        self.report = io.StringIO()
        self.redirected = contextlib.ExitStack()

    @pytest.hookimpl(tryfirst=True)
    def pytest_configure(self) -> None:
        self.redirected.enter_context(contextlib.redirect_stdout(self.report))
        self.redirected.enter_context(contextlib.redirect_stderr(self.report))

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionstart(self) -> None:
        self.redirected.close()

    def pytest_generate_tests(self, metafunc: pytest.Metafunc) -> None:
        names = [f"pass {one.pass_number} {one.benchmark.name}" for one in self.samples]
        metafunc.parametrize("sample", self.samples, ids=names)


def _benchmark(samples: list[Sample]) -> None:
    plugin = _Visits(samples)
    words = [
        *(__file__, "-c", os.devnull, "--rootdir", str(Path(__file__).parent), "--noconftest"),
        *("-p", "no:cacheprovider", "-p", "no:xdist", "-p", "no:faulthandler"),
        *("-q", "--exitfirst", "--capture=no", "--assert=plain", "-W", "ignore"),
        *(f"--benchmark-timer={TIMER}", "--benchmark-disable-gc", "--benchmark-quiet"),
    ]
    with _no_outer_pytest(), plugin.redirected:
        code = pytest.main(words, plugins=[plugin])
    if code == pytest.ExitCode.INTERRUPTED:
        raise KeyboardInterrupt
    if code != pytest.ExitCode.OK:
        report = plugin.report.getvalue().strip()
        raise RuntimeError(f"pytest ended with {code!r} on {Path(__file__).name}:\n{report}")


@contextlib.contextmanager
def _no_outer_pytest() -> Iterator[None]:
    """Hide an outer pytest's variables: under pytest-xdist's, pytest-benchmark would switch itself off."""
    hidden = {name: os.environ.pop(name) for name in list(os.environ) if name.startswith("PYTEST_")}
    path = list(sys.path)
    try:
        yield
    finally:
        os.environ.update(hidden)
        sys.path[:] = path
