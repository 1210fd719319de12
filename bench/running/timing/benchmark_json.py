"""The samples of a run in pytest-benchmark's own JSON, for `pytest-benchmark compare` and whatever else reads it.

pytest-benchmark itself saw each pass of each benchmark as a test of its own. Here a benchmark is one, its rounds are
the passes, and its iterations are ticks, so that every time is seconds a tick. Compare files of one machine, and with
an eye on the reference kernel: they have no ratios.
"""

from pathlib import Path
from types import SimpleNamespace

import numpy as np

from bench.base.files import write_json
from bench.running.timing.benchmark import Benchmark
from bench.running.timing.session import TIMER

OPTIONS = {"timer": TIMER, "disable_gc": True}


def write(path: Path, measured: list[Benchmark], seconds: np.ndarray) -> None:
    """The file of one run, without what cannot be timed.

    Args:
        seconds: one row a pass, one column a benchmark.
    Errors:
        BadResults: the file cannot be written.
    """
    from pytest_benchmark import plugin, stats, utils

    nothing: dict = dict.fromkeys(("param", "params", "cprofile_stats", "has_error"))
    kept = []
    for one, times in zip(measured, seconds.T.tolist(), strict=True):
        if one.ticks:
            group = one._replace(contender=None).name
            named = SimpleNamespace(name=one.name, fullname=one.name, group=group, extra_info={}, **nothing)
            kept.append(stats.Metadata(named, one.ticks, OPTIONS))
            for time in times:
                kept[-1].update(time)
    about = plugin.pytest_benchmark_generate_machine_info(), utils.get_commit_info()
    write_json(path, plugin.pytest_benchmark_generate_json(None, kept, True, *about))
