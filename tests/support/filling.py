"""Calling a Jacobian's kernels in every representation: what their contract and the invariants share."""

import numpy as np

from bench.law.chain import twist
from bench.law.contenders.registry import contenders
from support.bits import EPS
from support.buffers import as_floats, buffer, of_numbers

EVERY = contenders("jacobians").values()
ON_OMEGA = [(one, None) for one in EVERY if one.takes == "angular-acceleration"]
ON_COORDINATES = [
    (one, coordinates)
    for one in EVERY
    if one.takes == "coordinates"
    for coordinates in contenders("representations").values()
    if coordinates.differentiate is not None or not one.needs_derivatives
]
PAIRS = ON_OMEGA + ON_COORDINATES
# What MuJoCo hands over and what is made of it: products of n rotations, then sums of a few products each.
ROUNDING = 200 * EPS
AWAY = 0.1
"""Margin from the singular set; what is divided by it errs by ROUNDING over its square at most."""


def named(pair):
    one, coordinates = pair
    return one.name if coordinates is None else f"{one.name}-{coordinates.name}"


def rows_of(coordinates):
    return 3 + (3 if coordinates is None else len(coordinates.symbols))


def filled(pair, chain, dtype=float, fill=None):
    """J as the kernel leaves its buffer, NaN where it was not written."""
    one, coordinates = pair
    J = buffer(np.zeros((0, 0)), dtype)
    kernel = fill or one.kernels_in(coordinates)[0]
    chain = of_numbers(chain, dtype)
    with np.errstate(all="ignore"):
        kernel(J, chain, *(() if coordinates is None else (coordinates.chart(chain.R),)))
    return as_floats(J)


def converted(pair, chain, given, dtype=float, convert=None):
    """The six numbers expressed, or as `bias` of the drift."""
    one, coordinates = pair
    kernel = convert or one.kernels_in(coordinates)[1]
    chain, given = of_numbers(chain, dtype), of_numbers(given, dtype)
    with np.errstate(all="ignore"):
        if coordinates is None:
            return as_floats(np.array(kernel(chain, given), dtype=object))
        at, (_, omega) = coordinates.chart(chain.R), twist(chain)
        answer = kernel(chain, at, coordinates.rates(at, omega), omega, given)
        return as_floats(np.array(answer, dtype=object))
