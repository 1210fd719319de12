"""How the tests run episodes: the settings, one start of each kind, a metric that keeps what it sees."""

import tasks
from bench.engines.episode import Settings
from bench.engines.metrics.metric import Metric
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import WORTH_LANES, prepare
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from tasks.rules import ticks

NO_EARLY_STOP = 10**9
METRICS, ARM_METRICS = metrics_of(on_arm=False), metrics_of(on_arm=True)


def settings(dt_s=1e-3, horizon_s=3.0, hold_ticks=NO_EARLY_STOP, gains=None, **limits):
    """Settings under the judge's rules, or other limits; no early stop unless asked for."""
    return Settings(gains or Gains(), dt_s, ticks(horizon_s, dt_s), hold_ticks, **limits)


def spread(each: int, task: str = "free-body") -> list:
    """`each` starts of every set of a task, evenly spaced through it, so that exact and near ones are among them."""
    chosen = []
    for word in tasks.task(task).start_sets:
        every = tasks.start_set(word)
        chosen += every[:: max(1, len(every) // each)][:each]
    return chosen


def compile_into_cache(engine: str, law: str) -> None:
    """Loops of an ideal plant with a law, one start at a time and in lanes, as a run of all metrics has them."""
    for total in (0, WORTH_LANES):
        prepare(engine, find_contender(law), METRICS, total)


def recorder(kept):
    """A metric that keeps every sample it is shown."""

    def update(value, sample):
        kept.append(sample)
        return value

    return Metric("kept", "1", "kept", 0.0, update, lambda value, ending: value)
