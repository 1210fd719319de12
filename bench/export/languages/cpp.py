"""C++17: one header in a namespace, on Eigen's types, around the same core as C."""

from collections.abc import Iterator, Sequence

from bench.export.braces import INDENT, wrapped
from bench.export.c_core import Core, comment
from bench.export.c_tests import Asking, program
from bench.export.entries import Entry, Parameter
from bench.export.heading import RESET, UNFUSED, heading
from bench.export.language import Language, as_json, readme
from bench.export.subject import MATRIX, Subject, translated
from bench.export.types import Kind, Tuple
from bench.export.vectors import Vector, vectors
from bench.law.scalar import PRIMITIVES

COMPILE = (
    "c++ -std=c++17 -O2 -ffp-contract=off $(pkg-config --cflags eigen3 || echo -I/usr/include/eigen3) "
    "-o test_{name} test_{name}.cpp && ./test_{name}"
)

USED = "\n".join(f"using std::{one.__name__};" for one in PRIMITIVES)

READING = """
inline core::Rotation at(const Eigen::Matrix3d &R) {
    return core::Rotation_of(core::real3_of(R(0, 0), R(1, 0), R(2, 0)), core::real3_of(R(0, 1), R(1, 1), R(2, 1)),
                             core::real3_of(R(0, 2), R(1, 2), R(2, 2)));
}
inline Eigen::Matrix3d matrix(const core::Rotation &R) {
    Eigen::Matrix3d m;
    for (int i = 0; i < 3; i++) m.row(i) << R.n.at[i], R.o.at[i], R.a.at[i];
    return m;
}
"""


def law(subject: Subject) -> tuple[str, str]:
    """The name of its header, and the header."""
    return f"{subject.identifier}.hpp", header(subject)


def files(subject: Subject) -> dict[str, str]:
    """The header, its test, and the vectors."""
    name, found = subject.identifier, vectors(subject)
    name_of_law, text = law(subject)
    return {
        name_of_law: text,
        f"test_{name}.cpp": test(subject, found),
        "vectors.json": as_json(subject, found),
        "README.md": readme(subject, LANGUAGE),
    }


def header(subject: Subject) -> str:
    """The law as one header."""
    name, core = subject.identifier, Core(translated(subject).program)
    guard = f"ORIENTATION_BENCH_{name.upper()}_HPP"
    return "\n".join(
        (
            "\n".join(f"// {line}".rstrip() for line in heading(subject, UNFUSED).splitlines()),
            f"#ifndef {guard}\n#define {guard}\n\n#include <cmath>\n\n#include <Eigen/Geometry>\n",
            f"namespace orientation_bench::{name} {{\n\nnamespace core {{\n\n{USED}\n",
            f"{core.text()}\n}}  // namespace core",
            READING if MATRIX in core.names else "",
            *(line for size in sizes(subject, core) for line in vector_passage(size)),
            *state(subject),
            *(f"{entry_text(subject, core, one)}\n" for one in subject.entries),
            f"}}  // namespace orientation_bench::{name}\n\n#endif\n",
        )
    )


def sizes(subject: Subject, core: Core) -> list[int]:
    """Lengths of the tuples of numbers that entries take or return, matrices by rows apart."""
    return sorted(len(kind.items) for kind in core.names if kind.is_numbers and len(kind.items) in (3, 4))


def vector_passage(size: int) -> Iterator[str]:
    """A vector of so many numbers in and out."""
    real, parts = f"core::real{size}", range(size)
    yield f"inline {real} at(const Eigen::Vector{size}d &v) {{"
    yield f"{INDENT}return {real}_of({', '.join(f'v({at})' for at in parts)});"
    yield "}"
    yield f"inline Eigen::Vector{size}d vector(const {real} &v) {{"
    yield f"{INDENT}return Eigen::Vector{size}d({', '.join(f'v.at[{at}]' for at in parts)});"
    yield "}\n"


def state(subject: Subject) -> Iterator[str]:
    """What a law with memory carries from tick to tick."""
    if subject.memory is not None:
        first = ", ".join(map(repr, subject.memory))
        real = f"core::real{len(subject.memory)}"
        about = "\n".join(f"{INDENT}{line}" for line in slashes(RESET))
        yield "// What the law remembers from tick to tick."
        yield f"struct State {{\n{INDENT}{real} memory = {real}_of({first});\n"
        yield f"{about}\n{INDENT}void reset() {{ *this = State(); }}\n}};\n"


