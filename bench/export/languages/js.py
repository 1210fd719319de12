"""JavaScript: one classic script, with types for TypeScript. It loads by a script element, by require() and by import.

Tuples are arrays, those with names too; numbers are IEEE doubles, and no product is fused with a sum.
"""

import json

from bench.export.entries import Entry
from bench.export.heading import BY_ROWS, RESET, heading
from bench.export.language import Language, write_arguments
from bench.export.layout import fill_template, slashes
from bench.export.subject import Subject, translated
from bench.translation.braces import Braces
from bench.translation.inference import Typed
from bench.translation.layout import INDENT

WORDS = """
arguments await break case catch class const continue debugger default delete do else enum eval export extends
finally for function if implements import in instanceof interface let new package private protected public
return static super switch this throw try typeof var void while with yield
"""


SCRIPT: Braces = Braces(
    reserved=frozenset(WORDS.split()),
    declaration=lambda kind, name, is_changed: f"let {name}",
    built=lambda kind, items: f"[{', '.join(items)}]",
    part=lambda kind, value, place: f"{value}[{place}]",
    head=lambda function: f"function {function.name}({', '.join(map(SCRIPT.variable, function.parameters))})",
    function_name=str,
    primitive=lambda name: name if name == "copysign" else f"Math.{name}",  # Math has no copysign
)


def write_function(function: Typed) -> str:
    """Write a function after its comment."""
    return "\n".join((*slashes(function.summary), *SCRIPT.write(function)))


COPYSIGN = fill_template("copysign.js")
PASSED = {
    "gains": "[kp, kv]",
    "tuning": "[kp, kv, bound, delay]",
    "memory": "state.{name}",
    "matrix": "columns({name})",
    "": "{name}",
}
DECLARED = {"gains": "kp, kv", "tuning": "kp, kv, bound, delay", "memory": "state", "": "{name}"}


def write_script(subject: Subject) -> str:
    """Write the law as one script: NAME.angular_acceleration(...) and so on."""
    program = translated(subject)
    functions = [write_function(one) for one in program.functions]
    if any("copysign(" in one for one in functions):
        functions.insert(0, COPYSIGN)
    offered = [line for one in subject.entries for line in write_entry(one, program.entries[one.name].name)]
    if subject.memory:
        first = f"Object.assign(state, {{ {subject.memory_name}: {json.dumps(subject.memory)} }})"
        offered = [*slashes(f"{RESET} reset() makes a state."), f"reset: (state = {{}}) => {first},", *offered]
    return "\n".join(
        (
            *(f"// {line}".rstrip() for line in heading(subject, BY_ROWS).splitlines()),
            "(function (root) {\n'use strict';\n",
            "\n\n".join((*functions, fill_template("reading.js"))),
            "const offered = {",
            *(f"{INDENT}{line}" for line in offered),
            "};",
            "if (typeof module === 'object' && module.exports) module.exports = offered;",
            f"else root.{subject.identifier} = offered;",
            "})(typeof globalThis === 'object' ? globalThis : this);\n",
        )
    )


def write_entry(entry: Entry, function: str) -> list[str]:
    """Write one entry of the object that the script offers."""
    given, passed = write_arguments(entry, DECLARED, PASSED)
    call = f"{function}({passed})"
    if entry.has_memory:
        call = f"kept({call}, state, '{entry.parameters[-1].name}')"
    elif entry.returns.kind == "matrix":
        call = f"rows({call})"
    return [*slashes(entry.about), f"{entry.name}: ({given}) => {call},"]


TYPED = {"number": "{name}: number", "gains": "kp: number, kv: number", "memory": "state: State"}
TYPED["tuning"] = f"{TYPED['gains']}, bound: number, delay: number"
TYPED[""] = "{name}: ArrayLike<number>"


def write_types(subject: Subject) -> dict[str, str]:
    """Write the declarations for TypeScript."""
    state = f"export interface State {{ {subject.memory_name}: number[] }}"
    lines = [state, "export function reset(state?: object): State;"] if subject.memory else []
    for one in subject.entries:
        given, returned = next(write_arguments(one, TYPED)), "number" + "[]" * (one.returns.kind != "number")
        lines += (f"/** {one.about} */", f"export function {one.name}({given}): {returned};")
    return {f"{subject.identifier}.d.ts": "\n".join((*lines, ""))}


def write_test(subject: Subject) -> str:
    """Write the program that runs the vectors."""
    return fill_template("test.js", NAME=subject.identifier)


FILES = "{name}.js", "test_{name}.js"
LANGUAGE = Language("js", "JavaScript", FILES, write_script, write_test, "node test_{name}.js", beside=write_types)
