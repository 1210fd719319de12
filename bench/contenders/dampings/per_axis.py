"""A ratio for each axis: twice the root of the stiffness times the inertia felt along that axis.

Fails: Lambda couples the axes, and what couples is left out: no mode has the ratio that was asked for, and some have
much less.
"""

from bench.law import Damping, kernel, sqrt


@kernel
def design(K, Lambda, zeta, D, scratch):
    """D = 2 zeta diag(sqrt(K_i Lambda_ii))."""
    for i in range(6):
        for j in range(6):
            D[i, j] = 0.0
        D[i, i] = 2.0 * zeta * sqrt(K[i] * Lambda[i, i])


DAMPING = Damping(
    "per-axis",
    "A ratio for each axis",
    "of one mass on a spring, D = 2 zeta sqrt(K m), axis by axis",
    r"D = 2 \zeta\, \mathrm{diag}(\sqrt{K_i \Lambda_{ii}})",
    design,
)
