"""What C and C++ have in common: tuples as structures, typed functions as static inline ones."""

import ast
import textwrap
from collections.abc import Iterator

from bench.export.braces import WIDTH, Braces, is_identity, wrapped
from bench.export.heading import summary
from bench.export.types import INDEX, REAL, TRUTH, Kind, Program, Tuple, Typed

WORDS = """
auto break case char const continue default do double else enum extern float for goto if inline int long
register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while
and and_eq bitand bitor bool catch class compl delete explicit export false friend mutable namespace new not
not_eq operator or or_eq private protected public template this throw true try typename using virtual xor
"""
RESERVED = frozenset(WORDS.split())
"""Words of C and of C++, which shares the core."""


class Core(Braces):
    """The typed functions in what C and C++ have in common."""

    def __init__(self, program: Program, prefix: str = ""):
        """prefix: begins every name of the file's scope, in a language without namespaces."""
        self.program, self.prefix = program, prefix
        self.names: dict[Tuple, str] = {}
        for kind in program.tuples:
            self.names[kind] = _free(self.function_name(self._name_of(kind)), self.names.values())

    def function_name(self, name: str) -> str:
        """After the prefix."""
        return f"{self.prefix}{name}"

    def _name_of(self, kind: Tuple) -> str:
        if kind.is_numbers:
            return f"real{len(kind.items)}"
        return kind.name or "_".join(self.kind(one).removeprefix(self.prefix) for one in kind.items)

    def kind(self, kind: Kind) -> str:
        """How a kind is written."""
        return self.names[kind] if isinstance(kind, Tuple) else {REAL: "double", TRUTH: "int", INDEX: "int"}[kind]

    def declaration(self, kind: Kind, name: str, value: str | None) -> str:
        """`double x = 1.0`."""
        return f"{self.kind(kind)} {name}" if value is None else f"{self.kind(kind)} {name} = {value}"

    def built(self, kind: Tuple, items: list[str]) -> str:
        """By the function that makes one."""
        return f"{self.names[kind]}_of({', '.join(items)})"

    def part(self, kind: Tuple, value: str, place: int) -> str:
        """An element, or a field."""
        return f"{value}.at[{place}]" if kind.is_numbers else f"{value}.{_field(kind, place)}"

    def chosen(self, kind: Tuple, value: str, index: str) -> str:
        """The element that a variable says."""
        return f"{value}.at[{index}]"

    def variable(self, name: str) -> str:
        """With an underscore after it if it is a word of the language."""
        return f"{name}_" if name in RESERVED else name

    def head(self, function: Typed) -> str:
        """The signature."""
        given = (f"{self.kind(kind)} {self.variable(name)}" for name, kind in function.parameters.items())
        return f"static inline {self.kind(function.returns)} {self.function_name(function.name)}({', '.join(given)})"

    def types(self) -> Iterator[str]:
        """The structures, each with what makes one."""
        for kind, name in self.names.items():
            items = [f"x{at}" if kind.is_numbers else _field(kind, at) for at in range(len(kind.items))]
            fields = (f"{self.kind(one)} {item};" for one, item in zip(kind.items, items, strict=True))
            given = ", ".join(f"{self.kind(one)} {item}" for one, item in zip(kind.items, items, strict=True))
            held = f"double at[{len(items)}];" if kind.is_numbers else " ".join(fields)
            value = f"{{{', '.join(items)}}}"
            yield f"typedef struct {{ {held} }} {name};"
            yield f"static inline {name} {name}_of({given}) {{"
            yield f"    {name} t = {f'{{{value}}}' if kind.is_numbers else value};"
            yield "    return t;"
            yield "}"

    def text(self) -> str:
        """Types and functions, callees first."""
        functions = (self.documented(one) for one in self.program.functions if not is_identity(one))
        return "\n".join((*wrapped(self.types()), "", "\n\n".join(functions), ""))

    def documented(self, function: Typed) -> str:
        """A function after its comment; parameters that it does not look at are said to be so."""
        head, *body = self.function(function).split("\n")
        named = {one.id for one in ast.walk(function.node) if isinstance(one, ast.Name)}
        idle = [f"    (void){self.variable(name)};" for name in function.parameters if name not in named]
        return "\n".join((*comment(summary(function.text)), *wrapped((head, *idle, *body))))


def _field(kind: Tuple, place: int) -> str:
    return kind.fields[place] if kind.fields else f"item{place}"


def _free(name: str, taken) -> str:
    return name if name not in taken else _free(f"{name}_", taken)


def comment(text: str) -> list[str]:
    """As a comment before a function; no line if there is nothing to say."""
    if not text:
        return []
    lines = textwrap.wrap(text, WIDTH - 6)
    return (
        [f"/* {lines[0]}", *(f"   {line}" for line in lines[1:-1]), f"   {lines[-1]} */"]
        if lines[1:]
        else [f"/* {text} */"]
    )
