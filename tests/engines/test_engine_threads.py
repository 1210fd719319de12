"""Compiled code that threads and laws share: a loop for all laws, made once, and each law once, whoever asks first."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from support.bits import different_rows
from support.driving import settings, spread

from bench.engines import simulate as engines
from bench.engines.compiled import made_once
from bench.engines.metrics.registry import metrics_of
from bench.law.contenders.registry import find_contender

METRICS = metrics_of(on_arm=False)
ENGINES = ("ideal-rk4", "ideal-held", "native")


def test_threads_that_need_the_same_wait_for_the_first_to_make_it():
    made = []

    @made_once
    def slowly(word):
        made.append(word)
        time.sleep(0.05)
        return [word]

    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(slowly, 4 * ["loop"]))
    assert made == ["loop"]
    assert all(one is found[0] for one in found)


@pytest.mark.parametrize("engine", ENGINES)
def test_loop_of_one_law_runs_every_other(engine):
    """So that a law costs its own compilation, not that of a loop: it is made for no law, and has one signature."""
    loop = engines.compiled_loop(engine, METRICS)
    starts = spread(1)
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    one, other = (engines.run(engine, law, "free-body", starts, settings(horizon_s=0.5), METRICS) for law in laws)
    assert different_rows(one, other) != []
    assert engines.compiled_loop(engine, METRICS) is loop
    assert len(loop.signatures) == 1
