"""The answer to an arm user: inertias felt, and limits against those of a simulated arm.

The simulation (`support.sprung_arm`) computes torques from MuJoCo's state and looks whether the
tool's rate grows; it shares nothing with the theory.
"""

import math

import numpy as np
import pytest
from support.gimbal import INERTIA, MJCF, URDF
from support.sprung_arm import STEPS, Spring, SprungArm

import tasks
from bench.base.errors import BadModel, Incompatible
from bench.findings.selection.arm_question import (
    ArmQuestion,
    find_bodies,
    find_dampings,
    find_range,
    propose_damping,
)
from bench.findings.selection.felt_inertia import ENDS, Mechanics, feel
from bench.findings.selection.tool_chain import load_arm, load_mjcf, load_urdf
from bench.findings.theory.sampled_loop import is_stable
from tasks.kinematics import kinematics

WITHIN = 0.1
"""How far a predicted limit may be from the simulated one."""

TIMINGS = {"1 kHz": (1e-3, 0), "500 Hz, 3 ms": (2e-3, 6)}
"""Control period [s], and delay in steps of the simulation."""

ARMS = tasks.arm_names()


@pytest.fixture(scope="module")
def felt():
    """The inertias of each arm."""
    return {name: feel(load_arm(name)) for name in ARMS}


def write(folder, name, text):
    """Return the path of a file of this text."""
    path = folder / name
    path.write_text(text, encoding="utf-8")
    return path


@pytest.mark.parametrize("timing", TIMINGS)
@pytest.mark.parametrize("name", ARMS)
def test_limits_of_damping_and_stiffness_are_those_of_the_simulated_arm(felt, name, timing):
    period, late = TIMINGS[timing]
    arm = SprungArm(load_arm(name), period, late)
    question = ArmQuestion(50.0, period=period, delay=late * period / STEPS)
    lightest = int(np.argmin(felt[name].moments[:, 0]))
    for place in (lightest, 3):
        pose, inertia = felt[name].poses[place], felt[name].moments[place, 0]
        damping = 0.3 * find_dampings(question, inertia)[1]
        limits = find_range(question, inertia, damping)
        for share, stable in ((1.0 - WITHIN, True), (1.0 + WITHIN, False)):
            assert arm.is_stable(pose, Spring(50.0, share * limits.high)) is stable
            assert arm.is_stable(pose, Spring(share * limits.stiffness, damping)) is stable


@pytest.mark.parametrize("name", ARMS)
def test_least_damping_is_that_of_the_simulated_arm(felt, name):
    period, late = TIMINGS["500 Hz, 3 ms"]
    arm = SprungArm(load_arm(name), period, late)
    question = ArmQuestion(100.0, period=period, delay=late * period / STEPS)
    pose, inertia = felt[name].lightest, felt[name].least
    low, _ = find_dampings(question, inertia)
    assert not arm.is_stable(pose, Spring(100.0, (1.0 - WITHIN) * low), ticks=2000)
    assert arm.is_stable(pose, Spring(100.0, (1.0 + WITHIN) * low), ticks=2000)


@pytest.mark.parametrize("name", ARMS)
def test_greatest_damping_is_the_same_where_a_spring_holds_the_position(felt, name):
    period, late = TIMINGS["1 kHz"]
    arm = SprungArm(load_arm(name), period, late)
    _, high = find_dampings(ArmQuestion(50.0, period=period), felt[name].least)
    # 500 N/m, critically damped for a hand of 4 kg.
    held = Spring(50.0, high, 500.0, 2.0 * math.sqrt(500.0 * 4.0))
    assert arm.is_stable(felt[name].lightest, held._replace(damping=(1.0 - WITHIN) * high))
    assert not arm.is_stable(felt[name].lightest, held._replace(damping=(1.0 + WITHIN) * high))


def test_what_is_stable_at_the_least_inertia_is_stable_at_every_other(felt):
    question = ArmQuestion(50.0, period=2e-3, delay=3e-3)
    for name in ARMS:
        limits = find_range(question, felt[name].least, 5.0)
        for inertia in np.geomspace(felt[name].least, felt[name].most, 12):
            for damping in (1.01 * limits.low, 5.0, 0.99 * limits.high):
                assert is_stable(question.loop_about(inertia, damping))
            stiff = question._replace(stiffness=0.99 * limits.designed)
            assert is_stable(stiff.loop_about(inertia, stiff.design(inertia)))


