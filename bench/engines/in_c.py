"""Loops and laws translated to C, compiled by this machine's C compiler, and called from Python.

A file of C is compiled once: the name of its library follows from its text, the compiler and the options, and so an
edit elsewhere compiles nothing again. A library is written beside its place and renamed: nobody waits for anybody.
A process that runs a user's law takes what is there and keeps nothing: what it compiles goes with it.
"""

import contextlib
import ctypes
import functools
import hashlib
import os
import shutil
import subprocess
import tempfile
import threading
import typing
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from bench.base.errors import BadLaw, BenchError
from bench.base.processes import RUNS_A_LAW
from bench.engines import cache
from bench.engines.cache import COMPILER_VARIABLE
from bench.engines.signatures import Signature
from bench.engines.typed import UNTYPED
from bench.translation.c import CONNECT, CFile
from bench.translation.kinds import INTEGER, NONE, REAL, TRUTH, Array, Kind, Pointer, Tuple, is_static, kind_of

OPTIONS = ("-std=c11", "-O2", "-ffp-contract=off", "-fPIC", "-shared", "-w")
"""Never -ffast-math, and no product is fused with a sum: results must be the plain Python call's, bit for bit."""

TRANSLATING = threading.Lock()
"""Held while a function is translated: Python 3.11 may not parse in two threads at once (SystemError: AST constructor
recursion depth mismatch). The C compiler runs without it."""

SYMBOL = "orientation_bench_entry"

MOST_KEPT = 3000
"""Libraries that are kept: those of some twenty states of the sources, 60 MB."""


@functools.cache
def compiler() -> str:
    """Return the path of the C compiler; empty if there is none, or another way is wanted."""
    wanted = os.environ.get(COMPILER_VARIABLE, "")
    if wanted == "numba":
        return ""
    names = [wanted] if wanted else ["cc", "gcc", "clang"]
    command = next((path for path in map(shutil.which, names) if path), "")
    if wanted and not command:
        raise BenchError(
            f"{COMPILER_VARIABLE}={wanted}: there is no such command; allowed: that of a C compiler, or numba"
        )
    return command


@functools.cache
def _compiler_version() -> str:
    path = Path(compiler()).resolve()
    return f"{path} {path.stat().st_size} {path.stat().st_mtime_ns}"


class LoadedCode:
    """A file of C, compiled and loaded.

    Args:
        text: The file.
        externals: Names of the functions of MuJoCo's library that it calls, in its order.
        is_kept: Whether its library may be kept for other processes, and taken from them.
    """

    def __init__(self, text: str, externals: list[str], is_kept: bool) -> None:
        self._loaded = (is_kept and _load_kept(text)) or _load_once(text)
        if externals:
            from bench.engines.native.libmujoco import library  # MuJoCo takes a moment; the ideal plants need none

            pointers = [ctypes.cast(library[name], ctypes.c_void_p) for name in externals]
            self._loaded[CONNECT]((ctypes.c_void_p * len(pointers))(*pointers))

    def __getitem__(self, symbol: str) -> Any:
        return self._loaded[symbol]

    def address(self, symbol: str) -> int:
        """Return the address of a function."""
        return ctypes.cast(self._loaded[symbol], ctypes.c_void_p).value or 0


def _load_kept(text: str) -> ctypes.CDLL | None:
    """Return the library of a text that is kept; None if it is not there and may not be put there."""
    words = repr((text, OPTIONS, _compiler_version()))
    path = cache.FOLDER / "c" / f"{hashlib.sha256(words.encode()).hexdigest()[:32]}.so"
    with contextlib.suppress(OSError):  # it is not there, or another process has just removed it
        os.utime(path)
        return ctypes.CDLL(str(path))
    if RUNS_A_LAW:
        return None
    path.parent.mkdir(parents=True, exist_ok=True)
    descriptor, temporary = tempfile.mkstemp(suffix=".part", dir=path.parent)
    os.close(descriptor)
    try:
        _compile(text, temporary)
        loaded = ctypes.CDLL(temporary)
        os.replace(temporary, path)
    finally:
        Path(temporary).unlink(missing_ok=True)
    _remove_oldest(path.parent)
    return loaded


def _load_once(text: str) -> ctypes.CDLL:
    """Return the library of a text; its file is gone as soon as it is loaded."""
    # A user's law may have removed the folder of temporary files.
    places = (place for place in (tempfile.gettempdir(), "/tmp", os.getcwd()) if os.access(place, os.W_OK))
    with tempfile.TemporaryDirectory(prefix="orientation-bench-", dir=next(places, None)) as folder:
        path = Path(folder, "law.so")
        _compile(text, str(path))
        return ctypes.CDLL(str(path))


