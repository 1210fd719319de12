"""A share of starts with its interval (Wilson 1927): k of n, and between which shares the truth lies, at 95 %."""

import math
from typing import NamedTuple

Z_95 = 1.959963984540054
"""Two-sided 95 % quantile of the normal distribution."""


class Share(NamedTuple):
    """k of n as a share, with its interval."""

    k: int
    n: int
    low: float
    high: float

    @property
    def value(self) -> float:
        """k / n."""
        return self.k / self.n

    def __str__(self) -> str:
        return f"{self.value:.2%} ({self.low:.2%} to {self.high:.2%})".replace("%", " %")


def share(count: int, of: int) -> Share:
    """Wilson's interval; for low-discrepancy starts, which spread more evenly than chance, it is on the wide side."""
    if not 0 <= count <= of or of < 1:
        raise ValueError(f"{count} of {of} is no share (allowed: 0 <= k <= n, n >= 1)")
    spread = Z_95 * Z_95 / of
    middle = (count / of + spread / 2.0) / (1.0 + spread)
    half = Z_95 / (1.0 + spread) * math.sqrt(count / of * (1.0 - count / of) / of + spread / (4.0 * of))
    return Share(count, of, max(0.0, middle - half) if count else 0.0, min(1.0, middle + half) if count < of else 1.0)
