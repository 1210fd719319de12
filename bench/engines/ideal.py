"""The paper's plant without MuJoCo (Murphy 1988, 2.6-2.7): continuous, or sampled with a held command.

rk4: Runge-Kutta of order 4 on omega and on the columns of R, the law evaluated at every stage, as a continuous-time
simulation (the paper's Simnon) would; `refined` divides its steps, `convergence` says how far. held: the command stays
over the tick, omega is then linear in time and R moves by exp([Omega]x), Omega by Magnus to fourth order in the tick.
"""

from bench.law.scalar import atan2, cos, kernel, sin, sqrt
from bench.law.so3 import Rotation, cross, dot, double_sine, trace

SMALL_TURN_SQUARED = 1e-2
"""Below 0.1 rad a tick the series of sin(x)/x and (1 - cos x)/x^2 to x^8 err by under 3e-18."""


@kernel
def turned(R, turn):
    """exp([turn]x) R: R after a rotation by the base-frame vector `turn`."""
    squared = dot(turn, turn)
    first, second = small_turn(squared) if squared < SMALL_TURN_SQUARED else large_turn(squared)
    return turned_by(R, turn, first, second)


@kernel
def small_turn(x):
    """sin(angle)/angle and (1 - cos(angle))/angle^2 by their series in x = angle^2."""
    first = 1.0 - x / 6.0 * (1.0 - x / 20.0 * (1.0 - x / 42.0 * (1.0 - x / 72.0)))
    second = 0.5 - x / 24.0 * (1.0 - x / 30.0 * (1.0 - x / 56.0 * (1.0 - x / 90.0)))
    return first, second


@kernel
def large_turn(squared):
    """Return the two factors for an angle that is not small."""
    angle = sqrt(squared)
    return sin(angle) / angle, (1.0 - cos(angle)) / squared


@kernel
def turned_by(R, turn, first, second):
    """R + first [turn]x R + second [turn]x^2 R."""
    return Rotation(
        _turned_column(R.n, turn, first, second),
        _turned_column(R.o, turn, first, second),
        _turned_column(R.a, turn, first, second),
    )


@kernel
def _turned_column(column, turn, first, second):
    once = cross(turn, column)
    twice = cross(turn, once)
    return (
        column[0] + first * once[0] + second * twice[0],
        column[1] + first * once[1] + second * twice[1],
        column[2] + first * once[2] + second * twice[2],
    )


@kernel
def plus(v, h, w):
    """v + h w."""
    return (v[0] + h * w[0], v[1] + h * w[1], v[2] + h * w[2])


@kernel
def moved(R, h, dR):
    """R + h dR, column by column."""
    return Rotation(plus(R.n, h, dR.n), plus(R.o, h, dR.o), plus(R.a, h, dR.a))


@kernel
def rotation_rate(R, omega):
    """Rdot = [omega]x R (Murphy 1988, 2.7)."""
    return Rotation(cross(omega, R.n), cross(omega, R.o), cross(omega, R.a))


@kernel
def weighted(a, b, c, d):
    """Return a + 2 b + 2 c + d: the weights of Runge-Kutta 4, times six."""
    return (
        a[0] + 2.0 * (b[0] + c[0]) + d[0],
        a[1] + 2.0 * (b[1] + c[1]) + d[1],
        a[2] + 2.0 * (b[2] + c[2]) + d[2],
    )


@kernel
def held_turn(omega, u, dt):
    """Return the rotation of one tick with u held: Magnus to fourth order in dt."""
    drift = cross(u, omega)
    half, twelfth = 0.5 * dt * dt, dt * dt * dt / 12.0
    return (
        omega[0] * dt + u[0] * half + drift[0] * twelfth,
        omega[1] * dt + u[1] * half + drift[1] * twelfth,
        omega[2] * dt + u[2] * half + drift[2] * twelfth,
    )


@kernel
def held_step(R, omega, u, dt):
    """Return the plant one tick on with u held: R moved by the Magnus vector, omega by u dt."""
    return turned(R, held_turn(omega, u, dt)), plus(omega, dt, u)


@kernel
def haversine(R, R_d):
    """sin^2(theta/2) = |R - R_d|^2 / 8, without cancellation near zero."""
    n, o, a = plus(R.n, -1.0, R_d.n), plus(R.o, -1.0, R_d.o), plus(R.a, -1.0, R_d.a)
    return 0.125 * (dot(n, n) + dot(o, o) + dot(a, a))


@kernel
def angle_between(R, R_d):
    """theta in [0, pi] from its sine, |sum r_di x r_i| / 2, and its cosine, (tr(R_d^T R) - 1) / 2."""
    s = double_sine(R_d, R)
    return atan2(sqrt(dot(s, s)), trace(R_d, R) - 1.0)


@kernel
def rk4_step(evaluate, R, omega, u, goal, gains, memory, dt):
    """Return the closed loop one Runge-Kutta step on; the first stage's command u is the tick's and is given."""
    half = 0.5 * dt
    R1 = rotation_rate(R, omega)
    omega2, at2 = plus(omega, half, u), moved(R, half, R1)
    u2, _, _ = evaluate(at2, omega2, goal, gains, memory)
    R2 = rotation_rate(at2, omega2)
    omega3, at3 = plus(omega, half, u2), moved(R, half, R2)
    u3, _, _ = evaluate(at3, omega3, goal, gains, memory)
    R3 = rotation_rate(at3, omega3)
    omega4, at4 = plus(omega, dt, u3), moved(R, dt, R3)
    u4, _, _ = evaluate(at4, omega4, goal, gains, memory)
    R4 = rotation_rate(at4, omega4)
    n = weighted(R1.n, R2.n, R3.n, R4.n)
    o = weighted(R1.o, R2.o, R3.o, R4.o)
    a = weighted(R1.a, R2.a, R3.a, R4.a)
    sixth = dt / 6.0
    return moved(R, sixth, Rotation(n, o, a)), plus(omega, sixth, weighted(u, u2, u3, u4))
