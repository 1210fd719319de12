"""Jacobians over poses, against MuJoCo, numpy and scipy: none of them ours."""

import itertools
import math

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.buffers import state_of

import tasks
from bench.experiments import jacobians as poses
from bench.experiments import plan
from bench.experiments.jacobians import pose_sets
from bench.experiments.request import Request
from bench.experiments.tables import schema
from bench.law.contenders.registry import contenders, find_contender
from bench.regression import rows as compare
from tasks.arm_model import model_xml
from tasks.kinematics import Kinematics
from tasks.paths import cos_beta, zyx_angles

ARMS = ("puma560", "ur5e")
COUNT, SEED = 30, 7


@pytest.fixture(scope="module")
def frames():
    """The rows of two arms with few poses."""
    return {name: poses.rows(Request(seed=SEED), poses.of_arm(name, COUNT)) for name in ARMS}


def of_zyx(frame, *sets):
    rows = frame[frame["representation"] == "zyx-euler"]
    return rows[rows["pose_set"].isin(sets)] if sets else rows


def x_of(model, q):
    """Position and Z-Y-X angles of the tool: MuJoCo's frame, scipy's angles."""
    tool = state_of(model, q).site("tool")
    return np.concatenate(
        (tool.xpos, ScipyRotation.from_matrix(tool.xmat.reshape(3, 3)).as_euler("ZYX"))
    )


@pytest.mark.parametrize("name", ARMS)
def test_euler_jacobian_is_the_derivative_of_scipys_angles(frames, name):
    arm = tasks.arm(name)
    model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    rows = of_zyx(frames[name], "random")
    looked = 0
    for row in rows[rows["margin"] > 0.1].itertuples():
        q = np.array([getattr(row, f"q_{i + 1}") for i in range(arm.joints)])
        ends = [[x_of(model, q + sign * 1e-6 * e) for sign in (1, -1)] for e in np.eye(arm.joints)]
        J_E = np.array([(plus - minus) / 2e-6 for plus, minus in ends]).T
        if abs(J_E).max() > 1e3:  # an angle jumped between the two ends
            continue
        # step^2/margin^2 = 1e-10 and eps/step = 2e-10, both relative to elements of up to 1/margin, times the
        # condition numbers they end up in
        assert row.condition_analytic == pytest.approx(np.linalg.cond(J_E), rel=1e-8 * row.condition_analytic)
        assert row.largest == pytest.approx(abs(J_E[3:]).max(), rel=1e-7)
        looked += 1
    assert looked > COUNT // 2


@pytest.mark.parametrize("name", ARMS)
def test_condition_and_determinant_are_numpys_of_mujocos_jacobian(frames, name):
    kin = Kinematics(tasks.arm(name))
    for row in of_zyx(frames[name], "random", "named").itertuples():
        J = kin.jacobian([getattr(row, f"q_{i + 1}") for i in range(6)])
        assert row.condition == pytest.approx(np.linalg.cond(J), rel=1e-9)
        assert row.det == pytest.approx(np.linalg.det(J), abs=1e-15)


@pytest.mark.parametrize("name", ARMS)
def test_our_jacobian_is_mujocos(frames, name):
    # a cross product of sums of rounded lengths of about a metre, six of them along the chain
    assert frames[name]["kernel_gap"].max() <= 16 * EPS


def test_puma_stands_on_the_pole_at_its_stock_pose(frames):
    rows = of_zyx(frames["puma560"], "named").set_index("pose_id")
    assert rows.at["qn", "margin"] < 1e-15
    assert rows.at["qn", "condition"] == pytest.approx(7.88, abs=0.01)
    assert rows.at["qn", "condition_analytic"] > 1e15


@pytest.mark.parametrize("name", ARMS)
def test_determinants_are_those_of_the_converted_jacobian(frames, name):
    rows = of_zyx(frames[name], "random")
    rows = rows[rows["margin"] > 0.01]
    wanted = -rows["det"] / rows["margin"]
    np.testing.assert_allclose(rows["det_analytic"], wanted, atol=1e-12, rtol=1e-12)
    assert rows["det_gap"].max() <= 100 * EPS / 0.01


@pytest.mark.parametrize("name", ARMS)
def test_pole_poses_come_to_their_distances_with_the_arm_well_conditioned(frames, name):
    rows = of_zyx(frames[name], "pole")
    assert len(rows) == 2 * pose_sets.FAMILIES * (pose_sets.DECADES + 1)
    assert rows["condition"].max() <= pose_sets.WELL_CONDITIONED
    for row in rows.itertuples():
        distance = row.pose_id.split("-", 2)[2]
        wanted = 0.0 if distance == "exact" else math.sin(float(distance))
        # Newton's last step leaves the rounding of six joints and of the forward kinematics
        assert row.margin == pytest.approx(wanted, abs=16 * EPS)
        assert (row.beta > 0) == ("plus" in row.pose_id)


