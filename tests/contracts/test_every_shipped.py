"""Contracts that every controller of bench/law/contenders/shipped keeps; a new file is under them unnamed."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import of_scipy

from bench.law.contender import Gains, Goal
from bench.law.contenders.registry import known_shipped
from bench.law.shipped import ANTIPODE, NEAR, POSITION, TORQUE, VELOCITY, regulator_of
from bench.law.so3 import IDENTITY

SIZES = (1e-9, 1e-3, 0.2, 1.0, 2.5, 3.1, math.pi)


@pytest.fixture(params=known_shipped().values(), ids=lambda one: one.name)
def shipped(request):
    return request.param


def turns(count: int = 40):
    """Quaternions of turns about drawn axes."""
    drawn = np.random.default_rng(19).normal(size=(count, 3))
    for k in drawn / np.linalg.norm(drawn, axis=1)[:, None]:
        for theta in SIZES:
            yield (math.cos(theta / 2.0), *(math.sin(theta / 2.0) * k).tolist())


def test_fields_say_what_it_is(shipped):
    assert all((shipped.path, shipped.set_by))
    assert shipped.level in {TORQUE, VELOCITY, POSITION}
    assert (shipped.damping is None) == (shipped.level == VELOCITY)
    assert shipped.stiffness > 0.0


def test_source_is_pinned_to_a_commit_or_a_release(shipped):
    repository, _, revision = shipped.source.partition("@")
    assert repository.count("/") == 1
    assert revision.startswith("v") or (len(revision) == 40 and int(revision, 16))


def test_error_is_zero_at_the_goal(shipped):
    assert not any(shipped.error((1.0, 0.0, 0.0, 0.0)))


def test_error_of_the_opposite_turn_is_the_opposite(shipped):
    for w, x, y, z in turns():
        np.testing.assert_array_equal(shipped.error((w, -x, -y, -z)), np.negative(shipped.error((w, x, y, z))))


def test_law_is_the_error_times_the_gains_and_a_damper(shipped):
    law, gains, omega = regulator_of(shipped).law, Gains(3.0, 5.0), (0.25, -0.5, 1.0)
    drawn = ScipyRotation.random(20, rng=np.random.default_rng(3))
    for turn, sheet in zip(drawn, [NEAR, ANTIPODE] * 10, strict=True):
        u, q = law(of_scipy(turn), omega, Goal(IDENTITY), gains, sheet)
        assert np.dot(q, sheet) >= 0.0
        assert np.linalg.norm(q) == pytest.approx(1.0, abs=1e-15)
        np.testing.assert_allclose(u, 3.0 * np.array(shipped.error(q)) - 5.0 * np.array(omega), rtol=1e-14)


def test_law_is_one_regulator_however_often_it_is_asked_for(shipped):
    assert regulator_of(shipped) is regulator_of(shipped)
