"""Extremals of Pontryagin's principle: the motions among which the fastest of a bounded command is.

A body of unit inertia turns with omega' = u, |u| <= 1. In the base frame, with the turn q from the
goal to the body, the costate L of omega, the costate m of the turn and the constant N = m + omega x L
(constant because no place of the goal is special), an extremal obeys

    q' = (0, omega) q/2        omega' = L/|L|        L' = omega x L - N = -m

Shooting finds L(0), N and the time T with which the motion ends in a target, from many guesses.

Two targets. At rest: q(T) = (+-1, 0, 0, 0), omega(T) = 0. In a band of half width b, for good: the
body comes in at the angle b, and from there a command can keep it inside. That set is known exactly
where space is flat. With p the place (|p| = b) and v the velocity, no command keeps the body inside
if for a time t and a direction n: n.p + n.v t - t^2/2 > b, because n.p(t) cannot be less. At the limit
the command -n makes a parabola that touches the band's edge at b n after the time t = n.v,

    p + v t - n t^2/2 = b n        |v|^2 = b + (3/4) t^2

with a speed there of at most sqrt(b), so that the body can follow the edge and stop. Straight in
(n = -p/b) the speed is 2 sqrt(b), and along the edge sqrt(b). The principle adds L(T) = -|L| n and that
t m - L is along p.

Limitations: the band is seen as flat, with p the rotation vector and v the rate in the frame halfway
between goal and body; what this neglects is of the order of b^2, 0.4 % of the band's part of the time
at 180 deg and 2 %. |L| is rounded off by SMOOTH near zero, where the command turns over. The
guesses are drawn: a shorter extremal may exist.

Source: L. S. Pontryagin et al., The Mathematical Theory of Optimal Processes, 1962; the target of
the band is ours. Tests hold both against collocations that share no code with them.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

STEPS = 80
"""Steps of the Runge-Kutta method from 0 to T, for speeds up to 8 sqrt(a)."""

ROUNDS = 40
"""Steps of the Levenberg-Marquardt method from each guess, at most."""

STALLED = 8
"""Steps on end that improve nothing, after which a guess is given up."""

SMOOTH = 1e-3
"""Length under the root of |L|^2 + SMOOTH^2; the length of (L(0), N) is 1."""

SOLVED = 1e-10
"""Greatest sum of squares of what is missing at T: in rad and sqrt(a), or over the band."""

GUESSED_TIMES = (0.9, 3.0)
"""Between which a time is guessed, over a lower bound. To brake and return takes 2.4 times the braking."""

DIFFERENCE = 1e-6
MOST_STEP = 0.5
CHUNK = 512
"""Guesses that are improved together: their arrays stay in a processor's cache."""

UNKNOWNS = 7
IDENTITY = np.eye(UNKNOWNS)
COLUMN = np.newaxis


class Bodies(NamedTuple):
    """Bodies at their starts, one a column, in units of 1/sqrt(a) and rad.

    Attributes:
        quat: The turn from the goal to the body, w, x, y, z; shape (4, n).
        omega: The angular velocity, base frame; shape (3, n).
        band: Half width of the settling band; shape (n,).
    """

    quat: np.ndarray
    omega: np.ndarray
    band: np.ndarray

    def take(self, places: np.ndarray | slice) -> "Bodies":
        """Return some of the bodies."""
        return Bodies(*(values[..., places] for values in self))


class MotionEnds(NamedTuple):
    """The ends of motions: the turn q, omega and L, one a column."""

    quat: np.ndarray
    omega: np.ndarray
    L: np.ndarray


Target = Callable[[Bodies, np.ndarray, MotionEnds], np.ndarray]
"""What is missing of a target with these unknowns and ends; shape (any, n)."""


