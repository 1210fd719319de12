"""What the page on model errors shows: how far from the goal the tool ends when the plant is not the model."""

from __future__ import annotations

import functools
from collections.abc import Iterator

import numpy as np
import pandas as pd

import tasks
from report.figures.arms import arm_looks, arm_rows, model_rest
from report.figures.failures.failure_map import outcomes
from report.figures.kit import html
from report.figures.kit.page import ABSENT, Run
from report.figures.kit.tables import Table

SHOWN = (arm_rows.ON_MATRIX, arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)
VARIATIONS = Table(
    "Variation | The plant | Episodes | Settled [%]:.0f | The others | Angle [deg]:.2f | Strays [mm]:.1f"
)


@functools.cache
def compared(run: Run) -> pd.DataFrame:
    """Rows by the controllers that settle every clear start of a perfect model, so that what is left is the model's."""
    varied = arm_rows.varied(run)
    return arm_rows.with_standard(varied[varied["controller"].isin(SHOWN)]) if len(varied) else varied


def facts(run: Run) -> dict:
    """Whole sentences: what variations leave, on what that stands, and what of it is gravity's."""
    own = compared(run)
    if own.empty:
        return dict.fromkeys(("lead", "setting", "gravity"), f"Variations of the plant are {ABSENT}.")
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


def tables(run: Run) -> dict:
    """Return the table by variation."""
    return {"tab_variations": VARIATIONS(by_variation(compared(run)))}


def in_order(rows: pd.DataFrame) -> list[str]:
    """The variations that the rows hold, in the order of tasks/variations.py."""
    return [name for name in tasks.variation_names() if len(rows) and name in set(rows["variation"])]


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


def by_variation(rows: pd.DataFrame) -> Iterator[tuple]:
    """Every variation: what it is, episodes, share settled, how the others end, angle and distance."""
    for word in in_order(rows):
        own = rows[rows["variation"] == word]
        settled, others = 100.0 * arm_rows.settled(own).mean(), html.together(outcomes(own))
        left = np.degrees(own["final_angle_rad"].median()), 1e3 * own["position_error_m"].median()
        yield html.together(f"`{word}`"), tasks.variation(word).title, len(own), settled, others, *left
