"""Starts of a unit; those on arms are found by searches of ten seconds in all, and kept on disk."""

import functools
import hashlib

import tasks
from bench.experiments.kept_rows import kept
from tasks.base import Start


def count_of(start_set: str, count: int | None, seed: int, arm: str = "") -> int:
    """Return how many starts a set has, its own number if `count` is None; an arm that cannot do so many has fewer."""
    return len(on_arm(start_set, count, seed, arm)) if arm else tasks.start_set_length(start_set, count, seed)


def on_arm(start_set: str, count: int | None, seed: int, arm: str) -> list[Start]:
    """tasks.start_set(start_set, count, seed, arm)."""
    size = tasks.find_start_set(start_set, arm=True).size
    wanted = size if count is None else count
    text = hashlib.sha256(tasks.arm(arm).xml.encode()).hexdigest()[:16]
    return list(found(start_set, max(wanted, size), seed, arm, text)[:wanted])


@functools.lru_cache(maxsize=128)
def found(start_set: str, count: int, seed: int, arm: str, text: str) -> tuple[Start, ...]:
    """Return sets of one size, so that runs of fewer starts find what others have kept; text: digest of the arm's."""

    def search() -> list[dict]:
        return [start._asdict() for start in tasks.start_set(start_set, count, seed, arm)]

    rows = kept(f"starts/{arm}-{text}-{start_set}-{count}-{seed}", search)
    return tuple(Start(row.pop("id"), *map(tuple, row.values())) for row in map(dict, rows))
