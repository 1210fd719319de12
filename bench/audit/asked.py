"""The process that asks a function (apart.py): python -P asked.py FOLDER, with the request in that folder.

Once our modules are loaded their names are free again, so that the function may be of another package `bench`.
"""

from __future__ import annotations

import json
import mmap
import os
import sys
import traceback
from collections.abc import Callable
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]


def main(folder: Path) -> None:
    """Write the answer into the folder."""
    sys.path.insert(0, str(ROOT))
    from bench.audit import apart, load
    from bench.audit.convention import Stated
    from bench.audit.examine import examine, report_lost
    from bench.audit.faults import every_fault
    from bench.audit.lost import Lost
    from bench.audit.report import paragraph
    from bench.base.errors import BenchError

    every_fault()
    asked = json.loads((folder / apart.REQUEST).read_text("utf-8"))
    ours = {name: sys.modules.pop(name) for name in list(sys.modules) if name.partition(".")[0] == "bench"}
    sys.path[:] = asked["path"]
    target = asked["target"]
    stated = Stated(**asked["stated"] | {"accept": tuple(asked["stated"].get("accept", ()))})

    place, _, _ = target.rpartition(":")
    loaded: list[Callable] = []

    def fresh() -> Callable:
        sys.modules.pop(place, None)
        try:
            loaded.append(load.load(target))
        except BenchError:
            if not loaded:
                raise  # a module that can be imported only once is asked as it is
        return watched(loaded[-1], folder / apart.STATE, apart.BOARD.pack_into)

    said: dict[str, Any]
    try:
        if "lost" in asked:
            report = report_lost(target, lost_of(asked["lost"], Lost))
        else:
            here = [os.getcwd()] + ([str(Path(place).resolve().parent)] if place.endswith(".py") else [])
            sys.path[:0] = reversed(here)  # it may import from there when it is called
            report = examine(fresh(), stated, target, fresh)
        paragraphs = {one.fault.name: paragraph(target, one) for one in report.findings if one.is_fault}
        said = {"report": report.as_dict(), "text": report.text(), "head": report.head(), "paragraphs": paragraphs}
    except BenchError as error:
        said = {"refused": str(error)}
    except Exception:
        said = {"refused": f"the audit itself failed; report this: {traceback.format_exc()}"}
    written = folder / "written"
    written.write_text(json.dumps(said), "utf-8")
    written.rename(folder / apart.ANSWER)
    del ours
    os._exit(0)  # threads that the function has begun are not waited for


def lost_of(said: dict[str, Any], lost: Callable) -> Any:
    """Return the end of the process before, with the pair as an array of the right shape."""
    import numpy as np

    now, goal = (np.reshape(said[key], (3, 3) if len(said[key]) == 9 else -1) for key in ("now", "goal"))
    return lost(said["fault"], said["how"], now, goal)


def watched(function: Callable, state: Path, pack_into: Callable) -> Callable:
    """Return the function, with a note of what it is given before each call and of its end."""
    with state.open("r+b") as file:
        board = mmap.mmap(file.fileno(), 0)
    calls = 0

    def call(now: Any, goal: Any) -> Any:
        nonlocal calls
        calls += 1
        padded = [0.0] * (9 - now.size)
        pack_into(board, 0, calls, 1.0, now.size, *now.ravel(), *padded, *goal.ravel(), *padded)
        try:
            return function(now, goal)
        finally:
            pack_into(board, 0, calls, 0.0, now.size, *now.ravel(), *padded, *goal.ravel(), *padded)

    return call


if __name__ == "__main__":
    main(Path(sys.argv[1]))
