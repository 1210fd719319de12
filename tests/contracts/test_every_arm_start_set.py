"""What defines each start set of arms, on every arm, looked at with scipy's rotations.

Joint paths are walked again here, in steps of two degrees where the search took five.
"""

import itertools
import math
import subprocess
import sys

import numpy as np
import pytest
from scipy.optimize import least_squares
from scipy.spatial.transform import Rotation, Slerp

import tasks
from tasks.base import AT_REST, haversine
from tasks.clearance import CONDITION, COS_BETA, RANGE, WRAP
from tasks.kinematics import kinematics

ARMS = tasks.arm_names()
SETS = tasks.start_set_names(arm=True)
every_set_on_every_arm = pytest.mark.parametrize(("arm", "name"), list(itertools.product(ARMS, SETS)))
on_every_arm = pytest.mark.parametrize("arm", ARMS)

# A bound was looked at every five degrees; between these points a condition number can be a little larger.
BETWEEN = 1.05


def rotation(quat):
    return Rotation.from_quat(quat, scalar_first=True)


def quats(rotations):
    return [tuple(quat) for quat in rotations.as_quat(scalar_first=True).tolist()]


def geodesic(start, points):
    """Rotations along the shortest way from start to goal, at these shares of it."""
    return Slerp([0.0, 1.0], Rotation.concatenate([rotation(start.quat_wxyz), rotation(start.goal_wxyz)]))(points)


def straight(start, points):
    """Rotations whose Z-Y-X angles go straight from those of the start to those of the goal."""
    first, last = (rotation(quat).as_euler("ZYX") for quat in (start.quat_wxyz, start.goal_wxyz))
    return Rotation.from_euler("ZYX", first + np.outer(points, last - first))


def evenly(start):
    return np.linspace(0.0, 1.0, 2 + int(math.degrees(angle_of(start)) / 2.0))


def angle_of(start):
    return (rotation(start.goal_wxyz).inv() * rotation(start.quat_wxyz)).magnitude()


def cos_beta(rotations):
    return np.hypot(*rotations.as_matrix()[..., :2, 0].T)


def walked(arm, start, rotations):
    """The joint path, which must be there to the end."""
    path = kinematics(tasks.arm(arm)).follow(start.q, quats(rotations))
    assert path is not None, start.id
    return path


def conditions(arm, path):
    model = kinematics(tasks.arm(arm))
    return np.array([np.linalg.cond(model.jacobian(q)) for q in path])


def in_range(arm, path, margin=0.0):
    one = tasks.arm(arm)
    return bool(((np.array(one.lower) + margin <= path) & (path <= np.array(one.upper) - margin)).all())


# ------------------------------------------------------------------------------------------ every set


FRESH = """
import tasks
for arm in reversed(tasks.arm_names()):
    for name in reversed(tasks.start_set_names(arm=True)):
        print(tasks.start_set(name, 3, arm=arm))
"""


def test_fresh_process_gives_the_same_starts():
    """Made in the opposite order, so that nothing hangs on what was made before."""
    done = subprocess.run([sys.executable, "-c", FRESH], capture_output=True, text=True, check=True)
    expected = [str(tasks.start_set(name, 3, arm=arm)) for arm in reversed(ARMS) for name in reversed(SETS)]
    assert done.stdout.splitlines() == expected


@every_set_on_every_arm
def test_start_is_what_the_plant_shows_after_reset_bit_for_bit(arm, name):
    for start in tasks.start_set(name, arm=arm)[::4][:8]:
        environment = tasks.load("arm-regulation", start, arm=arm)
        observation = environment.reset().observation
        assert environment.physics.quat_wxyz() == start.quat_wxyz
        assert tuple(observation["omega"]) == start.omega
        assert tuple(observation["q"]) == start.q
        assert tuple(observation["qdot"]) == start.qdot


@every_set_on_every_arm
def test_joints_begin_inside_their_ranges_and_all_but_tumbling_at_rest(arm, name):
    starts = tasks.start_set(name, arm=arm)
    assert in_range(arm, np.array([start.q for start in starts]), 0.0 if name == "uniform" else RANGE)
    for start in starts:
        assert (start.omega == AT_REST and not any(start.qdot)) == (name != "tumbling")


# ------------------------------------------------------------------------------------- clear, tumbling


