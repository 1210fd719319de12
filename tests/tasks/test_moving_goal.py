"""The goal that sways, against scipy's rotations and finite differences."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tasks.moving_goal import reference_column, reference_rates

SWAYS = (0.5, 2.0, 10.0)
TIMES = np.linspace(0.0, 5.0, 41)


def goal(time, sway):
    """R_d by scipy, from a first orientation that is not the identity."""
    c = sway * math.sqrt(0.5)
    p, q = c * math.sin(2.0 * time) / 2.0, c * math.sin(3.1 * time) / 3.1
    return Rotation.from_rotvec([0.0, 0.0, p]) * Rotation.from_rotvec([q, 0.0, 0.0]) * FIRST


FIRST = Rotation.from_euler("ZYX", [0.3, -0.4, 0.9])


@pytest.mark.parametrize("sway", SWAYS)
def test_its_columns_are_those_of_two_turns(sway):
    for time in TIMES:
        ours = np.column_stack([reference_column(time, sway, tuple(column)) for column in FIRST.as_matrix().T])
        np.testing.assert_allclose(ours, goal(time, sway).as_matrix(), atol=1e-14)


@pytest.mark.parametrize("sway", SWAYS)
def test_its_rate_and_acceleration_are_the_derivatives(sway):
    h = 1e-5
    for time in TIMES:
        omega, alpha = reference_rates(time, sway)
        between = goal(time + h, sway) * goal(time - h, sway).inv()
        np.testing.assert_allclose(omega, between.as_rotvec() / (2.0 * h), atol=1e-8 * sway**3)
        after, before = (np.array(reference_rates(time + s, sway)[0]) for s in (h, -h))
        np.testing.assert_allclose(alpha, (after - before) / (2.0 * h), atol=1e-8 * sway**3)


@pytest.mark.parametrize("sway", SWAYS)
def test_its_rate_peaks_at_what_it_is_named_by(sway):
    speeds = [np.linalg.norm(reference_rates(time, sway)[0]) for time in TIMES]
    assert max(speeds) == pytest.approx(speeds[0], rel=1e-15) == pytest.approx(sway, rel=1e-15)
