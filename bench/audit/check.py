"""`check`: the convention and the faults of an orientation error."""

import argparse
import shutil
import sys
from typing import Any

from bench.audit.apart import CALLS, LIMIT_S, audit_apart

STATED = ("takes", "frame", "sign", "stiffness", "allow")
"""Options that are arguments of `bench.audit.audit`."""
DESCRIPTION = """\
Find the convention of an orientation error and its faults, each with a pair of orientations that reproduces it.

FUNCTION takes (R, R_d), 3 x 3, or (q, q_d), and returns three numbers. It is called with some thousand pairs of
orientations, in a process of its own that has a time limit and whose output is dropped: about a second."""
EPILOG = """\
A function of two matrices or two quaternions:
   {prog} my_file.py:my_error
A C function, void f(const double[9], const double[9], double[3]):
   {prog} libmine.so:my_error
A class whose instance is called:
   {prog} my_controller.py:Controller
The error must be in the base frame, and its goal is never 180° away:
   {prog} my.py:f --frame base --allow dead-at-180

A fault harms a controller. If one is intended, as the clip of a vector, allow it by its name. A note harms none: what
no encoder shows, or that the function refuses input that is no rotation. Exit code 1: a fault that is not allowed; a
function that ends the process or hangs has one.
In pytest, where the wheel orientation-audit is installed: pytest --orientation-error my_file.py:my_error"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Describe the options to a parser."""
    add = parser.add_argument
    add("function", metavar="FUNCTION", help="FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL")
    add("--takes", metavar="WORD", help="what it takes: matrix, wxyz or xyzw; found if left out")
    add("--frame", metavar="WORD", help="the frame that it must be in: base or body")
    add("--sign", metavar="WORD", help="where it must point: to-goal or from-goal")
    add("--stiffness", type=float, default=1.0, metavar="NUMBER", help="slope that your gains reckon with (1)")
    add("--allow", action="append", default=[], metavar="FAULT", help="a fault that is intended; repeatable")
    add("--limit", type=float, default=LIMIT_S, metavar="SECONDS", help=f"seconds that it may take ({LIMIT_S:g})")


def run(arguments: argparse.Namespace) -> tuple[int, str, dict[str, Any]]:
    """Return the exit code, 1 if a function has a fault and 0 if not, and its report as text and for JSON."""
    function, stated = arguments.function, {name: getattr(arguments, name) for name in STATED}
    try:
        show(f"loading {function}")
        count = f"of about {CALLS:,} calls: {function}"
        said = audit_apart(function, stated, arguments.limit, lambda calls: show(f"{calls:,} {count}"))
    finally:
        show("")
    return bool(said["report"]["faults"]), said["text"], said["report"]


def show(text: str) -> None:
    """Replace the last line of a terminal with this one; where stderr is no terminal, print nothing."""
    if sys.stderr.isatty():
        shown = text[: shutil.get_terminal_size().columns - 1]
        print(f"\r\x1b[K{shown}", end="", file=sys.stderr, flush=True)
