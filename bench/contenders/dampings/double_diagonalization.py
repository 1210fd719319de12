"""Double diagonalization: Lambda and K are made diagonal together, and every mode gets the ratio that is asked for.

    Lambda = Q Q^T,   K = Q diag(omega_i^2) Q^T,   D = 2 zeta Q diag(omega_i) Q^T

With Lambda = L L^T and the singular values diag(sqrt(K_i))^-1 L = U Sigma V^T: Q = L V and omega_i = 1/sigma_i. D is
2 zeta times the geometric mean of the matrices Lambda and K.

Fails: Lambda is not finite where J loses rank; it is Lambda of the pose, so that it changes along the way.
"""

from bench.law import Damping, factor, kernel, orthogonalize, sqrt


@kernel
def design(K, Lambda, zeta, D, scratch):
    """D = 2 zeta B diag(sigma_i^-3) B^T, B = L (V Sigma): sigma_i times the columns of Q."""
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
            total = L[i, 0] * rows[j, 0]
            for m in range(1, 6):
                total = total + L[i, m] * rows[j, m]
            B[i, j] = total
    for j in range(6):
        square = rows[j, 0] * rows[j, 0]
        for m in range(1, 6):
            square = square + rows[j, m] * rows[j, m]
        scratch.t[j] = 1.0 / (square * sqrt(square))
    for i in range(6):
        for j in range(6):
            total = 0.0 * B[i, 0]
            for m in range(6):
                total = total + B[i, m] * scratch.t[m] * B[j, m]
            D[i, j] = 2.0 * zeta * total


DAMPING = Damping(
    "double-diagonalization",
    "Double diagonalization",
    "Albu-Schaeffer, Ott, Frese, Hirzinger 2003 (ICRA, 3704-3709)",
    r"D = 2 \zeta\, Q \Omega Q^\top,\ \Lambda = Q Q^\top,\ K = Q \Omega^2 Q^\top",
    design,
)
