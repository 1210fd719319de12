"""Find where something stops holding."""

from collections.abc import Callable


def bisect(holds: Callable[[float], bool], low: float, high: float, halvings: int) -> tuple[float, float]:
    """Halve an interval so often that something holds at its lower end and not at its upper; return both ends."""
    for _ in range(halvings):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low, high
