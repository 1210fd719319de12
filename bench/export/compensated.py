"""Entries of an exported law with a state: the command, and the state at first and one control period on."""

from collections.abc import Callable

from bench.export.entries import COMMAND, FORMS, GAINS, Entry, Form, Parameter, named_entry
from bench.law import AT_REST, Goal, kernel, rotate, rotate_back

STATE, PERIOD = Parameter("state", "tuple", 4), Parameter("period", "number")


def of_compensator(law: Callable, begin: Callable) -> list[Entry]:
    """Of a law with a state: its command, the state one control period on and at first, in both frames and forms."""
    found = []
    for form in FORMS:
        made = _compensating(law, begin, form)
        found.append(named_entry("begin", form, made, (form.R,), "the state to begin with"))
        for frame in ("", "_body"):
            given = (form.R, Parameter(f"omega{frame}", "tuple", 3), form.R_d, GAINS, STATE)
            found.append(named_entry(f"command{frame}", form, made, given, COMMAND))
            doc = "the state one period [s] on: the state, and the period times its rate"
            found.append(named_entry(f"next_state{frame}", form, made, (*given, PERIOD), doc))
    return found


def _compensating(law: Callable, begin: Callable, form: Form) -> dict[str, Callable]:
    read = form.read

    @kernel
    def first(R):
        return begin(read(R))

    @kernel
    def command(R, omega, R_d, gains, state):
        u, _rate = law(read(R), omega, Goal(read(R_d), AT_REST, AT_REST), gains, state)
        return u

    @kernel
    def command_body(R, omega_body, R_d, gains, state):
        at = read(R)
        u, _rate = law(at, rotate(at, omega_body), Goal(read(R_d), AT_REST, AT_REST), gains, state)
        return rotate_back(at, u)

    @kernel
    def next_state(R, omega, R_d, gains, state, period):
        _u, rate = law(read(R), omega, Goal(read(R_d), AT_REST, AT_REST), gains, state)
        return (
            state[0] + period * rate[0],
            state[1] + period * rate[1],
            state[2] + period * rate[2],
            state[3] + period * rate[3],
        )

    @kernel
    def next_state_body(R, omega_body, R_d, gains, state, period):
        return next_state(R, rotate(read(R), omega_body), R_d, gains, state, period)

    made = (command, command_body, next_state, next_state_body)
    return {"begin": first, **{one.__name__: one for one in made}}
