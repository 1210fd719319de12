"""A spring along the axis of the turn and a damper: u = Kp f(eta) eps - a omega + b (eps . omega) eps + g eps x omega.

With dU/deta = -2 f and V = Kp U + |omega|^2/2 the terms of the spring cancel, and since |eps|^2 = 1 - eta^2

    V' = -a |omega|^2 + b (eps . omega)^2 <= -min(a, a - (1 - eta^2) b) |omega|^2

so that V falls where both are positive. The largest invariant set in V' = 0 is omega = 0, f eps = 0; where f > 0 that
is the goal alone (LaSalle). For a law without memory eta = 0 is left over. If f(0) = 0, every 180° rotation is an
equilibrium, unstable where df/deta > 0. If f(0) > 0, the command jumps there, and near it eta'' has the sign of eta,
so that few starts end there; on it the sign that the code takes decides. If eta f > 0 at eta = 0, U has no bound and
the body never comes there.

A law with memory stores the sign of the quaternion, so eta may be negative. It changes the sign only if eta <=
-delta. Each change takes at least 2 times the integral of f from -delta to delta from V/Kp. So there are finitely
many. The memory is a multiple of the quaternion of now (`memory`): time is continuous.

Where the damping is bounded by no constant, it must be above zero at the edges of paths too: a damper that vanishes
towards a rate lets a body turn at this rate for ever. V needs a bound near the goal, and so does f |eps|.

f, a, b, g and delta are what the law's own source gives. Source of the argument: Koditschek 1989; Mayhew, Sanfelice,
Teel 2011.
"""

import itertools
import math
from fractions import Fraction
from typing import Any, NamedTuple

import sympy as sp

from bench.findings.proofs.body import GOAL, IS_FINITE, QUATERNION, RATES, FreeBody, Tick
from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.memory import prove_start
from bench.findings.proofs.question import Question, agreement_lemma, find_least
from bench.findings.proofs.solver import Lemma, by_algebra, is_below
from bench.findings.proofs.theorem import FINITE_JUMPS, LASALLE, MEASURE_ZERO, DoesNotFit, Proof, Theorem
from bench.findings.proofs.traced_number import Traced, is_same
from bench.law.kinds import Law
from bench.law.so3 import IDENTITY, cross, dot

NEAR_GOAL, LARGEST = 0.98, 1000.0
"""eta^2 from which on f |eps| has a bound, and the bound; times (1 + Kp + Kv)^2/(Kp Kv) if f depends on the gains."""
ETA = sp.Symbol("w")
FORM = "u = Kp f(eta) eps - a omega + b (eps . omega) eps + g eps x omega"
NOT_DEFINED = "not defined at 180°"
FINITE_AT_180 = "the command is finite at 180°"


class Command(NamedTuple):
    """The command of one path, taken apart: functions of eta and the gains."""

    f: Traced
    a: Traced
    b: Traced


def take_apart(body: FreeBody, tick: Tick) -> Command:
    """Return f, a and b of a command; refuse a command that is not of the form."""
    eps, omega, kp = body.eps, body.omega, body.gains.kp
    turned, across = cross(eps, omega), dot(eps, omega)
    square, rates = dot(eps, eps), dot(omega, omega)
    damping = tuple(u - still for u, still in zip(tick.u, tick.at_rest, strict=True))
    f = dot(eps, tick.at_rest) / (kp * square)
    a = (across * dot(eps, damping) - dot(omega, damping) * square) / (rates * square - across**2)
    b = (dot(eps, damping) / across + a) / square
    g = dot(turned, damping) / (rates * square - across**2)
    for i in range(3):
        if not is_same(tick.u[i], kp * f * eps[i] - a * omega[i] + b * across * eps[i] + g * turned[i]):
            raise DoesNotFit(f"its command is not of the form {FORM}")
    if any(body.mentions(value, *QUATERNION[1:], *GOAL) for value in (f, a, b)) or body.mentions(f, *RATES):
        raise DoesNotFit(f"f, a or b of {FORM} depend on the axis or on the goal")
    return Command(f, a, b)


def is_damped_less(
    body: FreeBody, command: Command, c: Fraction, is_along: bool
) -> list[PolynomialRelation]:
    """Return the faults of a damping: along or across eps it is below c Kv; not above zero where c is zero."""
    damping = command.a - (1 - body.eta**2) * command.b if is_along else command.a
    undefined = [PolynomialRelation(value.value.denom, "=") for value in (command.a, command.b)]
    return [is_below(damping - body.symbols.number(c) * body.gains.kv, strictly=c != 0), *undefined]


