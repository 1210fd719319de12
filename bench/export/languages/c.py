"""C99: one header of static inline functions on plain arrays, without allocation, on nothing but <math.h>."""

import textwrap
from collections.abc import Callable, Iterator
from typing import NamedTuple

from bench.export.entries import Entry
from bench.export.heading import BY_ROWS, RESET, UNFUSED, heading
from bench.export.language import Language, write_arguments
from bench.export.layout import fill_template
from bench.export.subject import MATRIX, Subject, translated
from bench.export.vectors import CLOSE, vectors
from bench.translation.braces import Braces
from bench.translation.inference import Typed
from bench.translation.kinds import INTEGER, REAL, TRUTH, Kind, Tuple
from bench.translation.layout import INDENT, WIDTH, wrapped

WORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
and and_eq bitand bitor bool catch class compl delete explicit export false friend mutable namespace new not
not_eq operator or or_eq private protected public template this throw true try typename using virtual xor
"""
"""Words of C and of C++, which includes the header."""


class CFunctions:
    """The functions of a subject in C, on structures; prefix: begins every name of theirs."""

    def __init__(self, subject: Subject) -> None:
        self.program, self.prefix = translated(subject), f"{subject.identifier}_core_"
        self.names: dict[Tuple, str] = {}
        for kind in self.program.tuples:
            name = f"real{len(kind.items)}" if kind.is_numbers else kind.name
            name = name or "_".join(self.kind(one).removeprefix(self.prefix) for one in kind.items)
            while f"{self.prefix}{name}" in self.names.values():
                name += "_"
            self.names[kind] = f"{self.prefix}{name}"
        self.language = Braces(
            reserved=frozenset(WORDS.split()),
            declaration=lambda kind, name, is_changed: f"{self.kind(kind)} {name}",
            built=lambda kind, items: f"{self.names[kind]}_of({', '.join(items)})",
            part=lambda kind, value, place: f"{value}.{self.item(kind, place)}",
            head=self.head,
            function_name=lambda name: f"{self.prefix}{name}",
            primitive=str,
            unused="(void){};",
        )

    def kind(self, kind: Kind) -> str:
        """Return the type of a kind."""
        plain = {REAL: "double", TRUTH: "int", INTEGER: "int"}
        return self.names[kind] if isinstance(kind, Tuple) else plain[str(kind)]

    def item(self, kind: Tuple, place: int | str) -> str:
        """Return the name of an element, or of a field."""
        return f"at[{place}]" if kind.is_numbers else (kind.fields[int(place)] if kind.fields else f"item{place}")

    def head(self, function: Typed) -> str:
        """Return the signature of a function."""
        given = (f"{self.kind(kind)} {self.language.variable(name)}" for name, kind in function.parameters.items())
        return f"static inline {self.kind(function.returns)} {self.prefix}{function.name}({', '.join(given)})"

    def structure(self, kind: Tuple) -> Iterator[str]:
        """Write a structure, what makes one, and for vectors and matrices what reads and writes arrays, by rows."""
        name, count = self.names[kind], len(kind.items)
        items = [f"x{at}" if kind.is_numbers else self.item(kind, at) for at in range(count)]
        fields = [f"{self.kind(one)} {item}" for one, item in zip(kind.items, items, strict=True)]
        held, value = f"{'; '.join(fields)};", f"{{{', '.join(items)}}}"
        yield f"typedef struct {{ {f'double at[{count}];' if kind.is_numbers else held} }} {name};"
        yield f"static inline {name} {name}_of({', '.join(fields)}) {{"
        yield f"{INDENT}{name} t = {f'{{{value}}}' if kind.is_numbers else value};"
        yield f"{INDENT}return t;\n}}"
        read, parts = [f"x[{at}]" for at in range(count)], [f"at[{at}]" for at in range(count)]
        if kind == MATRIX:
            column = self.names[MATRIX.items[0]]
            read = [f"{column}_of(x[{at}], x[{at + 3}], x[{at + 6}])" for at in range(3)]
            parts = [f"{field}.at[{row}]" for row in range(3) for field in kind.fields]
        if kind == MATRIX or kind.is_numbers:
            yield f"static inline {name} {name}_at(const double *x) {{"
            yield f"{INDENT}return {name}_of({', '.join(read)});\n}}"
            yield f"static inline void {name}_to({name} t, double *x) {{"
            yield from (f"{INDENT}x[{at}] = t.{part};" for at, part in enumerate(parts))
            yield "}"

    def text(self) -> str:
        """Write structures and functions, callees first."""
        structures = (line for kind in self.names for line in self.structure(kind))
        lines = [*wrapped(structures), ""]
        for one in self.program.functions:
            lines += (*comment(one.summary), *self.language.write(one), "")
        return "\n".join(lines)


def comment(text: str) -> list[str]:
    """Return a text as a comment before a function; no line if it is empty."""
    lines = textwrap.wrap(f"/* {text} */", WIDTH - 6, subsequent_indent="   ")
    return lines if text else []


def write_header(subject: Subject) -> str:
    """Write the law as one header."""
    name, core = subject.identifier, CFunctions(subject)
    guard = f"ORIENTATION_BENCH_{name.upper()}_H"
    about = "\n".join(f" * {line}".rstrip() for line in heading(subject, BY_ROWS, UNFUSED).splitlines())
    return "\n".join(
        (
            f"/*\n{about}\n */\n#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n",
            core.text(),
            *write_state(subject),
            *(write_entry(subject, core, one) for one in subject.entries),
            "#endif\n",
        )
    )


def write_state(subject: Subject) -> Iterator[str]:
    """Write the type of a memory, and its reset."""
    if subject.memory is not None:
        name, kept = subject.identifier, subject.memory_name
        yield "/* What the law remembers from tick to tick. */"
        yield f"typedef struct {{ double {kept}[{len(subject.memory)}]; }} {name}_state;\n"
        yield from comment(RESET)
        yield f"static inline void {name}_reset({name}_state *state) {{"
        yield from (f"{INDENT}state->{kept}[{at}] = {value!r};" for at, value in enumerate(subject.memory))
        yield "}\n"


def write_entry(subject: Subject, core: CFunctions, entry: Entry) -> str:
    """Write one entry on plain arrays: NAME_ENTRY(arguments..., result)."""
    name, function = f"{subject.identifier}_{entry.name}", translated(subject).entries[entry.name]
    declared = {
        "number": "double {name}",
        "gains": "double kp, double kv",
        "tuning": "double kp, double kv, double bound, double delay",
        "memory": f"{subject.identifier}_state *state",
        "": "const double {name}[{size}]",
    }
    passed = {"number": "{name}", "gains": f"{core.prefix}Gains_of(kp, kv)"}
    passed["tuning"] = f"{core.prefix}Tuning_of(kp, kv, bound, delay)"
    passed["memory"] = f"{core.prefix}real{len(subject.memory or ())}_at(state->{subject.memory_name})"
    passed |= {"matrix": f"{core.prefix}Rotation_at({{name}})", "": f"{core.prefix}real{{size}}_at({{name}})"}
    given, arguments = write_arguments(entry, declared, passed)
    call, (out, kind, size) = f"{core.prefix}{function.name}({arguments})", entry.returns
    head = f"static inline void {name}({given}, double {out}[{size}]) {{"
    stored = f"{core.prefix}{'Rotation' if kind == 'matrix' else f'real{size}'}_to({{}}, {out});"
    body = [stored.format(call)]
    if kind == "number":
        head, body = f"static inline double {name}({given}) {{", [f"return {call};"]
    if entry.has_memory:
        body = [f"const {core.kind(function.returns)} answer = {call};", stored.format("answer.item0")]
        body.append(f"{passed['memory'].partition('_at')[0]}_to(answer.item1, state->{subject.memory_name});")
    return "\n".join((*comment(entry.about), *wrapped((head, *(f"{INDENT}{line}" for line in body), "}", ""))))


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
    functions = "\n".join(line for entry in subject.entries for line in _test_entry(subject, entry, calls))
    tests = "\n".join(f"{INDENT}wrong += test_{one.name}();" for one in subject.entries)
    filled = {"NAME": subject.identifier, "COUNT": len(vectors(subject)), "CLOSE": f"{CLOSE:g}", "CALLS": tests}
    return f'#include "{calls.header}"\n' + fill_template("test.c", **filled, FUNCTIONS=functions)


def _test_entry(subject: Subject, entry: Entry, calls: Calls) -> Iterator[str]:
    """Write rows of arguments, result, memory and tolerance, and a function that runs them."""
    found = [one for one in vectors(subject) if one.entry == entry.name]
    given, results, kept = entry.width, len(found[0].result), len(found[0].memory)
    width, deep = given + results + kept + 1, INDENT * 2
    yield f"static const double {entry.name}_rows[{len(found)}][{width}] = {{"
    for each in found:
        yield from wrapped([f"{INDENT}{{{', '.join(map(repr, each.row))}}},"])
    yield f"}};\n\nstatic int test_{entry.name}(void) {{"
    yield f"{INDENT}int wrong = 0, at;"
    yield f"{INDENT}for (at = 0; at < {len(found)}; at++) {{"
    yield f"{deep}const double *row = {entry.name}_rows[at], tolerance = row[{width - 1}];"
    yield f"{deep}double result[{results}];"
    checks = [f"is_wrong(result, row + {given}, {results}, tolerance)"]
    if kept:  # in the vectors at 180° the memory is the first one: after reset
        name, place = subject.memory_name, given - kept
        first = " && ".join(f"row[{place + at}] == {value!r}" for at, value in enumerate(subject.memory or ()))
        yield f"{deep}const int is_first = {first};"
        yield f"{deep}{calls.state} state;"
        yield f"{deep}int k;"
        yield f"{deep}for (k = 0; k < {kept}; k++) state.{name}[k] = is_first ? -1.0 : row[{place} + k];"
        yield f"{deep}if (is_first) {calls.reset};"
        checks.append(f"is_wrong(state.{name}, row + {given + results}, {kept}, tolerance)")
    yield f"{deep}{calls.call(entry, *write_arguments(entry, calls.passed))}"
    yield f"{deep}wrong += {' || '.join(checks)};\n{INDENT}}}\n{INDENT}return wrong;\n}}\n"


OF_ROW = {
    "gains": "row[{at}], row[{at} + 1]",
    "tuning": "row[{at}], row[{at} + 1], row[{at} + 2], row[{at} + 3]",
}
"""Gains, and gains with limits, from place {at} of a row."""


def write_test(subject: Subject) -> str:
    """Write the program that runs the vectors."""
    name = subject.identifier
    passed = {"memory": "&state", "number": "row[{at}]", **OF_ROW, "": "row + {at}"}

    def call(entry: Entry, arguments: str) -> str:
        if entry.returns.kind == "number":
            return f"result[0] = {name}_{entry.name}({arguments});"
        return f"{name}_{entry.name}({arguments}, result);"

    return write_program(subject, Calls(f"{name}.h", passed, call, f"{name}_state", f"{name}_reset(&state)"))


COMPILE = "cc -std=c99 -O2 -ffp-contract=off -o test_{name} test_{name}.c -lm && ./test_{name}"
LANGUAGE = Language("c", "C99", ("{name}.h", "test_{name}.c"), write_header, write_test, COMPILE)
