"""What the contact model does to a result, shown once: one episode on the plate, with other contacts and steps."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator
from typing import NamedTuple

import tasks
from bench.engines.contact_episode import USUAL, Conditions, Ended
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.registry import known_contact_metrics
from bench.engines.simulate_contact import run_contact as run
from bench.law.control.registry import find_controller
from report.figures.kit.tables import Table
from tasks.contact_model import STANDARD, ContactModel

TASK, ARM, TRIAL = "surface-alignment", "puma560", "tilt 20 about 0, beta+75"
CONTROLLERS = ("hybrid-base+transpose", "hybrid/zyx-euler+transpose")
METRICS = {
    "alignment_error_rad": 180.0 / math.pi,
    "time_to_align_s": 1.0,
    "peak_force_n": 1.0,
    "remaining_speed_m_per_s": 1e6,
    "penetration_m": 1e3,
}
"""Column -> factor to its unit in the table."""

MODELS = Table(
    "Contact | Outcomes | Tool to plate [deg]:.2f | the same, Euler [deg]:.2f | Time to align [s]:.2f | "
    "Largest force [N]:.0f | Still moves at [µm/s]:.1f | Penetration [mm]:.3f"
)


class Variant(NamedTuple):
    """One line: what differs from the standard, the contact model, and the control period [s]."""

    words: str
    contact: ContactModel = STANDARD
    dt_s: float = USUAL.dt_s


VARIANTS = (
    Variant("as in all results"),
    Variant("stiffer: 10⁶ N/m", STANDARD._replace(stiffness=1e6)),
    Variant("softer: 2·10⁴ N/m", STANDARD._replace(stiffness=2e4)),
    Variant("damping halved: 2000 N s/m", STANDARD._replace(damping=2e3)),
    Variant("friction creeps: no second solver", STANDARD._replace(noslip=0)),
    Variant("no friction", STANDARD._replace(friction=1e-5)),
    Variant("friction 0.6", STANDARD._replace(friction=0.6)),
    Variant("step 0.5 ms", dt_s=0.0005),
    Variant("step 2 ms", dt_s=0.002),
)


@functools.cache
def episode(controller: str, variant: Variant) -> tuple[str, tuple[float, ...]]:
    """Outcome and the numbers of METRICS, in their units there."""
    compliant, task, arm = find_controller(controller), tasks.contact_task(TASK), tasks.arm(ARM)
    trial = next(one for one in task.trials(arm) if one.id == TRIAL)
    conditions = Conditions(dt_s=variant.dt_s)
    ended: Ended = next(run("native", compliant, task, arm, (trial,), conditions, variant.contact))
    pose = Pose(task, arm, compliant, (response(trial, ended),))
    metrics = known_contact_metrics()
    return ended.outcome, tuple(metrics[name].measure(pose) * factor for name, factor in METRICS.items())


def models() -> Iterator[tuple]:
    """A variant a line, both controllers side by side where they differ most: the angle to the plate."""
    for variant in VARIANTS:
        (done, (angle, *others)), (euler_ended, euler) = (episode(controller, variant) for controller in CONTROLLERS)
        yield variant.words, ", ".join(dict.fromkeys((done, euler_ended))), angle, euler[0], *others
