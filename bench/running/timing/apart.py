"""The timing of a user's laws, with all else that is timed beside them, in a process of its own.

Run with a DESCRIPTOR (`module_command`), this module is that process: over the line comes what to time; back go the
progress, sample by sample, and at last the file's path or the mistake.
"""

import json
import sys
from collections.abc import Callable
from multiprocessing.connection import Connection
from pathlib import Path

from bench.base.errors import BadLaw, BenchError
from bench.law.contender import Contender
from bench.law.contenders.law_file import load_law
from bench.law.contenders.law_process import ask
from bench.law.contenders.registry import find_contender
from bench.running.timing.benchmarks import Progress
from bench.running.timing.rows import run

SILENT_S = 300.0
"""On the wall, from one sample to the next: ten times what compiling a law for all engines takes."""


def run_apart(
    contenders: list[Contender], folder: Path, quick: bool = False, report: Callable = lambda _: None,
    arms: tuple[str, ...] = (),
) -> Path:  # fmt: skip
    """Time contenders as `run` does, where some are a user's; BadLaw if one cannot be compiled, crashes or hangs."""
    files = sorted({(one.regulator.origin, one.regulator.text) for one in contenders if one.regulator.origin})
    how = {"folder": str(folder), "quick": quick, "arms": arms}
    asked = {"files": files, "names": [one.name for one in contenders], "how": how}
    named = ", ".join(path for path, _ in files)
    for said in ask(__name__, asked, SILENT_S, named):
        if "path" in said:
            return Path(said["path"])
        report(Progress(*said["progress"]))
    raise BadLaw(f"--law {named}: its process did not say where the times are; correct the file")


def main(descriptor: int) -> None:
    """Time the requested calls."""
    with Connection(descriptor) as line:
        asked = json.loads(line.recv_bytes())

        def report(done: Progress) -> None:
            line.send_bytes(json.dumps({"progress": done}).encode())

        try:
            own = tuple(load_law(Path(path), text.encode()) for path, text in asked["files"])
            contenders = [find_contender(name, own) for name in asked["names"]]
            said = {"path": str(run(contenders, report=report, **asked["how"]))}
        except BenchError as error:
            said = {"mistake": str(error)}
        line.send_bytes(json.dumps(said).encode())


if __name__ == "__main__":
    main(int(sys.argv[1]))
