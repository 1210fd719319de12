"""Compute once what several claims need of a run."""

from __future__ import annotations

import functools
import weakref
from collections.abc import Callable, Hashable
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

if TYPE_CHECKING:
    from bench.experiments.tables.run import Run

T = TypeVar("T")


class Computed(NamedTuple):
    """What came out, and the rows that were asked for on the way, as `Run.chosen` has them."""

    value: Any
    chosen: tuple[tuple[str, str], ...]


def once_a_run(compute: Callable[..., T]) -> Callable[..., T]:
    """Return the function of (run, *words) that computes once for each run and words; it goes when the run does.

    Who gets what was computed before has asked for its rows, too: they are added to `chosen` again.
    """
    found: weakref.WeakKeyDictionary[Run, dict[tuple[Hashable, ...], Computed]] = weakref.WeakKeyDictionary()

    @functools.wraps(compute)
    def once(run: Run, *words: Hashable) -> T:
        by_words = found.setdefault(run, {})
        if words in by_words:
            run.chosen.extend(by_words[words].chosen)
        else:
            before = len(run.chosen)
            value = compute(run, *words)
            by_words[words] = Computed(value, tuple(run.chosen[before:]))
        return by_words[words].value

    return once
