"""Code in C does what Python does with the same text: each construct of the loops' dialect, on numbers that tell."""

import ast
import linecache
import math
import runpy
from typing import NamedTuple

import numpy as np
import pytest

from bench.base.errors import BadLaw
from bench.engines.arrays import Matrix, Three, Vector
from bench.engines.in_c import compile_signature, compiler
from bench.engines.signatures import Signature
from bench.law.scalar import kernel
from bench.translation.source import tree_of

pytestmark = pytest.mark.skipif(not compiler(), reason="no C compiler here, or numba is wanted")

INTEGERS = (-7, -3, -1, 0, 1, 2, 5)
REALS = (-1.5, -0.0, 0.0, 0.25, 3.0, math.inf, math.nan)


class Pair(NamedTuple):
    """A record with a default."""

    first: float
    second: float = 2.0


class Asked(NamedTuple):
    """A record of an array and a number."""

    row: Vector
    count: int


@kernel
def floor_and_rest(a: int, b: int) -> tuple[int, int]:
    """Divide whole numbers."""
    return a // b, a % b


@kernel
def divide(a: int, b: int) -> float:
    """Divide whole numbers into a real one."""
    return a / b


@kernel
def count_down(a: int, b: int) -> int:
    """Count with `while`, `continue` and `break`."""
    steps = 0
    while a > -20:
        a -= 1
        if a % 3 == 0:
            continue
        steps += 2
        if steps > b + 9:
            break
    return steps


@kernel
def widen(a: int, b: int) -> float:
    """Hold a whole number at first, then a real one."""
    total = 0
    for i in range(3):
        total = total + 0.5 * i * a
    return total + b


@kernel
def chain_bits(a: int, b: int) -> int:
    """Combine comparisons, `&`, `|`, `and`, `or`, `not` and a choice."""
    small = -2 <= a < 3
    both = (a > 0) & (b > 0)
    either = a == 0 or not b <= 1
    return (4 if small else 0) + (2 if both else 0) + (1 if either and not both else 0)


@kernel
def swap(a: int, b: int) -> tuple[int, int]:
    """Assign several names at once, each from what they were before."""
    a, b = b, a + b
    a, b = b - a, a
    return a, b


@pytest.mark.parametrize("function", [floor_and_rest, divide, count_down, widen, chain_bits, swap])
def test_whole_numbers_are_python_s(function):
    hints = function.__annotations__
    code = compile_signature(function, Signature((int, int), hints["return"]), is_users=True)
    for a in INTEGERS:
        for b in (-4, -1, 1, 3):
            assert code(a, b) == function(a, b), (a, b)


@kernel
def least_and_most(x: float, y: float) -> tuple[float, float]:
    """Take min and max, of which Python gives the first where two do not compare."""
    return min(x, y), max(x, y)


@kernel
def square_and_sign(x: float, y: float) -> Three:
    """Take a square, an absolute value, and a sign."""
    return (x**2, abs(y), math.copysign(1.0, x))


@kernel
def pair_up(x: float, y: float) -> tuple[float, float, float, float]:
    """Build records, one with a default, and join tuples."""
    pair, other = Pair(x), Pair(second=x, first=y)
    return (pair.first, pair.second) + (other.first, other.second)  # noqa: RUF005


@kernel
def spread(x: float, y: float) -> tuple[float, float, float]:
    """Spread a tuple in another."""
    pair = (x, y)
    return (*pair, float("nan"))


@kernel
def guard(x: float, y: float) -> float:
    """Write the body of `try`."""
    try:
        z = x - y
    except ArithmeticError:
        z = 0.0
    return z


@kernel
def refuse_large(x: float) -> float:
    """Raise where x is large."""
    if x > 2.0:
        raise ValueError("large")
    return x


@kernel
def guard_twice(x: float, y: float) -> tuple[float, float]:
    """Catch an error of a callee, and raise another in a handler that is caught outside."""
    z = 0.0
    try:
        try:
            z = refuse_large(x) + y
        except ValueError:
            z = refuse_large(y)
        w = z
    except Exception:
        w = -1.0
    return z, w


@pytest.mark.parametrize("function", [least_and_most, square_and_sign, pair_up, spread, guard, guard_twice])
def test_real_numbers_are_python_s_to_the_bit(function):
    hints = function.__annotations__
    code = compile_signature(function, Signature((float, float), hints["return"]), is_users=True)
    for x in REALS:
        for y in REALS:
            got, wanted = np.array(code(x, y)), np.array(function(x, y))
            assert np.array_equal(got, wanted, equal_nan=True), (x, y)
            assert np.array_equal(np.signbit(got)[wanted == 0], np.signbit(wanted)[wanted == 0]), (x, y)


