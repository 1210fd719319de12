"""The longest settling time from rest, as a theorem: the angle's equation, integrated with intervals (Arb).

A law turns a body from rest about one fixed axis, from the angle p. With x = theta/p, whatever p, 0 included,

    x'' = -u/p,   x(0) = 1,   x'(0) = 0        settled for good once |x| stays below the tolerance

u is traced from the law's own source on the axis. Its cosine and sine of theta/2 are written as

    w = 1 - P c,   z = sin(theta/2)/p = x/2 - P s,   P = p^2,   c' = z v/2,   s' = c v/2

so that what a linear spring does cancels before anything is rounded. With a = Kv/2, xi = exp(a t) x and
upsilon = exp(a t) (v + a x) the linear system stands still, and xi' = upsilon, upsilon' = exp(a t) N with
N = -u/p + Kv v + a^2 x. Each step is a Taylor polynomial with its remainder over an enclosure of the whole step.

After the last crossing V = v^2/2 + Kp U/p^2 is below what it is at the edge of the band; the descent theorem does the
rest. The greatest time over p in [0, pi] is found by bisection of p, the intervals with the latest end first.
"""

import functools
import heapq
import itertools
import math
import operator
from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import sympy as sp
from flint import arb, arb_series, ctx

from bench.base.bisection import bisect
from bench.findings.proofs.solver import Solver
from bench.findings.proofs.theorem import DoesNotFit
from bench.findings.proofs.trace import Symbols, Traced
from bench.law.inputs import PAPERS_GAINS, Gains, Goal
from bench.law.kinds import Law
from bench.law.so3 import IDENTITY, Rotation, from_quaternion
from tasks.rules import RULES

ORDER, TERMS, PARTS, ACCURACY = 9, 14, 16, 1e-5
STEP_S, SHORTEST_S, LONGEST_S, WIDTH_S, NARROWEST_RAD = 0.02, 0.001, 1.2, 5e-4, 1e-4
Z, V, C, S, P = sp.symbols("z v c s P")


class Bound(NamedTuple):
    """No start at rest settles later than `upper` [s], and one settles at `lower` or later."""

    lower: float
    upper: float
    intervals: int


class Equation(NamedTuple):
    """N(z, v, c, s, P), its partial derivatives, and bounds of the spring's slope within the band."""

    N: Callable[..., Any]
    slopes: list[Callable[..., Any]]
    softest: float
    hardest: float


def trace_on_axis(law: Law, gains: Gains) -> Any:
    """Return the command about the axis over p, on the way from rest to the goal, in z, v, c, s and P.

    Errors:
        DoesNotFit: it has a corner on its way, or turns about another axis too.
    """
    symbols = Symbols(("z", "w", "rate", "half"), ("z", "w", "rate", "half"))
    z, w, rate = symbols["z", "w", "rate"]
    symbols.relate("z", 1 - w**2)
    symbols.angles[z, w] = symbols.of["half"]
    zero = symbols.number(0)
    R = from_quaternion((w, zero, zero, -z))
    one = tuple(tuple(symbols.number(part) for part in column) for column in IDENTITY)
    memory = () if law.memory is None else (tuple(symbols.number(part) for part in law.memory),)
    solver, found = Solver(symbols), list[Traced]()
    given = (R, (zero, zero, rate), Goal(Rotation(*one)), Gains(*map(symbols.number, gains)), *memory)
    for path in symbols.paths(lambda: law.law(*given)):  # type: ignore[misc]
        if solver.find(*solver.condition(path), solver.of["w"] < 1)[0] == "unsat":
            continue
        u = path.answer[0] if memory else path.answer
        if u[0] != 0 or u[1] != 0:
            raise DoesNotFit("it does not keep the axis of the turn")
        if path.meanings:
            raise DoesNotFit("its command has a root that does not vanish on the axis")
        if any(u[2] != other for other in found):
            raise DoesNotFit("its command has a corner between 0 and 180°")
        found.append(u[2])
    p = sp.Symbol("p", positive=True)
    z_, w_ = sp.symbols("z w")
    numer, denom = sp.fraction(sp.together(found[0].value.as_expr()))
    even, odd = (sp.expand(numer).coeff(z_, power) for power in (0, 1))
    shown = even / denom + odd * z_ / denom
    if denom.has(z_):  # (even + odd z)/(z d), with z^2 = 1 - w^2
        shown = sp.cancel(even / (1 - w_**2)) * z_ * z_ / denom + odd * z_ / denom
    turned = {"w": 1 - p**2 * C, "z": p * Z, "rate": -p * V, "half": p * (Z + p**2 * S)}
    command = sp.cancel(sp.cancel(shown).subs(turned, simultaneous=True) / p)
    return sp.cancel(command.subs(p, sp.sqrt(P)))


