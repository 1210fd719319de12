"""Two potentials, of which one is in force: V_q(X) = V(X_q), X_q = X exp(q kappa V(X) [b]x), q = 1 or -1.

X is R in the goal's axes, and V = q^T M q of its quaternion, M diagonal. The force is the gradient of U_q = 2 V_0 (1
- sqrt(1 - V_q/V_0)), and Kp U_q + |omega|^2/2 falls as -Kv |omega|^2. Where the force is zero X_q is at rest under V:
because kappa |b . grad V| < 1, X_q turns whenever X does. X_q is a bijection of X (a local one, on a compact set,
deformed from X itself). So X_q is the goal, and X is too, or X_q is one of three 180° rotations, each of one X, at
which V_{-q} is lower by more than the gap at which q changes. A change of q takes the gap from V_q, and more from
U_q.

All of it is what the law's own source gives; the X are enclosed by interval arithmetic (Arb).
Source: Mayhew & Teel 2013; Berkane & Tayebi, arXiv:1502.07386 (abstracts).
"""

import functools
import sys
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import arb

from bench.findings.proofs.body import FreeBody
from bench.findings.proofs.quadratic_potential import find_quadratic
from bench.findings.proofs.solver import by_algebra
from bench.findings.proofs.theorem import Proof, Theorem
from bench.findings.proofs.trace import Traced
from bench.law.kinds import Law

AXIS = ("axis_1", "axis_2", "axis_3")


def enclose(M: list[Fraction], i: int, squares: Sequence[Any], kappa: Fraction) -> arb:
    """Enclose V_{-q} where X_q is the 180° rotation H_i, X = H_i exp(-q phi [b]x) with phi = kappa V(X), |b_i|^2 given.

    The quaternion of H_i exp(phi [b]x) has the squares s b_i^2, c on axis i, s b_k^2 on j and s b_j^2 on k, with
    c = cos^2(phi/2), s = sin^2(phi/2); so it is the same for both q.
    """
    j, k = (other for other in range(3) if other != i)
    turned = M[0] * squares[i] + M[j + 1] * squares[k] + M[k + 1] * squares[j]

    def potential(phi: arb) -> arb:
        return exact(M[i + 1]) * (phi / 2).cos() ** 2 + exact(turned) * (phi / 2).sin() ** 2

    phi = arb(0).union(exact(kappa * max(M)))
    for _ in range(60):
        phi = phi.intersection(exact(kappa) * potential(phi))
    return potential(2 * phi)


def exact(ratio: Fraction) -> arb:
    """Return a fraction as Arb has it."""
    return arb(ratio.numerator) / ratio.denominator


def prove(law: Law) -> Proof:
    """Prove descent, equilibria and changes of potential."""
    file: Any = sys.modules[law.law.__module__]
    kappa, gap, top = (Fraction(repr(one)) for one in (file.KAPPA, file.GAP, file.TOP))
    weights = [Fraction(repr(one)) for one in file.WEIGHTS]
    share = 2 / sum(1 / one for one in weights)
    squares = [1 - share / one for one in weights]
    body = FreeBody(more=AXIS, constants=dict(zip(file.AXIS, AXIS, strict=True)), goal_frame=True)
    for name, square in zip(AXIS, squares, strict=True):
        body.symbols.relate(name, body.symbols.number(square))
    (kp, kv), omega, symbol = body.gains, body.omega, body.symbols.of
    still = tuple(body.symbols.number(0) for _ in range(3))
    potentials: dict[float, Traced] = {}
    forces, switches = [], []
    for memory in (1.0, -1.0):
        for path in body.symbols.paths(functools.partial(body.command, law, omega, (memory, 0.0, 0.0, 0.0))):
            u, (q, *_) = path.answer
            V = path.turns[0] / body.symbols.number(kappa)
            M = find_quadratic(body, body.derive(V, still))
            turning = body.derive(V, still) * body.symbols.number(kappa)
            more = {"cosine0": -symbol["sine0"] * turning, "sine0": symbol["cosine0"] * turning}
            inside, scale = symbol["root0"] ** 2, symbol["root1"]
            power = sum((omega[i] * (u[i] + kv * omega[i]) for i in range(3)), still[0])
            forces.append(
                power * symbol["root0"] * scale / kp - body.symbols.number(top) * body.derive(inside, still, more)
            )
            potentials[q] = body.symbols.number(top) * (1 - inside / scale**2)
            switches.append((memory, q, path.decisions[0]))
    gaps = [is_the_gap(body, potentials, memory, decision.polynomial, gap) for memory, _, decision in switches]
    entries = [Fraction(int(one.p), int(one.q)) for one in M.diagonal()]
    lower = [exact(entries[i + 1]) - enclose(entries, i, squares, kappa) for i in range(3)]
    changes = all(decision.is_negative == (q != memory) for memory, q, decision in switches)
    slope = kappa * (max(entries) - min(entries)) / 2
    lemmas = [
        by_algebra("u = -Kp grad U_q - Kv omega", forces),
        by_algebra("V = q^T M q, M diagonal with four different entries", M.is_diagonal() and len(set(entries)) == 4),
        by_algebra("V < V_0", max(entries) < top),
        by_algebra("kappa |grad V| <= kappa (max M - min M)/2 < 1", slope < 1),
        by_algebra("q changes where V_q - V_{-q} > gap, and there alone", changes and all(gaps)),
        by_algebra("V_q - V_{-q} > gap where X_q is a 180° rotation at rest", all(one > exact(gap) for one in lower)),
    ]
    shown = r"V = 2 K_p V_0 \bigl(1 - \sqrt{1 - V_q/V_0}\bigr) + \tfrac12|\omega|^2"
    return Proof(THEOREM.name, "global with memory", lemmas, shown, "none", 1.0, None, float(gap))


def is_the_gap(body: FreeBody, potentials: dict[float, Traced], q: float, polynomial: Any, gap: Fraction) -> bool:
    """Tell whether a polynomial is a positive multiple of gap - (V_q - V_{-q})."""
    compared = Traced(body.symbols.field(polynomial), body.symbols)
    limit = body.symbols.number(gap) - (potentials[q] - potentials[-q])
    factor = Fraction(repr(float(polynomial.coeff(1)))) / gap
    return factor > 0 and compared == limit * body.symbols.number(factor)


THEOREM = Theorem("two-potentials", "Two potentials, one of them in force", prove, ("synergistic",))
