"""C20 and C26 on tables written for them, and the experiments that C20 makes on an arm."""

import functools
import math

import numpy as np
import pandas as pd
import pytest
from support.tables import changed, decided
from support.tables import judged as judged_on

from bench.counting.counted import OPERATIONS
from bench.experiments import jacobians as poses
from bench.experiments.experiment import Settings
from bench.experiments.suites import ON_ARM
from bench.findings.claims import arm_probes, euler_controller
from bench.findings.claims.euler_controller import BY_COMMON, BY_EULER, INVERSES, ON_MATRIX, words
from bench.findings.claims.verdict import NoEvidence, Word
from bench.law.contender import Gains

ARMS = {"ur5e": 6, "panda": 7}
COSTS = {BY_EULER: (900, 24, 3), BY_COMMON: (830, 24, 3), ON_MATRIX: (810, 55, 0)}
"""flops in total, of the law alone, and calls."""

JOINTS = {f"q_{i + 1}": 0.0 for i in range(7)}


def cost_rows():
    for controller, (flops, law, calls) in COSTS.items():
        for joints in INVERSES:
            for stage, own, called in (("total", flops, 2 * calls), ("goal", 0, calls), ("regulate", law, 0)):
                numbers = dict.fromkeys(OPERATIONS, 0) | {"atan2": called, "flops": own}
                fixed = {"joints": joints, "branch": "typical", "stage": stage}
                yield {**words(controller, joints), **fixed, **numbers}


def episode_rows():
    for arm, joints in ARMS.items():
        for controller in COSTS:
            for start_set in ("clear", "pole"):
                for i in range(4):
                    fails = start_set == "pole" and i == 0 and controller != ON_MATRIX
                    yield {
                        **words(controller, joints),
                        **{"task": "arm-regulation", "arm": arm, "variation": "nominal", "engine": "native"},
                        **{
                            "start_set": start_set,
                            "start_id": f"{start_set}-{i}",
                            "kp": 100.0,
                            "kv": 20.0,
                            "dt_s": 1e-3,
                        },
                        **{"outcome": "saturated" if fails else "settled", "peak_tau_nm": 30.0},
                    }


@pytest.fixture
def frames():
    """What the theory has: a start at the pole fails on every arm, and the controller on J_E is dearer."""
    places = pd.DataFrame(
        {"arm": [*ARMS], "pose_set": "pole", "representation": "zyx-euler", "pose_id": "0-plus-exact"}
    )
    return {"costs": pd.DataFrame(cost_rows()), "episodes": pd.DataFrame(episode_rows()), "poses": places}


@pytest.fixture
def judged(frames):
    """judged(id, bend=, second=, drift=, beside=, table=frame): the experiments answer what they are told.

    bend: of an angle at 1 ms, first order in the step; second: what is left of it at step zero.
    """

    def judge(id, bend=5e-3, second=1e-5, drift=1e-5, beside="settled", **tables):
        def curves(word, arm, gains, dt_s, count):
            share = dt_s / 1e-3
            number = {"bend_0": bend * share + second, "bend_1": 0.0, "bend_2": 0.0, "position_error_m": drift}
            return pd.DataFrame([{"start_id": "clear-0", "time_s": t, **number} for t in (0.0, 0.02)])

        def beside_poles(word, arm, found, gains):
            outcome = "settled" if word.startswith("rotation-matrix") else beside
            return pd.DataFrame({"start_id": ["0-plus-exact"], "outcome": [outcome], "peak_tau_nm": [30.0]})

        bends = functools.partial(euler_controller.bend.__wrapped__, curves=curves)
        return judged_on(id, {"bend": bends, "beside_poles": beside_poles}, **frames | tables)

    return judge


def of(frame, controller, joints=6):
    named = words(controller, joints)
    return np.logical_and.reduce([frame[column] == word for column, word in named.items()])


@pytest.mark.parametrize("id", ["C20", "C26"])
def test_claim_holds_on_the_theory(judged, id):
    assert decided(judged(id), Word.HOLDS)


