"""Start another process that runs a module of ours, whatever lies in the working folder."""

import sys

from bench.base.provenance import ROOT

BEGIN = """import runpy, sys
sys.path.insert(0, sys.argv.pop(1))
runpy.run_module(sys.argv.pop(1), None, "__main__", True)"""
"""`python -m` would look for the module, and for numpy, in the working folder first."""


def module_command(module: str, *words: str) -> list[str]:
    """Return the command that runs a module of this checkout, or of the installed packages, with these arguments."""
    return [sys.executable, "-P", "-c", BEGIN, str(ROOT), module, *words]
