"""The test of an export to C or C++: the vectors as rows of numbers, and a program that calls each entry with them."""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from bench.export.entries import Entry
from bench.export.layout import INDENT, read_template, wrapped
from bench.export.subject import Subject
from bench.export.vectors import CLOSE, vectors


class Calls(NamedTuple):
    """How a language calls an entry with a row of numbers.

    passed: by kind of a parameter, its arguments from place {at} of `row`. call: what leaves the answer in `result`.
    state: the type of the memory. reset: what resets `state`.
    """

    header: str
    passed: dict[str, str]
    call: Callable[[Entry, str], str]
    state: str
    reset: str


def write_program(subject: Subject, calls: Calls) -> str:
    """Write a program that counts the wrong answers, and ends with 1 if there are any."""
    functions = (line for entry in subject.entries for line in _test_entry(subject, entry, calls))
    tests = "\n".join(f"{INDENT}wrong += test_{one.name}();" for one in subject.entries)
    filled = {"NAME": subject.identifier, "COUNT": len(vectors(subject)), "CLOSE": f"{CLOSE:g}", "CALLS": tests}
    text = read_template("test.c")
    for word, value in (filled | {"FUNCTIONS": "\n".join(functions)}).items():
        text = text.replace(word, str(value))
    return f'#include "{calls.header}"\n{text}'


def _test_entry(subject: Subject, entry: Entry, calls: Calls) -> Iterator[str]:
    """Write rows of arguments, result, memory and tolerance, and a function that runs them."""
    found = [one for one in vectors(subject) if one.entry == entry.name]
    given, results = sum(one.size for one in entry.parameters), len(found[0].result)
    kept, deep = len(found[0].memory), INDENT * 2
    width = given + results + kept + 1
    yield f"static const double {entry.name}_rows[{len(found)}][{width}] = {{"
    for each in found:
        numbers = np.hstack([*each.arguments.values(), each.result, each.memory, each.tolerance]).tolist()
        yield from wrapped([f"{INDENT}{{{', '.join(map(repr, numbers))}}},"])
    yield f"}};\n\nstatic int test_{entry.name}(void) {{"
    yield f"{INDENT}int wrong = 0, at;"
    yield f"{INDENT}for (at = 0; at < {len(found)}; at++) {{"
    yield f"{deep}const double *row = {entry.name}_rows[at], tolerance = row[{width - 1}];"
    yield f"{deep}double result[{results}];"
    passed, place = [], 0
    for one in entry.parameters:
        if one.kind == "memory":  # in the vectors at 180° it is the first one: after reset
            first = " && ".join(f"row[{place + at}] == {value!r}" for at, value in enumerate(subject.memory or ()))
            yield f"{deep}const int is_first = {first};"
            yield f"{deep}{calls.state} state;"
            yield f"{deep}int k;"
            yield f"{deep}for (k = 0; k < {one.size}; k++) state.memory[k] = is_first ? -1.0 : row[{place} + k];"
            yield f"{deep}if (is_first) {calls.reset};"
        passed.append(calls.passed.get(one.kind, calls.passed[""]).format(at=place, size=one.size))
        place += one.size
    yield f"{deep}{calls.call(entry, ', '.join(passed))}"
    checks = [f"is_wrong(result, row + {place}, {results}, tolerance)"]
    if kept:
        checks.append(f"is_wrong(state.memory, row + {place + results}, {kept}, tolerance)")
    yield f"{deep}wrong += {' || '.join(checks)};\n{INDENT}}}\n{INDENT}return wrong;\n}}\n"
