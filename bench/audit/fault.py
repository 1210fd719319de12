"""The record of a fault, and that of a finding."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

FAULT, NOTE = "fault", "note"


class Evidence(NamedTuple):
    """A pair to reproduce: what the function is given, what it said, and what would be right, if that is known."""

    now: np.ndarray
    goal: np.ndarray
    said: np.ndarray | str
    right: np.ndarray | str = ""


class Found(NamedTuple):
    """What `find` returns: how it shows, in numbers; a pair; and whether it is a property that one may want.

    effect, cure: of this function, where the fault's own words are too general.
    """

    text: str
    evidence: Evidence | None = None
    severity: str = FAULT
    effect: str = ""
    cure: str = ""


class Fault(NamedTuple):
    """One kind of fault: what the docstring of a file of faults/ says of it, and its `find`.

    Args:
        title: what it is.
        effect: what it does to a controller.
        cure: what to do.
        law: the name of a regulator that has it right.
        unless: names of faults that explain this one: with any of them it is not reported.
        name: of the file, with dashes: word in reports and on the command line, anchor on the page.
        find: examined -> Found, or None.
    """

    title: str
    effect: str
    cure: str
    law: str = "rotation-vector"
    unless: tuple[str, ...] = ()
    name: str = ""
    find: Callable = print


class Finding(NamedTuple):
    """A fault of a function."""

    fault: Fault
    found: Found
    is_accepted: bool = False

    @property
    def is_fault(self) -> bool:
        """Tell whether it makes the audit fail."""
        return self.found.severity == FAULT and not self.is_accepted