def test_pole_poses_of_a_family_hold_position_and_angles(frames):
    kin = Kinematics(tasks.arm("ur5e"))
    rows = of_zyx(frames["ur5e"], "pole")
    family = rows[rows["pose_id"].str.startswith("0-plus-1e-0")].head(6)
    seen = [kin.pose(q) for q in family[[f"q_{i + 1}" for i in range(6)]].to_numpy()]
    positions, angles = np.array([p for p, _ in seen]), np.array([zyx_angles(quat) for _, quat in seen])
    assert np.ptp(positions, axis=0).max() <= 32 * EPS
    # at 1e-6 from the pole alpha and gamma are known to eps/1e-6
    assert np.ptp(angles[:, [0, 2]], axis=0).max() <= 32 * EPS / 1e-6


@pytest.mark.parametrize("name", ARMS)
def test_slice_shows_both_kinds_of_singularity(name):
    kin = Kinematics(tasks.arm(name))
    seen = [(kin.condition(q), cos_beta(kin.pose(q)[1])) for _, q in pose_sets.grid(kin.arm, *pose_sets.pair(kin), 61)]
    conditions, margins = (np.array(numbers) for numbers in zip(*seen, strict=True))
    assert conditions.max() > 10 * np.median(conditions)
    assert margins[conditions <= pose_sets.WELL_CONDITIONED].min() < 0.1


def test_slice_varies_two_joints_over_their_ranges_and_leaves_the_others_at_home():
    arm = tasks.arm("puma560")
    places, qs = zip(*pose_sets.grid(arm, 1, 4, 5), strict=True)
    qs = np.array(qs)
    assert list(places) == list(itertools.product(range(5), repeat=2))
    assert np.ptp(qs[:, [0, 2, 3, 5]], axis=0).max() == 0.0
    for joint in (1, 4):
        span = arm.upper[joint] - arm.lower[joint]
        assert np.ptp(qs[:, joint]) == pytest.approx(min(span, math.tau) * 4 / 5)


def test_random_poses_are_in_range_and_the_first_of_more(frames):
    arm = tasks.arm("puma560")
    rows = of_zyx(frames["puma560"], "random")
    q = rows[[f"q_{i + 1}" for i in range(6)]].to_numpy()
    assert len(q) == COUNT
    assert ((q >= arm.lower) & (q <= arm.upper)).all()
    more = of_zyx(poses.rows(Request(seed=SEED), poses.of_arm("puma560", 2 * COUNT)), "random")
    assert np.array_equal(more[[f"q_{i + 1}" for i in range(6)]].to_numpy()[:COUNT], q)


def test_every_pose_has_a_row_in_every_representation(frames):
    for frame in frames.values():
        counts = frame.groupby(["pose_set", "pose_id"]).size()
        assert set(counts) == {len(contenders("representations"))}
        assert frame["q_7"].isna().all()
        assert set(schema.table_of("poses").names) == set(frame.columns)


def test_conditions_are_numpys_and_infinite_where_nothing_is_finite():
    square, tall = np.random.default_rng(3).normal(size=(2, 4, 7, 6))
    square = square[:, :6]
    tall[:, 6] = tall[:, 5]  # rank 6
    tall[3, 0, 0] = math.nan
    np.testing.assert_allclose(poses.conditions(square), np.linalg.cond(square), rtol=1e-12)
    np.testing.assert_allclose(poses.conditions(tall)[:3], np.linalg.cond(tall[:3]), rtol=1e-12)
    assert poses.conditions(tall)[3] == math.inf
    assert poses.conditions(np.zeros((1, 6, 6)))[0] == math.inf


def jacobians_of(**words):
    law = [find_contender("rotation-matrix")]
    return plan.make(Request("quick", tuple(law), **words)).of("jacobians")


def test_run_has_the_arms_of_its_plan():
    assert jacobians_of(tasks=("free-body",)) == ()
    assert [unit.arm for unit in jacobians_of(arms=("ur5e",))] == ["ur5e"]
    assert jacobians_of(arms=("ur5e",), start_sets=("clear",)) == ()  # narrowed, a run looks at no poses


def test_way_to_the_pole_is_refused_from_a_singular_posture():
    kin = Kinematics(tasks.arm("puma560"))
    stretched = np.array(tasks.arm("puma560").home)
    stretched[4] = 0.0  # the wrist's first and last axis in line
    assert kin.condition(stretched) > pose_sets.WELL_CONDITIONED
    assert pose_sets.towards_pole(kin, stretched, 1.0) is None


@pytest.mark.parametrize(
    ("pose_set", "column", "lines"),
    [
        ("random", "condition", 1),
        ("random", "det_analytic", 1),
        ("random", "q_3", 1),
        ("random", "derivation_gap", 0),
        ("named", "condition_analytic", 1),
    ],
)
def test_gate_catches_a_pose_that_changed_but_for_rounding(frames, pose_set, column, lines):
    old = frames["ur5e"]
    row = old.index[(old["pose_set"] == pose_set) & (old["representation"] == "zyx-euler")][0]
    new = old.copy()
    new.loc[row, column] = 1.001 * new.loc[row, column] + 1e-3
    assert compare.compare_tables(schema.table_of("poses"), old, old) == []
    assert len(compare.compare_tables(schema.table_of("poses"), old, new)) == lines
