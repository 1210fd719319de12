"""The counting scalar: an IEEE 754 double that tallies every operation of the law dialect it takes part in.

What the dialect lacks raises, so that nothing goes uncounted: Python itself would answer `==` and `if x`, and
math.sin(x) would make a plain float of the number.
"""

import operator
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from bench.base.errors import BadLaw
from bench.law import scalar

OPERATIONS = ("add", "mul", "div", "sqrt", "sin", "cos", "atan2", "acos", "compare", "copysign")
"""One column each. A subtraction is an add."""

STAGES = ("measure", "goal", "represent", "regulate", "jacobian", "invert", "linearize")
"""Parts of a tick: R and omega from sensors; E_d; E and Edot; the law; J in its coordinates; J^-1; u from u_E, tau."""

TOTAL = "total"


class OutsideDialect(BadLaw, TypeError):
    """A law that uses what cannot be counted."""


class Counts(NamedTuple):
    """Operations of one call: a row for each of STAGES, in it a number for each of OPERATIONS."""

    by_stage: tuple

    def of(self, stage: str) -> dict:
        """Operation -> number, of one stage or of "total"."""
        if stage == TOTAL:
            numbers = [sum(column) for column in zip(*self.by_stage, strict=True)]
        else:
            numbers = self.by_stage[STAGES.index(stage)]
        return dict(zip(OPERATIONS, numbers, strict=True))


class Tally:
    """Counts in progress. `stage` is where the next operation belongs, `now` its numbers in the order of OPERATIONS."""

    def __init__(self) -> None:
        self._by_stage: dict[str, list[int]] = {}
        self.stage = "regulate"

    @property
    def stage(self) -> str:
        """Return the stage to which the next operation is counted."""
        return self._stage

    @stage.setter
    def stage(self, stage: str) -> None:
        self._stage = stage
        self.now = self._by_stage.setdefault(stage, [0] * len(OPERATIONS))

    def take(self) -> Counts:
        """Return what was counted since the last time; then from zero again."""
        numbers, self._by_stage = self._by_stage, {}
        self.stage = self._stage
        nothing = (0,) * len(OPERATIONS)
        return Counts(tuple(tuple(numbers.get(stage, nothing)) for stage in STAGES))


def _quotient(x: float, y: float) -> float:
    try:
        return x / y
    except ZeroDivisionError:
        return float(np.float64(x) / np.float64(y))


CONSTANTS = (int, float)
"""Types of the constants of a law; a tuple, because isinstance would make a union of `int | float` at every call."""


def _dyadic(operation: str, compute: Callable) -> tuple[Callable, Callable]:
    place = OPERATIONS.index(operation)

    def forward(self: "Counted", other: Any) -> Any:
        if other.__class__ is Counted:
            value = other.value
        elif isinstance(other, CONSTANTS):
            value = float(other)
        else:
            return NotImplemented
        self.tally.now[place] += 1
        return Counted(compute(self.value, value), self.tally)

    def reflected(self: "Counted", other: Any) -> Any:
        """Apply the operation where the first operand is a constant; for two counting scalars `forward` is called."""
        if not isinstance(other, CONSTANTS):
            return NotImplemented
        self.tally.now[place] += 1
        return Counted(compute(float(other), self.value), self.tally)

    return forward, reflected


def _monadic(operation: str, compute: Callable) -> Callable:
    place = OPERATIONS.index(operation)

    def result(self: "Counted") -> "Counted":
        self.tally.now[place] += 1
        return Counted(compute(self.value), self.tally)

    return result


def _comparison(compute: Callable) -> Callable:
    place = OPERATIONS.index("compare")

    def compare(self: "Counted", other: Any) -> Any:
        if other.__class__ is Counted:
            other = other.value
        elif not isinstance(other, CONSTANTS):
            return NotImplemented
        self.tally.now[place] += 1
        return bool(compute(self.value, other))

    return compare


def _refused(what: str, cure: str) -> Callable:
    def refuse(self: "Counted", *others: object) -> None:
        raise OutsideDialect(f"{what} cannot be counted; {cure} (what a law may contain: bench/law/scalar.py)")

    return refuse


class Counted:
    """One number of a counted call. Constants may be mixed in; they are Python floats and carry no tally.

    The numbers are doubles, and division follows IEEE 754 as in every engine: 1/0 is infinite, 0/0 NaN, with a
    warning of numpy's for the caller to silence (numpy.errstate).
    """

    __slots__ = ("tally", "value")
    __array_ufunc__ = None  # numpy's own operators and functions then leave the operation to this class

    def __init__(self, value: float, tally: Tally) -> None:
        self.value = value
        self.tally = tally

    def __repr__(self) -> str:
        return f"Counted({self.value!r})"

    __add__, __radd__ = _dyadic("add", operator.add)
    __sub__, __rsub__ = _dyadic("add", operator.sub)
    __mul__, __rmul__ = _dyadic("mul", operator.mul)
    __truediv__, __rtruediv__ = _dyadic("div", _quotient)
    atan2, ratan2 = _dyadic("atan2", scalar.atan2)
    copysign, rcopysign = _dyadic("copysign", scalar.copysign)

    def __neg__(self) -> "Counted":
        """Free: a sign bit."""
        return Counted(-self.value, self.tally)

    def __pos__(self) -> "Counted":
        return self

    sqrt = _monadic("sqrt", scalar.sqrt)
    sin = _monadic("sin", scalar.sin)
    cos = _monadic("cos", scalar.cos)
    acos = _monadic("acos", scalar.acos)

    __lt__ = _comparison(operator.lt)
    __le__ = _comparison(operator.le)
    __gt__ = _comparison(operator.gt)
    __ge__ = _comparison(operator.ge)

    __eq__ = _refused("x == y", "compare with < <= > >=")
    __ne__ = _refused("x != y", "compare with < <= > >=")
    __hash__ = _refused("a number as a key", "keep numbers in tuples")
    __bool__ = _refused("a number as a condition", "write the comparison, such as x > 0.0")
    __float__ = _refused("math, numpy or float() of a number", "call sqrt, sin, cos, atan2, acos of bench.law.scalar")
    __int__ = __index__ = __complex__ = __float__
    __round__ = __trunc__ = __floor__ = __ceil__ = _refused("rounding", "write it with comparisons")
    __pow__ = __rpow__ = _refused("x ** y", "write x * x, or sqrt(x) of bench.law.scalar")
    __abs__ = _refused("abs(x)", "write copysign(x, 1.0) of bench.law.scalar")
    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __divmod__ = __rdivmod__ = _refused(
        "% or //", "write it with comparisons"
    )
