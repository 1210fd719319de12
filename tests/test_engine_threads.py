"""Threads that share a law: it is compiled once, whoever asks first."""

import time
from concurrent.futures import ThreadPoolExecutor

from bench.discovery import find_contender
from bench.engines import ideal
from bench.engines.run import compiled_loop


def test_threads_that_need_the_same_loop_compile_it_once(monkeypatch):
    compiled = []

    def slowly(*words):
        compiled.append(words)
        time.sleep(0.05)
        return words

    monkeypatch.setattr(ideal, "episodes_of", slowly)
    law = find_contender("rotation-matrix")
    with ThreadPoolExecutor(4) as pool:
        loops = list(pool.map(lambda _: compiled_loop("ideal-of-a-test", law, ()), range(4)))
    assert len(compiled) == 1
    assert all(loop is loops[0] for loop in loops)