@pytest.mark.parametrize(("id", "table"), [("C20", "episodes"), ("C20", "poses"), ("C20", "costs"), ("C26", "costs")])
def test_claim_is_refused_without_rows(judged, frames, id, table):
    with pytest.raises(NoEvidence):
        judged(id, **{table: frames[table].iloc[:0]})


@pytest.mark.parametrize("joints", [6, 7])
@pytest.mark.parametrize("id", ["C20", "C26"])
def test_claim_is_refused_without_costs_of_an_arm_of_so_many_joints(judged, frames, id, joints):
    costs = frames["costs"]
    with pytest.raises(NoEvidence, match=f"on {joints} joints"):
        judged(id, costs=costs[costs["joints"] != joints])


def test_episodes_beside_poles_are_refused_where_a_run_has_no_such_pose(frames):
    of_ur5e = frames["poses"].iloc[:1].assign(**JOINTS)
    with pytest.raises(NoEvidence, match="no pose of panda beside a pole"):
        arm_probes.beside_poles(f"{ON_MATRIX}+pseudo-inverse", "panda", of_ur5e, Gains())


def test_c20_is_refused_without_the_law_on_r(judged, frames):
    episodes = frames["episodes"]
    with pytest.raises(NoEvidence, match="rotation-matrix@geometric on ur5e"):
        judged("C20", episodes=episodes[~of(episodes, ON_MATRIX)])


@pytest.mark.parametrize(
    ("found", "word"),
    [
        ({"second": 5e-3}, Word.CORRECTED),
        ({"second": 5e-2}, Word.FAILS),
        ({"second": math.nan}, Word.FAILS),
        ({"bend": 1e-6, "second": 1e-4}, Word.CORRECTED),
        ({"drift": 5e-3}, Word.CORRECTED),
    ],
)
def test_c20_looks_at_what_is_left_at_step_zero(judged, found, word):
    # a bend that does not halve with the step is not the integrator's, however small
    assert judged("C20", **found).word == word


@pytest.mark.parametrize(
    ("rows", "cells"),
    [
        (lambda t: t["arm"] != "", {"outcome": "settled"}),  # no start at the pole fails
        (lambda t: t["arm"] == "panda", {"outcome": "settled"}),  # one arm alone does not fail
        (lambda t: (t["start_id"] == "clear-2") & of(t, BY_EULER), {"outcome": "diverged"}),
        (lambda t: t["start_set"] == "pole", {"outcome": "saturated"}),  # both fail: it is not the orientation
    ],
    ids=["nothing fails", "one arm does not fail", "a clear start fails", "both fail"],
)
def test_c20_is_corrected_when(judged, frames, rows, cells):
    episodes = frames["episodes"]
    assert judged("C20", episodes=changed(episodes, rows(episodes), **cells)).word == Word.CORRECTED


def test_c20_takes_a_start_on_the_pole_itself(judged, frames):
    assert judged("C20", beside="singular", episodes=frames["episodes"].assign(outcome="settled")).word == Word.HOLDS


def test_c20_takes_a_hammered_torque_for_a_failure(judged, frames):
    episodes = frames["episodes"].assign(outcome="settled")
    at_pole = (episodes["start_id"] == "pole-1") & (episodes["regulator"] == "feedback-linearized")
    assert judged("C20", episodes=changed(episodes, at_pole, peak_tau_nm=299.0)).word == Word.CORRECTED
    assert judged("C20", episodes=changed(episodes, at_pole, peak_tau_nm=301.0)).word == Word.HOLDS


def test_c20_leaves_out_plants_that_differ_from_the_model(judged, frames):
    other = frames["episodes"].assign(variation="mass-130", outcome="diverged")
    both = pd.concat([frames["episodes"], other], ignore_index=True)
    assert str(judged("C20", episodes=both).evidence) == str(judged("C20").evidence)


def test_c20_fails_when_it_neither_fails_nor_hides(judged, frames):
    costs = changed(frames["costs"], of(frames["costs"], BY_EULER), flops=100)
    episodes = frames["episodes"].assign(outcome="settled")
    assert judged("C20", costs=costs, episodes=episodes).word == Word.FAILS


