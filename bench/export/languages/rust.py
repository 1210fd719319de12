"""Rust: one crate without std, allocation or unsafe code, on nothing but libm, in f64 and f32, and with nalgebra."""

import re
import textwrap
import tomllib
from collections.abc import Iterator

from bench.export.entries import Entry
from bench.export.heading import BY_ROWS, PROJECT, RESET, heading
from bench.export.language import Language, write_arguments
from bench.export.layout import fill_template, slashes
from bench.export.subject import Subject, translated
from bench.export.vectors import vectors
from bench.translation.braces import Braces, count_assignments
from bench.translation.inference import Typed
from bench.translation.kinds import INTEGER, REAL, TRUTH, Kind, Tuple
from bench.translation.layout import INDENT, WIDTH, wrapped

WORDS = """
abstract as async await become box break const continue crate do dyn else enum extern false final fn for gen if impl in
let loop macro match mod move mut override priv pub ref return self static struct super trait true try type typeof
union unsafe unsized use virtual where while yield
"""
Form = dict[str, dict[str, str]]
PRECISION = (
    "Precision modules double (f64) and single (f32); double is equal to the test vectors bit for bit where the law "
    "takes sums, products, quotients and roots alone"
)


FORMS = tomllib.loads(fill_template("rust.toml"))
ON_ARRAYS: Form = FORMS["arrays"]
ON_NALGEBRA: Form = {part: given | FORMS["nalgebra"][part] for part, given in ON_ARRAYS.items()}


class RustFunctions:
    """The functions of a subject in Rust."""

    def __init__(self, subject: Subject) -> None:
        self.program = translated(subject)
        self.names: dict[Tuple, str] = {}
        for kind in (one for one in self.program.tuples if one.name):
            self.names[kind] = kind.name + "_" * (kind.name in self.names.values())
        self.language = Braces(
            reserved=frozenset(WORDS.split()),
            declaration=lambda kind, name, is_changed: f"let {'mut ' * is_changed}{name}: {self.kind(kind)}",
            built=self.built,
            part=lambda kind, value, place: value + self.part(kind, place),
            head=self.head,
            function_name=str,
            primitive=lambda name: f"Math::{name}",
            condition="{}",
            choice="if {} {{ {} }} else {{ {} }}",
            loop="for {name} in {first}..{last}",
            last="{}",
            unused="let _ = {};",
        )

    def kind(self, kind: Kind) -> str:
        """Return the type of a kind."""
        if not isinstance(kind, Tuple):
            return {REAL: "Real", TRUTH: "bool", INTEGER: "usize"}[str(kind)]
        if kind.is_numbers:
            return f"[Real; {len(kind.items)}]"
        return self.names.get(kind) or f"({', '.join(map(self.kind, kind.items))})"

    def built(self, kind: Tuple, items: list[str]) -> str:
        """Write a tuple of items."""
        if not kind.name:
            return f"[{', '.join(items)}]" if kind.is_numbers else f"({', '.join(items)})"
        fields = (one if one == name else f"{name}: {one}" for name, one in zip(kind.fields, items, strict=True))
        return f"{self.names[kind]} {{ {', '.join(fields)} }}"

    def part(self, kind: Tuple, place: int | str) -> str:
        """Write what takes an item of a tuple."""
        return f"[{place}]" if kind.is_numbers else f".{kind.fields[int(place)] if kind.fields else place}"

    def head(self, function: Typed) -> str:
        """Return the signature of a function."""
        given = (
            f"{'mut ' * bool(count_assignments(name, function.node.body))}{self.language.variable(name)}: {kind}"
            for name, kind in zip(function.parameters, map(self.kind, function.parameters.values()), strict=True)
        )
        return f"pub fn {function.name}({', '.join(given)}) -> {self.kind(function.returns)}"

    def structure(self, kind: Tuple) -> Iterator[str]:
        """Write the structure of a tuple with names."""
        yield f"#[derive(Clone, Copy)]\npub struct {self.names[kind]} {{"
        yield from (f"{INDENT}pub {name}: {self.kind(one)}," for name, one in zip(kind.fields, kind.items, strict=True))
        yield "}\n"

    def text(self) -> str:
        """Write structures and functions, callees first."""
        lines = [line for kind in self.names for line in self.structure(kind)]
        for one in self.program.functions:
            lines += (*slashes(one.summary), *self.language.write(one), "")
        return "\n".join(lines)


