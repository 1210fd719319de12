"""A share of starts with its interval (Wilson 1927): k of n, and between which shares the truth lies, at 95 %."""

from typing import NamedTuple

from scipy.stats import binomtest


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
    interval = binomtest(count, of).proportion_ci(method="wilson")
    return Share(count, of, float(interval.low), float(interval.high))
