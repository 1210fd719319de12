"""JavaScript: one classic script. It loads by a script element, from a file too, by require() and by import.

Tuples are arrays, those with names too; numbers are IEEE doubles, and no product is fused with a sum.
"""

import json
import textwrap

from bench.export.braces import INDENT, WIDTH, Braces, is_identity, wrapped
from bench.export.entries import Entry
from bench.export.heading import BY_ROWS, RESET, heading, summary
from bench.export.language import Language, as_json, readme
from bench.export.subject import Subject, translated
from bench.export.types import Kind, Tuple, Typed
from bench.export.vectors import vectors

WORDS = """
arguments await break case catch class const continue debugger default delete do else enum eval export extends
finally for function if implements import in instanceof interface let new package private protected public
return static super switch this throw try typeof var void while with yield
"""
RESERVED = frozenset(WORDS.split())


class Script(Braces):
    """The typed functions as JavaScript."""

    def declaration(self, kind: Kind, name: str, value: str | None) -> str:
        """`let x = 1.0`."""
        return f"let {name}" if value is None else f"let {name} = {value}"

    def built(self, kind: Tuple, items: list[str]) -> str:
        """An array."""
        return f"[{', '.join(items)}]"

    def part(self, kind: Tuple, value: str, place: int) -> str:
        """An element."""
        return f"{value}[{place}]"

    def chosen(self, kind: Tuple, value: str, index: str) -> str:
        """The element that a variable says."""
        return f"{value}[{index}]"

    def primitive(self, name: str) -> str:
        """Those of Math, and copysign, which it lacks."""
        return name if name == "copysign" else f"Math.{name}"

    def variable(self, name: str) -> str:
        """With an underscore after it if it is a word of the language."""
        return f"{name}_" if name in RESERVED else name

    def head(self, function: Typed) -> str:
        """The signature."""
        return f"function {function.name}({', '.join(map(self.variable, function.parameters))})"


def law(subject: Subject) -> tuple[str, str]:
    """The name of its script, and the script."""
    return f"{subject.identifier}.js", script(subject)


def files(subject: Subject) -> dict[str, str]:
    """The script, its test, and the vectors."""
    name = subject.identifier
    name_of_law, text = law(subject)
    return {
        name_of_law: text,
        f"test_{name}.js": TEST.replace("NAME", name),
        "vectors.json": as_json(subject, vectors(subject)),
        "README.md": readme(subject, LANGUAGE),
    }


COPYSIGN = """function copysign(magnitude, sign) {
    const negative = sign < 0 || Object.is(sign, -0);
    return negative ? -Math.abs(magnitude) : Math.abs(magnitude);
}
"""


def script(subject: Subject) -> str:
    """The law as one script: NAME.command(...) and so on, in the frame and form that the name says."""
    done, language = translated(subject), Script()
    functions = [
        "\n".join((*comment(summary(one.text)), *wrapped(language.function(one).split("\n"))))
        for one in done.program.functions
        if not is_identity(one)
    ]
    if any("copysign(" in one for one in functions):
        functions.insert(0, COPYSIGN)
    offered = [_offered(subject, one, done.entries[one.name]) for one in subject.entries]
    first = f"Object.assign(state, {{ memory: {json.dumps(subject.memory)} }})"
    about = "".join(f"{INDENT}{line}\n" for line in comment(f"{RESET} reset() makes a state."))
    memory = f"{about}{INDENT}reset: (state = {{}}) => {first},\n" if subject.memory else ""
    body = "\n\n".join(functions)
    return "\n".join(
        (
            *(f"// {line}".rstrip() for line in heading(subject, BY_ROWS).splitlines()),
            f"(function (root) {{\n'use strict';\n\n{body}\n",
            *(READING,),
            f"const offered = {{\n{memory}{''.join(offered)}}};",
            "if (typeof module === 'object' && module.exports) module.exports = offered;",
            f"else root.{subject.identifier} = offered;",
            "})(typeof globalThis === 'object' ? globalThis : this);\n",
        )
    )


READING = """function columns(R) {
    if (R.length !== 9 || typeof R[0] !== 'number')
        throw new TypeError('a matrix is an array of nine numbers, by rows: R[3 * i + j]; flatten a nested one');
    return [[R[0], R[3], R[6]], [R[1], R[4], R[7]], [R[2], R[5], R[8]]];
}

function rows(R) {
    return [0, 1, 2].flatMap((i) => [R[0][i], R[1][i], R[2][i]]);
}

function kept(answer, state) {
    state.memory = answer[1];
    return answer[0];
}
"""


def _offered(subject: Subject, entry: Entry, function: Typed) -> str:
    """One entry of the object that the script offers."""
    given, passed = [], []
    for one in entry.parameters:
        words = {"gains": ["kp", "kv"], "memory": ["state"]}.get(one.kind, [one.name])
        values = {"gains": "[kp, kv]", "memory": "state.memory", "matrix": f"columns({one.name})"}
        given += words
        passed.append(values.get(one.kind, one.name))
    call = f"{function.name}({', '.join(passed)})"
    call = f"kept({call}, state)" if entry.has_memory else f"rows({call})" if entry.returns == "matrix" else call
    about = "".join(f"{INDENT}{line}\n" for line in comment(entry.doc))
    return f"{about}{INDENT}{entry.name}: ({', '.join(given)}) => {call},\n"


def comment(text: str) -> list[str]:
    """As a comment before a function."""
    return [f"// {line}" for line in textwrap.wrap(text, WIDTH - 4)]


TEST = """// node test_NAME.js
const law = require('./NAME.js');
const { vectors } = require('./vectors.json');

let wrong = 0;
for (const one of vectors) {
    // a law with memory is at its first tick in the vectors at 180 degrees: after reset
    const state = { memory: [-1, -1, -1, -1] };
    if (one.kind === 'at 180°' && law.reset) law.reset(state);
    else state.memory = one.arguments.memory;
    const given = Object.entries(one.arguments).flatMap(([name, value]) =>
        name === 'gains' ? value : name === 'memory' ? [state] : [value]);
    const result = [law[one.entry](...given)].flat();
    const found = one.memory.length ? result.concat(state.memory) : result;
    const expected = one.result.concat(one.memory);
    if (!expected.every((value, at) => Math.abs(found[at] - value) <= one.tolerance)) wrong += 1;
}
console.log(`NAME: ${wrong} of ${vectors.length} vectors wrong`);
process.exit(wrong ? 1 : 0);
"""

LANGUAGE = Language("js", "JavaScript", law, files, "node test_{name}.js")
