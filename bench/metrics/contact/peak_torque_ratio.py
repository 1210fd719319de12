"""Largest torque over what its motor is rated for: above 1, a real arm could not have done it."""

import numpy as np

from bench.metrics.contact_metric import ContactMetric, Pose


def measure(pose: Pose) -> float:
    """max |tau_i| / rated_i over all ticks; NaN if nothing was recorded."""
    return float(np.fmax.reduce(np.concatenate([one.load for one in pose.responses]), initial=np.nan))


METRIC = ContactMetric(
    "peak-torque-ratio", "peak_torque_ratio", "1", "largest torque over the motor's rated one", measure
)
