"""The largest K dt of a first-order law that is held between ticks, omega = K f(R, R_d).

near    Each tick multiplies a small error by I - K dt F, F the derivative of f at the goal: with eigenvalues mu of F
        stable up to 2 Re(mu)/|mu|^2, the least of them; 2 for f = theta k + ..., that is 2 / f'(0).
far     A turn about one axis: no tick makes an angle larger up to the least of 2 theta/f(theta).
lagged  Servos with T qddot = c - qdot and errors that obey e' = -omega, sampled exactly: with a = exp(-dt/T),

            1 - a = b,   z^2 - (1 + a - K (dt - T b)) z + a + K (T b - a dt) = 0

        is stable (Jury) up to the lesser of b/(T b - a dt) and 2 (1 + a)/((1 + a) dt - 2 T b), where positive.
arms    By an inverse X of J the error is multiplied by I - K dt J X: 2 Re(mu)/|mu|^2 over the eigenvalues of J X.

Limitations: far of a law whose axis turns on its way, as on Euler angles; not asked.
"""

import math
from typing import Any

import numpy as np
import pandas as pd

import tasks
from bench.engines.arm_episode import buffers
from bench.law.contender import Contender
from bench.law.contenders.registry import find_contender, inverse
from bench.law.display import Equation
from bench.law.inputs import AT_REST, Goal, Tuning
from bench.law.kinds import Inverse
from bench.law.so3 import IDENTITY, from_quaternion
from tasks.kinematics import kinematics
from tasks.rotations import about

DIFFERENCE_RAD = 1e-5
"""Step of central differences, which err by its square."""

TURNS_RAD = np.linspace(1e-3, math.pi - 1e-3, 400)
"""Angles of which no tick may make one larger."""

SPANNED = 1e-9
"""Eigenvalues smaller than this are of directions that are not commanded at all."""


def by_eigenvalues(F: np.ndarray) -> float:
    """Return the largest K dt at which I - K dt F has no eigenvalue beyond 1 in size; 0 if some error grows at any."""
    mu = np.linalg.eigvals(F)
    mu = mu[np.abs(mu) > SPANNED]
    return max(0.0, float((2.0 * mu.real / np.abs(mu) ** 2).min()))


def near(one: Contender) -> float:
    """Compute the limit near the goal: 2 / f'(0) of a law with an equation, of others by their derivative at I."""
    if one.equation is not None:
        spring = one.equation.spring
        return 2.0 * 2.0 * DIFFERENCE_RAD / (spring(DIFFERENCE_RAD) - spring(-DIFFERENCE_RAD))
    return by_eigenvalues(derivative(one))


def derivative(one: Contender) -> np.ndarray:
    """F of a law without memory, 3 x 3, at the goal I: -f(exp([x]x)) = F x + ..."""
    gains, columns = Tuning(), []
    for axis in np.eye(3):
        ends = (from_quaternion(about(tuple(axis), sign * DIFFERENCE_RAD)) for sign in (1.0, -1.0))
        up, down = (np.array(one.law(R, AT_REST, Goal(IDENTITY), gains)) for R in ends)
        columns.append((down - up) / (2.0 * DIFFERENCE_RAD * gains.kp))
    return np.array(columns).T


def far(equation: Equation, angles: np.ndarray) -> float:
    """Return the least of 2 theta/f(theta) over these angles [rad]; NaN of a law that goes the long way."""
    if equation.the_long_way:
        return math.nan
    return min(2.0 * angle / equation.spring(angle) for angle in map(float, angles))


def lagged(lag_ticks: float) -> float:
    """Return the limit behind servos with a time constant of so many control periods."""
    if lag_ticks == 0.0:
        return 2.0
    a = math.exp(-1.0 / lag_ticks)
    coast = lag_ticks * (1.0 - a)
    bounds = ((1.0 - a) / (coast - a), 2.0 * (1.0 + a) / ((1.0 + a) - 2.0 * coast))
    return min(bound for bound in bounds if bound > 0.0)


def on_arm(arm: str, q: Any, by: Inverse) -> float:
    """Compute the limit of f with F = I, by an inverse at joint angles q [rad], J the judge's."""
    J, n = kinematics(tasks.arm(arm)).jacobian(q), tasks.arm(arm).joints
    columns = []
    for unit in np.eye(6):
        into = buffers(n)
        into.J[:6, :n], into.a[:6] = J, unit
        by.resolve(into.J, into.a, np.eye(n), into.x, 6, n, into.scratch)
        columns.append(into.x[:n].copy())
    return by_eigenvalues(J @ np.array(columns).T)


def with_theory(rows: pd.DataFrame) -> pd.DataFrame:
    """Return rows of velocity-limits.parquet with `k_dt_theory`; NaN where there is none."""
    return rows.assign(k_dt_theory=[float(of_row(row)) for row in rows.to_dict("records")])


def of_row(row: dict) -> float:
    """Return the closed form of one row."""
    law = str(row["contender"]).partition("@")[0]
    if row["arm"]:
        plain = on_arm(row["arm"], tasks.arm(row["arm"]).home, inverse(row["inverse"]))
        return plain if row["lag_ticks"] == 0.0 else lagged(row["lag_ticks"])
    one = find_contender(law)
    if row["reach"] == "near":
        return near(one) / row["share"]
    return far(one.equation, TURNS_RAD) if one.equation else math.nan
