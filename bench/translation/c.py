"""C of programs in the dialect of the loops: one file of static functions, and the functions that a caller finds in it.

A tuple is a structure, an array a structure of its address and its sizes. A function that is called by pointer takes
numbers and addresses only, the parts of its tuples and arrays one by one: compilers pass a structure of many words in
memory, and a tick would take up to twice the time.
"""

import ast
import math
from collections.abc import Callable, Iterator
from typing import Any

from bench.translation.braces import Braces
from bench.translation.dialect import LOOPS
from bench.translation.inference import Typed
from bench.translation.kinds import (
    INTEGER,
    NONE,
    REAL,
    TRUTH,
    Array,
    External,
    Kind,
    Pointer,
    Tuple,
    is_static,
)
from bench.translation.loop_syntax import LoopSyntax
from bench.translation.order import holds_array
from bench.translation.program import Program

CONNECT = "orientation_bench_connect"
"""The function of a file that takes the addresses of the functions of libraries."""

TYPES = {REAL: "double", TRUTH: "int", INTEGER: "int64_t", NONE: "void"}

WORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long register
restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
floor_div floor_mod square handler NAN INFINITY
"""
"""Names that a variable cannot have."""

HEAD = """#include <math.h>
#include <setjmp.h>
#include <stdint.h>
#include <stdlib.h>

static inline int64_t floor_div(int64_t a, int64_t b) {
    int64_t q = a / b;
    return q - (a % b != 0 && (a < 0) != (b < 0));
}
static inline int64_t floor_mod(int64_t a, int64_t b) {
    int64_t r = a % b;
    return r != 0 && (r < 0) != (b < 0) ? r + b : r;
}
static _Thread_local jmp_buf *handler;
static _Noreturn void raise_error(void) {
    if (!handler) abort();
    longjmp(*handler, 1);
}
static inline double square(double x) { return x * x; }
/* Python's min and max: the first of two that do not compare, as a number and a NaN. */
static inline double min_real(double a, double b) { return b < a ? b : a; }
static inline double max_real(double a, double b) { return b > a ? b : a; }
static inline int64_t min_integer(int64_t a, int64_t b) { return b < a ? b : a; }
static inline int64_t max_integer(int64_t a, int64_t b) { return b > a ? b : a; }
"""


GUARD = (
    "{{ jmp_buf here_{0}, *outer_{0} = handler; handler = &here_{0}; if (setjmp(here_{0}) == 0) {{",
    "handler = outer_{0};",
    "}} else {{ handler = outer_{0};",
    "}} }}",
)
"""A guard is where an error in a function of a user's law leads to."""


INLINED = "__attribute__((always_inline)) "
"""Functions that are given arrays are always inlined: a call hands on an address and sizes of each, and a controller of
an arm took up to twice the time."""


