"""Python: one file to the array API standard, for NumPy, JAX and torch alike, over any leading axes."""

import ast
import inspect
import keyword
import textwrap

from bench.export import lanes
from bench.export.braces import INDENT, is_identity, wrapped
from bench.export.entries import Entry, Parameter
from bench.export.heading import RESET, WIDTH, heading, summary
from bench.export.language import Language, as_json, readme
from bench.export.masks import ELSE, LANES, THEN, function_name, masked
from bench.export.subject import Subject, translated
from bench.export.types import Program, Tuple
from bench.export.vectors import vectors

ARRAYS = (
    "Arrays    NumPy 2, JAX (jit, vmap, grad), torch, or any of the array API standard: matrices (..., 3, 3), vectors "
    "(..., 3), quaternions (..., 4), gains numbers or (...), over any leading axes, broadcast. float32 stays float32"
)


def law(subject: Subject) -> tuple[str, str]:
    """The name of its module, and the module."""
    return f"{subject.identifier}.py", module(subject)


def files(subject: Subject) -> dict[str, str]:
    """The module, its test, and the vectors."""
    name = subject.identifier
    name_of_law, text = law(subject)
    return {
        name_of_law: text,
        f"test_{name}.py": TEST.replace("NAME", name),
        "vectors.json": as_json(subject, vectors(subject)),
        "README.md": readme(subject, LANGUAGE),
    }


def module(subject: Subject) -> str:
    """The law as one module: command(R, omega, R_d, kp, kv) and so on, in the frame and form that the name says."""
    done = translated(subject)
    tuples = _tuples(done.program)
    taken = {LANES, THEN, ELSE, "range", *tuples.values(), *keyword.kwlist, *keyword.softkwlist}
    taken |= {function_name(one) for one in done.program.functions}
    offered = [one.name for one in subject.entries] + (["reset"] if subject.memory else [])
    names = textwrap.fill(", ".join(f'"{one}"' for one in offered) + ",", WIDTH)
    parts = [
        f'r"""{heading(subject, ARRAYS)}\n"""\n\n{RUNTIME}',
        *(_definition(tuples[kind.name], kind) for kind in done.program.tuples if kind.name),
        *(
            _text(masked(one, taken, tuples), summary(one.text))
            for one in done.program.functions
            if not is_identity(one)
        ),
        *([_reset(subject.memory)] if subject.memory else []),
        *(_offered(one, function_name(done.entries[one.name]), tuples) for one in subject.entries),
        f"__all__ = [\n{textwrap.indent(names, INDENT)}\n]\n",
    ]
    return "\n\n\n".join(parts)


RUNTIME = inspect.getsource(lanes).partition('"""\n\n')[2].strip()
"""The file of lanes without what it says first."""


def _tuples(program: Program) -> dict[str, str]:
    """By name of a NamedTuple, its name in the file."""
    return {
        kind.name: f"{kind.name}_" if hasattr(lanes, kind.name) else kind.name for kind in program.tuples if kind.name
    }


def _definition(name: str, kind: Tuple) -> str:
    return "\n".join((f"class {name}(NamedTuple):", *(f"{INDENT}{field}: Any" for field in kind.fields)))


def _text(node: ast.FunctionDef, doc: str) -> str:
    """A function with what it says of itself."""
    head, *body = ast.unparse(ast.fix_missing_locations(node)).split("\n")
    return "\n".join(wrapped((head, *_docstring(doc), *body)))


def _docstring(doc: str) -> list[str]:
    lines = textwrap.wrap(doc.replace("\\", "\\\\"), WIDTH)
    if len(lines) < 2:
        return [f'{INDENT}"""{one}"""' for one in lines]
    return [INDENT + one for one in (f'"""{lines[0]}', *lines[1:], '"""')]


