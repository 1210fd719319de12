"""Compiled code that threads and laws share: a loop for all laws, made once, and each law once, whoever asks first."""

import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from support.bits import different_rows
from support.driving import settings, spread

from bench.contenders.registry import find_contender
from bench.engines import ideal
from bench.engines import run as engines
from bench.engines.native import free_body as native
from bench.metrics.registry import metrics_of

METRICS = metrics_of(on_arm=False)
ENGINES = ("ideal-rk4", "ideal-held", "native")


def test_threads_that_need_the_same_loop_compile_it_once(monkeypatch):
    compiled = []

    def slowly(*words):
        compiled.append(words)
        time.sleep(0.05)
        return words

    monkeypatch.setattr(ideal, "episodes_of", slowly)
    with ThreadPoolExecutor(4) as pool:
        loops = list(pool.map(lambda _: engines.compiled_loop("ideal-of-a-test", ()), range(4)))
    assert len(compiled) == 1
    assert all(loop is loops[0] for loop in loops)


def test_threads_that_need_the_same_law_compile_it_once():
    one = find_contender("rotation-matrix")
    with ThreadPoolExecutor(4) as pool:
        found = list(pool.map(lambda _: engines.evaluation(one), range(4)))
    assert all(law is found[0] for law in found)


@pytest.mark.parametrize("engine", ENGINES)
def test_loop_of_one_law_runs_every_other(engine, monkeypatch):
    """So that a law costs its own compilation, not that of a loop."""
    engines.compiled_loop(engine, METRICS)
    for module in (ideal, native):
        monkeypatch.setattr(module, "episodes_of", None)
    starts = spread(1)
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    one, other = (engines.run(engine, law, "free-body", starts, settings(horizon_s=0.5), METRICS) for law in laws)
    assert different_rows(one, other) != []
