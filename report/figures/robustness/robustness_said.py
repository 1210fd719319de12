"""The numbers in the sentences of the other pages on trouble: each function gives what one page pastes, key by key."""

from __future__ import annotations

import math
from collections.abc import Callable

import pandas as pd

from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.robustness import robustness_half_turn, robustness_reach, robustness_rows
from report.figures.robustness.robustness_half_turn import UNBOUNDED
from report.figures.robustness.robustness_words import DEG, ends, listed, losses, medians, needs, own_laws, slower
from tasks.condition import RATE, RATE_AND_ACCELERATION, UNTOLD
from tasks.rules import RULES

FARTHER = 1.05
"""Ratio of two ways from which one law turns farther than another from the same start."""


@needs("laws axes lost slowed held_deg starts episodes best fewest weakest most harmless hardest hardest_n untold_n")
def overview(rows: pd.DataFrame, found: dict) -> dict:
    """Of the overview; rows of the whole table, and how far each law goes."""
    return robustness_reach.facts(found)


def noise_theory(rows: pd.DataFrame, what: str) -> Callable[[float], float]:
    """Standard deviation of noise on the attitude or the rate -> root mean square angle that it leaves [rad]."""
    kp, kv = robustness_rows.gains(rows)
    gain = robustness_theory.noisy_rms(kp, kv, float(rows["dt_s"].iloc[0]), **{what: 1.0})
    return lambda level: gain * level


@needs("n tick_ms gain_a part gain_r ratio_low ratio_high jitter shake worst_a worst_r left_a left_r losses_a losses_r")
def noise(attitude: pd.DataFrame, rate: pd.DataFrame) -> dict:
    """Of the page on noise."""
    kp, kv = robustness_rows.gains(attitude)
    period = float(attitude["dt_s"].iloc[0])
    gains = [noise_theory(rows, word)(1.0) for rows, word in ((attitude, "attitude"), (rate, "rate"))]
    ratios = [
        math.sqrt(float((part["tail_rms_rad"] ** 2).mean())) / (gain * level)
        for rows, gain in zip((attitude, rate), gains, strict=True)
        for (law, level), part in rows[rows["good"] & (rows["level"] > 0.0)].groupby(
            ["contender", "level"], observed=True
        )
        if law not in families.CONTROLS
    ]
    worst = [max(robustness_rows.levels(rows)) for rows in (attitude, rate)]
    calm = medians(rate, "variation").loc[0.0]
    loud = medians(rate, "variation").loc[worst[1]]
    return {
        "n": int(attitude.groupby(["contender", "level"], observed=True).size().max()),
        "tick_ms": f"{1000.0 * period:g}",
        "gain_a": f"{gains[0]:.3f}",
        "part": f"{1.0 / gains[0]:.0f}",
        "gain_r": f"{DEG * gains[1]:.2f}",
        "ratio_low": f"{min(ratios):.2f}",
        "ratio_high": f"{max(ratios):.2f}",
        "jitter": f"{robustness_theory.jitter(kp, kv, rate=worst[1]):.0f}",
        "shake": f"{(loud / calm).median():.0f}",
        "worst_a": robustness_rows.said(worst[0], "attitude-noise"),
        "worst_r": robustness_rows.said(worst[1], "rate-noise"),
        "left_a": f"{DEG * medians(attitude, 'tail_rms_rad').loc[worst[0]].median():.2f}",
        "left_r": f"{DEG * medians(rate, 'tail_rms_rad').loc[worst[1]].median():.2f}",
        "losses_a": losses(attitude, "attitude-noise"),
        "losses_r": losses(rate, "rate-noise"),
    }


@needs(
    "n agree told known minding blind blind_free middle blind_middle memory_middle stuck least most chord "
    "chord_least chord_exact faster hybrid hybrid_deg delta late late_deg mrp mrp_deg switch"
)
def half_turn(rows: pd.DataFrame) -> dict:
    """Of the page on the worst noise at the half turn."""
    return robustness_half_turn.facts(rows)


