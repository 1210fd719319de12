"""Many starts at once against one at a time: every law, both ideal plants, bit for bit."""

import functools
import math
import multiprocessing
import re
from concurrent.futures import ProcessPoolExecutor

import numba
import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.driving import METRICS, compile_into_cache, settings, spread

from bench.engines import lanes
from bench.engines import simulate as engines
from bench.engines.binding import evaluation_of, observer
from bench.engines.curve import blank_curves
from bench.engines.episode import FIRST_METRIC, OUTCOME, TICKS, start_rows
from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.rotations import about, short_of_180_degrees
from tasks.rules import RULES
from tasks.verdict import DIVERGED, SATURATED, SETTLED, SINGULAR

IDEAL = tuple(lanes.STEPS)
LAWS = [one for one in all_contenders() if not one.regulator.in_engine]
AXIS = (0.48, -0.6, 0.64)

HOLD = RULES.hold_ticks(1e-3)
CONDITIONS = {
    "the judge's": settings(horizon_s=2.0, hold_ticks=HOLD),
    "other gains": settings(horizon_s=0.3, gains=Gains(37.0, 9.0)),
    "long ticks": settings(dt_s=0.05, horizon_s=2.0, hold_ticks=3),
    "a tick longer than the hold": settings(dt_s=0.3, horizon_s=3.0, hold_ticks=1),
    "tight limits": settings(horizon_s=0.3, command_limit=250.0, speed_limit=8.0),
    "one tick": settings(horizon_s=1e-3),
}


@functools.cache
def begun() -> np.ndarray:
    """Every start set of the free body, at the goal, near half turns and on them, spinning, and what is no number."""
    exact = [(1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0), (0.0, 0.6, 0.0, 0.8)]
    near = [short_of_180_degrees(AXIS, 10.0**-k) for k in (2, 5, 8, 12, 15)]
    spins = [(s, -0.5 * s, 0.25 * s) for s in (0.0, 1.0, 30.0, 120.0, 900.0, 7e3, 2e4, 1e200, math.inf, math.nan)]
    starts = [Start("", quat, omega) for quat in (*exact, *near, about(AXIS, 1.0)) for omega in spins]
    return start_rows([*spread(8), *starts])


def rows(engine, contender, condition, given, metrics=METRICS, total=10**9):
    """In lanes, or with a total of none one at a time."""
    return engines.on_ideal(engine, contender, given, CONDITIONS[condition], metrics, total, converge=False)


@pytest.fixture(scope="module")
def elsewhere():
    """A process that compiles into the cache on disk, and gives way to another one after a few laws.

    A loop in lanes, with all of a law in it, takes 25 MB of the process that compiled it to that one's end, and 2 MB of
    one that has it from the cache.
    """
    with ProcessPoolExecutor(1, multiprocessing.get_context("spawn"), max_tasks_per_child=16) as pool:
        yield pool


# Laws of each kind: with a memory, with branches, with and without libm, on coordinates that differentiate. Every week
# each is on both plants, of which the second calls a law four times in a tick, and every other law on the first.
KINDS = (
    *("hybrid", "sliding", "rotation-matrix", "paielli-bach", "linearized-euler-relative/zyx-euler"),
    *("feedback-linearized/mrp", "feedback-linearized/zyx-euler"),
)
ALWAYS = [("ideal-held", KINDS[0]), ("ideal-rk4", KINDS[2]), ("ideal-held", KINDS[-1])]
EVERY = [("ideal-held", one.name) for one in LAWS] + [("ideal-rk4", word) for word in KINDS]
CASES = [pytest.param(*case, marks=() if case in ALWAYS else pytest.mark.weekly) for case in EVERY]


@pytest.mark.parametrize(("engine", "word"), CASES)
def test_lanes_give_the_rows_of_the_loop_bit_for_bit(engine, word, elsewhere):
    elsewhere.submit(compile_into_cache, engine, word).result()
    contender = find_contender(word)
    for condition in CONDITIONS:
        alone = rows(engine, contender, condition, begun(), total=0)
        assert different_rows(rows(engine, contender, condition, begun()), alone) == [], condition


@pytest.mark.parametrize("engine", IDEAL)
def test_these_starts_end_in_every_way_and_at_many_times(engine):
    every = [rows(engine, find_contender("rotation-matrix"), condition, begun()) for condition in CONDITIONS]
    assert {SETTLED, DIVERGED, SATURATED, SINGULAR} <= set(np.concatenate(every)[:, OUTCOME])
    assert len(np.unique(every[0][:, TICKS])) > 50
    assert len(begun()) > 2 * lanes.LANES


HYBRID = find_contender("hybrid")


@pytest.mark.parametrize("count", [0, 1, 7, lanes.LANES - 1, lanes.LANES, lanes.LANES + 1])
def test_any_number_of_starts_may_be_given(count):
    given = begun()[-count:] if count else begun()[:0]
    expected = rows("ideal-held", HYBRID, "the judge's", given, total=0)
    assert same_bits(rows("ideal-held", HYBRID, "the judge's", given), expected)


@pytest.mark.parametrize("engine", IDEAL)
def test_judges_columns_are_the_same_without_metrics(engine):
    law = find_contender("rotation-matrix")
    there = rows(engine, law, "the judge's", begun())
    assert same_bits(rows(engine, law, "the judge's", begun(), metrics=()), there[:, :FIRST_METRIC])


def test_vectors_of_sines_are_not_taken_from_a_library_of_their_own():
    assert numba.config.DISABLE_INTEL_SVML


def test_law_is_compiled_into_vector_instructions():
    """Nothing but the law takes a root here."""
    loop = lanes.episodes_of("ideal-held", evaluation_of(HYBRID), observer(()), 0, cache=False)
    (code,) = loop.inspect_llvm().values()
    assert re.search(r"llvm\.sqrt\.v\d+f64", code)


def test_law_is_compiled_into_lanes_for_many_episodes_without_curves():
    word = "linearized-euler/zyx-euler"
    one, made = find_contender(word), []

    def law_in(representation):
        made.append(word)
        return one.regulator.law.law_in(representation)

    seen = one._replace(regulator=one.regulator._replace(law=one.regulator.law._replace(law_in=law_in)))
    kept = blank_curves(len(begun()), samples=1)

    def compilations(total, curves=None):
        before = len(made)
        engines.on_ideal("ideal-held", seen, begun(), CONDITIONS["one tick"], (), total, curves)
        return len(made) - before

    assert [compilations(engines.WORTH_LANES - 1), compilations(10**9, kept), compilations(0)] == [1, 0, 0]
    assert not np.isnan(kept.samples).all()
    assert [compilations(engines.WORTH_LANES), compilations(10**9)] == [1, 0]
