"""Compiling with numba: our options, the types of our signatures, and what the law dialect means in compiled code."""

import contextlib
import functools
import importlib
import itertools
import math
import os
import secrets
import threading
from collections.abc import Callable, Iterator
from inspect import isfunction
from typing import Any

import numba
from numba import _dynfunc, float64, types
from numba.core import caching
from numba.core.bytecode import FunctionIdentity
from numba.core.codegen import JITCodeLibrary
from numba.core.cpu import CPUContext
from numba.extending import overload, register_jitable
from numba.np import linalg

from bench.base.errors import BadLaw
from bench.engines import in_c
from bench.engines.arrays import Four, Matrix
from bench.engines.curve import Curves
from bench.engines.episode import Numbers
from bench.engines.kept_code import KeptCode, PlaceOfCode
from bench.engines.signatures import Signature
from bench.engines.typed import PART, type_of
from bench.engines.uncompiled import explain_failure
from bench.law import scalar
from tasks import contact_rest, moving_goal, rules, truth, velocity, verdict


def _count_from_a_random_place() -> None:
    FunctionIdentity._unique_ids = itertools.count(secrets.randbits(56))


_count_from_a_random_place()
os.register_at_fork(after_in_child=_count_from_a_random_place)
"""numba tells functions of one name apart by a number that counts from 1 in every process, and the linker keeps the
first of two that have the same. All laws' closures are called `evaluate`; two that two processes had compiled and a
third took from the cache became one, so that a law was silently run with parts of another. Counting from a random
place, no two processes meet; a fork begins at another one too."""


caching.IndexDataCacheFile = KeptCode
caching.CacheImpl._locator_classes.insert(0, PlaceOfCode)
"""The files of compiled code are ours, see kept_code.py."""

_look_for_blas, linalg.ensure_blas = linalg.ensure_blas, lambda: None
importlib.import_module("numba.np.arraymath")
linalg.ensure_blas = _look_for_blas
"""numba imports it with the first signature, and it imports scipy.linalg to see whether there is BLAS: a third of a
second, and no kernel of ours calls BLAS. One that did would look for it then."""


class _Inlined(JITCodeLibrary):
    """What other compiled code links, and nobody calls: it is optimized, and no machine code is made of it."""

    def _finalize_final_module(self) -> None:
        self._finalize_dynamic_globals()
        self._finalized = True


_executable = CPUContext.get_executable


def _get_executable(self: CPUContext, library: JITCodeLibrary, described: Any, environment: Any) -> Any:
    """Return what numba does; of a function without wrappers an empty one, for its code goes into its callers."""
    if library._finalized or {described.llvm_cpython_wrapper_name, described.llvm_cfunc_wrapper_name}.intersection(
        function.name for function in library._final_module.functions
    ):
        return _executable(self, library, described, environment)
    library.__class__ = _Inlined
    library.finalize()
    name = described.qualname.split(".")[-1]
    return _dynfunc.make_function(described.lookup_module(), name, "", 0, environment, (library,))


CPUContext.get_executable = _get_executable

JIT = {"nogil": True, "error_model": "numpy"}
"""Never fastmath: results must be the plain Python call's, bit for bit."""

VECTOR, MATRIX = float64[::1], float64[:, ::1]
FOUR, NUMBERS, CURVES = map(type_of, (Four, Numbers, Curves))


def numba_signature(signature: Any) -> Any:
    """Return numba's signature of one of `signatures`; another is one already."""
    if not isinstance(signature, Signature):
        return signature
    returns = types.void if signature.returns is None else type_of(signature.returns)
    return returns(*map(type_of, signature.parameters))


INLINED = (
    *(
        "bench.law.chain",
        "bench.law.linalg",
        "bench.law.contenders.jacobians",
        "bench.law.control.resolved_acceleration",
    ),
    *("bench.law.control.hybrid", "bench.engines.arm_episode", "bench.engines.contact_episode"),
    *("bench.engines.plants", "bench.engines.loop", "tasks.conditions"),
)
"""Modules whose kernels take buffers and are always inlined: a call passes each array as seven words, and counts a
reference to it; the chain's velocity took 60 ns, and takes 9."""

