"""Every metric there is: what is measured along an episode, and in contact."""

import functools

from bench.contenders.registry import collect
from bench.metrics import contact, motion
from bench.metrics.metric import Metric


@functools.cache
def known_metrics() -> dict:
    """Word -> Metric, from bench/metrics/motion, in alphabetical order: the order of their columns."""
    return collect(motion, "METRIC", Metric)


@functools.cache
def known_contact_metrics() -> dict:
    """Word -> ContactMetric, from bench/metrics/contact, in alphabetical order: the order of their columns."""
    # MuJoCo takes a moment to import; naming other things must not
    from bench.metrics.contact_metric import ContactMetric

    return collect(contact, "METRIC", ContactMetric)


def metrics_of(on_arm: bool) -> tuple[Metric, ...]:
    """The metrics that can be measured on an arm (all), or on the free body."""
    return tuple(one for one in known_metrics().values() if on_arm or not one.arm_only)
