"""Impedance that leaves the hand its own inertia: tau = J^T (K e - D v) + g, what most torque-controlled arms run.

    M qddot + c + g = tau          Lambda vdot + ... = K e - D v + F,  Lambda = (J M^-1 J^T)^-1

e = (p_d - p, f(R, R_d)), f the error vector of a law: its command at omega = 0 over Kp. No force is measured and no
inertia is cancelled. With g alone compensated V = qdot^T M qdot/2 + U is a storage function, Vdot = -v^T D v; what
compensates c too, as libfranka's example does, has c in it: qdot^T c = qdot^T Mdot qdot/2, of either sign.

On seven joints the elbow is damped, -NULL_RATE (M qdot - J^T Lambda v): no acceleration of the hand, and power of
-NULL_RATE times twice the kinetic energy that the hand does not show.

D is chosen among DAMPINGS: a design computes D from K, Lambda and the desired damping ratio zeta.

Limitations: where J loses rank, Lambda, and with it D of two designs, is not finite.
Source: Hogan 1985; Albu-Schaeffer et al. 2003; frankaemika/libfranka@155ddac8, cartesian_impedance_control.cpp.
"""

from bench.law.attribution import OURS, PUBLISHED
from bench.law.kinds import Impedance
from bench.law.linalg import dot_rows, factor, gram, multiply, multiply_transposed, orthogonalize, solve_factored
from bench.law.operational_space import whiten
from bench.law.scalar import kernel, sqrt

NULL_RATE = 10.0
"""[1/s]: half of the paper's Kv, as for other controllers on seven joints (`resolved_acceleration.relax`)."""


@kernel
def apparent_inertia(J, M, Lambda, n, scratch):
    """Lambda = (J M^-1 J^T)^-1, 6 x 6, both halves."""
    S, column = scratch.A, scratch.t
    whiten(J, M, 6, n, scratch)
    gram(scratch.V, S, 6, n)
    factor(S, 6)
    for i in range(6):
        for j in range(6):
            column[j] = 1.0 if i == j else 0.0
        solve_factored(S, column, 6)
        for j in range(6):
            Lambda[j, i] = column[j]


@kernel
def damp_elbow(J, M, Lambda, qdot, v, n, w, x, tau):
    """tau = -NULL_RATE (M qdot - J^T Lambda v); w (6) and x (n) are overwritten."""
    multiply(Lambda, v, w, 6, 6)
    multiply_transposed(J, w, x, 6, n)
    multiply(M, qdot, tau, n, n)
    for i in range(n):
        tau[i] = NULL_RATE * (x[i] - tau[i])


@kernel
def damp_by_stiffness(K, Lambda, zeta, D, scratch):
    """D = 2 zeta diag(sqrt(K_i)), as if every mass were 1 kg and every inertia 1 kg m^2.

    The number depends on the units: of a hand of inertia m it makes the ratio zeta/sqrt(m).

    Limitations: a light wrist creeps back, and with D dt/m above 2 the sampled loop is unstable.
    Source: frankaemika/libfranka@155ddac80565975b58f53eb2feeb85b07a6b9e13, cartesian_impedance_control.cpp.
    """
    for i in range(6):
        for j in range(6):
            D[i, j] = 0.0
        D[i, i] = 2.0 * zeta * sqrt(K[i])


@kernel
def damp_modes(K, Lambda, zeta, D, scratch):
    """D = 2 zeta Q diag(omega_i) Q^T, with Lambda = Q Q^T and K = Q diag(omega_i^2) Q^T: zeta in every mode.

    With Lambda = L L^T and the singular values diag(sqrt(K_i))^-1 L = U Sigma V^T: Q = L V and omega_i = 1/sigma_i. D
    is 2 zeta times the geometric mean of the matrices Lambda and K, 2 zeta B diag(sigma_i^-3) B^T with B = L (V Sigma).

    Limitations: Lambda is that of the pose, so that D changes along the path.
    Source: Albu-Schaeffer, Ott, Frese, Hirzinger 2003 (ICRA, 3704-3709).
    """
    L, rows, B, k = scratch.A, scratch.B, scratch.V, scratch.s
    for i in range(6):
        for j in range(6):
            L[i, j] = Lambda[i, j]
    factor(L, 6)
    for i in range(6):
        L[i, i] = 1.0 / L[i, i]
        k[i] = sqrt(K[i])
        for j in range(6):
            if j > i:
                L[i, j] = 0.0
            rows[i, j] = L[i, j] / k[i]
    orthogonalize(rows, k, 6, 6)  # to Sigma V^T
    for i in range(6):
        for j in range(6):
            B[i, j] = dot_rows(L, i, rows, j, 6)
    for j in range(6):
        square = dot_rows(rows, j, rows, j, 6)
        scratch.t[j] = 1.0 / (square * sqrt(square))
    for i in range(6):
        for j in range(6):
            total = 0.0 * B[i, 0]
            for m in range(6):
                total = total + B[i, m] * scratch.t[m] * B[j, m]
            D[i, j] = 2.0 * zeta * total


@kernel
def damp_axes(K, Lambda, zeta, D, scratch):
    """D = 2 zeta diag(sqrt(K_i Lambda_ii)), as of one mass on a spring, axis by axis.

    Limitations: Lambda couples the axes, which is left out: no mode has the ratio zeta, and some have much less.
    """
    for i in range(6):
        for j in range(6):
            D[i, j] = 0.0
        D[i, i] = 2.0 * zeta * sqrt(K[i] * Lambda[i, i])


DAMPINGS = {
    one.name: one
    for one in (
        Impedance(
            "diagonal",
            "Twice the root of the stiffness",
            "libfranka, impedance example",
            r"D = 2\zeta\operatorname{diag}(\sqrt{K_i})",
            design=damp_by_stiffness,
            attribution=PUBLISHED,
        ),
        Impedance(
            "double-diagonalization",
            "Double diagonalization",
            "Albu-Schaeffer et al. 2003",
            r"D = 2\zeta Q \operatorname{diag}(\omega_i) Q^\top",
            design=damp_modes,
            attribution=PUBLISHED,
        ),
        Impedance(
            "per-axis",
            "A ratio for each axis",
            "this benchmark, 2026",
            r"D = 2\zeta\operatorname{diag}(\sqrt{K_i \Lambda_{ii}})",
            design=damp_axes,
            attribution=OURS,
        ),
    )
}
"""The choices of D, by the word that rows have."""