def test_limits_without_delay_are_those_of_jurys_criterion():
    # The step of a period has det < 1 where D > K T/2, and no eigenvalue below -1 where D < 2 J/T.
    limits = find_range(ArmQuestion(50.0), INERTIA, 10.0)
    assert limits.low == pytest.approx(50.0 * 1e-3 / 2.0, rel=1e-6)
    assert limits.high == pytest.approx(2.0 * INERTIA / 1e-3, rel=1e-6)
    assert limits.stiffness == pytest.approx(2.0 * 10.0 / 1e-3, rel=1e-6)
    assert limits.designed == pytest.approx(INERTIA / 1e-3**2, rel=1e-6)


def test_stiffness_without_any_stable_damping_has_no_limits_of_damping():
    limits = find_range(ArmQuestion(5e4, delay=5e-3), INERTIA, math.nan)
    assert math.isnan(limits.low)
    assert math.isnan(limits.high)
    assert math.isnan(limits.stiffness)
    assert 0.0 < limits.designed < 5e4


@pytest.mark.parametrize(
    ("name", "text", "load"),
    [
        ("gimbal.xml", MJCF, lambda path: load_mjcf(path, site="grip")),
        ("gimbal.xml", MJCF, lambda path: load_mjcf(path, body="ball")),
        ("gimbal.urdf", URDF, load_urdf),
        ("gimbal.urdf", URDF, lambda path: load_urdf(path, body="ball")),
    ],
)
def test_ball_on_a_gimbal_is_felt_as_its_own_inertia_in_every_pose(tmp_path, name, text, load):
    chain = load(write(tmp_path, name, text))
    assert len(chain.joints) == 3
    felt = feel(chain, 300)
    assert felt.moments == pytest.approx(np.full(felt.moments.shape, INERTIA), rel=1e-4)
    assert felt.unevenness == pytest.approx(0.0, abs=1e-4)
    assert felt.held_ends is None


def test_pose_in_which_the_gimbal_locks_is_left_out(tmp_path):
    whole = MJCF.replace('range="-1 1"', 'range="-1.57 1.57"')
    felt = feel(load_mjcf(write(tmp_path, "gimbal.xml", whole), site="grip"), 400)
    pitch = np.abs(felt.poses[:, 1])
    assert 300 < len(felt.poses) < 400
    # The least singular value is sqrt(1 - sin(pitch)), 1/5 at 1.29 rad.
    assert pitch.max() == pytest.approx(math.asin(1.0 - 1.0 / 25.0), abs=0.05)
    assert pitch.max() < math.asin(1.0 - 1.0 / 25.0)


@pytest.mark.parametrize("name", ARMS)
def test_mobility_is_that_of_the_judge(name):
    arm, chain = tasks.arm(name), load_arm(name, "ideal-motors")
    J, M = Mechanics(chain).look(np.array(arm.home))
    assert J @ np.linalg.solve(M, J.T) == pytest.approx(
        kinematics(arm).mobility(arm.home), rel=1e-9
    )


@pytest.mark.parametrize("name", ARMS)
def test_inertias_hardly_depend_on_the_draw(felt, name):
    many = feel(load_arm(name), 10_000, 7)
    assert felt[name].least == pytest.approx(many.least, rel=0.04)
    assert felt[name].ends == pytest.approx(many.ends, rel=0.15)
    below = np.mean(felt[name].moments < felt[name].ends[0])
    assert 100.0 * below == pytest.approx(ENDS[0], abs=0.1)


