"""What does a law cost as exported C? Instructions a tick by callgrind, beside our own compiled loop's: results/export.

    python -m bench.studies.exported        some minutes; needs gcc and valgrind

The loop in C is that of bench/running/timing/law.py: each tick waits for the command before it. gcc and our compiler
arrange the same operations each in its way: what goes into vectors is counted once, and what spills is counted too.
"""

import os
import shutil
import string
import subprocess
import sys
import tempfile
from pathlib import Path

from bench.base.errors import MissingTool
from bench.base.files import write_json
from bench.base.provenance import ROOT, describe
from bench.export.language import find_language
from bench.export.subject import Subject, find_subject
from bench.law.contenders.registry import all_contenders
from bench.running.timing import law
from bench.studies.study import make_parser

STORED = ROOT / "results" / "export" / "instructions.json"
FLAGS = ("-std=c99", "-O2", "-ffp-contract=off")
SWEEPS = 2

LOOP = string.Template(Path(__file__).with_suffix(".c.template").read_text(encoding="utf-8"))


def program(subject: Subject) -> str:
    """Return the loop over states in memory, by columns there as in ours."""
    by_rows = [3 * column + row for row in range(3) for column in range(3)]
    return LOOP.substitute(
        name=subject.identifier,
        states=law.STATES,
        state=f"{subject.identifier}_state state;\n    {subject.identifier}_reset(&state);" if subject.memory else "",
        passed="&state, " if subject.memory else "",
        R=", ".join(f"s[{at}] + chain" for at in by_rows),
        omega=", ".join(f"s[{at}] + chain" for at in (9, 10, 11)),
        R_d=", ".join(f"s[{12 + at}]" for at in by_rows),
    )


def in_c(subject: Subject, folder: Path) -> float:
    """Instructions a tick of the exported law."""
    for name, text in find_language("c").files(subject).items():
        (folder / name).write_text(text, encoding="utf-8")
    (folder / "loop.c").write_text(program(subject), encoding="utf-8")
    subprocess.run(["gcc", *FLAGS, "-o", "loop", "loop.c", "-lm"], cwd=folder, check=True)
    short, long = (_total(folder, sweeps) for sweeps in (SWEEPS, 2 * SWEEPS))
    return (long - short) / (SWEEPS * law.STATES)


def _total(folder: Path, sweeps: int) -> int:
    [total] = _count(["./loop", str(sweeps), "100", "20"], folder, {"PATH": "/usr/bin:/bin"})
    return total


def _count(words: list[str], folder: Path, environment: dict[str, str]) -> list[int]:
    """Count the instructions of a command: up to each call of getpgid, and from the last one on."""
    for old in folder.glob("counted*"):
        old.unlink()
    valgrind = ["setarch", "-R", "valgrind", "--tool=callgrind", "--dump-before=getpgid"]
    command = [*valgrind, "--callgrind-out-file=counted", *words]
    subprocess.run(command, cwd=folder, check=True, capture_output=True, env=environment)
    files = sorted(folder.glob("counted*"), key=lambda path: (path.suffix == "", int(path.suffix[1:] or 0)))
    lines = [line for path in files for line in path.read_text(encoding="utf-8").splitlines()]
    return [int(line.split()[1]) for line in lines if line.startswith("totals:")]


OURS = """import os, sys
from bench.law.contenders.registry import find_contender
from bench.engines.binding import command_of, memory_of
from bench.running.timing import law

for name in sys.argv[2:]:
    one = find_contender(name)
    loop = law.loop_of(command_of(one), memory_of(one))
    loop(law.states(), 100.0, 20.0, 1)
    for sweeps in (int(sys.argv[1]), 2 * int(sys.argv[1])):
        os.getpgid(0)
        loop(law.states(), 100.0, 20.0, sweeps)
        os.getpgid(0)
"""
MARKS = 4  # of a law: before and after each of two calls


def in_numba(names: list[str], folder: Path) -> list[float]:
    """Count the instructions a tick of our compiled loops, in one interpreter, which takes minutes to import numba.

    Valgrind does not know the newest processors' instructions, so numba compiles for an older one.
    """
    more = {"PYTHONPATH": str(ROOT), "PYTHONHASHSEED": "0", "NUMBA_CPU_NAME": "x86-64-v3", "NUMBA_CPU_FEATURES": ""}
    words, environment = [sys.executable, "-c", OURS, str(SWEEPS), *names], {**os.environ, **more}
    subprocess.run(words, check=True, env=environment)  # so that all is compiled before
    totals = _count(words, folder, environment)[:-1]
    pairs = zip(totals[1::MARKS], totals[3::MARKS], strict=True)
    return [(long - short) / (SWEEPS * law.STATES) for short, long in pairs]


def counted(names: tuple[str, ...] = ()) -> dict[str, dict[str, float]]:
    """Law -> instructions a tick of ours and of the exported one; no names: every law that is timed.

    Errors:
        MissingTool: valgrind is not here.
    """
    if absent := [tool for tool in ("valgrind", "setarch") if shutil.which(tool) is None]:
        raise MissingTool(f"{' and '.join(absent)} not found (Debian: apt install valgrind util-linux)")
    chosen = list(names) or [one.name for one in all_contenders() if not one.regulator.in_engine]
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "states").write_bytes(law.states().tobytes())
        found = {}
        for name, ours in zip(chosen, in_numba(chosen, place), strict=True):
            found[name] = {"ours": ours, "c": in_c(find_subject(name), place)}
            print(f"{name}: {ours:.1f}, in C {found[name]['c']:.1f}", flush=True)
    return found


def main() -> None:
    """Run the study."""
    make_parser("exported", __doc__).parse_args()
    compiler = subprocess.run(["gcc", "--version"], capture_output=True, text=True, check=True).stdout.splitlines()[0]
    content = {"laws": counted(), "gcc": compiler, "flags": " ".join(FLAGS), "provenance": describe()}
    write_json(STORED, content)


if __name__ == "__main__":
    main()
