"""Coordinates x of the turn that obey x'' + Kv x' + Kp x = 0 exactly: eps, or with memory sigma = eps/(1 + eta).

V = |x'|^2/2 + Kp |x|^2/2 falls as -Kv |x'|^2. A law that is not defined at eta = 0 must not come there. From rest it
does not, since V < Kp/2 and so |eps| < 1; a body that spins fast enough comes there. With memory the side changes at
eta <= -delta. There |x| and |x'| = (1 + |sigma|^2) |omega|/4 are smaller on the new side: V falls.

Source: Paielli & Bach 1993; Schaub, Akella, Junkins 2001.
"""

from bench.findings.proofs.body import IS_FINITE, FreeBody, Tick
from bench.findings.proofs.memory import prove_start
from bench.findings.proofs.question import Question, agreement_lemma
from bench.findings.proofs.solver import by_algebra
from bench.findings.proofs.theorem import FINITE_JUMPS, DoesNotFit, Proof, Theorem
from bench.findings.proofs.traced_number import Traced, is_zero
from bench.law.kinds import Law
from bench.law.so3 import dot

V_FALLS = "We proved by hand that V = |x'|^2/2 + Kp |x|^2/2 falls if the coordinates x obey x'' + Kv x' + Kp x = 0."
FINITE_BELOW_180 = "the command is finite below 180°, where it is not defined"


def prove(law: Law) -> Proof:
    """Prove that eps or sigma is linear, and where a body stays."""
    start = prove_start(law)
    has_memory = law.memory is not None
    body = FreeBody(positive=() if has_memory else ("w",))
    (kp, kv), omega = body.gains, body.omega

    def coordinate(side: int) -> tuple[Traced, ...]:
        return tuple(side * one / (1 + side * body.eta) if has_memory else one for one in body.eps)

    rates = {side: [body.derive(one, (0, 0, 0)) for one in coordinate(side)] for side in (1, -1)}

    def check(_: FreeBody, tick: Tick) -> set[int]:
        found = set()
        for side in (1, -1) if has_memory else (1,):
            pairs = zip(coordinate(side), rates[side], strict=True)
            if all(is_zero(body.derive(rate, tick.u) + kv * rate + kp * one) for one, rate in pairs):
                found.add(side)
        if not found:
            raise DoesNotFit("neither eps nor sigma obeys a linear equation")
        return found

    ask = Question(body, law, check)
    if not ask.ticks:
        ask.refuse_no_ticks()
    x = r"\sigma" if has_memory else r"\epsilon"
    V = rf"V = \tfrac12|\dot x|^2 + \tfrac12 K_p |x|^2, \quad x = {x}"
    lemmas = [by_algebra("x'' + Kv x' + Kp x = 0", all(one.side in one.taken for one in ask.ticks))]
    lemmas += [*start, body.finite(IS_FINITE if has_memory else FINITE_BELOW_180)]
    lemmas.append(agreement_lemma(body, law, ask))
    if not has_memory:
        return Proof(
            THEOREM.name, "almost global from rest", lemmas, V, "not defined at 180°", 1.0, cited=(V_FALLS,)
        )
    size = dot(rates[1], rates[1]) - dot(omega, omega) / (4 * (1 + body.eta) ** 2)
    delta = float(ask.delta)
    drop = 0.5 * ((1 + delta) / (1 - delta) - (1 - delta) / (1 + delta))
    lemmas += [by_algebra("|x'| = |omega|/(2 (1 + eta))", size), *ask.changes_of_side()]
    cited = (V_FALLS, FINITE_JUMPS)
    return Proof(THEOREM.name, "global with memory", lemmas, V, "none", 1.0, delta, drop, cited)


THEOREM = Theorem("linear-coordinates", "Coordinates that obey a linear equation", prove, order=2)
