"""The real-time loop: the exported C++, the theory of late torques, the committed study."""

import os
import time
from pathlib import Path

import numpy as np
import pytest
from scipy.linalg import expm
from scipy.spatial.transform import Rotation
from support.buffers import bias_of, inertia_of, jacobian_of
from support.states import rotation

import tasks
from bench.experiments import starts
from bench.experiments.tables.store import read
from bench.findings.real_time import GREATEST, PERIOD_S, STUDY
from bench.findings.theory.late_torques import (
    find_alternating_limit,
    find_constant_limit,
    find_greatest_kv,
    transition,
)
from bench.law.inputs import PAPERS_GAINS
from bench.studies.real_time.__main__ import (
    LAST,
    LAWS,
    STARTS,
    beside_home,
    compute_delays,
    compute_parts,
    critical_gains,
    is_shrinking,
)
from bench.studies.real_time.loop import (
    EIGEN,
    NEVER,
    PERIOD_NS,
    SLOTS,
    SUBSTEPS,
    Loop,
    build_programs,
)

PATIENCE_S = 30.0
TICKS = 2000


def limit_of(applied_s):
    """Return the greatest Kv T of the theory."""
    return PERIOD_S * find_greatest_kv(applied_s, PERIOD_S, GREATEST, LAST)


def late_by(delay):
    """Return when each tick's torque arrives, if all are late by one share of the period."""
    return PERIOD_S * (np.arange(TICKS) + delay)


def oracle_radius(gain, delay):
    """Return the greatest |eigenvalue| over a period, by matrix exponentials of e'' = u."""
    drift = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]])
    # A new command replaces u; (e, omega) at the tick are in the fourth and fifth place.
    state = np.zeros((5, 5))
    state[:3, :3] = drift
    remember = np.eye(5)
    remember[3:, :] = np.eye(5)[:2]
    switch = np.eye(5)
    switch[2] = [0.0, 0.0, 0.0, -0.25 * gain * gain, -gain]
    period = expm((1.0 - delay) * state) @ switch @ expm(delay * state) @ remember
    return np.abs(np.linalg.eigvals(period)).max()


@pytest.mark.parametrize("delay", [0.0, 0.05, 0.125, 0.25, 0.5, 0.9])
def test_limit_of_a_constant_delay_is_that_of_the_eigenvalues(delay):
    limit = find_constant_limit(delay)
    assert oracle_radius(0.999 * limit, delay) < 1.0 < oracle_radius(1.001 * limit, delay)
    assert limit_of(late_by(delay)) == pytest.approx(limit, rel=3e-3)


def radius_of_whole_periods(gain, periods):
    """Return the greatest |eigenvalue| of (e, omega, commands that wait), the last in force."""
    size = 2 + periods
    period = np.eye(size, k=-1)
    period[0] = period[1] = period[2] = 0.0
    period[0, [0, 1, size - 1]] = 1.0, 1.0, 0.5
    period[1, [1, size - 1]] = 1.0
    period[2, [0, 1]] = -0.25 * gain * gain, -gain
    return np.abs(np.linalg.eigvals(period)).max()


@pytest.mark.parametrize("periods", [1, 2, 3])
def test_limit_of_a_delay_of_whole_periods_is_that_of_the_eigenvalues(periods):
    limit = limit_of(late_by(float(periods)))
    assert (
        radius_of_whole_periods(0.995 * limit, periods)
        < 1.0
        < radius_of_whole_periods(1.005 * limit, periods)
    )


def test_without_delay_the_command_alternates_at_the_limit():
    values = np.linalg.eigvals(transition(find_constant_limit(0.0), 0.0))
    assert np.abs(values + 1.0).min() < 1e-3
    assert find_constant_limit(0.0) == pytest.approx(2.0, abs=1e-4)


@pytest.mark.parametrize("delay", [0.01, 0.05, 0.1, 0.13])
def test_short_delay_weakens_the_alternation(delay):
    limit = find_constant_limit(delay)
    assert limit == pytest.approx(find_alternating_limit(delay), rel=1e-4)
    assert limit > 2.0 / (1.0 - 2.0 * delay)