class CFile:
    """One file of C.

    Args:
        needs_marks: Whether functions of files that are not ours must be marked as kernels, as in a user's law.
    """

    def __init__(self, needs_marks: bool = False) -> None:
        self.program = Program(LOOPS, needs_marks)
        self._types: dict[Kind, str] = {}
        self._declarations: list[str] = []
        self.externals: list[str] = []
        self._found: list[Callable[[], Iterator[str]]] = []
        self._language = Braces(
            reserved=frozenset(WORDS.split()),
            declaration=lambda kind, name, is_changed: f"{self.type(kind)} {name}",
            built=self._built,
            part=lambda kind, value, place: f"{value}.{_item(kind, place)}",
            head=self._head,
            function_name=lambda name: f"fn_{name}",
            primitive=str,
            loops=LoopSyntax(
                element=lambda kind, array, indices: f"{array}.at[{_offset(array, indices)}]",
                view=self._view,
                size=lambda array, place: f"{array}.size[{place}]",
                by_pointer=self._call_by_pointer,
                external=self._call_of_library,
                address="(int64_t){}.at",
                operations={
                    ast.FloorDiv: "floor_div({}, {})",
                    ast.Mod: "floor_mod({}, {})",
                    ast.Pow: "square({0})",
                    ast.Div: "((double)({}) / (double)({}))",
                },
                builtin=_builtin,
                constant=_constant,
                error="raise_error()",
                guard=GUARD,
            ),
        )

    def type(self, kind: Kind) -> str:
        """Return the type of a kind, declared."""
        if isinstance(kind, str):
            return TYPES[kind]
        if kind not in self._types:
            self._types[kind] = self._declare(kind)
        return self._types[kind]

    def _declare(self, kind: Kind) -> str:
        if isinstance(kind, Tuple):
            return self._structure(kind)
        if isinstance(kind, Array):
            return self._array(kind)
        assert isinstance(kind, Pointer), kind
        return self._pointer(kind)

    def _structure(self, kind: Tuple) -> str:
        if kind.is_even:
            fields = f"{self.type(kind.items[0])} at[{len(kind.items)}];"
        else:
            places = [place for place, item in enumerate(kind.items) if not is_static(item)]
            fields = " ".join(f"{self.type(kind.items[place])} {_item(kind, place)};" for place in places)
        name = self.program.name(kind.name or f"items{len(kind.items)}")
        self._declarations.append(f"typedef struct {{ {fields} }} {name};")
        return name

    def _array(self, kind: Array) -> str:
        name = self.program.name(f"array{kind.dimensions}_{kind.element}")
        held = f"{self.type(kind.element)} *at; int64_t size[{kind.dimensions}];"
        self._declarations.append(f"typedef struct {{ {held} }} {name};")
        return name

    def _pointer(self, kind: Pointer) -> str:
        """Declare the type of a pointer, and what calls it with tuples and arrays taken apart."""
        there = {f"x{place}": one for place, one in enumerate(kind.parameters) if not is_static(one)}
        leaves = [leaf for name, one in there.items() for leaf in self._leaves(name, one)]
        types = ", ".join(type_ for _, type_ in leaves)
        given = ", ".join(f"{self.type(one)} {name}" for name, one in there.items())
        returns, name = self.type(kind.returns), self.program.name("pointer")
        self._declarations += [
            f"typedef {returns} (*{name})({types});",
            f"static inline {returns} call_{name}({name} function, {given}) {{",
            f"    return function({', '.join(text for text, _ in leaves)});\n}}",
        ]
        return name

    def _leaves(self, text: str, kind: Kind) -> Iterator[tuple[str, str]]:
        """Yield the numbers and addresses of a value, and the type of each."""
        if isinstance(kind, Tuple):
            for place, item in enumerate(kind.items):
                yield from self._leaves(f"{text}.{_item(kind, place)}", item)
        elif isinstance(kind, Array):
            yield f"{text}.at", f"{self.type(kind.element)} *"
            yield from ((f"{text}.size[{place}]", "int64_t") for place in range(kind.dimensions))
        elif not is_static(kind):
            yield text, self.type(kind)

    def _from_leaves(self, kind: Kind, names: Iterator[str]) -> str:
        """Write a value of its numbers and addresses, which have these names."""
        if isinstance(kind, Tuple):
            items = [self._from_leaves(item, names) for item in kind.items if not is_static(item)]
            return self._built(kind, items)
        if isinstance(kind, Array):
            address = next(names)
            sizes = ", ".join(next(names) for _ in range(kind.dimensions))
            return f"({self.type(kind)}){{{address}, {{{sizes}}}}}"
        return next(names)

    def _built(self, kind: Tuple, items: list[str]) -> str:
        held = ", ".join(items)
        return f"({self.type(kind)}){{{{{held}}}}}" if kind.is_even else f"({self.type(kind)}){{{held}}}"

    def _view(self, kind: Array, array: str, indices: list[str], lower: str, upper: str) -> str:
        """Write a part of an array; of the first index that is not given from lower to upper."""
        view = Array(kind.dimensions - len(indices), kind.element)
        start = lower
        if indices:
            start = f"({_offset(array, indices)}) * {array}.size[{len(indices)}]"
            start += f" + {lower}" if lower != "0" else ""
        for place in range(len(indices) + 1, kind.dimensions):
            start = f"({start}) * {array}.size[{place}]"
        sizes = [f"{upper} - {lower}" if lower != "0" else upper]
        sizes += [f"{array}.size[{place}]" for place in range(len(indices) + 1, kind.dimensions)]
        return f"({self.type(view)}){{{array}.at + {start}, {{{', '.join(sizes)}}}}}"

    def _call_by_pointer(self, kind: Pointer, function: str, arguments: list[str]) -> str:
        return f"call_{self.type(kind)}({', '.join([function, *arguments])})"

    def _call_of_library(self, function: External, arguments: list[str]) -> str:
        if function.name not in self.externals:
            self.externals.append(function.name)
        returns = "void" if function.returns == NONE else "int"
        types = ", ".join(["int64_t"] * len(arguments))
        return f"(({returns} (*)({types}))in_library_{function.name})({', '.join(arguments)})"

    def _head(self, function: Typed) -> str:
        there = {name: kind for name, kind in function.parameters.items() if not is_static(kind)}
        given = ", ".join(f"{self.type(kind)} {self._language.variable(name)}" for name, kind in there.items())
        returns = "void" if is_static(function.returns) else self.type(function.returns)
        inlined = INLINED if any(map(holds_array, there.values())) else ""
        return f"static inline {inlined}{returns} fn_{function.name}({given or 'void'})"

    def offer(self, symbol: str, function: Callable, kinds: tuple[Kind, ...]) -> Tuple:
        """Add a function that Python calls by its symbol, on the address of a structure of its arguments.

        Return the kind of that structure.
        """
        typed = self.program.add(function, kinds)
        given = Tuple(kinds, "Arguments", tuple(f"x{place}" for place in range(len(kinds))))

        def write() -> Iterator[str]:
            there = [place for place, kind in enumerate(kinds) if not is_static(kind)]
            parts = ", ".join(f"given->{_item(given, place)}" for place in there)
            yield f"void {symbol}(const {self.type(given)} *given) {{ fn_{typed.name}({parts}); }}"

        self._found.append(write)
        return given

    def offer_by_pointer(self, symbol: str, function: Callable, parameters: tuple[Kind, ...]) -> Pointer:
        """Add a function that loops call by pointer, and return the kind of that; `symbol` is its address."""
        typed = self.program.add(function, parameters)
        pointer = Pointer(parameters, typed.returns)

        def write() -> Iterator[str]:
            there = [kind for kind in pointer.parameters if not is_static(kind)]
            types = [type_ for kind in there for _, type_ in self._leaves("", kind)]
            names = [f"x{place}" for place in range(len(types))]
            given = ", ".join(f"{type_} {name}" for type_, name in zip(types, names, strict=True))
            waiting = iter(names)
            parts = [self._from_leaves(kind, waiting) for kind in there]
            call = f"fn_{typed.name}({', '.join(parts)})"
            if typed.identity:
                call = parts[list(typed.parameters).index(typed.identity)]
            yield f"{self.type(pointer.returns)} {symbol}({given}) {{ return {call}; }}"

        self._found.append(write)
        return pointer

    def offer_callback(self, symbol: str, function: Callable, numbers: int, elements: int) -> None:
        """Add a function that a library calls back.

        It gets so many whole numbers, and last the address of an array of so many.
        """
        typed = self.program.add(function, (*[INTEGER] * numbers, Array(1, INTEGER)))

        def write() -> Iterator[str]:
            names = [f"x{place}" for place in range(numbers)]
            given = ", ".join(f"int64_t {name}" for name in names)
            array = f"({self.type(Array(1, INTEGER))}){{at, {{{elements}}}}}"
            yield f"void {symbol}({given}, int64_t *at) {{ fn_{typed.name}({', '.join([*names, array])}); }}"

        self._found.append(write)

    def text(self) -> str:
        """Write the file."""
        body = [line for one in self.program.functions for line in self._language.write(one)]
        body += [line for write in self._found for line in write()]
        return "\n".join([HEAD, *self._declarations, *self._connection(), "", *body, ""])

    def _connection(self) -> Iterator[str]:
        """Write what takes the addresses of the functions of libraries, in the order of `externals`."""
        yield from (f"static void *in_library_{name};" for name in self.externals)
        stored = (f"    in_library_{name} = addresses[{at}];" for at, name in enumerate(self.externals))
        yield "\n".join((f"void {CONNECT}(void *const *addresses) {{", *stored, "}"))


