"""The counting scalar and the cost of a law: what is counted, what is free, what is refused."""

import math

import numpy as np
import pytest

from bench.base.errors import BadLaw
from bench.engines.counting import OPERATIONS, TOTAL, Counted, OutsideDialect, Tally, cost
from bench.engines.counting.costs import counted_calls
from bench.law import scalar
from bench.law.contender import contender
from bench.law.kinds import Law
from bench.law.so3 import dot


def counted(*numbers):
    tally = Tally()
    return tally, *(Counted(number, tally) for number in numbers)


def taken(tally):
    return {name: number for name, number in tally.take().of(TOTAL).items() if number}


def regulator(law, **fields):
    return Law(name="ours", title="", source="", formula="", law=law, **fields)


@pytest.mark.parametrize(
    ("operation", "compute"),
    [
        ("add", lambda x, y: x + y),
        ("add", lambda x, y: x - y),
        ("add", lambda x, y: 1.0 + y),
        ("add", lambda x, y: 1.0 - y),
        ("add", lambda x, y: x - 1),
        ("mul", lambda x, y: x * y),
        ("mul", lambda x, y: 2 * y),
        ("mul", lambda x, y: x * 1.0),
        ("mul", lambda x, y: np.float64(3.0) * x),
        ("div", lambda x, y: x / y),
        ("div", lambda x, y: 1.0 / y),
        ("sqrt", lambda x, y: scalar.sqrt(x)),
        ("sin", lambda x, y: scalar.sin(x)),
        ("cos", lambda x, y: scalar.cos(x)),
        ("acos", lambda x, y: scalar.acos(x)),
        ("atan2", lambda x, y: scalar.atan2(x, y)),
        ("atan2", lambda x, y: scalar.atan2(1.0, y)),
        ("atan2", lambda x, y: scalar.atan2(x, -2.0)),
        ("copysign", lambda x, y: scalar.copysign(x, y)),
        ("copysign", lambda x, y: scalar.copysign(1.0, y)),
        ("copysign", lambda x, y: scalar.copysign(x, -1.0)),
    ],
)
def test_operation_counts_once_and_keeps_its_value(operation, compute):
    x, y = np.float64(0.3), np.float64(-0.7)
    tally, *pair = counted(x, y)
    answer = compute(*pair)
    assert answer.value == compute(x, y)
    assert taken(tally) == {operation: 1}


@pytest.mark.parametrize("compare", [lambda x, y: x < y, lambda x, y: x <= y, lambda x, y: x > y, lambda x, y: x >= y])
@pytest.mark.parametrize("other", [0.5, 0.25, 0.0, math.nan])
def test_comparison_counts_once_and_follows_the_value(compare, other):
    for right in (other, np.float64(other)):
        tally, x = counted(0.25)
        assert compare(x, right) is compare(0.25, other)
        assert compare(right, x) is compare(other, 0.25)
        assert taken(tally) == {"compare": 2}


def test_sign_change_is_free_and_constants_alone_are_folded():
    tally, x = counted(0.25)
    assert (-x).value == -0.25
    assert taken(tally) == {}
    assert (x * (2.0 * scalar.sqrt(4.0))).value == 1.0
    assert taken(tally) == {"mul": 1}


def test_division_follows_ieee_754():
    tally, one, zero = counted(1.0, 0.0)
    with np.errstate(all="ignore"):
        assert (one / zero).value == math.inf
        assert (one / -zero).value == -math.inf
        assert math.isnan((zero / zero).value)
        assert math.isnan(scalar.sqrt(-one).value)
    assert taken(tally) == {"div": 3, "sqrt": 1}


