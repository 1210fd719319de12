"""Branches as masks: every lane as if it were alone, without a word of the sides that it does not take."""

import ast
import types
import warnings

import numpy as np
import pytest

from bench.errors import BadLaw
from bench.export.languages.python import RUNTIME
from bench.export.masks import function_name, masked
from bench.export.program import read_function
from bench.export.types import REAL, Program
from bench.law import acos, atan2, copysign, cos, sin, sqrt

WEIGHTS = (0.5, 0.25, 2.0)


def set_on_both_sides(x, y):
    if x > 0.0:
        size = sqrt(x)
        answer = y / size
    elif x < -1.0:
        answer = y / (x + 1.0)
    else:
        answer = 2.0
    return answer, x


def changed_on_one_side(x, y):
    a, b = x, y
    if a < b:
        a, b = b, a
    if y > 0.0 and x / y > 1.0:
        b -= 1.0
    return a - b, b


def returned_early(x, y):
    if x > 0.0:
        if y > 0.0:
            return sqrt(x * y)
        x = x + 1.0
    else:
        y = 1.0 / (1.0 - x)
    return x - y


def chosen_within(x, y):
    return acos(x) if -1.0 < x < 1.0 else copysign(0.0 if x > 0.0 else 3.0, y)


def summed(x, y):
    total = 0.0
    for k in range(1, 3):
        if not x < WEIGHTS[k]:
            total += sqrt(x - WEIGHTS[k])
        total -= WEIGHTS[k - 1] * y
    return total


def either_of_two(x, y):
    answer = 1.0
    if x > 1.0 or 1.0 / y > 1.0:
        answer = atan2(y, x) + sin(x) * cos(y)
    return answer


LAWS = (set_on_both_sides, changed_on_one_side, returned_early, chosen_within, summed, either_of_two)
GRID = (-2.0, -1.0, -0.5, -0.0, 0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0)


def translated(function):
    """The function as a function of two arrays."""
    program = Program()
    program.add(read_function(function), (REAL, REAL))
    trees = [ast.fix_missing_locations(masked(one, set(), {})) for one in program.functions]
    module = types.ModuleType("translated")
    exec("\n\n".join((RUNTIME, *map(ast.unparse, trees))), vars(module))

    def ask(x, y):
        lanes, x, y = module.opened(x=(x,), y=(y,))
        answer = getattr(module, function_name(program.functions[-1]))(lanes, x, y)
        return tuple(lanes.number(one) for one in answer) if isinstance(answer, tuple) else lanes.number(answer)

    return ask


def alone(function, x, y):
    """What one lane answers, as the law dialect has it; its own quotients by zero are silent."""
    with np.errstate(all="ignore"):
        return function(np.float64(x), np.float64(y))


@pytest.mark.parametrize("law", LAWS, ids=lambda one: one.__name__)
def test_masked_law_answers_as_each_lane_would_alone(law):
    x, y = (one.ravel() for one in np.meshgrid(GRID, GRID))
    with np.errstate(all="ignore"):
        together = translated(law)(x, y)
    expected = [alone(law, *each) for each in zip(x, y, strict=True)]
    # NumPy's own sine and arcs are another library's than libm's: 4 ulp of numbers of the size of 1
    exact = law not in (chosen_within, either_of_two)
    np.testing.assert_allclose(np.transpose(together), expected, rtol=0.0, atol=0.0 if exact else 4.0 * 2.0**-51)


@pytest.mark.parametrize("law", LAWS, ids=lambda one: one.__name__)
def test_masked_law_gives_no_warning_of_sides_not_taken(law):
    x, y = (one.ravel() for one in np.meshgrid(GRID, GRID))
    quiet = []
    for at in zip(x, y, strict=True):
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            with np.errstate(all="warn"):
                law(*map(np.float64, at))
        quiet.append(not heard)
    assert sum(quiet) > 80
    translated(law)(x[quiet], y[quiet])  # warnings are errors here


def test_masked_law_changes_no_argument():
    x, y = np.array(GRID), np.ones(len(GRID))
    translated(summed)(x, y)
    assert (x.tolist(), y.tolist()) == (list(GRID), [1.0] * len(GRID))


def left_early(x, y):
    for k in range(3):
        if x < WEIGHTS[k]:
            break
        y = y + 1.0
    return y


def set_on_one_side(x, y):
    if x > 0.0:
        z = y
    return z


def returned_on_one_side(x, y):
    if x > 0.0:
        return y


@pytest.mark.parametrize(
    ("law", "word"),
    [
        (left_early, "`break`"),
        (set_on_one_side, "set on one side alone"),
        (returned_on_one_side, "one side returns nothing"),
    ],
)
def test_law_that_arrays_cannot_take_is_refused(law, word):
    with pytest.raises(BadLaw, match=word):
        translated(law)


def test_name_that_the_file_has_is_written_otherwise():
    program = Program()
    program.add(read_function(summed), (REAL, REAL))
    text = ast.unparse(ast.fix_missing_locations(masked(program.functions[-1], {"total", "k"}, {})))
    assert "total_ = 0.0" in text
    assert "for k_ in range(1, 3)" in text
