"""The number that a law computes with when it is traced: each operation goes to `trace.Symbols`."""

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.reasons import Untraceable

if TYPE_CHECKING:
    from bench.findings.proofs.trace import Symbols


def _operation(compute: Callable[[Any, Any], Any], is_reflected: bool = False) -> Callable[..., Traced]:
    def apply(self: Traced, other: Any) -> Traced:
        pair = self.value, self.symbols.number(other).value
        return self.symbols.compute(compute, *(pair[::-1] if is_reflected else pair))

    return apply


class Traced:
    """A number of the law dialect, as a rational function; `tally` is what `bench.law.scalar` asks for."""

    tally = None
    __add__ = __radd__ = _operation(operator.add)
    __mul__ = __rmul__ = _operation(operator.mul)
    __sub__, __rsub__ = _operation(operator.sub), _operation(operator.sub, True)
    __hash__ = object.__hash__

    def __init__(self, value: Any, symbols: Symbols) -> None:
        self.value, self.symbols = value, symbols

    def __truediv__(self, other: Any) -> Traced:
        divisor = self.symbols.number(other)
        self.symbols.require_divisor(divisor)
        return self.symbols.compute(operator.truediv, self.value, divisor.value)

    def __rtruediv__(self, other: Any) -> Traced:
        return self.symbols.number(other) / self

    def __neg__(self) -> Traced:
        return Traced(-self.value, self.symbols)

    def __pos__(self) -> Traced:
        return self

    def __pow__(self, power: Any) -> Traced:
        if isinstance(power, Traced) or power != int(power):
            raise Untraceable(f"it raises a number to the power {power!r}, which is not a whole number")
        if power < 0:
            return 1 / self ** (-int(power))
        return self.symbols.reduce(self.value ** int(power))

    def __abs__(self) -> Traced:
        return -self if self.symbols.is_negative(self) else self

    # comparisons: each is a decision, followed both ways

    def __bool__(self) -> bool:
        return self.symbols.decide(self, "!=")

    def __eq__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, "=")

    def __ne__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, "!=")

    def __lt__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, "<")

    def __gt__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, ">")

    def __ge__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, ">=")

    def __le__(self, other: Any) -> bool:
        return self.symbols.decide(self - other, "<=")

    def __repr__(self) -> str:
        return str(self.value)

    # functions of the law dialect

    def sqrt(self) -> Traced:
        """Return the square root, of numerator and denominator."""
        symbols, numer, denom = self.symbols, self.value.numer, self.value.denom
        symbols.require_not(
            PolynomialRelation(numer * denom, "<"), "a square root of a number below zero"
        )
        if not denom.is_ground and symbols.is_negative(Traced(symbols.field(denom), symbols)):
            numer, denom = -numer, -denom
        return symbols.root_of(numer) / symbols.root_of(denom)

    def cos(self) -> Traced:
        """Return the cosine as a symbol."""
        return self.symbols.circle_of(self)[0]

    def sin(self) -> Traced:
        """Return the sine as a symbol."""
        return self.symbols.circle_of(self)[1]

    def acos(self) -> Traced:
        """Return the inverse cosine as the angle of the point (self, sqrt(1 - self^2))."""
        numer, denom = self.value.numer, self.value.denom
        outside = PolynomialRelation(denom**2 - numer**2, "<")
        self.symbols.require_not(outside, "an inverse cosine of a number outside [-1, 1]")
        return (1 - self * self).sqrt().atan2(self)

    def atan2(self, x: Any) -> Traced:
        """Return the angle of the point (x, self)."""
        return self.symbols.angle_of(self, self.symbols.number(x))

    def ratan2(self, y: Any) -> Traced:
        """Return the angle of the point (self, y)."""
        return self.symbols.number(y).atan2(self)

    def copysign(self, sign: Any) -> Traced:
        """Return the size of this number with a sign; zero has either sign, and both are followed."""
        size, sign = abs(self), self.symbols.number(sign)
        if sign < 0 or (sign == 0 and self.symbols.choose()):
            return -size
        return size

    def rcopysign(self, magnitude: Any) -> Traced:
        """Return the size of another number with the sign of this one."""
        return self.symbols.number(magnitude).copysign(self)


def is_zero(value: Traced) -> bool:
    """Tell whether a value is zero in normal form, wherever its path's conditions hold."""
    return not value.value


def is_same(value: Any, other: Any) -> bool:
    """Tell whether two values are equal in normal form."""
    return is_zero(value - other)


def are_same(values: tuple, others: tuple) -> bool:
    """Tell whether each of some values is the same as the other at its place."""
    return len(values) == len(others) and all(map(is_same, values, others))
