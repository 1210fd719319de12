"""C20, C26, C33, C46: controllers on the Euler Jacobian, what they do and what they cost (Murphy 1988, 3 and 4)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple

import tasks
from bench.base.on_first_use import pd
from bench.experiments.columns import CONTENDER_KEY
from bench.experiments.probe_values.arms import BY_EULER, CURVES, INVERSES, ON_MATRIX, TASK
from bench.experiments.suites import SUITES
from bench.experiments.tables.rows import matching
from bench.experiments.tables.run import Run, require_rows
from bench.findings.amounts import count_of, join_words, part_of
from bench.findings.claims import adequacy, standing
from bench.findings.claims.adequacy import of_stage, tallied
from bench.findings.claims.side_by_side import BASE
from bench.findings.claims.standing import ORDERED, Operations, by_columns
from bench.findings.claims.tables import check_starts, evidence, percent
from bench.findings.claims.verdict import Evidence, Word, claim, word_of
from bench.law.control.contact_controller import PAPERS_FORM

# rad, at step zero by Richardson. What the extrapolation leaves is of second order: (10/s x 1 ms)^2 = 1e-4, times a
# motion of up to pi, times a few for the curvature of the angles. A visible bend is a hundredth, as in C09.
BEND_TIGHT = 1e-3
BEND_LOOSE = 1e-2
# m, at step zero: a thousandth of an arm's reach.
DRIFT_M = 1e-3
# Departure at half the step over that at the step: a half if it is the integrator's, of first order; one if it is the
# law's. A second-order part of -0.3 to 0.7 of the first-order one moves it this far from a half.
HALVING = (0.4, 0.6)
# Peak torque over that of the geometric Jacobian from the same start: beyond it the Jacobian is to blame.
HAMMERED = 10.0
# Share of the flops of the whole tick: up to a tenth more is a few.
FEW = 0.1
# Share of operations from which on a law is much simpler.
MUCH = 0.5


LAW, COORDINATES = "feedback-linearized", "zyx-euler"

BY_COMMON = f"{LAW}/{COORDINATES}@geometric"
"""(2.2) with (2.15); BY_EULER is (3.7) and ON_MATRIX (2.2) with the law on R."""

CONTROLLERS = (
    ("The controller (3.7)", BY_EULER),
    ("The controller (2.2) with the rotation-matrix law", ON_MATRIX),
    ("The controller (2.2) with the law (2.15)", BY_COMMON),
)
"""What they are called in sentences."""


EULER = f"hybrid/{COORDINATES}"


def words(controller: str, joints: int) -> dict[str, str]:
    """Return the words of a controller's rows on so many joints."""
    law, _, by = controller.partition("@")
    regulator, _, representation = law.partition("/")
    return {"regulator": regulator, "representation": representation, "jacobian": by, "inverse": INVERSES[joints]}


def controller_costs(run: Run, controller: str, joints: int) -> pd.DataFrame:
    """Its rows of costs.parquet, typical branch, a row a stage."""
    rows = run.table("costs", **words(controller, joints), branch="typical")
    return require_rows(rows[rows["joints"] == joints], f"cost of {controller} on {joints} joints")


COMPARED = (*CONTENDER_KEY, "arm", "start_set", "start_id", "outcome", "peak_tau_nm")
"""Columns of episodes that C20 compares controllers by."""


