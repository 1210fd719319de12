"""Audit a function in a process of its own, where it may hang, exit or crash (audit_process.py).

What the function prints goes nowhere. This module imports no more than what starts a process, nor
does the pytest plugin, which runs in the process of somebody's tests.
"""

import json
import os
import sys
from collections.abc import Callable
from typing import Any

from bench.base.errors import BadFunction, BadNumber
from bench.base.isolated import UNLIMITED, IsolatedProcess, NoAnswer, Refused, TimeLimits

LIMIT_S = 60.0
"""Seconds on the wall for the whole audit: fifty times what a function of some microseconds takes."""

LONGEST_S = 86_400.0

REPORT_S = 60.0
"""Seconds on the wall for the process to start, and to report on a function that is lost."""

CALLS = 6000
"""Approximate number of calls of the function in one audit."""

PROCESS = f"{__package__}.audit_process"


def audit_apart(
    target: str,
    stated: dict[str, Any],
    limit_s: float = LIMIT_S,
    progress: Callable[[int], object] = bool,
) -> dict[str, Any]:
    """Return the report on FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL.

    Args:
        target: The function.
        stated: Arguments of `bench.audit.audit`.
        limit_s: Seconds on the wall for the whole audit.
        progress: Is called with the number of calls, some times a second.

    Returns:
        `report` (`Report.as_dict`), `text` (for people), `head` (its first lines), and
        `paragraphs` (name of a fault -> text).

    Errors:
        BadNumber: The limit is no time.
        BadFunction: The function cannot be audited, or is too slow.
    """
    # NaN too: no comparison with it is true.
    if not 0.0 < limit_s <= LONGEST_S:
        raise BadNumber(
            f"limit {limit_s:g} s is not a time up to {LONGEST_S:g} s, a day "
            f"(try: --limit {LIMIT_S:g})"
        )
    request = {"target": target, "stated": stated, "limit_s": limit_s, "path": sys.path}
    # A function may keep every processor busy all the time.
    wall_s = limit_s + REPORT_S
    limits = TimeLimits(wall_s * (os.cpu_count() or 1), wall_s)
    try:
        with IsolatedProcess(PROCESS, mapped=UNLIMITED) as process:
            return dict(json.loads(process.ask(request, limits, progress=progress)))
    except Refused as mistake:
        raise BadFunction(str(mistake)) from mistake
    except (NoAnswer, ValueError) as error:
        reason = f"the audit of {target} ended without a report ({error}); report this"
        raise BadFunction(reason) from error
