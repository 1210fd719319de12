"""Functions of the law dialect, IEEE 754 in place of exceptions; rotations on tuples, against scipy and MuJoCo."""

import itertools
import math

import mpmath
import mujoco
import numpy as np
import pytest
from support.bits import EPS, same_bits
from support.each import each
from support.states import matrix, vector

import tasks
from bench.engines.compiled import compile_on_demand
from bench.law.scalar import PRIMITIVES, acos, atan2, copysign, cos, sin, sqrt
from bench.law.so3 import from_quaternion

TINY = 5e-324  # the smallest double above zero
SPECIAL = (0.0, TINY, 1e-308, 1e-8, 0.5, 1.0, 1.0 + EPS, 2.0, math.pi / 2, math.pi, 1e17, 1e308, math.inf, math.nan)
SIGNED = [np.float64(sign * x) for x in SPECIAL for sign in (1.0, -1.0)]
DRAWN = [np.float64(x) for x in np.random.default_rng(3).normal(scale=2.0, size=400)]


def arguments(function) -> list[tuple]:
    """All special numbers, in pairs where two are taken, and drawn ones."""
    if function.__code__.co_argcount == 1:
        return [(x,) for x in SIGNED + DRAWN]
    return [*itertools.product(SIGNED, repeat=2), *itertools.pairwise(DRAWN)]


primitive = each(PRIMITIVES)


def test_primitive_compiles_to_the_plain_call_bit_for_bit(primitive):
    given = np.array(arguments(primitive))
    if given.shape[1] == 1:

        def over(rows, out):
            for i in range(rows.shape[0]):
                out[i] = primitive(rows[i, 0])
    else:

        def over(rows, out):
            for i in range(rows.shape[0]):
                out[i] = primitive(rows[i, 0], rows[i, 1])

    out = np.empty(len(given))
    compile_on_demand(over)(given, out)
    with np.errstate(all="ignore"):
        assert same_bits(out, [primitive(*numbers) for numbers in arguments(primitive)])


@pytest.mark.parametrize("kind", [float, np.float64])
def test_primitive_keeps_the_type_it_is_given(primitive, kind):
    given = [kind(0.5)] * primitive.__code__.co_argcount
    assert type(primitive(*given)) is kind


@pytest.mark.parametrize(
    ("function", "true", "given"),
    [
        (sqrt, mpmath.sqrt, [(abs(x),) for x in DRAWN]),
        (sin, mpmath.sin, [(x,) for x in DRAWN]),
        (cos, mpmath.cos, [(x,) for x in DRAWN]),
        (acos, mpmath.acos, [(sin(x),) for x in DRAWN]),
        (atan2, mpmath.atan2, list(itertools.pairwise(DRAWN))),
    ],
)
def test_primitive_is_within_one_last_place_of_the_true_value(function, true, given):
    for numbers in given:
        answer = function(*numbers)
        with mpmath.workdps(40):
            error = abs(true(*map(mpmath.mpf, numbers)) - mpmath.mpf(answer))
        assert error < np.spacing(abs(answer)), numbers


@pytest.mark.parametrize(
    ("function", "given", "answer"),
    [
        (sqrt, (-1.0,), math.nan),
        (sqrt, (-TINY,), math.nan),
        (sqrt, (-math.inf,), math.nan),
        (acos, (1.0 + EPS,), math.nan),
        (acos, (-2.0,), math.nan),
        (sin, (math.inf,), math.nan),
        (cos, (-math.inf,), math.nan),
        (sin, (math.nan,), math.nan),
        (sqrt, (-0.0,), -0.0),
        (atan2, (0.0, 0.0), 0.0),
        (atan2, (-0.0, 0.0), -0.0),
        (atan2, (0.0, -0.0), math.pi),
        (atan2, (-0.0, -1.0), -math.pi),
        (atan2, (math.inf, math.inf), math.pi / 4),
        *((copysign, (-2.0, sign), math.copysign(2.0, sign)) for sign in (0.0, -0.0, 3.0, -3.0, math.inf, -math.inf)),
    ],
)
@pytest.mark.parametrize("kind", [float, np.float64])
def test_primitive_is_nan_outside_its_domain_and_follows_the_signs_of_zero_and_infinity(function, given, answer, kind):
    assert same_bits([function(*map(kind, given))], [answer])


STARTS = [start for word in tasks.start_set_names() for start in tasks.start_set(word)]


def test_rotation_of_a_quaternion_is_mujocos_bit_for_bit():
    for start in STARTS:
        theirs = np.empty(9)
        mujoco.mju_quat2Mat(theirs, np.array(start.quat_wxyz))
        assert same_bits(matrix(from_quaternion(vector(start.quat_wxyz))), theirs.reshape(3, 3)), start.id
