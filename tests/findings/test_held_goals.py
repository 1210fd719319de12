"""Goals that the linearized law cannot hold: the law itself about goals, and episodes, against the closed form."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.driving import settings
from support.states import of_scipy

from bench.engines.episode import OUTCOME
from bench.engines.simulate import run
from bench.findings.theory.held_goals import held_share, least_cosine
from bench.law.contenders.registry import find_contender
from bench.law.inputs import AT_REST, Gains, Goal
from tasks.base import Start
from tasks.rotations import about, multiply
from tasks.verdict import SETTLED

LAW = find_contender("linearized-euler/zyx-euler")
PAPER = Gains()
BETAS = (-1.2, 0.0, 0.4, 1.0)


def compute_growth(goal: ScipyRotation, gains: Gains) -> float:
    """Return the largest real part of the eigenvalues of the closed loop about a goal, by central differences [1/s]."""
    system, goal_matrix, step = np.eye(6, k=3), of_scipy(goal), 1e-5
    for i, unit in enumerate(step * np.eye(3)):
        turned = [of_scipy(ScipyRotation.from_rotvec(sign * unit) * goal) for sign in (1, -1)]
        states = ((i, [(R, AT_REST) for R in turned]), (3 + i, [(goal_matrix, tuple(s * unit)) for s in (1, -1)]))
        for column, ends in states:
            up, down = (np.array(LAW.law(*end, Goal(goal_matrix), gains)) for end in ends)
            system[3:, column] = (up - down) / (2.0 * step)
    return float(np.linalg.eigvals(system).real.max())


def goal_beside(beta: float, gains: Gains, beyond_rad: float) -> ScipyRotation:
    """Return a goal with this beta whose alpha is so much beyond the closed form's boundary; gamma does not matter."""
    return ScipyRotation.from_euler("ZYX", (math.acos(least_cosine(beta, gains)) + beyond_rad, beta, 0.7))


@pytest.mark.parametrize("beta", BETAS)
@pytest.mark.parametrize("gains", [PAPER, Gains(100.0, 10.0), Gains(25.0, 30.0)])
def test_loop_about_a_goal_is_unstable_just_beyond_the_closed_forms_boundary(gains, beta):
    assert (
        compute_growth(goal_beside(beta, gains, -1e-5), gains)
        < 0.0
        < compute_growth(goal_beside(beta, gains, 1e-5), gains)
    )


def test_share_is_that_of_random_goals():
    """Angles by scipy; three standard errors of 20,000 goals."""
    angles = ScipyRotation.random(20_000, rng=np.random.default_rng(3)).as_euler("ZYX")
    held = np.cos(angles[:, 0]) > least_cosine(angles[:, 1], PAPER)
    assert held.mean() == pytest.approx(held_share(PAPER), abs=3.0 * math.sqrt(0.25 / 20_000))


@pytest.mark.parametrize(("beyond", "expected"), [(-0.05, True), (0.05, False)])
def test_body_beside_its_goal_stays_there_only_if_the_goal_is_held(beyond, expected):
    """A thousandth of a radian off; 0.05 rad past the boundary its error grows."""
    goals = [tuple(goal_beside(beta, PAPER, beyond).as_quat(scalar_first=True).tolist()) for beta in BETAS]
    starts = [Start("", multiply(about((0.48, -0.6, 0.64), 1e-3), goal), goal_wxyz=goal) for goal in goals]
    found = run("ideal-rk4", LAW, "free-body", starts, settings(horizon_s=20.0), ())
    assert [row[OUTCOME] == SETTLED for row in found] == [expected] * len(starts)
