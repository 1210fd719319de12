"""The end of the asking: a function that ends the process, or that does not return."""

from __future__ import annotations

import numpy as np

ENDS, HANGS = "ends-process", "hangs"
"""Names of the faults, each a file of faults/ without a `find`."""


class Lost(BaseException):
    """No answer will come, and nothing more is asked. No `except Exception` of a function that calls another stops it.

    Args:
        fault: ENDS or HANGS. how: what happened, as in "SIGSEGV". now, goal: what the function was given.
    """

    def __init__(self, fault: str, how: str, now: np.ndarray, goal: np.ndarray):
        super().__init__(how)
        self.fault, self.how, self.now, self.goal = fault, how, now, goal