def test_greatest_limit_is_where_a_complex_pair_takes_over():
    delays = np.linspace(0.0, 1.0, 1001)
    limits = np.array([find_constant_limit(delay) for delay in delays])
    peak = delays[limits.argmax()]
    assert peak == pytest.approx(0.134, abs=0.002)
    values = np.linalg.eigvals(transition(find_constant_limit(peak + 0.01), peak + 0.01))
    lost = values[np.abs(values).argmax()]
    assert abs(lost.imag) > 0.1


def test_state_that_is_never_answered_leaves_the_torque_before():
    # It is a loop of twice the period with the same law: its Kv T, with this period, is half.
    applied_s = late_by(0.0)
    applied_s[1::2] = np.nan
    assert limit_of(applied_s) == pytest.approx(1.0, rel=3e-3)


def expected_torque(loop, start):
    """Return D J^+ (a - Jdot qdot) + h by numpy, the law by the sine of a rotation vector."""
    model, data, (kp, kv) = loop.model, loop.data, PAPERS_GAINS
    J, drift, D = (
        jacobian_of(model, data, "tool"),
        bias_of(model, data, "tool"),
        inertia_of(model, data),
    )
    left = (
        rotation(start.goal_wxyz) * Rotation.from_matrix(data.site("tool").xmat.reshape(3, 3)).inv()
    )
    angle = left.magnitude()
    sine = left.as_rotvec() / angle * np.sin(angle)
    twist = J @ data.qvel
    a = np.r_[-kv * twist[:3], kp * sine - kv * twist[3:]] - drift
    damped = (0.5 * kv if loop.joints > 6 else 0.0) * data.qvel
    return D @ (np.linalg.pinv(J) @ (a + J @ damped) - damped) + data.qfrc_bias - data.qfrc_passive


FOLDERS = (
    EIGEN,
    *map(Path, filter(None, os.environ.get("CPLUS_INCLUDE_PATH", "").split(os.pathsep))),
)
NEEDS_EIGEN = pytest.mark.skipif(
    not any((folder / "Eigen").is_dir() for folder in FOLDERS),
    reason="no Eigen here (apt install libeigen3-dev, or name its folder in CPLUS_INCLUDE_PATH)",
)


@NEEDS_EIGEN
@pytest.mark.parametrize("arm", ["puma560", "panda"])
def test_controller_answers_with_the_formulas_torque(arm, tmp_path):
    start = starts.on_arm("tumbling", 2, 0, arm)[1]
    with Loop(arm, "nominal", build_programs("rotation-matrix", tmp_path)) as loop:
        loop.begin(start, PAPERS_GAINS)
        loop.publish(1)
        began = time.monotonic()
        while loop.shared["answered"] != 1 and time.monotonic() - began < PATIENCE_S:
            time.sleep(1e-3)
        answer = loop.shared["answers"][1 % SLOTS]
        assert answer["tick"] == 1
        np.testing.assert_allclose(
            answer["tau"][: loop.joints], expected_torque(loop, start), rtol=1e-8, atol=1e-8
        )


@pytest.fixture(scope="module")
def loop(tmp_path_factory):
    """Return a UR5e in real time, its torques without bounds."""
    programs = build_programs("late-braking", tmp_path_factory.mktemp("programs"))
    with Loop("ur5e", "ideal-motors", programs) as loop:
        yield loop


@NEEDS_EIGEN
def test_episode_in_real_time_turns_the_tool_to_its_goal(loop):
    start = starts.on_arm("clear", 1, 0, "ur5e")[0]
    course = loop.run(start, PAPERS_GAINS, 1.0, SUBSTEPS[0])
    assert course.haversine[-1] < 1e-4 * course.haversine[0]


@NEEDS_EIGEN
def test_clocks_of_both_processes_are_in_the_order_of_the_events(loop):
    course = loop.run(starts.on_arm("clear", 1, 0, "ur5e")[0], PAPERS_GAINS, 0.3, SUBSTEPS[-1])
    for name, seconds in compute_parts(course).items():
        assert (seconds >= 0.0).all(), name
    records = course.records[course.records["applied_ns"] != NEVER]
    assert len(records) > 0
    assert (np.diff(records["applied_ns"]) >= 0).all()
    assert (records["applied_ns"] >= records["written_ns"]).all()


