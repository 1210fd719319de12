"""Entries of laws with a state and of springs, in both frames."""

from collections.abc import Callable

from bench.export.entries import COMMAND, GAINS, MOMENT, OMEGA, R_D, Entry, Frame, Parameter, R, U, in_both_frames
from bench.law import AT_REST, Goal, kernel, minus, quaternion_direction, relative, rotate_back, sqrt

STATE, NEXT = (Parameter(name, "tuple", 4) for name in ("state", "state_next"))
PERIOD = Parameter("period", "number")
BEGIN = "the state to begin with"
NEXT_STATE = "the state one period [s] on: the state, and the period times its rate"
STIFFNESS, TURNING = Parameter("stiffness", "rows", 9), Parameter("turning_stiffness", "number")
P, P_D = Parameter("p", "tuple", 3), Parameter("p_d", "tuple", 3)
FORCE = Parameter("force", "vector", 3)
ON_HAND = "force on the hand [N] of the stiffness K [N/m], symmetric, row-major; p, p_d: its place, the goal's [m]"
TURN = "moment on the hand about its origin [N m]; turning_stiffness [N m/rad]"
ON_BODY = (
    "moment on the body [N m] of the stiffness K at the goal [N m/rad], symmetric, row-major, in the axes of the tool"
)


def of_compensator(law: Callable, begin: Callable) -> list[Entry]:
    """Return the command of a law with a state, the state one control period on, and the first state."""

    def make(frame: Frame) -> tuple[Callable, ...]:
        to_base, from_base = frame.to_base, frame.from_base

        @kernel
        def command(R, omega, R_d, gains, state):
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

        return command, next_state

    @kernel
    def first(R):
        return begin(R)

    given = (R, OMEGA, R_D, GAINS, STATE)
    both = in_both_frames(make, (given, U, COMMAND), ((*given, PERIOD), NEXT, NEXT_STATE))
    return [*both, Entry("begin", first, (R,), STATE, BEGIN)]


def of_spring(law: Callable, is_rotational: bool) -> list[Entry]:
    """Return the force and the moment of a spring on the hand; of a rotational spring, the moment on the body alone."""

    def make_rotational(frame: Frame) -> tuple[Callable, ...]:
        from_body = frame.from_body

        @kernel
        def moment(R, R_d, stiffness):
            _f, m = law(turn_left(R, R_d), AT_REST, AT_REST, by_rows(stiffness))
            return from_body(R, m)

        return (moment,)

    def make(frame: Frame) -> tuple[Callable, ...]:
        from_body = frame.from_body

        @kernel
        def wrench(R, p, R_d, p_d, stiffness, turning_stiffness):
            left = rotate_back(R_d, minus(p, p_d))
            return law(turn_left(R, R_d), left, by_rows(stiffness), turning_stiffness)

        @kernel
        def force(R, p, R_d, p_d, stiffness, turning_stiffness):
            f, _m = wrench(R, p, R_d, p_d, stiffness, turning_stiffness)
            return from_body(R, f)

        @kernel
        def moment(R, p, R_d, p_d, stiffness, turning_stiffness):
            _f, m = wrench(R, p, R_d, p_d, stiffness, turning_stiffness)
            return from_body(R, m)

        return force, moment

    if is_rotational:
        return in_both_frames(make_rotational, ((R, R_D, STIFFNESS), MOMENT, ON_BODY))
    given = (R, P, R_D, P_D, STIFFNESS, TURNING)
    return in_both_frames(make, (given, FORCE, ON_HAND), (given, MOMENT, TURN))


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
