"""Whether work is conserved where a controller changes the wrench's coordinates (Murphy 1988, 3.10).

m . omega = F_E . Edot        Edot = B^-1 omega, F_E = B^T m (3.12), or what the controller takes for it
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from bench.engines.metrics.contact_metric import ContactMetric, Pose, Response
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
    coordinates: Coordinates, convert: Callable, from_goal: bool, one: Response
) -> Iterator[tuple[float, float, float]]:
    """(m . omega, F_E . Edot, |m| |omega|) at some ticks [W]."""
    goal = from_quaternion(one.trial.goal_wxyz)
    for tick in np.linspace(0, len(one.time) - 1, TICKS).astype(int):
        R, m, omega = Rotation(*one.R[tick].T.tolist()), one.moment[tick].tolist(), one.omega[tick].tolist()
        if from_goal:
            R, m, omega = relative(goal, R), rotate_back(goal, m), rotate_back(goal, omega)
        at = coordinates.chart(R)
        yield np.dot(m, omega), np.dot(convert(at, m), coordinates.rates(at, omega)), _length(m) * _length(omega)


def _length(v: Sequence[float]) -> float:
    return float(np.linalg.norm(v))


METRIC = ContactMetric("work_residual", "1", "work lost between Cartesian and generalized forces", work_residual)