def _reset(first: tuple) -> str:
    """What returns the memory before the first tick."""
    zeros = f"({', '.join('0.0' for _ in first)})"
    about = f"{RESET} A memory (..., {len(first)}) that is given says the lanes, the library and the precision."
    lines = (f"{LANES}, _ = opened(memory=(memory, {len(first)}))", f"return {LANES}.vector({first})")
    return "\n".join((f"def reset(memory={zeros}):", *_docstring(about), *(INDENT + one for one in lines)))


def _offered(entry: Entry, core: str, tuples: dict[str, str]) -> str:
    """One entry on arrays."""
    given = [each for one in entry.parameters for each in _arguments(one)]
    names = ", ".join(name for name, _ in given)
    opening = ", ".join(f"{name}={_written((name, *axes))}" for name, axes in given)
    shapes = ", ".join(f"{name} ({', '.join(map(str, ('...', *axes)))})" for name, axes in given)
    passed = ", ".join((LANES, *(_passed(one, tuples) for one in entry.parameters)))
    if entry.has_memory:
        ends = [f"answer, kept = {core}({passed})", f"return {LANES}.vector(answer), {LANES}.vector(kept)"]
    else:
        way = {"matrix": "matrix", "number": "number"}.get(entry.returns, "vector")
        ends = [f"return {LANES}.{way}({core}({passed}))"]
    body = [INDENT + one for one in (f"{LANES}, {names} = opened({opening})", *ends)]
    doc = _docstring(f"{entry.doc[0].upper()}{entry.doc[1:]}; {shapes}.")
    return "\n".join((*wrapped([f"def {entry.name}({names}):"]), *doc, *wrapped(body)))


def _written(items: tuple) -> str:
    """As a tuple in Python."""
    return f"({', '.join(map(str, items))})" if len(items) > 1 else f"({items[0]},)"


def _arguments(one: Parameter) -> list[tuple[str, tuple[int, ...]]]:
    """What an argument is for who calls, with its last axes."""
    if one.kind == "gains":
        return [("kp", ()), ("kv", ())]
    axes: dict[int, tuple[int, ...]] = {1: (), 9: (3, 3)}
    return [(one.name, axes.get(one.size, (one.size,)))]


def _passed(one: Parameter, tuples: dict[str, str]) -> str:
    """The argument of the core."""
    if one.kind == "gains":
        return f"{tuples['Gains']}(kp, kv)"
    if one.kind == "matrix":
        return f"{tuples['Rotation']}(*columns({one.name}))"
    if one.size == 9:
        return f"by_rows({one.name})"
    return one.name if one.kind == "number" else f"numbers({one.name})"


TEST = '''"""python test_NAME.py"""

import json
import sys
from pathlib import Path

import numpy as np
import NAME as law


def values(name, given, kinds):
    """The arguments that a name stands for, of all questions at once."""
    rows = np.array(given)
    if name == "gains":
        return [rows[:, 0], rows[:, 1]]
    if name == "memory":  # at its first tick in the vectors at 180 degrees: after reset
        rows[kinds == "at 180°"] = law.reset()
    return [rows.reshape(-1, 3, 3) if rows.shape[-1] == 9 else rows]


asked = {}
for one in json.loads(Path(__file__).with_name("vectors.json").read_text())["vectors"]:
    asked.setdefault(one["entry"], []).append(one)

wrong = 0
for entry, questions in asked.items():
    names = questions[0]["arguments"]
    kinds = np.array([one["kind"] for one in questions])
    given = [x for name in names for x in values(name, [one["arguments"][name] for one in questions], kinds)]
    answer = getattr(law, entry)(*given)
    parts = answer if isinstance(answer, tuple) else (answer,)
    found = np.concatenate([part.reshape(len(questions), -1) for part in parts], axis=1)
    expected = np.array([one["result"] + one["memory"] for one in questions])
    tolerance = np.array([[one["tolerance"]] for one in questions])
    wrong += int((~(np.abs(found - expected) <= tolerance)).any(axis=1).sum())

print(f"NAME: {wrong} of {sum(map(len, asked.values()))} vectors wrong")
sys.exit(1 if wrong else 0)
'''

LANGUAGE = Language("python", "Python on arrays", law, files, "python test_{name}.py")