@claim("C20")
def c20(run: Run) -> tuple[Word, Evidence]:
    """Curves at two steps; outcomes at the poles against the law on R; stages and totals."""
    found = require_rows(
        run.table("episodes", task=TASK, engine="native", variation="ideal-motors"),
        "nominal episode of an arm",
    )
    found = found[list(COMPARED)]
    arms = sorted(set(found["arm"].astype(str)))
    bends = [_bend(run, arm) for arm in arms]
    compared_at = {arm: _at_poles(run, found, arm) for arm in arms}
    clear, common = [], []
    for arm in arms:
        clear += _pairs(run, found, arm, "clear", BY_EULER)
        common += _pairs(run, found, arm, "clear", BY_COMMON)
    hidden = [_hidden(run, joints) for joints in INVERSES]
    full, shares, limits, drifts, samples = zip(*bends, strict=True)
    is_first_order = HALVING[0] <= min(shares) and max(shares) <= HALVING[1]
    is_linear = is_first_order and max(limits) <= BEND_TIGHT and max(drifts) <= DRIFT_M
    fails = all(map(any, compared_at.values())) and not any(clear)
    hides = all(is_hidden for is_hidden, _ in hidden)
    all_failures, all_poles = (sum(map(count, compared_at.values())) for count in (sum, len))
    at_poles = join_words(
        f"{part_of(sum(rows), len(rows))} pole starts on the arm {arm}" for arm, rows in compared_at.items()
    )
    return word_of(is_linear and fails and hides, max(limits) <= BEND_LOOSE and (fails or hides)), evidence(
        f"""We simulated {CURVES * len(arms)} motions on {len(arms)} arms with the full time step and with half of
        it. Their paths stay away from the poles (start set 'clear'). With the full step, the angles differ from the
        linear response by at most {max(full):.1e} rad. With half the step, this difference is {min(shares):.3f} to
        {max(shares):.3f} times as large. We extrapolated the results to step zero. Then the angles differ from the
        linear response by at most {max(limits):.1e} rad, and the position of the tool differs from its goal by at most
        {max(drifts):.1e} m. A pole start is near a pole, or the shortest path from it to the goal passes near a pole.
        The controller (3.7) fails and the rotation-matrix law settles from {at_poles}. In episodes.parquet,
        {count_of(sum(clear), len(clear), "starts")} of the set 'clear' fail with (3.7) and settle with the
        rotation-matrix law. With the law of the controller (3.7) and the geometric Jacobian,
        {count_of(sum(common), len(common), "starts")} fail in this way.
        {" ".join(said for _, said in hidden)}""",
        sum(samples) + sum(map(len, compared_at.values())) + len(clear) + 3 * len(hidden),
        measured=f"""The Euler angles differ from the linear response by at most {max(limits):.1e} rad. From
        {count_of(all_failures, all_poles, "starts")} whose shortest path to the goal passes near a pole, the controller
        with the Euler Jacobian (3.7) fails and the rotation-matrix law settles.""",
    )


def _bend(run: Run, arm: str) -> tuple[float, ...]:
    """Return how far an arm's curves are from double integrators.

    The bend at the step [rad], the halved one's share of it, that at step zero [rad], the drift [m], samples.
    """
    curves = run.probe("arm-curve", arm=arm)
    whole, at_half = (_worst(curves[name]) for name in ("bend_rad", "bend_at_half_step_rad"))
    limit, drift = (_worst(curves[name]) for name in ("bend_at_step_zero_rad", "drift_at_step_zero_m"))
    return whole, at_half / whole, limit, drift, int(curves["samples"].sum())


def _worst(numbers: pd.Series) -> float:
    """Return the largest number; infinite if one is missing."""
    return float(numbers.fillna(math.inf).max())


def _pairs(run: Run, found: pd.DataFrame, arm: str, start_set: str, controller: str = BY_EULER) -> list[bool]:
    """Return `_against` of a controller and the law on R from the same starts of a set."""
    rows = found[((found["arm"] == arm) & (found["start_set"] == start_set)).to_numpy(bool)]
    least = SUITES["quick"].sections["arm"]["sizes"]  # of the smallest suite
    parts = []
    for one in (controller, ON_MATRIX):
        own = matching(rows, words(one, tasks.arm(arm).joints))
        parts.append(_list_ends(require_rows(own, f"episode of {one} on {arm} from {start_set}")))
        check_starts(run, own, f"{one} on {arm}", least, start_set)
    return _against(*parts)


class End(NamedTuple):
    """How an episode on an arm ended. peak: the largest torque [N m]."""

    is_settled: bool
    peak: float


def _list_ends(rows: pd.DataFrame, start: str = "start_id") -> dict[str, End]:
    """Return how the episode from each start ended; start: the column that names the start."""
    ends = zip((rows["outcome"] == "settled").tolist(), rows["peak_tau_nm"].tolist(), strict=True)
    return {name: End(*end) for name, end in zip(rows[start].astype(object), ends, strict=True)}


def _against(own: dict[str, End], other: dict[str, End]) -> list[bool]:
    """Return of each start that both controllers ran whether the first fails where the other settles."""
    fails = []
    for start in own.keys() & other.keys():
        # A peak that is not a number is one that the first controller never came back from.
        is_hammered = not own[start].peak <= HAMMERED * other[start].peak
        fails.append(other[start].is_settled and (is_hammered or not own[start].is_settled))
    return fails