@NEEDS_EIGEN
def test_replay_of_recorded_delays_is_the_same_episode(loop):
    start = starts.on_arm("clear", 1, 0, "ur5e")[0]
    course = loop.run(start, PAPERS_GAINS, 0.5, SUBSTEPS[1])
    again = loop.replay(start, PAPERS_GAINS, course.records["applied_ns"], SUBSTEPS[1])
    for name in ("q", "qdot", "applied_ns"):
        np.testing.assert_array_equal(again.records[name], course.records[name])


@NEEDS_EIGEN
@pytest.mark.parametrize("substeps", SUBSTEPS)
@pytest.mark.parametrize("delay", [0.0, 0.1, 0.3, 1.5])
def test_arm_is_held_exactly_between_torques_whatever_the_substeps(loop, substeps, delay):
    # MuJoCo's own eight steps lose the loop without delay at 1.941, with 1/8 period at 2.834.
    ticks = np.arange(400)
    applied_ns = np.round(PERIOD_NS * (ticks + delay)).astype(np.int64)
    limit = limit_of(1e-9 * applied_ns)
    for share, is_stable in ((0.98, True), (1.02, False)):
        gains = critical_gains(share * limit / PERIOD_S)
        assert (
            is_shrinking(loop.replay(beside_home("ur5e"), gains, applied_ns, substeps)) == is_stable
        )


def test_delay_counts_the_torque_of_a_later_state_where_a_state_has_none():
    class OfTwo:
        applied_s = np.array([np.nan, 1.25 * PERIOD_S, np.nan])

    np.testing.assert_allclose(compute_delays(OfTwo), [1.25 * PERIOD_S, 0.25 * PERIOD_S])


def stored():
    """Return the committed rows."""
    return read(STUDY, "real_time").astype({"arm": str, "regulator": str})


def test_study_has_every_arm_law_and_number_of_substeps():
    rows = stored()
    keys = {*zip(rows["arm"], rows["regulator"], rows["substeps"], strict=True)}
    # An arm may be newer than the study.
    studied = set(rows["arm"])
    assert {"jaco", "panda", "puma560", "ur5e"} <= studied <= set(tasks.arm_names())
    assert keys == {(arm, law, substeps) for arm in studied for law in LAWS for substeps in SUBSTEPS}
    assert {8, 16, 64} <= set(SUBSTEPS)


def test_study_ends_as_the_simulated_loop_does():
    rows = stored()
    by_arm = rows.groupby(["arm", "regulator"])[["starts", "agreeing"]].sum()
    assert (by_arm["starts"] == STARTS).all()
    assert (by_arm["agreeing"] >= STARTS - 1).all()


def test_limit_with_recorded_delays_does_not_depend_on_the_substeps():
    limits = stored().groupby(["arm", "regulator"])["kv_replayed"].agg(["min", "max"])
    assert (limits["max"] / limits["min"] - 1.0 < 0.02).all()


def test_limit_with_recorded_delays_is_that_of_an_exact_hold():
    rows = stored()
    np.testing.assert_allclose(rows["kv_replayed"], rows["kv_replay_predicted"], rtol=0.05)


def test_limit_in_real_time_is_that_of_an_exact_hold_and_does_not_depend_on_the_substeps():
    rows = stored()
    np.testing.assert_allclose(rows["kv_measured"], rows["kv_predicted"], rtol=0.05)
    medians = rows.groupby("substeps")["kv_measured"].median()
    assert medians.max() / medians.min() - 1.0 < 0.02


def test_delays_of_the_study_are_no_multiples_of_a_substep():
    rows = stored()
    for substeps in SUBSTEPS:
        shares = rows["delay_median_s"] / (PERIOD_S / substeps)
        assert (np.abs(shares - np.round(shares)) > 1e-3).any()
    assert (rows["resolution_s"] < 0.1 * rows["delay_median_s"]).all()
