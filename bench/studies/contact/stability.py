"""A tip pressed on a level plane of any stiffness, by a sensor that is late: does it settle?

The boundary is found by bisection of the stiffness for each delay, and held against findings/theory.
"""

import functools
import math
from collections.abc import Callable

import mujoco
import numpy as np

import tasks
from bench.base.bisection import bisect
from bench.engines.contact_episode import FORCE, USUAL, Ended, Sensor
from bench.engines.simulate_contact import run_contact as run
from bench.findings.theory.contact_stability import Spring, acceleration, settles
from bench.law.control.registry import find_controller
from bench.law.control.setpoint import TOUCH
from tasks.arm_model import Arm
from tasks.contact_model import STANDARD, ContactModel, mobilities, model_xml

ARM = "ur5e"
CONTROLLERS = (
    ("hybrid-base+transpose", TOUCH.kf),
    ("hybrid-base+transpose", 2.0),
    ("hybrid-base+inverse", TOUCH.kf),
    ("impedance-geometric", TOUCH.kf),
)
"""Each with its gain on the error of force, which the last two do not have."""

DECADES, LEAST = (3.0, 6.0), 1e3
DELAYS_MS = (0, 1, 2, 3, 5, 7, 10, 15, 20)
HORIZON_S = 3.0
RELAXATION_S = 2e-3
"""Damping over stiffness of what is pressed on: little, so that a controller has to see to it."""
INERTANCE = 0.02
"""dmax of the contact: of an inertance a fiftieth of the hand's own mass, so that a spring is a spring."""
SLICK = 1e-5
"""Friction: none, so that nothing but the controller and the spring damps."""
HALVINGS = 6
"""Halvings of three decades: to a factor of 1.11."""
STEADY = 0.05
"""Share of the force ordered: the largest deviation in the last quarter of an episode that has settled."""


def contact(stiffness: float) -> ContactModel:
    """Return the plane."""
    damping = RELAXATION_S * stiffness
    return STANDARD._replace(stiffness=stiffness, damping=damping, dmin=INERTANCE, dmax=INERTANCE, friction=SLICK)


def pressed(controller: str, kf: float, stiffness: float, delay_s: float) -> Ended:
    """Return the episode; the tip begins a millimetre over the plane."""
    task, arm = tasks.contact_task("force-on-plane")._replace(horizon_s=HORIZON_S), tasks.arm(ARM)
    trial = task.trials(arm)[0]
    trial = trial._replace(specification=trial.specification._replace(velocity=(0.0, 0.0, 0.0)))
    conditions = USUAL._replace(sensor=Sensor(delay_s), touch=TOUCH._replace(kf=kf))
    return next(run("native", find_controller(controller), task, arm, [trial], conditions, contact(stiffness)))


def is_steady(ended: Ended) -> bool:
    """Whether the force is what it will stay."""
    late = ended.record[-len(ended.record) // 4 :, FORCE + 2]
    return ended.outcome == "done" and float(np.ptp(late)) <= STEADY * 15.0 and float(late.min()) > 0.0


def predicted(controller: str, kf: float, stiffness: float, late: int) -> bool:
    """Return what theory says of the same."""
    arm = tasks.arm(ARM)
    spring = Spring(stiffness, RELAXATION_S * stiffness, INERTANCE / (1.0 - INERTANCE) / scale(arm))
    law = acceleration(find_controller(controller), mobility(arm), touch=TOUCH._replace(kf=kf))
    return settles(law, spring, late, USUAL.dt_s)


def scale(arm: Arm) -> float:
    """MuJoCo's own estimate of the hand's mobility [1/kg]."""
    return mobilities(tasks.contact_task("force-on-plane"), arm)["hand"]


@functools.cache
def mobility(arm: Arm) -> float:
    """e_z^T J D^-1 J^T e_z [1/kg] of the tip at the start."""
    task = tasks.contact_task("force-on-plane")
    model = mujoco.MjModel.from_xml_string(model_xml(task, arm, 1e-3))
    data, J, D = mujoco.MjData(model), np.zeros((3, model.nv)), np.zeros((model.nv, model.nv))
    data.qpos[:] = task.trials(arm)[0].q
    mujoco.mj_forward(model, data)
    mujoco.mj_jacSite(model, data, J, None, model.site("hand").id)
    mujoco.mj_fullM(model, data, D)
    return float(J[2] @ np.linalg.solve(D, J[2]))


def boundary(is_stable: Callable[..., bool]) -> float:
    """Return the stiffness [N/m] up to which it is stable: LEAST if never, infinite if everywhere in DECADES."""
    if not is_stable(LEAST):
        return LEAST
    if is_stable(10.0 ** DECADES[1]):
        return math.inf
    return 10.0 ** (0.5 * sum(bisect(lambda decades: is_stable(10.0**decades), *DECADES, HALVINGS)))


def boundaries() -> list[dict]:
    """Return a row a controller and delay: the boundary measured, and by theory [N/m]."""
    return [
        {
            "controller": one,
            "kf": kf,
            "delay_ms": delay,
            "measured": boundary(lambda K, one=one, kf=kf, d=delay: is_steady(pressed(one, kf, K, 1e-3 * d))),
            "theory": boundary(lambda K, one=one, kf=kf, d=delay: predicted(one, kf, K, d)),
        }
        for one, kf in CONTROLLERS
        for delay in DELAYS_MS
    ]