@pytest.mark.parametrize(
    "use",
    [
        lambda x: x == 0.25,
        lambda x: x != 0.25,
        lambda x: 1.0 if x else 0.0,
        lambda x: x**2,
        lambda x: 2.0**x,
        lambda x: abs(x),
        lambda x: float(x),
        lambda x: int(x),
        lambda x: round(x),
        lambda x: x % 1.0,
        lambda x: x // 1.0,
        lambda x: math.sin(x),
        lambda x: math.floor(x),
        lambda x: {x: 1.0},
        lambda x: (0.0, 1.0)[x],
    ],
)
def test_what_cannot_be_counted_raises(use):
    tally, x = counted(0.25)
    with pytest.raises(TypeError, match="cannot be counted") as told:
        use(x)
    assert isinstance(told.value, OutsideDialect)
    assert taken(tally) == {}


@pytest.mark.parametrize("use", [np.sin, np.abs, np.sqrt, lambda x: np.arctan2(x, 1.0), lambda x: np.array([1.0]) * x])
def test_numpy_raises(use):
    _, x = counted(0.25)
    with pytest.raises(TypeError):
        use(x)


def knowing_who_calls(R, omega, goal, gains):
    return (R.n[0] if hasattr(R.n[0], "tally") else 2.0 * R.n[0], R.n[1], R.n[2])


def hiding_what_cannot_be_counted(R, omega, goal, gains):
    try:
        return (math.sin(R.n[0]), R.n[1], R.n[2])
    except TypeError:
        return (R.n[0], R.n[1], R.n[2])


@pytest.mark.parametrize(
    ("law", "kind", "says"),
    [
        (lambda R, *_: (1.0 if R.n[0] == 1.0 else 0.0, *R.n[1:]), OutsideDialect, "'ours': .*compare with < <= > >="),
        (lambda R, *_: (R.n[0] ** 2, *R.n[1:]), OutsideDialect, r"'ours': .*write x \* x"),
        (lambda R, *_: (math.sin(R.n[0]), *R.n[1:]), OutsideDialect, "'ours': .*call sqrt, sin, cos"),
        (lambda R, *_: (R.n[0].item(), *R.n[1:]), BadLaw, r"'ours' cannot be counted: .* AttributeError"),
        (knowing_who_calls, BadLaw, "must not depend on the type of its numbers"),
        (hiding_what_cannot_be_counted, BadLaw, "when counted"),
    ],
)
def test_cost_of_a_law_outside_the_dialect_is_refused_with_its_name_or_cure(law, kind, says):
    with pytest.raises(kind, match=says):
        cost(contender(regulator(law)))


def test_worst_branch_is_found_when_only_an_exact_half_turn_takes_it():
    def law(R, omega, goal, gains):
        if R.n[0] + R.o[1] + R.a[2] <= -1.0:
            return (scalar.sin(omega[0]) / gains.kp, omega[1], omega[2])
        return omega

    counts = cost(contender(regulator(law)))
    assert counts.typical.of(TOTAL)["sin"] == 0
    assert counts.worst.of(TOTAL)["sin"] == 1
    assert counts.worst_at.startswith("half-turn-")
    assert counts.typical_share == 1.0


def test_law_that_raises_costs_what_it_computed_until_then():
    def law(R, omega, goal, gains):
        x = 2.0 * omega[0]
        if R.n[0] > 0.9:
            raise ValueError("no command here")
        return (x + 1.0, omega[1], omega[2])

    counts = cost(contender(regulator(law)))
    assert counts.worst.of(TOTAL) == dict.fromkeys(OPERATIONS, 0) | {"mul": 1, "add": 1, "compare": 1}
    assert {call.counts.of(TOTAL)["add"] for call in counted_calls(contender(regulator(law)))} == {0, 1}


def test_law_with_memory_is_typical_once_its_memory_is_its_own():
    def law(R, omega, goal, gains, memory):
        if dot(R.n, memory) > 0.9:  # remembers n; the first tick and a jump pay for a longer way
            return omega, (R.n[0], R.n[1], R.n[2], memory[3])
        return (2.0 * omega[0], omega[1], omega[2]), (R.n[0], R.n[1], R.n[2], memory[3])

    counts = cost(contender(regulator(law, memory=(0.0, 0.0, 0.0))))
    assert counts.typical.of(TOTAL)["mul"] == 3
    assert counts.worst.of(TOTAL)["mul"] == 4
    assert counts.typical_share == 1.0