@pytest.mark.parametrize(
    ("id", "controller", "stage", "flops", "word"),
    [
        ("C20", BY_EULER, "regulate", 60, Word.CORRECTED),  # nothing is hidden
        ("C20", BY_EULER, "total", 700, Word.CORRECTED),
        # calls are the same in both: one flop less contradicts
        ("C26", BY_EULER, "total", 829, Word.FAILS),
        ("C26", BY_EULER, "total", 831, Word.HOLDS),
        # 3 calls more and 10 flops less: columns differ
        ("C26", ON_MATRIX, "total", 910, Word.FAILS),
    ],
)
def test_verdict_follows_the_costs(judged, frames, id, controller, stage, flops, word):
    costs = frames["costs"]
    rows = of(costs, controller) & (costs["stage"] == stage)
    assert judged(id, costs=changed(costs, rows, flops=flops)).word == word


def test_c26_counts_pairs_on_both_numbers_of_joints(judged):
    assert "dearer in both columns in 4 of 4 pairs" in str(judged("C26").evidence)


@pytest.mark.parametrize("euler", [3000.0, 1000.0])
def test_no_time_changes_the_word_of_c26(judged, euler):
    times = {BY_COMMON: 2000.0, ON_MATRIX: 1800.0, BY_EULER: euler}
    where = {"what": "engine", "engine": "native", "arm": "ur5e", "machine": "m", "ticks": 1}
    rows = [
        {**words(one, 6), **where, "ratio": time, "ratio_low": time - 50.0, "ratio_high": time + 50.0}
        for one, time in times.items()
    ]
    verdict = judged("C26", timings=pd.DataFrame(rows).assign(ns_per_tick=1.0))
    assert verdict.word == Word.HOLDS
    assert "times part 2 of them" in str(verdict.evidence)


def test_c26_says_that_nothing_was_timed(judged):
    assert "not timed" in str(judged("C26").evidence)


@pytest.mark.slow
def test_curves_of_an_arm_bend_by_the_integration_error_alone():
    word = f"{BY_EULER}+solve"
    full, half = (arm_probes.curves(word, "ur5e", Gains(), dt, 2) for dt in (1e-3, 5e-4))
    assert arm_probes.largest(half) / arm_probes.largest(full) == pytest.approx(0.5, abs=0.01)
    assert full["start_id"].nunique() == 2
    assert full.groupby("start_id")["time_s"].min().max() == 0.0


@pytest.mark.slow
def test_curves_of_a_law_that_is_not_linear_in_the_angles_bend_at_any_step():
    full, half = (arm_probes.curves(f"{ON_MATRIX}+solve", "ur5e", Gains(), dt, 2) for dt in (1e-3, 5e-4))
    assert arm_probes.largest(half) > 0.9 * arm_probes.largest(full) > 0.01


@pytest.mark.slow
def test_episodes_beside_poles_start_where_the_table_says_and_end_at_a_tenth_of_a_radian():
    table = poses.rows(Settings(), poses.of_arm("ur5e", 5))
    table = table[table["representation"] == "zyx-euler"]
    found = arm_probes.beside_poles(f"{ON_MATRIX}+solve", "ur5e", table, Gains())
    assert len(found) == 8 * 12
    assert (found["outcome"] == "settled").all()
    exact = found[found["start_id"].astype(str).str.endswith("exact")]
    assert np.abs(np.abs(exact["beta0"]) - math.pi / 2).max() < 1e-7  # beta is an arc tangent of rounding there
    assert np.allclose(exact["angle0_rad"], 0.1, atol=1e-12)
    assert found["horizon_s"].eq(ON_ARM).all()


def test_largest_bend_is_infinite_where_one_is_no_number():
    frame = pd.DataFrame({"bend_0": [1e-3, -2e-3], "bend_1": 0.0, "bend_2": 0.0})
    assert arm_probes.largest(frame) == 2e-3
    assert arm_probes.largest(frame.assign(bend_1=[math.nan, 0.0])) == math.inf
