"""Units carried out by threads of this process; those of a user's law, by processes that threads wait for."""

import importlib
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path

from bench.experiments.experiment import Unit
from bench.running.precompile import Ahead
from bench.running.run_folder import write_part
from bench.running.sandbox.sandbox import Sandbox
from bench.running.schedulers import share_heap

UNITS_A_PROCESS = 8
"""Units of users' laws beyond which one more process is worth its start of some seconds, if no law of ours runs."""


def run(
    todo: Sequence[Unit], out: Path, workers: int, sandbox: Sandbox, done: Callable[[Unit], None],
    ahead: Ahead | None = None,
) -> int:  # fmt: skip
    """Carry out units in order, write each and call `done` with it, on Ctrl-C too; return the number of workers."""
    share_heap()
    stop = threading.Event()

    def work(unit: Unit) -> Unit | None:
        if ahead and not sandbox.has(unit):
            ahead.wait_for(unit, stop)
        if stop.is_set():
            return None
        if (content := sandbox.packed(unit)) is not None:
            write_part(sandbox.plan, out, unit, content)
        return unit

    ours, own = [unit for unit in todo if not sandbox.has(unit)], [unit for unit in todo if sandbox.has(unit)]
    processes = 1 if ours else min(workers, 1 + len(own) // UNITS_A_PROCESS)
    if any(unit.engine == "reference" for unit in ours):
        importlib.import_module("tasks.episode")  # it silences GLFW's import, which works in the main thread only
    with ThreadPoolExecutor(workers) as pool, ThreadPoolExecutor(processes) as apart:
        pending = {pool.submit(work, unit) for unit in ours} | {apart.submit(work, unit) for unit in own}
        try:
            for future in as_completed(pending):
                unit = future.result()
                if unit is not None:
                    done(unit)
        except BaseException:
            stop.set()
            sandbox.stopping = True
            raise
    return workers
