"""Units carried out by threads of this process."""

import importlib
import threading
from collections.abc import Callable, Sequence
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from pathlib import Path

from bench.journal import part
from bench.plan import AnyUnit, Plan, Unit
from bench.store import write_table
from bench.work import rows


def run(plan: Plan, todo: Sequence[AnyUnit], out: Path, workers: int, done: Callable[[AnyUnit], None]) -> None:
    """Carry out units, in their order, and write each when it is done.

    Args:
        done: told of each, when it is written.
    Errors:
        KeyboardInterrupt: after the units under way are written.
    """
    stop = threading.Event()

    def work(unit: AnyUnit) -> AnyUnit | None:
        if stop.is_set():
            return None
        write_table(part(out, unit), rows(plan, unit), unit.table)
        return unit

    if any(isinstance(unit, Unit) and unit.engine == "reference" for unit in todo):
        importlib.import_module("tasks.episode")  # it silences GLFW's import, which works in the main thread only
    with ThreadPoolExecutor(workers) as pool:
        pending = {pool.submit(work, unit) for unit in todo}
        try:
            while pending:
                ended, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in ended:
                    unit = future.result()
                    if unit is not None:
                        done(unit)
        except BaseException:
            stop.set()
            raise
