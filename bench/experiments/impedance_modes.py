"""Modes of impedances that shape no inertia, from one tick of the loop about the goal.

    (q, qdot) -> (q, qdot) one tick later, by central differences          qdot+ = qdot - dt (X q + Y qdot)
    P = J X J^+ = Lambda^-1 K,  Q = J Y J^+ = Lambda^-1 D                  as the hand sees it

P phi = omega^2 phi; with psi the left eigenvector the mode's damping ratio is psi Q phi/(2 omega psi phi). The tick's
map of the hand is [[I - dt^2 P, dt (I - dt Q)], [-dt P, I - dt Q]], MuJoCo's rates first.
"""

from __future__ import annotations

import itertools

import numpy as np

import tasks
from bench.base.bisection import bisect
from bench.experiments.experiment import Experiment, Unit
from bench.experiments.impedance import LAW, STIFFNESSES, ZETA, Stiffness, prepare, setting_columns, units_on_arms
from bench.experiments.request import Request
from bench.law.contenders.registry import find_contender
from bench.law.control.unshaped import DAMPINGS

STEP = 1e-4
"""Steps of the differences [rad, rad/s]: they err by its square, 1e-8, and by rounding over it and the tick, 1e-9."""

SHIPPED = {
    "libfranka, example": Stiffness(150.0, 10.0),
    "franka_ros, example": Stiffness(200.0, 10.0),
    "crisp_controllers": Stiffness(500.0, 30.0),
    "frankapy": Stiffness(600.0, 50.0),
}
"""Defaults for Pandas with D = 2 sqrt(K), from the sources that bench/law/contenders/shipped names."""
ANGLES = np.geomspace(1e-4, np.pi, 400)
"""Angles of z on the unit circle at which a delayed loop is looked at."""

DESIGN_S = 0.02
"""CPU seconds a design of damping on an arm."""


def units(request: Request) -> tuple[Unit, ...]:
    """Return the designs on arms."""
    return units_on_arms(request, "impedance-modes")


def rows(request: Request, unit: Unit) -> list[dict]:
    """Return one row a mode."""
    every = map(tasks.variation, tasks.variation_names(unit.arm))
    plants = [one.name for one in every if not one.believed and one.late_ticks(request.dt_s) < 0]
    found = []
    stiffnesses = dict.fromkeys((*STIFFNESSES, *(SHIPPED.values() if unit.arm == "panda" else ())))
    for plant, stiffness in itertools.product(plants, stiffnesses):
        P, Q = hand_matrices(request, unit, stiffness, plant)
        radius = compute_tick_radius(P, Q, request.dt_s)
        delay = find_longest_delay(P, Q, request.dt_s) if radius < 1.0 else np.nan
        loop = {"variation": plant, "dt_s": request.dt_s, "longest_dt_s": find_longest_tick(P, Q)}
        loop |= {"longest_delay_s": delay, "radius": radius}
        for mode, (omega, ratio) in enumerate(zip(*compute_modes(P, Q), strict=True), start=1):
            found.append({**setting_columns(unit, stiffness), **loop, "mode": mode, "omega": omega, "ratio": ratio})
    return found


def hand_matrices(request: Request, unit: Unit, stiffness: Stiffness, plant: str) -> tuple[np.ndarray, np.ndarray]:
    """Compute P [1/s^2] and Q [1/s], 6 x 6, at the arm's home."""
    from bench.engines.plants.impedance import Springs
    from bench.engines.simulate_arms import run_impedance as run
    from tasks.kinematics import kinematics

    arm = tasks.arm(unit.arm)
    judge, n, dt = kinematics(arm), arm.joints, request.dt_s
    p, quat = judge.pose(arm.home)
    offsets = STEP * np.vstack((np.eye(2 * n), -np.eye(2 * n)))
    states = np.hstack((arm.home, np.zeros(n))) + offsets
    begun = [judge.start("", one[:n], quat, one[n:], goal_p=tuple(p.tolist())) for one in states]
    limits = request.limits(dt)._replace(ticks=1)
    law, damping, springs = find_contender(LAW), DAMPINGS[unit.selector], Springs(*stiffness, ZETA, 0)
    _, ends = run(law, damping, springs, begun, limits, unit.arm, plant)
    tick = (ends[: 2 * n] - ends[2 * n :]).T / (2.0 * STEP)
    J = judge.jacobian(arm.home)
    J_inverse = np.linalg.pinv(J)
    X, Y = -tick[n:, :n] / dt, (np.eye(n) - tick[n:, n:]) / dt
    return J @ X @ J_inverse, J @ Y @ J_inverse


def compute_modes(P: np.ndarray, Q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Compute natural frequencies [1/s] in ascending order, and their damping ratios."""
    squares, phi = np.linalg.eig(P)
    order = np.argsort(squares.real)
    omega, phi = np.sqrt(squares.real[order]), phi.real[:, order]
    psi = np.linalg.inv(phi)
    return omega, np.diag(psi @ Q @ phi) / (2.0 * omega)


def find_longest_tick(P: np.ndarray, Q: np.ndarray) -> float:
    """Return the control period [s] above which some error grows, to a nanosecond."""
    return bisect(lambda dt: compute_tick_radius(P, Q, dt) < 1.0, 0.0, 1.0, halvings=30)[0]


def find_longest_delay(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Return the delay of the command [s] above which some error grows; with none the loop is stable.

    At the limit det((z - 1)^2 z^d + dt (Q (z - 1) + dt z P)) = 0 for a z = exp(i phi): an eigenvalue mu of
    -dt (Q (z - 1) + dt z P)/(z - 1)^2 has |mu| = 1, and d = arg(mu)/phi.
    """
    z = np.exp(1j * ANGLES)[:, None, None]
    mu = np.linalg.eigvals(-dt * (Q * (z - 1.0) + dt * z * P) / (z - 1.0) ** 2)
    order = np.argsort(np.abs(mu), axis=1)
    moduli = np.take_along_axis(np.abs(mu), order, axis=1)
    ticks = np.take_along_axis(np.angle(mu) % (2.0 * np.pi), order, axis=1) / ANGLES[:, None]
    crosses = (moduli[:-1] >= 1.0) & (moduli[1:] < 1.0)
    share = np.log(moduli[:-1]) / np.log(moduli[:-1] / moduli[1:])
    return dt * float((ticks[:-1] + share * np.diff(ticks, axis=0))[crosses].min(initial=np.inf))


def compute_tick_radius(P: np.ndarray, Q: np.ndarray, dt: float) -> float:
    """Compute the greatest |eigenvalue| of the map, 12 x 12, of the hand's place and rate over one tick."""
    after = np.eye(6) - dt * Q
    tick = np.block([[np.eye(6) - dt * dt * P, dt * after], [-dt * P, after]])
    return float(np.abs(np.linalg.eigvals(tick)).max())


EXPERIMENT = Experiment.of(
    globals(),
    "modes of impedance without inertia shaping",
    takes=("tasks", "arms"),
    prepare=prepare,
    cost_s=lambda unit: DESIGN_S,
    compiles=False,
)
