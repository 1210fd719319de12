"""The page on robots commanded in velocity: limits of K dt, first-order laws, limiters, inverses, lagging servos."""

from __future__ import annotations

import functools
import math
from typing import Any

import numpy as np
import pandas as pd

from bench.experiments.limiters import BAND, GREATEST_RATE
from bench.experiments.suites import BY_EVERY_INVERSE
from bench.findings.claims.adequacy import DETOUR
from bench.findings.selection.needs import Advice
from bench.findings.selection.robots import VELOCITIES, advise_for
from bench.findings.selection.words import standing
from bench.findings.theory.velocity_limits import with_theory
from bench.law.contenders.registry import contenders
from report.figures.comparison.cells import by_law
from report.figures.kit import families, html
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

DEG = 180.0 / math.pi

BENT_SUPREMUM = math.acos(1.0 / math.sqrt(3.0))
"""The most [rad] by which a clamp per axis turns a vector: from beside an axis to the box's diagonal."""

INVERSES = Table(
    "Inverse | Starts | Settled | Settled, servos lag | Median [s] | Joint rates [rad/s]:.0f | K dt | Closed form",
    words=("Settled", "Settled, servos lag", "Median [s]", "K dt", "Closed form"),
)


@functools.cache
def told(run: Run) -> pd.DataFrame:
    """Rows of episodes, with `law` and `settled`; none where the run has none."""
    rows = run.rows("velocity")
    law = rows["contender"].astype(str).str.partition("@")[0]
    return rows.assign(law=law, settled=rows["outcome"].astype(str) == "settled")


@functools.cache
def limits(run: Run) -> pd.DataFrame:
    """Measured limits beside theory's, with `law`."""
    rows = run.rows("velocity-limits")
    return with_theory(rows).assign(law=rows["contender"].astype(str).str.partition("@")[0])


def plain(run: Run, start_set: str) -> pd.DataFrame:
    """Rows of the free body at the full share of K, without a limiter."""
    rows = told(run)
    return rows[(rows["arm"] == "") & (rows["limiter"] == "none") & (rows["share"] == 1.0)].pipe(
        lambda own: own[own["start_set"] == start_set]
    )


def facts(run: Run) -> dict:
    """Return the numbers of the text; none where no law of the run commands velocities."""
    rows, found, advice = told(run), limits(run), advise_for(VELOCITIES, run.folder)
    uniform, exact = plain(run, "uniform"), plain(run, "half-turn")
    shares = exact.groupby("law")["settled"].mean()
    ways = uniform[uniform["settled"]].groupby("law")["path_ratio"].max()
    has_theory = found[found["k_dt_theory"] > 0.0]
    gaps = (found["k_dt"] - found["k_dt_theory"]).abs() / found["k_dt_theory"]
    transposed = found[(found["inverse"] == "transpose")]["k_dt"]
    lag_s, gain = float(rows["lag_s"].max()), float(rows["gain"].iloc[0])
    cut = {name: of_limiter(run, name) for name in ("axis-clamp", "deadband")}
    return {
        "lead": lead(advice),
        "gain": gain,
        "log_limit": log_limit(found),
        "tick": f"{1000 * float(rows['dt_s'].iloc[0]):g}",
        "uniform": len(uniform) // uniform["law"].nunique(),
        "exact": len(exact) // exact["law"].nunique(),
        "bound": f"{GREATEST_RATE:g}",
        "band": f"{BAND:g}",
        "detour": f"{DETOUR:g}",
        "others": len(has_theory),
        "dead": named(shares.index[shares == 0.0]),
        "unwinds": named(ways.index[ways >= DETOUR]),
        "worst_gap": f"{100 * float(gaps[has_theory.index].max()):.1g}",
        "lag": f"{1000 * lag_s:g}",
        "overshoots": f"{1000 / (4.0 * gain):g}",
        "transpose": f"{transposed.min():.2f} to {transposed.max():.2f}" if len(transposed) else None,
        "bent": f"{DEG * cut['axis-clamp']['bent_rad'].max():.0f}",
        "bent_sup": f"{DEG * BENT_SUPREMUM:.1f}",
        "longer": f"{100 * (cut['axis-clamp']['path_ratio'].max() - 1):.0f}",
        "left": f"{DEG * cut['deadband']['final_angle_rad'].max():.2f}",
    }


