"""A number whose sines, cosines and arcs are off by as much as those of another library may be.

Where such a number enters a law, its answer moves by what the law makes of those errors; what takes no such call keeps
every bit. It enters as a counting scalar does: `bench.law.scalar` asks whoever has a `tally`.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np

ULPS = 4.0
"""How far off a call of libm may be, in units of the last place."""


class Shaken:
    """An IEEE double; `errors` draws the signs of what its calls of libm are off by."""

    errors: np.random.Generator
    tally = None

    def __init__(self, value: Any):
        self.value: np.float64 = np.float64(value.value if isinstance(value, Shaken) else value)

    def __float__(self) -> float:
        return float(self.value)

    def _off(self, value: float) -> "Shaken":
        return Shaken(value + Shaken.errors.choice((-ULPS, ULPS)) * np.spacing(value))

    def sqrt(self) -> "Shaken":
        """Rounded correctly everywhere."""
        return Shaken(np.sqrt(self.value))

    def sin(self) -> "Shaken":
        """Off."""
        return self._off(math.sin(self.value))

    def cos(self) -> "Shaken":
        """Off."""
        return self._off(math.cos(self.value))

    def acos(self) -> "Shaken":
        """Off; NaN outside [-1, 1]."""
        return self._off(math.acos(self.value) if abs(self.value) <= 1.0 else math.nan)

    def atan2(self, x: Any) -> "Shaken":
        """atan2(self, x), off."""
        return self._off(math.atan2(self.value, float(x)))

    def ratan2(self, y: Any) -> "Shaken":
        """atan2(y, self), off."""
        return self._off(math.atan2(float(y), self.value))

    def copysign(self, sign: Any) -> "Shaken":
        """This magnitude with that sign."""
        return Shaken(math.copysign(self.value, float(sign)))

    def rcopysign(self, magnitude: Any) -> "Shaken":
        """That magnitude with this sign."""
        return Shaken(math.copysign(float(magnitude), self.value))

    def __neg__(self) -> "Shaken":
        return Shaken(-self.value)


def _arithmetic(name: str) -> Callable:
    def method(self: Shaken, other: Any) -> Any:
        found = getattr(self.value, name)(np.float64(float(other)))
        return Shaken(found) if isinstance(found, np.floating) else found

    return method


for _name in ("add", "radd", "sub", "rsub", "mul", "rmul", "truediv", "rtruediv", "lt", "le", "gt", "ge"):
    setattr(Shaken, f"__{_name}__", _arithmetic(f"__{_name}__"))