def test_ends_of_kp_are_bodies_between_the_ends_of_inertia(felt):
    question = ArmQuestion(50.0, 10.0, 12.0, delay=2e-3, spin=1.0)
    low, high = felt["panda"].ends
    light, heavy = find_bodies(question, felt["panda"])
    # s is at most the map's 0.5: moments from half to one and a half times the mean.
    assert 0.5 * light.inertia == pytest.approx(low)
    assert 1.5 * heavy.inertia == pytest.approx(high)
    for body in (light, heavy):
        assert body.at.unevenness == 0.5
        assert body.kp == pytest.approx(50.0 / body.inertia)
        assert body.kv == pytest.approx(10.0 / body.inertia)
        assert body.at.bound == pytest.approx(12.0 / 50.0)
        assert body.at.zeta == pytest.approx(body.kv / (2.0 * math.sqrt(body.kp)), rel=5e-3)
        assert body.at.delay == pytest.approx(2e-3 * math.sqrt(body.kp), rel=5e-3)
        assert body.at.spin == pytest.approx(1.0 / math.sqrt(body.kp), rel=5e-3)


def test_bodies_without_a_damping_have_the_ratio_one(felt):
    for body in find_bodies(ArmQuestion(50.0), felt["ur5e"]):
        assert body.at.zeta == 1.0
        assert math.isinf(body.at.bound)


def test_proposed_damping_is_critical_for_heavy_axes_unless_light_ones_cannot_bear_it(felt):
    quick, late = ArmQuestion(50.0), ArmQuestion(50.0, delay=5e-3)
    heavy = felt["ur5e"].ends[1]
    assert quick.ratio(heavy, propose_damping(quick, felt["ur5e"])) == pytest.approx(1.0)
    held_back = propose_damping(late, felt["ur5e"])
    assert late.ratio(heavy, held_back) < 0.9
    assert held_back == pytest.approx(0.5 * find_dampings(late, felt["ur5e"].least)[1])
    for stiffness in (300.0, 600.0, 650.0):
        question = late._replace(stiffness=stiffness)
        low, high = find_dampings(question, felt["ur5e"].least)
        assert low < propose_damping(question, felt["ur5e"]) < high


BALL_JOINT = MJCF.replace('<joint name="roll" axis="1 0 0"/>', '<joint name="roll" type="ball"/>')
ENDLESS = MJCF.replace(' range="0 .05"', "")


@pytest.mark.parametrize(
    ("text", "effector", "refusal", "words"),
    [
        (
            MJCF,
            {},
            BadModel,
            "which site is the end effector? its sites: grip; its bodies: base, ring, ball, finger",
        ),
        (MJCF, {"site": "grop"}, BadModel, "no site 'grop'; its sites: grip"),
        (MJCF, {"body": "bell"}, BadModel, "no body 'bell'; its bodies: base, ring, ball, finger"),
        (MJCF, {"body": "ring"}, Incompatible, "2 hinges move body ring, and it takes at least 3"),
        (
            "<mujoco><worldbody><site name='a'/></worldbody></mujoco>",
            {"site": "a"},
            Incompatible,
            "0 hinges move",
        ),
        (
            "<mujoco/>",
            {},
            BadModel,
            "its sites: none; its bodies: none (it has no sites; try: --body NAME)",
        ),
        ("not XML", {"site": "a"}, BadModel, "MuJoCo cannot load"),
        (BALL_JOINT, {"site": "grip"}, Incompatible, "joint 'roll' is a ball or free joint"),
        (ENDLESS, {"body": "finger"}, Incompatible, "slide 'squeeze' has no range"),
    ],
)
def test_mjcf_that_is_no_arm_is_refused_with_the_cure(tmp_path, text, effector, refusal, words):
    with pytest.raises(refusal) as error:
        load_mjcf(write(tmp_path, "arm.xml", text), **effector)
    assert words in str(error.value)


def test_urdf_that_is_none_is_refused_with_the_cure(tmp_path):
    for text, words in ((MJCF, "is no URDF (MJCF: use --mjcf)"), ("<robot", "is not XML")):
        with pytest.raises(BadModel) as error:
            load_urdf(write(tmp_path, "arm.urdf", text))
        assert words in str(error.value)
    with pytest.raises(BadModel, match="is no file"):
        load_urdf(tmp_path / "nowhere.urdf")


def test_arm_whose_axes_lie_in_a_plane_is_refused(tmp_path):
    flat = MJCF.replace('axis="1 0 0"', 'axis="0 1 0"')
    chain = load_mjcf(write(tmp_path, "flat.xml", flat), site="grip")
    with pytest.raises(Incompatible, match="turns freely about every axis in 0 of 100"):
        feel(chain, 100)