def make_equation(law: Law, gains: Gains, tolerance: arb) -> Equation:
    """Return the equation of a law at gains that are whole numbers."""
    command, kv = trace_on_axis(law, gains), sp.Rational(gains.kv)
    N = sp.cancel(-command + kv * V + kv**2 / 2 * (Z + P * S))
    at_rest = command.subs(V, 0)
    slope = sp.diff(at_rest, Z) * (1 - P * C) / 2 + sp.diff(at_rest, C) * Z / 2 + sp.diff(at_rest, S) * C / 2
    x, square = arb(0).union(tolerance), arb(0).union(arb.pi() ** 2)
    c, s = turned_by(x, square)[:2]
    within = compile_function(sp.cancel(slope))(x / 2 - square * s, arb(0), c, s, square)
    slopes = [compile_function(sp.cancel(sp.diff(N, one))) for one in (Z, V, C, S, P)]
    return Equation(compile_function(N), slopes, within.lower(), within.upper())


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


def turned_by(x: arb, P: arb) -> tuple[arb, arb, arb, arb]:
    """Return c, s and their derivatives by P at x, by their series, since P may hold zero.

    c = (1 - cos(p x/2))/P = (x^2/4) (1/2! - u/4! + ...), s = (x/2 - sin(p x/2)/p)/P = (x^3/8) (1/3! - u/5! + ...) with
    u = P x^2/4.
    """
    u, found = P * x * x / 4, []
    for power in (2, 3):
        terms = [arb((-1) ** k) / math.factorial(2 * k + power) for k in range(TERMS + 1)]
        value, slope = arb(0, abs(terms[-1] * u**TERMS).upper()), arb(0, abs(TERMS * terms[-1] * u ** (TERMS - 1)).upper())
        for k in reversed(range(TERMS)):
            value, slope = value + terms[k] * u**k, slope + (k * terms[k] * u ** (k - 1) if k else 0)
        found.append(((x / 2) ** power * value, (x / 2) ** (power + 2) * slope))
    (c, c_P), (s, s_P) = found
    return c, s, c_P, s_P


class Polynomials(NamedTuple):
    """xi and upsilon over one step as Taylor polynomials, whose last coefficients hold the remainders."""

    xi: list[arb]
    upsilon: list[arb]

    def at(self, time: arb, a: arb) -> tuple[arb, arb]:
        """Return x and y = v + a x at a time from the step's beginning."""
        shrinks = (-a * time).exp()
        x, y = (shrinks * functools.reduce(lambda sum_, one: sum_ * time + one, reversed(part)) for part in self)
        return x, y


class Flow:
    """Motions for every P of an interval, and their derivatives by P."""

    def __init__(self, equation: Equation, a: arb, P: arb) -> None:
        self.N, self.slopes, self.a, self.P = equation.N, equation.slopes, a, P

    def rates(self, state: Sequence[Any], grows: Any) -> list[Any]:
        """Return the derivatives of xi, upsilon, c and s, with grows = exp(a t); and, where given, of theirs by P."""
        (xi, upsilon, c, s), P = state[:4], self.P
        x, v = xi / grows, (upsilon - self.a * xi) / grows
        z = x / 2 - P * s
        found = [upsilon, grows * self.N(z, v, c, s, P), z * v / 2, c * v / 2]
        if len(state) > 4:
            dxi, dupsilon, dc, ds = state[4:]
            dx, dv = dxi / grows, (dupsilon - self.a * dxi) / grows
            dz = dx / 2 - P * ds - s
            parts = zip(self.slopes, (dz, dv, dc, ds, 1), strict=True)
            push = functools.reduce(operator.add, (slope(z, v, c, s, P) * change for slope, change in parts))
            found += [dupsilon, grows * push, (dz * v + z * dv) / 2, (dc * v + c * dv) / 2]
        return found

    def complete(self, begin: Sequence[arb], grows: arb) -> list[arb]:
        """Return xi, upsilon and, where given, their derivatives by P, with c and s beside them."""
        x = begin[0] / grows
        c, s, c_P, s_P = turned_by(x, self.P)
        dx = begin[2] / grows if len(begin) > 2 else 0
        more = [*begin[2:], c_P + (x / 2 - self.P * s) / 2 * dx, s_P + c / 2 * dx] if len(begin) > 2 else []
        return [*begin[:2], c, s, *more]

    def expand(self, begin: Sequence[arb], grows: arb) -> list[Polynomials]:
        """Return the Taylor polynomials from there: of xi and upsilon, and of their derivatives by P where given."""
        first = [arb_series([one]) for one in self.complete(begin, grows)]
        state, growing = first, (arb_series([0, 1]) * self.a).exp() * grows
        for _ in range(ORDER):
            rates = self.rates(state, growing)
            state = [one + arb_series(rate).integral() for one, rate in zip(first, rates, strict=True)]
        coefficients = [[one[k] for k in range(ORDER + 1)] for one in state]
        return [Polynomials(*coefficients[k : k + 2]) for k in range(0, len(state), 4)]

    def step(self, begin: Sequence[arb], h: arb) -> tuple[list[Polynomials], arb]:
        """Return the polynomials of one step of [0, h], and an enclosure of v over it.

        Errors:
            Unenclosed: no enclosure of the step was found, or a wide one: shorten the step.
        """
        during = arb(0).union(h)
        grows = (self.a * during).exp()
        box = list(begin)
        for _ in range(12):
            rates = self.rates(self.complete(box, grows), grows)
            rates = [*rates[:2], *rates[4:6]]
            image = [one + during * rate for one, rate in zip(begin, rates, strict=True)]
            if all(outer.contains(inner) for outer, inner in zip(box, image, strict=True)):
                break
            box = [one.union(other) for one, other in zip(box, image, strict=True)]
            box = [one + arb(0, 0.2 * float(one.rad()) + 1e-12) for one in box]
        else:
            raise Unenclosed
        box = image  # tighter, and an enclosure too
        near, over = self.expand(begin, arb(1)), self.expand(box, grows)
        joined = [
            Polynomials(*([*part[:-1], rest[-1]] for part, rest in zip(one, whole, strict=True)))
            for one, whole in zip(near, over, strict=True)
        ]
        if any(float((one.upsilon[-1] * h**ORDER).rad()) > ACCURACY for one in joined):
            raise Unenclosed
        return joined, (box[1] - self.a * box[0]) / grows


