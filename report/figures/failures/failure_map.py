"""What the page on failures shows: shares of SO(3), maps, the exact points at which a law fails, how far they are."""

import functools
import math
from collections.abc import Iterable, Iterator

import numpy as np
import pandas as pd
from scipy.spatial.transform import Rotation

from bench.experiments.tables import read
from bench.findings.start_sets import AT_REST
from bench.findings.theory import held_goals
from bench.law.contender import PAPERS_GAINS
from bench.law.contenders.registry import find_contender, papers_coordinates
from bench.law.so3 import from_quaternion
from report.figures.failures import ball, maps, pole_steps, world_map
from report.figures.kit import html, laws
from report.figures.kit.page import Run
from report.figures.kit.rows import LINEARIZED, SHORT, lost, of
from report.figures.kit.share import share
from report.figures.kit.tables import Table

EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad) and what rounding leaves of an exact one (4e-16 rad)."""

NEAR_RAD = 0.1 + EXACT_RAD
"""Of a pole: the first decade of the set poles, 0.1 rad with its rounding."""

SHARES = Table("Law | Starts | Settled [%]:.2f | 95 % interval | The others")
HELD = Table("Axis | Angle [°]:.2f | alpha [°]:.2f | beta [°]:.2f | Bound on alpha [°]:.2f")
ALONG = ((0, 0, 1), (0, 1, 1), (1, 0, 1), (1, 1, 1), (-1, 1, 1), (1, 0, 0))
"""Axes of goals."""

STEPS = Table("Step [µs] | Lost [%]:.2f | 95 % interval | Starts | of them before too")
EXACT = Table("Law | Start on | Tried | Failing | How | One of them (w, x, y, z)")
NEAREST = Table("Law | Axes | Failing | Smallest:.1f | About | Median:.1f | Nearest start:.1f")


@functools.cache
def continuous(run: Run) -> pd.DataFrame:
    """Return the episodes on the continuous plant whose end no shorter step moves."""
    return read.converged(run.rows("episodes", task="free-body", engine="ideal-rk4"))


def facts(run: Run) -> dict:
    """How much each law loses, where the linearized law's failures begin, and how far along each axis."""
    episodes, boundaries = continuous(run), run.rows("boundaries")
    linearized = of(episodes, LINEARIZED)
    failed = lost(linearized)
    outside = linearized[linearized["alpha0"].abs() > np.pi / 2.0]
    along = {key: boundaries.loc[boundaries["contender"] == name, "fails_from_rad"] for key, name in SHORT.items()}
    return {
        **maps.facts(),
        "held_level": f"{math.degrees(math.acos(held_goals.least_cosine(0.0, PAPERS_GAINS))):.1f}",
        "held_share": f"{100.0 * held_goals.held_share(PAPERS_GAINS):.1f}",
        "stepped": html.number(pole_steps.STARTS),
        "n": len(linearized),
        "failed_l": len(failed),
        "failed_others": counted(len(lost(of(episodes, SHORT[letter]))) for letter in "mf"),
        "axes_l": int(along["l"].notna().sum()),
        "axes_others": counted(int(along[letter].notna().sum()) for letter in "mf"),
        "mapped_l": maps.lost_at_rest(LINEARIZED),
        "least": f"{np.floor(np.degrees(failed['alpha0'].abs().min())):.0f}",
        "least_gamma": f"{np.degrees(failed['gamma0'].abs().min()):.0f}",
        "inside": int((failed["alpha0"].abs() < np.pi / 2.0).sum()),
        "outside": f"{100 * (1 - len(lost(outside)) / len(outside)):.0f}",
        "reach": f"{np.degrees(boundaries['settled_to_rad'].max()):.0f}",
        "axes": len(along["l"]),
        "axes_first": f"{np.degrees(along['l'].min()):.0f}",
        "axes_median": f"{np.degrees(along['l'].median()):.0f}",
    }


def counted(losses: Iterable[int]) -> str:
    """How many each law loses; none where no law loses any."""
    each = list(losses)
    return " and ".join(map(str, each)) if any(each) else "none"


def tables(run: Run) -> dict:
    """Shares by law and engine; exact points; nearest failures in degrees."""
    episodes = continuous(run)
    return {
        "tab_shares": SHARES(shares(episodes)),
        "tab_mapped": maps.at_rest(),
        "tab_spun": maps.spinning(),
        "tab_held": HELD(held()),
        "tab_steps": STEPS(pole_steps.rows()),
        "tab_exact": EXACT(exact_points(episodes)),
        "tab_nearest": NEAREST(nearest(run.rows("boundaries"), episodes)),
    }


