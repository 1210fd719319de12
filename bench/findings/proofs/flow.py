"""Motions of an angle from rest, enclosed for every P of an interval: Taylor polynomials with remainders (Arb).

The equation and its variables are those of `settling_time`. In the mean-value form, x(P) lies in
x(P_mid) + (dx/dP)([P]) (P - P_mid). Each step's remainder is the last Taylor coefficient
over an enclosure of the whole step, which is found by Picard's iteration.
"""

import functools
import math
import operator
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from flint import arb, arb_series, ctx

from bench.base.bisection import bisect

ORDER, TERMS, ACCURACY = 9, 14, 1e-5
"""The order of Taylor polynomials in time, the terms of the series of c and s, and the widest remainder of a step."""
STEP_S, SHORTEST_S, LONGEST_S = 0.02, 0.001, 1.2


class Unenclosed(Exception):
    """A motion that is not known well enough: shorten the step, or the interval of P."""


class FlowEquation(NamedTuple):
    """N(z, v, c, s, P), its partial derivatives, and bounds of the slope of u/p by x within the band."""

    N: Callable[..., Any]
    slopes: list[Callable[..., Any]]
    softest: arb
    hardest: arb


def turned_by(x: arb, P: arb) -> tuple[arb, arb, arb, arb]:
    """Return c, s and their derivatives by P at x, by their series, since P may hold zero.

    c = (1 - cos(p x/2))/P = (x^2/4) (1/2! - u/4! + ...), s = (x/2 - sin(p x/2)/p)/P = (x^3/8) (1/3! - u/5! + ...) with
    u = P x^2/4.
    """
    u, found = P * x * x / 4, []
    if not abs(u) < 100:  # or the terms left out would not be smaller than the last
        raise Unenclosed
    for power in (2, 3):
        terms = [arb((-1) ** k) / math.factorial(2 * k + power) for k in range(TERMS + 1)]
        value, slope = (
            arb(0, abs(terms[-1] * u**TERMS).upper()),
            arb(0, abs(TERMS * terms[-1] * u ** (TERMS - 1)).upper()),
        )
        for k in reversed(range(TERMS)):
            value, slope = value + terms[k] * u**k, slope + (k * terms[k] * u ** (k - 1) if k else 0)
        found.append(((x / 2) ** power * value, (x / 2) ** (power + 2) * slope))
    (c, c_P), (s, s_P) = found
    return c, s, c_P, s_P


class Step(NamedTuple):
    """Taylor polynomials of xi, of upsilon and of their derivatives by P over one step, and an enclosure of v."""

    polynomials: list[list[arb]]
    v: arb

    def at(self, time: float, a: arb) -> list[arb]:
        """Return x, y = v + a x and their derivatives by P at a time from the step's beginning."""
        t = arb(time)
        return [(-a * t).exp() * functools.reduce(lambda sum_, k: sum_ * t + k, one[::-1]) for one in self.polynomials]