def entry_text(subject: Subject, core: Core, entry: Entry) -> str:
    """One entry on Eigen's types; of quaternions in the order w, x, y, z one on Eigen's own type too."""
    made = [_function(subject, core, entry, quaternion=False)]
    if entry.name.endswith("_wxyz"):
        made.append(_function(subject, core, entry, quaternion=True))
    return "\n".join(made)


def _function(subject: Subject, core: Core, entry: Entry, quaternion: bool) -> str:
    function = translated(subject).entries[entry.name]
    given, passed = [], []
    for one in entry.parameters:
        words, value = argument(one, quaternion)
        given += words
        passed.append(value)
    call = f"core::{function.name}({', '.join(passed)})"
    name = entry.name.removesuffix("_wxyz") if quaternion else entry.name
    first = function.returns.items[0] if entry.has_memory and isinstance(function.returns, Tuple) else function.returns
    head = f"inline {result_type(entry, first)} {name}({', '.join(given)}) {{"
    body = [f"return {result(entry, call)};"]
    if entry.has_memory:
        body = [
            f"const auto answer = {call};",
            "state.memory = answer.item1;",
            f"return {result(entry, 'answer.item0')};",
        ]
    return "\n".join((*slashes(entry.doc), *wrapped((head, *(f"{INDENT}{line}" for line in body), "}"))))


def slashes(text: str) -> list[str]:
    """A comment in the manner of C++."""
    return [one.replace("/* ", "// ").replace(" */", "").replace("   ", "// ") for one in comment(text)]


def argument(one: Parameter, quaternion: bool) -> tuple[list[str], str]:
    """How an argument is declared, and the value that is made of it."""
    if one.kind == "number":
        return [f"double {one.name}"], one.name
    if one.kind == "gains":
        return ["double kp", "double kv"], "core::Gains_of(kp, kv)"
    if one.kind == "memory":
        return ["State &state"], "state.memory"
    if one.kind == "tuple" and one.size == 9:  # a matrix, by rows
        items = ", ".join(f"{one.name}({row}, {column})" for row in range(3) for column in range(3))
        return [f"const Eigen::Matrix3d &{one.name}"], f"core::real9_of({items})"
    if quaternion and one.name.startswith("quat"):
        name = one.name.removesuffix("_wxyz").replace("quat", "q")
        return [f"const Eigen::Quaterniond &{name}"], f"core::real4_of({name}.w(), {name}.x(), {name}.y(), {name}.z())"
    kind = "Matrix3d" if one.kind == "matrix" else f"Vector{one.size}d"
    return [f"const Eigen::{kind} &{one.name}"], f"at({one.name})"


def result_type(entry: Entry, kind: Kind) -> str:
    """Of what an entry returns."""
    if not isinstance(kind, Tuple):
        return "double"
    return "Eigen::Matrix3d" if entry.returns == "matrix" else f"Eigen::Vector{len(kind.items)}d"


def result(entry: Entry, value: str) -> str:
    """An answer of the core as Eigen's type."""
    return {"number": value, "matrix": f"matrix({value})"}.get(entry.returns, f"vector({value})")


def passed(one: Parameter, place: int) -> list[str]:
    """How a test passes an argument that begins at a place of the row."""
    words = {"memory": ["state"], "number": [f"row[{place}]"], "gains": [f"row[{place}]", f"row[{place + 1}]"]}
    matrix = f"Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(row + {place})"
    vector = f"Eigen::Map<const Eigen::Vector{one.size}d>(row + {place})"
    return words.get(one.kind, [matrix if one.size == 9 else vector])


def called(subject: Subject, entry: Entry, given: list[str]) -> str:
    """What leaves the answer in `result`."""
    call = f"orientation_bench::{subject.identifier}::{entry.name}({', '.join(given)})"
    if entry.returns == "number":
        return f"result[0] = {call};"
    if entry.returns == "matrix":
        return f"Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{{result}} = {call};"
    kind = translated(subject).entries[entry.name].returns
    kind = kind.items[0] if entry.has_memory and isinstance(kind, Tuple) else kind
    size = len(kind.items) if isinstance(kind, Tuple) else 1
    return f"Eigen::Map<Eigen::Vector{size}d>{{result}} = {call};"


def test(subject: Subject, found: Sequence[Vector]) -> str:
    """The program that runs the vectors."""
    include = (f'#include "{subject.identifier}.hpp"',)
    state = f"orientation_bench::{subject.identifier}::State"
    asking = Asking(include, passed, called, state, "state.reset()", "state.memory.at")
    return program(subject, found, asking)


LANGUAGE = Language("cpp", "C++17 on Eigen", law, files, COMPILE)
