"""Feedback linearization does what its name says: in any three coordinates the error obeys the linear equation."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.driving import settings
from support.states import of_scipy

from bench.contenders.registry import contenders_of, known_regulators
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.simulate import run
from bench.metrics.registry import metrics_of
from tasks.base import Start
from tasks.rotations import zyx

# Of a quaternion, what is along it moves nothing and drops out: four coordinates are not free to be linear.
LINEAR = [
    one for one in contenders_of(known_regulators()["feedback-linearized"]) if len(one.representation.symbols) == 3
]
START = Start("moving", zyx(0.4, 0.7, -0.5), (1.0, -2.0, 1.5), zyx(-0.3, 0.5, 0.6))  # far from every singular set
MATRIX = [NUMBERS.index(f"{column}_{x}") for column in "noa" for x in "xyz"]
STEP = 1e-6


def coordinates(one, R):
    return np.array(one.representation.chart(of_scipy(R)).E)


@pytest.mark.parametrize("one", LINEAR, ids=lambda one: one.name)
def test_coordinates_follow_the_critically_damped_response(one):
    """E - E_d = (x + (v + 10 x) t) exp(-10 t) of Kp = 100, Kd = 20 (Murphy 1988, 2.3 and 2.16)."""
    curves = blank_curves(1, 1000)
    run("ideal-rk4", one, "free-body", [START], settings(horizon_s=1.0), metrics_of(on_arm=False), curves=curves)
    columns = curves.samples[0][:, MATRIX].reshape(-1, 3, 3)
    E = np.array([coordinates(one, ScipyRotation.from_matrix(n_o_a.T)) for n_o_a in columns[::20]])
    times = curves.samples[0][::20, NUMBERS.index("time_s")][:, None]

    first = ScipyRotation.from_quat(START.quat_wxyz, scalar_first=True)
    E_d = coordinates(one, ScipyRotation.from_quat(START.goal_wxyz, scalar_first=True))
    turned = [coordinates(one, ScipyRotation.from_rotvec(np.array(START.omega) * h) * first) for h in (STEP, -STEP)]
    x, v = coordinates(one, first) - E_d, (turned[0] - turned[1]) / (2.0 * STEP)
    expected = (x + (v + 10.0 * x) * times) * np.exp(-10.0 * times)
    np.testing.assert_allclose(E - E_d, expected, rtol=0.0, atol=1e-6)
