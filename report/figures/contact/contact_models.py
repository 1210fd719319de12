"""What the contact model does to a result, shown once: one episode on the plate, with other contacts and steps."""

from __future__ import annotations

import functools
from typing import NamedTuple

import pandas as pd

import tasks
from bench.control.registry import find_compliant
from bench.engines.contact_episode import USUAL, Conditions, Ended
from bench.engines.run_contact import run
from bench.metrics.contact_metric import Pose, response
from bench.metrics.registry import known_contact_metrics
from report.figures.kit import html
from tasks.contact_model import STANDARD, ContactModel

TASK, ARM, TRIAL = "surface-alignment", "puma560", "tilt 20 about 0, beta+75"
CONTROLLERS = ("hybrid-base+inverse", "hybrid/zyx-euler+inverse")
METRICS = (
    ("alignment-error", "Tool to plate [deg]", 57.29577951308232, ".2f"),
    ("force-error-rms", "Force error, rms [N]", 1.0, ".2f"),
    ("peak-force", "Largest force [N]", 1.0, ".0f"),
    ("penetration", "Penetration [mm]", 1e3, ".3f"),
)


class Variant(NamedTuple):
    """One line: what differs from the standard, the contact model, and the control period [s]."""

    words: str
    contact: ContactModel = STANDARD
    dt_s: float = USUAL.dt_s


VARIANTS = (
    Variant("as in all results"),
    Variant("stiffer: solref 5 ms", STANDARD._replace(timeconst=0.005)),
    Variant("softer: solref 20 ms", STANDARD._replace(timeconst=0.02)),
    Variant("solimp from 0.5 to 0.9", STANDARD._replace(dmin=0.5, dmax=0.9)),
    Variant("no friction", STANDARD._replace(friction=1e-5)),
    Variant("friction 0.6", STANDARD._replace(friction=0.6)),
    Variant("step 0.5 ms", dt_s=0.0005),
    Variant("step 2 ms", dt_s=0.002),
)


@functools.cache
def episode(controller: str, variant: Variant) -> tuple[str, tuple[float, ...]]:
    """Outcome and the numbers of METRICS, in their units there."""
    compliant, task, arm = find_compliant(controller), tasks.contact_task(TASK), tasks.arm(ARM)
    trial = next(one for one in task.trials(arm) if one.id == TRIAL)
    conditions = Conditions(dt_s=variant.dt_s)
    ended: Ended = next(run("native", compliant, task, arm, (trial,), conditions, variant.contact))
    pose = Pose(task, arm, compliant, (response(trial, ended),))
    metrics = known_contact_metrics()
    return ended.outcome, tuple(metrics[name].measure(pose) * factor for name, _, factor, _ in METRICS)


def table() -> html.Markdown:
    """A variant a line, both controllers side by side where they differ most: the angle to the plate."""
    lines = []
    for variant in VARIANTS:
        (done, numbers), (euler_ended, euler) = (episode(controller, variant) for controller in CONTROLLERS)
        lines.append(
            {
                "Contact": variant.words,
                "Outcomes": ", ".join(dict.fromkeys((done, euler_ended))),
                METRICS[0][1]: numbers[0],
                "the same, Euler [deg]": euler[0],
                **{title: number for (_, title, _, _), number in zip(METRICS[1:], numbers[1:], strict=True)},
            }
        )
    forms = {title: form for _, title, _, form in METRICS}
    return html.table(pd.DataFrame(lines), {**forms, "the same, Euler [deg]": METRICS[0][3]})
