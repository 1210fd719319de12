"""The page on robots commanded in velocity: limits of K dt, first-order laws, limiters, inverses, lagging servos."""

from __future__ import annotations

import functools
import math

import numpy as np
import pandas as pd

from bench.experiments.limiters import BAND, GREATEST_RATE, LIMITERS, NONE
from bench.experiments.suites import BY_EVERY_INVERSE
from bench.findings.claims.adequacy import DETOUR
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.needs import Advice
from bench.findings.selection.robots import VELOCITIES, advise_for
from bench.findings.selection.words import standing
from bench.findings.theory.velocity_limits import lagged, with_theory
from bench.law.contenders.registry import known_inverses
from report.figures.arms import arm_looks
from report.figures.comparison.cells import by_family
from report.figures.kit import families, html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table

DEG = 180.0 / math.pi

BENT_SUPREMUM = math.acos(1.0 / math.sqrt(3.0))
"""The most [rad] by which a clamp per axis turns a vector: from beside an axis to the box's diagonal."""

SITUATIONS = Table("Situation | Law | Ties with")
LIMITED = Table(
    "Limiter | Starts | Settled | Median [s]:.2f | Way over the shortest:.3f | Bent by [deg]:.1f | Left [deg]:.2f"
)
INVERSES = Table(
    "Inverse | Starts | Settled | Settled, servos lag | Median [s] | Joint rates [rad/s]:.0f | K dt | Closed form",
    words=("Settled", "Settled, servos lag", "Median [s]", "K dt", "Closed form"),
)


@functools.cache
def told(run: Run) -> pd.DataFrame:
    """Rows of episodes, with `law` and `settled`; none where the run has none."""
    rows = run.any_rows("velocity")
    if rows.empty:
        return rows
    law = rows["contender"].astype(str).str.partition("@")[0]
    return rows.assign(law=law, settled=rows["outcome"].astype(str) == "settled")


@functools.cache
def limits(run: Run) -> pd.DataFrame:
    """Measured limits beside theory's, with `law`."""
    rows = run.any_rows("velocity-limits")
    if rows.empty:
        return rows
    return with_theory(rows).assign(law=rows["contender"].astype(str).str.partition("@")[0])


@functools.cache
def choice(run: Run) -> Advice | None:
    """What the rule advises; None if the run compares no laws."""
    try:
        return advise_for(VELOCITIES, run.folder)
    except NoEvidence:
        return None


def plain(run: Run, start_set: str) -> pd.DataFrame:
    """Rows of the free body at the full share of K, without a limiter."""
    rows = told(run)
    return rows[(rows["arm"] == "") & (rows["limiter"] == "none") & (rows["share"] == 1.0)].pipe(
        lambda own: own[own["start_set"] == start_set]
    )


def facts(run: Run) -> dict:
    """Return the numbers of the text; none where no law of the run commands velocities."""
    rows, found, advice = told(run), limits(run), choice(run)
    if rows.empty or found.empty or advice is None:
        return {}
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
    """The largest K dt of the logarithm near the goal, measured on the free body."""
    own = found[(found["law"] == "rotation-vector") & (found["arm"] == "") & (found["share"] == 1.0)]
    own = own[own["reach"] == "near"]
    return f"{float(own['k_dt'].iloc[0]):.3g}" if len(own) else None


def named(laws) -> str:
    """Laws by their short words."""
    return "; ".join(families.word(name) for name in families.in_order(laws)) or "none"


def lead(advice: Advice) -> str:
    """What is advised, and with whom it ties."""
    if advice.default.law is None:
        return "No law of this run settles from every start when it commands velocities."
    said = standing(advice.default, families.word)
    return f"{families.word(advice.default.law)}. {said[0].upper()}{said[1:]}"


def tables(run: Run) -> dict:
    """Situations, laws, limiters, inverses."""
    rows, advice = told(run), choice(run)
    return {
        "tab_situations": SITUATIONS(situations(advice)) if advice else None,
        "tab_laws": given(rows, lambda _: by_family(rows["law"].unique(), lambda law: line(run, law))),
        "tab_limiters": LIMITED(limited(run)) if len(rows) else None,
        "tab_inverses": INVERSES(by_inverse(run)) if len(rows) and len(limits(run)) else None,
    }


def situations(advice: Advice) -> list[tuple]:
    """A row a situation in which another law is better, after what is advised where nothing else is known."""
    return [
        (one.need.words, families.word(one.law) if one.law else "none", named(one.tied))
        for one in (advice.default, *advice.exceptions)
    ]


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


def limited(run: Run) -> list[tuple]:
    """A row a limiter."""
    found = ((name, of_limiter(run, name)) for name in LIMITERS)
    return [
        (
            LIMITERS[name].title,
            len(own),
            int(own["settled"].sum()),
            own["settling_time_s"].median(),
            own["path_ratio"].max(),
            DEG * own["bent_rad"].max(),
            DEG * own["final_angle_rad"].max(),
        )
        for name, own in sorted(found, key=lambda pair: pair[0] != NONE)
        if len(own)
    ]


def by_inverse(run: Run) -> list[tuple]:
    """A row an inverse, all arms that take it together."""
    rows, found = told(run), limits(run)
    lines = []
    for name, one in known_inverses().items():
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
    """The least and the greatest, once if they look alike."""
    low, high = f"{values.min():.3g}", f"{values.max():.3g}"
    return low if low == high else f"{low} to {high}"


def figures(run: Run) -> dict:
    """The limit against the servos' lag."""
    own = limits(run)
    own = own[(own["arm"] != "") & (own["inverse"].isin(("solve", "pseudo-inverse")))] if len(own) else own
    own = own[own.groupby(["arm", "inverse"], observed=True)["lag_ticks"].transform("nunique") > 1] if len(own) else own
    return {"servo-lag": given(own, servo_lag)}


@responsive_picture
def servo_lag(rows: pd.DataFrame, narrow: bool):
    """The largest K dt against T over dt: theory's curve, and every arm's."""
    figure, axes = style.panels(height=3.4 if narrow else 3.0, narrow=narrow)
    lags = np.geomspace(0.05, 8.0, 400)
    axes.plot(lags, [lagged(lag) for lag in lags], color=style.INK, linewidth=0.9, zorder=1)
    for arm in arm_looks.arms(rows):
        own, look = rows[(rows["arm"] == arm) & (rows["lag_ticks"] > 0.0)], arm_looks.look(arm)
        axes.plot(
            own["lag_ticks"],
            own["k_dt"],
            color=look.colour,
            marker=look.marker,
            linestyle="none",
            alpha=0.7,
            label=arm_looks.title(arm),
        )
    axes.axhline(2.0, color=style.MUTED, linewidth=0.7, linestyle=style.DASHED)
    axes.set(
        xscale="log", ylim=(1.5, 4.5), xlabel="servo's time constant over the tick, $T/dt$", ylabel="largest $K\\,dt$"
    )
    axes.set_xticks([0.1, 0.25, 1, 4], ["0.1", "0.25", "1", "4"])
    axes.legend(loc="upper right")
    top = max((lagged(lag), lag) for lag in lags)
    return figure, (
        f"Largest stable K dt against the servo's lag: 2 without one, up to {top[0]:.1f} at T = {top[1]:.2f} dt, "
        f"towards 2 again for slow servos; {rows['arm'].nunique()} arms lie on the curve."
    )
