"""What the page on settling times shows: numbers of the three laws, and the rotation matrix towards 180°."""

import functools
import math

import pandas as pd

from bench.findings.theory import closed_form
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.rows import MATRIX, SHORT, of
from report.figures.kit.tables import Table
from report.figures.responses import settling_decades

SLOPES = Table(
    "Engine | Starts fitted | Slope [s/decade]:.4f | Closed form:.4f | Difference [%]:+.3f | Exact 180° rotations | "
    "of which settle | Horizon [s]"
)


@functools.cache
def continuous(run: Run) -> pd.DataFrame:
    """Episodes on the continuous plant."""
    return run.rows("episodes", engine="ideal-rk4")


def facts(run: Run) -> dict:
    """Return settling near zero, against the angle by law, and towards 180°."""
    episodes = continuous(run)
    kp, kv, tolerance, tick = (float(episodes[name].iloc[0]) for name in ("kp", "kv", "tolerance", "dt_s"))
    near, exact = settling_decades.near_and_exact(of(episodes, MATRIX, "half-turn"))
    late = late_ms(of(episodes, MATRIX), kp, kv, tolerance)
    values = {
        "kp": kp,
        "kv": kv,
        "band": f"{100 * tolerance:g}",
        "tick": f"{1000 * tick:g}",
        "rtol": f"{closed_form.TIGHT['rtol']:.0e}",
        "linear": f"{closed_form.linear_settling(kp, kv, tolerance):.4f}",
        "n": len(late),
        "early": f"{late.min():.2f}",
        "late": f"{late.max():.2f}",
        "slope": f"{settling_decades.slope(near):.4f}",
        "theory": f"{closed_form.decade_slope(kp, kv):.4f}",
        "near": len(near),
        "closest": f"{10.0 ** -settling_decades.decade(near['start_id']).max():.0e}",
        "longest": f"{near['settling_time_s'].max():.2f}",
        "exact": len(exact),
        "stuck": int((exact["outcome"] == "stuck").sum()),
        "horizon": float(exact["horizon_s"].max()),
        "first_k": settling_decades.FITTED[0],
        "last_k": settling_decades.FITTED[1],
    }
    for letter, name in SHORT.items():
        times = of(episodes, name)["settling_time_s"]
        values |= {f"median_{letter}": f"{times.median():.3f}", f"worst_{letter}": f"{times.max():.3f}"}
    return values


def tables(run: Run) -> dict:
    """The slope by engine."""
    half = run.rows("episodes", task="free-body", start_set="half-turn", contender=MATRIX)
    engines = half.groupby("engine", observed=True, sort=False)
    return {"tab_slopes": SLOPES(slope_on(engine, part) for engine, part in engines)}


def figures(run: Run) -> dict:
    """Draw the settling time against the distance from 180°."""
    return {"settling-decades": settling_decades.decades(of(continuous(run), MATRIX, "half-turn"))}


def late_ms(rows: pd.DataFrame, kp: float, kv: float, tolerance: float) -> pd.Series:
    """Measured settling time minus its closed form [ms], for rows of the rotation-matrix law at rest."""
    theory = closed_form.settling_curve(kp, kv, tolerance)(math.pi - rows["angle0_rad"].to_numpy())
    return 1000.0 * (rows["settling_time_s"] - theory)


def slope_on(engine: str, rows: pd.DataFrame) -> tuple:
    """Return an engine's measured slope, the closed form's, and the outcomes of exact 180° rotations."""
    near, exact = settling_decades.near_and_exact(rows)
    theory = closed_form.decade_slope(float(rows["kp"].iloc[0]), float(rows["kv"].iloc[0]))
    found = settling_decades.slope(near)
    return (
        html.together(engine),
        int(settling_decades.decade(near["start_id"]).between(*settling_decades.FITTED).sum()),
        found,
        theory,
        100.0 * (found / theory - 1.0),
        len(exact),
        int((exact["outcome"] == "settled").sum()),
        float(rows["horizon_s"].max()),
    )
