"""The largest K dt of every velocity law: measured within 1 % of its closed form, the closed forms by other ways."""

import functools

import numpy as np
import pandas as pd
import pytest
from scipy.linalg import expm

import tasks
from bench.experiments import plan
from bench.experiments.choice import Choice
from bench.experiments.experiment import rows_of
from bench.experiments.tables.read import with_contender
from bench.experiments.velocity_limits import LAG_TICKS, pose
from bench.findings.theory.velocity_limits import by_eigenvalues, derivative, lagged, near, on_arm, with_theory
from bench.law.contenders.registry import all_contenders, contenders, inverse
from tasks.kinematics import kinematics

EXACT = ("solve", "pseudo-inverse", "dynamically-consistent", "truncated-svd", "damped-least-squares-variable")


@functools.cache
def measured() -> pd.DataFrame:
    laws = [one for one in all_contenders() if not one.regulator.costing_only]
    made = plan.make("quick", laws, Choice(experiments=("velocity-limits",)))
    return with_theory(with_contender(pd.concat([rows_of(made.settings, unit) for unit in made.units])))


def test_limit_of_every_velocity_law_is_within_one_percent_of_its_closed_form():
    rows = measured()
    has_theory = rows["k_dt_theory"].notna()
    off = (rows["k_dt"] - rows["k_dt_theory"]).abs() - 0.01 * rows["k_dt_theory"]
    assert rows[has_theory & (off > 0.0)].to_dict("records") == []
    assert set(rows.loc[rows["reach"] == "near", "k_dt_theory"].isna()) == {False}


@pytest.mark.parametrize("lag", LAG_TICKS)
def test_limit_behind_servos_is_where_a_root_leaves_the_circle(lag):
    """Roots of the sampled loop by the exponential of its matrix, on both sides of the limit."""

    def largest_root(K):
        if lag == 0.0:
            return abs(1.0 - K)
        A = np.array([[0.0, -1.0, 0.0], [0.0, -1.0 / lag, 1.0 / lag], [0.0, 0.0, 0.0]])  # of (e, rate, command)
        step = expm(A)
        closed = step[:2, :2] + np.outer(step[:2, 2], (K, 0.0))
        return np.abs(np.linalg.eigvals(closed)).max()

    assert largest_root(0.999 * lagged(lag)) < 1.0 < largest_root(1.001 * lagged(lag))


@pytest.mark.parametrize("arm", tasks.arm_names())
def test_limit_of_exact_inverses_is_two_and_of_the_transpose_that_of_its_largest_singular_value(arm):
    q, joints = pose(arm), tasks.arm(arm).joints
    for word in EXACT:
        if not contenders("inverses")[word].refuses(6, joints):
            assert on_arm(arm, q, inverse(word)) == pytest.approx(2.0, rel=1e-6)
    largest = np.linalg.svd(kinematics(tasks.arm(arm)).jacobian(q), compute_uv=False)[0]
    assert on_arm(arm, q, inverse("transpose")) == pytest.approx(2.0 / largest**2, rel=1e-9)


def test_closed_form_of_a_law_with_an_equation_is_that_of_its_derivative():
    for one in all_contenders():
        if one.equation is not None and one.regulator.memory is None and not one.regulator.in_engine:
            assert by_eigenvalues(derivative(one)) == pytest.approx(near(one), rel=1e-4)


def test_limit_of_errors_that_turn_is_that_of_complex_roots():
    turning = np.array([[1.0, -1.0], [1.0, 1.0]])  # eigenvalues 1 +- i: |1 - k (1 + i)| = 1 at k = 1
    assert by_eigenvalues(turning) == pytest.approx(1.0)
    assert by_eigenvalues(-np.eye(3)) == 0.0
