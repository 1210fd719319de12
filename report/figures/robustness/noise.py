"""The page on noise."""

from __future__ import annotations

import math
from collections.abc import Callable

import pandas as pd

from bench.findings.theory import robustness_theory
from report.figures.kit import families
from report.figures.kit.page import Run, given
from report.figures.robustness.bundle import Strand, bundle
from report.figures.robustness.rows import DEG, along, gains, levels, losses, medians, starts, with_unit
from report.figures.robustness.tables import by_level, costs

ATTITUDE, RATE = "attitude-noise", "rate-noise"


def theory(rows: pd.DataFrame, what: str) -> Callable[[float], float]:
    """Standard deviation of noise on the attitude or the rate -> root mean square angle that it leaves [rad]."""
    kp, kv = gains(rows)
    gain = robustness_theory.noisy_rms(kp, kv, float(rows["dt_s"].iloc[0]), **{what: 1.0})
    return lambda level: gain * level


def over_theory(rows: pd.DataFrame, gain: float) -> list[float]:
    """What noise leaves over what it leaves by theory: a number for each law and level."""
    noisy = rows[rows["good"] & (rows["level"] > 0.0)]
    return [
        math.sqrt(float((part["tail_rms_rad"] ** 2).mean())) / (gain * level)
        for (law, level), part in noisy.groupby(["contender", "level"], observed=True)
        if law not in families.CONTROLS
    ]


def facts(run: Run) -> dict:
    """What noise leaves, by theory and in the episodes."""
    attitude, rate = along(run, ATTITUDE), along(run, RATE)
    if attitude.empty or rate.empty:
        return {}
    on_attitude, on_rate = theory(attitude, "attitude")(1.0), theory(rate, "rate")(1.0)
    ratios = over_theory(attitude, on_attitude) + over_theory(rate, on_rate)
    worst_attitude, worst_rate = max(levels(attitude)), max(levels(rate))
    variation = medians(rate, "variation")
    return {
        "n": starts(attitude),
        "tick_ms": f"{1000.0 * float(attitude['dt_s'].iloc[0]):g}",
        "gain_a": f"{on_attitude:.3f}",
        "part": f"{1.0 / on_attitude:.0f}",
        "gain_r": f"{DEG * on_rate:.2f}",
        "ratio_low": f"{min(ratios):.2f}",
        "ratio_high": f"{max(ratios):.2f}",
        "jitter": f"{robustness_theory.jitter(*gains(attitude), rate=worst_rate):.0f}",
        "shake": f"{(variation.loc[worst_rate] / variation.loc[0.0]).median():.0f}",
        "worst_a": with_unit(worst_attitude, ATTITUDE),
        "worst_r": with_unit(worst_rate, RATE),
        "left_a": f"{DEG * medians(attitude, 'tail_rms_rad').loc[worst_attitude].median():.2f}",
        "left_r": f"{DEG * medians(rate, 'tail_rms_rad').loc[worst_rate].median():.2f}",
        "losses_a": losses(attitude, ATTITUDE),
        "losses_r": losses(rate, RATE),
    }


def tables(run: Run) -> dict:
    """What both kinds of noise leave, and what noise on the rate takes."""
    attitude, rate = along(run, ATTITUDE), along(run, RATE)
    return {
        "tab_attitude": by_level(attitude, ATTITUDE),
        "tab_rate": by_level(rate, RATE),
        "tab_costs": costs(rate, RATE),
    }


def figures(run: Run) -> dict:
    """What is left by level."""
    rows = {name: along(run, name) for name in (ATTITUDE, RATE)}
    words = {ATTITUDE: "attitude", RATE: "rate"}
    return {
        "noise": given(
            rows[ATTITUDE],
            lambda _: bundle([Strand(name, own, theory(own, words[name])) for name, own in rows.items()]),
        )
    }
