"""Ways to call a function that takes two orientations, but not as two arrays, or returns more than their error.

Positions are equal wherever a function wants them. So of six numbers, as of a twist, three are zero in every call, and
the other three are those of the orientation.
"""

import importlib
import inspect
from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

MATRIX = ("{}", "{}[None]", "{}.ravel()", "Rotation.from_matrix({})", "np.pad({}, (0, 1)) + np.diag((0, 0, 0, 1))")
XYZW = ("{}", "{}[None]", "np.append(np.zeros(3), {})")
GIVEN = {"matrix": MATRIX, "wxyz": (*XYZW, "SimpleNamespace(**dict(zip('wxyz', {})))"), "xyzw": XYZW}
"""Code of what is given in the place of an array."""
PARTS = {"": slice(0, 3), "[3:]": slice(3, 6), "[:3]": slice(0, 3)}


class Call(NamedTuple):
    """How a function is called: a code of GIVEN, keywords as "R=", a word of PARTS."""

    takes: str
    given: str = "{}"
    keywords: tuple[str, ...] = ("", "")
    part: str = ""

    def code(self, function: str, *orientations: str) -> str:
        """Return the call in Python."""
        given = (key + self.given.format(one) for key, one in zip(self.keywords, orientations, strict=True))
        return f"{function}({', '.join(given)}){self.part}"

    def wrap(self, function: Callable) -> Callable:
        """Return the function of two arrays; answers of other sizes than the code expects are passed on."""
        code = compile(self._replace(part="").code("f", "now", "goal"), "call", "eval")

        def call(now: np.ndarray, goal: np.ndarray) -> Any:
            names = {"f": function, "now": now, "goal": goal, "np": np, "SimpleNamespace": SimpleNamespace}
            if "Rotation" in self.given:
                names["Rotation"] = importlib.import_module("scipy.spatial.transform").Rotation
            said = eval(code, names)
            if not self.part or np.size(said) != 6 or np.delete(np.ravel(said), PARTS[self.part]).any():
                return said
            return np.ravel(said)[PARTS[self.part]]

        return call


def ways_to_call(function: Callable, takes: str) -> list[Call]:
    """Return the plain one first."""
    try:
        found = list(inspect.signature(function).parameters.values())
    except (TypeError, ValueError):  # of a function in C nothing is known
        found = []
    needed = [f"{one.name}=" for one in found if one.kind is one.KEYWORD_ONLY and one.default is one.empty]
    keywords = tuple(needed) if len(needed) == 2 else ("", "")
    return [Call(takes, given, keywords, part) for part in PARTS for given in GIVEN[takes]]
