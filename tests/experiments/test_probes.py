"""Probes and what they are made of, each against a number that is known."""

import math

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.experiments.experiment import Unit, known_experiments, rows_of
from bench.experiments.probes import PROBES, arms, commands, coordinates, turns, units, variables
from bench.experiments.request import Request
from bench.findings.claims.euler_jacobian import DIFFERENCED, EPS
from bench.findings.theory import closed_form
from bench.law.contenders.registry import all_contenders, representation
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.so3 import IDENTITY, Rotation
from tasks.haar import axes

ZYX = representation("zyx-euler")


def test_quarter_turns_about_two_axes_and_back_are_a_third_of_a_turn():
    # a rotation of the cube about its diagonal
    loops = [one for one in variables.measure_ways(Request(), None) if one.measure == "left_after_loop_rad"]
    assert loops[-1].at == math.pi / 2
    assert loops[-1].value == pytest.approx(2 * math.pi / 3, abs=1e-12)


def test_small_rotations_settle_as_expected_and_large_ones_do_not():
    linear = closed_form.linear_settling(*Gains())
    off = []
    for angle in (0.001, 1.2):
        turned = turns.measure_turns(Request(), turns.LINEARIZED, axes(16), Gains(), angle)
        off.append(max(abs(one.value / linear - 1) for one in turned))
    assert off[0] < 2e-3
    assert off[1] > 0.05


def test_exact_error_of_a_turn_about_z_is_its_sine():
    c, s = 0.6, 0.8
    R = Rotation((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))
    assert [float(x) for x in commands.exact_error(R, IDENTITY)] == [0.0, 0.0, -0.8]


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
    assert coordinates.condition_in(form, R) == pytest.approx(expected, rel=1e-12)


def test_condition_of_angle_and_axis_is_that_of_its_half_angle():
    # columns of length 1, 2 sin(angle / 2) and that times sin(polar angle), orthogonal
    angle, polar = 0.3, 0.7
    expected = 1.0 / (2 * math.sin(angle / 2) * math.sin(polar))
    found = coordinates.condition_of_angle_and_axis(np.array((angle, polar, -0.9)))
    assert found == pytest.approx(expected, rel=1e-12)


def test_bodies_beside_a_pole_are_counted_and_some_settle():
    starts = turns.starts_beside_pole(0.2)
    outcomes = turns.episodes(turns.FEEDBACK, starts, Gains(), 1e-3, 10.0)["outcome"]
    assert len(outcomes) == turns.BESIDE
    assert (outcomes == "settled").any()


def test_linear_response_is_that_of_the_closed_form():
    times = np.linspace(0.0, 2.0, 21)
    for gains in (Gains(), Gains(100.0, 10.0), Gains(100.0, 30.0)):
        expected = closed_form.linear(times, *gains)
        assert np.abs(arms.linear_response(times, gains) - expected).max() < 1e-12


def test_curves_of_an_arm_bend_by_the_integration_error_alone():
    name = f"{arms.BY_EULER}+solve"
    full, half = (arms.curves(name, "ur5e", Request(), dt, 2) for dt in (1e-3, 5e-4))
    assert arms.largest(half) / arms.largest(full) == pytest.approx(0.5, abs=0.01)
    assert full["start_id"].nunique() == 2
    assert full.groupby("start_id")["time_s"].min().max() == 0.0


def test_curves_of_a_law_that_is_not_linear_in_the_angles_bend_at_any_step():
    name = f"{arms.ON_MATRIX}+solve"
    full, half = (arms.curves(name, "ur5e", Request(), dt, 2) for dt in (1e-3, 5e-4))
    assert arms.largest(half) > 0.9 * arms.largest(full) > 0.01


def test_episodes_beside_poles_start_within_a_hundredth_and_end_at_a_tenth_of_a_radian():
    found = arms.episodes_at_poles(f"{arms.ON_MATRIX}+solve", "ur5e", Request())
    assert len(found) == 8 * 12
    assert (found["outcome"] == "settled").all()
    exact = found[found["start_id"].astype(str).str.endswith("exact")]
    assert np.abs(np.abs(exact["beta0"]) - math.pi / 2).max() < 1e-7  # beta is an arc tangent of rounding there
    assert np.allclose(exact["angle0_rad"], 0.1, atol=1e-12)


def test_largest_bend_is_infinite_where_one_is_no_number():
    frame = pd.DataFrame({"bend_0": [1e-3, -2e-3], "bend_1": 0.0, "bend_2": 0.0})
    assert arms.largest(frame) == 2e-3
    assert arms.largest(frame.assign(bend_1=[math.nan, 0.0])) == math.inf


