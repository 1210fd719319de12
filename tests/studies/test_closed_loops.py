"""Other libraries' errors in closed loop: closed forms, dead points, unwinding; verdicts, and what is fixed."""

import math

import numpy as np
import pandas as pd
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.planted import log as logarithm

from bench.findings.theory.closed_form import linear_settling
from bench.findings.theory.isotropic import EQUATIONS, settling
from bench.law.contenders.registry import contenders
from bench.studies.libraries import __main__ as study
from bench.studies.libraries import closed_loop, turns
from bench.studies.libraries.asked import ours
from bench.studies.libraries.closed_loop import accelerated, after, angle, conjugate, driven, matrix
from bench.studies.libraries.judge import judge
from bench.studies.libraries.library import MATRIX, QUATERNION, Function
from bench.studies.libraries.verdict import REPLACEMENTS, left_to_go, verdict
from report.figures.libraries import libraries
from tasks.rules import RULES

TICK_S = closed_loop.DT_S


def sine(R):
    return 0.5 * np.array((R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]))


def response(call, angle_deg, takes=MATRIX, sheet=1.0):
    """Return the response from the first start at an angle."""
    begun = tuple(sheet * part for part in next(closed_loop.starts(angle_deg)))
    return closed_loop.response(accelerated(Function("f", takes, call), 100.0, 20.0, TICK_S, begun), TICK_S)


@pytest.mark.parametrize("angle_deg", [1.0, 90.0, 179.9, 180.0])
def test_logarithm_settles_in_the_time_of_the_linear_system_from_any_angle(angle_deg):
    """A command that is held costs up to 0.3 ms (shared facts), a tick rounds up to the next."""
    found = response(logarithm, angle_deg)
    assert found.outcome == "settled"
    assert found.settling_s == pytest.approx(linear_settling(100.0, 20.0), abs=2 * TICK_S)


@pytest.mark.parametrize("angle_deg", [30.0, 90.0, 179.0])
def test_sine_settles_in_the_time_of_its_closed_form(angle_deg):
    expected = settling(EQUATIONS["rotation-matrix"], math.radians(angle_deg), 100.0, 20.0, RULES.tolerance)
    assert response(sine, angle_deg).settling_s == pytest.approx(expected, abs=2 * TICK_S)


def test_sine_never_leaves_an_exact_180_degree_rotation():
    rows = closed_loop.rows_of(Function("f", MATRIX, sine))
    assert (rows[-1]["angle_deg"], rows[-1]["dead"]) == (180.0, closed_loop.HALF_TURN_AXES)
    assert sum(row["dead"] for row in rows) == rows[-1]["dead"]


def test_bare_quaternion_unwinds_from_the_antipode_alone():
    for sheet in (1.0, -1.0):
        found = response(lambda quat_wxyz: 2.0 * quat_wxyz[1:], 90.0, QUATERNION, sheet)
        assert found.goes_away == (sheet < 0.0)


def test_function_without_numbers_fails():
    assert response(lambda R: (math.nan,) * 3, 30.0).outcome == "failed"


def test_velocity_loop_settles_in_the_time_of_a_first_order_system():
    """theta shrinks by 1 - K dt a tick: to 2 % after ln(0.02)/ln(1 - K dt) ticks."""
    begun = next(closed_loop.starts(90.0))
    found = closed_loop.response(driven(lambda T: 10.0 * logarithm(T), 0.01, begun), 0.01)
    assert found.settling_s == pytest.approx(0.01 * math.log(0.02) / math.log(0.9), abs=0.01)


def test_step_is_that_of_rodrigues_formula():
    q, turn = ScipyRotation.from_rotvec((0.3, -1.0, 0.7)), np.array((0.02, 0.5, -0.1))
    stepped = after(tuple(q.as_quat(scalar_first=True)), tuple(turn))
    expected = q.as_matrix() @ ScipyRotation.from_rotvec(-turn).as_matrix()
    np.testing.assert_allclose(matrix(stepped), expected, rtol=0.0, atol=1e-15)
    assert angle(conjugate(stepped)) == pytest.approx(np.linalg.norm(ScipyRotation.from_matrix(expected).as_rotvec()))


