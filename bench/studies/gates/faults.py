"""One fault at a time, planted in a copy of the sources: is it caught, and do the words name it?

Faults of behaviour are judged by two runs, row by row, of a slice of the quick suite; those of speed by the two
processes' gates.
"""

import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any, NamedTuple

import tasks
from bench.errors import BadResults
from bench.law.so3 import from_quaternion
from bench.provenance import ROOT
from bench.regression.revisions.comparison import REGRESSION, Finding
from bench.regression.revisions.gates import of_folders
from bench.regression.revisions.machine import environment
from bench.regression.revisions.measured import Wanted, measured
from bench.regression.revisions.process import Laws, running
from bench.studies.gates import power
from bench.studies.gates.planting import Edit, copy_with, removed, replaced, unchanged

STARTS = 40
SLICE = (
    "--suite",
    "quick",
    "--task",
    "free-body",
    "--engine",
    "ideal-rk4",
    "--starts",
    "uniform",
    "--count",
    str(STARTS),
)
LAWS = ("rotation-matrix", "mrp", "sliding")

MATRIX = "bench/contenders/regulators/rotation_matrix.py"
ENTRY = "    n = cross(R.n, goal.R.n)\n"
HALF = "    half = 0.5 * gains.kp\n"
START = 17
"""The uniform start at which something is planted."""

NEAR = 1e-9
"""No other episode passes through a box of that width in three numbers."""

TENTH = 3
"""Steps of `power` that slow its law by about a tenth."""


class Fault(NamedTuple):
    """What is planted, in words; the law that must be named, and words that must be said of it."""

    title: str
    law: str
    says: str
    edit: Edit


def at_start(command: str) -> Edit:
    """The rotation-matrix law answers so at one start, and as ever everywhere else."""
    R = from_quaternion(tasks.start_set("uniform", STARTS, 0)[START].quat_wxyz)
    sides = {"R.n[0]": R.n[0], "R.o[1]": R.o[1], "R.a[0]": R.a[0]}
    inside = " and ".join(f"{value - NEAR!r} < {name} < {value + NEAR!r}" for name, value in sides.items())
    return replaced(MATRIX, ENTRY, f"    if {inside}:\n        return {command}\n{ENTRY}")


def behaviour() -> list[Fault]:
    """Faults that runs show."""
    name = tasks.start_set("uniform", STARTS, 0)[START].id
    return [
        Fault(
            "one multiplication more",
            "rotation-matrix",
            "mul",
            replaced(MATRIX, HALF, "    half = 0.5 * gains.kp * 1.0\n"),
        ),
        Fault("one outcome flipped", "rotation-matrix", name, at_start("(1e300, 0.0, 0.0)")),
        Fault("one dead point more", "rotation-matrix", "new dead point", at_start("(0.0, 0.0, 0.0)")),
        Fault("a contender removed", "sliding", "removed contender", removed("bench/contenders/regulators/sliding.py")),
    ]


def run() -> Iterator[dict[str, Any]]:
    """One row a fault; the first is none at all."""
    with copy_with(unchanged) as copy:
        base = _run(copy)
        with copy_with(unchanged) as again:
            yield _row(Fault("nothing", "", "", unchanged), of_folders(base, _run(again)).findings)
        for fault in behaviour():
            with copy_with(fault.edit) as changed:
                yield _row(fault, of_folders(base, _run(changed)).findings)
    tenth = Fault("a tenth slower", power.LAW, "instructions", power.slower(TENTH))
    asked = Laws(engines=False, names=(power.LAW, *LAWS))
    with copy_with(tenth.edit) as copy, running([(ROOT, asked), (copy, asked)]) as sides:
        _, found, _ = measured(sides, ({}, {}), Wanted(same_code=False), lambda _: None)
        yield _row(tenth, found)


def _run(copy: Path) -> Path:
    """The folder of a copy's run."""
    folder = copy / "results" / "run"
    words = [sys.executable, "-m", "bench", "run", *SLICE, "--out", str(folder)]
    for law in LAWS:
        if (copy / "bench" / "contenders" / "regulators" / f"{law.replace('-', '_')}.py").is_file():
            words += ["--regulator", law]
    ended = subprocess.run(words, cwd=copy, env=environment(copy), capture_output=True, text=True)
    if ended.returncode:
        raise BadResults(f"a copy of the sources does not run: {ended.stderr.strip().splitlines()[-1]}")
    return folder


def _row(fault: Fault, findings) -> dict[str, Any]:
    bad: list[Finding] = [one for one in findings if one.verdict == REGRESSION]
    named = [one for one in bad if one.name == fault.law and fault.says in one.says]
    others = {one.name for one in bad} - {fault.law}
    return {
        "fault": fault.title,
        "law": fault.law,
        "caught": bool(bad),
        "named": bool(named),
        "others_blamed": sorted(others),
        "gates": sorted({one.gate for one in bad}),
        "says": [one.says for one in (*named, *(one for one in bad if one not in named))][:4],
    }
