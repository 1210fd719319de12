"""Variations: how the plant differs from the ideal arm, and from the arm that its controller computes with.

    nominal       the arm as it is: motors cut at the rated torque, and at the rate of change that its file may state;
                  stops at the ends of joint ranges, the hand and the usual motor inertia of the file
    ideal-motors  the paper's assumption: no torque is too large; no stops, no hand, motor inertia as in the file
    mass-s        D -> s D, and gravity and Coriolis torques with it
    links-k       D of links whose inertial parameters are s_i times the model's, s_i in [0.7, 1.3], drawn with seed k

The controller knows hand and motors. In mass-s, links-k and friction-p it computes with the nominal arm. A factor
multiplies the mass and inertia of a link and the reflected motor inertia of its joint; centres of mass and viscous
damping stay.

Dry friction is MuJoCo's frictionloss: up to that torque a joint resists motion. Its solver softens the constraint: a
joint of inertia m that should stay where it is creeps under a torque F at

    v = (1 - d) / d * F / (m b),   b = 2 / (d T)   [rad/s]      (1/m is dof_invweight0)

With MuJoCo's own d = .9 and T = .02 s the UR5e's wrist creeps some .01 rad/s; with d = .9999, the most MuJoCo takes,
and T of two ticks, the least, some 1e-6 rad/s, and a joint that slows down is stopped within a tick.

Limitations: T is that of the time step the model has when it is varied; change the step afterwards and it is off.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

if TYPE_CHECKING:
    import mujoco

SPREAD = (0.7, 1.3)  # of the factors of single links: the +-30 % of the uniform ones
IMPEDANCE = 0.9999  # mjMAXIMP
LOW, USUAL, HIGH = range(3)  # of the numbers of an arm's "motors"


class Variation(NamedTuple):
    """One way in which the plant differs from the controller's model."""

    name: str
    title: str
    apply: Callable[[mujoco.MjModel, Sequence[float]], None]
    """apply(model, rated): changes a compiled model of an arm in place; rated torques [N m]. For a fresh model, once,
    before its data are made."""
    believed: str = ""  # the variation that the controller's model is; empty: this one
    lag_s: float = 0.0  # time constant of the motors' torque [s]
    delay_s: float = 0.0  # how late a torque is [s]
    needs_range: bool = False  # whether only arms have it whose file states a range of motor inertia

    def late_ticks(self, dt: float) -> int:
        """Return the delay in control periods; -1 where motors are neither late nor slow."""
        return round(self.delay_s / dt) if self.delay_s or self.lag_s else -1


def numbers_of(model: mujoco.MjModel, name: str) -> np.ndarray | None:
    """Return the data of a <numeric> of this name, None if the model has none."""
    import mujoco

    found = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_NUMERIC, name)
    return None if found < 0 else np.array(model.numeric(found).data)


def _scale_all(factor: float, model: mujoco.MjModel, rated: Sequence[float]) -> None:
    _scale(model, [factor] * model.nv)


def _scale_links(seed: int, model: mujoco.MjModel, rated: Sequence[float]) -> None:
    draw = random.Random(seed)  # documented to give the same numbers in every version of Python
    _scale(model, [draw.uniform(*SPREAD) for _ in range(model.nv)])


def _scale(model: mujoco.MjModel, factors: list[float]) -> None:
    """Scale by a factor a joint its reflected motor inertia and all that moves with it and not with the next one."""
    import mujoco

    for i, factor in enumerate(factors):
        model.dof_armature[i] *= factor
    for body in range(1, model.nbody):
        moving = model.body_weldid[body]  # itself, or the body it is fixed to; 0 is the ground
        if moving:
            factor = factors[model.body_dofadr[moving] + model.body_dofnum[moving] - 1]
            model.body_mass[body] *= factor
            model.body_inertia[body] *= factor
    mujoco.mj_setConst(model, mujoco.MjData(model))  # what MuJoCo derives from them: subtree masses, dof_M0, weights


def _rub(percent: float, model: mujoco.MjModel, rated: Sequence[float]) -> None:
    for i, torque in enumerate(rated):
        model.dof_frictionloss[i] = percent / 100.0 * torque
        model.dof_solref[i] = (2.0 * model.opt.timestep, 1.0)
        model.dof_solimp[i, :2] = IMPEDANCE


def _build(motors: int, model: mujoco.MjModel, rated: Sequence[float]) -> None:
    """Cut motors at their rating, stop joints at their ends, and mount the hand; motors: which of the file's three."""
    import mujoco

    model.actuator_ctrllimited[:] = 1
    model.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_LIMIT)
    armature, hand = numbers_of(model, "motors"), numbers_of(model, "hand")
    if armature is not None:
        model.dof_armature[:] = armature[motors]
    if hand is not None:
        body = model.body("tool").id
        model.body_mass[body], model.body_ipos[body], model.body_inertia[body] = hand[0], hand[1:4], hand[4:]
        model.body_iquat[body], model.body_sameframe[body] = (1.0, 0.0, 0.0, 0.0), 0  # the body's axes, not its origin
    mujoco.mj_setConst(model, mujoco.MjData(model))


def _differing(name: str, title: str, change: Callable[[mujoco.MjModel, Sequence[float]], None]) -> Variation:
    """Return the nominal arm with a change that its controller does not know."""

    def apply(model: mujoco.MjModel, rated: Sequence[float]) -> None:
        _build(USUAL, model, rated)
        change(model, rated)

    return Variation(name, title, apply, "nominal")


VARIATIONS = {
    variation.name: variation
    for variation in (
        Variation("nominal", "Motors cut at their rating, joints with stops; exact model", partial(_build, USUAL)),
        Variation("ideal-motors", "No torque is too large, no joint ends: the paper's assumption", lambda *_: None),
        Variation("motors-low", "The least motor inertia of the arm's file", partial(_build, LOW), needs_range=True),
        Variation(
            "motors-high", "The greatest motor inertia of the arm's file", partial(_build, HIGH), needs_range=True
        ),
        Variation("motors-slow", "Torque follows with a time constant of 5 ms", partial(_build, USUAL), lag_s=5e-3),
        Variation("motors-late", "Torque comes 5 ms late", partial(_build, USUAL), delay_s=5e-3),
        _differing("mass-0.70", "Links and rotors 30 % lighter than the model", partial(_scale_all, 0.70)),
        _differing("mass-0.85", "Links and rotors 15 % lighter than the model", partial(_scale_all, 0.85)),
        _differing("mass-1.15", "Links and rotors 15 % heavier than the model", partial(_scale_all, 1.15)),
        _differing("mass-1.30", "Links and rotors 30 % heavier than the model", partial(_scale_all, 1.30)),
        _differing("links-1", "Each link up to 30 % lighter or heavier, first draw", partial(_scale_links, 1)),
        _differing("links-2", "Each link up to 30 % lighter or heavier, second draw", partial(_scale_links, 2)),
        _differing("links-3", "Each link up to 30 % lighter or heavier, third draw", partial(_scale_links, 3)),
        _differing("friction-2", "Dry friction, 2 % of each rated torque", partial(_rub, 2.0)),
        _differing("friction-5", "Dry friction, 5 % of each rated torque", partial(_rub, 5.0)),
        _differing("friction-10", "Dry friction, 10 % of each rated torque", partial(_rub, 10.0)),
    )
}
