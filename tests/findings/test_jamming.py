"""The jamming diagram against statics: a load that contacts within their friction cones can balance moves nothing."""

import itertools

import numpy as np
import pytest
from scipy.optimize import linprog

from bench.findings.theory.jamming import margin

MU = 0.2


def is_balanced(across: float, turning: float, reach: float) -> bool:
    """Whether forces of any size within their cones hold a peg pushed inwards by 1: it touches at its end and at the
    mouth, on the same side or, askew, on both.

    r = 1: x across, z outwards, moments about y; the peg has gone in by l = 2 mu lambda.
    """
    pushed = np.array((across, -1.0, turning))
    for end, mouth in itertools.product((1.0, -1.0), repeat=2):
        columns = []
        for (side, height), friction in itertools.product(((end, 0.0), (mouth, 2.0 * MU * reach)), (MU, -MU)):
            x, z = -side, friction
            columns.append((x, z, height * x - side * z))
        found = linprog(np.zeros(len(columns)), A_eq=np.array(columns).T, b_eq=-pushed, bounds=(0.0, None))
        if found.status == 0:
            return True
    return False


@pytest.mark.parametrize("reach", [1.1, 4.0])
def test_load_inside_the_diagram_cannot_be_balanced_and_one_outside_can(reach):
    draw, inside = np.random.default_rng(5), 0
    for _ in range(200):
        across, turning = draw.uniform(-1.2, 1.2) / MU, draw.uniform(-1.5, 1.5) * (1.0 + 2.0 * reach)
        size = margin(across, turning, reach, MU)
        if abs(size - 1.0) < 1e-6:
            continue
        inside += size < 1.0
        assert is_balanced(across, turning, reach) == (size > 1.0), (across, turning)
    assert 20 < inside < 180


def test_peg_that_is_not_far_in_may_be_wedged_by_a_load_that_would_slide():
    """lambda < 1: friction cones of the end and of the mouth see each other, and forces between them cost nothing."""
    load = (-3.56, -0.735)
    assert margin(*load, 0.2, MU) < 1.0
    assert is_balanced(*load, 0.2)
