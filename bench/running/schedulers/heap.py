"""One heap for all threads of this process.

glibc's allocator gives every thread an arena of its own and seldom returns what one has freed: a default run then holds
two thirds more memory. Source: mallopt(3), M_ARENA_MAX.
"""

import ctypes
import sys

ARENA_MAX = -8
"""M_ARENA_MAX of malloc.h."""


def share() -> bool:
    """Let threads begun from now on share the main thread's heap; False where the C library has no such setting."""
    if sys.platform != "linux":
        return False
    mallopt = getattr(ctypes.CDLL(None), "mallopt", None)
    return mallopt is not None and mallopt(ARENA_MAX, 1) == 1
