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
from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.quadratic_potential import find_quadratic
from bench.findings.proofs.solver import by_algebra, sign_of
from bench.findings.proofs.theorem import FINITE_JUMPS, LASALLE, Proof, Theorem
from bench.findings.proofs.traced_number import Traced
from bench.law.kinds import Law
from bench.law.so3 import cross, from_quaternion

FOUR_RESTS = (
    "We proved by hand that the force of the potential on the turned body is zero only if this turned body is at the "
    "goal or at one of three 180° rotations from the goal."
)
CITED = (LASALLE, FINITE_JUMPS, FOUR_RESTS)

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
    forces, switches, places = [], [], []
    roots = set()
    memories = [tuple(law.memory or ())]
    body.symbols.oracle = None  # what must be defined is compared with a lemma below, without Z3
    for memory in (1.0, -1.0):
        for path in body.symbols.paths(functools.partial(body.command, law, omega, (memory, 0.0, 0.0, 0.0))):
            u, next_memory = path.answer
            memories.append(next_memory)
            q = next_memory[0]
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
            places.append(potentials[q] - potential_of_turned(body, M, q))
            if path.meanings["root1"].is_number and path.meanings["root1"] > 0:
                roots.add(scale.value.numer)
            roots |= {normalize(symbol["root0"].value.numer), normalize(inside.value.numer)}
            switches.append((memory, q, path.decisions[0]))
    gaps = [is_the_gap(body, potentials, *switch, gap) for switch in switches]
    entries = [Fraction(int(one.p), int(one.q)) for one in M.diagonal()]
    lower = [exact(entries[i + 1]) - enclose(entries, i, squares, kappa) for i in range(3)]
    starts = all(memory in ((1.0, 0.0, 0.0, 0.0), (-1.0, 0.0, 0.0, 0.0)) for memory in memories)
    # the law takes the root of 1 - V_q/V_0, and divides by it
    is_defined = all(normalize(fault.polynomial) in roots for fault in body.symbols.requirements)
    slope = kappa * (max(entries) - min(entries)) / 2
    lemmas = [
        by_algebra("u = -Kp grad U_q - Kv omega", forces),
        by_algebra("V = q^T M q, M diagonal with four different entries", M.is_diagonal() and len(set(entries)) == 4),
        by_algebra("V < V_0, at q^T M q of every unit quaternion", max(entries) < top),
        by_algebra("the potential in force is V of the body turned by q kappa V about b", places),
        by_algebra("the command is finite: it divides by the root of 1 - V_q/V_0 alone", is_defined),
        by_algebra("the memory is q = 1 or -1, at first and after every tick", starts),
        by_algebra("kappa |grad V| <= kappa (max M - min M)/2 < 1", slope < 1),
        by_algebra("q changes where V_q - V_{-q} > gap, and there alone", all(gaps)),
        by_algebra("V_q - V_{-q} > gap where X_q is a 180° rotation at rest", all(one > exact(gap) for one in lower)),
    ]
    shown = r"V = 2 K_p V_0 \bigl(1 - \sqrt{1 - V_q/V_0}\bigr) + \tfrac12|\omega|^2"
    return Proof(THEOREM.name, "global with memory", lemmas, shown, "none", 1.0, None, float(gap), CITED)


def normalize(polynomial: Any) -> Any:
    """Return a polynomial over its leading coefficient."""
    return PolynomialRelation(polynomial, "=").normal().polynomial


def potential_of_turned(body: FreeBody, M: Any, q: float) -> Traced:
    """Return V = x^T M x of the body that is turned by q phi about its own axis b, by the cosine and sine of phi.

    V is linear in the diagonal of X in the goal's axes, for 4 x_i^2 = 1 + X_ii - X_jj - X_kk.
    """
    symbol, number = body.symbols.of, body.symbols.number
    cosine, sine = symbol["cosine0"], symbol["sine0"] * number(q)
    b, X = body.symbols[AXIS], from_quaternion(conjugate(body.q))
    diagonal = []
    for i in range(3):
        # the columns of X exp(phi [b]x), by Rodrigues' formula
        along, across = b[i], cross(b, tuple(number(float(i == j)) for j in range(3)))
        turned_axis = [cosine * float(i == j) + sine * across[j] + (1 - cosine) * along * b[j] for j in range(3)]
        diagonal.append(sum((X[j][i] * turned_axis[j] for j in range(3)), number(0)))
    total = number(0)
    for i in range(3):
        j, k = (other for other in range(3) if other != i)
        square = (1 + diagonal[i] - diagonal[j] - diagonal[k]) / 4
        total = total + square * number(Fraction(int(M[i + 1, i + 1].p), int(M[i + 1, i + 1].q)))
    return total


def conjugate(q: tuple) -> tuple:
    """Return the quaternion of the turn back."""
    return (q[0], *(-part for part in q[1:]))


def is_the_gap(
    body: FreeBody,
    potentials: dict[float, Traced],
    memory: float,
    q: float,
    decision: PolynomialRelation,
    gap: Fraction,
) -> bool:
    """Tell whether a path's decision is that V_q - V_{-q} is over the gap, where q changes, and that it is not."""
    limit = body.symbols.number(gap) - (potentials[memory] - potentials[-memory])
    relation = ">=" if q == memory else "<"
    return (
        decision
        == PolynomialRelation(body.symbols.without_positive(sign_of(limit)), relation).normal()
    )


THEOREM = Theorem("two-potentials", "Two potentials, one of them in force", prove, ("synergistic",))
