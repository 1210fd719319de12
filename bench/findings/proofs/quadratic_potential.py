"""A potential that is quadratic in the quaternion, U = q^T M q, and a damper: u = -Kp grad U - Kv omega.

V = Kp U + |omega|^2/2 falls as -Kv |omega|^2. A body that stays where V' = 0 is at an eigenvector q of M: if M is
diagonal with four different entries, at the goal or at a 180° rotation about n_d, o_d or a_d. The goal has the least
entry, so U decreases along a rotation away from the others, and they are unstable. M is what the law's own source
gives, in the goal's axes.

Source: Chillingworth, Marsden, Wan 1982; Chaturvedi, Sanyal, McClamroch 2011.
"""

import itertools
from fractions import Fraction

import sympy as sp

from bench.findings.proofs.body import FreeBody
from bench.findings.proofs.question import Question, agreement_lemma
from bench.findings.proofs.solver import by_algebra
from bench.findings.proofs.theorem import LASALLE, MEASURE_ZERO, DoesNotFit, Proof, Theorem
from bench.findings.proofs.traced_number import Traced
from bench.law.kinds import Law
from bench.law.so3 import dot

CITED = (LASALLE, MEASURE_ZERO)


def find_quadratic(body: FreeBody, slope: Traced) -> sp.Matrix:
    """Return M, symmetric with M_00 = 0, for which the derivative of q^T M q along the motion is a slope."""
    pairs = list(itertools.combinations_with_replacement(range(4), 2))[1:]
    still = tuple(body.symbols.number(0) for _ in range(3))
    derivatives = [body.derive(body.q[i] * body.q[j], still).value.numer for i, j in pairs]
    scale = slope.value.denom.LC
    terms = sorted({monomial for one in [*derivatives, slope.value.numer] for monomial in one.monoms()})
    columns = [[one.get(monomial, 0) for monomial in terms] for one in derivatives]
    given = [slope.value.numer.get(monomial, 0) / scale for monomial in terms]
    unknowns = sp.symbols(f"m:{len(pairs)}")
    system = (sp.Matrix(columns).T, sp.Matrix(given))
    solution = sp.linsolve(system, *unknowns) if slope.value.denom.is_ground else sp.EmptySet
    if not solution:
        raise DoesNotFit("its spring has no potential that is quadratic in the quaternion")
    M = sp.zeros(4)
    for (i, j), value in zip(pairs, next(iter(solution)), strict=True):
        M[i, j] = M[j, i] = value if i == j else value / 2
    return M


def prove(law: Law) -> Proof:
    """Prove descent and equilibria of a law of this form."""
    if law.memory is not None:
        raise DoesNotFit("it has a memory")
    # asked first without the goal's axes, where polynomials are short
    plain = FreeBody()
    if any(path.taken for path in itertools.islice(plain.commands(law), 1)):
        raise DoesNotFit("its command has branches")
    body = FreeBody(goal_frame=True)
    ticks = list(body.ticks(law))
    if len(ticks) != 1:
        raise DoesNotFit("its command has branches, or answers at no state")
    tick = ticks[0]
    kp, kv = body.gains
    M = find_quadratic(body, -dot(body.omega, tick.at_rest) / kp)
    entries = [Fraction(int(one.p), int(one.q)) for one in M.diagonal()]
    lemmas = [
        body.finite(),
        agreement_lemma(plain, law, Question(plain, law, lambda *_: True)),
        by_algebra("U' = -u . omega/Kp at rest, U = q^T M q", True),  # or find_quadratic would have refused it
        by_algebra("u - u at rest = -Kv omega", [tick.u[i] - tick.at_rest[i] + kv * body.omega[i] for i in range(3)]),
        by_algebra("M is diagonal with four different entries", M.is_diagonal() and len(set(entries)) == 4),
        by_algebra("the least entry is the goal's", entries[0] == min(entries)),
    ]
    listed = ", ".join(f"{float(one):g}" for one in entries)
    V = rf"V = K_p\, q^\top M q + \tfrac12|\omega|^2, \quad M = \operatorname{{diag}}({listed})"
    return Proof(THEOREM.name, "almost global", lemmas, V, "180° rotations about n_d, o_d and a_d", 1.0, cited=CITED)


THEOREM = Theorem(
    "quadratic-potential", "A potential that is quadratic in the quaternion, and a damper", prove, order=1
)
