"""Name the places at which the starts of a law fail: read off the starts of a run that settle and that do not."""

from __future__ import annotations

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.claims import places as start_places
from bench.findings.claims.adequacy import HELD_RAD, NOISE
from bench.findings.claims.places import EXACT_RAD
from bench.findings.claims.tables import settled, settling_times

HALF_TURN, GIMBAL_LOCK = "exactly 180 deg", "gimbal lock"

NEAR_DEG = 170.0
"""From this initial angle on a start is near 180 degrees."""

NEAR_POLE_DEG = 10.0
"""Up to this distance of beta from 90 degrees a start is near gimbal lock."""


def describe_failures(rows: pd.DataFrame) -> list[str]:
    """Return the places at which a law fails; none if every start settles.

    rows: of one law, from rest, to zero rotation. A place at which every start fails is named first. What fails
    elsewhere is described by the narrowest place that holds all of it.
    """
    distance = start_places.boundary_distance(rows)
    places = {
        GIMBAL_LOCK: (distance["pole"] <= EXACT_RAD).to_numpy(),
        HALF_TURN: (distance["half_turn"] <= EXACT_RAD).to_numpy(),
    }
    is_failed = ~settled(rows).to_numpy()
    words = []
    is_left = np.ones(len(rows), dtype=bool)
    # The place with more failures first: some rotations by 180 degrees lie at gimbal lock, too.
    for place in sorted(places, key=lambda name: -int((places[name] & is_failed).sum())):
        here = places[place] & is_left
        if here.any() and is_failed[here].all():
            words.append(place)
            is_left &= ~here
    left = is_left & is_failed
    if left.any():
        words.append(
            _describe_rest(rows[left], {name: place[left] for name, place in places.items()})
        )
    return words


def _describe_rest(failed: pd.DataFrame, places: dict[str, np.ndarray]) -> str:
    """Return the narrowest place that holds all of some failures, or how far they are from zero at least."""
    for place, is_there in places.items():
        if is_there.all():
            return f"some at {place}"
    alpha = np.degrees(failed["alpha0"].abs().min())
    angle = np.degrees(failed["angle0_rad"].min())
    to_pole = np.degrees(start_places.boundary_distance(failed)["pole"].max())
    if angle >= NEAR_DEG:
        return f"from {_down(angle)} deg on"
    if to_pole <= NEAR_POLE_DEG:
        return f"near {GIMBAL_LOCK}"
    if alpha >= 90.0:
        return f"|alpha| > {_down(alpha)} deg"
    return f"from {_down(angle)} deg on"


def _down(degrees: float) -> str:
    """Write an angle rounded down, so that what lies above it holds every start; close to 180 with more digits."""
    digits = 0 if degrees < 179.0 else 2
    scale = 10.0**digits
    return f"{np.floor(degrees * scale) / scale:g}"


def slowness_near_half_turn(rows: pd.DataFrame) -> float | None:
    """Return how many times the median time the slowest start near 180 degrees takes, of those that settle.

    rows: as of `describe_failures`. The median is the median of the uniform starts. None: no start of either kind
    settles.
    """
    times = settling_times(rows)
    is_near = np.degrees(rows["angle0_rad"]) >= NEAR_DEG
    near = times[is_near & np.isfinite(times)]
    uniform = times[rows["start_set"] == "uniform"]
    median = quantile_estimate(uniform, 0.5).value if len(uniform) else np.inf
    return float(near.max() / median) if len(near) and np.isfinite(median) else None


def least_trapping_noise(run: Run, law: str) -> float | None:
    """Return the smallest sensor error tried that traps a law at 180 degrees [rad], up to HELD_RAD.

    Infinite: none of them does. None: the law was not tried under noise, or fails there without it.
    """
    rows = run.table("robustness", axis=NOISE)
    rows = rows[rows["contender"].astype(str) == law]
    tried = rows[(rows["level"] > 0.0) & (rows["level"] <= HELD_RAD)]
    if tried.empty or not settled(rows[rows["level"] == 0.0]).all():
        return None
    trapped = tried[~settled(tried)]
    return float(trapped["level"].min()) if len(trapped) else float("inf")
