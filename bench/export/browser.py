"""All laws, the plant and the judge as one script for a page, translated from the sources that are measured.

    live.laws["late-braking"].law(R, omega, goal, gains, memory), live.plant.step(R, omega, u, inertia, h), ...

Matrices are their three columns. A function that two laws call is there once; `needs` names what a law calls, callees
first, so that a page can show the text of the very functions it runs.
"""

import json
from collections.abc import Callable, Iterable, Iterator

from bench.engines.ideal import angle_between, haversine, turned
from bench.engines.rigid_body import step
from bench.export.languages.js import COPYSIGN, write_function
from bench.export.subject import MATRIX, TUNING
from bench.law.contender import Contender
from bench.law.inputs import Goal
from bench.law.shipped import shortened
from bench.law.so3 import from_quaternion, turn_quaternion
from bench.translation.inference import Typed
from bench.translation.kinds import REAL, TRUTH, Kind, Tuple, numbers
from bench.translation.program import Program
from tasks.verdict import OUTCOMES, Watch, check_command, check_state, first_watch, verdict, watched

THREE, FOUR = numbers(3), numbers(4)
GOAL = Tuple((MATRIX, THREE, THREE), Goal.__name__, Goal._fields)
WATCH = Tuple((REAL, REAL, TRUTH, REAL, REAL), Watch.__name__, Watch._fields)

PLANT: dict[Callable, tuple[Kind, ...]] = {
    from_quaternion: (FOUR,),
    turn_quaternion: (MATRIX, MATRIX),
    turned: (MATRIX, THREE),
    shortened: (THREE, REAL),
    step: (MATRIX, THREE, THREE, THREE, REAL),
    haversine: (MATRIX, MATRIX),
    angle_between: (MATRIX, MATRIX),
}
"""Functions that move the body and measure it, with the kinds of their arguments."""

JUDGE: dict[Callable, tuple[Kind, ...]] = {
    first_watch: (REAL,) * 4,
    watched: (WATCH, *(REAL,) * 5),
    check_command: (REAL, REAL),
    check_state: (REAL, REAL),
    verdict: (REAL, WATCH, *(REAL,) * 6),
}


def script(contenders: Iterable[Contender]) -> str:
    """Write the script, which defines a global `live`: laws, plant, judge, outcomes, and functions by name."""
    program = Program()
    offered = [
        f"{name}: {{{', '.join(program.add(one, kinds).name for one, kinds in functions.items())}}},"
        for name, functions in (("plant", PLANT), ("judge", JUDGE))
    ]
    laws = {one.on_free_body: _write_law(program, one) for one in contenders}
    listed = ",\n".join(f"{json.dumps(word)}: {one}" for word, one in laws.items())
    return "\n".join(
        (
            "(function (root) {",
            "'use strict';",
            COPYSIGN,
            *map(write_function, program.functions),
            "root.live = {",
            *offered,
            f"functions: {{copysign, {', '.join(one.name for one in program.functions)}}},",
            f"outcomes: {json.dumps(OUTCOMES)},",
            f"laws: {{\n{listed}\n}}}};",
            "})(typeof globalThis === 'object' ? globalThis : this);\n",
        )
    )


def _write_law(program: Program, one: Contender) -> str:
    """Write a law: its function, its memory at first, and what it needs, which ends with itself."""
    memory = one.regulator.memory
    kinds = (MATRIX, THREE, GOAL, TUNING, *((numbers(len(memory)),) if memory else ()))
    called = list(_with_callees(program.add(one.law, kinds)))
    needs = ["copysign"] * any("copysign(" in write_function(each) for each in called)
    needs += dict.fromkeys(each.name for each in called)
    return f"{{law: {needs[-1]}, memory: {json.dumps(memory)}, needs: {json.dumps(needs)}}}"


def _with_callees(function: Typed) -> Iterator[Typed]:
    for one in function.calls.values():
        if one.identity is None:
            yield from _with_callees(one)
    yield function