@on_every_arm
@pytest.mark.parametrize("name", ["clear", "tumbling"])
@pytest.mark.parametrize("way", [geodesic, straight])
def test_both_paths_of_a_clear_start_are_clear(arm, name, way):
    for start in tasks.start_set(name, arm=arm):
        rotations = way(start, evenly(start))
        assert cos_beta(rotations).min() >= COS_BETA * 0.99, start.id
        alpha, _, gamma = rotations.as_euler("ZYX").T
        assert max(abs(alpha).max(), abs(gamma).max()) <= math.pi - WRAP + 0.02, start.id
        path = walked(arm, start, rotations)
        assert conditions(arm, path).max() <= CONDITION * BETWEEN, start.id
        assert in_range(arm, path, RANGE - 0.02), start.id


@on_every_arm
def test_clear_angles_are_spread_from_10_to_150_degrees(arm):
    """32 strata; an arm that can do them all has one start in each."""
    degrees = sorted(math.degrees(angle_of(start)) for start in tasks.start_set("clear", arm=arm))
    assert degrees[0] < 15.0
    assert degrees[-1] > 145.0
    assert max(np.diff(degrees)) < 10.0


@on_every_arm
def test_tumbling_tool_turns_in_place_at_up_to_5_rad_per_second(arm):
    """Velocities by centred differences of the pose along qdot, 2e-6 s apart."""
    model, speeds = kinematics(tasks.arm(arm)), []
    for start in tasks.start_set("tumbling", arm=arm):
        q, step = np.array(start.q), 1e-6 * np.array(start.qdot)
        (after, _), (before, _) = model.pose(q + step), model.pose(q - step)
        assert np.linalg.norm(after - before) / 2e-6 < 1e-8
        speeds.append(math.hypot(*start.omega))
    assert max(speeds) == pytest.approx(5.0, abs=1e-12)
    np.testing.assert_allclose(sorted(speeds), 5.0 * (np.arange(24) + 0.5) / 24.0, atol=0.25)


# ----------------------------------------------------------------------------------------------- wrist


def middle(start):
    return geodesic(start, [0.5])


def towards_the_middle(start, least):
    """Shares of the way to the middle, closing in on it geometrically down to `least` rad."""
    half = 0.5 * angle_of(start)
    closing = np.geomspace(half, least, 60)
    return 0.5 * (1.0 - closing / half)


@on_every_arm
def test_tool_keeps_off_the_pole_on_its_way_through_a_singularity(arm):
    for start in tasks.start_set("wrist", arm=arm):
        assert cos_beta(geodesic(start, np.linspace(0.0, 1.0, 41))).min() >= COS_BETA * 0.99


@on_every_arm
def test_wrist_starts_and_goals_are_80_degrees_apart_and_well_conditioned(arm):
    for start in tasks.start_set("wrist", arm=arm):
        assert math.degrees(angle_of(start)) == pytest.approx(80.0, abs=1e-9)
        assert conditions(arm, [start.q]) <= CONDITION


@on_every_arm
def test_condition_number_goes_beyond_all_bounds_on_the_way_through_a_singularity(arm):
    """At s rad before the middle sigma_min is proportional to s: the condition number times s stays put.

    With seven joints the path of least rates veers from the singular configuration by what rounding and steps make.
    """
    exact = [start for start in tasks.start_set("wrist", arm=arm) if start.id.endswith("exact")]
    assert len(exact) == 4
    for start in exact:
        shares = towards_the_middle(start, 1e-6)
        worst = conditions(arm, walked(arm, start, geodesic(start, shares)))
        if tasks.arm(arm).joints == 6:
            assert worst[-1] > 1e6
            assert worst[-1] / worst[-10] == pytest.approx((0.5 - shares[-10]) / (0.5 - shares[-1]), rel=0.1)
        else:
            assert worst.max() > 1e3


@on_every_arm
def test_condition_number_is_as_said_beside_a_singularity(arm):
    for start in tasks.start_set("wrist", arm=arm):
        if not start.id.endswith("exact"):
            distance = 10.0 ** -int(start.id[-1])
            path = walked(arm, start, geodesic(start, towards_the_middle(start, 1e-3 * distance)))
            s = np.linalg.svd(kinematics(tasks.arm(arm)).jacobian(path[-1]), compute_uv=False)
            if tasks.arm(arm).joints == 6:
                assert s[5] == pytest.approx(distance, rel=0.05), start.id
            else:
                assert conditions(arm, path).max() > 100.0, start.id


# ------------------------------------------------------------------------------------------------ pole


