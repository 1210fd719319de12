"""What an episode asks of an arm: torques, a place to hold, the joints' ranges."""

from bench.engines.metrics.metric import Metric, if_finite, root
from bench.law import dot, kernel, minus


@kernel
def largest_torque(value, sample):
    """max tau_i^2; a torque that is not a number changes nothing."""
    for i in range(7):
        value = max(value, sample.tau[i] * sample.tau[i])
    return value


@kernel
def largest_ratio(value, sample):
    """max (tau_i / rated_i)^2; a torque that is not a number changes nothing."""
    for i in range(7):
        ratio = sample.tau[i] / sample.rated[i]
        value = max(value, ratio * ratio)
    return value


@kernel
def farthest(value, sample):
    """max |p - p_d|^2."""
    return max(value, last_distance(value, sample))


@kernel
def last_distance(value, sample):
    """|p - p_d|^2 now."""
    away = minus(sample.p, sample.p_d)
    return dot(away, away)


@kernel
def largest_excess(value, sample):
    """max over joints of q - upper or lower - q [rad], if positive; stops are soft."""
    for i in range(7):
        value = max(value, sample.q[i] - sample.upper[i], sample.lower[i] - sample.q[i])
    return value


METRICS = (
    Metric("peak_tau_nm", "N m", "largest torque of any joint", 0.0, largest_torque, root, True),
    # with ideal motors above 1: a real arm could not have done it
    Metric("peak_torque_ratio", "1", "largest torque over the motor's rated one", 0.0, largest_ratio, root, True),
    Metric("position_error_m", "m", "largest distance of the tool from its place", 0.0, farthest, root, True),
    Metric("position_left_m", "m", "distance of the tool from its place at the end", 0.0, last_distance, root, True),
    Metric("range_excess_rad", "rad", "largest excess of a joint over its range", 0.0, largest_excess, if_finite, True),
)
