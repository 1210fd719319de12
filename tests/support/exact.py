"""Numbers of 80 digits that kernels can be called with: what a law's functions are without rounding.

`scalar` hands sqrt, sin, cos, ... to any number that has a `tally`, as it does for counting scalars. A kernel so
called is differentiated along a path of coordinates by central differences with a step of 1e-20, whose error of
1e-40 no double can see. This is the oracle for B, its inverse and its derivative in any representation.
"""

import mpmath

EXACT = mpmath.mp.clone()
EXACT.dps = 80
STEP = EXACT.mpf(10) ** -20


# functions of mpmath as methods of its numbers, which is how the law dialect calls them
EXACT.mpf.tally = None
for _name in ("sqrt", "sin", "cos", "acos", "atan2"):
    setattr(EXACT.mpf, _name, lambda *numbers, name=_name: getattr(EXACT, name)(*numbers))
EXACT.mpf.ratan2 = lambda x, y: EXACT.atan2(y, x)
EXACT.mpf.copysign = lambda x, sign: -abs(x) if sign < 0 else abs(x)
EXACT.mpf.rcopysign = lambda sign, x: EXACT.mpf(x).copysign(sign)


def path(to_matrix, E, Edot, Eddot):
    """Return R, Rdot and Rddot of the path E + Edot t + Eddot t^2/2 at t = 0."""

    def at(t):
        terms = ([EXACT.mpf(x) for x in each] for each in zip(E, Edot, Eddot, strict=False))
        return EXACT.matrix(to_matrix(tuple(e + t * d + t * t * a / 2 for e, d, a in terms))).T

    behind, R, ahead = at(-STEP), at(0), at(STEP)
    return R, (ahead - behind) / (2 * STEP), (ahead - 2 * R + behind) / STEP**2


def motion(to_matrix, E, Edot, Eddot=(0.0, 0.0, 0.0, 0.0)):
    """(omega, omegadot), base frame: [omega]x = Rdot R^T (Murphy 1988, 2.7), [omegadot]x the skew part of Rddot R^T."""
    R, first, second = path(to_matrix, E, Edot, Eddot)
    return _axial(first * R.T), _axial(second * R.T)


def _axial(A) -> list:
    """The vector w of the skew part of A, [w]x."""
    return [(A[2, 1] - A[1, 2]) / 2, (A[0, 2] - A[2, 0]) / 2, (A[1, 0] - A[0, 1]) / 2]


def exact_B(to_matrix, E):
    """B(E) of omega = B Edot (Murphy 1988, 2.8), by differentiating to_matrix."""
    count = len(E)
    units = [[int(i == j) for i in range(count)] for j in range(count)]
    images = [motion(to_matrix, E, unit)[0] for unit in units]
    return EXACT.matrix([[images[j][i] for j in range(count)] for i in range(3)])
