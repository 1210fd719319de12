"""Records of a hand in contact that are made up, whose metrics are known."""

import numpy as np
from scipy.spatial.transform import Rotation as ScipyRotation

import tasks
from bench.engines.metrics.contact_metric import ContactResponse, Pose
from bench.law.control.contact_controller import hybrid
from tasks.contact import Specification, Trial
from tasks.domains import wrench_probe

ARM = tasks.arm("ur5e")
CARTESIAN = hybrid("hybrid-base", "inverse")
TICKS = 101
TIME = np.linspace(0.0, 1.0, TICKS)


def specification(*held, desired_wrench=(0.0,) * 6) -> Specification:
    """Return an order to hold these rows."""
    return Specification("as given", held, desired_wrench)


def trial(of: Specification, **more) -> Trial:
    """Return a trial of an order at home."""
    return Trial("one", "pose", of, ARM.home, (1.0, 0.0, 0.0, 0.0), **more)


def answered(of: Trial, outcome="done", **arrays) -> ContactResponse:
    """Return a response that rests at the identity but for the arrays given, of as many ticks as its time has."""
    ticks = len(arrays.get("time", TIME))
    blank = {
        "time": TIME,
        "R": np.tile(np.eye(3), (ticks, 1, 1)),
        **dict.fromkeys(("omega", "p", "force", "moment"), np.zeros((ticks, 3))),
        **dict.fromkeys(("gap", "turned", "load"), np.zeros(ticks)),
    }
    return ContactResponse(of, outcome, **(blank | arrays))


def pose(*responses, task=wrench_probe.TASK, controller=CARTESIAN) -> Pose:
    """Return the responses at one pose."""
    return Pose(task, ARM, controller, responses)


def spun(vector) -> np.ndarray:
    """Return orientations that turn evenly by a rotation vector [rad]."""
    return ScipyRotation.from_rotvec(np.outer(TIME, vector)).as_matrix()