@pytest.mark.parametrize(
    ("name", "ratio", "faults"),
    [
        ("franka_ros", 0.5, {"stiffness"}),
        ("deoxys_control", 0.0, {"deadband", "stiffness"}),
        ("Isaac Gym idiom", 0.5, {"dead-at-180", "stiffness"}),
        ("crisp_controllers", 1.0, {"axis-clip"}),
        ("cartesian_controllers", 1.0, {"norm-clip"}),
    ],
)
def test_shipped_controller_has_the_stiffness_and_the_faults_of_its_source(name, ratio, faults):
    (library,) = (one for one in ours.shipped() if one.name == name)
    (function,) = library.functions
    assert closed_loop.stiffness_ratio(function) == pytest.approx(ratio, abs=1e-6)
    assert set(verdict(function)["faults"].split(", ")) == faults


def test_relative_quaternion_is_that_of_the_matrices():
    q, q_d = (ScipyRotation.from_rotvec(one) for one in ((0.3, -1.0, 0.7), (2.0, 0.1, 0.4)))
    left = left_to_go(q.as_quat(scalar_first=True), q_d.as_quat(scalar_first=True))
    np.testing.assert_allclose(matrix(left), (q_d * q.inv()).as_matrix(), rtol=0.0, atol=1e-15)


def test_right_function_needs_no_replacement():
    found = verdict(Function("f", MATRIX, logarithm))
    assert (found["faults"], found["replacement"]) == ("", "")
    assert found["convention"] == "θ, base, to-goal, slope 1"


def test_every_restated_controller_was_read_at_the_commit_that_its_source_names():
    named = {name: contenders("shipped")[word].source.partition("@")[2][:8] for name, word in ours.RESTATED.items()}
    for table in (libraries.table("closed_loop"), libraries.table("verdicts")):
        restated = table[table["library"].isin(named)]
        assert restated.groupby("library")["version"].unique().map(list).to_dict() == {k: [v] for k, v in named.items()}


def test_default_weld_is_stiffer_than_a_sine_and_stuck_at_180_degrees_alone():
    rows = libraries.table("closed_loop").query("function == '<weld>, by default'").set_index("angle_deg").sort_index()
    assert rows["dead"].to_dict() == dict.fromkeys(closed_loop.ANGLES_DEG, 0) | {180.0: closed_loop.HALF_TURN_AXES}
    between = rows.loc[[30.0, 90.0, 150.0, 175.0, 179.0], "pull_ratio"]
    assert (between > np.sin(np.radians(between.index))).all()


@pytest.mark.parametrize("takes", [MATRIX, QUATERNION])
def test_replacement_is_right_on_every_turn(takes):
    function = Function("f", takes, REPLACEMENTS[takes])
    assert verdict(function)["faults"] == ""
    for one in (turns.small(12), turns.drawn(), turns.near_half_turn(15), turns.half_turns()):
        row = judge(function, one)
        assert row["form_error_rad"] <= 1e-14  # some units in the last place of pi
        assert row["other_sheet"] == 0


def table(version, faults, **others):
    row = {"library": "a", "function": "f", "takes": MATRIX, "version": version, "faults": faults}
    return pd.DataFrame([row | {"fixed": "", "fixed_since": ""} | others])


@pytest.mark.parametrize(
    ("now", "earlier", "fixed", "since"),
    [
        (table("1.1", "deadband"), table("1.0", "deadband, dead-at-180"), "dead-at-180", "1.0"),
        # the same version asked again, and a function that is new
        (table("1.1", ""), table("1.1", "", fixed="deadband", fixed_since="1.0"), "deadband", "1.0"),
        (table("1.0", "deadband"), table("1.0", "").assign(function="g"), "", ""),
    ],
)
def test_fault_that_a_new_version_has_no_longer_is_marked_fixed_and_stays_so(now, earlier, fixed, since):
    (row,) = study.marked(now, earlier).to_dict("records")
    assert (row["fixed"], row["fixed_since"]) == (fixed, since)
