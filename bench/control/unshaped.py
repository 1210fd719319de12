"""Impedance that leaves the hand its own inertia: tau = J^T (K e - D v) + g, what most torque-controlled arms run.

    M qddot + c + g = tau          Lambda vdot + ... = K e - D v + F,  Lambda = (J M^-1 J^T)^-1

e = (p_d - p, f(R, R_d)), f the error vector of a law: its command at omega = 0 over Kp. No force is measured and no
inertia is cancelled. With g alone compensated V = qdot^T M qdot/2 + U is a storage function, Vdot = -v^T D v; what
compensates c too, as libfranka's example does, has c in it: qdot^T c = qdot^T Mdot qdot/2, of either sign.

On seven joints the elbow is damped, -NULL_RATE (M qdot - J^T Lambda v): no acceleration of the hand, and power of
-NULL_RATE times twice the kinetic energy that the hand does not show.

Fails: where J loses rank, Lambda, and with it D of two designs, is not finite.
Source: Hogan 1985; Albu-Schaeffer et al. 2003; frankaemika/libfranka@155ddac8, cartesian_impedance_control.cpp.
"""

from bench.law.linalg import factor, gram, multiply, multiply_transposed, solve_factored, solve_lower
from bench.law.scalar import kernel

NULL_RATE = 10.0
"""[1/s]: half of the paper's Kv, as for other controllers on seven joints (`resolved_acceleration.relax`)."""


@kernel
def apparent_inertia(J, M, Lambda, n, scratch):
    """Lambda = (J M^-1 J^T)^-1, 6 x 6, both halves."""
    L, Y, S, column = scratch.B, scratch.V, scratch.A, scratch.t
    for i in range(n):
        for j in range(i + 1):
            L[i, j] = M[i, j]
    factor(L, n)
    for i in range(6):
        for j in range(n):
            column[j] = J[i, j]
        solve_lower(L, column, n)
        for j in range(n):
            Y[i, j] = column[j]
    gram(Y, S, 6, n)
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
