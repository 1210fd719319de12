"""A sine with an integral under a constant disturbance d, for Kv^2 < 5 Kp.

With e = sin(theta) k = 2 eta eps, the law's state x, x' = omega - c e, and x_d where its integral balances d,

    V = 2 Kp (1 - eta^2) - c e . omega + |omega|^2/2 + h |x - x_d|^2/2 > 0
    V' < 0 but where omega = 0 and e = 0

The law's own source gives c and h = -du/dx. Where V' stays zero the body rests at the goal or on a 180° rotation.
(That 180° rotations are unstable is not checked: s^3 + Kv s^2 + (h - Kp) s - h c has a positive root.)
Source: Goodarzi, Lee, Lee 2013.
"""

from fractions import Fraction

from bench.findings.proofs.body import FreeBody
from bench.findings.proofs.solver import by_algebra, decide
from bench.findings.proofs.theorem import LASALLE, MEASURE_ZERO, Proof, Theorem
from bench.law.contenders.compensators.integral import INTEGRAL, LEAD
from bench.law.kinds import Stateful
from bench.law.so3 import dot

STATE, BALANCE = ("x_1", "x_2", "x_3"), ("d_1", "d_2", "d_3")
RATIO = 5
"""Kv^2 over Kp below which V is positive and falls."""


def prove(stateful: Stateful) -> Proof:
    """Prove descent of a body and its integral."""
    fractions = {one: Fraction(one).limit_denominator(1000) for one in (INTEGRAL, LEAD, 0.5 * LEAD)}
    body = FreeBody(more=(*STATE, *BALANCE, "s", "S"), constants=fractions)
    (kp, kv), omega, half = body.gains, body.omega, body.symbols.number(0.5)
    state, balance = body.symbols[STATE], body.symbols[BALANCE]
    given = (*state, body.symbols.number(0))
    (path,) = body.symbols.paths(lambda: body.command(stateful.law, omega, given))
    u, rate = path.answer
    e = tuple(2 * body.eta * one for one in body.eps)
    c = dot(tuple(w - one for w, one in zip(omega, rate, strict=False)), e) / dot(e, e)
    hold = -body.symbols.derivative(u[0], STATE[0])
    pushed = tuple(one + hold * d for one, d in zip(u, balance, strict=True))
    off = tuple(one - d for one, d in zip(state, balance, strict=True))
    V = 2 * kp * (1 - body.eta**2) - c * dot(e, omega) + half * dot(omega, omega) + half * hold * dot(off, off)
    falls = body.derive(V, pushed, dict(zip(STATE, rate[:3], strict=True)))
    # with s = eps . omega and S = |omega|^2, of which s^2 <= (1 - eta^2) S is all that matters
    s, S, square = body.symbols.of["s"], body.symbols.of["S"], 1 - body.eta**2
    terms = (
        (dot(omega, omega), S, -kv + c * body.eta**2),
        (dot(body.eps, omega) ** 2, s**2, -c),
        (dot(body.eps, omega), s, 2 * c * kv * body.eta),
        (body.symbols.number(1), body.symbols.number(1), -4 * c * kp * body.eta**2 * square),
    )
    written = sum((vector * factor for vector, _, factor in terms), body.symbols.number(0))
    bound = sum((short * factor for _, short, factor in terms), body.symbols.number(0))
    energy = 2 * kp * square - 2 * c * body.eta * s + half * S
    solver = body.solver
    known = [
        *solver.given,
        solver.of["kv"] * solver.of["kv"] < RATIO * solver.of["kp"],
        solver.of["w"] * solver.of["w"] < 1,
        solver.of["S"] >= 0,
    ]
    known += [solver.is_below(s**2 - square * S, strictly=False), solver.is_below(-(S + body.eta**2))]
    lemmas = [
        body.finite(),
        by_algebra(
            "V' = (c eta^2 - Kv) S - c s^2 + 2 c Kv eta s - c Kp |e|^2, s = eps . omega, S = |omega|^2", falls - written
        ),
        decide("V > 0 away from the goal", known, solver.is_below(energy, strictly=False)),
        decide("V' < 0 but at rest at the goal or on a 180° rotation", known, solver.is_below(-bound, strictly=False)),
    ]
    shown = r"V = 2 K_p (1 - \eta^2) - c\,e \cdot \omega + \tfrac12|\omega|^2 + \tfrac12 h |x - x_d|^2"
    stands, cited = f"almost global where Kv^2 < {RATIO} Kp", (LASALLE, MEASURE_ZERO)
    return Proof(THEOREM.name, stands, lemmas, shown, "every 180° rotation", cited=cited)


THEOREM = Theorem("integral", "A sine of the angle with an integral", prove, ("integral",))
