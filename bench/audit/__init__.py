"""Is an orientation error all right? `audit(function)` asks it over some thousand pairs of orientations.

A function f(R, R_d) of two 3 x 3 matrices, or of two unit quaternions, returns three numbers. What it means by them
is found first (`convention.py`), then each file of `faults/` looks for one fault. Nothing of ours is the measure: the
pairs are made from axis and angle in closed form, so what the function should say of them is known.

The wheel `orientation-audit` is this package under another name, with its command line (`command.py`) and its pytest
plugin (bench/export/wheel.py). This module imports nothing: a plugin that is not used must cost nothing.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bench.audit.report import Report


def audit(
    function: Callable,
    takes: str | None = None,
    *,
    frame: str | None = None,
    sign: str | None = None,
    stiffness: float = 1.0,
    accept: tuple[str, ...] = (),
    name: str = "",
) -> Report:
    """Return the convention of an orientation error, and what is wrong with it.

    Args:
        function: f(R, R_d) or f(q, q_d) -> three numbers.
        takes: "matrix", "wxyz" or "xyzw", if it is known; it is found otherwise.
        frame: "base" or "body", if it must be that one.
        sign: "to-goal" (from R to R_d) or "from-goal", if it must be that one.
        stiffness: |f|/theta near the goal that the caller's gains reckon with.
        accept: names of faults that are meant, as ("norm-clip",).
        name: what the report calls the function.

    Errors:
        BadFunction: it returns three numbers neither of matrices nor of quaternions; or a word is unknown.
    """
    from bench.audit.convention import Stated
    from bench.audit.examine import examine

    return examine(function, Stated(takes, frame, sign, stiffness, accept), name or getattr(function, "__name__", "f"))
