"""A second counter: the paper's equations typed anew as CasADi expressions, whose instructions are counted.

Nothing of ours is called to build them. CasADi simplifies x * 1, x + x and the like by default; that is
switched off here, so that an expression keeps every operation it is written with. A Python name used twice
is one node, which is our rule for common sub-expressions. Not compared: comparisons (an expression has no
branches) and sign changes (OP_NEG, free by our rules).
"""

import math

import casadi
import numpy as np
import pytest
from casadi import SX, atan2, sqrt
from scipy.spatial.transform import Rotation as ScipyRotation
from support.states import of_scipy

from bench.engines.counting import OPERATIONS, TOTAL, cost
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains, Goal

COLUMN = {
    casadi.OP_ADD: "add",
    casadi.OP_SUB: "add",
    casadi.OP_MUL: "mul",
    casadi.OP_DIV: "div",
    casadi.OP_SQRT: "sqrt",
    casadi.OP_SIN: "sin",
    casadi.OP_COS: "cos",
    casadi.OP_ATAN2: "atan2",
}
FREE = {casadi.OP_NEG, casadi.OP_CONST, casadi.OP_INPUT, casadi.OP_OUTPUT, casadi.OP_PARAMETER}
COMPARED = [name for name in OPERATIONS if name != "compare"]


@pytest.fixture(autouse=True, scope="module")
def expressions_as_written():
    casadi.GlobalOptions.setSimplificationOnTheFly(False)
    yield
    casadi.GlobalOptions.setSimplificationOnTheFly(True)


def angles(n, o, a):
    """Z-Y-X angles by atan2 (2.2): alpha from n, gamma from o and a turned back by alpha; what B needs."""
    nx, ny, nz = casadi.vertsplit(n)
    cb = sqrt(nx * nx + ny * ny)
    ca, sa = nx / cb, ny / cb
    gamma = atan2(sa * a[0] - ca * a[1], ca * o[1] - sa * o[0])
    return (atan2(ny, nx), atan2(-nz, cb), gamma), (sa, ca, -nz, cb)


def rates(trig, w):
    """(2.9) with its last row named: the first is sin(beta) times it, plus omega_z."""
    sa, ca, sb, cb = trig
    wx, wy, wz = casadi.vertsplit(w)
    dgamma = (ca * wx + sa * wy) / cb
    return sb * dgamma + wz, ca * wy - sa * wx, dgamma


def pd(E, E_d, dE, kp, kv):
    """u_e of (2.16): Kp (E_d - E) - Kd Edot."""
    return [kp * (want - have) - kv * rate for want, have, rate in zip(E_d, E, dE, strict=True)]


def permuted(u):
    """(2.14): u_x drives gamma, u_z drives alpha."""
    return u[2], u[1], u[0]


def crosses(n, o, a, nd, od, ad):
    """n x n_d + o x o_d + a x a_d (2.12)."""
    return casadi.cross(n, nd) + casadi.cross(o, od) + casadi.cross(a, ad)


def rotation_matrix(n, o, a, w, nd, od, ad, kp, kv):
    """Return the law of columns with Kp / 2 computed once."""
    half = 0.5 * kp
    e = crosses(n, o, a, nd, od, ad)
    return [half * e[i] - kv * w[i] for i in range(3)]


def linearized(n, o, a, w, nd, od, ad, kp, kv):
    """PD in E, given to the inputs that (2.14) asks for."""
    E, trig = angles(n, o, a)
    E_d, _ = angles(nd, od, ad)
    return permuted(pd(E, E_d, rates(trig, w), kp, kv))


def feedback_linearized(n, o, a, w, nd, od, ad, kp, kv):
    """omegadot for a wanted Eddot, (2.8) differentiated by hand.

    Along the level axis (ca, sa, 0) omega is cb gammadot, along the one across it (-sa, ca, 0) it is
    betadot, and both axes turn about z with alphadot; along z it is alphadot - sb gammadot.
    """
    E, trig = angles(n, o, a)
    E_d, _ = angles(nd, od, ad)
    sa, ca, sb, cb = trig
    dalpha, dbeta, dgamma = rates(trig, w)
    ddalpha, ddbeta, ddgamma = pd(E, E_d, (dalpha, dbeta, dgamma), kp, kv)
    spin = cb * dgamma
    level = cb * ddgamma - (sb * dgamma + dalpha) * dbeta
    across = ddbeta + dalpha * spin
    return ca * level - sa * across, sa * level + ca * across, ddalpha - sb * ddgamma - dbeta * spin


def function_of(expression):
    given = [SX.sym(name, 3) for name in ("n", "o", "a", "w", "nd", "od", "ad")] + [SX.sym("kp"), SX.sym("kv")]
    return casadi.Function("u", given, [casadi.vertcat(*expression(*given))])


def counted_by_casadi(expression):
    function = function_of(expression)
    counts = dict.fromkeys(COMPARED, 0)
    for index in range(function.n_instructions()):
        operation = function.instruction_id(index)
        if operation not in FREE:
            counts[COLUMN[operation]] += 1
    return counts


def difference(expression, word, stage=TOTAL):
    theirs, own = counted_by_casadi(expression), cost(find_contender(word)).typical.of(stage)
    return {name: theirs[name] - own[name] for name in COMPARED if theirs[name] != own[name]}


FORMS = [
    (rotation_matrix, "rotation-matrix"),
    (linearized, "linearized-euler/zyx-euler"),
    (feedback_linearized, "feedback-linearized/zyx-euler"),
]
"""An expression, and the law that it is."""


@pytest.mark.parametrize(("expression", "word"), FORMS)
def test_casadi_counts_our_operations(expression, word):
    assert difference(expression, word) == {}


def test_casadi_counts_the_same_operations_for_the_angles():
    def of_goal(n, o, a, w, nd, od, ad, kp, kv):
        return angles(nd, od, ad)[0]

    assert difference(of_goal, "feedback-linearized/zyx-euler", "goal") == {}


@pytest.mark.parametrize(("expression", "word"), FORMS)
def test_expression_is_the_law_that_is_counted(expression, word):
    rng = np.random.default_rng(1988)
    function, law, gains = function_of(expression), find_contender(word).law, Gains()
    turns = [of_scipy(turn) for turn in ScipyRotation.random(60, rng=rng)]
    regular = [R for R in turns if math.hypot(R.n[0], R.n[1]) > 0.01]
    for R, R_d in zip(regular[:20], regular[20:40], strict=True):
        omega = tuple(rng.normal(scale=3.0, size=3).tolist())
        theirs = function(*R, omega, *R_d, *gains).full().ravel()
        # eps / cos^2(beta) times commands up to 1e4: 1e-9 holds for cos(beta) > 0.01
        np.testing.assert_allclose(law(R, omega, Goal(R_d), gains), theirs, rtol=1e-9, atol=1e-9)
