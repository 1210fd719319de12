"""Who carries out the units of a plan: threads, processes of this machine, or a cluster that is there already."""

import ctypes
import re
import sys
from importlib.util import find_spec

from bench.base.errors import BadNumber, MissingTool, UnknownWord

THREADS = "threads"
LOCAL = "local:"
MOST = 256

ARENA_MAX = -8
"""M_ARENA_MAX of malloc.h."""


def check_scheduler(word: str) -> None:
    """Refuse a word that names no scheduler, or a bad number of processes, or one without its package (MissingTool)."""
    if word.startswith(LOCAL):
        number = word.removeprefix(LOCAL)
        if not (re.fullmatch("[0-9]{1,9}", number) and 1 <= int(number) <= MOST):
            raise BadNumber(
                f"--scheduler {word}: give between 1 and {MOST} processes (the number of cores is best: local:2)"
            )
    elif word != THREADS and not re.fullmatch(r"(tcp|tls)://.+:[0-9]{1,5}", word):
        raise UnknownWord("scheduler", word, [THREADS, "local:N", "tcp://host:8786", "tls://host:8786"])
    if word != THREADS and find_spec("distributed") is None:
        raise MissingTool(
            f"--scheduler {word}: needs Dask, which is not installed (try: make setup-cluster, or leave it away)"
        )


def kind(word: str) -> str:
    """Return what it is, without the name of a host: threads, local, tcp or tls."""
    return word.split(":")[0]


def share_heap() -> bool:
    """Let threads begun from now on share the main thread's heap; False where the C library has no such setting.

    glibc's allocator gives every thread an arena of its own and seldom returns what one has freed: a default run then
    holds two thirds more memory. Source: mallopt(3), M_ARENA_MAX.
    """
    if sys.platform != "linux":
        return False
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    return mallopt is not None and mallopt(ARENA_MAX, 1) == 1
