"""Whether work is conserved where a controller changes the wrench's coordinates (Murphy 1988, 3.10).

m . omega = F_E . Edot        Edot = B^-1 omega, F_E = B^T m (3.12), or what the controller takes for it
"""

from collections.abc import Callable, Sequence

import numpy as np

from bench.engines.metrics.contact_metric import ContactMetric, ContactResponse, Pose
from bench.law.control import hybrid
from bench.law.kinds import Coordinates
from bench.law.so3 import Rotation, from_quaternion, relative, rotate_back

# Ticks of an episode that are looked at, evenly spaced: nothing in a rounding depends on the tick.
TICKS = 16

Port = tuple[Sequence[float], ...]
"""m, omega, F_E and Edot of one tick, three numbers each."""


def work_residual(pose: Pose) -> float:
    """max |m . omega - F_E . Edot| / max |m| |omega| over ticks; NaN without coordinates, moment or motion."""
    controller = pose.controller
    if controller.representation is None or any(one.outcome != "done" for one in pose.responses):
        return np.nan
    convert = hybrid.conversion(controller.representation, controller.converts)
    from_goal = controller.impedance is not None and controller.impedance.relative
    ports: list[Port] = []
    for response in pose.responses:
        ports += sample_ports(controller.representation, convert, from_goal, response)
    m, omega, F_E, rates = np.array(ports, float).transpose(1, 0, 2)
    gaps = np.abs(dots(m, omega) - dots(F_E, rates))
    scales = np.sqrt(dots(m, m)) * np.sqrt(dots(omega, omega))
    # of a record that ends beyond all bounds, the largest is NaN
    largest = np.max(scales)
    return float(np.max(gaps) / largest) if largest > 0.0 else np.nan


def sample_ports(
    coordinates: Coordinates, convert: Callable, from_goal: bool, response: ContactResponse
) -> list[Port]:
    """Return m [N m], omega [rad/s], F_E and Edot at each of TICKS ticks of an episode."""
    goal = from_quaternion(response.trial.goal_wxyz)
    ticks = np.linspace(0, len(response.time) - 1, TICKS).astype(int)
    frames = response.R[ticks].transpose(0, 2, 1).tolist()
    moments, velocities = response.moment[ticks].tolist(), response.omega[ticks].tolist()
    ports: list[Port] = []
    for columns, m, omega in zip(frames, moments, velocities, strict=True):
        R = Rotation(*columns)
        if from_goal:
            R, m, omega = relative(goal, R), rotate_back(goal, m), rotate_back(goal, omega)
        at = coordinates.chart(R)
        ports.append((m, omega, convert(at, m), coordinates.rates(at, omega)))
    return ports


def dots(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return the products of the rows of two arrays, N x 3, each as `numpy.dot` rounds it."""
    products = a[:, np.newaxis, :] @ b[:, :, np.newaxis]
    return products[:, 0, 0]


METRIC = ContactMetric("work_residual", "1", "work lost between Cartesian and generalized forces", work_residual)