class Unenclosed(Exception):
    """A motion that is not known well enough."""


def enclose(equation: Equation, a: arb, p: tuple[float, float], tolerance: arb) -> tuple[float, float]:
    """Return times before and after which the angle comes to stay below the tolerance, for every p of an interval.

    A motion is the one of the middle P, and its derivative by P over the interval times what P is away.
    """
    ctx.cap = ORDER + 1
    ends = [arb(one) if one < math.pi else arb.pi() for one in p]
    P = (ends[0] ** 2).union(ends[1] ** 2)
    middle, away, h = P.mid(), P - P.mid(), STEP_S
    one, all_ = Flow(equation, a, middle), Flow(equation, a, P)
    centre, change = (arb(1), a), (arb(0), arb(0))
    lower = upper = None
    x, began = arb(1), 0.0
    while began < LONGEST_S:
        begin = [at + by * away for at, by in zip(centre, change, strict=True)]
        try:
            (path,), _ = one.step(centre, arb(h))
            (_, drift), v = all_.step([*begin, *change], arb(h))
        except (Unenclosed, ValueError):  # flint's ValueError: it would divide by an interval that holds zero
            h = h / 2
            if h < SHORTEST_S:
                raise Unenclosed from None
            continue

        def angle(t: float, path: Polynomials = path, drift: Polynomials = drift) -> arb:
            return path.at(arb(t), a)[0] + drift.at(arb(t), a)[0] * away

        before, centre, change = x, path.at(arb(h), a), drift.at(arb(h), a)
        x, y = (at + by * away for at, by in zip(centre, change, strict=True))
        if lower is None and not x > tolerance:
            lower = began + bisect(lambda t: angle(t) > tolerance, 0.0, h, 20)[0]
        if upper is None and x < tolerance and v < 0:
            upper = began + bisect(lambda t: not angle(t) < tolerance, 0.0, h, 20)[1]
        elif upper is not None and not (v < 0 and before < tolerance and x > -tolerance):
            upper = None  # it may have left the band again
        if upper is not None and (y - a * x) ** 2 + x**2 * equation.hardest < tolerance**2 * equation.softest:
            return lower or 0.0, upper
        began, h = began + h, min(2 * h, STEP_S)
    raise Unenclosed


def bound(law: Law, gains: Gains = PAPERS_GAINS) -> Bound:
    """Return bounds of the longest settling time from rest, WIDTH_S apart.

    Errors:
        DoesNotFit: the law has none, or none that this method finds.
    """
    tolerance, a = arb(str(RULES.tolerance)), arb(gains.kv) / 2
    equation = make_equation(law, gains, tolerance)
    c, s, *_ = turned_by(arb(1), arb.pi() ** 2)
    from_180 = a**2 - equation.N(arb("0.5") - arb.pi() ** 2 * s, arb(0), c, s, arb.pi() ** 2)
    if not from_180 > 0:
        is_dead = from_180.is_finite()
        raise DoesNotFit("a 180° rotation is an equilibrium" if is_dead else "its command has no bound at 180°")
    ends = [k * math.pi / PARTS for k in range(PARTS)] + [math.pi]
    lower, waiting, count = 0.0, [], 0
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
    return Bound(lower, -waiting[0][0], count)

