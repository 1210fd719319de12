"""Joint PD with gravity compensation: D qddot + C qdot = M (Kp e - Kv qdot), e = q_d - q, M diagonal and constant.

V = qdot^T D qdot/2 + Kp e^T M e/2. Since D' - 2 C is skew, V' = qdot^T tau - Kp e^T M qdot = -Kv qdot^T M qdot, and
where that stays zero M e = 0. Source: Takegaki & Arimoto 1981.
"""

from types import SimpleNamespace
from typing import Any

import numpy as np

from bench.findings.proofs.solver import by_algebra
from bench.findings.proofs.theorem import LASALLE, Proof, Theorem
from bench.findings.proofs.trace import Symbols
from bench.law.inputs import Gains
from bench.law.kinds import Baseline

JOINTS = 7
CITED = (LASALLE, "By Takegaki and Arimoto, D' - 2 C is skew-symmetric, so that V' has no term of C.")


def prove(baseline: Baseline) -> Proof:
    """Prove descent for an arm of seven joints; one of fewer is one whose other joints do not move."""
    parts = {word: tuple(f"{word}{i}" for i in range(JOINTS)) for word in ("e", "qdot", "m")}
    symbols = Symbols(("kp", "kv", *parts["e"], *parts["qdot"], *parts["m"]), ("kp", "kv", *parts["m"]))
    kp, kv = symbols["kp", "kv"]
    e, qdot, m = (symbols[parts[word]] for word in parts)
    chain = SimpleNamespace(n=JOINTS, axes=np.zeros((JOINTS, 3)), qdot=qdot)
    a, tau = list(e), [None] * JOINTS
    assemble: Any = baseline.assemble
    resolution: Any = baseline.resolution
    _, inverse = resolution
    assemble(chain, None, None, Gains(kp, kv), (), None, a)
    inverse.resolve(np.diag(m), a, None, tau, JOINTS, JOINTS, None)
    power = sum((qdot[i] * (tau[i] - kp * m[i] * e[i] + kv * m[i] * qdot[i]) for i in range(JOINTS)), symbols.number(0))
    still = [tau[i] - m[i] * (kp * e[i] - kv * qdot[i]) for i in range(JOINTS)]
    lemmas = [by_algebra("V' = -Kv qdot^T M qdot", power), by_algebra("tau = M (Kp e - Kv qdot)", still)]
    V = r"V = \tfrac12 \dot q^\top D \dot q + \tfrac12 K_p\, e^\top M e"
    return Proof(THEOREM.name, "global in the joints", lemmas, V, cited=CITED)


THEOREM = Theorem("joints", "A spring and a damper at every joint", prove, ("joint-pd",))
