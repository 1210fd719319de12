"""Energy through the port between hand and surroundings: is what a controller makes of the arm passive?

    E(t) = - integral of F . (v, omega) dt        given to the surroundings from the start to t

A passive hand gives no more than it has stored, whatever it is pressed on or pushed by: E is bounded (Colgate and Hogan
1988). What is ordered to exert a force, or to move, has that to give besides; where nothing is ordered and the hand
begins at rest and without a load the bound is 0.

The F that a tick records acted from the tick before to it.
Source: Colgate and Hogan 1988, "Robust control of dynamically interacting systems"; Hogan 1985.
"""

from collections.abc import Callable

import numpy as np

from bench.engines.metrics.contact_metric import ContactMetric, ContactResponse, Pose, once_a_pose


def given(one: ContactResponse) -> np.ndarray:
    """E [J] after each tick but the first, N - 1."""
    rate = (one.omega[1:] + one.omega[:-1]) / 2.0
    along = (one.force[1:] * np.diff(one.p, axis=0)).sum(axis=1)
    about = (one.moment[1:] * rate).sum(axis=1) * np.diff(one.time)
    return -np.cumsum(along + about)


def port_energy(pose: Pose) -> float:
    """E [J] at the end, of the episode that gave most; NaN if one of them recorded nothing."""
    return _largest(pose, lambda energies: energies[-1])


def port_energy_peak(pose: Pose) -> float:
    """max E [J] over all ticks, at least 0: what a passive hand must have stored before it began."""
    return _largest(pose, lambda energies: max(0.0, energies.max()))


def _largest(pose: Pose, of: Callable[[np.ndarray], float]) -> float:
    energies = _energies(pose)
    if any(len(one) == 0 or not np.isfinite(one).all() for one in energies):
        return np.nan
    return float(max(map(of, energies)))


@once_a_pose
def _energies(pose: Pose) -> list[np.ndarray]:
    return [given(one) for one in pose.responses]


METRICS = (
    ContactMetric("port_energy_j", "J", "energy given to the surroundings by the end", port_energy),
    ContactMetric("port_energy_peak_j", "J", "most energy given to the surroundings", port_energy_peak),
)
