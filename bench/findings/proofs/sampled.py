"""When a loop near its goal that is held between ticks of h is stable, for all gains, periods and lags.

A polynomial z^2 + p z + q with real coefficients has its roots inside the unit circle where and only where q < 1,
1 + p + q > 0 and 1 - p + q > 0 (Jury 1964; Schur, Cohn). The polynomials are those of the loops sampled exactly:

    second order   x'' = u, u = -Kp x - Kv x'                       z^2 + (Kp h^2/2 + Kv h - 2) z + 1 + Kp h^2/2 - Kv h
    first order    e' = -omega, omega = K e behind a lag T          a = exp(-h/T), see `lagged_loop`

What is proved is that the criterion says what `bench.findings.theory` computes with: Kv h < 2 and Kp h < 2 Kv, and
K below two bounds.
"""

import sympy as sp
import z3

from bench.findings.proofs.solver import Lemma, decide

KP, KV, H, A, K, T, ROOT = sp.symbols("kp kv h a K T z", positive=True)


def held_loop() -> sp.Poly:
    """Return the polynomial of the second-order loop: the double integrator, held for h, with its feedback."""
    free, pushed = sp.Matrix([[1, H], [0, 1]]), sp.Matrix([H**2 / 2, H])
    return sp.Poly((ROOT * sp.eye(2) - free + pushed * sp.Matrix([[KP, KV]])).det(), ROOT)


def lagged_loop() -> sp.Poly:
    """Return the polynomial of e' = -w, T w' = K e - w over one tick, K e held, with a = exp(-h/T)."""
    free = sp.Matrix([[1, -T * (1 - A)], [0, A]])
    pushed = sp.Matrix([-(H - T * (1 - A)), 1 - A])
    return sp.Poly((ROOT * sp.eye(2) - free - pushed * sp.Matrix([[K, 0]])).det(), ROOT)


def prove_loops() -> list[Lemma]:
    """Prove both limits."""
    of = {str(one): z3.Real(str(one)) for one in (KP, KV, H, A, K, T)}
    positive = [one > 0 for one in of.values()]
    kp, kv, h, a, K_, lag = of.values()
    coast = lag * (1 - a)  # of which a h < coast < h, as exp(-h/T) has it
    known = [*positive, a < 1, a * h < coast, coast < h]
    bounds = z3.And(K_ * (coast - a * h) < 1 - a, K_ * ((1 + a) * h - 2 * coast) < 2 * (1 + a))
    return [
        decide(
            "held loop: stable where and only where Kv h < 2 and Kp h < 2 Kv",
            positive,
            _jury(held_loop(), of) != z3.And(kv * h < 2, kp * h < 2 * kv),
        ),
        decide(
            "behind a lag: stable where and only where K is below both bounds",
            known,
            _jury(lagged_loop(), of) != bounds,
        ),
    ]


def _jury(polynomial: sp.Poly, of: dict[str, z3.ArithRef]) -> z3.BoolRef:
    _, p, q = (
        sp.lambdify((KP, KV, H, A, K, T), sp.expand(one), modules=[{}])(*of.values()) for one in polynomial.all_coeffs()
    )
    return z3.And(q < 1, 1 + p + q > 0, 1 - p + q > 0)
