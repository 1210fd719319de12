"""An experiment and a perturbation that tests plant in a copy of the tree, and what they ask there."""

EXPERIMENT = "bench/experiments/dropped_experiment.py"
DROPPED_EXPERIMENT = '''
"""Position gains: a unit a law; killed at the one that the environment names."""

import os
import signal

from bench.experiments.columns import Table, numbers, words
from bench.experiments.experiment import Experiment, Unit


def columns():
    """dropped.parquet: a row a law."""
    return [*words(law="the law"), *numbers("1/s^2", "position gain", "kp")]


def units(asked):
    """A unit a law."""
    return tuple(Unit("dropped-experiment", one.name, episodes=1) for one in asked.laws)


def rows(settings, unit):
    """One."""
    if os.environ.get("KILLED_AT") == unit.contender:
        os.kill(os.getpid(), signal.SIGKILL)
    return [{"law": unit.contender, "kp": settings.gains.kp}]


EXPERIMENT = Experiment(
    "dropped-experiment",
    "A dropped experiment",
    Table("dropped", columns, ("law",)),
    units,
    rows,
    cost_s=lambda unit: 0.1,
    compiles=False,
    summary=lambda frame: frame,
)
'''

PLANTED = "tasks/conditions/planted_bias.py"
PLANTED_AXIS = '''
"""A gyroscope that reads too much."""

from tasks.axis import Axis, Field

AXIS = Axis(
    "planted-bias",
    "A planted bias",
    "rad/s",
    (0.0, 0.1),
    0.0,
    (Field("planted_bias", 0.0, "what the rate reads too much [rad/s]", lasts=True),),
)
'''
ASKED_OF_AXIS = """
import tasks
from bench.engines.typed import type_of
from bench.findings.perturbed import lasting, ways
from report.figures.robustness.robustness import AXES
from tasks.condition import Condition, condition_at

compiled = type_of(Condition)
print(dict(zip(compiled.fields, map(str, compiled.types)))["planted_bias"])
print(condition_at(tasks.axis("planted-bias"), 0.1).planted_bias)
print("planted-bias" in lasting(), [way.name for way in ways() if way.axis == "planted-bias"], "planted-bias" in AXES)
"""
