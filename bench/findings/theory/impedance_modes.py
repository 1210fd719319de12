"""Modes of an impedance without inertia shaping about the goal, from the arm's own matrices.

    Lambda xddot + D xdot + K x = 0,  Lambda = (J M^-1 J^T)^-1          K phi = omega^2 Lambda phi
    ratio = phi^T D phi/(2 omega phi^T Lambda phi)

With double diagonalization it is zeta in every mode. D = 2 zeta sqrt(K) on the diagonal makes sqrt(K/Lambda) the
frequency and zeta/sqrt(Lambda) the ratio of an axis that is alone; its fastest pole is D/Lambda, so that a tick of dt
is unstable from some D dt/Lambda = 2 on, whatever the stiffness. Friction of the joints, B, adds J M^-1 B J^+.

`longest_tick` and `longest_delay` are limits of the loop that was run: MuJoCo takes the new rates for the way of a
tick, and `longest_delay` half a tick of age for the rates. An arm is no such integrator. `longest_held_tick` and
`longest_held_delay` are of an arm whose command is held and which moves exactly in between:

    x -> x + dt v + dt^2/2 u,  v -> v + dt u,  u = -(P x + Q v) of the tick, or of an earlier one

Limitations: where J loses rank; says nothing of errors that are not small.
Source: Albu-Schaeffer, Ott, Frese, Hirzinger 2003.
"""

import functools
from typing import Any, NamedTuple

import numpy as np
import pandas as pd
from scipy.linalg import eigh

import tasks
from bench.base.bisection import bisect
from bench.engines.arm_episode import buffers
from bench.law.control.unshaped import DAMPINGS
from tasks.kinematics import Kinematics

Stiffness = tuple[float, float]
"""Stiffness of translation [N/m] and of rotation [N m/rad]."""

FREQUENCIES = 4_000
"""At which a delayed loop is looked at: they are 0.2 % apart."""
ANGLES = np.geomspace(1e-3, np.pi, 1_000)
"""Angles of z on the unit circle at which a held loop is looked at; the crossings are interpolated."""
ITERATIONS = 30
"""Greatest number of iterations for the delay of a held loop."""

DESIGN = ["arm", "variation", "damping", "stiffness_n_m", "stiffness_nm_rad", "zeta", "dt_s"]
"""The columns that decide modes and limits."""

LIMITS = ("longest_dt_s", "radius", "longest_delay_s")


class Hand(NamedTuple):
    """Lambda^-1 of an arm at its home, 6 x 6, and what the joints' friction does to the hand, J M^-1 B J^+ [1/s]."""

    mobility: np.ndarray
    friction: np.ndarray


def hand_of(name: str, variation: str = "ideal-motors") -> Hand:
    """Return the hand of an arm at its home."""
    arm = tasks.arm(name)
    judge = Kinematics(arm)
    tasks.variation(variation).apply(judge.model, arm.rated)
    J, friction = judge.jacobian(arm.home), np.diag(judge.model.dof_damping)
    by_joints = np.linalg.inv(judge.inertia_matrix(arm.home))
    return Hand(J @ by_joints @ J.T, J @ by_joints @ friction @ np.linalg.pinv(J))


def hand_matrices(hand: Hand, damping: str, stiffness: Stiffness, zeta: float) -> tuple[np.ndarray, np.ndarray]:
    """Compute P = Lambda^-1 K [1/s^2] and Q = Lambda^-1 D and friction's [1/s], D of a design."""
    D, diagonal = np.zeros((6, 6)), np.repeat(stiffness, 3)
    DAMPINGS[damping].design(diagonal, np.linalg.inv(hand.mobility), zeta, D, buffers(7).scratch)
    return hand.mobility * diagonal, hand.mobility @ D + hand.friction


def longest_tick(P: np.ndarray, Q: np.ndarray) -> float:
    """Return the control period [s] above which the loop is unstable, to a nanosecond: 2/(D/Lambda) or less."""
    return bisect(lambda dt: compute_radius(P, Q, dt) < 1.0, 0.0, 1.0, halvings=30)[0]


