"""C++ that calls a library of Debian's, compiled here: a file of asked/cpp, whose functions give e of a rotation."""

import ctypes
import functools
import shutil
import subprocess
import tempfile
from collections.abc import Callable
from pathlib import Path

import numpy as np

SOURCES = Path(__file__).parent / "asked" / "cpp"
NUMBERS = ctypes.POINTER(ctypes.c_double)


@functools.cache
def load(name: str, *options: str) -> Callable[[str], Callable]:
    """asked/cpp/NAME.cpp, compiled: name of a function -> call(array of doubles) -> three numbers.

    Errors:
        ImportError: no compiler, or the library's headers are not installed.
    """
    compiler = shutil.which("c++")
    if compiler is None:
        raise ImportError("no C++ compiler; install g++")
    folder = Path(tempfile.mkdtemp(prefix="orientation-bench-"))
    try:
        made = subprocess.run(
            [compiler, "-O2", "-shared", "-fPIC", "-std=c++17", SOURCES / f"{name}.cpp", "-o", folder / name, *options],
            capture_output=True,
            text=True,
            check=False,
        )
        if made.returncode:
            reason = next((line for line in made.stderr.splitlines() if "error:" in line), "no reason given")
            raise ImportError(f"{name}.cpp: {reason.rpartition('error: ')[2]}")
        library = ctypes.CDLL(str(folder / name))
    finally:
        shutil.rmtree(folder)

    def function(word: str) -> Callable:
        called = getattr(library, word)
        called.argtypes, called.restype = (NUMBERS, NUMBERS), None

        def call(value) -> np.ndarray:
            value, e = np.ascontiguousarray(value, dtype=float), np.full(3, np.nan)
            called(value.ctypes.data_as(NUMBERS), e.ctypes.data_as(NUMBERS))
            return e

        return call

    return function
