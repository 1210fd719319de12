"""Call the libraries that only compute errors, as libraries.toml lists them; compile those in C++."""

import ctypes
import functools
import shutil
import subprocess
import tempfile
import tomllib
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library

TAKES = {"R": MATRIX, "q": QUATERNION}
"""Variable of a call -> what its function takes."""
LISTED: dict[str, Any] = tomllib.loads(Path(__file__).with_name("libraries.toml").read_text(encoding="utf-8"))
SOURCES = Path(__file__).parent / "cpp"
NUMBERS = ctypes.POINTER(ctypes.c_double)


def listed(name: str) -> list[Library]:
    """Return a library of libraries.toml.

    Errors:
        ImportError: it is not installed, or it is one in C++ and there is no compiler.
    """
    said, scope = dict(LISTED[name]), {"np": np, "compiled": compiled}
    exec(said.pop("imports"), scope)
    return [Library(name, functions=tuple(_function(one, scope) for one in said.pop("functions")), **said)]


def _function(said: dict[str, Any], scope: dict[str, Any]) -> Function:
    [variable] = TAKES.keys() & said.keys()
    call = eval(f"lambda {variable}: {said[variable]}", scope)
    return Function(takes=TAKES[variable], call=call, **{name: said[name] for name in said.keys() - TAKES.keys()})


@functools.cache
def compiled(name: str, *options: str) -> Callable[[str], Callable]:
    """Compile cpp/NAME.cpp and return: name of a function -> call(array of doubles) -> three numbers.

    Errors:
        ImportError: no compiler, or the library's headers are not installed.
    """
    compiler = shutil.which("c++")
    if compiler is None:
        raise ImportError("no C++ compiler; install g++")
    with tempfile.TemporaryDirectory(prefix="orientation-bench-") as place:
        made = Path(place) / name
        command = [compiler, "-O2", "-shared", "-fPIC", "-std=c++17", str(SOURCES / f"{name}.cpp"), "-o", str(made)]
        done = subprocess.run([*command, *options], capture_output=True, text=True, check=False)
        if done.returncode:
            reason = next((line for line in done.stderr.splitlines() if "error:" in line), "no reason given")
            raise ImportError(f"{name}.cpp: {reason.rpartition('error: ')[2]}")
        library = ctypes.CDLL(str(made))

    def function(word: str) -> Callable:
        called = getattr(library, word)
        called.argtypes, called.restype = (NUMBERS, NUMBERS), None

        def call(value: np.ndarray) -> np.ndarray:
            value, e = np.ascontiguousarray(value, dtype=float), np.full(3, np.nan)
            called(value.ctypes.data_as(NUMBERS), e.ctypes.data_as(NUMBERS))
            return e

        return call

    return function
