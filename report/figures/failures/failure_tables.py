"""Failures in numbers: shares of SO(3), the exact points at which a law fails, and how far its failures are."""

import math

import numpy as np
import pandas as pd

from report.figures.failures.failure_map import SETS
from report.figures.kit import html, laws
from report.figures.kit.share import share

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad) and what rounding leaves of an exact one (4e-16 rad)."""

NEAR_RAD = 0.1 + EXACT_RAD
"""Of a pole: the first decade of the set poles, 0.1 rad with its rounding."""

ENGINES = ("ideal-rk4", "ideal-held", "native", "reference")


def outcomes(rows: pd.DataFrame) -> str:
    """How those that did not settle ended, in words."""
    failed = rows.loc[rows["outcome"] != "settled", "outcome"].astype(str).value_counts()
    return ", ".join(f"{html.number(count)} {word}" for word, count in failed.items()) or "none"


def shares(episodes: pd.DataFrame) -> pd.DataFrame:
    """Law and engine: uniform starts, share that settles with its interval, how the others end."""
    rows = []
    uniform = episodes[episodes["start_set"] == "uniform"]
    for name, title, own in laws.each(uniform):
        for engine in ENGINES:
            part = own[own["engine"] == engine]
            if len(part):
                settled = share(int((part["outcome"] == "settled").sum()), len(part))
                rows.append(
                    {
                        "Law": html.law(name, title),
                        "Engine": html.together(engine),
                        "Starts": settled.n,
                        "Settled [%]": 100.0 * settled.value,
                        "95 % interval": html.together(f"{100.0 * settled.low:.2f} to {100.0 * settled.high:.2f}"),
                        "The others": outcomes(part),
                    }
                )
    return pd.DataFrame(rows)


def places(rows: pd.DataFrame) -> pd.Series:
    """On which special point of SO(3) each start lies exactly, or that it is near a pole, in words."""
    half = math.pi - rows["angle0_rad"] < EXACT_RAD
    pole = math.pi / 2.0 - rows["beta0"].abs() < EXACT_RAD
    wrap = (math.pi - rows["alpha0"].abs() < EXACT_RAD) | (math.pi - rows["gamma0"].abs() < EXACT_RAD)
    beside = math.pi / 2.0 - rows["beta0"].abs() <= NEAR_RAD
    words = np.select(
        [half & pole, half, pole, wrap, beside],
        ["half turn and pole", "half turn", "pole", "jump of atan2", "near a pole"],
        "elsewhere",
    )
    return pd.Series(words, rows.index)


def exact_points(episodes: pd.DataFrame) -> pd.DataFrame:
    """Law and special place: directed starts exactly there, how many fail and how, and one of them."""
    directed = episodes[episodes["start_set"].isin(SETS)]
    directed = directed.assign(place=places(directed))
    rows = []
    for name, title, own in laws.each(directed):
        for place, part in own.groupby("place", sort=True):
            failed = part[part["outcome"] != "settled"]
            if failed.empty:
                continue
            first = failed.iloc[0]
            quat = ", ".join(html.cell(float(first[f"quat_{axis}"])) for axis in "wxyz")
            is_exact = place not in ("near a pole", "elsewhere")
            rows.append(
                {
                    "Law": html.law(name, title),
                    "Start on": place,
                    "Tried": len(part),
                    "Failing": len(failed),
                    "How": outcomes(part),
                    "One of them (w, x, y, z)": html.together(f"({quat})") if is_exact else None,
                }
            )
    return pd.DataFrame(rows)


def nearest(boundaries: pd.DataFrame, episodes: pd.DataFrame) -> pd.DataFrame:
    """Law: axes with a failing angle, its smallest and median, the axis of the smallest; smallest failing start."""
    at_rest = episodes[episodes["start_set"].isin(("uniform", *SETS))]
    rows = []
    for name, title, own in laws.each(boundaries):
        fails = own["fails_from_rad"].dropna()
        starts = at_rest[(at_rest["contender"] == name) & (at_rest["outcome"] != "settled")]
        axis = None  # a dash in the table
        if len(fails):
            first = own.loc[fails.idxmin()]
            axis = html.together("(" + ", ".join(html.cell(float(first[f"axis_{one}"]), ".2f") for one in "xyz") + ")")
        rows.append(
            {
                "Law": html.law(name, title),
                "Axes": len(own),
                "Failing": len(fails),
                "Smallest": float(np.degrees(fails.min())) if len(fails) else None,
                "About": axis,
                "Median": float(np.degrees(fails.median())) if len(fails) else None,
                "Nearest start": float(np.degrees(starts["angle0_rad"].min())) if len(starts) else None,
            }
        )
    return pd.DataFrame(rows)
