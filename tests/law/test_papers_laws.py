"""What the paper's regulators are, each against its equation (Murphy 1988, 2.12-2.16)."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation as ScipyRotation
from support.bits import EPS
from support.exact import EXACT, exact_B, motion, solved
from support.states import as_rotation, axis_permuting, matrix, of_scipy, vector

from bench.law.contenders.registry import all_contenders, find_contender
from bench.law.inputs import AT_REST, Gains, Goal
from bench.law.so3 import IDENTITY

GAINS = Gains(kp=100.0, kv=20.0)
REGULAR = 0.05  # margin above which B^-1 is at most 20 times larger than 1


def command(word, R, omega=AT_REST, R_d=IDENTITY, gains=GAINS):
    with np.errstate(all="ignore"):
        return np.array(find_contender(word).law(R, vector(omega), Goal(R_d), gains))


@pytest.fixture
def draw():
    return np.random.default_rng(12)


def regular(draw, count=100):
    """Drawn orientations away from the poles, each with a tumbling velocity."""
    drawn = (of_scipy(r) for r in ScipyRotation.random(2 * count, rng=draw))
    kept = [R for R in drawn if math.hypot(R.n[0], R.n[1]) > REGULAR][:count]
    return zip(kept, draw.normal(scale=5.0, size=(len(kept), 3)), strict=True)


# --------------------------------------------------------------------------- linearized Euler (2.14)


def test_linearized_euler_as_printed_exchanges_its_ends_and_relative_is_it_seen_from_the_goal(draw):
    """Hold the two to linearized-euler, whose equation test_counts_against_casadi has."""
    # angles move by 10 EPS over the margin, rates by 10 EPS |omega| over its square
    allowed = 20 * EPS * (GAINS.kp / REGULAR + GAINS.kv * 20.0 / REGULAR**2)
    for (R, omega), (goal, _) in zip(regular(draw), regular(draw), strict=True):
        u, literal = (command(f"linearized-euler{word}/zyx-euler", R, omega, goal) for word in ("", "-literal"))
        np.testing.assert_allclose(literal, u[::-1], rtol=0.0, atol=0.0)
        R_d = matrix(goal)
        moved = as_rotation((R_d @ matrix(R)).T)
        seen = command("linearized-euler-relative/zyx-euler", moved, R_d @ omega, goal)
        np.testing.assert_allclose(seen, R_d @ command("linearized-euler/zyx-euler", R, omega), rtol=0.0, atol=allowed)


# --------------------------------------------------------------------------- feedback-linearized (2.15)-(2.16)


# Of a quaternion, what is along it moves nothing and drops out: four coordinates are not free to be linear.
LINEAR = [
    one
    for one in all_contenders()
    if one.regulator.name.startswith("feedback-linearized") and len(one.representation.symbols) == 3
]


@pytest.mark.parametrize("one", LINEAR, ids=lambda one: one.name)
def test_feedback_linearized_coordinates_obey_the_linear_equation(one, draw):
    """Eddot = Kp (E_d - E) - Kd Edot (2.16), the plant inverted on 80-digit numbers, without any B of ours.

    omegadot = B Eddot + Bdot Edot; the second term is what a path with Eddot = 0 has.
    """
    at, compared = one.representation, 0
    for (R, omega), (R_d, _) in zip(regular(draw, 60), regular(draw, 60), strict=True):
        if at.margin(R) < REGULAR:
            continue
        compared += 1
        E, E_d = at.chart(R).E, at.chart(R_d).E
        B = exact_B(at.to_matrix, E)
        Edot = solved(B, omega)
        _, bias = motion(at.to_matrix, E, Edot)
        u = command(one.name, R, omega, R_d)
        Eddot = solved(B, [EXACT.mpf(x) - y for x, y in zip(u, bias, strict=True)])
        expected = [GAINS.kp * (d - e) - GAINS.kv * rate for d, e, rate in zip(E_d, E, Edot, strict=True)]
        speed = float(max(abs(rate) for rate in Edot))
        # the command carries 10 EPS of its largest term, and B^-1 magnifies it
        scale = 10 * EPS / REGULAR * (GAINS.kp * 2.0 * math.pi + GAINS.kv * speed + speed**2)
        np.testing.assert_allclose([float(x) for x in Eddot], [float(x) for x in expected], rtol=0.0, atol=scale)
    assert compared >= 40


@pytest.mark.parametrize("word", ["feedback-linearized/zyx-euler", "linearized-euler/zyx-euler"])
def test_euler_commands_are_not_finite_at_the_pole(word):
    """C10: dividing by cos(beta) = 0."""
    poles = [R for R in axis_permuting() if abs(R.n[2]) == 1.0]
    assert len(poles) == 8
    for R in poles:
        assert not np.isfinite(command(word, R, (1.0, 0.5, 0.2))).all()
