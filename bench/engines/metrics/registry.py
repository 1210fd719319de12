"""Every metric there is: what is measured along an episode, and in contact."""

import functools
import importlib
import pkgutil
from types import ModuleType
from typing import Any

from bench.base.errors import BadMetric
from bench.engines.metrics import contact, motion
from bench.engines.metrics.metric import Metric


@functools.cache
def known_metrics() -> dict:
    """Column -> Metric, from bench/engines/metrics/motion, in alphabetical order."""
    return collect(motion, Metric)


@functools.cache
def known_contact_metrics() -> dict:
    """Column -> ContactMetric, from bench/engines/metrics/contact, in alphabetical order."""
    # MuJoCo takes a moment to import; naming other things must not
    from bench.engines.metrics.contact_metric import ContactMetric

    return collect(contact, ContactMetric)


def metrics_of(on_arm: bool) -> tuple[Metric, ...]:
    """Return the metrics that can be measured on an arm (all), or on the free body."""
    return tuple(one for one in known_metrics().values() if on_arm or not one.arm_only)


def collect(package: ModuleType, kind: type[Any]) -> dict[str, Any]:
    """Return column -> metric, from METRIC or METRICS of every module of a package, in alphabetical order."""
    found: dict[str, Any] = {}
    for info in pkgutil.iter_modules(package.__path__):
        module = importlib.import_module(f"{package.__name__}.{info.name}")
        metrics = getattr(module, "METRICS", None) or (getattr(module, "METRIC", None),)
        for one in metrics:
            if not isinstance(one, kind):
                raise BadMetric(f"{module.__file__} has no METRIC that is a {kind.__name__}, and no METRICS of them")
            if one.column in found:
                raise BadMetric(f"{module.__file__}: there is a column '{one.column}' already; give it one of its own")
            found[one.column] = one
    return dict(sorted(found.items()))
