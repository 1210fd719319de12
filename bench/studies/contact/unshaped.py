"""Impedance without inertia shaping, pressed on planes of any stiffness: does it settle, and where does energy go?

The hand is told to be deeper than the plane by what its spring makes FORCE_N of. No force is measured, so that none is
late. Energy: V(t) - V(0) = -damped - elbow - given, V of springs and motion, given through the port of the hand.
"""

import numpy as np

from bench.contenders.registry import known_dampings
from bench.control.unshaped import NULL_RATE
from bench.engines.arm_episode import buffers
from bench.engines.contact_episode import USUAL
from bench.experiments.impedance import STIFFNESSES, ZETA, Stiffness
from bench.findings.theory.impedance_modes import diagonal
from bench.studies.contact.admittance import FORCE_N, calms
from bench.studies.contact.pressing import Tick, press

ARMS = ("panda", "puma560", "ur5e")
PLANES = (1e3, 1e6)
"""Stiffness [N/m]: the least and the greatest of the study."""
HORIZON_S = 4.0
GAP_M = 1e-3
"""Between the tip and the plane at the start."""


def rows() -> list[dict]:
    """A row an arm, design of damping, stiffness of the springs and of the plane."""
    return [
        {
            "arm": arm,
            "damping": name,
            "stiffness": springs.translation,
            "plane": plane,
            **pressed(arm, name, springs, plane),
        }
        for arm in ARMS
        for name in known_dampings()
        for springs in STIFFNESSES
        for plane in PLANES
    ]


def pressed(arm: str, damping: str, springs: Stiffness, plane: float) -> dict:
    """Whether it settles, force at the end [N], energy stored at first, given at most, and what is unaccounted [J]."""
    K, D, design, scratch = diagonal(springs), np.zeros((6, 6)), known_dampings()[damping].design, buffers(7).scratch
    deeper = np.zeros(6)
    deeper[2] = -GAP_M - FORCE_N / springs.translation
    powers = []

    def torque(now: Tick) -> np.ndarray:
        Lambda = np.linalg.inv(now.J @ np.linalg.solve(now.M, now.J.T))
        design(K, Lambda, ZETA, D, scratch)
        damp = D @ now.twist
        elbow = NULL_RATE * (now.M @ now.qdot - now.J.T @ Lambda @ now.twist) if len(now.qdot) > 6 else 0.0 * now.qdot
        powers.append((damp @ now.twist, elbow @ now.qdot))
        return now.J.T @ (K * (now.error + deeper) - damp) - elbow + now.gravity

    ticks = press(arm, plane, torque, HORIZON_S)
    force = np.array([now.wrench[2] for now in ticks])
    stored = np.array([energy(now, K, deeper) for now in ticks])
    taken = np.array(powers).sum(axis=1)
    # a wrench that a tick records acted from the tick before to it
    twist = np.array([now.twist for now in ticks])
    along = 0.5 * (twist[1:] + twist[:-1])
    given = -USUAL.dt_s * np.cumsum((np.array([now.wrench for now in ticks])[1:] * along).sum(axis=1))
    damped = USUAL.dt_s * np.cumsum(0.5 * (taken[1:] + taken[:-1]))
    gap = stored[1:] + damped + given - stored[0]
    return {
        "settles": len(ticks) == round(HORIZON_S / USUAL.dt_s) and calms(force),
        "force": float(force[-1]),
        "stored": float(stored[0]),
        "given": float(max(0.0, given.max())),
        "unaccounted": float(np.abs(gap).max() / stored[0]),
    }


def energy(now: Tick, K: np.ndarray, deeper: np.ndarray) -> float:
    """Of springs and motion [J]."""
    off = now.error + deeper
    return float(0.5 * (off @ (K * off) + now.qdot @ now.M @ now.qdot))
