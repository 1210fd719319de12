"""The test that goes with an export to C or C++: the vectors as rows of numbers, and a program that asks each."""

from collections.abc import Callable, Iterator, Sequence
from typing import NamedTuple

from bench.export.braces import INDENT, wrapped
from bench.export.entries import Entry, Parameter
from bench.export.subject import Subject
from bench.export.vectors import Vector

FUSED = 1e-7
"""Relative tolerance where a compiler fuses products with sums. Vectors lie as near as 1e-8 rad to 180° rotations;
some laws divide by that distance, which leaves half of the digits."""

IS_WRONG = f"""static int inexact = 0;

/* Bit for bit, or else within a tolerance: compilers that fuse products with sums change last digits. */
static int is_wrong(const double *found, const double *expected, int count, double tolerance) {{
    double size = 0.0;
    int at, is_off = 0, wrong = 0;
    for (at = 0; at < count; at++) size = fmax(size, fabs(expected[at]));
    for (at = 0; at < count; at++) {{
        if (!(fabs(found[at] - expected[at]) <= tolerance)) is_off = 1;
        if (!(fabs(found[at] - expected[at]) <= tolerance + {FUSED} * size)) wrong = 1;
    }}
    inexact += is_off && !wrong;
    return wrong;
}}
"""


class Asking(NamedTuple):
    """How a language asks an entry of a row of numbers, in lines of code.

    include: the lines before all. passed(parameter, place): the arguments that begin at a place of `row`.
    called(subject, entry, arguments): what leaves the answer in `result`. state: the type of the memory.
    reset: what resets a `state`. remembered: where the memory's numbers are.
    """

    include: tuple[str, ...]
    passed: Callable[[Parameter, int], list[str]]
    called: Callable[[Subject, Entry, list[str]], str]
    state: str
    reset: str
    remembered: str = "state.memory"


def program(subject: Subject, found: Sequence[Vector], asking: Asking) -> str:
    """A program that counts the answers that are off, and ends with 1 if there are any."""
    lines = [*asking.include, "#include <stdio.h>", "", IS_WRONG]
    for entry in subject.entries:
        lines += _of_entry(subject, entry, [one for one in found if one.entry == entry.name], asking)
    said = f'"{subject.identifier}: %d of {len(found)} vectors wrong\\n"'
    total = f"{INDENT}printf({said}, wrong);"
    fused = f'"%d answers are right to {FUSED:g} only; bit for bit: -ffp-contract=off, no -march, no -ffast-math\\n"'
    calls = (f"{INDENT}wrong += test_{one.name}();" for one in subject.entries)
    lines += [
        "int main(void) {",
        f"{INDENT}int wrong = 0;",
        *calls,
        total,
        f"{INDENT}if (inexact) printf({fused}, inexact);",
        f"{INDENT}return wrong != 0;",
        "}",
        "",
    ]
    return "\n".join(lines)


def _of_entry(subject: Subject, entry: Entry, found: Sequence[Vector], asking: Asking) -> Iterator[str]:
    """Rows of arguments, result, memory and tolerance, and a function that asks them."""
    given = sum(one.size for one in entry.parameters)
    results, kept = len(found[0].result), len(found[0].memory)
    width, deep = given + results + kept + 1, INDENT * 2
    yield f"static const double {entry.name}_rows[{len(found)}][{width}] = {{"
    for each in found:
        yield from wrapped([f"{INDENT}{{{', '.join(repr(float(value)) for value in _numbers(each))}}},"])
    yield "};\n"
    yield f"static int test_{entry.name}(void) {{"
    yield f"{INDENT}int wrong = 0, at;"
    yield f"{INDENT}for (at = 0; at < {len(found)}; at++) {{"
    yield f"{deep}const double *row = {entry.name}_rows[at], tolerance = row[{width - 1}];"
    yield f"{deep}double result[{results}];"
    passed, place = [], 0
    for one in entry.parameters:
        if one.kind == "memory":
            yield f"{deep}{asking.state} state;"
            first = " && ".join(f"row[{place + at}] == {value!r}" for at, value in enumerate(subject.memory or ()))
            parts = (f"{asking.remembered}[{at}] = is_first ? -1.0 : row[{place + at}];" for at in range(one.size))
            yield f"{deep}const int is_first = {first};"
            yield from wrapped([f"{deep}{part}" for part in parts])
            yield f"{deep}if (is_first) {asking.reset};"
        passed += asking.passed(one, place)
        place += one.size
    yield f"{deep}{asking.called(subject, entry, passed)}"
    checks = [f"is_wrong(result, row + {place}, {results}, tolerance)"]
    if kept:
        checks.append(f"is_wrong({asking.remembered}, row + {place + results}, {kept}, tolerance)")
    yield f"{deep}wrong += {' || '.join(checks)};"
    yield f"{INDENT}}}"
    yield f"{INDENT}return wrong;"
    yield "}\n"


def _numbers(one: Vector) -> Iterator[float]:
    for value in one.arguments.values():
        yield from value if isinstance(value, list) else (value,)
    yield from (*one.result, *one.memory, one.tolerance)
