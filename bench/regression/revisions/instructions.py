"""Instructions a tick of every law alone, counted by callgrind: they repeat to a few parts in a million, time does not.

A law's compiled loop is called with n sweeps over the states and with 2n; the difference is n sweeps, with all that
starting and calling costs taken out. Address randomization is off and the environment empty, so that nothing depends
on where benchmarks lie.

Fails: counts of another processor, C library or compiler are other counts; compare only within one run of this.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import llvmlite

from bench.errors import MissingTool
from bench.regression.revisions.process import Process
from bench.timing import law

CALLED = Path(__file__).with_name("called.py")
SWEEPS = 2
"""Two thousand ticks, some 1e5 to 2e6 instructions; what a call costs beside them repeats to within ten."""

TOLERANCE = 0.01
"""What a law may grow by: how a compiler lays out the same code."""

MARKS = 4
"""A law's: before and after each of two calls."""


def missing() -> str:
    """Why nothing can be counted here; empty if it can."""
    absent = [tool for tool in ("valgrind", "setarch") if shutil.which(tool) is None]
    return f"{' and '.join(absent)} not found (Debian: apt install valgrind util-linux)" if absent else ""


def count(side: Process, names: list[str]) -> dict[str, float]:
    """Instructions a tick, by law.

    Errors:
        MissingTool: valgrind is not there or cannot run this.
    """
    if absent := missing():
        raise MissingTool(f"no instructions are counted: {absent}")
    if not names:
        return {}
    laws = [word for name in names for word in (side.benchmarks[name].file, side.benchmarks[name].symbol)]
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder:
        dumps = Path(folder) / "callgrind"
        words = [
            *("setarch", "-R", shutil.which("valgrind") or "valgrind", "--tool=callgrind", "--dump-before=getpgid"),
            *(f"--callgrind-out-file={dumps}", sys.executable, "-I", "-S", str(CALLED)),
            *(str(Path(llvmlite.__file__).parents[1]), str(side.objects), str(SWEEPS), str(law.states().shape[1])),
            *laws,
        ]
        environment = {"PATH": "/usr/bin:/bin", "PYTHONHASHSEED": "0"}
        ended = subprocess.run(words, env=environment, capture_output=True, text=True)
        written = sorted(dumps.parent.glob("callgrind.*"), key=lambda path: int(path.suffix[1:]))
        totals = [_total(path) for path in written]
    if ended.returncode or len(totals) != MARKS * (1 + len(names)):
        said = [line for line in ended.stderr.splitlines() if line.strip()]
        raise MissingTool(f"no instructions are counted: callgrind ended with {ended.returncode} ({said[-1]})")
    ticks = SWEEPS * law.STATES
    once, twice = totals[MARKS + 1 :: MARKS], totals[MARKS + 3 :: MARKS]
    return {name: (long - short) / ticks for name, short, long in zip(names, once, twice, strict=True)}


def _total(path: Path) -> int:
    """All instructions of a file of callgrind's."""
    [line] = [line for line in path.read_text(encoding="utf-8").splitlines() if line.startswith("totals:")]
    return int(line.split()[1])
