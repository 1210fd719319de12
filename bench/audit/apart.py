"""Audit a function in a process of its own (audit_process.py): what it prints goes nowhere; it may hang, exit or crash.

It imports no more than the errors, nor does the pytest plugin, which runs in the process of somebody's tests.
"""

import json
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

from bench.base.errors import BadFunction, BadNumber

LIMIT_S = 60.0
"""Seconds on the wall for the whole audit: fifty times what a function of some microseconds takes."""
CALLS = 6000
"""Approximate number of calls of the function in one audit."""
ROOT = str(Path(__file__).resolve().parents[__name__.count(".")])
"""The folder that holds our outermost package: a checkout, or installed packages."""
BEGIN = f"import sys; sys.path.insert(0, {ROOT!r}); from {__package__}.audit_process import main; main()"


LONGEST_S = 86_400.0


def audit_apart(
    target: str, stated: dict[str, Any], limit_s: float = LIMIT_S, progress: Callable[[int], object] = bool
) -> dict[str, Any]:
    """Return the report on FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL; BadFunction if it takes too long.

    `stated` are arguments of `bench.audit.audit`; `progress` gets the number of calls, some times a second. It returns
    `report` (`Report.as_dict`), `text` (for people), `head` (its first lines), `paragraphs` (name of a fault -> text).
    """
    if not 0.0 < limit_s <= LONGEST_S:  # NaN too: no comparison with it is true
        raise BadNumber(f"limit {limit_s:g} s is not a time up to {LONGEST_S:g} s, a day (try: --limit {LIMIT_S:g})")
    request = {"target": target, "stated": stated, "limit_s": limit_s, "path": sys.path}
    command = [sys.executable, "-P", "-c", BEGIN, json.dumps(request)]
    said: Any = 0
    with subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout or ():
            said = json.loads(line)
            if isinstance(said, int):
                progress(said)
    if isinstance(said, int):
        raise BadFunction(f"the audit of {target} ended without a report (exit code {process.returncode}); report this")
    if "refused" in said:
        raise BadFunction(said["refused"])
    return dict(said)
