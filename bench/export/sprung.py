"""Entries of laws with a state and of springs, in both frames, and of coordinates."""

from collections.abc import Callable

from bench.export.entries import (
    ACCELERATION,
    GAINS,
    MOMENT,
    OMEGA,
    R_D,
    SEEN,
    Entry,
    Frame,
    Parameter,
    R,
    U,
    in_both_frames,
    name_numbers,
    of_torque,
)
from bench.law import AT_REST, Coordinates, Goal, kernel, quaternion_direction, relative, sqrt

PERIOD = Parameter("period", "number")
BEGIN = "the state to begin with, and after a pause"
NEXT_STATE = "the state one period [s] on: the state, and the period times its rate"
STIFFNESS = Parameter("stiffness_body", "rows", 9)
ON_BODY = "moment on the body [N m] of stiffness_body, K at the goal [N m/rad], symmetric, in the axes of the tool"


def of_compensator(law: Callable, begin: Callable) -> list[Entry]:
    """Return angular acceleration and torque of a law with a state, its first state and the one a period on."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        to_base, from_base = frame.to_base, frame.from_base

        @kernel
        def angular_acceleration(R, omega, R_d, gains, state):
            u, _rate = law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains, state)
            return from_base(R, u)

        @kernel
        def next_state(R, omega, R_d, gains, state, period):
            _u, rate = law(R, to_base(R, omega), Goal(R_d, AT_REST, AT_REST), gains, state)
            return (
                state[0] + period * rate[0],
                state[1] + period * rate[1],
                state[2] + period * rate[2],
                state[3] + period * rate[3],
            )

        return angular_acceleration, next_state

    name = name_numbers("state", begin(SEEN[0]), quaternion_direction(SEEN[0])[0])
    state, following = (Parameter(each, "tuple", 4) for each in (name, name.replace("state", "state_next")))
    given = (R, OMEGA, R_D, GAINS, state)
    both = in_both_frames(make, (given, U, ACCELERATION), ((*given, PERIOD), following, NEXT_STATE))
    return [*both, Entry("reset", begin, (R,), state, BEGIN), *of_torque()]


def of_spring(law: Callable) -> list[Entry]:
    """Return the moment of a spring on the body."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        from_body = frame.from_body

        @kernel
        def moment(R, R_d, stiffness):
            return from_body(R, law(turn_left(R, R_d), by_rows(stiffness)))

        return (moment,)

    return in_both_frames(make, ((R, R_D, STIFFNESS), MOMENT, ON_BODY))


@kernel
def turn_left(R, R_d):
    """Return the unit quaternion (w, x, y, z) of R_d^T R, w >= 0."""
    quat_wxyz, t = quaternion_direction(relative(R_d, R))
    shorter = 0.5 / sqrt(t)
    return (shorter * quat_wxyz[0], shorter * quat_wxyz[1], shorter * quat_wxyz[2], shorter * quat_wxyz[3])


@kernel
def by_rows(k):
    """Return a matrix of nine numbers by rows."""
    return ((k[0], k[1], k[2]), (k[3], k[4], k[5]), (k[6], k[7], k[8]))


def of_representation(record: Coordinates) -> list[Entry]:
    """Return the entries of coordinates: to and from R, B, B^-1 and B^T, base frame."""
    size, order = len(record.symbols), "_wxyz" * (record.symbols == ("w", "x", "y", "z"))
    chart, chart_of = record.chart, record.chart_of
    push, pull, accelerate, convert = record.angular_velocity, record.rates, record.accelerate, record.generalized
    E, Edot, Eddot, F = (Parameter(f"{name}{order}", "tuple", size) for name in ("E", "Edot", "Eddot", "F"))
    number = Parameter("margin", "number")

    @kernel
    def coordinates(R):
        return chart(R).E

    @kernel
    def rates(E, omega):
        return pull(chart_of(E), omega)

    @kernel
    def angular_velocity(E, Edot):
        return push(chart_of(E), Edot)

    @kernel
    def angular_acceleration(E, Edot, Eddot):
        return accelerate(chart_of(E), Edot, Eddot)

    @kernel
    def generalized_forces(E, moment):
        return convert(chart_of(E), moment)

    return [
        Entry(f"coordinates{order}", coordinates, (R,), E, f"E = ({', '.join(record.symbols)}) of R"),
        Entry("rotation", record.to_matrix, (E,), R, "R of E"),
        Entry(f"rates{order}", rates, (E, OMEGA), Edot, "Edot = B^-1 omega"),
        Entry("angular_velocity", angular_velocity, (E, Edot), OMEGA, "omega = B Edot"),
        Entry("angular_acceleration", angular_acceleration, (E, Edot, Eddot), U, "u = B Eddot + Bdot Edot"),
        Entry(f"generalized_forces{order}", generalized_forces, (E, MOMENT), F, "B^T m"),
        Entry("margin", record.margin, (R,), number, "in [0, 1], 0 exactly where B^-1 does not exist"),
    ]
