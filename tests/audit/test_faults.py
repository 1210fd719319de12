"""The registry of faults, the pairs, and the forms: each against what does not come from the audit."""

import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from bench.audit.convention import FORMS
from bench.audit.faults import every_fault
from bench.audit.pairs import every_pair
from bench.law.contenders.registry import contenders

FAULTS = every_fault()
EACH = pytest.mark.parametrize("fault", FAULTS)


@EACH
def test_fault_has_words_for_people_a_law_that_is_right_and_faults_that_explain_it(fault):
    assert re.fullmatch(r"[a-z0-9]+(-[a-z0-9]+)*", fault.name)
    assert all(len(text) > 8 for text in (fault.title, fault.effect, fault.cure))
    assert fault.law in contenders("regulators")
    assert set(fault.unless) <= {one.name for one in FAULTS} - {fault.name}


def test_no_two_faults_explain_each_other():
    by_name = {one.name: one for one in FAULTS}
    assert [(one.name, other) for one in FAULTS for other in one.unless if one.name in by_name[other].unless] == []


def test_truth_of_the_pairs_is_that_of_scipy():
    of = every_pair()
    k = of.angle[:, None] * of.axis
    quats = (Rotation.from_quat(q, scalar_first=True) for q in (of.q, of.q_d))
    for here, goal in ((Rotation.from_matrix(of.R), Rotation.from_matrix(of.R_d)), quats):
        e = (goal * here.inv()).as_rotvec()
        either = np.where(of.distance < 1e-12, np.abs(e + k).max(axis=1), np.inf)
        np.testing.assert_array_less(np.minimum(np.abs(e - k).max(axis=1), either), 5e-15)


def test_quaternions_and_matrices_of_a_pair_are_the_same_orientations():
    of = every_pair()
    for q, R in ((of.q, of.R), (of.q_d, of.R_d)):
        np.testing.assert_allclose(Rotation.from_quat(q, scalar_first=True).as_matrix(), R, rtol=0.0, atol=2e-15)
    assert (of.q * of.q_d).sum(axis=1).min() > -1e-15


def test_relative_rotation_is_exact_where_digits_matter():
    """The product R_d R^T of a diagonal R rounds nothing: 180° rotations stay symmetric, small angles exact."""
    of = every_pair()
    exact = np.abs(of.R).max(axis=(1, 2)) == np.abs(of.R).sum(axis=(1, 2)) / 3.0
    half = of.chosen(exact & of.at("at-180"))
    X = half.R_d @ half.R.swapaxes(1, 2)
    np.testing.assert_array_equal(X, X.swapaxes(1, 2))
    small = of.chosen(of.at("near-identity"))
    X = small.R_d @ small.R.swapaxes(1, 2)
    sine = 0.5 * np.stack((X[:, 2, 1] - X[:, 1, 2], X[:, 0, 2] - X[:, 2, 0], X[:, 1, 0] - X[:, 0, 1]), axis=1)
    error = np.linalg.norm(sine - np.sin(small.angle)[:, None] * small.axis, axis=1)
    np.testing.assert_array_less(error, 1e-15 * small.angle)


def test_distance_to_180_keeps_its_digits():
    of = every_pair().chosen(every_pair().at("near-180"))
    np.testing.assert_allclose(of.distance.min(), 1e-12, rtol=1e-12)


@pytest.mark.parametrize("form", FORMS)
def test_form_is_the_angle_near_0(form):
    theta = np.array((1e-6, 1e-5, 1e-4))
    np.testing.assert_allclose(FORMS[form].size(theta), theta, rtol=1e-8)