def _item(kind: Tuple, place: int | str) -> str:
    """Return the name of an item of a structure."""
    if kind.is_even:
        return f"at[{place}]"
    return f"{kind.fields[int(place)]}_" if kind.fields else f"item{place}"


def _offset(array: str, indices: list[str]) -> str:
    """Write where an element, or a row, lies in an array."""
    offset = indices[0]
    for place, index in enumerate(indices[1:], start=1):
        offset = f"({offset}) * {array}.size[{place}] + {index}"
    return offset


def _builtin(name: str, kind: Kind, arguments: list[str]) -> str:
    """Write min, max, abs, or a conversion."""
    if name in ("float", "int"):
        return f"({'double' if name == 'float' else 'int64_t'})({arguments[0]})"
    if name == "bool":
        return f"({arguments[0]} != 0)"
    if name == "abs":
        return f"{'fabs' if kind == REAL else 'llabs'}({arguments[0]})"
    text = arguments[0]
    for argument in arguments[1:]:
        text = f"{name}_{'real' if kind == REAL else 'integer'}({text}, {argument})"
    return text


def _constant(value: Any, kind: Kind) -> str:
    """Write a number or a truth value; a number reads back as the same bits."""
    if kind != REAL:
        return str(int(value))
    number = float(value)
    if math.isnan(number):
        return "NAN"
    if math.isinf(number):
        return "INFINITY" if number > 0 else "-INFINITY"
    return repr(number)