@on_every_arm
def test_middle_is_on_the_pole_or_misses_it_by_what_the_id_says(arm):
    for start in tasks.start_set("pole", arm=arm):
        tilt = cos_beta(middle(start))[0]
        sign = -np.sign(middle(start).as_matrix()[0, 2, 0])
        assert start.id.startswith("pole-plus" if sign > 0 else "pole-minus")
        if start.id.endswith("exact"):
            assert tilt < 8e-15  # scipy's middle rounds a few times more
            assert 1.0 - abs(middle(start).as_matrix()[0, 2, 0]) < 1e-15
        else:
            miss = 10.0 ** -int(start.id[-1])
            assert tilt == pytest.approx(math.sin(miss), abs=1e-14)
            around = geodesic(start, np.linspace(0.4, 0.6, 201))
            assert cos_beta(around).min() == pytest.approx(tilt, abs=1e-14)


@on_every_arm
@pytest.mark.parametrize(("name", "ending"), [("pole", ""), ("half-turn", "k1")])
def test_arm_is_well_conditioned_across_the_pole_and_through_a_half_turn(arm, name, ending):
    """Of half turns those 0.1 rad short, where all pass: nearer ones are determined, that of an exact one is either."""
    for start in tasks.start_set(name, arm=arm):
        if start.id.endswith(ending):
            path = walked(arm, start, geodesic(start, evenly(start)))
            assert conditions(arm, path).max() <= CONDITION * BETWEEN
            assert in_range(arm, path, RANGE - 0.02)


@on_every_arm
def test_start_and_goal_are_far_from_the_pole(arm):
    for start in tasks.start_set("pole", arm=arm):
        ends = Rotation.concatenate([rotation(start.quat_wxyz), rotation(start.goal_wxyz)])
        assert cos_beta(ends).min() > 0.6


# ------------------------------------------------------------------------------------------- half turn


@on_every_arm
def test_half_turn_is_exact_or_short_by_what_the_id_says(arm):
    for start in tasks.start_set("half-turn", arm=arm):
        if start.id.endswith("exact"):
            assert haversine(start.quat_wxyz, start.goal_wxyz) >= 1.0 - 1e-15
        else:
            delta = 10.0 ** -int(start.id[-1])
            assert math.pi - tasks.base.angle(start.quat_wxyz, start.goal_wxyz) == pytest.approx(delta, abs=2e-15)


@on_every_arm
def test_half_turns_are_about_the_base_axes_and_others(arm):
    axes = {}
    for start in tasks.start_set("half-turn", arm=arm):
        turn = rotation(start.goal_wxyz) * rotation(start.quat_wxyz).inv()
        axes.setdefault(start.id.split("-")[2], []).append(turn.as_rotvec() / turn.magnitude())
    assert set(axes) == {"x", "y", "z", "drawn0", "drawn1", "drawn2"}
    for i, word in enumerate("xyz"):
        np.testing.assert_allclose(np.abs(axes[word]), np.tile(np.eye(3)[i], (4, 1)), atol=1e-14)


# --------------------------------------------------------------------------------------------- uniform


@on_every_arm
def test_uniform_goal_is_reachable_at_the_starts_position(arm):
    """scipy's own least squares, inside the joint ranges or one turn, from drawn joints."""
    one, model = tasks.arm(arm), kinematics(tasks.arm(arm))
    lower, upper = (np.nan_to_num(x, posinf=math.pi, neginf=-math.pi) for x in (one.lower, one.upper))
    generator = np.random.default_rng(17)
    for start in tasks.start_set("uniform", arm=arm)[::40]:
        p, goal = model.pose(start.q)[0], rotation(start.goal_wxyz)

        def miss(q, p=p, goal=goal):
            here, quat = model.pose(q)
            return np.concatenate((here - p, (goal * rotation(quat).inv()).as_rotvec()))

        guesses = [generator.uniform(lower, upper) for _ in range(30)]
        to_rounding = {"bounds": (lower, upper), "ftol": 1e-15, "xtol": 1e-15, "gtol": 1e-15}
        found = (least_squares(miss, guess, **to_rounding).cost < 1e-16 for guess in guesses)
        assert any(found), start.id


@on_every_arm
def test_uniform_joints_and_goals_are_spread_evenly(arm):
    """Thirds of the range hold a third each, and the goals' traces have mean 0; what is refused moves both a little."""
    starts = tasks.start_set("uniform", arm=arm)
    q = np.array([start.q for start in starts])
    one = tasks.arm(arm)
    for joint in range(one.joints):
        low, high = one.lower[joint], one.upper[joint]
        middle, width = (0.5 * (low + high), min(high - low, math.tau)) if high - low < math.inf else (0.0, math.tau)
        share = (abs(q[:, joint] - middle) < width / 6.0).mean()
        assert share == pytest.approx(1.0 / 3.0, abs=0.1)
    assert abs(np.mean([np.trace(rotation(start.goal_wxyz).as_matrix()) for start in starts])) < 0.2