def write_law(subject: Subject) -> str:
    """Write the law as one file, for a module that defines Real."""
    core = RustFunctions(subject)
    text, memory = core.text(), subject.memory_name
    names = {name: one.name for name, one in core.program.entries.items()}
    offered, typed = (
        "\n".join(write_entry(one, form, names[one.name]) for one in subject.entries)
        for form in (ON_ARRAYS, ON_NALGEBRA)
    )
    reading = (fill_template(f"{name}.rs") for name in ("columns", "rows") if f"{name}(" in offered)
    reset = "\n/// ".join(textwrap.wrap(RESET, WIDTH - 4))
    return fill_template(
        "law.rs",
        HEADING="\n".join(f"// {line}".rstrip() for line in heading(subject, BY_ROWS, PRECISION).splitlines()),
        LAW=textwrap.indent("type Math = libm::Libm<Real>;\n\n" * ("Math::" in text) + text, INDENT).rstrip(),
        READING="\n".join(reading),
        STATE=fill_template("state.rs", RESET=reset, MEMORY=memory, FIRST=list(subject.memory or ())) * bool(memory),
        ENTRIES=offered,
        OWN="{Real, State}" if memory else "Real",
        TYPED=textwrap.indent(typed, INDENT).rstrip(),
    )


def write_entry(entry: Entry, form: Form, function: str) -> str:
    """Write one entry: on arrays around a function of the law, on nalgebra's types around the one on arrays."""
    given, passed = write_arguments(entry, form["declared"], form["passed"])
    about, call = f"`super::{entry.name}` on the types of nalgebra.", f"super::{entry.name}({passed})"
    if form is ON_ARRAYS:
        about, call = f"Return {entry.about}.", f"law::{function}({passed})"
        call = f"keep({call}, &mut state.{entry.parameters[-1].name})" if entry.has_memory else call
    kind, size = entry.returns.kind, entry.returns.size
    head = f"pub fn {entry.name}({given}) -> {form['returned'].get(kind, form['returned']['']).format(size=size)} {{"
    text = textwrap.wrap(re.sub(r"([][<*]|(?<= )[-+](?= ))", r"\\\1", about), WIDTH - 8)
    lines = (head, f"{INDENT}{form['result'].get(kind, '{}').format(call)}", "}\n")
    return "\n".join((*(f"/// {line}" for line in text), *wrapped(lines)))


def write_crate(subject: Subject) -> dict[str, str]:
    """Write what makes a crate of the law."""
    about = "\n".join(f"//! {line}".rstrip() for line in heading(subject, BY_ROWS, PRECISION).splitlines())
    title = f"{subject.record.title}: {subject.word}".replace('"', "'")
    return {
        "Cargo.toml": fill_template("Cargo.toml", NAME=subject.identifier, TITLE=title, VERSION=PROJECT["version"]),
        "src/lib.rs": fill_template("lib.rs", ABOUT=about, NAME=subject.identifier),
    }


def write_test(subject: Subject) -> str:
    """Write the program that runs the vectors."""
    rows, tests = [], []
    for entry in subject.entries:
        found = [one for one in vectors(subject) if one.entry == entry.name]
        table = f"{entry.name.upper()}_ROWS"
        rows.append(f"static {table}: [(&str, [f64; {len(found[0].row)}]); {len(found)}] = [")
        rows += wrapped(f'{INDENT}("{one.kind}", [{", ".join(map(repr, one.row))}]),' for one in found)
        rows.append("];\n")
        tests.append(f"check!({entry.name}, {table}, {entry.width});")
    plain, typed = ("\n".join(ask(one, form) for one in subject.entries) for form in (ON_ARRAYS, ON_NALGEBRA))
    filled = {"NAME": subject.identifier, "TESTS": "\n".join(tests), "ROWS": "\n".join(rows)}
    return fill_template("test.rs", PLAIN=plain, TYPED=typed, **filled)


def ask(entry: Entry, form: Form) -> str:
    """Write a function that asks an entry with a row of numbers, and returns result and memory."""
    (passed,), body = write_arguments(entry, form["asked"]), []
    parts = [form["flat"].get(entry.returns.kind, form["flat"][""])]
    if entry.has_memory:
        name, size = entry.parameters[-1].name, entry.parameters[-1].size
        body.append(f"let mut state = law::State {{ {name}: at(row, {entry.width - size}) }};")
        parts.append(f"&state.{name}")
    path = "law" if form is ON_ARRAYS else "law::on_nalgebra"
    body += [f"let found = {path}::{entry.name}({passed});", f"collect(&[{', '.join(parts)}])"]
    return "\n".join((f"pub fn {entry.name}(row: &[f64]) -> Vec<f64> {{", *(f"{INDENT}{line}" for line in body), "}"))


FILES = "src/{name}.rs", "tests/vectors.rs"
LANGUAGE = Language("rust", "Rust", FILES, write_law, write_test, "cargo test", fill_template("rust.md"), write_crate)
