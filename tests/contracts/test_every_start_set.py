"""Contracts over every start set, of the free body and of every arm, and what defines those of arms, by scipy."""

import itertools
import json
import math
import re

import numpy as np
import pytest
from support.arm_paths import (
    ARMS,
    BETWEEN,
    angle_of,
    conditions,
    cos_beta,
    evenly,
    geodesic,
    in_range,
    straight,
    walked,
)
from support.command_line import python

import tasks
from tasks.base import AT_REST
from tasks.clearance import CONDITION, COS_BETA, RANGE, WRAP
from tasks.kinematics import kinematics

ON_BODY, ON_ARM = tasks.start_set_names(), tasks.start_set_names(arm=True)
SAMPLED = [("uniform", ""), ("tumbling", ""), ("goals", "")]
SAMPLED += itertools.product(("clear", "uniform", "tumbling"), ARMS)
every_set = pytest.mark.parametrize(
    ("name", "arm"), [(name, "") for name in ON_BODY] + [*itertools.product(ON_ARM, ARMS)]
)


@every_set
def test_ids_are_unique_words_quaternions_unit_and_elements_plain_floats(name, arm):
    ids = [start.id for start in tasks.start_set(name, arm=arm)]
    assert len(set(ids)) == len(ids)
    assert all(re.fullmatch(r"[a-z0-9][a-z0-9.-]*", word) for word in ids)
    assert not arm or all(word.startswith(name) for word in ids)
    for start in tasks.start_set(name, arm=arm):
        for quat in (start.quat_wxyz, start.goal_wxyz):
            # MuJoCo normalizes no product along the chain of an arm: seven of them, each rounded to 2e-16
            assert math.hypot(*quat) == pytest.approx(1.0, abs=2e-15 if arm else 4e-16)
    for start in tasks.start_set(name, arm=arm)[:40]:
        numbers = (*start.quat_wxyz, *start.omega, *start.goal_wxyz, *start.q, *start.qdot)
        assert len(numbers) == 11 + (2 * tasks.arm(arm).joints if arm else 0)
        assert {type(x) for x in numbers} == {float}
        assert np.isfinite(numbers).all()


@every_set
def test_shorter_set_begins_the_longer_one(name, arm):
    for count in (1, 2, 17, 20, 150):
        whole = tasks.start_set(name, arm=arm)
        assert tasks.start_set(name, min(count, len(whole)), arm=arm) == whole[:count]


@pytest.mark.parametrize(("name", "arm"), SAMPLED)
def test_sampled_set_has_as_many_as_asked_for_and_begins_the_same(name, arm):
    usual = tasks.start_set(name, arm=arm)
    longer = tasks.start_set(name, len(usual) + 5, arm=arm)
    assert len(longer) == len(usual) + 5
    assert longer[: len(usual)] == usual


@pytest.mark.parametrize(("name", "arm"), [*SAMPLED[:3], *zip(ON_ARM, itertools.cycle(ARMS))])
def test_other_seed_gives_other_starts(name, arm):
    count = 6 if arm else 100
    assert tasks.start_set(name, count, seed=1, arm=arm) != tasks.start_set(name, count, seed=0, arm=arm)


SETTINGS = {
    "as it is": {},
    "blas": {"OPENBLAS_CORETYPE": "Prescott"},
    "numpy": {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX2 FMA3 X86_V3 X86_V4"},
}
STARTS = """
import json, tasks
from bench.experiments.jacobians.pose_sets import poses

found = {}
for name, arm in ORDER:
    chosen = tasks.find_start_set(name, arm=True)
    starts = chosen.build(tasks.arm(arm), chosen.size, 0)[: chosen.size]
    found[f"{name} of {arm}"] = [[start.id, *(x.hex() for part in start[1:] for x in part)] for start in starts]
found["poses"] = [[pose.id, *(x.hex() for x in pose.q)] for pose in poses(tasks.arm("ur5e"), 16, 0)]
"""


ORDER = list(itertools.product(ON_ARM, ("ur5e", "panda")))


@pytest.fixture(scope="module")
def found_here():
    """What STARTS finds in this process."""
    here = {"ORDER": ORDER}
    exec(STARTS, here)
    return here["found"]


@pytest.mark.parametrize("setting", SETTINGS)
def test_fresh_process_finds_the_kept_starts_bit_for_bit_in_the_opposite_order(setting, found_here):
    told = python("-W", "ignore", "-c", f"ORDER = {ORDER[::-1]}{STARTS}print(json.dumps(found))", **SETTINGS[setting])
    there = json.loads(told)
    assert sum(len(found) > 8 for found in there.values()) >= 4
    assert [name for name in found_here if found_here[name] != there[name]] == []
    for name, arm in ORDER:
        kept = [[start.id, *(x.hex() for part in start[1:] for x in part)] for start in tasks.start_set(name, arm=arm)]
        assert kept == there[f"{name} of {arm}"]


every_set_on_every_arm = pytest.mark.parametrize(("arm", "name"), list(itertools.product(ARMS, ON_ARM)))
on_every_arm = pytest.mark.parametrize("arm", ARMS)


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


def towards_the_middle(start, least):
    """Shares of the way to the middle, closing in on it geometrically down to `least` rad."""
    half = 0.5 * angle_of(start)
    closing = np.geomspace(half, least, 60)
    return 0.5 * (1.0 - closing / half)


@on_every_arm
def test_wrist_starts_and_goals_are_80_degrees_apart_well_conditioned_and_keep_off_the_pole(arm):
    for start in tasks.start_set("wrist", arm=arm):
        assert math.degrees(angle_of(start)) == pytest.approx(80.0, abs=1e-9)
        assert conditions(arm, [start.q]) <= CONDITION
        assert cos_beta(geodesic(start, np.linspace(0.0, 1.0, 41))).min() >= COS_BETA * 0.99


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