def figures(run: Run) -> dict:
    """Map of the world, and ball."""
    return {"failure-map": world_map.world(continuous(run)), "ball": ball.ball(continuous(run))}


def held() -> Iterator[tuple]:
    """Axis: the first goal that the linearized law does not hold, its angles, and the closed form's bound there."""
    law, chart = find_contender(LINEARIZED).law, papers_coordinates().chart
    for axis in ALONG:
        unit = np.array(axis) / np.linalg.norm(axis)
        angle, name = held_goals.held_to(law, unit, PAPERS_GAINS), html.together(str(axis))
        if angle < math.pi:
            alpha, beta, _ = chart(from_quaternion((math.cos(angle / 2.0), *(math.sin(angle / 2.0) * unit)))).E
            bound = math.acos(held_goals.least_cosine(beta, PAPERS_GAINS))
            yield name, *map(math.degrees, (angle, alpha, beta, bound))
        else:
            yield name, None, None, None, None


def outcomes(rows: pd.DataFrame) -> str:
    """How those that did not settle ended, in words."""
    failed = lost(rows)["outcome"].astype(str).value_counts()
    return ", ".join(f"{html.number(count)} {word}" for word, count in failed.items()) or "none"


def shares(episodes: pd.DataFrame) -> Iterator[tuple]:
    """Law: uniform starts, share that settles with its interval, how the others end."""
    for name, title, own in laws.each(episodes[episodes["start_set"] == "uniform"]):
        settled = share(int((own["outcome"] == "settled").sum()), len(own))
        interval = html.together(f"{100.0 * settled.low:.2f} to {100.0 * settled.high:.2f}")
        yield html.law(name, title), settled.n, 100.0 * settled.value, interval, outcomes(own)


def places(rows: pd.DataFrame) -> pd.Series:
    """On which special point of SO(3) each start lies exactly, or that it is near a pole, in words."""
    half = math.pi - rows["angle0_rad"] < EXACT_RAD
    pole = math.pi / 2.0 - rows["beta0"].abs() < EXACT_RAD
    wrap = (math.pi - rows["alpha0"].abs() < EXACT_RAD) | (math.pi - rows["gamma0"].abs() < EXACT_RAD)
    beside = math.pi / 2.0 - rows["beta0"].abs() <= NEAR_RAD
    words = np.select(
        [half & pole, half, pole, wrap, beside],
        ["180° rotation and pole", "180° rotation", "pole", "jump of atan2", "near a pole"],
        "elsewhere",
    )
    return pd.Series(words, rows.index)


def once(rows: pd.DataFrame) -> pd.DataFrame:
    """Each orientation once a law, though several sets have it."""
    return rows[~orientation(rows).assign(contender=rows["contender"]).duplicated()]


def orientation(rows: pd.DataFrame) -> pd.DataFrame:
    """R, which both quaternions of an orientation share, to the last digit but three."""
    turns = Rotation.from_quat(rows[["quat_w", "quat_x", "quat_y", "quat_z"]].to_numpy(), scalar_first=True)
    return pd.DataFrame(turns.as_matrix().reshape(-1, 9).round(13), rows.index)


def exact_points(episodes: pd.DataFrame) -> Iterator[tuple]:
    """Law and special place: directed starts exactly there, how many fail and how, and one of them."""
    directed = once(episodes[episodes["start_set"].isin(AT_REST)])
    for name, title, own in laws.each(directed.assign(place=places(directed))):
        for place, part in own.groupby("place", sort=True):
            failed = lost(part)
            if failed.empty:
                continue
            quat = ", ".join(html.cell(float(failed.iloc[0][f"quat_{axis}"])) for axis in "wxyz")
            one = html.together(f"({quat})") if place not in ("near a pole", "elsewhere") else None
            yield html.law(name, title), place, len(part), len(failed), outcomes(part), one


def nearest(boundaries: pd.DataFrame, episodes: pd.DataFrame) -> Iterator[tuple]:
    """Law: axes with a failing angle, its smallest and median, the axis of the smallest; smallest failing start."""
    at_rest = lost(episodes[episodes["start_set"].isin(("uniform", *AT_REST))])
    for name, title, own in laws.each(boundaries):
        fails = own["fails_from_rad"].dropna()
        starts = at_rest.loc[at_rest["contender"] == name, "angle0_rad"]
        axis = None  # a dash in the table, as for any other that is missing
        if len(fails):
            first = own.loc[fails.idxmin()]
            axis = html.together("(" + ", ".join(html.cell(float(first[f"axis_{one}"]), ".2f") for one in "xyz") + ")")
        smallest, median, start = (float(np.degrees(one)) for one in (fails.min(), fails.median(), starts.min()))
        yield html.law(name, title), len(own), len(fails), smallest, axis, median, start