def damping_lemma(body: FreeBody, ask: Question, statement: str, c: Fraction, is_along: bool) -> Lemma:
    """Return the lemma that the damping along or across eps is at least c Kv, or above zero where c is zero."""

    def faults(tick: Tick) -> list[PolynomialRelation]:
        return is_damped_less(body, tick.taken, c, is_along)

    return ask.never(statement, faults, to_the_edge=c == 0, to_180=c == 0)


def find_rate(body: FreeBody, ask: Question) -> Fraction:
    """Return the greatest c, to 0.01, with V' <= -c Kv |omega|^2."""

    def is_held(lost: Fraction) -> bool:
        return all(damping_lemma(body, ask, "", 1 - lost, is_along).is_proved for is_along in (False, True))

    return 1 - find_least(is_held, 100)


def prove(law: Law) -> Proof:
    """Prove descent, equilibria and changes of side of a law of this form."""
    start = prove_start(law)
    has_memory = law.memory is not None
    body = FreeBody(positive=() if has_memory else ("w",))
    ask = Question(body, law, take_apart)
    if not ask.ticks:
        ask.refuse_no_ticks()
    lemmas = [by_algebra(FORM, True), *start, finite_lemma(body, ask)]  # or take_apart would have refused it
    if not lemmas[-1].is_proved:
        return Proof(THEOREM.name, "", lemmas, "")
    lemmas += [spring_lemma(ask), bounded_lemma(body, ask)]
    lemmas.append(agreement_lemma(body, law, ask))
    springs = collect_springs(ask)
    lemmas.append(by_algebra("f is one function of eta", is_one_function(ask, has_memory)))
    equilibria = "none"
    if not has_memory and all(lemma.is_proved for lemma in lemmas):
        equilibria, at_180 = look_at_180(law, springs)
        lemmas += at_180
    c = find_rate(body, ask)
    least = f">= {float(c):g} Kv" if c else "> 0"
    lemmas.append(turn(damping_lemma(body, ask, f"a {least}", c, False), False))
    lemmas.append(turn(damping_lemma(body, ask, f"a - (1 - eta^2) b {least}", c, True), True))
    lemmas += ask.changes_of_side()
    f = ", ".join(sorted(sp.latex(sp.simplify(spring.subs(ETA, sp.Symbol("eta")))) for spring in springs))
    V = rf"V = K_p U + \tfrac12|\omega|^2, \quad \mathrm dU/\mathrm d\eta = -2 f, \quad f = {f}"
    if has_memory:
        delta, drop = float(ask.delta), find_drop(springs, ask.delta)
        cited = (LASALLE, FINITE_JUMPS)
        return Proof(THEOREM.name, "global with memory", lemmas, V, "none", float(c), delta, drop, cited)
    cited = (LASALLE, MEASURE_ZERO)
    return Proof(THEOREM.name, "almost global", lemmas, V, equilibria, float(c), cited=cited)


def spring_lemma(ask: Question) -> Lemma:
    """Return the lemma that the spring pulls, at the edges of paths too: where f fades, a body may come to rest."""

    def faults(tick: Tick) -> list[PolynomialRelation]:
        return [is_below(tick.side * tick.taken.f, strictly=False)]

    return ask.never("f > 0 but at the goal", faults, to_the_edge=True)


def bounded_lemma(body: FreeBody, ask: Question) -> Lemma:
    """Return the lemma that the spring's pull has a bound near the goal: else U may have none."""
    near_goal = PolynomialRelation((body.symbols.number(NEAR_GOAL) - body.eta**2).value.numer, "<")
    kp, kv = body.gains

    def faults(tick: Tick) -> list[PolynomialRelation]:
        f = tick.taken.f
        most = body.symbols.number(LARGEST)
        if body.mentions(f, "kp", "kv"):
            most = most * (1 + kp + kv) ** 2 / (kp * kv)
        is_large = is_below(most**2 - f**2 * (1 - body.eta**2))
        return [is_large, PolynomialRelation(f.value.denom, "=")]

    return ask.never("f |eps| has a bound near the goal", faults, where=(near_goal,))