def _remove_oldest(folder: Path) -> None:
    """Remove the libraries that were not used for longest, if there are more than MOST_KEPT."""
    with contextlib.suppress(OSError):  # other processes remove, too
        by_age = sorted(folder.iterdir(), key=lambda path: path.stat().st_mtime)
        for path in by_age[:-MOST_KEPT]:
            path.unlink()


def _compile(text: str, path: str) -> None:
    command = [compiler(), *OPTIONS, "-x", "c", "-o", path, "-", "-lm"]
    ended = subprocess.run(command, input=text, text=True, capture_output=True, check=False)
    if ended.returncode:
        raise BenchError(
            f"{compiler()} cannot compile what was translated; its headers may be missing (Debian: libc6-dev). "
            f"{COMPILER_VARIABLE}=numba compiles without it. It said: {ended.stderr[:500]}"
        )


def kind_of_hint(hint: Any) -> Kind:
    """Return the kind of an annotation: of a number, an array, or a tuple, plain or named, of such."""
    plain = {int: INTEGER, float: REAL, bool: TRUTH, None: NONE}
    if hint in plain:
        return plain[hint]
    if typing.get_origin(hint) is Annotated:
        (about,) = hint.__metadata__
        return Array(1, INTEGER) if about == "integers" else Array(about, REAL)
    if typing.get_origin(hint) is tuple:
        return Tuple(tuple(map(kind_of_hint, typing.get_args(hint))))
    hints = UNTYPED.get(hint) or typing.get_type_hints(hint, include_extras=True).values()
    return Tuple(tuple(map(kind_of_hint, hints)), hint.__name__, hint._fields)


@functools.cache
def pointer_to(signature: Signature) -> Pointer:
    """Return the kind of a function that is called by pointer."""
    return Pointer(tuple(map(kind_of_hint, signature.parameters)), kind_of_hint(signature.returns))


CTYPES = {REAL: ctypes.c_double, INTEGER: ctypes.c_int64, TRUTH: ctypes.c_int, NONE: None}


@functools.cache
def _ctype(kind: Kind) -> Any:
    """Return the type of a kind for ctypes."""
    if isinstance(kind, Pointer):
        return ctypes.c_void_p
    if isinstance(kind, Array):
        fields: list = [("at", ctypes.c_void_p), ("size", ctypes.c_int64 * kind.dimensions)]
    elif isinstance(kind, Tuple) and kind.is_even:
        fields = [("at", _ctype(kind.items[0]) * len(kind.items))]
    elif isinstance(kind, Tuple):
        there = [item for item in kind.items if not is_static(item)]
        fields = [(f"item{place}", _ctype(item)) for place, item in enumerate(there)]
    else:
        return CTYPES[str(kind)]
    return type("Structure", (ctypes.Structure,), {"_fields_": fields})


def pack(value: Any, kind: Kind) -> Any:
    """Return a value as C takes it; whoever calls keeps its arrays alive."""
    if isinstance(kind, Pointer):
        return value.address
    if isinstance(kind, Array):
        dtype = np.float64 if kind.element == REAL else np.int64
        if value.dtype != dtype or value.ndim != kind.dimensions or not value.flags.c_contiguous:
            raise TypeError(
                f"an array of {value.dtype} with {value.ndim} indices; wanted: contiguous, {dtype.__name__}, "
                f"{kind.dimensions}"
            )
        return _ctype(kind)(value.ctypes.data, (ctypes.c_int64 * kind.dimensions)(*value.shape))
    if isinstance(kind, Tuple):
        pairs = zip(value, kind.items, strict=True)
        if kind.is_even:
            items = [pack(item, its_kind) for item, its_kind in pairs]
            return _ctype(kind)((_ctype(kind.items[0]) * len(items))(*items))
        return _ctype(kind)(*(pack(item, its_kind) for item, its_kind in pairs if not is_static(its_kind)))
    return float(value) if kind == REAL else int(value)


