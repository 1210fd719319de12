"""C99: one header of static inline functions on plain arrays, without allocation, on nothing but <math.h>."""

from collections.abc import Iterator, Sequence

from bench.export.braces import INDENT, wrapped
from bench.export.c_core import Core, comment
from bench.export.c_tests import Asking, program
from bench.export.entries import Entry, Parameter
from bench.export.heading import BY_ROWS, RESET, UNFUSED, heading
from bench.export.language import Language, as_json, readme
from bench.export.subject import MATRIX, Subject, translated
from bench.export.types import Kind, Tuple
from bench.export.vectors import Vector, vectors

RESULTS = {"command": "u", "orientation": "e", "torque": "tau", "rotation": "R"}
"""What the result of an entry is called, by the first word of its name."""

COMPILE = "cc -std=c99 -O2 -ffp-contract=off -o test_{name} test_{name}.c -lm && ./test_{name}"


def law(subject: Subject) -> tuple[str, str]:
    """The name of its header, and the header."""
    return f"{subject.identifier}.h", header(subject)


def files(subject: Subject) -> dict[str, str]:
    """The header, its test, and the vectors."""
    name, found = subject.identifier, vectors(subject)
    name_of_law, text = law(subject)
    return {
        name_of_law: text,
        f"test_{name}.c": test(subject, found),
        "vectors.json": as_json(subject, found),
        "README.md": readme(subject, LANGUAGE),
    }


def header(subject: Subject) -> str:
    """The law as one header."""
    name, done = subject.identifier, translated(subject)
    core = Core(done.program, prefix=f"{name}_core_")
    guard = f"ORIENTATION_BENCH_{name.upper()}_H"
    return "\n".join(
        (
            "/*\n"
            + "\n".join(f" * {line}".rstrip() for line in heading(subject, BY_ROWS, UNFUSED).splitlines())
            + "\n */",
            f"#ifndef {guard}\n#define {guard}\n\n#include <math.h>\n",
            core.text(),
            *(line for text in passages(subject, core).values() for line in text),
            *state(subject),
            *(f"{entry_text(subject, core, one)}\n" for one in subject.entries),
            "#endif\n",
        )
    )


def passages(subject: Subject, core: Core) -> dict[str, list[str]]:
    """By type, how its numbers are read from an array and written to one."""
    done = translated(subject)
    found: dict[str, list[str]] = {}
    for entry in subject.entries:
        function = done.entries[entry.name]
        for kind in (*function.parameters.values(), *results(entry, function.returns)):
            if isinstance(kind, Tuple) and (kind.is_numbers or kind.name == MATRIX.name):
                found.setdefault(core.kind(kind), list(_passage(core, kind)))
    return found


def _passage(core: Core, kind: Tuple) -> Iterator[str]:
    """A matrix is by rows in arrays, and by columns in ours."""
    name = core.kind(kind)
    if kind.is_numbers:
        items = [f"x[{at}]" for at in range(len(kind.items))]
        parts = [core.part(kind, "t", at) for at in range(len(kind.items))]
    else:
        column = core.kind(kind.items[0])
        items = [f"{column}_of(x[{at}], x[{at + 3}], x[{at + 6}])" for at in range(3)]
        parts = [f"{core.part(kind, 't', at)}.at[{row}]" for row in range(3) for at in range(3)]
    yield f"static inline {name} {name}_at(const double *x) {{"
    yield f"{INDENT}return {name}_of({', '.join(items)});"
    yield "}"
    yield f"static inline void {name}_to({name} t, double *x) {{"
    yield from (f"{INDENT}x[{at}] = {part};" for at, part in enumerate(parts))
    yield "}\n"


def results(entry: Entry, returns: Kind) -> tuple[Kind, ...]:
    """What an entry returns; with memory the new memory after it."""
    return returns.items if entry.has_memory and isinstance(returns, Tuple) else (returns,)


