"""Rules by which tables are compared, each with its tolerances; a table without a rule here has the plain one."""

from collections.abc import Callable

import numpy as np
import pandas as pd

from bench.experiments.columns import Table
from bench.law.contenders.registry import contenders
from bench.law.contenders.representations.zyx_euler import to_matrix
from bench.regression.rows.difference import ComparisonRule, Difference, align_rows, compare_cells
from tasks.contact_rest import REST
from tasks.verdict import OUTCOMES, SETTLED

RELATIVE = 1e-6
"""Two libraries' sines (1e-16 apart) leave 1e-12 of a settled episode; effects of the step size start at 1e-4."""
ABSOLUTE = 1e-9  # below this an angle [rad] or a margin is rounding itself
SINGLE_RELATIVE = 2e-6  # RELATIVE, and rounding to single precision
MARGIN = 10.0  # times the change that 1e-12 rad made of a doubtful episode: two samples of the effect of rounding
FRICTION_RELATIVE = 1e-3
"""With dry friction joints stick and creep by what MuJoCo's solver leaves: two libraries' angles differ by 1e-4."""
BOUNDARY_ANGLE, LIMIT_RELATIVE = 1e-5, 1e-3  # bisection ends at 7e-7 rad and 4e-6; rounding decides its last steps
POSE_RELATIVE, STEADY = 1e-5, 1e8
"""Single precision is 6e-8; condition numbers up to STEADY lose half the digits of the doubles they are made of."""
PERTURBED_RELATIVE = 1e-4  # noise or a moving goal has driven what settles for five thousand steps
ON_SET, THROWN = 1e-6, 1.0
"""A goal whose margin is smaller is meant to be on the singular set of its coordinates. Above a torque of THROWN times
its rated one a hand has been thrown about. In both cases rounding decides the outcome."""
SEARCH_RELATIVE = 0.01  # where |e| is flat, a search for its least value ends anywhere: 2e-3 apart
HALF_TICK_S = 5e-4  # of the 1 ms that probes are compared at
CONTACT = (1e-4, 1e-7)
"""Relative and absolute. Impacts multiply rounding: 1e-16 in a joint angle becomes 4e-7 in a jammed peg's force."""
PEG, CREEP = (1e-3, 1e-5), (1e-2, 1e-4)
"""For pegs by the Jacobian transpose or an impedance, which cancel no impact: another processor's libraries moved an
overshoot by 6e-4 of it, a rotation about held axes by 8e-6 rad. For what sticks and slips all the time: without
fused multiply-add one peg went 1.6e-4 of its depth less far, and turned by 0.5 % less about a held axis."""
ENDS = {
    "remaining_speed_m_per_s": (0.1, REST.speed),
    "remaining_rate_rad_per_s": (0.1, REST.rate),
    "time_to_rest_s": (0.0, REST.hold_s),
}
"""How an episode in contact ends: with a last shiver or one slip more, the window of rest begins again 0.08 s later."""
PEG_ENDS = {
    "force_error_end_n": (0.01, 0.01),
    "moment_error_end_nm": (0.01, 0.002),
    "contact_settling_time_s": (0.03, 0.0),
}
"""Tolerances of a peg that sticks and slips: rounding decides where its last slip ends. Poses that
differ only by a rotation of the whole task, which these controllers do not notice, differ by 0.7 %
of 0.63 N and by 0.22 s of 10.4 s. Another processor's libraries moved an error at the end from
0.042 N to 0.038 N; the largest errors are above 36 N.
"""


def within(relative: float, absolute: float = ABSOLUTE) -> Callable[[str], tuple[float, float]]:
    """Return one tolerance for all columns."""
    return lambda column: (relative, absolute)


def end_as(word: str, *frames: pd.DataFrame) -> np.ndarray:
    """Return whether each row has this outcome in every frame."""
    return np.all([one["outcome"].astype(str) == word for one in frames], axis=0)


def share_outcome(old: pd.DataFrame, new: pd.DataFrame) -> np.ndarray:
    """Return whether an outcome of base, beside its start too, is one of head's, or rounding changes half a number."""
    sides = ("outcome", "outcome_beside")
    pairs = [(old[a].astype(str).to_numpy(), new[b].astype(str).to_numpy()) for a in sides for b in sides]
    same = [(was == now) & (was != "") for was, now in pairs]
    return np.any([*same, np.fmax(old["rounding_change"], new["rounding_change"]).to_numpy() >= 0.5], axis=0)


