"""The counting scalar: an IEEE 754 double that tallies every operation of the law dialect it takes part in.

What the dialect lacks raises, so that nothing goes uncounted: Python itself would answer `==` and `if x`, and
math.sin(x) would make a plain float of the number.
"""

from typing import NamedTuple

import numpy as np

from bench import scalar
from bench.errors import BadLaw

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
    """Counts in progress. `stage` is where the next operation belongs."""

    def __init__(self):
        self.stage = "regulate"
        self._numbers = {}

    def add(self, operation: str) -> None:
        """One more of this operation."""
        key = (self.stage, operation)
        self._numbers[key] = self._numbers.get(key, 0) + 1

    def take(self) -> Counts:
        """What was counted since the last time; then from zero again."""
        numbers, self._numbers = self._numbers, {}
        return Counts(tuple(tuple(numbers.get((stage, name), 0) for name in OPERATIONS) for stage in STAGES))


def _value(x):
    """The double in a counting scalar or a constant; None for anything else."""
    if isinstance(x, Counted):
        return x.value
    return np.float64(x) if isinstance(x, int | float) else None


def _dyadic(operation: str, compute):
    def forward(self, other):
        value = _value(other)
        return NotImplemented if value is None else self._result(operation, compute(self.value, value))

    def reflected(self, other):
        value = _value(other)
        return NotImplemented if value is None else self._result(operation, compute(value, self.value))

    return forward, reflected


def _comparison(compute):
    def compare(self, other):
        value = _value(other)
        if value is None:
            return NotImplemented
        self.tally.add("compare")
        return bool(compute(self.value, value))

    return compare


def _refused(what: str, cure: str):
    def refuse(self, *others):
        raise OutsideDialect(f"{what} cannot be counted; {cure} (what a law may contain: bench/scalar.py)")

    return refuse


class Counted:
    """One number of a counted call. Constants may be mixed in; they are Python floats and carry no tally.

    The numbers are numpy.float64, as in every engine: 1/0 is infinite, 0/0 NaN, with a warning of numpy's for
    the caller to silence (numpy.errstate).
    """

    __slots__ = ("tally", "value")
    __array_ufunc__ = None  # numpy's own operators and functions then leave the operation to this class

    def __init__(self, value, tally: Tally):
        self.value = np.float64(value)
        self.tally = tally

    def __repr__(self):
        return f"Counted({float(self.value)!r})"

    def _result(self, operation, value):
        self.tally.add(operation)
        return Counted(value, self.tally)

    __add__, __radd__ = _dyadic("add", lambda x, y: x + y)
    __sub__, __rsub__ = _dyadic("add", lambda x, y: x - y)
    __mul__, __rmul__ = _dyadic("mul", lambda x, y: x * y)
    __truediv__, __rtruediv__ = _dyadic("div", lambda x, y: x / y)
    atan2, ratan2 = _dyadic("atan2", scalar.atan2)
    copysign, rcopysign = _dyadic("copysign", scalar.copysign)

    def __neg__(self):
        """Free: a sign bit."""
        return Counted(-self.value, self.tally)

    def __pos__(self):
        return self

    def sqrt(self):
        """Square root, counted."""
        return self._result("sqrt", scalar.sqrt(self.value))

    def sin(self):
        """Sine, counted."""
        return self._result("sin", scalar.sin(self.value))

    def cos(self):
        """Cosine, counted."""
        return self._result("cos", scalar.cos(self.value))

    def acos(self):
        """Arc cosine, counted."""
        return self._result("acos", scalar.acos(self.value))

    __lt__ = _comparison(lambda x, y: x < y)
    __le__ = _comparison(lambda x, y: x <= y)
    __gt__ = _comparison(lambda x, y: x > y)
    __ge__ = _comparison(lambda x, y: x >= y)

    __eq__ = _refused("x == y", "compare with < <= > >=")
    __ne__ = _refused("x != y", "compare with < <= > >=")
    __hash__ = _refused("a number as a key", "keep numbers in tuples")
    __bool__ = _refused("a number as a condition", "write the comparison, such as x > 0.0")
    __float__ = _refused(
        "math, numpy or float() of a number", "call sqrt, sin, cos, atan2, acos of bench.scalar"
    )
    __int__ = __index__ = __complex__ = __float__
    __round__ = __trunc__ = __floor__ = __ceil__ = _refused("rounding", "write it with comparisons")
    __pow__ = __rpow__ = _refused("x ** y", "write x * x, or sqrt(x) of bench.scalar")
    __abs__ = _refused("abs(x)", "write copysign(x, 1.0) of bench.scalar")
    __mod__ = __rmod__ = __floordiv__ = __rfloordiv__ = __divmod__ = __rdivmod__ = _refused(
        "% or //", "write it with comparisons"
    )