def state(subject: Subject) -> Iterator[str]:
    """What a law with memory carries from tick to tick."""
    if subject.memory is None:
        return
    name = subject.identifier
    yield "/* What the law remembers from tick to tick. */"
    yield f"typedef struct {{ double memory[{len(subject.memory)}]; }} {name}_state;\n"
    yield from comment(RESET)
    yield f"static inline void {name}_reset({name}_state *state) {{"
    yield from (f"{INDENT}state->memory[{at}] = {value!r};" for at, value in enumerate(subject.memory))
    yield "}\n"


def entry_text(subject: Subject, core: Core, entry: Entry) -> str:
    """One entry on plain arrays: NAME_ENTRY(arguments..., result)."""
    name, function = f"{subject.identifier}_{entry.name}", translated(subject).entries[entry.name]
    given, passed = [], []
    for one, kind in zip(entry.parameters, function.parameters.values(), strict=True):
        words, value = argument(subject, core.kind(kind), one)
        given += words
        passed.append(value)
    call = f"{core.function_name(function.name)}({', '.join(passed)})"
    if entry.returns == "number":
        head, body = f"static inline double {name}({', '.join(given)}) {{", [f"return {call};"]
    else:
        first, *kept = results(entry, function.returns)
        out = RESULTS.get(entry.name.partition("_")[0], "result")
        size = 9 if entry.returns == "matrix" or not isinstance(first, Tuple) else len(first.items)
        head = f"static inline void {name}({', '.join(given)}, double {out}[{size}]) {{"
        body = [f"{core.kind(first)}_to({call}, {out});"]
        if kept:
            body = [f"const {core.kind(function.returns)} answer = {call};"]
            body += [
                f"{core.kind(first)}_to(answer.item0, {out});",
                f"{core.kind(kept[0])}_to(answer.item1, state->memory);",
            ]
    return "\n".join(
        (*comment(entry.doc + rows_of(entry)), *wrapped((head, *(f"{INDENT}{line}" for line in body), "}")))
    )


def rows_of(entry: Entry) -> str:
    """Name the entry's matrices that are arrays, and say how they are stored."""
    names = [one.name for one in entry.parameters if one.size == 9] + ["R"] * (entry.returns == "matrix")
    return f"; {', '.join(names)} by rows: {names[0]}[3*i+j]" if names else ""


def argument(subject: Subject, kind: str, one: Parameter) -> tuple[list[str], str]:
    """How an argument is declared, and the value that is made of it."""
    if one.kind == "number":
        return [f"double {one.name}"], one.name
    if one.kind == "gains":
        return ["double kp", "double kv"], f"{kind}_of(kp, kv)"
    if one.kind == "memory":
        return [f"{subject.identifier}_state *state"], f"{kind}_at(state->memory)"
    return [f"const double {one.name}[{one.size}]"], f"{kind}_at({one.name})"


def passed(one: Parameter, place: int) -> list[str]:
    """How a test passes an argument that begins at a place of the row."""
    words = {"memory": ["&state"], "number": [f"row[{place}]"], "gains": [f"row[{place}]", f"row[{place + 1}]"]}
    return words.get(one.kind, [f"row + {place}"])


def called(subject: Subject, entry: Entry, given: list[str]) -> str:
    """What leaves the answer in `result`."""
    name = f"{subject.identifier}_{entry.name}"
    if entry.returns == "number":
        return f"result[0] = {name}({', '.join(given)});"
    return f"{name}({', '.join((*given, 'result'))});"


def test(subject: Subject, found: Sequence[Vector]) -> str:
    """The program that runs the vectors."""
    include = (f'#include "{subject.identifier}.h"',)
    state, reset = f"{subject.identifier}_state", f"{subject.identifier}_reset(&state)"
    return program(subject, found, Asking(include, passed, called, state, reset))


LANGUAGE = Language("c", "C99", law, files, COMPILE)
