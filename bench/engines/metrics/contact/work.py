"""Whether work is conserved where a controller changes the wrench's coordinates (Murphy 1988, 3.10).

m . omega = F_E . Edot        Edot = B^-1 omega, F_E = B^T m (3.12), or what the controller takes for it
"""

import math
from collections.abc import Callable, Iterator

import numpy as np

from bench.engines.metrics.contact_metric import ContactMetric, ContactResponse, Pose
from bench.law.control import hybrid
from bench.law.kinds import Coordinates
from bench.law.so3 import Rotation, from_quaternion, relative, rotate_back

# Ticks of an episode that are looked at, evenly spaced: nothing in a rounding depends on the tick.
TICKS = 16


def work_residual(pose: Pose) -> float:
    """max |m . omega - F_E . Edot| / max |m| |omega| over ticks; NaN without coordinates, moment or motion."""
    controller = pose.controller
    if controller.representation is None or any(one.outcome != "done" for one in pose.responses):
        return np.nan
    convert = hybrid.conversion(controller.representation, controller.converts)
    from_goal = controller.impedance is not None and controller.impedance.relative
    works = np.array(
        [work for one in pose.responses for work in _works(controller.representation, convert, from_goal, one)]
    )
    largest = works[:, 2].max()
    return float(np.abs(works[:, 0] - works[:, 1]).max() / largest) if largest > 0.0 else np.nan


def _works(
    coordinates: Coordinates, convert: Callable, from_goal: bool, one: ContactResponse
) -> Iterator[tuple[float, float, float]]:
    """(m . omega, F_E . Edot, |m| |omega|) at some ticks [W]."""
    goal = from_quaternion(one.trial.goal_wxyz)
    ticks = np.linspace(0, len(one.time) - 1, TICKS).astype(int)
    sampled = (one.R[ticks].transpose(0, 2, 1).tolist(), one.moment[ticks].tolist(), one.omega[ticks].tolist())
    for columns, m, omega in zip(*sampled, strict=True):
        R = Rotation(*columns)
        if from_goal:
            R, m, omega = relative(goal, R), rotate_back(goal, m), rotate_back(goal, omega)
        at = coordinates.chart(R)
        work = np.dot(convert(at, m), coordinates.rates(at, omega))
        yield np.dot(m, omega), work, math.sqrt(np.dot(m, m)) * math.sqrt(np.dot(omega, omega))


METRIC = ContactMetric("work_residual", "1", "work lost between Cartesian and generalized forces", work_residual)
