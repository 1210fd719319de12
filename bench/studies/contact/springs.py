"""Springs that hold a tool and let it lie down: what is left of a plate's tilt, by their rotational stiffness."""

import functools
import math
from typing import Any

import numpy as np

import tasks
from bench.engines.metrics.contact.rest import time_to_rest
from bench.engines.metrics.contact.scene import alignment_error
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.simulate_contact import run_contact as run
from bench.law import Gains, kernel
from bench.law.contenders.impedances import geometric
from bench.law.control.contact_controller import ContactController, impedance_controller
from bench.law.control.setpoint import TOUCH
from bench.law.inputs import PAPERS_GAINS

ARMS = ("puma560", "ur5e")
STIFFNESSES = (50.0, 20.0, 10.0, 5.0, 2.0)
"""N m/rad; the first is that of all results."""


def rows() -> list[dict]:
    """Return a row a stiffness, arm and plate: the angle left at rest [deg]."""
    task, found = tasks.contact_task("surface-alignment"), []
    for stiffness in STIFFNESSES:
        for name in ARMS:
            arm, one = tasks.arm(name), softened(stiffness)
            trials = [each for each in task.trials(arm) if each.id.endswith("beta+0")]
            for trial, ended in zip(trials, run("native", one, task, arm, trials), strict=True):
                pose = Pose(task, arm, one, (response(trial, ended),))
                found.append(
                    {
                        "stiffness": stiffness,
                        "arm": name,
                        "trial": trial.id,
                        "tilt_deg": math.degrees(trial.tilt),
                        "left_deg": float(np.degrees(alignment_error(pose))),
                        "rested": ended.rested,
                        "time_to_rest_s": time_to_rest(pose),
                    }
                )
    return found


@functools.cache
def softened(stiffness: float) -> ContactController:
    """Return the impedance on columns of R with this rotational stiffness [N m/rad], otherwise unchanged."""
    share = stiffness / (PAPERS_GAINS.kp * TOUCH.m_o)
    slower, law = math.sqrt(share), geometric.law

    @kernel
    def softer(R: Any, omega: Any, m: Any, R_d: Any, gains: Any, inertia: Any) -> Any:
        return law(R, omega, m, R_d, Gains(share * gains.kp, slower * gains.kv), inertia)

    return impedance_controller(geometric.IMPEDANCE._replace(name=f"geometric-{stiffness:g}", law=softer))