def test_torques_of_the_arms_own_model_give_the_acceleration_and_those_of_another_do_not():
    own, other = (arms.accelerations("puma560", plant, 3) for plant in ("", "mass-1.15"))
    assert max(own) < 1e-6
    assert np.median(other) > 0.1


def balances(along, places):
    """Return what balances of work are at some places, a row each."""
    return pd.DataFrame([found for _, found in coordinates.balances(along, places, 0)])


def somewhere(count):
    return [(coordinates.AT_RANDOM, R) for R in coordinates.random_orientations(count, 1)]


def test_work_balances_at_random_and_polar_orientations():
    rows = rows_of(Request(), Unit("probes", selector="work"))
    found = rows[rows["representation"] == "zyx-euler"]
    place = found.loc[found["measure"] == "exists", "case"].str.partition("-")[0]
    assert place.value_counts().to_dict() == {"random": 2000, "near": 2 * 20 * 12, "exact": 2 * 20}
    values = found.groupby("measure")["value"]
    assert values.min()["exists"] == 1.0
    assert values.max()["power_gap"] < 10 * EPS
    assert values.max()["difference_gap"] < 10 * DIFFERENCED
    assert rows["representation"].nunique() == 1 + 5


def test_balance_sees_a_moment_that_is_not_converted():
    unconverted = ZYX._replace(generalized=lambda at, moment: (moment[2], moment[1], moment[0]))
    found = balances(unconverted, somewhere(50))
    assert found["power_gap"].min() > 1e-4
    assert np.allclose(found["power_gap"], found["unconverted"], atol=1e-14)


def test_balance_sees_a_b_that_is_wrong_on_both_sides():
    # B with its first column doubled, in (2.8) and in (3.12): they agree with each other, and not with R(E)
    def angular_velocity(at, Edot):
        return ZYX.angular_velocity(at, (2 * Edot[0], Edot[1], Edot[2]))

    def generalized(at, moment):
        first, second, third = ZYX.generalized(at, moment)
        return (2 * first, second, third)

    doubled = ZYX._replace(angular_velocity=angular_velocity, generalized=generalized)
    found = balances(doubled, somewhere(50))
    assert found["power_gap"].max() < 10 * EPS
    assert found["difference_gap"].min() > 1e-4


def test_moment_about_the_level_axis_is_lost_at_the_poles_alone():
    places = coordinates.polar_orientations(ZYX, 0)
    found = balances(ZYX, places)
    exact = np.array([place == coordinates.AT_POLE for place, _ in places])
    assert found.loc[exact, "lost"].max() < 1e-12
    assert found.loc[~exact, "lost"].min() > 0.5e-12
    for _, R in [one for one in places if one[0] == coordinates.AT_POLE]:
        at_pole = ZYX.chart(R)
        assert np.abs(ZYX.generalized(at_pole, (at_pole.cos_alpha, at_pole.sin_alpha, 0.0))).max() < 1e-15


def test_random_orientations_are_uniform():
    # the trace of a Haar-random rotation has mean 0 and variance 1
    traces = [R.n[0] + R.o[1] + R.a[2] for R in coordinates.random_orientations(4000, 1)]
    assert abs(np.mean(traces)) < 4 / math.sqrt(4000)
    assert np.var(traces) == pytest.approx(1.0, abs=0.1)


def plan(gains=PAPERS_GAINS):
    laws = tuple(one for one in all_contenders() if not one.regulator.costing_only)
    return units(Request("quick", laws, gains))


def test_every_probe_is_planned_once_and_on_each_of_its_arms():
    found = plan()
    assert list(dict.fromkeys(unit.selector for unit in found)) == list(PROBES)
    assert len({unit.key for unit in found}) == len(found)
    assert {unit.arm for unit in found if unit.selector == "arm-pole"} == set(tasks.arm_names())


def test_probes_of_the_sliding_law_are_left_out_where_the_gains_have_no_real_poles():
    left = {unit.selector for unit in plan()} - {unit.selector for unit in plan(Gains(100.0, 10.0))}
    assert left == {name for name, probe in PROBES.items() if probe.needs_real_poles}


@pytest.mark.parametrize("name", [name for name, probe in PROBES.items() if probe.cost_s < 1.0])
def test_no_two_numbers_of_a_probe_have_one_key(name):
    [unit] = [one for one in plan() if one.selector == name][:1]
    rows = rows_of(Request(), unit)
    assert len(rows)
    assert not rows.duplicated([one for one in known_experiments()["probes"].table.key if one in rows]).any()
