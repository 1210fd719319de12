"""C20: the controller on the Euler Jacobian (Murphy 1988, 3.6-3.8)."""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import tasks
from bench.findings.claims import arm_probes
from bench.findings.claims.adequacy import CALLS, tallied
from bench.findings.claims.controller_costs import (
    BY_COMMON,
    BY_EULER,
    COORDINATES,
    INVERSES,
    LAW,
    ON_MATRIX,
    controller_costs,
    words,
)
from bench.findings.claims.standing import ORDERED, by_columns
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of
from bench.law.contender import Gains

if TYPE_CHECKING:
    import pandas as pd

CURVES = 8
"""Clear starts whose curves are computed at both steps."""

BEND_TIGHT, BEND_LOOSE = 1e-3, 1e-2
"""rad, at step zero by Richardson. What the extrapolation leaves is of second order: (10/s x 1 ms)^2 = 1e-4, times a
motion of up to pi, times a few for the curvature of the angles. A visible bend is a hundredth, as in C09."""

DRIFT_M = 1e-3
"""m, at step zero: a thousandth of an arm's reach."""

HALVING = (0.4, 0.6)
"""Departure at half the step over that at the step: a half if it is the integrator's, of first order; one if it is the
law's. A second-order part of -0.3 to 0.7 of the first-order one moves it this far from a half."""

HAMMERED = 10.0
"""Peak torque over that of the geometric Jacobian from the same start: beyond it the Jacobian is to blame."""


class Bend(NamedTuple):
    """How far an arm is from double integrators: [rad] at the step, the halved one's share, at step zero; [m]."""

    full: float
    share: float
    limit: float
    drift: float
    samples: int


@claim(
    id="C20",
    section="3.2",
    equation="(3.6)-(3.8)",
    quote="""
        The result is truly a system of decoupled double integrators. ... However, this linearization fails to
        exist for certain orientations mentioned above and it hides the expense of calculating the Euler angles.
    """,
    correction="The plant is linear, and one of the two reservations fails.",
    written="2026-11-23 953f62a",
    sentence="With it the plant is decoupled double integrators; this fails at places and hides a cost.",
    question="Is the arm's answer linear, how does it end near the pole, and what do (2.2), (3.7) cost?",
    criterion=f"""
        Native engine, every arm, perfect model, law (3.7): {LAW}/{COORDINATES}@analytic with the inverse {INVERSES[6]}
        on six joints and {INVERSES[7]} on seven. Against it: rotation-matrix@geometric, (2.2), with the same inverse.
        (a) Double integrators: from clear starts, each angle's departure from E_d + (E_0 - E_d) response(t), the closed
        form of C09, is the integration error of MuJoCo's semi-implicit Euler step, which is of first order: with half
        the step it is {HALVING[0]:g} to {HALVING[1]:g} of what it was, and extrapolated to step zero (twice the
        half-step trace less the full) at most {BEND_TIGHT:g} rad; the tool's position likewise, at most {DRIFT_M:g} m.
        (b) Orientations: on every arm some start at a pole fails with it that settles with the other, where failing is
        not settling, or a peak torque {HAMMERED:g} times the other's; no clear start fails. Starts at a pole are those
        of the set pole, and the poses of C18's families at 10^-2 or nearer, at rest, with the pose at 10^-1 for a goal.
        (c) Hidden expense: by costs.parquet, typical branch, its stage 'regulate' has fewer flops and no more calls
        than the other's, and yet its total without the goal's angles has no fewer of either and more of one, on six and
        on seven joints. It holds if all three pass; with a correction if
        (a) extrapolates to {BEND_LOOSE:g} rad or less and (b) or (c) passes; otherwise it does not hold. Also reported:
        (2.2) with (2.15), the same law on the geometric Jacobian.
    """,
    open="""
        The paper computes no arm. The halved step is an experiment of the judge's, and so are the episodes from C18's
        poses: a response in E is straight in E, so it nears a pole only from there or to there, while the starts of the
        set pole begin and end 40 degrees away from one, and only the tool of a law on R passes it.
    """,
    earlier=(
        Earlier("2026-11-21 9b9e874", "In (c) a call was counted as 1 to 20 flops; columns need no price.", Word.HOLDS),
    ),
)
def c20(results):
    """Curves at two steps; outcomes at the poles against the law on R; stages and totals."""
    import pandas as pd

    found = some(
        results.table("episodes", task=arm_probes.TASK, engine="native", variation="nominal"),
        "nominal episode of an arm",
    )
    arms = sorted(set(found["arm"].astype(str)))
    poses = some(results.table("poses", representation=COORDINATES, pose_set="pole"), "pose at a pole")
    gains = Gains(float(found["kp"].iloc[0]), float(found["kv"].iloc[0]))
    bends = {arm: results.found_by(bend, arm, gains, float(found["dt_s"].iloc[0])) for arm in arms}
    compared_at = {arm: _at_poles(results, found, poses, arm, gains) for arm in arms}
    clear, common = (pd.concat([_pairs(found, arm, "clear", one) for arm in arms]) for one in (BY_EULER, BY_COMMON))
    hidden = [_hidden(results, joints) for joints in INVERSES]
    limit, drift = max(one.limit for one in bends.values()), max(one.drift for one in bends.values())
    first_order = all(HALVING[0] <= one.share <= HALVING[1] for one in bends.values())
    linear = first_order and limit <= BEND_TIGHT and drift <= DRIFT_M
    fails = all(rows["fails"].any() for rows in compared_at.values()) and not clear["fails"].any()
    hides = all(is_hidden for is_hidden, _ in hidden)
    word = word_of(linear and fails and hides, limit <= BEND_LOOSE and (fails or hides))
    at_poles = ", ".join(f"{rows['fails'].sum()} of {len(rows)} ({arm})" for arm, rows in compared_at.items())
    return word, evidence(
        f"""{CURVES * len(arms)} clear curves a step on {len(arms)} arms: angles are at most
        {max(one.full for one in bends.values()):.1e} rad off the closed form at the step,
        {min(one.share for one in bends.values()):.3f} to {max(one.share for one in bends.values()):.3f} of that at half
        of it, and {limit:.1e} rad at step zero; the tool moves {drift:.1e} m. At a pole it fails, and the law on R does
        not, from {at_poles}; from {int(clear["fails"].sum())} of {len(clear)} clear starts (by the same law on the
        common Jacobian: {int(common["fails"].sum())}). {" ".join(said for _, said in hidden)}""",
        sum(one.samples for one in bends.values()) + sum(map(len, compared_at.values())) + len(clear) + 3 * len(hidden),
        ("episodes", "poses", "costs", "experiment"),
    )