def compare_episodes(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare outcomes, each beside its start too where rounding decides it, and numbers of what settled.

    The cause of a failure follows from two numbers of a failed episode, which are not compared either.
    """
    has_ticks = "ticks" in old  # episodes, not those of velocity commands, whose table is in single precision
    doubt = MARGIN * np.fmax(old["rounding_change"].to_numpy(), new["rounding_change"].to_numpy())
    known: float | np.ndarray = SINGLE_RELATIVE
    if has_ticks:
        rubs = old["variation"].astype(str).str.startswith("friction").to_numpy()
        known = np.where(rubs, FRICTION_RELATIVE, RELATIVE)
    loose = np.fmax(known, doubt)  # no doubt is NaN, which fmax passes over
    relative, half_tick = np.fmin(loose, 1.0), 0.5 * old["dt_s"].to_numpy()

    def tolerance(column: str) -> tuple[float | np.ndarray, float | np.ndarray]:
        if column in ("settling_time_s", "failure_time_s"):
            return (relative - RELATIVE, half_tick) if has_ticks else (relative, ABSOLUTE + half_tick)
        return (relative - RELATIVE, 0.0) if column == "ticks" else (relative, ABSOLUTE)

    rows = end_as(OUTCOMES[SETTLED], old, new) & (loose < 1.0)
    skipped = ("cause", "outcome_beside", "rounding_change")
    return ComparisonRule(tolerance, rows, {"outcome": ~share_outcome(old, new)}, skipped)


def compare_robustness(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare outcomes exactly, and numbers of what settled in both."""
    both = end_as(OUTCOMES[SETTLED], old, new)
    return ComparisonRule(within(PERTURBED_RELATIVE), both, {"outcome": np.ones(len(old), bool)})


def compare_contact(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare outcomes where no rounding decides them, and numbers of what is done in both."""
    torque = np.fmin(new["peak_torque_ratio"].to_numpy(), old["peak_torque_ratio"].to_numpy())
    decided = ~_is_on_singular_set(old) & ~(torque > THROWN)
    both = end_as("done", old, new) & decided
    is_peg = (old["task"].astype(str) == "peg-in-hole") & ~old["form"].astype(str).isin(("inverse", "projected"))
    creeps = old["rest"].astype(str) == "creeping"
    relative, absolute = (np.select([creeps, is_peg], [CREEP[at], PEG[at]], CONTACT[at]) for at in (0, 1))

    def tolerance(column: str) -> tuple[float | np.ndarray, float | np.ndarray]:
        if column in PEG_ENDS:
            at_end = PEG_ENDS[column]
            return np.where(is_peg, at_end[0], relative), np.where(is_peg, at_end[1], absolute)
        return ENDS.get(column, (relative, absolute))

    return ComparisonRule(tolerance, both, {"outcome": decided, "rest": both})


def _is_on_singular_set(rows: pd.DataFrame) -> np.ndarray:
    """Return whether a row's goal is where its controller's coordinates are singular."""
    margins = {name: one.margin for name, one in contenders("representations").items()}
    goals = zip(rows["representation"].astype(str), rows["alpha"], rows["beta"], rows["gamma"], strict=True)
    return np.array([bool(name) and margins[name](to_matrix(E)) < ON_SET for name, *E in goals], bool)


def compare_poses(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare Jacobians that are not nearly singular; columns of gaps are rounding itself."""
    steady = ((old["condition_analytic"] < STEADY) & (old["condition"] < STEADY)).to_numpy()
    return ComparisonRule(
        within(POSE_RELATIVE),
        steady,
        {},
        tuple(name for name in old.columns if name.endswith("_gap")),
    )


def compare_command_field(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare every finding's word, and its numbers where they are bounded; not the state, which is one of many."""
    kept = ("what", "value", "least", "most")
    is_bounded = (old["what"] != "unbounded").to_numpy()
    return ComparisonRule(
        within(POSE_RELATIVE),
        is_bounded,
        {},
        tuple(name for name in old.columns if name not in kept),
    )


def compare_probes(old: pd.DataFrame, new: pd.DataFrame) -> ComparisonRule:
    """Compare outcomes and numbers of probes where rounding does not decide them, and of what settled in both.

    A spin or an arm beside a pole ends as rounding decides. A gap is rounding itself, a search takes as many steps as
    rounding wills, and a gain of up to 1e12 has lost the digits of cos(beta).
    """
    probe, measure = (old[name].astype(str) for name in ("probe", "measure"))
    is_decided = ~probe.isin(("beside-pole", "arm-pole")).to_numpy()
    is_rounding = measure.str.endswith("_gap") | measure.isin(("evaluations", "gain"))
    has_ended_well = old["outcome"].astype(str).isin(("", OUTCOMES[SETTLED]))
    rows = is_decided & ~is_rounding.to_numpy() & has_ended_well.to_numpy()
    is_perturbed = probe.isin(("wrong-inertia", "moving-goal"))
    is_searched = probe == "error-search"
    relative = np.select([is_perturbed, is_searched], [PERTURBED_RELATIVE, SEARCH_RELATIVE], RELATIVE)
    absolute = np.where(measure == "settling_time_s", HALF_TICK_S, ABSOLUTE)
    return ComparisonRule(lambda column: (relative, absolute), rows, {"outcome": is_decided})


RULES: dict[str, Callable[[pd.DataFrame, pd.DataFrame], ComparisonRule]] = {
    "episodes": compare_episodes,
    "velocity": compare_episodes,
    "robustness": compare_robustness,
    "compliance": compare_contact,
    "poses": compare_poses,
    "command-field": compare_command_field,
    "costs": lambda old, new: ComparisonRule(within(0.0, 0.0)),
    "boundaries": lambda old, new: ComparisonRule(
        within(0.0, BOUNDARY_ANGLE), skipped=("outcome",)
    ),
    "probes": compare_probes,
    "velocity-limits": lambda old, new: ComparisonRule(within(LIMIT_RELATIVE, LIMIT_RELATIVE)),
    "traces": lambda old, new: ComparisonRule(within(RELATIVE, RELATIVE), skipped=("outcome",)),
}


def compare_tables(table: Table, old: pd.DataFrame, new: pd.DataFrame) -> list[Difference]:
    """Return what differs between base's and head's rows."""
    if table.name == "traces":  # curves that came to the goal; on the others rounding may decide when they end
        old, new = (frame[end_as(OUTCOMES[SETTLED], frame)] for frame in (old, new))
    old, new, found = align_rows(table, old, new)
    rule = RULES[table.name](old, new) if table.name in RULES else ComparisonRule(within(RELATIVE))
    return found + compare_cells(table, old, new, rule)
