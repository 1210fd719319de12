"""Claims C39 to C45 and what they compute, each against a number known otherwise or a plant that is wrong."""

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation as Turn
from support.tables import decided, judged

from bench.findings.claims import all_claims, euler_jacobian, linearized_euler, representations
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import Word

TURNED = Turn.from_euler("z", 0.7).as_matrix()[None]
TRIO = (0, 1, 3)
"""n_x, n_y and o_x."""


def gains_only():
    row = {"task": "free-body", "arm": "", "jacobian": "", "engine": "ideal-rk4", "kp": 100.0, "kv": 20.0}
    return pd.DataFrame([row | {"regulator": "rotation-matrix", "representation": "", "inverse": ""}])


@pytest.mark.parametrize(
    ("tails", "outcome", "word"),
    [
        ((1e-4, 1e-4), "settled", Word.HOLDS),
        ((1e-4, 5e-4), "settled", Word.CORRECTED),
        ((5e-4, 5e-4), "settled", Word.FAILS),
        ((1e-4, 1e-4), "timed-out", Word.FAILS),
    ],
)
def test_law_tracks_as_well_as_another_or_does_not(tails, outcome, word):
    def perturbed(law, *_):
        is_own = law.startswith("linearized")
        rows = [
            {
                "level": level,
                "start_id": f"uniform-{far:g}",
                "angle0_rad": far,
                "outcome": outcome if is_own else "settled",
            }
            | {"tail_max_rad": tail if is_own and level and far < 1 else 1e-4}
            for level, tail in ((0.0, 1.0), (1.0, tails[0]), (5.0, tails[1]))
            for far in (0.5, 2.0)
        ]
        return pd.DataFrame(rows)

    assert decided(judged("C39", {"perturbed": perturbed}, episodes=gains_only()), word)


def test_divisor_of_a_turn_about_z_is_its_sine_and_no_column_can_be_eliminated():
    # det [[2c, 2s, 0], [0, 0, -2s], [-s, c, c]] = 4 s (c^2 + s^2)
    assert representations.divisor(TURNED, TRIO)[0] == pytest.approx(np.sin(0.7), abs=1e-15)
    assert representations.product(TURNED, TRIO)[0] == pytest.approx(np.sin(0.7), abs=1e-15)
    assert np.abs(representations.divisor(Turn.random(5, rng=0).as_matrix(), (0, 1, 2))).max() < 1e-15


def test_second_matrix_with_the_same_elements_is_a_rotation():
    other = representations.another(TURNED, TRIO)[0]
    assert np.allclose(other.T @ other, np.eye(3), atol=1e-15)
    assert np.linalg.det(other) == pytest.approx(1.0)
    assert np.allclose(other[:, 1], TURNED[0, :, 1])
    assert other[2, 0] == TURNED[0, 2, 0]
    assert not np.allclose(other, TURNED[0])


def test_smallest_singular_value_of_two_forms_is_that_of_a_closed_form():
    # B^T B has eigenvalues 1, 1 + x and 1 - x, x = sin(beta) of Z-Y-X and cos(beta) of Z-Y-Z angles
    assert representations.least_of("ZYX", (0.4, 0.5, -0.9)) == pytest.approx(np.sqrt(1 - np.sin(0.5)))
    assert representations.least_of("ZYZ", (0.4, 0.5, -0.9)) == pytest.approx(np.sqrt(1 - np.cos(0.5)))


@pytest.mark.parametrize(
    ("id", "word"),
    [("C40", Word.CORRECTED), ("C41", Word.HOLDS), ("C42", Word.HOLDS), ("C43", Word.HOLDS), ("C45", Word.HOLDS)],
)
@pytest.mark.parametrize("seed", [0, 7])
def test_claim_without_tables_gets_the_same_word_from_any_draw(id, word, seed, tmp_path):
    (tmp_path / "plan.json").write_text(f'{{"seed": {seed}, "dt_s": 0.001}}')
    claim = next(one for one in all_claims() if one.id == id)
    found, why = claim.judge(Results(tmp_path))
    assert (found, why.rows > 0) == (word, True)


def test_torques_of_the_arms_own_model_give_the_acceleration_and_those_of_another_do_not():
    own, other = (euler_jacobian.accelerations("puma560", plant, 3) for plant in ("", "mass-1.15"))
    assert own.max() < 1e-6
    assert np.median(other) > 0.1


@pytest.mark.parametrize(
    ("gaps", "word"), [((1e-9, 0.5), Word.HOLDS), ((1e-3, 0.5), Word.FAILS), ((1e-9, 1e-9), Word.FAILS)]
)
def test_torques_that_miss_the_input_or_need_no_model_refute_the_claim(gaps, word):
    def accelerations(arm, plant, seed):
        return np.array([gaps[bool(plant)]])

    assert decided(judged("C44", {"accelerations": accelerations}), word)


def test_acceleration_of_the_angles_is_that_of_a_body_that_spins_freely():
    E, omega, h = np.array((0.4, 0.6, -0.9)), np.array((0.5, -0.3, 0.8)), 1e-3

    def angles(t):
        return (Turn.from_rotvec(omega * t) * Turn.from_euler("ZYX", E)).as_euler("ZYX")

    rates = (angles(h) - angles(-h)) / (2 * h)
    expected = (angles(h) - 2 * angles(0.0) + angles(-h)) / h**2
    assert np.allclose(linearized_euler.angular_acceleration(E, rates, np.zeros(3)), expected, atol=1e-4)


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