def _at_poles(run: Run, found: pd.DataFrame, arm: str) -> list[bool]:
    """Return `_against` of (3.7) and the law on R: starts of the set 'pole', then episodes beside poles."""
    beside = []
    for controller in (BY_EULER, ON_MATRIX):
        rows = run.probe("arm-pole", arm=arm, **words(controller, tasks.arm(arm).joints))
        beside.append(_list_ends(rows, "case"))
    return [*_pairs(run, found, arm, "pole"), *_against(*beside)]


def _hidden(run: Run, joints: int) -> tuple[bool, str]:
    """Whether the law seems cheaper and the controller is dearer, and the numbers in a sentence."""
    rows = {one: controller_costs(run, one, joints) for one in (BY_EULER, BY_COMMON, ON_MATRIX)}
    seen = {one: of_stage(own, "regulate") for one, own in rows.items()}
    total = {one: tallied(own, with_goal=False) for one, own in rows.items()}
    seems_cheaper = seen[BY_EULER].flops < seen[ON_MATRIX].flops and seen[BY_EULER].calls <= seen[ON_MATRIX].calls
    is_dearer = by_columns(total[ON_MATRIX], total[BY_EULER]) == ORDERED
    told = " ".join(
        f"{name} takes {total[one].calls or 'no'} calls and {total[one].flops} flops; the "
        f"law within this controller takes {seen[one].flops} of these flops."
        for name, one in CONTROLLERS
    )
    return seems_cheaper and is_dearer, f"On arms with {joints} joints, we counted these operations. {told}"


TITLES = (
    "law on Euler angles, geometric Jacobian: (2.2) with (2.15)",
    "law on R, geometric Jacobian: (2.2)",
    "law on Euler angles, Euler Jacobian: (3.7)",
)
"""The controllers that C26 compares."""

OPERATIONS = (
    "Joints",
    "Controller",
    "Flops and calls, without the Euler angles of the goal",
    "Flops and calls, with the Euler angles of the goal",
    "Time of (3.7), divided by the time of this controller (a ratio for each machine and arm)",
)
"""Heads of what was counted and timed of a controller."""


@claim("C26")
def c26(run: Run) -> tuple[Word, Evidence]:
    """Pairs of controllers on six and seven joints."""
    timed, stands, counts, surpluses = run.controller_timings(), [], [], []
    rows: list[tuple[str, ...]] = []
    for joints, inverse in INVERSES.items():
        three = {f"{one}+{inverse}": controller_costs(run, one, joints) for one in (BY_COMMON, ON_MATRIX, BY_EULER)}
        alone, whole = ({name: tallied(own, goal) for name, own in three.items()} for goal in (False, True))
        counts.append(f"{euler_count(whole, three)} flops on an arm with {joints} joints")
        surpluses.append(f"{surplus(whole, three)} %")
        times = standing.times_of(timed[timed["contender"].isin(list(three))])
        known = standing.Ledger(times, (alone, whole), math.nan, standing.MEASURABLE)
        *others, euler = three
        stands += [known.stand(one, euler) for one in others]
        for name, title in zip(three, TITLES, strict=True):
            ratio = "" if name == euler else known.over(euler, name)
            rows.append((str(joints), title, str(alone[name]), str(whole[name]), ratio))
    dearer = sum(set(one.by_columns) == {ORDERED} for one in stands)
    return word_of(dearer == len(stands), False), evidence(
        f"""We counted the flops and calls of three controllers in a control period. A pair is (3.7) and one of the
        two other controllers, on an arm with 6 or with 7 joints. With and without the goal's angles, (3.7) takes
        more operations than the other controller in {count_of(dearer, len(stands), "pairs")}. The measured times
        differ in {count_of(sum(bool(one.by_time) for one in stands), len(stands), "pairs")}, and (3.7) takes longer
        in {count_of(sum(one.by_time == ORDERED for one in stands), len(stands), "pairs")}.""",
        3 * 2 * len(INVERSES) + len(timed),
        ("costs", "timings") if len(timed) else ("costs",),
        measured=f"""With the Euler Jacobian (3.7), a control step takes {join_words(counts)}. These are
        {join_words(surpluses)} more than with the cheapest controller on the geometric Jacobian (2.2).""",
        numbers=(OPERATIONS, *rows),
    )


def euler_count(totals: dict[str, Operations], names: Iterable[str]) -> str:
    """Return the flops of (3.7), the last of the controllers."""
    *_, euler = names
    return f"{totals[euler].flops:,}"


def surplus(totals: dict[str, Operations], names: Iterable[str]) -> str:
    """Return how many per cent more flops (3.7), the last of the controllers, takes than the cheapest other one."""
    *others, euler = (totals[name].flops for name in names)
    return percent(euler / min(others) - 1)


