"""Contracts that every controller of bench/law/contenders/shipped keeps; a new file is under them unnamed."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import of_scipy

from bench.law.contenders.registry import contenders
from bench.law.inputs import Gains, Goal
from bench.law.kinds import POSITION, TORQUE, VELOCITY
from bench.law.shipped import ANTIPODE, NEAR
from bench.law.so3 import IDENTITY

SIZES = (1e-9, 1e-3, 0.2, 1.0, 2.5, 3.1, math.pi)


@pytest.fixture(params=contenders("shipped").values(), ids=lambda one: one.name)
def one(request):
    return request.param


def turns(count: int = 40):
    """Quaternions of turns about drawn axes."""
    drawn = np.random.default_rng(19).normal(size=(count, 3))
    for k in drawn / np.linalg.norm(drawn, axis=1)[:, None]:
        for theta in SIZES:
            yield (math.cos(theta / 2.0), *(math.sin(theta / 2.0) * k).tolist())


def test_fields_say_what_it_is_and_its_source_is_pinned(one):
    assert all((one.shipped.path, one.shipped.set_by))
    assert one.level in {TORQUE, VELOCITY, POSITION}
    assert (one.gains.kv == 0.0) == (one.level == VELOCITY)
    assert one.gains.kp > 0.0
    repository, _, revision = one.source.partition("@")
    assert repository.count("/") == 1
    assert revision.startswith("v") or (len(revision) == 40 and int(revision, 16))


def test_error_is_zero_at_the_goal_and_that_of_the_opposite_turn_is_the_opposite(one):
    assert not any(one.shipped.error((1.0, 0.0, 0.0, 0.0)))
    for w, x, y, z in turns():
        np.testing.assert_array_equal(one.shipped.error((w, -x, -y, -z)), np.negative(one.shipped.error((w, x, y, z))))


def test_law_is_the_error_times_the_gains_and_a_damper(one):
    law, gains, omega = one.law, Gains(3.0, 5.0), (0.25, -0.5, 1.0)
    drawn = ScipyRotation.random(20, rng=np.random.default_rng(3))
    for turn, sheet in zip(drawn, [NEAR, ANTIPODE] * 10, strict=True):
        u, q = law(of_scipy(turn), omega, Goal(IDENTITY), gains, sheet)
        assert np.dot(q, sheet) >= 0.0
        assert np.linalg.norm(q) == pytest.approx(1.0, abs=1e-15)
        np.testing.assert_allclose(u, 3.0 * np.array(one.shipped.error(q)) - 5.0 * np.array(omega), rtol=1e-14)
