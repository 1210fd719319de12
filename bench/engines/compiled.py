"""numba, set up once: where its cache lives, how laws compile, what a law's functions mean in compiled code.

Import this before numba. numba's cache looks only at the file of the function it caches, so an edited law or another
mujoco would run stale code; here the cache folder is a digest of all our sources and the versions that matter.
"""

import contextlib
import itertools
import os
import secrets
import shutil
from pathlib import Path
from typing import Any

from bench.provenance import source_digest

fcntl: Any
try:
    import fcntl
except ImportError:  # no such locks on this system: compile in one process at a time there
    fcntl = None

KEPT_CACHES = 8
"""States of the sources whose compiled code is kept, the newest first: some 15 MB each."""


def cache_home() -> Path:
    """The folder that holds one cache for each state of the sources."""
    base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "orientation-bench" / "numba"


def _use_cache() -> Path:
    """The cache of these sources, which NUMBA_CACHE_DIR overrides; the oldest of the others go."""
    chosen = os.environ.get("NUMBA_CACHE_DIR")
    if chosen:
        return Path(chosen)
    folder = cache_home() / source_digest()
    os.environ["NUMBA_CACHE_DIR"] = str(folder)
    if not folder.exists() and cache_home().is_dir():
        by_age = sorted(cache_home().iterdir(), key=lambda path: path.stat().st_mtime, reverse=True)
        for path in by_age[KEPT_CACHES - 1 :]:
            shutil.rmtree(path, ignore_errors=True)
    return folder


CACHE = _use_cache()

import math  # noqa: E402

import llvmlite.binding as llvm  # noqa: E402
import numba  # noqa: E402
from numba import float64, int32, int64, types  # noqa: E402
from numba.core.bytecode import FunctionIdentity  # noqa: E402
from numba.extending import overload, register_jitable  # noqa: E402

from bench import scalar  # noqa: E402
from bench.contender import Gains, Goal  # noqa: E402
from bench.engines.episode import Numbers  # noqa: E402
from bench.so3 import Rotation  # noqa: E402
from tasks import truth, verdict  # noqa: E402

__all__ = ["CACHE", "EPISODES", "MATRIX", "NUMBERS", "compile_function", "float64", "int32", "int64", "llvm", "types"]

FunctionIdentity._unique_ids = itertools.count(secrets.randbits(56))
"""numba tells functions of one name apart by a number that counts from 1 in every process, and the linker keeps the
first of two that have the same. All laws' closures are called `command`; two that two processes had compiled and a
third took from the cache became one, so that a law was silently run with parts of another. Counting from a random
place, no two processes meet."""

JIT = {"nogil": True, "error_model": "numpy"}
"""Never fastmath: results must be the plain Python call's, bit for bit."""

VECTOR = types.UniTuple(float64, 3)
ROTATION = types.NamedUniTuple(VECTOR, 3, Rotation)
GOAL = types.NamedTuple((ROTATION, VECTOR, VECTOR), Goal)
GAINS = types.NamedUniTuple(float64, 2, Gains)
MATRIX = float64[:, ::1]
NUMBERS = types.NamedTuple((float64, float64, float64, int64, int64, float64, float64, float64, float64), Numbers)
EPISODES = types.void(MATRIX, NUMBERS, MATRIX)
"""episodes(starts, numbers, rows): the signature of every compiled loop over the ideal plant."""

_registered: set = set()


def _register_primitive(function):
    libm = getattr(math, function.__name__)
    if function.__code__.co_argcount == 2:
        overload(function, jit_options=JIT, strict=False)(lambda y, x: lambda y, x: libm(y, x))
    else:
        overload(function, jit_options=JIT, strict=False)(lambda x: lambda x: libm(x))
    _registered.add(function)


def register_kernels() -> None:
    """Make every marked function known to numba; functions marked since the last call are added."""
    for function in scalar.PRIMITIVES:
        if function not in _registered:
            _register_primitive(function)
    for function in (*scalar.KERNELS, *verdict.COMPILABLE, truth.angle, truth.haversine):
        register(function)


def register(function):
    """Make one plain function callable from compiled code."""
    if function not in _registered:
        register_jitable(error_model="numpy")(function)
        _registered.add(function)
    return function


def compile_function(function, signature, cache: bool = True):
    """The function compiled for one signature with our options; cached on disk unless the law is a user's."""
    register_kernels()
    with cache_to_itself() if cache else contextlib.nullcontext():
        return numba.njit(signature, cache=cache, **JIT)(function)


@contextlib.contextmanager
def cache_to_itself():
    """Others wait, threads and processes: of two that write its index at once, one would find the other's code."""
    if fcntl is None:
        yield
        return
    CACHE.mkdir(parents=True, exist_ok=True)
    with open(CACHE / "lock", "w", encoding="utf-8") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield
