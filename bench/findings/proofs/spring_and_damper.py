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
many. The memory is the quaternion of now: time is continuous.

f, a, b, g and delta are what the law's own source gives. Source of the argument: Koditschek 1989; Mayhew, Sanfelice,
Teel 2011.
"""

import itertools
import math
from fractions import Fraction
from typing import Any, NamedTuple

import sympy as sp

from bench.findings.proofs.body import GOAL, QUATERNION, RATES, FreeBody, Tick
from bench.findings.proofs.question import Question, find_least
from bench.findings.proofs.solver import Lemma, by_algebra
from bench.findings.proofs.theorem import DoesNotFit, Proof, Theorem
from bench.findings.proofs.trace import Traced
from bench.law.kinds import Law
from bench.law.so3 import IDENTITY, cross, dot

ETA = sp.Symbol("w")
FORM = "u = Kp f(eta) eps - a omega + b (eps . omega) eps + g eps x omega"


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
        if tick.u[i] != kp * f * eps[i] - a * omega[i] + b * across * eps[i] + g * turned[i]:
            raise DoesNotFit(f"its command is not of the form {FORM}")
    if any(body.mentions(one, *QUATERNION[1:], *GOAL) for one in (f, a, b)) or body.mentions(f, *RATES):
        raise DoesNotFit(f"f, a or b of {FORM} depend on the axis or on the goal")
    return Command(f, a, b)


def is_damped_less(body: FreeBody, one: Command, c: Fraction, is_along: bool) -> Any:
    """Return the condition that the damping along or across eps is below c Kv; at most zero where c is zero."""
    damping = one.a - (1 - body.eta**2) * one.b if is_along else one.a
    return body.solver.is_below(damping - body.symbols.number(c) * body.gains.kv, c != 0)


def find_rate(body: FreeBody, ask: Question) -> Fraction:
    """Return the greatest c, to 0.01, with V' <= -c Kv |omega|^2."""

    def is_held(lost: Fraction) -> bool:
        ways = (lambda one, along=along: is_damped_less(body, one.taken, 1 - lost, along) for along in (False, True))
        return all(ask.never("", way).is_proved for way in ways)

    return 1 - find_least(is_held, 100)


def prove(law: Law) -> Proof:
    """Prove descent, equilibria and changes of side of a law of this form."""
    body = FreeBody(positive=() if law.memory is not None else ("w",))
    ask = Question(body, law, take_apart)
    c = find_rate(body, ask)
    least = f">= {float(c):g} Kv" if c else "> 0"
    springs = {one.taken.f.value.as_expr().subs(one.path.meanings): one for one in ask.ticks if one.side > 0}
    if any(str(name) not in ("w", "kp", "kv") for one in springs for name in one.free_symbols):
        raise DoesNotFit("f depends on more than eta")
    lemmas = [
        by_algebra(FORM, True),  # or take_apart would have refused it
        ask.never("the command is finite", lambda one: body.solver.is_zero(*(part.value.denom for part in one.u))),
        ask.never("f > 0 but at the goal", lambda one: body.solver.is_below(one.side * one.taken.f, strictly=False)),
        turn(ask.never(f"a {least}", lambda one: is_damped_less(body, one.taken, c, False)), False),
        turn(ask.never(f"a - (1 - eta^2) b {least}", lambda one: is_damped_less(body, one.taken, c, True)), True),
        by_algebra("f is one function of eta", is_one_function(ask, law.memory is not None)),
    ]
    delta, drop, equilibria = None, None, "none"
    if law.memory is not None:
        delta = float(ask.delta)
        drop = float(2 * sp.Integral(min(springs, key=str), (ETA, -ask.delta, ask.delta)).evalf())
    else:
        equilibria, lemma = look_at_180(set(springs))
        lemmas.append(lemma)
    f = ", ".join(sorted(sp.latex(sp.simplify(one.subs(ETA, sp.Symbol("eta")))) for one in springs))
    V = rf"V = K_p U + \tfrac12|\omega|^2, \quad \mathrm dU/\mathrm d\eta = -2 f, \quad f = {f}"
    stands = "almost global" if law.memory is None else "global with memory"
    return Proof(THEOREM.name, stands, [*lemmas, *ask.changes_of_side()], V, equilibria, float(c), delta, drop)


def is_one_function(ask: Question, is_smooth: bool) -> bool:
    """Tell whether f is the same wherever eta is; of a law with memory, on every path."""
    of = [(one.taken.f.value.as_expr().subs(one.path.meanings), one) for one in ask.ticks if one.side > 0]
    pairs = itertools.combinations(of, 2)
    return not any(f != g and (is_smooth or ask.meets(one, other)) for (f, one), (g, other) in pairs)


def look_at_180(springs: set[Any]) -> tuple[str, Lemma]:
    """Return what a law without memory does at 180°, and the lemma that it leaves, or never comes there."""
    for f in springs:
        if f.subs(ETA, 0) == 0:
            return "every 180° rotation", by_algebra("df/deta > 0 at 180°", bool(sp.diff(f, ETA).subs(ETA, 0) > 0))
        if f.subs(ETA, 0) == sp.zoo:
            return "not defined at 180°", by_algebra(
                "U has no bound at 180°", sp.limit(ETA * f, ETA, 0, "+").is_positive
            )
    least = min(f.subs(ETA, 0) for f in springs)
    return "none, but the command jumps at 180°", by_algebra("f > 0 at 180°", bool(least > 0))


def turn(lemma: Lemma, is_along: bool) -> Lemma:
    """Let the body of a counterexample turn along eps or across it, by 5 rad/s."""
    if lemma.counterexample is None:
        return lemma
    eps = [lemma.counterexample[name] for name in QUATERNION[1:]]
    direction = eps if is_along else cross(eps, min(IDENTITY, key=lambda axis: abs(dot(axis, eps))))
    size = math.sqrt(dot(direction, direction))
    omega = {name: 5.0 * one / size for name, one in zip(RATES, direction, strict=True)}
    return lemma._replace(counterexample=lemma.counterexample | omega)


THEOREM = Theorem("spring-and-damper", "A spring along the axis of the turn, and a damper", prove)
