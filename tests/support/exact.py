"""Numbers of 80 digits that kernels can be called with: what a law's functions are without rounding.

`scalar` hands sqrt, sin, cos, ... to any number that has a `tally`, as it does for counting scalars. A kernel so
called is differentiated along a path of coordinates by central differences with a step of 1e-20, whose error of
1e-40 no double can see. This is the oracle for B, its inverse and its derivative in any representation.
"""

import mpmath

EXACT = mpmath.mp.clone()
EXACT.dps = 80
STEP = EXACT.mpf(10) ** -20


class Exact:
    """One real number of 80 digits with the arithmetic and the functions of the law dialect."""

    tally = None

    def __init__(self, value):
        self.value = value.value if isinstance(value, Exact) else EXACT.mpf(value)

    def __add__(self, other):
        return Exact(self.value + Exact(other).value)

    def __sub__(self, other):
        return Exact(self.value - Exact(other).value)

    def __rsub__(self, other):
        return Exact(other) - self

    def __mul__(self, other):
        return Exact(self.value * Exact(other).value)

    def __truediv__(self, other):
        return Exact(self.value / Exact(other).value)

    def __rtruediv__(self, other):
        return Exact(other) / self

    def __neg__(self):
        return Exact(-self.value)

    def __lt__(self, other):
        return self.value < Exact(other).value

    def __le__(self, other):
        return self.value <= Exact(other).value

    def __gt__(self, other):
        return self.value > Exact(other).value

    def __ge__(self, other):
        return self.value >= Exact(other).value

    __radd__, __rmul__ = __add__, __mul__

    def sqrt(self):
        return Exact(EXACT.sqrt(self.value))

    def sin(self):
        return Exact(EXACT.sin(self.value))

    def cos(self):
        return Exact(EXACT.cos(self.value))

    def acos(self):
        return Exact(EXACT.acos(self.value))

    def atan2(self, x):
        return Exact(EXACT.atan2(self.value, Exact(x).value))

    def ratan2(self, y):
        return Exact(y).atan2(self)

    def copysign(self, sign):
        size = abs(self.value)
        return Exact(-size if Exact(sign).value < 0 else size)

    def rcopysign(self, magnitude):
        return Exact(magnitude).copysign(self)


def exact_matrix(to_matrix, E):
    """to_matrix(E) as a matrix of 80 digits."""
    columns = to_matrix(tuple(Exact(x) for x in E))
    return EXACT.matrix([[columns[j][i].value for j in range(3)] for i in range(3)])


def motion(to_matrix, E, Edot, Eddot=(0.0, 0.0, 0.0, 0.0)):
    """(omega, omegadot), base frame, of the path E + Edot t + Eddot t^2/2 at t = 0.

    [omega]x = Rdot R^T (Murphy 1988, 2.7), and [omegadot]x is the skew part of Rddot R^T.
    """

    def at(t):
        return exact_matrix(to_matrix, [_taylor(t, *terms) for terms in zip(E, Edot, Eddot, strict=False)])

    behind, here, ahead = at(-STEP), at(0), at(STEP)
    first = (ahead - behind) / (2 * STEP)
    second = (ahead - 2 * here + behind) / STEP**2
    return _axial(first * here.T), _axial(second * here.T)


def _taylor(t, e, edot, eddot):
    return EXACT.mpf(e) + t * EXACT.mpf(edot) + t * t * EXACT.mpf(eddot) / 2


def _axial(A) -> list:
    """The vector w of the skew part of A, [w]x."""
    return [(A[2, 1] - A[1, 2]) / 2, (A[0, 2] - A[2, 0]) / 2, (A[1, 0] - A[0, 1]) / 2]


def exact_B(to_matrix, E):
    """B(E) of omega = B Edot (Murphy 1988, 2.8), by differentiating to_matrix."""
    count = len(E)
    units = [[int(i == j) for i in range(count)] for j in range(count)]
    images = [motion(to_matrix, E, unit)[0] for unit in units]
    return EXACT.matrix([[images[j][i] for j in range(count)] for i in range(3)])


def solved(A, right) -> list:
    """A^-1 times a vector, to 80 digits less the condition number."""
    answer = EXACT.lu_solve(A, EXACT.matrix([EXACT.mpf(x) for x in right]))
    return list(answer)


def rows_of(A) -> list[list]:
    """A matrix as lists of its rows."""
    return [[A[i, j] for j in range(A.cols)] for i in range(A.rows)]