def draw_guesses(shortest: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    """Draw a guess of L(0), N and log T for each shortest time; shape (7, n)."""
    count = len(shortest)
    costates = rng.standard_normal((6, count))
    costates /= np.linalg.norm(costates, axis=0)
    times = shortest * rng.uniform(*GUESSED_TIMES, count)
    return np.vstack([costates, np.log(times)])


def improve(
    bodies: Bodies,
    unknown: np.ndarray,
    target: Target,
    rounds: int = ROUNDS,
    steps: int = STEPS,
) -> tuple[np.ndarray, np.ndarray]:
    """Return the unknowns, each improved on its own, and the sum of squares of what is missing.

    Args:
        bodies: one for each guess.
        unknown: L(0), N and log T of each guess; shape (7, n).
        target: what is missing at the end.
        rounds: steps of the method of Levenberg and Marquardt; the derivatives are differences.
        steps: of the integration.
    """
    improved = np.array(unknown)
    missing = np.empty(improved.shape[1])
    # A guess may run away; its missing is then infinite, and its step is none.
    with np.errstate(over="ignore", invalid="ignore"):
        for first in range(0, len(missing), CHUNK):
            part = slice(first, first + CHUNK)
            improved[:, part], missing[part] = improve_chunk(
                bodies.take(part),
                unknown[:, part],
                target,
                rounds=rounds,
                steps=steps,
            )
    return improved, missing


def improve_chunk(
    bodies: Bodies,
    unknown: np.ndarray,
    target: Target,
    rounds: int,
    steps: int,
) -> tuple[np.ndarray, np.ndarray]:
    """Improve unknowns as `improve` does, all at once."""
    unknown = np.array(unknown)
    missing = square(find_missing(bodies, unknown, target, steps))
    damping = np.full(len(missing), 1e-2)
    failures = np.zeros(len(missing), dtype=int)
    for _ in range(rounds):
        is_open = (missing > SOLVED) & (failures < STALLED)
        live = np.flatnonzero(is_open)
        if not len(live):
            break
        those = bodies.take(live)
        before = unknown[:, live]
        slopes, lacking = differentiate(those, before, target, steps)
        step = find_step(slopes, lacking, damping[live])
        after = before + np.clip(step, -MOST_STEP, MOST_STEP)
        left = square(find_missing(those, after, target, steps))
        is_better = left < missing[live]
        unknown[:, live] = np.where(is_better, after, before)
        missing[live] = np.where(is_better, left, missing[live])
        failures[live] = np.where(is_better, 0, failures[live] + 1)
        factor = np.where(is_better, 1.0 / 6.0, 6.0)
        damping[live] = np.clip(factor * damping[live], 1e-12, 1e6)
    return unknown, missing


def differentiate(
    bodies: Bodies, unknown: np.ndarray, target: Target, steps: int
) -> tuple[np.ndarray, np.ndarray]:
    """Return the derivatives of what is missing, shape (n, any, 7), and what is, shape (n, any)."""
    count = unknown.shape[1]
    moves = DIFFERENCE * np.hstack([np.zeros((UNKNOWNS, 1)), IDENTITY])
    beside = unknown[:, COLUMN, :] + moves[:, :, COLUMN]
    copies = np.tile(np.arange(count), UNKNOWNS + 1)
    flat = beside.reshape(UNKNOWNS, -1)
    missing = find_missing(bodies.take(copies), flat, target, steps)
    missing = missing.reshape(-1, UNKNOWNS + 1, count)
    lacking = missing[:, 0]
    slopes = (missing[:, 1:] - missing[:, :1]) / DIFFERENCE
    return np.moveaxis(slopes, 2, 0), lacking.T


def find_step(slopes: np.ndarray, lacking: np.ndarray, damping: np.ndarray) -> np.ndarray:
    """Solve (J^T J + damping D) step = -J^T missing of each guess; D is the diagonal of J^T J."""
    transposed = np.swapaxes(slopes, 1, 2)
    normal = transposed @ slopes
    gradient = transposed @ lacking[:, :, COLUMN]
    is_finite = np.isfinite(normal).all(axis=(1, 2)) & np.isfinite(gradient).all(axis=(1, 2))
    normal[~is_finite] = IDENTITY
    gradient[~is_finite] = 0.0
    diagonal = np.einsum("nii->ni", normal) + 1e-3
    weights = damping[:, COLUMN] * diagonal
    damped = normal + weights[:, :, COLUMN] * IDENTITY
    step = np.linalg.solve(damped, gradient)
    return -step[:, :, 0].T


def find_missing(bodies: Bodies, unknown: np.ndarray, target: Target, steps: int) -> np.ndarray:
    """Return what is missing of a target, and |(L(0), N)|^2 - 1, which fixes the costates' size."""
    end = follow(bodies, unknown, steps)
    size = np.sum(unknown[:6] ** 2, axis=0) - 1.0
    return np.vstack([target(bodies, unknown, end), size])


def miss_rest(bodies: Bodies, unknown: np.ndarray, end: MotionEnds) -> np.ndarray:
    """Return what is missing to rest at the goal: the rotation vector and omega."""
    return np.vstack([rotation_vector(end.quat), end.omega])


def miss_band(bodies: Bodies, unknown: np.ndarray, end: MotionEnds) -> np.ndarray:
    """Return what is missing to an arrival in the band for good, as the module has it.

    All is over the band, and nothing is over |p|: so that a guess that misses by several bands is led to it.
    """
    place = rotation_vector(end.quat)
    across = cross(place, end.omega)
    # Half of the turn, to the second order: the frame in which p and p' = v are parallel for a
    # straight way in, and in which p'' = u up to terms of the order of |p|^2.
    velocity = end.omega - 0.5 * across + 0.125 * cross(place, across)
    outward = -end.L / length(end.L)
    time = np.sum(velocity * outward, axis=0)
    touching = place + velocity * time - (0.5 * time**2 + bodies.band) * outward
    speed_squared = np.sum(velocity**2, axis=0)
    excess = speed_squared - 0.75 * time**2 - bodies.band
    m = unknown[3:6] - cross(end.omega, end.L)
    transverse = cross(time * m - end.L, place)
    # The touching lies ahead.
    late = np.minimum(time, 0.0) * np.sqrt(bodies.band)
    return np.vstack([touching, excess, transverse, late]) / bodies.band


def follow(bodies: Bodies, unknown: np.ndarray, steps: int = STEPS) -> MotionEnds:
    """Return the ends of the extremals that begin with the unknowns, by the Runge-Kutta method."""
    N = unknown[3:6]
    step = np.exp(unknown[6]) / steps
    state = np.vstack([bodies.quat, bodies.omega, unknown[:3]])
    for _ in range(steps):
        slope = find_rates(state, N)
        total = slope.copy()
        slope = find_rates(state + 0.5 * step * slope, N)
        total += 2.0 * slope
        slope = find_rates(state + 0.5 * step * slope, N)
        total += 2.0 * slope
        slope = find_rates(state + step * slope, N)
        total += slope
        state = state + (step / 6.0) * total
    return MotionEnds(state[:4], state[4:7], state[7:])


def find_rates(state: np.ndarray, N: np.ndarray) -> np.ndarray:
    """Return the rates of q, omega and L along an extremal; shape (10, n)."""
    w, x, y, z = state[:4]
    omega_x, omega_y, omega_z = omega = 0.5 * state[4:7]
    L = state[7:]
    rates = np.empty_like(state)
    rates[0] = -(omega_x * x + omega_y * y + omega_z * z)
    rates[1] = omega_x * w + omega_y * z - omega_z * y
    rates[2] = omega_y * w + omega_z * x - omega_x * z
    rates[3] = omega_z * w + omega_x * y - omega_y * x
    L_squared = np.sum(L * L, axis=0)
    rates[4:7] = L / np.sqrt(L_squared + SMOOTH**2)
    rates[7:] = 2.0 * cross(omega, L) - N
    return rates


def rotation_vector(quat: np.ndarray) -> np.ndarray:
    """Return the rotation vector of a small turn: 2 arcsin of the vector part's length, as a series.

    At 0.13 rad it is right to 1e-9 rad; far from the goal it is only a direction and a size.
    """
    sign = np.where(quat[0] < 0.0, -1.0, 1.0)
    vector = sign * quat[1:]
    squared = np.sum(vector * vector, axis=0)
    return vector * (2.0 + squared / 3.0 + 0.15 * squared**2)


def cross(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Return the cross products of columns."""
    product = np.empty_like(right)
    product[0] = left[1] * right[2] - left[2] * right[1]
    product[1] = left[2] * right[0] - left[0] * right[2]
    product[2] = left[0] * right[1] - left[1] * right[0]
    return product


def length(vectors: np.ndarray) -> np.ndarray:
    """Return the lengths of columns; above 0, because what is divided by them may vanish."""
    return np.sqrt(np.sum(vectors * vectors, axis=0) + 1e-20)


def square(missing: np.ndarray) -> np.ndarray:
    """Return the sums of squares of columns; infinite where one is not a number."""
    sums = np.sum(missing * missing, axis=0)
    return np.nan_to_num(sums, nan=np.inf)
