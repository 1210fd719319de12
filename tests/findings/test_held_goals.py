"""Goals that the linearized law cannot hold: bisection on the law itself, against the closed form and episodes."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.driving import settings

from bench.engines.episode import OUTCOME
from bench.engines.simulate import run
from bench.findings.theory.held_goals import held_share, held_to, least_cosine
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains
from tasks.base import Start
from tasks.haar import axes
from tasks.rotations import about, multiply
from tasks.verdict import SETTLED

LAW = find_contender("linearized-euler/zyx-euler")
PAPER = Gains()


@pytest.mark.parametrize("gains", [PAPER, Gains(100.0, 10.0), Gains(25.0, 30.0)])
def test_bisected_goals_lie_on_the_closed_forms_boundary(gains):
    found = {tuple(axis): held_to(LAW.law, axis, gains) for axis in axes(12)}
    bounded = {axis: angle for axis, angle in found.items() if angle < math.pi}
    assert len(bounded) >= 8
    for axis, angle in bounded.items():
        alpha, beta, _ = ScipyRotation.from_rotvec(angle * np.array(axis)).as_euler("ZYX")
        assert math.cos(alpha) == pytest.approx(least_cosine(beta, gains), abs=1e-6)
    for axis in found.keys() - bounded:
        alphas, betas, _ = ScipyRotation.from_rotvec(np.outer(np.linspace(0.0, 3.1, 300), axis)).as_euler("ZYX").T
        assert (np.cos(alphas) > least_cosine(betas, gains)).all()


def test_about_z_the_law_holds_goals_to_76_degrees():
    """At beta = 0, s = 1 and critical damping: cos(alpha_d) = sqrt(5) - 2, 76.35 degrees."""
    assert held_to(LAW.law, np.array((0.0, 0.0, 1.0)), PAPER) == pytest.approx(
        math.acos(math.sqrt(5.0) - 2.0), abs=1e-8
    )


def test_about_x_every_goal_is_held():
    assert held_to(LAW.law, np.array((1.0, 0.0, 0.0)), PAPER) == math.pi


def test_share_is_that_of_random_goals():
    """Angles by scipy; three standard errors of 20,000 goals."""
    angles = ScipyRotation.random(20_000, rng=np.random.default_rng(3)).as_euler("ZYX")
    held = np.cos(angles[:, 0]) > least_cosine(angles[:, 1], PAPER)
    assert held.mean() == pytest.approx(held_share(PAPER), abs=3.0 * math.sqrt(0.25 / 20_000))


@pytest.mark.parametrize(("beyond", "expected"), [(-0.05, True), (0.05, False)])
def test_body_beside_its_goal_stays_there_only_if_the_goal_is_held(beyond, expected):
    """A thousandth of a radian off; 0.05 rad past the boundary its error grows."""
    found = []
    bounded = [(axis, held_to(LAW.law, axis, PAPER)) for axis in axes(6)]
    bounded = [(axis, angle) for axis, angle in bounded if angle < math.pi]
    assert len(bounded) >= 4
    for axis, angle in bounded:
        goal = about(tuple(axis), angle + beyond)
        start = Start("", multiply(about((0.48, -0.6, 0.64), 1e-3), goal), goal_wxyz=goal)
        [row] = run("ideal-rk4", LAW, "free-body", [start], settings(horizon_s=20.0), ())
        found.append(row[OUTCOME] == SETTLED)
    assert found == [expected] * len(found)