def longest_delay(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Return the delay [s] above which det(s^2 + e^(-s tau) (P + s e^(-s dt/2) Q)) has a zero with Re s > 0.

    The rates of a tick are on average half a tick old. At the limit s = i omega, where an eigenvalue of
    -(P + s e^(-s dt/2) Q)/s^2 is e^(s tau).
    """
    omega = np.geomspace(1.0, np.pi / dt, FREQUENCIES)
    s = 1j * omega[:, None, None]
    values = np.linalg.eigvals(-(P + s * np.exp(-0.5 * dt * s) * Q) / s**2)
    late = (np.angle(values) % (2.0 * np.pi)) / omega[:, None]
    return float(late[np.abs(np.log(np.abs(values))) < 3.0 / FREQUENCIES * np.log(omega[-1])].min(initial=np.inf))


def longest_held_tick(P: np.ndarray, Q: np.ndarray) -> float:
    """Return the control period [s] above which the loop with an exact hold is unstable, to a nanosecond."""
    return bisect(lambda dt: compute_held_radius(P, Q, dt) < 1.0, 0.0, 1.0, halvings=30)[0]


def compute_held_radius(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Compute the greatest |eigenvalue| of the map of (x, v) over one period of an exact hold."""
    identity = np.eye(len(P))
    tick = np.block(
        [
            [identity - 0.5 * dt * dt * P, dt * identity - 0.5 * dt * dt * Q],
            [-dt * P, identity - dt * Q],
        ]
    )
    return float(np.abs(np.linalg.eigvals(tick)).max())


def longest_held_delay(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Return the delay [s] above which the loop with an exact hold is unstable; NaN if it is so without delay.

    A delay is m + d periods, d in [0, 1). The command of a tick moves the arm by the hold's response

        v = dt z^-m ((1 - d) + d/z)/(z - 1) u,   x = dt^2 z^-m ((1 - d)^2 z/2 + 1/2 + d - d^2 + d^2/(2 z))/(z - 1)^2 u

    At the limit an eigenvalue of -(P x + Q v)/u without z^-m is z^m for a z = exp(i phi). The delay m + d that belongs
    to d hardly depends on d: the fixed point is found by iteration.
    """
    if compute_held_radius(P, Q, dt) >= 1.0:
        return np.nan
    periods = 0.0
    for _ in range(ITERATIONS):
        before, periods = periods, least_crossing(P, Q, dt, periods % 1.0)
        if not np.isfinite(periods) or abs(periods - before) < 1e-6:
            break
    return dt * periods


def least_crossing(P: np.ndarray, Q: np.ndarray, dt: float, d: float) -> float:
    """Return the least delay [periods] at which some z has modulus one, if d is the part of it beside whole periods."""
    z = np.exp(1j * ANGLES)[:, None, None]
    rate = dt * ((1.0 - d) + d / z) / (z - 1.0)
    place = dt * dt * (0.5 * (1.0 - d) ** 2 * z + 0.5 + d - d * d + 0.5 * d * d / z) / (z - 1.0) ** 2
    values = np.linalg.eigvals(-(P * place + Q * rate))
    order = np.argsort(np.abs(values), axis=1)
    moduli = np.log(np.take_along_axis(np.abs(values), order, axis=1))
    angles = np.angle(np.take_along_axis(values, order, axis=1))
    # Whole turns are taken off after the part d of a period has been added: a small delay is not a turn more.
    delays = ((angles + d * ANGLES[:, None]) % (2.0 * np.pi)) / ANGLES[:, None]
    crosses = (moduli[:-1] >= 0.0) != (moduli[1:] >= 0.0)
    share = moduli[:-1] / (moduli[:-1] - moduli[1:])
    return float((delays[:-1] + share * np.diff(delays, axis=0))[crosses].min(initial=np.inf))


def compute_modes(P: np.ndarray, Q: np.ndarray, mobility: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute natural frequencies [1/s] in ascending order, and their damping ratios, with P = mobility K."""
    Lambda = np.linalg.inv(mobility)
    squares, phi = eigh(Lambda @ P, 0.5 * (Lambda + Lambda.T))  # phi^T Lambda phi = 1
    omega = np.sqrt(squares)
    return omega, np.diag(phi.T @ Lambda @ Q @ phi) / (2.0 * omega)


def compute_radius(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Compute the greatest |z| with det(z^2 + z (dt Q + dt^2 P - 2) + 1 - dt Q) = 0.

    They are the poles of v+ = v - dt (P x + Q v), x+ = x + dt v+, MuJoCo's rates first.
    """
    one = np.eye(len(P))
    companion = np.block([[np.zeros_like(P), one], [dt * Q - one, 2.0 * one - dt * Q - dt * dt * P]])
    return float(np.abs(np.linalg.eigvals(companion)).max())


def with_exact_hold(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of impedance-modes.parquet with the limits of an exact hold: `held_dt_s`, `held_delay_s`."""
    groups = [
        group.assign(**_find_held_limits(*key)) for key, group in rows.groupby(DESIGN, observed=True, sort=False)
    ]
    return pd.concat(groups) if groups else rows


def with_theory(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of impedance-modes.parquet with theory's omega, ratio, radius and limits: `omega_theory`, ..."""
    found = []
    for key, group in rows.groupby(DESIGN, observed=True, sort=False):
        theory, places = _compute_theory(*key), group["mode"].to_numpy() - 1
        by_mode = {f"{name}_theory": theory[name][places] for name in ("omega", "ratio")}
        found.append(group.assign(**by_mode, **{f"{name}_theory": theory[name] for name in LIMITS}))
    return pd.concat(found) if found else rows


@functools.cache
def _find_held_limits(
    arm: str, variation: str, damping: str, translation: float, rotation: float, zeta: float, dt: float
) -> dict[str, float]:
    """Find the limits of a design with an exact hold."""
    P, Q = hand_matrices(hand_of(str(arm), str(variation)), str(damping), (translation, rotation), zeta)
    return {"held_dt_s": longest_held_tick(P, Q), "held_delay_s": longest_held_delay(P, Q, dt)}


@functools.cache
def _compute_theory(
    arm: str, variation: str, damping: str, translation: float, rotation: float, zeta: float, dt: float
) -> dict[str, Any]:
    """Compute the modes and the limits of a design; tables of the same designs share them."""
    hand = hand_of(str(arm), str(variation))
    P, Q = hand_matrices(hand, str(damping), (translation, rotation), zeta)
    omega, ratio = compute_modes(P, Q, hand.mobility)
    limits = (longest_tick(P, Q), compute_radius(P, Q, dt), longest_delay(P, Q, dt))
    return {"omega": omega, "ratio": ratio, **dict(zip(LIMITS, limits, strict=True))}
