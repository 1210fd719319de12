"""Random starts in blocks: distributions against their closed forms, and a block from its number alone."""

import numpy as np
import pytest
from scipy import stats

from tasks.random_starts import BLOCK, block


@pytest.fixture(scope="module")
def starts():
    made = [block(number, seed=5, most_speed=20.0) for number in (0, 1, 2**31)]
    return np.concatenate([quats for quats, _ in made]), np.concatenate([omegas for _, omegas in made])


def test_orientations_have_the_haar_measure(starts):
    quats, _ = starts
    np.testing.assert_allclose(np.linalg.norm(quats, axis=1), 1.0, atol=4e-16)
    angles = 2.0 * np.arccos(np.abs(quats[:, 0]))
    assert stats.kstest(angles, lambda theta: (theta - np.sin(theta)) / np.pi).pvalue > 0.01
    along = quats[:, 1:] / np.linalg.norm(quats[:, 1:], axis=1)[:, None]
    for z in along.T:  # Archimedes
        assert stats.kstest(z, stats.uniform(-1.0, 2.0).cdf).pvalue > 0.01


def test_speeds_are_uniform_and_directions_too(starts):
    _, omegas = starts
    speeds = np.linalg.norm(omegas, axis=1)
    assert stats.kstest(speeds, stats.uniform(0.0, 20.0).cdf).pvalue > 0.01
    for z in (omegas / speeds[:, None]).T:
        assert stats.kstest(z, stats.uniform(-1.0, 2.0).cdf).pvalue > 0.01


def test_block_follows_from_its_number_and_seed():
    quats, omegas = block(7, seed=3)
    assert quats.shape == (BLOCK, 4)
    assert not omegas.any()
    np.testing.assert_array_equal(block(7, seed=3, most_speed=1.0)[0], quats)
    for other in (block(8, seed=3), block(7, seed=4)):
        assert not np.isin(other[0], quats).any()
