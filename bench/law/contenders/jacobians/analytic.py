"""The Euler Jacobian by conversion, J_E = diag(I, B^-1) J, and Jdot_E qdot from Jdot qdot (Murphy 1988, 3.3-3.7).

In any representation. Of a quaternion there are four rows, (1/2) Xi(q) z_i, a Jacobian of 7 x n and rank 6. Along q
itself, out of the unit sphere, no motion can be commanded, and the drift leaves its own part -|omega|^2 / 4 q out. No
inverse sees either: J_E^T (0, q) = 0, and each of them is J_E^T (J_E J_E^T + ...)^-1 a or (...) J_E^T a.

Limitations: where the coordinates are singular, B^-1 and with it J_E are not finite, and where the arm itself is
singular.
"""

from bench.law import AT_REST, PUBLISHED, Jacobian, kernel
from bench.law.contenders.jacobians.geometric import fill as fill_geometric

STILL_QUATERNION = (0.0, 0.0, 0.0, 0.0)


def kernels_in(representation):
    """fill and drift in the coordinates of one representation."""
    rates, accelerate = representation.rates, representation.accelerate
    count = len(representation.symbols)
    still = AT_REST if count < 4 else STILL_QUATERNION

    @kernel
    def fill(J, chain, at):
        """J_i = [z_i x (p - p_i); B^-1 z_i] (Murphy 1988, 3.3)."""
        fill_geometric(J, chain)
        for i in range(chain.n):
            turned = rates(at, (J[3, i], J[4, i], J[5, i]))
            for k in range(count):
                J[3 + k, i] = turned[k]

    @kernel
    def drift(chain, at, Edot, omega, bias):
        """Jdot_E qdot = (pddot, B^-1 (omegadot - Bdot Edot)), pddot and omegadot those of Jdot qdot."""
        bent = accelerate(at, Edot, still)
        # added, not spread with a star: compiled code has no (*a, *b) of tuples
        turned = rates(at, (bias[3] - bent[0], bias[4] - bent[1], bias[5] - bent[2]))
        return (bias[0], bias[1], bias[2]) + turned  # noqa: RUF005

    return fill, drift


JACOBIAN = Jacobian(
    name="analytic",
    title="Analytic, converted",
    source="Murphy 1988, (3.3)-(3.7)",
    attribution=PUBLISHED,
    formula=r"J_E = \operatorname{diag}(I, B^{-1})\, J, \quad "
    r"\dot J_E \dot q = \bigl(\ddot p,\; B^{-1} (\dot\omega - \dot B \dot E)\bigr)\big|_{\ddot q = 0}",
    takes="coordinates",
    kernels_in=kernels_in,
)
