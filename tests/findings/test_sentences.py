"""What claims C40 to C47 rest on, each against a number known otherwise."""

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.claim_tables import compliances
from support.tables import decided, judged

from bench.experiments.probes import coordinates, variables
from bench.findings.claims import side_by_side
from bench.findings.claims.verdict import Word

TURNED = ScipyRotation.from_euler("z", 0.7).as_matrix()[None]
TRIO = (0, 1, 3)
"""n_x, n_y and o_x."""


def test_divisor_of_a_turn_about_z_is_its_sine_and_no_column_can_be_eliminated():
    # det [[2c, 2s, 0], [0, 0, -2s], [-s, c, c]] = 4 s (c^2 + s^2)
    assert variables.divisor(TURNED, TRIO)[0] == pytest.approx(np.sin(0.7), abs=1e-15)
    assert variables.product(TURNED, TRIO)[0] == pytest.approx(np.sin(0.7), abs=1e-15)
    assert (
        np.abs(variables.divisor(ScipyRotation.random(5, rng=0).as_matrix(), (0, 1, 2))).max()
        < 1e-15
    )


def test_second_matrix_with_the_same_elements_is_a_rotation():
    other = variables.another(TURNED, TRIO)[0]
    assert np.allclose(other.T @ other, np.eye(3), atol=1e-15)
    assert np.linalg.det(other) == pytest.approx(1.0)
    assert np.allclose(other[:, 1], TURNED[0, :, 1])
    assert other[2, 0] == TURNED[0, 2, 0]
    assert not np.allclose(other, TURNED[0])


def test_smallest_singular_value_of_two_forms_is_that_of_a_closed_form():
    # B^T B has eigenvalues 1, 1 + x and 1 - x, x = sin(beta) of Z-Y-X and cos(beta) of Z-Y-Z angles
    assert variables.least_of("ZYX", (0.4, 0.5, -0.9)) == pytest.approx(np.sqrt(1 - np.sin(0.5)))
    assert variables.least_of("ZYZ", (0.4, 0.5, -0.9)) == pytest.approx(np.sqrt(1 - np.cos(0.5)))


def test_acceleration_of_the_angles_is_that_of_a_body_that_spins_freely():
    E, omega, h = np.array((0.4, 0.6, -0.9)), np.array((0.5, -0.3, 0.8)), 1e-3

    def angles(t):
        return (ScipyRotation.from_rotvec(omega * t) * ScipyRotation.from_euler("ZYX", E)).as_euler(
            "ZYX"
        )

    rates = (angles(h) - angles(-h)) / (2 * h)
    expected = (angles(h) - 2 * angles(0.0) + angles(-h)) / h**2
    assert np.allclose(coordinates.angular_acceleration(E, rates, np.zeros(3)), expected, atol=1e-4)


@pytest.mark.parametrize(
    ("force", "moment", "turn", "outcome", "word"),
    [
        (3.0, 1e-4, 1e-3, "done", Word.HOLDS),
        (3.0, 1e-4, 0.02, "done", Word.CORRECTED),
        (9.0, 1e-4, 1e-3, "done", Word.FAILS),
        (3.0, 1e-2, 1e-3, "done", Word.FAILS),
        (3.0, 1e-4, 1e-3, "singular", Word.FAILS),
    ],
)
def test_force_control_is_judged_by_force_moment_and_rotation(force, moment, turn, outcome, word):
    rows = [
        {"task": task, "controller": "hybrid-base", "form": form, "outcome": outcome, "held_turn_rad": turn}
        | {"normal_force_error_n": pressed, "alignment_error_rad": laid}
        for task, pressed, laid in (("force-on-plane", force, np.nan), ("surface-alignment", np.nan, moment))
        for form in ("transpose", "inverse")
    ]
    assert decided(judged("C47", compliance=pd.DataFrame(rows)), word)


def test_planes_of_compliance_are_as_far_apart_as_their_normals():
    flat = np.diag([1.0, 1.0, 0.0])[None]
    tilted = side_by_side.turned(flat, ScipyRotation.from_euler("y", 0.3).as_matrix()[None])
    assert side_by_side.planes_apart(tilted, flat) == pytest.approx([0.3], abs=1e-12)
    assert np.isnan(side_by_side.planes_apart(np.full((1, 3, 3), np.nan), flat)).all()


def test_compliance_counts_as_not_measured_unless_done():
    table = compliances()["compliance"]
    assert np.isfinite(side_by_side.compliances(table[table["outcome"] == "done"])).all()
    assert np.isnan(side_by_side.compliances(table.assign(outcome="saturated"))).all()
