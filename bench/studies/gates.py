"""Check the regression gate: false alarms on the same code, and planted faults.

same-code   COMPARISONS timings of this checkout against itself, at the gate's own settings; every verdict but "same"
            is a false alarm
faults      one fault at a time in a copy of the sources: is it caught, and is the law named?

A call that was stopped goes on with the rows that are missing, if the sources are the same. They are kept in
results/regress.
"""

import contextlib
import functools
import shutil
import tempfile
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import tasks
from bench.base.errors import BadResults
from bench.base.files import write_json
from bench.base.provenance import ROOT, describe
from bench.experiments.tables.schema import RESULTS
from bench.law.so3 import from_quaternion
from bench.regression.revisions.checkouts import run_python
from bench.regression.revisions.comparison import REGRESSION
from bench.regression.revisions.exact import compare_runs
from bench.regression.revisions.gates import describe_time
from bench.regression.revisions.timing import SAME, Side, compare_times
from bench.studies.study import make_parser, make_parts

FOLDER = RESULTS / "regress"
COMPARISONS = 20
STARTS, START = 40, 17
"""Uniform starts, and the one at which something is planted."""
LAWS = ("rotation-matrix", "mrp", "sliding")
RUN = (
    *["--suite", "quick", "--task", "free-body", "--engine", "ideal-rk4", "--starts", "uniform", "--count"],
    str(STARTS),
)
COPIED = ("bench", "tasks", "requirements", "pyproject.toml")
FILES = {law: f"bench/law/contenders/regulators/{law.replace('-', '_')}.py" for law in (*LAWS, "rotation-vector")}
MATRIX = FILES["rotation-matrix"]
ENTRY, SQUARE = "    n = cross(R.n, goal.R.n)\n", "    square = dot(v, v)\n"
NEAR = 1e-9
"""No other episode passes through a box of that width in three numbers."""
SLOW = f"""{SQUARE}    slow = square
    for _ in range(8):
        slow = 0.5 * slow + w
    square = square + 0.0 * slow
"""
"""A quarter slower; the command keeps every bit, for 0 x = 0."""


class Fault(NamedTuple):
    """What is planted, in words; the law that must be named, words that must be said of it; file, old and new text."""

    title: str
    law: str = ""
    says: str = ""
    file: str = ""
    old: str = ""
    new: str = ""


def list_faults() -> list[Fault]:
    """Return what is planted: first nothing, last what only time shows."""
    start = tasks.start_set("uniform", STARTS, 0)[START]
    R = from_quaternion(start.quat_wxyz)
    sides = {"R.n[0]": R.n[0], "R.o[1]": R.o[1], "R.a[0]": R.a[0]}
    inside = " and ".join(f"{value - NEAR!r} < {name} < {value + NEAR!r}" for name, value in sides.items())
    flipped, dead = (f"    if {inside}:\n        return ({u}, 0.0, 0.0)\n{ENTRY}" for u in ("1e300", "0.0"))
    half = "    half = 0.5 * gains.kp\n"
    return [
        Fault("nothing"),
        Fault("one multiplication more", LAWS[0], "mul", MATRIX, half, half.replace("kp", "kp * 1.0")),
        Fault("one outcome flipped", LAWS[0], start.id, MATRIX, ENTRY, flipped),
        Fault("one dead point more", LAWS[0], "new dead point", MATRIX, ENTRY, dead),
        Fault("a contender removed", "sliding", "gone from episodes", FILES["sliding"]),
        Fault("a quarter slower", "rotation-vector", "slower", FILES["rotation-vector"], SQUARE, SLOW),
    ]


@contextlib.contextmanager
def copy_with(fault: Fault) -> Iterator[Path]:
    """Copy the sources with a fault in them; the copy is removed when the block ends.

    Errors:
        BadResults: the text that is replaced does not occur once, so the study must follow the sources.
    """
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as folder:
        copy = Path(folder) / "checkout"
        for name in COPIED:
            place = shutil.copytree if (ROOT / name).is_dir() else shutil.copy2
            copy.mkdir(exist_ok=True)
            place(ROOT / name, copy / name)
        if fault.file and not fault.old:
            (copy / fault.file).unlink()
        elif fault.file:
            text = (copy / fault.file).read_text(encoding="utf-8")
            if text.count(fault.old) != 1:
                raise BadResults(f"{fault.file}: '{fault.old.strip()}' does not occur once; mend this study")
            (copy / fault.file).write_text(text.replace(fault.old, fault.new), encoding="utf-8")
        yield copy


def run_copy(copy: Path) -> Path:
    """Run a copy; return the folder of its run."""
    folder = copy / "results" / "run"
    words = [word for law in LAWS if (copy / FILES[law]).is_file() for word in ("--regulator", law)]
    run_python(copy, "-m", "bench", "run", *RUN, "--count", str(STARTS), *words, "--out", str(folder))
    return folder


def plant(number: int) -> dict[str, Any]:
    """Plant one fault and return a row: whether it was caught, whether the law was named, and the words."""
    fault = list_faults()[number]
    with copy_with(fault) as copy:
        if fault.says == "slower":
            base, head = (Side(path, names=(fault.law, *LAWS)) for path in (ROOT, copy))
            _, times = compare_times(base, head)
            found = [describe_time(one) for one in times.values() if one.verdict != SAME]
        else:
            with copy_with(Fault("nothing")) as unchanged:
                found = compare_runs(run_copy(unchanged), run_copy(copy))
    bad = [one for one in found if one.verdict == REGRESSION]
    named = [one.says for one in bad if one.name == fault.law and fault.says in one.says]
    return {
        **{"fault": fault.title, "law": fault.law, "caught": bool(bad), "named": bool(named)},
        **{
            "others_blamed": sorted({one.name for one in bad} - {fault.law}),
            "gates": sorted({one.gate for one in bad}),
        },
        "says": named[:2],
    }


def compare_same_code(number: int) -> dict[str, Any]:
    """Time this checkout against itself and return a row: least p, extreme ratios, what one run doubted, and alarms."""
    _, times = compare_times(Side(ROOT), Side(ROOT))
    ratios = [one.ratio for one in times.values()]
    return {
        **{"benchmarks": len(times), "least_p": min(one.p for one in times.values())},
        **{"least_ratio": round(min(ratios), 4), "largest_ratio": round(max(ratios), 4)},
        "doubted": [name for name, one in times.items() if one.confirmed is not None],
        "alarms": [name for name, one in times.items() if one.verdict != SAME],
    }


PARTS: dict[str, tuple[Callable[[int], dict[str, Any]], int]] = {
    "same-code": (compare_same_code, COMPARISONS),
    "faults": (plant, len(list_faults())),
}
"""Name -> how a row is made, some 40 to 60 CPU seconds each, and how many rows there are."""


def main() -> None:
    """Run the study's command."""
    for name in make_parser("gates", __doc__, PARTS).parse_args().only or PARTS:
        make, count = PARTS[name]
        path = FOLDER / f"{name.replace('-', '_')}.json"
        made = make_parts(path, {f"{name} {k}": functools.partial(make, k) for k in range(count)})
        about = {**describe(), "command": f"python -P -m bench.studies.gates --only {name}"}
        write_json(path, {"about": about, "rows": [*made.values()]})


if __name__ == "__main__":
    main()
