"""The numbers and the computed answers of the pages about arms, each function what one page pastes, key by key."""

from __future__ import annotations

import numpy as np
import pandas as pd

import tasks
from report.figures.arms import (
    arm_causes,
    arm_pole,
    arm_responses,
    arm_rows,
    arm_settling,
    arm_wrist,
    model_error,
    model_rest,
)
from report.figures.kit import absent, html
from report.figures.kit.share import share
from tasks.cause import NEAR_CONDITION, NEAR_MARGIN

DAMPED = "damped-least-squares"
FEWEST = 2
"""Ways to choose between: with fewer there is no choice to advise on."""


def told(rows: pd.DataFrame) -> str:
    """Share that settles with its interval and n, in words."""
    found = share(int(arm_rows.settled(rows).sum()), len(rows))
    return f"{100 * found.value:.1f} % ({100 * found.low:.1f} to {100 * found.high:.1f} %, n = {found.n})"


def on_arms(rows: pd.DataFrame) -> dict:
    """Of the page on arms.

    Args:
        rows: of `arm_rows.episodes`, every inverse.
    """
    standard = arm_rows.with_standard(rows)
    both = arm_pole.side_by_side(standard)
    later = arm_settling.differences(standard)
    counts = arm_causes.tallied(standard)
    close = arm_settling.close(later)
    clear = rows[rows["start_set"] == "clear"]
    return {
        **advice(rows),
        **damping(rows),
        "arms": len(arm_rows.arms(rows)),
        "tick_ms": f"{1e3 * float(rows['dt_s'].iloc[0]):g}",
        "episodes": len(rows),
        "controllers": standard["controller"].nunique(),
        "pole_n": len(both),
        "pole_fails": int(both["fails"].sum()),
        "pole_fails_m": int(both["fails_matrix"].sum()),
        "hammer": f"{arm_pole.HAMMERED:g}",
        "hammered": int((both["fails"] | (both["harder"] > arm_pole.HAMMERED)).sum()),
        "harder": html.number(both["harder"].median()),
        "pole_worst": both.groupby("arm")["fails"].mean().idxmax(),
        "pole_worst_k": int(both.groupby("arm")["fails"].sum().max()),
        "pole_worst_n": int(both.groupby("arm").size().max()),
        "near_margin": int((both["min_margin"] < NEAR_MARGIN).sum()),
        "cond": html.number(both["cond_jacobian_max"].median()),
        "cond_m": html.number(both["cond_jacobian_max_matrix"].median()),
        "margin": f"{NEAR_MARGIN:g}",
        "condition": f"{NEAR_CONDITION:g}",
        "both_ways": same_both_ways(rows),
        "clear_n": len(later),
        "close": int(close.sum()),
        "close_ms": f"{1e3 * arm_settling.CLOSE_TICKS * float(later['dt_s'].iloc[0]):g}",
        "median_ms": f"{1e3 * later['later_s'].abs().median():.1f}",
        "clear_m": int((~arm_rows.settled(arm_rows.of(clear, arm_rows.ON_MATRIX))).sum()),
        "possible": f"{100 * float((standard['peak_torque_ratio'] <= 1.0).mean()):.0f}",
        "possible_clear": possible(clear, arm_rows.ON_MATRIX),
        "possible_clear_f": possible(clear, arm_rows.ON_ANGLES),
        "kinematic": int(counts["kinematic"].sum()),
        "failures": int(counts[list(arm_causes.COLOURS)].to_numpy().sum()),
    }


def in_words(inverse: str) -> str:
    """An inverse's title inside a sentence."""
    title = arm_rows.title_of_inverse(inverse)
    return title[:1].lower() + title[1:]


def possible(clear: pd.DataFrame, controller: str) -> str:
    """Share of clear episodes by a controller within the rated torques, in per cent."""
    return f"{100 * float((arm_rows.of(clear, controller)['peak_torque_ratio'] <= 1.0).mean()):.0f}"


def same_both_ways(rows: pd.DataFrame) -> str:
    """How many episodes of the Euler law end alike by (2.2) with (2.15) and by (3.7)."""
    pair = [arm_rows.of(rows, controller) for controller in (arm_rows.SAME_BOTH_WAYS, arm_rows.ON_ANGLES)]
    both = pair[0].merge(pair[1], on=["arm", "start_set", "start_id"])
    if both.empty:
        return absent.WORDS
    alike = int((both["outcome_x"] == both["outcome_y"]).sum())
    return f"{alike} of {len(both)}"


