"""cost(contender): operations per tick in its typical and its worst branch; rows(contenders): costs.parquet.

Every counted call is checked against the plain call, so that a cost is never that of another law.
"""

import functools
import math
import statistics
import struct
import threading
from collections.abc import Callable, Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

from bench.base.errors import BadLaw
from bench.engines.counting.counted import OPERATIONS, STAGES, TOTAL, Counted, Counts, OutsideDialect, Tally
from bench.engines.counting.staged import law_of
from bench.engines.counting.states import GAINS, CountedState, states
from bench.law.contender import Contender
from bench.law.inputs import NO_MEMORY

FLOPS = ("add", "mul", "div", "sqrt")
BRANCHES = ("typical", "worst")

PACK = struct.Struct("<d").pack
"""A double as eight bytes."""


class Cost(NamedTuple):
    """Operations per tick of one contender, or controller in contact; the rules are `bench.engines.counting.RULES`.

    typical_share: fraction of the sampled states that take the typical branch. worst_at: the worst state.
    """

    contender: Any
    typical: Counts
    worst: Counts
    typical_share: float
    worst_at: str


class CountedCall(NamedTuple):
    """One counted call. `is_typical` if it is one of those the typical branch is chosen from."""

    state: Any
    counts: Counts
    is_typical: bool


@functools.cache
def cost(contender: Contender) -> Cost:
    """Count the contender's law over all states; once in a process.

    Errors:
        OutsideDialect: it uses what cannot be counted. BadLaw: counted it does not return what the plain law returns.
    """
    return cost_of(contender, list(counted_calls(contender)), statistics.mode)


def cost_of(one: Any, calls: list[CountedCall], choose: Callable[[list[Counts]], Counts]) -> Cost:
    """Return the cost that calls show; choose: the typical one of what was counted in sampled states."""
    sampled = [call.counts for call in calls if call.is_typical]
    typical, worst = choose(sampled), max(calls, key=lambda call: size(call.counts))
    return Cost(one, typical, worst.counts, sampled.count(typical) / len(sampled), worst.state.id)


def rows(contenders: Iterable[Contender]) -> list[dict]:
    """Rows of costs.parquet: contender x branch x stage, the stage "total" last."""
    return [row for contender in contenders for row in rows_of(cost(contender), contender.words | {"joints": 0})]


def flops(numbers: dict) -> int:
    """Floating-point operations without transcendental functions: add + mul + div + sqrt."""
    return sum(numbers[name] for name in FLOPS)


def rows_of(one: Cost, words: dict, stages: tuple[str, ...] = STAGES) -> Iterator[dict]:
    """Yield a row for each branch and stage of a cost, the stage "total" last; words: its first columns."""
    for branch, counts in zip(BRANCHES, (one.typical, one.worst), strict=True):
        for stage in (*stages, TOTAL):
            numbers = counts.of(stage)
            yield words | {"branch": branch, "stage": stage, **numbers, "flops": flops(numbers)}


def size(counts: Counts) -> tuple[int, int]:
    """Return what calls are ranked by: all operations, then flops."""
    numbers = counts.of(TOTAL)
    return sum(numbers[name] for name in OPERATIONS), flops(numbers)


class Given(NamedTuple):
    """What a law is called with at a state: numbers, and the same numbers as counting scalars."""

    state: CountedState
    plain: tuple
    counting: tuple


def give(over: Iterable[CountedState], tally: Tally) -> list[Given]:
    """Return what a law is called with at some states, its counting scalars on this tally."""
    every = ((state, (state.R, state.omega, state.goal, GAINS)) for state in over)
    return [Given(state, plain, counted(plain, tally)) for state, plain in every]


@functools.cache
def _prepare(thread: int) -> tuple[Tally, list[Given]]:
    """Return all states with one tally, once a thread: to make them for each law takes a quarter of the counting."""
    tally = Tally()
    return tally, give(states(), tally)


def counted_calls(
    contender: Contender, over: Iterable[CountedState] | None = None
) -> Iterator[CountedCall]:
    """Yield all states counted, checked against the plain call; a law that raises costs what it computed until then."""
    tally, every = _prepare(threading.get_ident())
    tally.take()  # of a law that was refused, something may be left
    if over is not None:
        every = give(over, tally)
    plain, counting = contender.law, law_of(contender, tally)
    first = contender.regulator.memory
    left: tuple = ()
    with np.errstate(all="ignore"):
        for given in every:
            if first is None:
                yield _call(contender, plain, counting, tally, given, ())[0]
                continue
            initial = tuple(np.float64(x) for x in (*first, *NO_MEMORY[len(first) :]))
            for memory in (initial, *((left,) if left else ())):
                call, after = _call(contender, plain, counting, tally, given, (memory,))
                yield call._replace(is_typical=False)
                left = after or initial
            call, after = _call(contender, plain, counting, tally, given, (left,))
            yield call
            left = after or initial


def _call(
    contender: Contender,
    plain: Callable,
    counting: Callable,
    tally: Tally,
    given: Given,
    memory: tuple,
) -> tuple[CountedCall, tuple]:
    """Return the call, and the memory the law left (empty for a law without, or if it raised)."""
    tally.stage = "regulate"
    call, want = checked(
        contender.name,
        given.state,
        tally,
        lambda: plain(*given.plain, *memory),
        lambda: counting(*given.counting, *counted(memory, tally)),
    )
    return call, want[1] if memory and want is not None else ()


def checked(
    name: str, state: Any, tally: Tally, plain: Callable, counting: Callable
) -> tuple[CountedCall, Any]:
    """Return a counted call, whose answer must be the plain one bit for bit; and that answer, None if it raised."""
    want, answer, trouble = None, None, None
    try:
        want = plain()
    except Exception as error:
        trouble = error
    try:
        answer = counting()
    except OutsideDialect as error:
        raise OutsideDialect(f"'{name}': {error}") from error
    except Exception as error:
        if trouble is None:
            raise BadLaw(
                f"'{name}' cannot be counted: with counting scalars it raises {type(error).__name__}: {error}; use "
                "only the dialect of bench/law/scalar.py"
            ) from error
    if bits(answer) != bits(want):
        raise BadLaw(
            f"'{name}' returns {values(answer)} when counted and {values(want)} when called with floats, at "
            f"{state.id}; a law must not depend on the type of its numbers"
        )
    return CountedCall(state, tally.take(), state.is_sampled), want


def counted(numbers: Any, tally: Tally) -> Any:
    """Return nested tuples and arrays with every float replaced by a counting scalar; counts of things stay ints."""
    if isinstance(numbers, int):
        return numbers
    if isinstance(numbers, np.ndarray):
        return np.frompyfunc(lambda number: Counted(float(number), tally), 1, 1)(numbers)
    if not isinstance(numbers, tuple):
        return Counted(float(numbers), tally)
    inside = [counted(number, tally) for number in numbers]
    return type(numbers)(*inside) if hasattr(numbers, "_fields") else tuple(inside)


def values(answer: Any) -> Any:
    """Return what a counted call returned, as nested tuples of floats."""
    if isinstance(answer, tuple):
        return tuple(values(number) for number in answer)
    if isinstance(answer, Counted):
        answer = answer.value
    return float(answer) if isinstance(answer, int | float) else answer


def bits(answer: Any) -> bytes:
    """Return the numbers of an answer, bit by bit: NaN equals NaN, and 0.0 is not -0.0."""
    if isinstance(answer, tuple):
        return b"".join(map(bits, answer))
    number = values(answer)
    if not isinstance(number, float):
        return repr(number).encode()
    return PACK(number if number == number else math.nan)
