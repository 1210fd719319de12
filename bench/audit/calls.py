"""Ways to call a function that takes two orientations, but not as two arrays, or returns more than their error.

Positions are equal wherever a function wants them. So of six numbers, as of a twist, three are zero in every call, and
the other three are those of the orientation.
"""

import importlib
import inspect
from collections.abc import Callable, Iterator
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np


def rotation_of(R: np.ndarray) -> Any:
    """Return SciPy's object; only a function that takes it needs SciPy."""
    return importlib.import_module("scipy.spatial.transform").Rotation.from_matrix(R)


GIVEN: dict[str, dict[str, Callable]] = {
    "matrix": {
        "{}": lambda R: R,
        "{}[None]": lambda R: R[None],
        "{}.ravel()": np.ravel,
        "Rotation.from_matrix({})": rotation_of,
        "np.pad({}, (0, 1)) + np.diag((0, 0, 0, 1))": lambda R: np.pad(R, (0, 1)) + np.diag((0.0, 0.0, 0.0, 1.0)),
    },
    "wxyz": {
        "{}": lambda q: q,
        "{}[None]": lambda q: q[None],
        "np.append(np.zeros(3), {})": lambda q: np.append(np.zeros(3), q),
        "SimpleNamespace(**dict(zip('wxyz', {})))": lambda q: SimpleNamespace(**dict(zip("wxyz", q, strict=True))),
    },
}
"""What is given in the place of an array: code, with {} for the array, and the same as a function."""
GIVEN["xyzw"] = {code: given for code, given in GIVEN["wxyz"].items() if "Simple" not in code}
PARTS: dict[str, tuple[slice, slice]] = {"": (slice(0, 3), slice(3, None)), "[3:]": (slice(3, 6), slice(0, 3))}
PARTS["[:3]"] = PARTS[""]
"""What of an answer is the error, and what of it must be zero."""


class Call(NamedTuple):
    """How a function is called: a code of GIVEN, keywords as "R=", a word of PARTS."""

    takes: str
    given: str = "{}"
    keywords: tuple[str, ...] = ("", "")
    part: str = ""

    @property
    def is_plain(self) -> bool:
        """Tell whether two arrays are given and three numbers returned."""
        return self.given == "{}" and not self.part

    def code(self, function: str, *orientations: str) -> str:
        """Return the call in Python."""
        given = (key + self.given.format(one) for key, one in zip(self.keywords, orientations, strict=True))
        return f"{function}({', '.join(given)}){self.part}"

    def wrap(self, function: Callable) -> Callable:
        """Return the function of two arrays; answers of other sizes are passed on."""
        given, (kept, zero) = GIVEN[self.takes][self.given], PARTS[self.part]
        names = [key[:-1] for key in self.keywords if key]

        def call(now: np.ndarray, goal: np.ndarray) -> Any:
            both = given(now), given(goal)
            said = function(**dict(zip(names, both, strict=True))) if names else function(*both)
            if not self.part or np.size(said) != 6 or np.ravel(said)[zero].any():
                return said
            return np.ravel(said)[kept]

        return call


def ways_to_call(function: Callable, takes: str) -> Iterator[Call]:
    """Yield the plain one first."""
    try:
        found = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):  # of a function in C nothing is known
        found = ()
    needed = [f"{one.name}=" for one in found if one.kind is one.KEYWORD_ONLY and one.default is one.empty]
    keywords = tuple(needed) if len(needed) == 2 else ("", "")
    for part in PARTS:
        for given in GIVEN[takes]:
            yield Call(takes, given, keywords, part)