def advice(rows: pd.DataFrame) -> dict:
    """What the evenly spread starts say: which law by the standard inverse, and which inverse for that law."""
    uniform = rows[rows["start_set"] == "uniform"]
    standard = arm_rows.with_standard(uniform)
    shares = standard.assign(good=arm_rows.settled(standard)).groupby("controller")["good"].mean()
    law = str(shares.idxmax())
    worst = str(shares.idxmin())
    values = {
        "best": arm_rows.title(law),
        "best_share": told(arm_rows.of(uniform, law)),
        "euler_share": told(arm_rows.of(uniform, arm_rows.ON_ANGLES)),
        "worst": arm_rows.title(worst),
        "worst_share": f"{100 * shares[worst]:.0f}",
    }
    whose, own = "it", uniform[uniform["controller"] == law]
    if own["way"].nunique() < FEWEST:
        whose, own = "the rotation matrix by (2.2)", uniform[uniform["controller"] == arm_rows.ON_MATRIX]
    ways = own.assign(good=arm_rows.settled(own), strays=own["position_error_m"]).groupby("way")
    table = pd.DataFrame({"good": ways["good"].mean(), "strays": ways["strays"].median(), "n": ways.size()})
    if len(table) < FEWEST:
        return values | {"inverse_advice": f"Which inverse is best is {absent.WORDS}."}
    best = table.sort_values(["good", "strays"], ascending=[False, True]).index[0]
    inverse = best.partition("+")[2]
    return values | {
        "inverse_advice": f"With the inverse “{in_words(inverse)}” {whose} settles "
        f"{told(own[own['way'] == best])} and strays {html.number(1e3 * table.loc[best, 'strays'])} mm in the median."
    }


def damping(rows: pd.DataFrame) -> dict:
    """What damping does to turns through and past singularities, of each controller a clause."""
    starts = arm_wrist.of_wrist(rows)
    said = {}
    for key, controller in (("damped_m", arm_rows.ON_MATRIX), ("damped_f", arm_rows.ON_ANGLES)):
        ways = [arm_rows.of(starts, controller, name) for name in (arm_rows.STANDARD, DAMPED)]
        if any(own.empty for own in ways):
            said[key] = absent.WORDS
            continue
        plain, damped = (100.0 * float(arm_rows.settled(own).mean()) for own in ways)
        before, after = (html.number(1e3 * float(own["position_error_m"].median())) for own in ways)
        said[key] = (
            f"{plain:.0f} % settle with the plain inverse and {damped:.0f} % with damped least squares, the tool "
            f"straying by {before} and {after} mm in the median"
        )
    return said


def responding(traces: pd.DataFrame, rows: pd.DataFrame, kp: float, kv: float) -> dict:
    """Of the responses on arms.

    Args:
        traces, rows: of `arm_rows.named` and `arm_rows.episodes`; the curves may be none.
    """
    bends = arm_responses.bends(traces, rows, kp, kv)
    if bends.empty:
        return dict.fromkeys(("bend", "bend_n", "bend_arm"), absent.WORDS)
    worst = bends.loc[bends["bend_deg"].idxmax()]
    return {"bend": f"{worst['bend_deg']:.2g}", "bend_n": int(bends["n"].sum()), "bend_arm": worst["arm"]}


def varied(rows: pd.DataFrame, nominal: pd.DataFrame) -> dict:
    """Of the page on model errors, whole sentences, since a smaller run has none of them.

    Args:
        rows, nominal: of `arm_rows.varied` and `arm_rows.episodes`; the first may be none.
    """
    own = model_error.compared(arm_rows.with_standard(rows))
    if own.empty:
        return dict.fromkeys(("lead", "setting", "gravity"), f"Variations of the plant are {absent.WORDS}.")
    medians = np.degrees(own.groupby("variation")["final_angle_rad"].median())
    angles = own.pivot_table(
        index=["arm", "start_id", "variation"], columns="controller", values="final_angle_rad", observed=True
    ).dropna()
    apart = np.degrees((angles.max(axis=1) - angles.min(axis=1)).median())
    clear = nominal[(nominal["start_set"] == "clear") & nominal["controller"].isin(model_error.SHOWN)]
    lost = int((~arm_rows.settled(arm_rows.with_standard(clear))).sum())
    settled = 100.0 * float(arm_rows.settled(own).mean())
    return {
        "lead": f"From the same start the controllers end {apart:.1g}° apart in the median; the worst variation, "
        f"{medians.idxmax()}, leaves {medians.max():.1f}°, the mildest, {medians.idxmin()}, {medians.min():.2f}°.",
        "setting": f"From clear starts, {len(own)} episodes of {float(own['horizon_s'].max()):g} s by "
        f"{own['controller'].nunique()} controllers on {len(arm_rows.arms(own))} arms. With a perfect model {lost} of "
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
    return f"Measured over predicted is {', '.join(said)}." if said else f"The comparison is {absent.WORDS}."
