"""The law dialect: that every file a law is made of keeps to it, and that leaving it is noticed."""

from pathlib import Path

import pytest

import bench
from bench.engines.counting.dialect import violations

ROOM = Path(bench.__file__).parent
FILES = [*(ROOM / "law").glob("linalg/*.py"), *(ROOM / "law" / f"{name}.py" for name in ("so3", "chain", "weighting"))]
FILES += [ROOM / "law" / "control" / f"{name}.py" for name in ("hybrid", "impedance")]

LAW = '''"""A law."""

from bench.law.kinds import Law
from bench.law.scalar import kernel, sin
from bench.law.so3 import cross


def law_in(representation):
    chart = representation.chart

    @kernel
    def law(R, omega, goal, gains):
        """u = 0."""
        x = chart(R).E[0]
        {statement}
        return (x, x, x)

    return law
'''


def found_in(statement):
    return violations(LAW.replace("{statement}", statement))


@pytest.mark.parametrize("path", [path for path in FILES if path.stem != "__init__"], ids=lambda path: path.stem)
def test_file_keeps_to_the_dialect(path):
    assert violations(path.read_text()) == []


@pytest.mark.parametrize(
    "line",
    [
        *("import math", "import numpy as np", "from math import sin", "from os import path", "from bench import law"),
    ],
)
def test_import_is_outside_the_dialect(line):
    [told] = violations(f"{line}\n{LAW.replace('{statement}', 'pass')}")
    assert told.startswith("line 1: ")


@pytest.mark.parametrize(
    "statement",
    [
        "x = x + 2 * sin(x) - x / 3.0",
        "x = -x if x > 0.0 else x",
        "for i in range(3): x = x + omega[i]",
        "n, o, a = cross(R.n, goal.R.n)",
        "x *= x",
        "x = x if 0.0 < x <= 1.0 and not omega[0] < x else omega[0]",
    ],
)
def test_statement_is_in_the_dialect(statement):
    assert found_in(statement) == []


@pytest.mark.parametrize(
    "statement",
    [
        "x = x ** 2",
        "x **= 2",
        "x = x % 2.0",
        "x = x // 2.0",
        "x = x if x == 0.0 else 1.0",
        "x = x if x != 0.0 else 1.0",
        "x = x if 0.0 < x == 1.0 else 1.0",
        "x = x if x in omega else 1.0",
        "x = abs(x)",
        "x = max(x, 0.0)",
        "x = float(x)",
        "x = math.sin(x)",
        "x = np.sin(x)",
        "x = x.sqrt()",
        "x = representation.chart(R).E[1]",
        "for part in omega: x = x + part",
        "while x > 1.0: x = x / 2.0",
        "x = sum([part for part in omega])",
        "x = (lambda y: y)(x)",
        "assert x > 0.0",
        "raise ValueError",
        "import math",
        "from numpy import sin as sine",
        "global y",
        "try:\n            x = sin(x)\n        except ValueError:\n            x = 0.0",
    ],
)
def test_statement_is_outside_the_dialect(statement):
    assert found_in(statement)


def test_violation_says_line_text_and_what_is_allowed():
    assert found_in("x = x ** 2") == ["line 15: `x ** 2`: the dialect has + - * / only"]