@kernel
def fill(A, b, asked):
    """Write elements, rows and parts of arrays."""
    rows, columns = A.shape[0], A.shape[1]
    for i in range(rows):
        row = A[i]
        for j in range(columns):
            row[j] = 10.0 * i + j
    part = b[1:3]
    part[0], part[1] = b[0], b[3]
    A[0, 0], A[1, 1] = A[1, 1], A[0, 0]
    last = A[rows - 1, 1:]
    last[0] += len(b)
    asked.row[asked.count] = 1.0


def test_arrays_are_python_s():
    code = compile_signature(fill, Signature((Matrix, Vector, Asked), None), is_users=True)
    given, wanted = ((np.zeros((2, 3)), np.arange(4.0), Asked(np.zeros(2), 1)) for _ in range(2))
    code(*given)
    fill(*wanted)
    assert np.array_equal(given[0], wanted[0])
    assert np.array_equal(given[1], wanted[1])
    assert np.array_equal(given[2].row, wanted[2].row)


def test_an_array_of_another_kind_is_refused():
    code = compile_signature(fill, Signature((Matrix, Vector, Asked), None), is_users=True)
    with pytest.raises(TypeError, match="wanted: contiguous, float64, 2"):
        code(np.zeros((3, 2)).T, np.zeros(4), Asked(np.zeros(2), 1))
    with pytest.raises(TypeError, match="an array of int64"):
        code(np.zeros((2, 3), np.int64), np.zeros(4), Asked(np.zeros(2), 1))


def made_with(hook, limit):
    """Return a function that calls another one, or none, which is known when the code is written."""

    @kernel
    def limited(x):
        y = hook(x) if hook is not None else x
        if limit is None:
            return y
        return min(y, limit)

    return limited


@pytest.mark.parametrize(
    ("hook", "limit"), [(None, None), (None, 2.0), (math.cos, None), (math.fabs, 1.0)], ids=str
)
def test_what_is_known_when_the_code_is_written_is_decided_then(hook, limit):
    function = made_with(hook, limit)
    code = compile_signature(function, Signature((float,), float), is_users=True)
    assert [code(x) for x in (-3.0, 0.5, 9.0)] == [function(x) for x in (-3.0, 0.5, 9.0)]


@kernel
def take(b):
    """Write into an array."""
    b[0] = b[0] + 1.0
    return b[0]


@kernel
def read_beside(b):
    """Call what writes beside what reads."""
    return take(b) * b[0]


@kernel
def power(x):
    """Raise to another power than the square."""
    return x**3


@kernel
def build_list(x):
    """Build a list."""
    return [x, x][0]


@kernel
def change_kind(x):
    """Use one name for a number and a tuple."""
    y = x
    y = (x, x)
    return y[0]


@kernel
def look_up(x):
    """Read a name that is nowhere."""
    return x + nowhere  # noqa: F821


@kernel
def fall_off(x):
    """Return nothing on one path."""
    if x > 0.0:
        return x


@kernel
def call_itself(x):
    """Call itself."""
    return x if x < 1.0 else call_itself(x - 1.0)


@pytest.mark.parametrize(
    ("function", "hint", "words"),
    [
        (fall_off, float, "fall_off: a path of it returns nothing"),
        (call_itself, float, "call_itself calls itself"),
        (read_beside, Vector, "read_beside: `take.b. . b.0.` has a call that writes into an array beside"),
        (power, float, r"power: `x \*\* 3` cannot be translated"),
        (build_list, float, r"build_list: `\[x, x\]` cannot be translated"),
        (change_kind, float, "change_kind: 'y' is real and becomes .*; use another name"),
        (look_up, float, "'nowhere' is not defined"),
    ],
)
def test_what_c_would_do_otherwise_is_refused_by_function_and_expression(function, hint, words):
    with pytest.raises(BadLaw, match=words):
        compile_signature(function, Signature((hint,), float), is_users=True)


def test_function_whose_file_was_edited_after_its_import_is_refused(tmp_path):
    path = tmp_path / "edited.py"
    path.write_text("def double(x):\n    return 2.0 * x\n")
    function = runpy.run_path(str(path))["double"]
    path.write_text("def double(x):\n    return 2.0 + x\n")
    with pytest.raises(BadLaw, match="double was edited while this ran; run it again"):
        tree_of(function)
    linecache.clearcache()
    path.write_text("# a comment\ndef double(x):\n    return 2.0 * x\n")
    assert ast.unparse(tree_of(function)) == "def double(x):\n    return 2.0 * x"
