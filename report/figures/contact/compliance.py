"""The page on compliance: the axis about which a hand yields, by the paper's force control and by accelerations."""

import numpy as np
import pandas as pd

from report.figures.arms.arm_rows import name_arm
from report.figures.contact import as_arms_run
from report.figures.contact import rows as controllers
from report.figures.contact.hand_axes import ORDER, axes_of_turning, measured, shown_arm, turns
from report.figures.contact.rows import level, of
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import power

PROBE = "wrench-probe"


def facts(run: Run) -> dict:
    """Return the numbers of the probe, and the axes of turning."""
    rows = controllers.of_task(run, PROBE)
    return {
        "axes_arm": name_arm(shown_arm(rows)),
        **measured(turns(rows)),
        "off_by_accelerations": off_by_accelerations(rows),
        **(in_run(lambda: damping(run)) or {}),
        "compliance-axes": axes_of_turning(rows),
    }


def damping(run: Run) -> dict:
    """Return the damping that two designs give an impedance without inertia shaping."""
    found = as_arms_run.facts(run)
    return {name: found[name] for name in ("felt_least", "felt_most", "double")}


def off_by_accelerations(rows: pd.DataFrame) -> str:
    """Return how far the Euler hand's misalignment is from beta [deg], about x and y complying by accelerations."""
    own = level(of(rows, controllers.EULER, ORDER))
    own = own[own["outcome"] == "done"]
    return power(float((np.degrees(own["misalignment_rad"]) - own["beta_deg"].abs()).abs().max()))