def over_least(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows of saturation with `over_least`: settling time over the least that the bound allows from that angle."""
    if rows.empty:
        return rows
    least = [
        robustness_theory.least_settling(angle, bound, RULES.tolerance)
        for angle, bound in zip(rows["angle0_rad"], rows["level"], strict=True)
    ]
    return rows.assign(over_least=rows["time_s"] / least)


@needs(
    "n laws worst losses record record_law record_bound tight tight_law place of slack slack_law mild mild_bound "
    "over_law over tamed untamed"
)
def saturation(rows: pd.DataFrame, free: pd.DataFrame) -> dict:
    """Of the page on the bound; rows of `over_least`, and rows with the same starts and no bound, at level 0."""
    table = medians(rows, "over_least")
    kept = rows[rows["contender"].isin(own_laws(rows))]
    best, tight, mild = kept.loc[kept["over_least"].idxmin()], min(table.index), max(table.index)
    overshoot = medians(rows, "overshoot_rad").loc[tight]
    return {
        **ends(rows, "saturation"),
        "record": f"{best['over_least']:.3f}",
        "record_law": families.word(str(best["contender"])),
        "record_bound": robustness_rows.said(float(best["level"]), "saturation"),
        "tight": f"{table.loc[tight].min():.2f}",
        "tight_law": families.word(table.loc[tight].idxmin()),
        "place": int(table.loc[mild].rank()[table.loc[tight].idxmin()]),
        "of": table.shape[1],
        "slack": f"{table.loc[tight].max():.2f}",
        "slack_law": families.word(table.loc[tight].idxmax()),
        "mild": f"{table.loc[mild].min():.0f}",
        "mild_bound": robustness_rows.said(mild, "saturation"),
        "over_law": families.word(overshoot.idxmax()),
        "over": f"{DEG * overshoot.max():.0f}",
        "tamed": listed(_settled(rows, law, tight) for law in UNBOUNDED if law in table),
        "untamed": listed(_settled(free, law, 0.0) for law in UNBOUNDED if law in table),
    }


def _settled(rows: pd.DataFrame, law: str, level: float) -> str:
    own = robustness_rows.of(rows, law, level)
    return f"{families.word(law)} {int(own['good'].sum())} of {len(own)}"


def turned(rows: pd.DataFrame) -> pd.DataFrame:
    """Rows with `turned_deg`, all that the body turned [deg]."""
    return rows if rows.empty else rows.assign(turned_deg=DEG * rows["path_ratio"] * rows["angle0_rad"])


@needs(
    "n laws worst losses turns coast coast_deg rest_deg spun_deg most most_law unwound longer shorter both slowest "
    "slowest_law"
)
def spin(rows: pd.DataFrame) -> dict:
    """Of the page on the initial spin; rows of `turned`."""
    _, kv = robustness_rows.gains(rows)
    worst = robustness_rows.worst(rows, "spin")
    last = rows[(rows["level"] == worst) & rows["good"]]
    farthest = last.groupby("contender", observed=True)["turned_deg"].max()
    mine, middle = (
        farthest[[law for law in own_laws(rows) if law in farthest]],
        medians(rows, "turned_deg").median(axis=1),
    )
    hybrid, short = (
        robustness_rows.of(last, law).set_index("start_id")["turned_deg"] for law in ("hybrid", "quaternion-shortest")
    )
    ratio = (hybrid / short).dropna()
    slow = slower(rows, "spin")
    return {
        **ends(rows, "spin"),
        "turns": f"{worst / (2.0 * math.pi):.1f}",
        "coast": f"{worst / kv:g}",
        "coast_deg": f"{DEG * worst / kv:.0f}",
        "rest_deg": f"{middle.iloc[0]:.0f}",
        "spun_deg": f"{middle.loc[worst]:.0f}",
        "most": f"{mine.max():.0f}",
        "most_law": families.word(mine.idxmax()),
        "unwound": f"{farthest.get('quaternion-unwinding', math.nan):.0f}",
        "longer": int((ratio > FARTHER).sum()),
        "shorter": int((ratio < 1.0 / FARTHER).sum()),
        "both": len(ratio),
        "slowest": f"{100.0 * (slow.max() - 1.0):.0f}",
        "slowest_law": families.word(slow.idxmax()),
    }


MOVING = {"moving-goal": RATE_AND_ACCELERATION, "moving-goal-rate": RATE, "moving-goal-untold": UNTOLD}

"""Axis -> what the law is told."""


def sway_theory(rows: pd.DataFrame, name: str) -> Callable[[float], float]:
    """Peak rate -> error that the linear loop has of a goal that sways little [rad]."""
    kp, kv = robustness_rows.gains(rows)
    numbers = (float(rows[column].iloc[0]) for column in ("dt_s", "horizon_s"))
    gain = robustness_theory.swaying_rms(kp, kv, MOVING[name], *numbers)
    return lambda level: gain * level


@needs("n laws top slow lag_s told rate untold ratio_low ratio_high told_top rate_top untold_top lost lag_deg blind")
def moving(both: pd.DataFrame, rate: pd.DataFrame, untold: pd.DataFrame) -> dict:
    """Of the page on goals that move."""
    kp, kv = robustness_rows.gains(both)
    each = dict(zip(MOVING, (both, rate, untold), strict=True))
    top = robustness_rows.worst(both, "moving-goal")
    slow = min(level for level in robustness_rows.levels(both) if level > 0.0)
    left = {name: DEG * medians(rows, "tail_rms_rad") for name, rows in each.items()}
    curves = {name: sway_theory(rows, name) for name, rows in each.items()}
    ratios = [left[name].loc[slow] / (DEG * curves[name](slow)) for name in each]
    gain = {name: DEG * curves[name](1.0) for name in each}
    told, rated, blind = MOVING
    return {
        "n": int(both.groupby(["contender", "level"], observed=True).size().max()),
        "laws": len(own_laws(both)),
        "top": robustness_rows.said(top, told),
        "slow": robustness_rows.said(slow, told),
        "lag_s": f"{kv / kp:g}",
        "told": f"{gain[told]:.1g}",
        "rate": f"{gain[rated]:.2g}",
        "untold": f"{gain[blind]:.2g}",
        "ratio_low": f"{min(ratio.min() for ratio in ratios):.2f}",
        "ratio_high": f"{max(ratio.max() for ratio in ratios):.2f}",
        "told_top": f"{left[told].loc[top].median():.2g}",
        "rate_top": f"{left[rated].loc[top].median():.2g}",
        "untold_top": f"{left[blind].loc[top].median():.2g}",
        "lost": losses(both, told),
        "lag_deg": f"{DEG * kv / kp:.0f}",
        "blind": int((left[blind].loc[slow] > DEG * robustness_rows.HELD_RAD).sum()),
    }
