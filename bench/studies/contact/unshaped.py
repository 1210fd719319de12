"""Impedance without inertia shaping in contact: does it settle, what does it do to the scene, where does energy go?

On a plane the hand's setpoint is deeper by what its spring makes FORCE_N of. No force is measured, so that none is
late. Energy: V(t) - V(0) = -damped - elbow - given, V of springs and motion, given through the port of the hand.

In tasks it is set what impedances with inertia shaping are, at their stiffness, and held against one of them.
"""

import numpy as np

import tasks
from bench.engines.arm_episode import buffers
from bench.engines.contact_episode import USUAL
from bench.engines.metrics.contact.port import given
from bench.engines.metrics.contact.scene import alignment_error, crank_angle, insertion_depth
from bench.engines.metrics.contact_metric import Pose, Response
from bench.engines.metrics.contact_metric import response as response_of
from bench.engines.simulate_contact import run_contact as run
from bench.experiments.impedance import STIFFNESSES, ZETA, Stiffness
from bench.findings.theory.impedance_modes import diagonal
from bench.law.control.contact_controller import ContactController
from bench.law.control.registry import find_controller
from bench.law.control.unshaped import DAMPINGS, NULL_RATE
from bench.studies.contact.admittance import FORCE_N, calms
from bench.studies.contact.by_torque import Tick, Torque, episode, press, response
from tasks.contact import ContactTask

ARMS = ("panda", "puma560", "ur5e")
PLANES = (1e3, 1e6)
"""Stiffness [N/m]: the least and the greatest of the study."""
HORIZON_S = 4.0
GAP_M = 1e-3
"""Between the tip and the plane at the start."""

SHAPED = "impedance-rotation-vector"
"""The impedance with inertia shaping on the same error, of the second of STIFFNESSES."""
SCENES = {
    "surface-alignment": ("tilt 20 about 0, beta+0", alignment_error, 180.0 / np.pi),
    "peg-in-hole": ("", insertion_depth, 1e3),
    "crank": ("", crank_angle, 180.0 / np.pi),
}
"""Task -> its trial (the first where none is named), what is done to the scene, and its unit: degrees, mm."""


def controller(damping: str, springs: Stiffness, deeper: np.ndarray, powers: list) -> Torque:
    """tau = J^T (K e + D (v_d - v) + h) + g; powers: gets what damping and elbow take at each tick [W]."""
    K, D, design, scratch = diagonal(springs), np.zeros((6, 6)), DAMPINGS[damping].design, buffers(7).scratch

    def torque(now: Tick) -> np.ndarray:
        Lambda = np.linalg.inv(now.J @ np.linalg.solve(now.M, now.J.T))
        design(K, Lambda, ZETA, D, scratch)
        damp = -D @ now.rate
        elbow = NULL_RATE * (now.M @ now.qdot - now.J.T @ Lambda @ now.twist) if len(now.qdot) > 6 else 0.0 * now.qdot
        powers.append(damp @ now.twist + elbow @ now.qdot)
        return now.J.T @ (K * (now.error + deeper) - damp + now.wanted) - elbow + now.gravity

    return torque


def rows() -> list[dict]:
    """Return a row an arm, design of damping, stiffness of the springs and of the plane."""
    return [
        {
            "arm": arm,
            "damping": name,
            "stiffness": springs.translation,
            "plane": plane,
            **pressed(arm, name, springs, plane),
        }
        for arm in ARMS
        for name in DAMPINGS
        for springs in STIFFNESSES
        for plane in PLANES
    ]


def pressed(arm: str, damping: str, springs: Stiffness, plane: float) -> dict:
    """Whether it settles, force at the end [N], energy stored at first, given at most [J], and unaccounted over it."""
    deeper = np.zeros(6)
    powers: list[float] = []
    deeper[2] = -GAP_M - FORCE_N / springs.translation
    ticks = press(arm, plane, controller(damping, springs, deeper, powers), HORIZON_S)
    stored = np.array([energy(now, diagonal(springs), deeper) for now in ticks])
    taken, dt = np.array(powers), USUAL.dt_s
    # a wrench that a tick records acted from the tick before to it
    twist, wrench = (np.array([getattr(now, name) for now in ticks]) for name in ("twist", "wrench"))
    out = -dt * np.cumsum((wrench[1:] * 0.5 * (twist[1:] + twist[:-1])).sum(axis=1))
    gap = stored[1:] + dt * np.cumsum(0.5 * (taken[1:] + taken[:-1])) + out - stored[0]
    return {
        "settles": len(ticks) == round(HORIZON_S / dt) and calms(wrench[:, 2]),
        "force": float(wrench[-1, 2]),
        "stored": float(stored[0]),
        "given": float(max(0.0, out.max())),
        "unaccounted": float(np.abs(gap).max() / stored[0]),
    }


def energy(now: Tick, K: np.ndarray, deeper: np.ndarray) -> float:
    """Return the energy of springs and motion [J]."""
    off = now.error + deeper
    return float(0.5 * (off @ (K * off) + now.qdot @ now.M @ now.qdot))


def in_tasks() -> list[dict]:
    """Return a row a task, arm and design of damping; `shaped` names the impedance with inertia shaping."""
    return [
        {"task": task, "arm": arm, "damping": name, **done(task, arm, name)}
        for task in SCENES
        for arm in ARMS
        for name in ("shaped", *DAMPINGS)
    ]


def done(name: str, arm: str, damping: str) -> dict:
    """Return what was done to the scene by HORIZON_S, the most energy given [J], and the speed at the end [mm/s]."""
    words, measure, unit = SCENES[name]
    task = tasks.contact_task(name)._replace(horizon_s=HORIZON_S, rests=False)
    trials = task.trials(tasks.arm(arm))
    trial = next(one for one in trials if one.id == words) if words else trials[0]
    one = find_controller(SHAPED)
    if damping == "shaped":
        [ended] = run("native", one, task, tasks.arm(arm), [trial])
        seen = response_of(trial, ended)
    else:
        ticks = episode(task, arm, trial, controller(damping, STIFFNESSES[1], np.zeros(6), []), HORIZON_S)
        seen = response(trial, ticks, HORIZON_S)
    return {"outcome": seen.outcome, "done": unit * float(measure(pose(task, arm, one, seen))), **ending(seen)}


def pose(task: ContactTask, arm: str, one: ContactController, seen: Response) -> Pose:
    """Return what a metric takes."""
    return Pose(task, tasks.arm(arm), one, (seen,))


def ending(seen: Response) -> dict:
    """Energy given at most, and the speed over the last tenth of a second; nothing of an episode that broke off."""
    if seen.outcome != "done":
        return {"given": np.nan, "speed": np.nan}
    moved = np.linalg.norm(seen.p[-1] - seen.p[-101]) / (100 * USUAL.dt_s)
    return {"given": float(max(0.0, given(seen).max())), "speed": 1e3 * float(moved)}
