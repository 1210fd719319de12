"""The longest settling time from rest, as a theorem: the angle's equation, integrated with intervals (Arb).

A law turns a body from rest about one fixed axis, from the angle p. With x = theta/p, whatever p, 0 included,

    x'' = -u/p,   x(0) = 1,   x'(0) = 0        settled for good once |x| stays below the tolerance

u is traced from the law's own source on the axis. Its cosine and sine of theta/2 are written as

    w = 1 - P c,   z = sin(theta/2)/p = x/2 - P s,   P = p^2,   c' = z v/2,   s' = c v/2

so that the linear part cancels in symbols, before anything is rounded. With a = Kv/2, xi = exp(a t) x and
upsilon = exp(a t) (v + a x) the linear system of Kp = a^2 has N = 0, and xi' = upsilon, upsilon' = exp(a t) N with
N = -u/p + Kv v + a^2 x (`flow`).

After the last crossing V = v^2/2 + Kp U/p^2 is smaller than at the edge of the band. V does not increase (the descent
theorem), so the angle cannot leave the band again. The memory is reset, and at 180° the law turns to one side. The
greatest time over p in [0, pi] is found by bisection of p, the intervals with the latest end first.
"""

import heapq
import itertools
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import sympy as sp
from flint import arb

from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.flow import FlowEquation, Unenclosed, enclose, turned_by
from bench.findings.proofs.paths import Angle
from bench.findings.proofs.solver import Solver
from bench.findings.proofs.theorem import DoesNotFit
from bench.findings.proofs.trace import Symbols
from bench.findings.proofs.traced_number import Traced, is_same, is_zero
from bench.law.inputs import PAPERS_GAINS, Gains, Goal
from bench.law.kinds import Law
from bench.law.so3 import IDENTITY, Rotation, from_quaternion
from tasks.rules import RULES

PARTS, WIDTH_S, NARROWEST_RAD = 16, 5e-4, 1e-4
Z, V, C, S, P = sp.symbols("z v c s P")


class Bound(NamedTuple):
    """No start at rest settles later than `upper` [s], rounded up to 0.1 ms; one settles at `lower` or later."""

    lower: float
    upper: float
    intervals: int


def trace_on_axis(law: Law, gains: Gains) -> Any:
    """Return the command about the axis over p, on the way from rest to the goal, in z, v, c, s and P."""
    symbols = Symbols(("w", "z", "rate", "half"), ("w", "z", "rate", "half"))
    z, w, rate = symbols["z", "w", "rate"]
    symbols.relate("w", 1 - z**2)
    symbols.angles.append(Angle(z, w, symbols.of["half"]))
    zero = symbols.number(0)
    R = from_quaternion((w, zero, zero, -z))
    one = tuple(tuple(symbols.number(part) for part in column) for column in IDENTITY)
    memory = () if law.memory is None else (tuple(symbols.number(part) for part in law.memory),)
    solver, found = Solver(symbols), list[Traced]()
    below_1 = PolynomialRelation((w - 1).value.numer, "<")
    kp_kv: Any = map(symbols.number, gains)
    given = (R, (zero, zero, rate), Goal(Rotation(*one)), Gains(*kp_kv), *memory)
    evaluate: Any = law.law
    for path in symbols.paths(lambda: evaluate(*given)):
        if solver.find(path, below_1).answer == "unsat":
            continue
        u = path.answer[0] if memory else path.answer
        u = tuple(map(symbols.number, u))
        if not (is_zero(u[0]) and is_zero(u[1])):
            raise DoesNotFit("it does not keep the axis of the turn")
        if path.meanings:
            raise DoesNotFit("its command has a root that does not vanish on the axis")
        if not all(is_same(u[2], other) for other in found):
            raise DoesNotFit("its command has a corner between 0 and 180°")
        found.append(u[2])
    p = sp.Symbol("p", positive=True)
    turned = {"w": 1 - p**2 * C, "z": p * Z, "rate": -p * V, "half": p * (Z + p**2 * S)}
    command = sp.cancel(found[0].value.as_expr().subs(turned, simultaneous=True) / p)
    return sp.cancel(command.subs(p, sp.sqrt(P)))


