"""Is an orientation error all right? `audit(function)` asks it over some thousand pairs of orientations.

A function f(R, R_d) of two 3 x 3 matrices, or of two unit quaternions, returns three numbers. Its convention is found
first (`convention.py`), then each file of `faults/` looks for one fault. The pairs are made from axis and angle in
closed form, so that the right answers are known. The wheel `orientation-audit` is this package under another name.
This module imports nothing of ours: a plugin that is not used must cost nothing.
"""

from __future__ import annotations

import sys
import types
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from bench.audit.report import Report


def audit(
    function: Callable,
    takes: str | None = None,
    *,
    frame: str | None = None,
    sign: str | None = None,
    stiffness: float = 1.0,
    allow: tuple[str, ...] = (),
    name: str = "",
) -> Report:
    """Return the convention of an orientation error f(R, R_d) or f(q, q_d), and what is wrong with it.

    Args:
        takes: "matrix", "wxyz" or "xyzw", if it is known; it is found otherwise.
        frame: "base" or "body", if it must be that one.
        sign: "to-goal" (from R to R_d) or "from-goal", if it must be that one.
        stiffness: |f|/theta near the goal that the caller's gains reckon with.
        allow: names of faults that are intended, as ("norm-clip",).
        name: what the report calls the function.

    Errors:
        BadFunction: it returns three numbers neither of matrices nor of quaternions; or a word is unknown.
    """
    from bench.audit.convention import Stated
    from bench.audit.examine import examine

    return examine(function, Stated(takes, frame, sign, stiffness, allow), name or getattr(function, "__name__", "f"))


class _CalledModule(types.ModuleType):
    """This module, called as its function: `bench.audit(my_error)`, where the package has the function's name."""

    def __call__(self, *words: Any, **options: Any) -> Report:
        return audit(*words, **options)


sys.modules[__name__].__class__ = _CalledModule
