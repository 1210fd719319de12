"""Compiling ahead, into a cache that a run finds, by a process that ends with it; one heap for a run's threads."""

import json
import os
import platform
import re
import subprocess
import threading
from pathlib import Path

import psutil
import pytest
from support.command_line import python, started

from bench.base.processes import module_command
from bench.experiments import plan
from bench.experiments.request import Request
from bench.law.contenders.registry import all_contenders, find_contender
from bench.running import precompile
from bench.running.wire_format import described

# Without arms, whose starts take seconds to find.
EVERY = plan.make(Request("quick", tuple(all_contenders()), tasks=("free-body",)))


def compile_apart(folder: Path, units: tuple, *counted: str, **variables: str) -> list[int]:
    """Compile and count in a process with a cache of its own; the numbers that it prints."""
    content = json.dumps({"plan": described(EVERY, units), "count": counted})
    command = module_command("bench.running.precompile", str(os.getpid()))
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(folder), **variables}
    done = subprocess.run(command, env=environment, input=content, text=True, check=True, capture_output=True)
    return [int(line) for line in done.stdout.splitlines()]


HELD = [next(one for one in EVERY.units if one.engine == "ideal-held")]


def test_it_leaves_a_loop_a_law_and_counts_in_the_cache(tmp_path):
    assert set(compile_apart(tmp_path, HELD, "hybrid")) == {0, 1}
    assert {path.stem.partition("-")[2] for path in (tmp_path / "costs").iterdir()} == {"hybrid"}
    assert len(list((tmp_path / "c").glob("*.so"))) == 3  # the loop, the law, and what MuJoCo calls back


def test_numba_leaves_a_loop_and_a_law_in_the_cache_where_it_compiles(tmp_path):
    assert set(compile_apart(tmp_path, HELD, ORIENTATION_BENCH_COMPILER="numba")) == {0}
    assert {"binding", "loop"} <= {path.name.split(".")[0] for path in tmp_path.rglob("*.nbc")}


def test_what_is_beyond_a_life_is_done_by_the_next_fork(tmp_path):
    counted = ["rotation-matrix"] * precompile.LIFE + ["hybrid"]
    assert {0, precompile.LIFE} <= set(compile_apart(tmp_path, (), *counted))
    assert {path.stem.partition("-")[2] for path in (tmp_path / "costs").iterdir()} == {"rotation-matrix", "hybrid"}


def test_a_few_contenders_are_not_worth_a_process():
    few = plan.make(Request("quick", (find_contender("hybrid"),), tasks=("free-body",)))
    with precompile.compiling_ahead(few, few.units) as ahead:
        assert ahead is None


def test_a_thread_waits_until_what_it_needs_is_compiled_or_the_process_has_ended():
    units = EVERY.units[:2]
    with subprocess.Popen(["cat"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        ahead, stop = precompile.Ahead(process, units), threading.Event()
        waiting = threading.Thread(target=ahead.wait_for, args=(units[0], stop))
        waiting.start()
        waiting.join(0.5)
        assert waiting.is_alive()
        print(0, file=process.stdin, flush=True)
        waiting.join(60)
        assert not waiting.is_alive()
        process.stdin.close()
        ahead.wait_for(units[1], stop)


def interrupted(begun):
    with precompile.compiling_ahead(EVERY, EVERY.units) as ahead:
        begun.append(ahead.process)
        assert ahead.process.poll() is None
        raise KeyboardInterrupt


def test_the_process_ends_with_the_run_even_if_that_fails():
    with pytest.raises(KeyboardInterrupt):
        interrupted(begun := [])
    assert begun[0].poll() is not None


def test_the_process_and_its_fork_end_with_a_run_that_is_killed(tmp_path):
    script = (
        "import time; from bench.experiments import plan, request; from bench.law.contenders import registry\n"
        "from bench.running import precompile\n"
        "laws = tuple(registry.all_contenders())\n"
        "every = plan.make(request.Request('quick', laws, tasks=('free-body',)))\n"
        "with precompile.compiling_ahead(every, every.units) as ahead:\n"
        "    print(ahead.process.pid, flush=True); time.sleep(60)"
    )
    with started("-c", script, variables={"NUMBA_CACHE_DIR": tmp_path}) as run:
        compiling = psutil.Process(int(run.stdout.readline()))
        while not (forks := compiling.children()):
            compiling.status()
        run.kill()
    for one in (compiling, *forks):
        one.wait(timeout=10)


ASKED = """
import ctypes, sys, threading
from bench.running.schedulers import share_heap
if sys.argv[1] == "shared":
    assert share_heap()
libc = ctypes.CDLL(None)
libc.malloc.restype = ctypes.c_void_p
begun = threading.Barrier(4)
def work():
    begun.wait()
    for _ in range(100):
        libc.malloc(ctypes.c_size_t(1000))
threads = [threading.Thread(target=work) for _ in range(4)]
for one in threads:
    one.start()
for one in threads:
    one.join()
libc.fdopen.restype = ctypes.c_void_p
libc.malloc_info(0, ctypes.c_void_p(libc.fdopen(1, b"w")))
libc.fflush(None)
"""


def heaps(way: str) -> int:
    """How many heaps four threads have used, by the C library's own account."""
    return len(re.findall("<heap nr=", python("-c", ASKED, way)))


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library has no arenas")
def test_threads_share_a_heap_where_they_would_have_one_each():
    assert heaps("shared") == 1 < heaps("apart")