def finite_lemma(body: FreeBody, ask: Question) -> Lemma:
    """Return the lemma that the command is finite: what it computes, and what is left of it in normal form."""
    finite = body.finite(IS_FINITE)
    if not finite.is_proved:
        return finite

    def faults(tick: Tick) -> list[PolynomialRelation]:
        return [PolynomialRelation(part.value.denom, "=") for part in tick.u]

    # at the edges too: there a force without a bound would give a body any energy
    bounded = ask.never(IS_FINITE, faults, to_the_edge=True)
    return bounded._replace(seconds=bounded.seconds + finite.seconds)


def collect_springs(ask: Question) -> list[Any]:
    """Return f of every path on which a side is kept, as functions of eta and the gains."""
    springs = []
    for tick in ask.ticks:
        spring = expand_spring(tick)
        if tick.side > 0 and spring not in springs:
            springs.append(spring)
    if any(str(symbol) not in ("w", "kp", "kv") for spring in springs for symbol in spring.free_symbols):
        raise DoesNotFit("f depends on more than eta")
    if not springs:
        raise DoesNotFit("it keeps its side at no state")
    return springs


def expand_spring(tick: Tick) -> Any:
    """Return f of a path without the path's own symbols."""
    return tick.taken.f.value.as_expr().subs(tick.path.meanings)


def find_drop(springs: list[Any], delta: Fraction) -> float | None:
    """Return what a change of side takes from V, over Kp; None: f is more than one function."""
    if len(springs) > 1:
        return None
    drop = 2 * sp.Integral(springs[0], (ETA, -delta, delta)).evalf()
    return float(drop) if drop.is_Float else None


def is_one_function(ask: Question, is_smooth: bool) -> bool:
    """Tell whether f is the same wherever eta is; of a law with memory, on every path."""
    kept = [(expand_spring(tick), tick) for tick in ask.ticks if tick.side > 0]
    for (f, tick), (g, other) in itertools.combinations(kept, 2):
        if f != g and (is_smooth or ask.meets(tick, other)):
            return False
    return True


def look_at_180(law: Law, springs: list[Any]) -> tuple[str, list[Lemma]]:
    """Return what a law without memory does at 180°, and the lemmas that it leaves, or never comes there.

    The function f of every path is looked at, for each may be the one near 180°.
    """
    at_180 = [spring.subs(ETA, 0) for spring in springs]
    if all(value == 0 for value in at_180):
        slopes = [sp.diff(spring, ETA).subs(ETA, 0) for spring in springs]
        leaves = by_algebra("df/deta > 0 at 180°", all(map(is_positive, slopes)))
        return "every 180° rotation", [leaves, finite_at_180(law)]
    if all(value == sp.zoo for value in at_180):
        limits = [sp.limit(ETA * spring, ETA, 0, "+") for spring in springs]
        statement = "U has no bound at 180°, where f is not defined"
        return NOT_DEFINED, [by_algebra(statement, all(map(is_positive, limits)))]
    leaves = by_algebra("f > 0 at 180°", all(map(is_positive, at_180)))
    return "none, but the command jumps at 180°", [leaves, finite_at_180(law)]


def is_positive(value: Any) -> bool:
    """Tell whether an expression of positive gains is above zero; not if sympy cannot tell."""
    gains = {symbol: sp.Symbol(str(symbol), positive=True) for symbol in value.free_symbols}
    return value.subs(gains).is_positive is True


def finite_at_180(law: Law) -> Lemma:
    """Return the lemma that the command of a law without memory is finite at eta = 0, where bodies turn through."""
    body = FreeBody(at_180=True)
    for _ in body.commands(law):
        pass
    return body.finite(FINITE_AT_180)


def turn(lemma: Lemma, is_along: bool) -> Lemma:
    """Let the body of a counterexample turn along eps or across it, by 5 rad/s, if it is at rest."""
    state = lemma.counterexample
    if state is None or any(abs(state[name]) > 1e-9 for name in RATES):
        return lemma
    eps = [state[name] for name in QUATERNION[1:]]
    direction = eps if is_along else cross(eps, min(IDENTITY, key=lambda axis: abs(dot(axis, eps))))
    size = math.sqrt(dot(direction, direction))
    omega = {name: 5.0 * part / size for name, part in zip(RATES, direction, strict=True)}
    return lemma._replace(counterexample=state | omega)


THEOREM = Theorem("spring-and-damper", "A spring along the axis of the turn, and a damper", prove)