def _leaves(value: Any, kind: Kind) -> Iterator[tuple[Any, Any]]:
    """Yield the numbers and addresses of a value, each with its type."""
    if isinstance(kind, Tuple):
        for item, its_kind in zip(value, kind.items, strict=True):
            yield from _leaves(item, its_kind)
    elif isinstance(kind, Array):
        packed = pack(value, kind)
        yield packed.at, ctypes.c_void_p
        yield from ((size, ctypes.c_int64) for size in packed.size)
    elif not is_static(kind):
        yield pack(value, kind), _ctype(kind)


def _unpack(value: Any, kind: Kind) -> Any:
    if not isinstance(kind, Tuple):
        return value
    parts = value.at if kind.is_even else (getattr(value, name) for name, _ in value._fields_)
    return tuple(_unpack(part, item) for part, item in zip(parts, kind.items, strict=True))


class CodeOfFunction:
    """A function that loops call by its address, and Python as any other.

    Attributes:
        address: Where its code is.
        pointer: The kind of a pointer to it.
    """

    def __init__(self, function: Callable, kinds: tuple[Kind, ...], is_kept: bool, needs_marks: bool = False) -> None:
        with TRANSLATING:
            file = CFile(needs_marks)
            self.pointer = file.offer_by_pointer(SYMBOL, function, kinds)
            text = file.text()
        self._library = LoadedCode(text, file.externals, is_kept)
        self.address = self._library.address(SYMBOL)

    def __call__(self, *values: Any) -> Any:
        """Call the function."""
        return self.bind(*values)()

    def bind(self, *values: Any) -> Callable[[], Any]:
        """Return a function without arguments that calls this one with these values."""
        pairs = zip(values, self.pointer.parameters, strict=True)
        leaves = [leaf for value, kind in pairs for leaf in _leaves(value, kind)]
        function = ctypes.CFUNCTYPE(_ctype(self.pointer.returns), *(ctype for _, ctype in leaves))(self.address)
        numbers = [number for number, _ in leaves]
        return lambda: _unpack(function(*numbers), self.pointer.returns)


def compile_signature(function: Callable, signature: Signature, is_users: bool) -> CodeOfFunction:
    """Return a function that loops call by pointer; a user's must be marked as a kernel, and is not kept.

    Errors:
        BadLaw: It is beyond the dialect, or returns another kind of value.
    """
    wanted = pointer_to(signature)
    code = CodeOfFunction(function, wanted.parameters, is_kept=not is_users, needs_marks=is_users)
    if code.pointer != wanted:
        raise BadLaw(f"{function.__name__} returns {code.pointer.returns}; wanted: {wanted.returns}")
    return code


class CodeOnDemand:
    """A function that is compiled when it is called first with values of some kinds, as Python takes them."""

    def __init__(self, function: Callable, is_kept: bool) -> None:
        self._function, self._is_kept = function, is_kept
        self._codes: dict[tuple[Kind, ...], CodeOfFunction] = {}

    def __call__(self, *values: Any) -> Any:
        """Call the function."""
        return self.bind(*values)()

    def bind(self, *values: Any) -> Callable[[], Any]:
        """Return a function without arguments that calls this one with these values."""
        kinds = tuple(value.pointer if isinstance(value, CodeOfFunction) else kind_of(value) for value in values)
        if kinds not in self._codes:
            self._codes[kinds] = CodeOfFunction(self._function, kinds, self._is_kept)
        return self._codes[kinds].bind(*values)


class CodeOfCallback:
    """A function that a library calls back by its `address`, with three whole numbers and an array of three."""

    def __init__(self, function: Callable) -> None:
        with TRANSLATING:
            file = CFile()
            file.offer_callback(SYMBOL, function, numbers=3, elements=3)
            text = file.text()
        self._library = LoadedCode(text, file.externals, is_kept=True)
        self.address = self._library.address(SYMBOL)


class CodeOfLoop:
    """A loop of `loop.episodes_of`: a function of Python that fills rows, without Python's lock."""

    def __init__(self, episodes: Callable, signatures: tuple[Signature, ...], hints: tuple) -> None:
        missing = [NONE] * (3 - len(signatures))
        kinds: tuple[Kind, ...] = (*map(pointer_to, signatures), *missing, *map(kind_of_hint, hints))
        with TRANSLATING:
            file = CFile()
            self._given = file.offer(SYMBOL, episodes, kinds)
            text = file.text()
        self._run = LoadedCode(text, file.externals, is_kept=True)[SYMBOL]
        self._run.restype = None

    def __call__(self, *values: Any) -> None:
        """Run the loop on the arguments of `episodes`."""
        self._run(ctypes.byref(pack(values, self._given)))