@functools.cache
def bend(arm: str, gains: Gains, dt_s: float, curves: Callable = arm_probes.curves) -> Bend:
    """Of curves at a step and at half of it."""
    word = f"{BY_EULER}+{INVERSES[tasks.arm(arm).joints]}"
    full, half = (curves(word, arm, gains, step, CURVES) for step in (dt_s, dt_s / 2))
    both = full.merge(half, on=["start_id", "time_s"], suffixes=("", "_half"))
    limits = [2 * both[f"{name}_half"] - both[name] for name in arm_probes.BENDS]
    drift = 2 * both["position_error_m_half"] - both["position_error_m"]
    whole = arm_probes.largest(full)
    share = arm_probes.largest(half) / whole
    return Bend(whole, share, float(np.abs(limits).max()), float(np.abs(drift.to_numpy()).max()), len(both))


def _pairs(found: pd.DataFrame, arm: str, start_set: str, controller: str = BY_EULER) -> pd.DataFrame:
    """Episodes by a controller and by the law on R from the same starts of a set."""
    rows = found[(found["arm"] == arm) & (found["start_set"] == start_set)]
    parts = []
    for one in (controller, ON_MATRIX):
        named = words(one, tasks.arm(arm).joints).items()
        own = rows[np.logical_and.reduce([rows[column] == word for column, word in named])]
        parts.append(some(own, f"episode of {one} on {arm} from {start_set}"))
    return _against(*parts)


def _against(own: pd.DataFrame, other: pd.DataFrame) -> pd.DataFrame:
    """Both controllers' episodes side by side: whether the first fails where the other settles."""
    import pandas as pd

    both = own.merge(other, on="start_id", suffixes=("", "_other"))
    hammered = ~(both["peak_tau_nm"] <= HAMMERED * both["peak_tau_nm_other"])
    fails = (both["outcome_other"] == "settled") & ((both["outcome"] != "settled") | hammered)
    return pd.DataFrame({"start_id": both["start_id"].astype(str), "fails": fails})


def _at_poles(results, found: pd.DataFrame, poses: pd.DataFrame, arm: str, gains: Gains) -> pd.DataFrame:
    import pandas as pd

    controllers = [f"{one}+{INVERSES[tasks.arm(arm).joints]}" for one in (BY_EULER, ON_MATRIX)]
    beside = [results.found_by(arm_probes.beside_poles, one, arm, poses, gains) for one in controllers]
    return pd.concat([_pairs(found, arm, "pole"), _against(*beside)], ignore_index=True)


def _hidden(results, joints: int) -> tuple[bool, str]:
    """Whether the law seems cheaper and the controller is dearer, and the numbers in a sentence."""
    rows = {one: controller_costs(results, one, joints) for one in (BY_EULER, BY_COMMON, ON_MATRIX)}
    laws = {one: own[own["stage"] == "regulate"].iloc[0] for one, own in rows.items()}
    seen = {one: (int(law["flops"]), int(sum(law[name] for name in CALLS))) for one, law in laws.items()}
    total = {one: tallied(own, with_goal=False) for one, own in rows.items()}
    seems_cheaper = seen[BY_EULER][0] < seen[ON_MATRIX][0] and seen[BY_EULER][1] <= seen[ON_MATRIX][1]
    is_dearer = by_columns(total[ON_MATRIX], total[BY_EULER]) == ORDERED
    told = "; ".join(
        f"{name} {seen[one][0]} flops of {total[one]} calls"
        for name, one in (("(3.7)", BY_EULER), ("(2.2) with the law on R", ON_MATRIX), ("(2.2) with (2.15)", BY_COMMON))
    )
    return seems_cheaper and is_dearer, f"On {joints} joints the law itself is {told}."
