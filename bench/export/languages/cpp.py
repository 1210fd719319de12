"""C++17: Eigen's types around the header in C."""

from collections.abc import Iterator

from bench.export.entries import Entry
from bench.export.heading import RESET, UNFUSED, heading
from bench.export.language import Language, write_arguments
from bench.export.languages import c
from bench.export.layout import slashes
from bench.export.subject import Subject
from bench.translation.layout import INDENT, wrapped

ROWS = "Eigen::Matrix<double, 3, 3, Eigen::RowMajor>"
DECLARED = {
    "number": "double {name}",
    "gains": "double kp, double kv",
    "tuning": "double kp, double kv, double bound, double delay",
    "memory": "State &state",
    "matrix": "const Rows &{name}",
    "rows": "const Rows &{name}",
    "": "const Eigen::Vector{size}d &{name}",
}
PASSED = {
    "number": "{name}",
    "gains": "kp, kv",
    "tuning": "kp, kv, bound, delay",
    "memory": "&state",
    "": "{name}.data()",
}


def write_header(subject: Subject) -> str:
    """Write the header around the one in C."""
    name = subject.identifier
    around = f"Needs     {name}.h beside it, and Eigen. Rows: a matrix by rows; any other matrix or expression converts"
    guard = f"ORIENTATION_BENCH_{name.upper()}_HPP"
    return "\n".join(
        (
            *(f"// {line}".rstrip() for line in heading(subject, around, UNFUSED).splitlines()),
            f'#ifndef {guard}\n#define {guard}\n\n#include <Eigen/Core>\n\n#include "{name}.h"\n',
            f"namespace orientation_bench::{name} {{\n\nusing Rows = {ROWS};\n",
            *write_state(subject),
            *(line for one in subject.entries for line in write_entry(subject, one)),
            f"}}  // namespace orientation_bench::{name}\n\n#endif\n",
        )
    )


def write_state(subject: Subject) -> Iterator[str]:
    """Write the type of a memory."""
    if subject.memory is not None:
        name = subject.identifier
        yield "// What the law remembers from tick to tick."
        yield from slashes(RESET)
        yield f"struct State : {name}_state {{\n{INDENT}State() {{ reset(); }}"
        yield f"{INDENT}void reset() {{ {name}_reset(this); }}\n}};\n"


def write_entry(subject: Subject, entry: Entry) -> Iterator[str]:
    """Write one entry on Eigen's types."""
    given, arguments = write_arguments(entry, DECLARED, PASSED)
    name = f"{subject.identifier}_{entry.name}"
    out, kind, size = entry.returns
    returned = {"number": "double", "matrix": "Eigen::Matrix3d"}.get(kind, f"Eigen::Vector{size}d")
    body = [f"return {name}({arguments});"]
    if kind != "number":
        held = "Rows" if kind == "matrix" else returned
        body = [f"{held} {out};", f"{name}({arguments}, {out}.data());", f"return {out};"]
    yield from slashes(entry.doc)
    head = f"inline {returned} {entry.name}({given}) {{"
    yield from wrapped((head, *(f"{INDENT}{line}" for line in body), "}\n"))


def write_test(subject: Subject) -> str:
    """Write the program that runs the vectors."""
    name = f"orientation_bench::{subject.identifier}"
    rows = f"Eigen::Map<const {ROWS}>(row + {{at}})"
    passed = {
        "memory": "state",
        "number": "row[{at}]",
        **c.OF_ROW,
        "matrix": rows,
        "rows": rows,
        "": "Eigen::Map<const Eigen::Vector{size}d>(row + {at})",
    }

    def call(entry: Entry, arguments: str) -> str:
        held = ROWS if entry.returns.kind == "matrix" else f"Eigen::Vector{entry.returns.size}d"
        found = "result[0]" if entry.returns.kind == "number" else f"Eigen::Map<{held}>{{result}}"
        return f"{found} = {name}::{entry.name}({arguments});"

    return c.write_program(
        subject, c.Calls(f"{subject.identifier}.hpp", passed, call, f"{name}::State", "state.reset()")
    )


COMPILE = (
    "c++ -std=c++17 -O2 -ffp-contract=off "
    "$(pkg-config --cflags eigen3 2>/dev/null || echo -I/usr/include/eigen3) "
    "-o test_{name} test_{name}.cpp && ./test_{name}"
)
FILES = "{name}.hpp", "test_{name}.cpp"
LANGUAGE = Language("cpp", "C++17 on Eigen", FILES, write_header, write_test, COMPILE, beside=c.LANGUAGE.law)