def make_equation(law: Law, gains: Gains, tolerance: arb) -> FlowEquation:
    """Return the equation of a law at gains that are whole numbers."""
    command, kv = trace_on_axis(law, gains), sp.Rational(gains.kv)
    N = sp.cancel(-command + kv * V + kv**2 / 2 * (Z + P * S))
    at_rest = command.subs(V, 0)
    slope = sp.diff(at_rest, Z) * (1 - P * C) / 2 + sp.diff(at_rest, C) * Z / 2 + sp.diff(at_rest, S) * C / 2
    x, square = arb(0).union(tolerance), arb(0).union(arb.pi() ** 2)
    c, s = turned_by(x, square)[:2]
    within = compile_function(sp.cancel(slope))(x / 2 - square * s, arb(0), c, s, square)
    slopes = [compile_function(sp.cancel(sp.diff(N, one))) for one in (Z, V, C, S, P)]
    return FlowEquation(compile_function(N), slopes, within.lower(), within.upper())


def compile_function(expression: Any) -> Callable[..., Any]:
    """Return a rational function of z, v, c, s and P that computes with whole numbers alone, its factors kept."""
    of = Z, V, C, S, P
    numer, denom = (sp.Poly(one, *of) for one in sp.fraction(sp.together(expression)))
    scale = sp.ilcm(*(one.q for one in (*numer.coeffs(), *denom.coeffs())))
    top, below = (sp.lambdify(of, gather(scale * one), modules=[{}]) for one in (numer, denom))
    return lambda z, *others: (0 * z + top(z, *others)) / (0 * z + below(z, *others))


def gather(polynomial: sp.Poly) -> Any:
    """Return a polynomial by powers of z and v, what each is multiplied with as a product of factors."""
    by_power = sp.Poly(polynomial.as_expr(), Z, V)
    return sum(sp.factor(factor) * Z**i * V**j for (i, j), factor in by_power.terms())


def bound(law: Law, gains: Gains = PAPERS_GAINS) -> Bound:
    """Return bounds of the longest settling time from rest, WIDTH_S apart; DoesNotFit: none is found."""
    tolerance, a = arb(str(RULES.tolerance)), arb(gains.kv) / 2
    equation = make_equation(law, gains, tolerance)
    c, s, *_ = turned_by(arb(1), arb.pi() ** 2)
    from_180 = a**2 - equation.N(arb("0.5") - arb.pi() ** 2 * s, arb(0), c, s, arb.pi() ** 2)
    if not from_180 > 0:
        is_dead = from_180.is_finite()
        raise DoesNotFit("a 180° rotation is an equilibrium" if is_dead else "its command has no bound at 180°")
    ends = [k * math.pi / PARTS for k in range(PARTS)] + [math.pi]
    lower, count = 0.0, 0
    waiting: list[tuple[float, float, float]] = []
    for begin, end in itertools.pairwise(ends):
        heapq.heappush(waiting, (-math.inf, begin, end))
    while -waiting[0][0] > lower + WIDTH_S:
        _, begin, end = heapq.heappop(waiting)
        if end - begin < NARROWEST_RAD:
            raise DoesNotFit(f"its settling time grows without a bound, or is not found, at {math.degrees(end):.0f}°")
        middle = 0.5 * (begin + end)
        for part in ((begin, middle), (middle, end)):
            high = part[1]
            count += 1
            try:
                lower = max(lower, enclose(equation, a, (high, high), tolerance)[0])
                upper = enclose(equation, a, part, tolerance)[1]
            except Unenclosed:
                upper = math.inf
            heapq.heappush(waiting, (-upper, *part))
    return Bound(lower, math.ceil(-1e4 * waiting[0][0]) / 1e4, count)