class Flow:
    """Motions for every P of an interval, and their derivatives by P."""

    def __init__(self, equation: FlowEquation, a: arb, P: arb) -> None:
        self.equation, self.a, self.P = equation, a, P

    def complete(self, begin: Sequence[arb], grows: arb) -> list[arb]:
        """Return xi, upsilon, c and s, and the derivatives of all four by P, from those of xi and upsilon."""
        xi, upsilon, dxi, dupsilon = begin
        x, dx = xi / grows, dxi / grows
        c, s, c_P, s_P = turned_by(x, self.P)
        return [xi, upsilon, c, s, dxi, dupsilon, c_P + (x / 2 - self.P * s) / 2 * dx, s_P + c / 2 * dx]

    def rates(self, state: Sequence[Any], grows: Any) -> list[Any]:
        """Return the time derivatives of a state that `complete` has made, with grows = exp(a t)."""
        xi, upsilon, c, s, dxi, dupsilon, dc, ds = state
        x, v, dx, dv = (one / grows for one in (xi, upsilon - self.a * xi, dxi, dupsilon - self.a * dxi))
        z, dz = x / 2 - self.P * s, dx / 2 - self.P * ds - s
        at = z, v, c, s, self.P
        parts = zip(self.equation.slopes, (dz, dv, dc, ds, 1), strict=True)
        push = functools.reduce(operator.add, (slope(*at) * change for slope, change in parts))
        first = [upsilon, grows * self.equation.N(*at), z * v / 2, c * v / 2]
        return [*first, dupsilon, grows * push, (dz * v + z * dv) / 2, (dc * v + c * dv) / 2]

    def expand(self, begin: Sequence[arb], grows: arb) -> list[list[arb]]:
        """Return the Taylor coefficients of xi, upsilon and their derivatives by P, from there."""
        first = [arb_series([one]) for one in self.complete(begin, grows)]
        state, growing = first, (arb_series([0, 1]) * self.a).exp() * grows
        for _ in range(ORDER):
            rates = self.rates(state, growing)
            state = [one + arb_series(rate).integral() for one, rate in zip(first, rates, strict=True)]
        return [[state[place][k] for k in range(ORDER + 1)] for place in (0, 1, 4, 5)]

    def step(self, begin: Sequence[arb], h: float) -> Step:
        """Return the step of [0, h] from x, y = v + a x and their derivatives by P; Unenclosed: none is found."""
        during = arb(0).union(arb(h))
        grows, box = (self.a * during).exp(), list(begin)
        for _ in range(12):
            rates = self.rates(self.complete(box, grows), grows)
            image = [one + during * rates[place] for one, place in zip(begin, (0, 1, 4, 5), strict=True)]
            if all(outer.contains(inner) for outer, inner in zip(box, image, strict=True)):
                break
            box = [one.union(other) for one, other in zip(box, image, strict=True)]
            box = [one + arb(0, 0.2 * float(one.rad()) + 1e-12) for one in box]
        else:
            raise Unenclosed
        near, over = self.expand(begin, arb(1)), self.expand(image, grows)
        if any(float((one[-1] * arb(h) ** ORDER).rad()) > ACCURACY for one in over):
            raise Unenclosed
        joined = [[*one[:-1], whole[-1]] for one, whole in zip(near, over, strict=True)]
        return Step(joined, (image[1] - self.a * image[0]) / grows)


def enclose(
    equation: FlowEquation, a: arb, p: tuple[float, float], tolerance: arb
) -> tuple[float, float]:
    """Return times before and after which the angle comes to stay below the tolerance, for every p of an interval.

    The equation holds while v < 0 < x: at v = 0 < x the spring pulls back, and x > 0 is checked at every step's end.
    Unenclosed: not found within LONGEST_S, or x is not above zero.
    """
    ctx.cap = ORDER + 1
    low, high = (arb(one) ** 2 if one < math.pi else arb.pi() ** 2 for one in p)
    P = low.union(high)
    flows, away = (Flow(equation, a, P.mid()), Flow(equation, a, P)), P - P.mid()
    lower = upper = None
    centre, change, x, began, h = [arb(1), a], [arb(0), arb(0)], arb(1), 0.0, STEP_S
    while began < LONGEST_S:
        all_ = [at + by * away for at, by in zip(centre, change, strict=True)]
        try:
            path, every = flows[0].step([*centre, arb(0), arb(0)], h), flows[1].step([*all_, *change], h)
        except (Unenclosed, ValueError):  # flint's ValueError: it would divide by an interval that holds zero
            h = h / 2
            if h < SHORTEST_S:
                raise Unenclosed from None
            continue

        def angle(t: float, path: Step = path, every: Step = every) -> arb:
            return path.at(t, a)[0] + every.at(t, a)[2] * away

        before, centre, change = x, path.at(h, a)[:2], every.at(h, a)[2:]
        x, y = (at + by * away for at, by in zip(centre, change, strict=True))
        if not x > 0:
            raise Unenclosed
        if lower is None and not x > tolerance:
            lower = began + bisect(lambda t: angle(t) > tolerance, 0.0, h, 20)[0]
        if upper is None and x < tolerance and every.v < 0:
            upper = began + bisect(lambda t: not angle(t) < tolerance, 0.0, h, 20)[1]
        elif upper is not None and not (every.v < 0 and before < tolerance):
            upper = None  # it may have left the band again
        if upper is not None and (y - a * x) ** 2 + x**2 * equation.hardest < tolerance**2 * equation.softest:
            return lower or 0.0, upper
        began, h = began + h, min(2 * h, STEP_S)
    raise Unenclosed
