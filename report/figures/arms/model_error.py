"""What the page on model errors shows: how far from the goal the tool ends when the plant is not the model."""

from __future__ import annotations

import functools

import numpy as np
import pandas as pd

import tasks
from report.figures.arms import arm_looks, arm_rows, model_rest
from report.figures.kit.page import ABSENT, NotInRun, Run

SHOWN = (arm_rows.ON_MATRIX, arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)


@functools.cache
def compared(run: Run) -> pd.DataFrame:
    """Rows by the controllers that settle every clear start of a perfect model, so that what is left is the model's."""
    varied = arm_rows.varied(run)
    if varied.empty:
        raise NotInRun("no variation")
    return arm_rows.with_standard(varied[varied["controller"].isin(SHOWN)])


def facts(run: Run) -> dict:
    """Whole sentences: what variations leave, on what that stands, and what of it is gravity's."""
    own = compared(run)
    medians = np.degrees(own.groupby("variation")["final_angle_rad"].median())
    angles = own.pivot_table(
        index=["arm", "start_id", "variation"], columns="controller", values="final_angle_rad", observed=True
    ).dropna()
    apart = np.degrees((angles.max(axis=1) - angles.min(axis=1)).median())
    nominal = arm_rows.episodes(run)
    clear = nominal[(nominal["start_set"] == "clear") & nominal["controller"].isin(SHOWN)]
    lost = int((~arm_rows.settled(arm_rows.with_standard(clear))).sum())
    settled = 100.0 * float(arm_rows.settled(own).mean())
    return {
        "lead": f"From the same start the controllers end {apart:.1g}° apart in the median; the worst variation, "
        f"{medians.idxmax()}, leaves {medians.max():.1f}°, the mildest, {medians.idxmin()}, {medians.min():.2f}°.",
        "setting": f"From clear starts, {len(own)} episodes of {float(own['horizon_s'].max()):g} s by "
        f"{own['controller'].nunique()} controllers on {len(arm_looks.arms(own))} arms. With a perfect model {lost} of "
        f"their clear episodes fail; with these {settled:.0f} % settle, and the others stay outside "
        f"{100 * float(own['tolerance'].iloc[0]):g} % of the initial angle.",
        "gravity": by_gravity(own),
    }


def by_gravity(own: pd.DataFrame) -> str:
    """Measured angle over that of the formula, for arms of six joints and of seven."""
    found = model_rest.predicted(own)
    joints = found["arm"].map(lambda name: tasks.arm(name).joints)
    said = []
    for words, rows in (("six joints", found[joints == 6]), ("seven", found[joints > 6])):
        ratio = model_rest.ratios(rows)
        if len(ratio):
            low, middle, high = ratio.quantile(0.05), ratio.median(), ratio.quantile(0.95)
            said.append(f"on {words} {middle:.3f} in the median ({low:.2f} to {high:.2f} from 5 to 95 %)")
    return f"Measured over predicted is {', '.join(said)}." if said else f"The comparison is {ABSENT}."
