"""Columns and rows of tasks in contact: a pose a row of compliance.parquet.

A record is folded into numbers as soon as the trials of its pose are there, and then dropped: it is 25 doubles a tick.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np

from bench.base.on_first_use import pd
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.measured_compliance import compliance
from bench.engines.metrics.registry import known_contact_metrics
from bench.experiments.columns import of_metrics, read_table
from bench.law.contenders.representations.zyx_euler import chart
from bench.law.control.contact_controller import ContactController
from bench.law.so3 import from_quaternion
from tasks.arm_model import Arm
from tasks.contact import ContactTask, Trial

if TYPE_CHECKING:
    from bench.engines.contact_episode import Conditions, Ended

DONE, *_ = WORST_LAST = ("done", "singular", "saturated", "diverged", "broken")
"""Outcomes of `engines.contact_episode`; a pose has the worst of its trials'."""

AT_REST, CREEPING = "at-rest", "creeping"

MEASURED = tuple(f"c_{i}{j}" for i in "xyz" for j in "xyz")
TABLE = read_table(__file__, "compliance", METRICS=lambda: of_metrics(known_contact_metrics().values()))


def frame(
    suite: str,
    controller: ContactController,
    task: ContactTask,
    arm: Arm,
    poses: tuple[tuple[Trial, ...], ...],
    conditions: Conditions,
    simulate: Callable[..., Iterator[Ended]] | None = None,
) -> pd.DataFrame:
    """Return one row a pose; a pose is the trials that share it. `simulate` is `run_contact` unless it is given."""
    from bench.engines.simulate_contact import run_contact as run

    episodes = (simulate or run)(
        "native", controller, task, arm, (trial for pose in poses for trial in pose), conditions
    )
    made = [_row(task, arm, controller, [(one, next(episodes)) for one in pose], conditions) for pose in poses]
    return pd.DataFrame([{"suite": suite, **row} for row in made])


def _row(
    task: ContactTask, arm: Arm, controller: ContactController, ended: list[tuple[Trial, Ended]], conditions: Conditions
) -> dict:
    first = ended[0][0]
    outcome = max((one.outcome for _, one in ended), key=WORST_LAST.index)
    ticks = min(len(one.record) for _, one in ended if one.outcome == outcome)
    rest = AT_REST if all(one.rested for _, one in ended) else CREEPING
    pose = Pose(task, arm, controller, tuple(response(*each) for each in ended))
    with np.errstate(all="ignore"):  # of a record that ends beyond all bounds
        measured = {one.column: one.measure(pose) for one in known_contact_metrics().values()}
    return {
        "task": task.name,
        "arm": arm.name,
        "controller": controller.law,
        "representation": controller.representation.name if controller.representation else "",
        "form": controller.form,
        "pose": first.pose,
        "complies": first.specification.name,
        **dict(zip(("alpha", "beta", "gamma"), chart(from_quaternion(first.goal_wxyz)).E, strict=True)),
        "tilt": first.tilt,
        **conditions.gains._asdict(),
        **conditions.touch._asdict(),
        "dt_s": conditions.dt_s,
        "integrator": conditions.integrator,
        "horizon_s": task.horizon_s,
        "trials": len(ended),
        "outcome": outcome,
        "rest": rest if task.rests and outcome == DONE else "",
        "failure_time_s": np.nan if outcome == DONE else ticks * conditions.dt_s,
        **measured,
        **dict(zip(MEASURED, compliance(pose).ravel(), strict=True)),
    }
