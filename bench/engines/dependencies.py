"""Find on what the compiled code of a function depends, so that code that is kept is taken only where it is the same.

Four things decide it, and `stamp_of` is a digest over all of them:

1. The functions that it calls. A walk begins at the function and follows each name that its byte code reads: globals,
   cells of a closure, attributes of our modules. Functions count by their byte code, which has no comments and no
   lines; numbers, texts, tuples and arrays count by their value, wherever they came from.
2. The files of the modules of these functions, and all that these files import: the fields of a named tuple, say.
3. What decides how code is compiled: each file of the engines that imports numba or `compiled`, and what it imports.
4. Versions of packages, variables of the environment that numba and libraries read, vector units of the processor.

The processor itself and the types of the arguments are in numba's own key.
"""

import enum
import functools
import hashlib
import os
import sys
import types
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numba.core.dispatcher import Dispatcher
from numba.core.types import ExternalFunction, Type

from bench.base.provenance import ARITHMETIC, VERSIONED, vectors, versions
from bench.base.sources import reader

ROOM = "bench/engines"
COMPILER = ("numba", "llvmlite")
COMPILED = "bench.engines.compiled"

READS_NO_CODE = ("NUMBA_CACHE_DIR", "NUMBA_DEBUG_CACHE", "NUMBA_NUM_THREADS", "NUMBA_WARNINGS")
"""Variables of numba that change no code."""

VERSIONS_DECIDE = sys.stdlib_module_names.union(name.replace("-", "_") for name in VERSIONED)
"""Packages whose functions a walk names and does not follow: their versions are in the stamp."""

SIMPLE = (bool, int, float, complex, str, bytes, type(None), type(Ellipsis), np.generic)
"""Types whose `repr` is the whole value."""


class Stamp(NamedTuple):
    """Digest of all on which the compiled code of one function depends, but the types of its arguments."""

    digest: str


class Reached(NamedTuple):
    """What a walk from a function has come by.

    Attributes:
        modules: Names of the modules of all functions and classes.
        words: Descriptions of all functions and values, in the order of the walk.
    """

    modules: frozenset[str]
    words: tuple[str, ...]


def stamp_of(function: Callable) -> Stamp:
    """Return the stamp of a function."""
    reached = walk(function)
    paths: set[Path] = set(list_compiler_files())
    for module in reached.modules:
        paths |= reader().follow(module)
    setting = describe_setting(os.environ, _versions())
    return Stamp(reader().digest(paths, repr((reached.words, setting))))


@functools.cache
def list_compiler_files() -> frozenset[Path]:
    """Return the files that decide how functions are compiled, with all that they import."""
    files = reader()
    found: set[Path] = set()
    for path in files.list_files(ROOM):
        imports = files.read(path).imports
        if any(name.split(".")[0] in COMPILER or name.startswith(COMPILED) for name in imports):
            module = ".".join(path.relative_to(files.root).with_suffix("").parts)
            found |= files.follow(module.removesuffix(".__init__"))
    return frozenset(found)


def describe_setting(environment: Mapping[str, str], packages: Mapping[str, str]) -> str:
    """Describe what else decides the machine code: versions, variables of the environment, vector units."""
    names = {name for name in environment if name.startswith("NUMBA_")}
    names = names.union(ARITHMETIC).difference(READS_NO_CODE)
    variables = [(name, environment.get(name)) for name in sorted(names)]
    return repr((sorted(packages.items()), variables, vectors()))


@functools.cache
def _versions() -> dict[str, str]:
    return versions()


def walk(function: Callable) -> Reached:
    """Follow all names that a function reads, and those that its callees read."""
    modules: set[str] = set()
    words: list[str] = []
    places: dict[int, int] = {}
    kept: list[Any] = []  # so that no two objects have one id
    waiting: list[tuple[str, Any]] = [("", function)]
    while waiting:
        name, value = waiting.pop()
        if isinstance(value, Dispatcher):
            value = value.py_func
        if not isinstance(value, (tuple, frozenset, *SIMPLE)):  # equal ones may or may not be one object
            if id(value) in places:
                words.append(f"{name}: as {places[id(value)]}")
                continue
            places[id(value)] = len(words)
            kept.append(value)
        words.append(f"{name}: {describe(value)}")
        if isinstance(value, types.FunctionType | type):
            modules.add(value.__module__)
        elif isinstance(value, tuple | enum.Enum):
            modules.add(type(value).__module__)
        waiting += list_parts(value)
    return Reached(frozenset(modules), tuple(words))