def log_limit(found: pd.DataFrame) -> str | None:
    """Return the largest K dt of the logarithm near the goal, measured on the free body."""
    own = found[(found["law"] == "rotation-vector") & (found["arm"] == "") & (found["share"] == 1.0)]
    own = own[own["reach"] == "near"]
    return f"{float(own['k_dt'].iloc[0]):.3g}" if len(own) else None


def named(laws: Any) -> str:
    """Laws by their short words."""
    return "; ".join(families.word(name) for name in families.in_order(laws)) or "none"


def lead(advice: Advice) -> str:
    """Return what is advised, and with whom it ties."""
    if advice.default.law is None:
        return "No law of this run settles from every start when it commands velocities."
    said = standing(advice.default, families.word)
    return f"{families.word(advice.default.law)}. {said[0].upper()}{said[1:]}"


def tables(run: Run) -> dict:
    """Return laws and inverses."""
    rows = told(run)
    return {
        "tab_laws": by_law(rows["law"].unique(), lambda law: line(run, law)),
        "tab_inverses": INVERSES(by_inverse(run)),
    }


def line(run: Run, law: str) -> dict:
    """One law: its limits, how fast it is, 180° rotations, its way, its peak, arms."""
    uniform, exact = (part[part["law"] == law] for part in (plain(run, name) for name in ("uniform", "half-turn")))
    own = limits(run)
    own = own[(own["law"] == law) & (own["arm"] == "") & (own["share"] == 1.0)] if len(own) else own
    times = uniform["settling_time_s"].where(uniform["settled"])
    return {
        **{f"K dt, {reach}": limit(own, reach) for reach in ("near", "far")},
        "Settled in [s]": f"{times.median():.2f}, {times.max():.2f}" if times.notna().any() else html.MISSING,
        "Of 180°": f"{int(exact['settled'].sum())} of {len(exact)}",
        "Longest path": f"{uniform['path_ratio'].max():.2f}",
        "Peak [rad/s]": f"{uniform['peak_omega'].max():.0f}",
    }


def limit(own: pd.DataFrame, reach: str) -> str:
    """Measured, and by theory in brackets."""
    found = own[own["reach"] == reach] if len(own) else own
    if found.empty:
        return html.MISSING
    theory = float(found["k_dt_theory"].iloc[0])
    said = f" ({theory:.3g})" if np.isfinite(theory) else ""
    return f"{float(found['k_dt'].iloc[0]):.3g}{said}"


def of_limiter(run: Run, name: str) -> pd.DataFrame:
    """Rows of the law that is resolved by every inverse, behind a limiter; without one its first so many starts."""
    rows = told(run)
    own = rows[(rows["law"] == BY_EVERY_INVERSE) & (rows["arm"] == "") & (rows["start_set"] == "uniform")]
    few = set(own.loc[own["limiter"] != "none", "start_id"])
    return own[(own["limiter"] == name) & own["start_id"].isin(few)]


def by_inverse(run: Run) -> list[tuple]:
    """Return a row an inverse, all arms that take it together."""
    rows, found = told(run), limits(run)
    lines = []
    for name, one in contenders("inverses").items():
        own = rows[(rows["law"] == BY_EVERY_INVERSE) & (rows["inverse"] == name)]
        near = found[(found["inverse"] == name) & (found["lag_ticks"] == 0.0)]
        if own.empty or near.empty:
            continue
        at_once, late = own[own["lag_s"] == 0.0], own[own["lag_s"] > 0.0]
        times = at_once["settling_time_s"].where(at_once["settled"])
        lines.append(
            (
                one.title,
                len(at_once),
                f"{int(at_once['settled'].sum())}",
                f"{int(late['settled'].sum())}",
                f"{times.median():.2f}",
                at_once["peak_rate"].max(),
                between(near["k_dt"]),
                between(near["k_dt_theory"]),
            )
        )
    return lines


def between(values: pd.Series) -> str:
    """Return the least and the greatest, once if they look alike."""
    low, high = f"{values.min():.3g}", f"{values.max():.3g}"
    return low if low == high else f"{low} to {high}"
