"""Start another process that runs a module of ours, whatever lies in the working folder."""

import os
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[__name__.count(".")]
"""The folder that holds our outermost package: a checkout, or installed packages."""

LAW_PROCESS = "ORIENTATION_BENCH_LAW_PROCESS"
"""Environment variable of every process that runs a user's law, or a function that is audited; its value is the same in
all that this code started."""

RUNS_A_LAW = LAW_PROCESS in os.environ
"""Whether this process runs a user's law, and so keeps nothing for other processes: no compiled code, no rows.

It is read when this module is imported, which is before the first line of the law: the law may
change the environment.
"""

BEGIN = """import runpy, sys
sys.path.insert(0, sys.argv.pop(1))
runpy.run_module(sys.argv.pop(1), None, "__main__", True)"""
"""`python -m` would look for the module, and for numpy, in the working folder first."""


def module_command(module: str, *words: str) -> list[str]:
    """Return the command that runs a module of this checkout, or of the installed packages, with these arguments."""
    return [sys.executable, "-P", "-c", BEGIN, str(ROOT), module, *words]


def law_environment(token: str) -> dict[str, str]:
    """Return the environment of a process that runs a user's law, which is found again by the token.

    It writes no byte code either: what it would write next to our sources is run by every later
    process.
    """
    return {**os.environ, "PYTHONDONTWRITEBYTECODE": "1", LAW_PROCESS: token}