_registered: set = set()
_registering = threading.Lock()


def _register_primitive(function: Callable) -> None:
    libm = getattr(math, function.__name__)
    if function.__code__.co_argcount == 2:
        overload(function, jit_options=PART, strict=False)(lambda y, x: lambda y, x: libm(y, x))
    else:
        overload(function, jit_options=PART, strict=False)(lambda x: lambda x: libm(x))
    _registered.add(function)


def register_kernels() -> None:
    """Make every marked function known to numba; functions marked since the last call are added."""
    with _registering:
        for function in scalar.PRIMITIVES:
            if function not in _registered:
                _register_primitive(function)
        judges = (verdict, truth, rules, moving_goal, velocity, contact_rest)
        plain = (one for module in judges for one in vars(module).values() if isfunction(one))
        for function in (*scalar.KERNELS, *plain):
            register(function)


def register(function: Callable) -> Callable:
    """Make one plain function callable from compiled code."""
    if function not in _registered:
        inlined = {"forceinline": True} if function.__module__.startswith(INLINED) else {}
        register_jitable(**PART, **inlined)(function)
        _registered.add(function)
    return function


def compile_function(function: Callable, signature: Any, cache: bool = True, **options: Any) -> Callable:
    """Return the function compiled for one signature with our options and others; cached on disk if no user's law."""
    if isinstance(signature, Signature) and in_c.compiler():
        return in_c.compile_signature(function, signature, is_users=not cache)
    register_kernels()
    return numba.njit(numba_signature(signature), cache=cache, **JIT, **options)(function)


def compile_on_demand(function: Callable, is_kept: bool = False) -> Callable:
    """Return a function that is compiled for the values that it is called with; is_kept: on disk."""
    if in_c.compiler():
        return in_c.CodeOnDemand(function, is_kept)
    register_kernels()
    return numba.njit(**JIT)(function)


def bind(code: Callable, *values: Any) -> Callable[[], Any]:
    """Return a function without arguments that calls compiled code with these values, which it takes apart once."""
    return code.bind(*values) if isinstance(code, in_c.CodeOnDemand) else functools.partial(code, *values)


def compile_loop(episodes: Callable, laws: tuple, world: Any = None) -> Callable:
    """Return a loop of `loop.episodes_of`, compiled; cached on disk.

    laws: signatures of the functions that it calls by pointer, three at most. world: a named tuple, annotated.
    """
    if in_c.compiler():
        return in_c.CodeOfLoop(episodes, laws, (world, Four, Matrix, Numbers, Matrix, Curves))
    functions = (*(types.FunctionType(numba_signature(law)) for law in laws), *[types.none] * (3 - len(laws)))
    # a file of the cache for each world: one for all would import every world, and MuJoCo, with the first loop
    episodes.__qualname__ += f".{world.__module__}.{world.__name__}" if world else ".ideal"
    return compile_function(episodes, types.void(*functions, type_of(world), FOUR, MATRIX, NUMBERS, MATRIX, CURVES))


def compile_callback(function: Callable, signature: Any) -> Any:
    """Return the function as C code calls it, by its `address`; cached on disk."""
    register_kernels()
    return numba.cfunc(signature, nopython=True, cache=True)(function)


def compile_once(make: Callable) -> Callable:
    """Return a function that compiles once for the same arguments; other threads wait for it."""
    cached = functools.cache(make)
    locks: dict[tuple, threading.Lock] = {}

    @functools.wraps(make)
    def compile_or_wait(*words: Any) -> Any:
        with locks.setdefault(words, threading.Lock()):
            return cached(*words)

    return compile_or_wait


part = compile_once(compile_function)
"""part(function, signature): a function of ours that loops call by pointer, compiled or taken from the disk cache."""


@contextlib.contextmanager
def own_law(origin: str) -> Iterator[bool]:
    """Compile what holds a law: yields whether it may be cached on disk, which a user's (of the file `origin`) is not.

    Errors:
        BadLaw: a user's law that the compiler cannot take.
    """
    try:
        yield not origin
    except Exception as error:
        if not origin:
            raise
        raise BadLaw(f"--law {origin}: the law cannot be compiled: {explain_failure(error)}") from error
