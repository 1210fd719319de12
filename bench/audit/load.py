"""The function that a user names: in a Python file or module, of a class, or a symbol of a shared library.

    my_file.py:my_error         package.module:my_error         libmine.so:my_error
    my_file.py:MyController     a class: its instance is called, or its only method of two orientations

A C function has the signature

    void f(const double R[9], const double R_d[9], double e[3]);     matrices by rows, or
    void f(const double q[4], const double q_d[4], double e[3]);     quaternions

and is given buffers of 64 numbers, so that asking it for the wrong kind reads nothing that is not there, and what it
writes behind e[2] is seen.
"""

import ctypes
import importlib
import importlib.util
import inspect
import sys
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np

from bench.audit.examined import INTERFACE, Lost
from bench.base.errors import BadFunction

LIBRARIES = (".so", ".dylib", ".dll")
BUFFER = 64
UNWRITTEN = 255
"""Every byte of e before a call: of eight, no number."""


def load(target: str) -> Callable:
    """Return the function that FILE:NAME or MODULE:NAME names. This runs the file."""
    place, colon, name = target.rpartition(":")
    if not (place and colon and name):
        raise BadFunction(f"'{target}' names no function; give FILE.py:NAME, MODULE:NAME or LIBRARY.so:SYMBOL")
    if place.endswith(LIBRARIES):
        return of_library(Path(place), name)
    module = imported(place)
    try:
        found = getattr(module, name)
    except AttributeError:
        public = [word for word in vars(module) if not word.startswith("_")]
        raise BadFunction(f"{place} has no '{name}'; it has {', '.join(public) or 'nothing'}") from None
    if inspect.isclass(found):
        return of_class(found, target)
    if not callable(found):
        raise BadFunction(f"{target} is {type(found).__name__}, no function; give one of (R, R_d) or (q, q_d)")
    return found


def existing(path: Path) -> Path:
    """Return the path, if there is a file."""
    if not path.is_file():
        raise BadFunction(f"there is no file {path}; give the path of a Python file or of a shared library")
    return path


def imported(place: str) -> ModuleType:
    """Return a Python file or a module by its name, the file's folder or this one among those that it imports from."""
    is_file = place.endswith(".py")
    sys.path.insert(0, str(existing(Path(place)).resolve().parent if is_file else Path.cwd()))
    try:
        if not is_file:
            return importlib.import_module(place)
        spec: Any = importlib.util.spec_from_file_location(f"audited_{Path(place).stem}", place)
        module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)  # where dataclasses look for it
        spec.loader.exec_module(module)
        return module
    except (Exception, SystemExit) as error:
        cure = "correct the file" if is_file else "give FILE.py:NAME, or install the package"
        raise BadFunction(f"{place} does not import ({type(error).__name__}: {error}); {cure}") from error
    finally:
        sys.path.pop(0)


def of_class(found: type, target: str) -> Callable:
    """Return an instance's function: the instance itself, or its only public method that takes two things."""
    try:
        instance = found()
    except Exception as error:
        raise BadFunction(
            f"{target}() raises {type(error).__name__}: {error}; give a class that needs no arguments, or a function"
        ) from error
    if callable(instance):
        return instance
    methods = [name for name, _ in inspect.getmembers(instance, inspect.ismethod) if takes_two(instance, name)]
    if len(methods) != 1:
        said = f"several ({', '.join(methods)})" if methods else "none"
        raise BadFunction(f"{target}: of methods that take two orientations it has {said}; give it a __call__(R, R_d)")
    return getattr(instance, methods[0])


def takes_two(instance: object, name: str) -> bool:
    """Tell whether a public method can be called with two arguments."""
    if name.startswith("_"):
        return False
    try:
        inspect.signature(getattr(instance, name)).bind(None, None)
    except TypeError:
        return False
    return True


def of_library(path: Path, symbol: str) -> Callable:
    """Return a function of C."""
    try:
        library = ctypes.CDLL(str(existing(path).resolve()))
    except OSError as error:
        raise BadFunction(f"{path} does not load ({error}); build it as a shared library of this machine") from error
    try:
        function = getattr(library, symbol)
    except AttributeError:
        raise BadFunction(f"{path} has no symbol '{symbol}'; declare it extern \"C\" (try: nm -D {path})") from None
    numbers = np.ctypeslib.ndpointer(dtype=np.float64, shape=(BUFFER,), flags="C_CONTIGUOUS")
    function.argtypes, function.restype = (numbers, numbers, numbers), None

    has_answered = False

    def call(now: np.ndarray, goal: np.ndarray) -> np.ndarray:
        nonlocal has_answered
        given, wanted = np.zeros(BUFFER), np.zeros(BUFFER)
        e = np.full(8 * BUFFER, UNWRITTEN, np.uint8).view(float)
        given[: now.size], wanted[: goal.size] = now.ravel(), goal.ravel()
        function(given, wanted, e)
        written = np.flatnonzero((e.view(np.uint8).reshape(-1, 8) != UNWRITTEN).any(axis=1))
        last = int(written[-1]) if len(written) else -1
        if last > 2 or not (last == 2 or has_answered):
            how = f"it wrote e[{last}]" if last > 2 else "it wrote no e[2]" if last >= 0 else "it wrote nothing into e"
            raise Lost(INTERFACE, f"{how}, where three doubles are expected", now, goal)
        has_answered = True
        now[...], goal[...] = given[: now.size].reshape(now.shape), wanted[: goal.size].reshape(goal.shape)
        return e[:3]

    return call
