"""Compiling ahead, into a cache that a run finds, by a process that ends with it; one heap for a run's threads."""

import os
import platform
import re
import subprocess
import sys
from pathlib import Path

import psutil
import pytest

from bench.base.provenance import ROOT
from bench.experiments import plan
from bench.experiments.experiment import experiment_of
from bench.law.contenders.registry import all_contenders
from bench.running import precompile


def compiled(folder: Path, *work: str) -> set[str]:
    """Compile and count in a process with a cache of its own; the laws whose counts are kept there."""
    words = [sys.executable, "-m", "bench.running.precompile", str(os.getpid()), *work]
    subprocess.run(words, env={**os.environ, "NUMBA_CACHE_DIR": str(folder)}, check=True, capture_output=True)
    return {path.stem.partition("-")[2] for path in (folder / "costs").iterdir()}


def test_it_leaves_laws_controllers_of_arms_and_of_contact_in_the_cache(tmp_path):
    names = ["rotation-matrix", "rotation-matrix@geometric+solve", "impedance-geometric"]
    assert compiled(tmp_path, *names, f"{precompile.COUNT}rotation-matrix") == {"rotation-matrix"}
    assert {"binding", "resolved_acceleration"} <= {path.name.split(".")[0] for path in tmp_path.rglob("*.nbi")}
    assert len(list(tmp_path.rglob("*.nbi"))) >= len(names)


def test_every_name_that_a_default_run_compiles_ahead_is_one_it_can_compile():
    every = plan.make("default", all_contenders())
    names = {unit.contender for unit in every.units if experiment_of(unit).compiles}
    assert len(names) > precompile.LIFE
    assert all(callable(precompile.compiler_of(name)) for name in names)


def test_what_is_beyond_a_life_is_done_by_the_next(tmp_path):
    work = [f"{precompile.COUNT}rotation-matrix"] * precompile.LIFE + [f"{precompile.COUNT}hybrid"]
    assert compiled(tmp_path, *work) == {"rotation-matrix", "hybrid"}


def test_a_few_contenders_are_not_worth_a_process():
    with precompile.compiling_ahead(["hybrid"] * 100) as ahead:
        assert ahead is None


def interrupted(begun):
    with precompile.compiling_ahead(["rotation-matrix", *map(str, range(precompile.WORTH))]) as ahead:
        begun.append(ahead.process)
        assert ahead.process.poll() is None
        raise KeyboardInterrupt


def test_the_process_ends_with_the_run_even_if_that_fails():
    begun = []
    with pytest.raises(KeyboardInterrupt):
        interrupted(begun)
    assert begun[0].poll() is not None


def test_the_process_ends_with_a_run_that_is_killed(tmp_path):
    script = (
        "import time; from bench.law.contenders.registry import all_contenders; from bench.running import precompile\n"
        "with precompile.compiling_ahead(one.name for one in all_contenders()) as ahead:\n"
        "    print(ahead.process.pid, flush=True); time.sleep(60)"
    )
    environment = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    with subprocess.Popen([sys.executable, "-c", script], env=environment, stdout=subprocess.PIPE, cwd=ROOT) as run:
        compiling = psutil.Process(int(run.stdout.readline()))
        run.kill()
    compiling.wait(timeout=10)


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
    made = subprocess.run([sys.executable, "-c", ASKED, way], capture_output=True, text=True, check=True)
    return len(re.findall("<heap nr=", made.stdout))


@pytest.mark.skipif(platform.libc_ver()[0] != "glibc", reason="another C library has no arenas")
def test_threads_share_a_heap_where_they_would_have_one_each():
    assert heaps("shared") == 1 < heaps("apart")