def describe(value: Any) -> str:
    """Describe one object without its parts.

    Compiled code can hold as constants what has a branch here, and no other object: numba refuses it.
    """
    kind = f"{type(value).__module__}.{type(value).__qualname__}"
    if isinstance(value, types.FunctionType):
        return f"{value.__module__}.{value.__qualname__} {describe_code(value.__code__, value.__doc__)}"
    if isinstance(value, type):
        return f"{value.__module__}.{value.__qualname__} {getattr(value, '_fields', '')}"
    if isinstance(value, (enum.Enum, np.dtype, *SIMPLE)):
        return f"{kind} {value!r}"
    if isinstance(value, ExternalFunction):
        return f"{kind} {value.symbol} {value.sig}"
    if isinstance(value, Type):
        return f"{kind} {value!r}"
    if isinstance(value, np.ndarray):
        return f"{kind} {value.dtype} {value.shape} {value.strides} {hashlib.sha256(value.tobytes()).hexdigest()}"
    if isinstance(value, types.ModuleType | types.BuiltinFunctionType | np.ufunc):
        return f"{kind} {value.__name__}"
    if isinstance(value, set | frozenset):
        return f"{kind} {sorted(map(repr, value))}"
    if isinstance(value, tuple | list | dict):
        return f"{kind} of {len(value)}"
    return kind


def list_parts(value: Any) -> Iterator[tuple[str, Any]]:
    """Yield the parts of an object that a function may read, by name."""
    if isinstance(value, types.FunctionType):
        if not is_foreign(value.__module__):
            yield from list_reads(value)
    elif isinstance(value, dict):
        yield from ((repr(key), part) for key, part in value.items())
    elif isinstance(value, tuple | list):
        yield from ((str(place), part) for place, part in enumerate(value))


def list_reads(function: types.FunctionType) -> Iterator[tuple[str, Any]]:
    """Yield all that a function reads from outside: defaults, cells, globals, and attributes of our modules."""
    for values in (function.__defaults__, function.__kwdefaults__):
        if values:
            yield "defaults", values
    for name, cell in zip(function.__code__.co_freevars, function.__closure__ or (), strict=True):
        try:
            yield name, cell.cell_contents
        except ValueError:
            yield name, None  # it is filled later, and numba refuses it now
    names = sorted(list_names(function.__code__))
    for name in names:
        if name not in function.__globals__:
            continue
        value = function.__globals__[name]
        yield name, value
        if isinstance(value, types.ModuleType) and not is_foreign(value.__name__):
            content = vars(value)
            yield from ((f"{name}.{word}", content[word]) for word in names if word in content)


def is_foreign(module: str) -> bool:
    """Tell whether a module is of Python's library or of a package whose version is in the stamp."""
    return module.partition(".")[0] in VERSIONS_DECIDE


def list_names(code: types.CodeType) -> set[str]:
    """Return the names that code reads, and code inside of it."""
    names = set(code.co_names)
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            names |= list_names(constant)
    return names


def describe_code(code: types.CodeType, docstring: str | None) -> str:
    """Return a digest of byte code and its constants, without lines, the file's place and the docstring."""
    words = [code.co_code.hex(), code.co_exceptiontable.hex(), code.co_name, str(code.co_flags)]
    words += map(repr, (code.co_names, code.co_varnames, code.co_freevars, code.co_cellvars))
    words += map(repr, (code.co_argcount, code.co_posonlyargcount, code.co_kwonlyargcount))
    for constant in code.co_consts:
        if isinstance(constant, types.CodeType):
            words.append(describe_code(constant, None))
        elif isinstance(constant, frozenset):
            words.append(repr(sorted(map(repr, constant))))
        elif docstring is None or constant != docstring:
            words.append(repr(constant))
    return hashlib.sha256("\0".join(words).encode()).hexdigest()
