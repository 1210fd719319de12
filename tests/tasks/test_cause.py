"""Why an episode on an arm failed: the word for each combination of what the judge saw, and in the rows of a run."""

import math

import numpy as np
import pytest
from support.driving import settings
from support.on_arms import named

import tasks
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate_arms import run_arm as run
from bench.experiments.episode_rows import frame
from bench.experiments.experiment import Settings, Unit
from bench.experiments.suites import NOMINAL
from tasks.cause import CAUSES, NEAR_CONDITION, NEAR_MARGIN, cause
from tasks.kinematics import kinematics, rotation_vector
from tasks.verdict import OUTCOMES

NEVER_NEAR = ("settled", "crashed", "hung")
FAILED = [word for word in OUTCOMES if word not in NEVER_NEAR]
FAR, NEAR = (1.0, 5.0), (0.5 * NEAR_MARGIN, 2.0 * NEAR_CONDITION)


@pytest.mark.parametrize("margin", [*FAR, *NEAR, 0.0, math.nan])
@pytest.mark.parametrize("condition", [*FAR, *NEAR, math.inf, math.nan])
@pytest.mark.parametrize(("outcome", "word"), [("settled", ""), ("crashed", "law"), ("hung", "law")])
def test_settled_episode_has_no_cause_and_the_law_is_it_when_it_crashes_or_hangs(outcome, word, margin, condition):
    assert cause(outcome, margin, condition) == word


@pytest.mark.parametrize("outcome", FAILED)
@pytest.mark.parametrize(
    ("margin", "condition", "word"),
    [
        (NEAR[0], NEAR[1], "both"),
        (NEAR[0], FAR[1], "representation"),
        (FAR[0], NEAR[1], "kinematic"),
        (math.nan, NEAR[1], "kinematic"),  # a law on R has no margin
        (0.0, FAR[1], "representation"),
        (FAR[0], math.inf, "kinematic"),
        (FAR[0], math.nan, "kinematic"),  # joint angles that are no numbers have no condition
        (math.nan, math.inf, "kinematic"),
        (0.0, math.inf, "both"),
    ],
)
def test_singularity_that_was_near_is_the_cause_however_it_failed(outcome, margin, condition, word):
    assert cause(outcome, margin, condition) == word


@pytest.mark.parametrize("margin", [FAR[0], math.nan])
def test_torque_is_the_cause_only_if_the_torque_rule_ended_it(margin):
    found = {outcome: cause(outcome, margin, FAR[1]) for outcome in FAILED}
    assert {outcome for outcome, word in found.items() if word == "torque"} == {"saturated", "singular"}
    assert set(found.values()) == {"torque", "law"} < set(CAUSES)


def test_thresholds_themselves_are_not_near():
    assert cause("stuck", NEAR_MARGIN, NEAR_CONDITION) == "law"


# ---------------------------------------------------------------------------- in rows

ARM = "ur5e"
METRICS = metrics_of(on_arm=True)


def rows_of(word: str, starts, horizon_s: float = 3.0):
    """The rows that a run would store."""
    one = named(ARM, word)
    unit = Unit("arm", one.name, "arm-regulation", ARM, "native", "clear", NOMINAL, horizon_s=horizon_s)
    numbers = run("native", one, unit.task, ARM, starts, settings(horizon_s=horizon_s), METRICS)
    return frame(Settings(), unit, starts, numbers)


def test_condition_of_a_row_is_the_judges_largest_along_the_way():
    """At rest at its goal an arm stays; the largest is then that of the start, by numpy on MuJoCo's Jacobian."""
    model = kinematics(tasks.arm(ARM))
    start = model.start("home", model.arm.home, model.pose(model.arm.home)[1])
    [seen] = rows_of("rotation-matrix@geometric+solve", [start], 0.05).cond_jacobian_max
    assert seen == pytest.approx(np.linalg.cond(model.jacobian(model.arm.home)), rel=1e-6)


def test_dead_point_of_the_law_is_the_laws_own_fault():
    starts = [one for one in tasks.start_set("half-turn", arm=ARM) if one.id.endswith("exact")]
    rows = rows_of("rotation-matrix@geometric+solve", starts, 1.0)
    stuck = rows[rows.outcome == "stuck"]
    assert len(stuck)
    assert set(stuck.cause) == {"law"}


def test_stretched_arm_fails_of_its_kinematics():
    model = kinematics(tasks.arm(ARM))
    start = model.start("straight", [0.0] * 6, model.pose(model.arm.home)[1])
    [row] = rows_of("rotation-matrix@geometric+dynamically-consistent", [start]).itertuples()
    assert (row.outcome, row.cause) == ("singular", "kinematic")
    assert row.cond_jacobian_max > 1e8


def test_pole_is_the_representations_fault_where_the_arm_is_well_conditioned():
    """From the middle of the turns of `pole`, the pole itself, on to their goals."""
    model, starts = kinematics(tasks.arm(ARM)), []
    for start in (one for one in tasks.start_set("pole", arm=ARM) if one.id.endswith("exact")):
        turn = np.array(rotation_vector(start.goal_wxyz, start.quat_wxyz))
        angle = float(np.linalg.norm(turn))
        q = model.turn(start.q, tuple(turn / angle), angle / 2.0, 40)[-1]
        starts.append(model.start(start.id, q, start.goal_wxyz))
    by_angles = rows_of("feedback-linearized/zyx-euler@analytic+solve", starts)
    failed = by_angles[by_angles.outcome != "settled"]
    assert len(failed)
    assert set(failed.cause) <= {"representation", "both"}  # thrown by the pole, the arm may come near its own
    by_matrix = rows_of("rotation-matrix@geometric+solve", starts)
    assert set(by_matrix.outcome) == {"settled"}
    assert set(by_matrix.cause) == {""}
