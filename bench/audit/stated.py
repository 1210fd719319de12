"""Statements of the caller on a function; what is left out is found."""

from __future__ import annotations

from typing import NamedTuple

from bench.base.errors import BadNumber, UnknownWord

TAKES = ("matrix", "wxyz", "xyzw")
"""3 x 3 matrices, or quaternions with the scalar first or last."""
FRAMES = ("base", "body")
"""Frames of the three numbers. The body frames of R and of R_d are one for them: R_d^T k = R^T k."""
SIGNS = ("to-goal", "from-goal")
"""Directions: along the rotation from R to R_d, as R_d - R, or back, as R - R_d and with swapped arguments."""


class Stated(NamedTuple):
    """The arguments of `audit`."""

    takes: str | None = None
    frame: str | None = None
    sign: str | None = None
    stiffness: float = 1.0
    accept: tuple[str, ...] = ()

    def check(self, faults: list[str]) -> None:
        """Refuse what is in no list."""
        words = (("input", self.takes, TAKES), ("frame", self.frame, FRAMES), ("sign", self.sign, SIGNS))
        for kind, given, known in (*words, *(("fault", one, faults) for one in self.accept)):
            if given is not None and given not in known:
                raise UnknownWord(kind, given, list(known))
        if not 0.0 < self.stiffness < float("inf"):
            raise BadNumber(f"stiffness {self.stiffness} is not a positive number (1 where the gains are all of it)")
