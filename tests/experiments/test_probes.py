"""The experiments that claims make themselves, and what they are made of, each against a number that is known."""

import math

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation as Turn
from support.claim_tables import compliances, controllers

from bench.experiments import jacobians as poses
from bench.experiments.experiment import Settings
from bench.experiments.suites import ON_ARM
from bench.findings.claims import degeneracy, force_conversion, probes, rotation_matrix, side_by_side
from bench.findings.claims.controller_costs import BY_EULER, ON_MATRIX
from bench.findings.claims.euler_jacobian import DIFFERENCED, EPS
from bench.findings.claims.verdict import NoEvidence
from bench.law.contenders.registry import representation
from bench.law.inputs import Gains
from bench.law.so3 import IDENTITY, Rotation
from tasks.haar import axes

ZYX = representation("zyx-euler")


def test_quarter_turns_about_two_axes_and_back_are_a_third_of_a_turn():
    # a rotation of the cube about its diagonal
    assert degeneracy.ways(0)[1][-1] == pytest.approx(2 * math.pi / 3, abs=1e-12)


def test_small_rotations_settle_as_expected_and_large_ones_do_not():
    small, large = (probes.off_linear("linearized-euler", angle, axes(16), Gains(), 1e-3) for angle in (0.001, 1.2))
    assert small.max() < 2e-3
    assert large.max() > rotation_matrix.LOOSE_SETTLING


def test_exact_error_of_a_turn_about_z_is_its_sine():
    c, s = 0.6, 0.8
    R = Rotation((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))
    assert [float(x) for x in rotation_matrix._exact(R, IDENTITY)] == [0.0, 0.0, -0.8]


ANGLE, BETA = math.hypot(0.8, -0.5, 1.1), 0.3


@pytest.mark.parametrize(
    ("form", "E", "expected"),
    [
        # singular values of the left Jacobian are 1 and 2 sin(angle / 2) / angle (twice)
        ("rotation-vector", (0.8, -0.5, 1.1), ANGLE / (2 * math.sin(ANGLE / 2))),
        # B^T B has eigenvalues 1, 1 + cos(beta), 1 - cos(beta)
        ("zyz-euler", (0.4, BETA, -0.9), math.sqrt((1 + math.cos(BETA)) / (1 - math.cos(BETA)))),
    ],
)
def test_condition_of_coordinates_is_that_of_a_closed_form(form, E, expected):
    R = representation(form).to_matrix(E)
    assert degeneracy.condition_in(form, R) == pytest.approx(expected, rel=1e-12)


def test_condition_of_angle_and_axis_is_that_of_its_half_angle():
    # columns of length 1, 2 sin(angle / 2) and that times sin(polar angle), orthogonal
    angle, polar = 0.3, 0.7
    expected = 1.0 / (2 * math.sin(angle / 2) * math.sin(polar))
    found = degeneracy.condition_of_angle_and_axis(np.array((angle, polar, -0.9)))
    assert found == pytest.approx(expected, rel=1e-12)


def test_bodies_beside_a_pole_are_counted_and_some_settle():
    outcomes = probes.beside_pole(0.2, "feedback-linearized/zyx-euler", Gains())["outcome"]
    assert len(outcomes) == probes.BESIDE
    assert (outcomes == "settled").any()


def test_episodes_beside_poles_are_refused_where_a_run_has_no_such_pose():
    of_ur5e = controllers()["poses"].iloc[:1].assign(**{f"q_{i + 1}": 0.0 for i in range(7)})
    with pytest.raises(NoEvidence, match="no pose of panda beside a pole"):
        probes.beside_poles(f"{ON_MATRIX}+pseudo-inverse", "panda", of_ur5e, Gains())


def test_curves_of_an_arm_bend_by_the_integration_error_alone():
    full, half = (probes.curves(f"{BY_EULER}+solve", "ur5e", Gains(), dt, 2) for dt in (1e-3, 5e-4))
    assert probes.largest(half) / probes.largest(full) == pytest.approx(0.5, abs=0.01)
    assert full["start_id"].nunique() == 2
    assert full.groupby("start_id")["time_s"].min().max() == 0.0


def test_curves_of_a_law_that_is_not_linear_in_the_angles_bend_at_any_step():
    full, half = (probes.curves(f"{ON_MATRIX}+solve", "ur5e", Gains(), dt, 2) for dt in (1e-3, 5e-4))
    assert probes.largest(half) > 0.9 * probes.largest(full) > 0.01


