"""Numbers of a run that its conclusions, its table and the book share: the paper's laws, Jacobians and compliance."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.suites import IDEAL_MOTORS
from bench.experiments.tables.run import FREE_BODY, MAIN_ENGINE, Run, converged, require_rows
from bench.experiments.tables.statistics import Estimate, bootstrap, quantile_estimate
from bench.findings.claims import compliance, side_by_side
from bench.findings.claims.adequacy import (
    HELD_RAD,
    PAPERS,
    Adequacy,
    Tested,
    every,
    examine,
    held,
    of_three,
)
from bench.findings.claims.controller_costs import BY_EULER, ON_MATRIX
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.side_by_side import BASE, PROBE
from bench.findings.claims.standing import Ledger
from bench.findings.claims.tables import Share, settled, settling_times, share
from bench.findings.selection.tables import by_standard_inverse
from bench.findings.theory.closed_form import linear_settling
from bench.law.control.contact_controller import PAPERS_FORM

AT_REST = ("uniform", "half-turn", "poles", "wraps", "box")
"""Start sets from rest whose goal is zero rotation."""

NEARLY_ALL = 0.99

TILT_DEG = 60.0
"""Tilt beta at which the axis of compliance is stated; of the tilts that were run the nearest one is taken."""


class Settling(NamedTuple):
    """How the uniform starts of a law end.

    Attributes:
        share: Share of the starts that settle (outcome "settled").
        median: Time within which 50 % of the starts settle [s]; infinite if fewer do.
        nearly_all: Time within which 99 % of the starts settle [s]; infinite if fewer do.
    """

    share: Share
    median: Estimate
    nearly_all: Estimate


def starts_at_rest(run: Run, engine: str = MAIN_ENGINE) -> pd.DataFrame:
    """Return the episodes of all laws from rest to zero rotation whose end no shorter step moves."""
    rows = run.table("episodes", **FREE_BODY, task="free-body", engine=engine)
    return converged(rows[rows["start_set"].isin(AT_REST)])


def measure_settling(rows: pd.DataFrame) -> Settling:
    """Return how the uniform starts among a law's rows end; NoEvidence: there is none.

    The times are quantiles of the column settling_time_s, in which an episode that does not settle
    counts as infinite.
    """
    uniform = require_rows(rows[rows["start_set"] == "uniform"], "uniform start of a law")
    times = settling_times(uniform)
    return Settling(
        share(settled(uniform)), quantile_estimate(times, 0.5), quantile_estimate(times, NEARLY_ALL)
    )


class Jacobians(NamedTuple):
    """Moves of the arms past gimbal lock, the same ones by both of the paper's controllers, with ideal motors.

    failed: by the geometric Jacobian with the law on R (2.2), and by the Euler Jacobian (3.7). torque: median peak
    torque over the rated one, of both. harder: peak torque of (3.7) over that of (2.2), the median over the moves.
    """

    moves: int
    arms: int
    failed: tuple[int, int]
    torque: tuple[float, float]
    harder: Estimate


def pair_past_poles(run: Run) -> pd.DataFrame:
    """Return the moves of arms past gimbal lock that both of the paper's controllers ran, a row a move.

    NoEvidence: there is none. Columns: arm, kp, start_id; outcome and peak_torque_ratio of the law on
    R by the geometric Jacobian (2.2); the same of (3.7), with the suffix _euler; and harder, the peak
    of (3.7) over the other one, infinite where no number came back.
    """
    rows = run.table(
        "episodes", task="arm-regulation", variation=IDEAL_MOTORS, start_set="pole", engine="native"
    )
    rows = by_standard_inverse(require_rows(rows, "move of an arm past gimbal lock"))
    controller = rows["contender"].astype(str).str.partition("+")[0]
    columns = ["arm", "kp", "start_id", "outcome", "peak_torque_ratio"]
    geometric, euler = (rows.loc[controller == name, columns] for name in (ON_MATRIX, BY_EULER))
    keys = dict.fromkeys(("arm", "start_id", "outcome"), str)
    both = geometric.astype(keys).merge(euler.astype(keys), on=columns[:3], suffixes=("", "_euler"))
    require_rows(both, "move of an arm past gimbal lock by both Jacobians")
    harder = both["peak_torque_ratio_euler"] / both["peak_torque_ratio"]
    return both.assign(harder=harder.fillna(math.inf))


def compare_jacobians(run: Run) -> Jacobians:
    """Return how both Jacobians do past gimbal lock; NoEvidence: no arm ran such moves by both."""
    both = pair_past_poles(run)
    return Jacobians(
        len(both),
        both["arm"].nunique(),
        (
            int((both["outcome"] != "settled").sum()),
            int((both["outcome_euler"] != "settled").sum()),
        ),
        (
            float(both["peak_torque_ratio"].median()),
            float(both["peak_torque_ratio_euler"].median()),
        ),
        bootstrap(both["harder"].to_numpy(float), np.median),
    )


class WrongAxis(NamedTuple):
    """Angle between a moment about x and the axis about which the tilted end effector turns [deg].

    Two axes comply by the Euler Jacobian and the paper's force control. off: of each arm, in the order of the angles.
    """

    tilt_deg: float
    off: tuple[float, ...]

    @property
    def middle(self) -> float:
        """Return the lower median over the arms."""
        return self.off[(len(self.off) - 1) // 2]


def measure_wrong_axis(run: Run, tilt_deg: float = TILT_DEG) -> WrongAxis:
    """Return how far off the axis is at the tilt that is nearest; NoEvidence: no arm was tilted about y alone."""
    rows = run.table("compliance", task=PROBE, controller="hybrid", representation=COORDINATES)
    is_level = (rows["alpha"].abs() < 1e-9) & (rows["gamma"].abs() < 1e-9)
    is_wanted = (
        is_level & (rows["form"] == PAPERS_FORM) & (rows["complies"] == compliance.LEVEL_PAIR)
    )
    rows = rows[is_wanted & (rows["outcome"] == "done") & (rows["beta"] > 0.0)]
    require_rows(rows, f"tilted end effector by {PROBE}, {compliance.LEVEL_PAIR}")
    away = (np.degrees(rows["beta"]) - tilt_deg).abs()
    nearest = rows[away <= away.min() + 1e-6]
    off = sorted(np.degrees(nearest["misalignment_rad"]).tolist())
    return WrongAxis(float(np.degrees(nearest["beta"].iloc[0])), tuple(off))


def count_single_axes(run: Run) -> Share:
    """Count poses at which one angle complies about the same axis of the base; NoEvidence: there is none."""
    orders = compliance.ONE_AXIS
    rows = side_by_side.beside_base(run, COORDINATES, orders, (PAPERS_FORM,))
    is_away = (rows["cos_beta"] >= compliance.CLOSE_TO_POLE).to_numpy()
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    same = side_by_side.apart(C, base) <= compliance.SAME
    return share(
        pd.Series(
            same[require_rows(is_away.nonzero()[0], f"pose of {PROBE} by {BASE} away from gimbal lock")]
        )
    )


class ExaminedLaws(NamedTuple):
    """The laws of a run by the tests of C27, the fewest operations first, and what is known of their cost."""

    laws: dict[str, Adequacy]
    tested: dict[str, Tested]
    ledger: Ledger
    small_s: float

    @property
    def answers(self) -> list[str]:
        """Return the later laws that pass every test."""
        return [
            name for name, result in self.tested.items() if name not in PAPERS and result.passes
        ]


def examine_laws(run: Run) -> ExaminedLaws:
    """Return every law of a run by C27's tests, as the claim does; NoEvidence: the run lacks starts or costs."""
    laws = {one.name: one for one in every(run, MAIN_ENGINE)}
    ledger, small_s = of_three(run), linear_settling(*run.gains())
    by_noise = held(run, HELD_RAD)
    tested = {name: examine(law, ledger, small_s, by_noise) for name, law in laws.items()}
    return ExaminedLaws(laws, tested, ledger, small_s)


def time_over(ledger: Ledger, name: str, other: str) -> Estimate | None:
    """Return the time of a step of a law over another's; None if they were not timed together.

    The ends are those of both intervals divided the widest way; of several machines, the extreme ones.
    """
    ratios = []
    for times in ledger.times:
        if name in times and other in times:
            law, base = times[name], times[other]
            ratios.append((law.value / base.value, law.low / base.high, law.high / base.low))
    if not ratios:
        return None
    values, lows, highs = zip(*ratios, strict=True)
    return Estimate(float(np.median(values)), min(lows), max(highs))