@claim("C33")
def c33(run: Run) -> tuple[Word, Evidence]:
    """Flops and calls of both in contact."""
    price, told, is_more, is_few, by_joints = adequacy.ledger(run).price, [], [], [], []
    for joints in INVERSES:
        base, euler = (_in_contact(run, one, joints) for one in (BASE, EULER))
        dearer = euler.weighed(price) / base.weighed(price) - 1
        weighed = (
            f" If calls are counted as flops, the controller with the Euler Jacobian takes {100 * dearer:.0f} % more "
            "operations."
        )
        more = euler.flops / base.flops - 1
        is_more.append(by_columns(base, euler) == ORDERED)
        is_few.append(more <= FEW)
        by_joints.append(f"{percent(more)} % more on an arm with {joints} joints")
        told.append(
            f"On an arm with {joints} joints, a control period takes {base.flops:,} flops and "
            f"{base.calls or 'no'} calls with the geometric Jacobian, and {euler.flops:,} flops and "
            f"{euler.calls or 'no'} calls with the Euler Jacobian."
            f"{weighed if math.isfinite(price) else ''}"
        )
    by_time = f" In this count, a call counts as {price:.0f} flops, because a call takes as long as {price:.0f} flops."
    return word_of(all(is_more) and all(is_few), all(is_more)), evidence(
        f"{' '.join(told)}{by_time if math.isfinite(price) else ''}",
        2 * len(told),
        measured=f"""Force control with the Euler Jacobian takes more flops than force control with the geometric
        Jacobian: {join_words(by_joints)}.""",
    )


def _in_contact(run: Run, controller: str, joints: int) -> Operations:
    """Return the operations of a controller's typical control period on an arm of so many joints."""
    counts = run.probe("contact-cost")
    is_it = (counts["case"] == f"{controller}+{PAPERS_FORM}") & (counts["at"] == joints)
    row = require_rows(counts[is_it], f"cost of {controller} in contact on {joints} joints").iloc[0]
    return Operations(int(row["flops"]), int(row["calls"]))


@claim("C46")
def c46(run: Run) -> tuple[Word, Evidence]:
    """Operations of (3.7), of what it replaces, and of what it leaves to the law."""
    rows_told, is_less, is_left, sizes = [], [], [], []
    for joints in INVERSES:
        rows = {one: controller_costs(run, one, joints) for one in (BY_EULER, BY_COMMON, ON_MATRIX)}
        total = {one: tallied(own, with_goal=False) for one, own in rows.items()}
        law = {one: of_stage(own, "regulate") for one, own in rows.items()}
        is_less += [by_columns(total[BY_EULER], total[one]) == ORDERED for one in (BY_COMMON, ON_MATRIX)]
        whole = {one: total[one] for one in (BY_COMMON, ON_MATRIX, BY_EULER)}
        sizes.append(f"{surplus(whole, whole)} % more on an arm with {joints} joints")
        is_left.append(law[BY_EULER].flops <= MUCH * law[ON_MATRIX].flops)
        rows_told += [
            (
                f"{joints} joints",
                title,
                f"{total[one].flops:,} flops and {total[one].calls or 'no'} calls",
                f"{law[one].flops} flops",
            )
            for one, title in SIMPLIFIED.items()
        ]
    return word_of(all(is_less) and all(is_left), all(is_left)), evidence(
        f"""We counted the flops and calls of {len(SIMPLIFIED)} controllers in a typical control period, on arms with
        {join_words(map(str, INVERSES))} joints. The table also gives the flops of the law alone, which is a part of the
        controller.""",
        len(rows_told),
        measured=f"""The controller (3.7) takes more flops than the cheapest controller that uses (2.2):
        {join_words(sizes)}. The law within (3.7) takes {law[BY_EULER].flops} flops, and the rotation-matrix law
        {law[ON_MATRIX].flops} flops.""",
        numbers=(SIMPLIFIED_HEADS, *rows_told),
    )


SIMPLIFIED = {
    BY_EULER: "(3.7), which contains a law on Euler angles",
    BY_COMMON: "(2.2) with the law (2.15)",
    ON_MATRIX: "(2.2) with the rotation-matrix law",
}
"""The controllers that C46 compares."""

SIMPLIFIED_HEADS = (
    "Arm",
    "Controller",
    "Flops and calls of the whole controller in a control period",
    "Flops of the law alone",
)
"""Heads of what was counted of a controller and of its law."""