def test_episodes_beside_poles_start_where_the_table_says_and_end_at_a_tenth_of_a_radian():
    table = poses.rows(Settings(), poses.of_arm("ur5e", 5))
    table = table[table["representation"] == "zyx-euler"]
    found = probes.beside_poles(f"{ON_MATRIX}+solve", "ur5e", table, Gains())
    assert len(found) == 8 * 12
    assert (found["outcome"] == "settled").all()
    exact = found[found["start_id"].astype(str).str.endswith("exact")]
    assert np.abs(np.abs(exact["beta0"]) - math.pi / 2).max() < 1e-7  # beta is an arc tangent of rounding there
    assert np.allclose(exact["angle0_rad"], 0.1, atol=1e-12)
    assert found["horizon_s"].eq(ON_ARM).all()


def test_largest_bend_is_infinite_where_one_is_no_number():
    frame = pd.DataFrame({"bend_0": [1e-3, -2e-3], "bend_1": 0.0, "bend_2": 0.0})
    assert probes.largest(frame) == 2e-3
    assert probes.largest(frame.assign(bend_1=[math.nan, 0.0])) == math.inf


def somewhere(count):
    return [(force_conversion.AT_RANDOM, R) for R in force_conversion.random_orientations(count, 1)]


def test_work_balances_at_random_and_polar_orientations():
    found, elsewhere = force_conversion.experiment()
    assert found["place"].value_counts().to_dict() == {"random": 2000, "near": 2 * 20 * 12, "exact": 2 * 20}
    assert found["exists"].all()
    assert found["gap"].max() < 10 * EPS
    assert found["difference_gap"].max() < 10 * DIFFERENCED
    assert len(elsewhere) == 5


def test_balance_sees_a_moment_that_is_not_converted():
    unconverted = ZYX._replace(generalized=lambda at, moment: (moment[2], moment[1], moment[0]))
    found = force_conversion.balances(unconverted, somewhere(50), 0)
    assert found["gap"].min() > 1e-4
    assert np.allclose(found["gap"], found["raw_gap"], atol=1e-14)


def test_balance_sees_a_b_that_is_wrong_on_both_sides():
    # B with its first column doubled, in (2.8) and in (3.12): they agree with each other, and not with R(E)
    def angular_velocity(at, Edot):
        return ZYX.angular_velocity(at, (2 * Edot[0], Edot[1], Edot[2]))

    def generalized(at, moment):
        first, second, third = ZYX.generalized(at, moment)
        return (2 * first, second, third)

    doubled = ZYX._replace(angular_velocity=angular_velocity, generalized=generalized)
    found = force_conversion.balances(doubled, somewhere(50), 0)
    assert found["gap"].max() < 10 * EPS
    assert found["difference_gap"].min() > 1e-4


def test_moment_about_the_level_axis_is_lost_at_the_poles_alone():
    found = force_conversion.balances(ZYX, force_conversion.polar_orientations(ZYX, 0), 0)
    exact = found["place"] == force_conversion.AT_POLE
    assert found.loc[exact, "lost"].max() < force_conversion.LOST
    assert found.loc[~exact, "lost"].min() > 0.5e-12
    for _, R in [one for one in force_conversion.polar_orientations(ZYX, 0) if one[0] == force_conversion.AT_POLE]:
        at_pole = ZYX.chart(R)
        assert np.abs(ZYX.generalized(at_pole, (at_pole.cos_alpha, at_pole.sin_alpha, 0.0))).max() < 1e-15


def test_random_orientations_are_uniform():
    # the trace of a Haar-random rotation has mean 0 and variance 1
    traces = [R.n[0] + R.o[1] + R.a[2] for R in force_conversion.random_orientations(4000, 1)]
    assert abs(np.mean(traces)) < 4 / math.sqrt(4000)
    assert np.var(traces) == pytest.approx(1.0, abs=0.1)


def test_planes_of_compliance_are_as_far_apart_as_their_normals():
    flat = np.diag([1.0, 1.0, 0.0])[None]
    tilted = side_by_side.turned(flat, Turn.from_euler("y", 0.3).as_matrix()[None])
    assert side_by_side.planes_apart(tilted, flat) == pytest.approx([0.3], abs=1e-12)
    assert np.isnan(side_by_side.planes_apart(np.full((1, 3, 3), np.nan), flat)).all()


def test_compliance_counts_as_not_measured_unless_done():
    table = compliances()["compliance"]
    assert np.isfinite(side_by_side.compliances(table[table["outcome"] == "done"])).all()
    assert np.isnan(side_by_side.compliances(table.assign(outcome="saturated"))).all()
