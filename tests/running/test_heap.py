"""Threads of a run share one heap, so that what one has freed serves the others."""

import platform
import re
import subprocess
import sys

import pytest

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
