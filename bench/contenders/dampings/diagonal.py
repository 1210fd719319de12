"""The shipped rule: twice the root of each stiffness, as if every mass were 1 kg and every inertia 1 kg m^2.

libfranka's and franka_ros's examples, and what copies them. The number depends on the units: of a hand of inertia m it
makes the ratio 1/sqrt(m).

Fails: a light wrist is damped so much that it creeps back, and with D dt/m above 2 the sampled loop is unstable.
"""

from bench.law import Damping, kernel, sqrt


@kernel
def design(K, Lambda, zeta, D, scratch):
    """D = 2 zeta diag(sqrt(K_i))."""
    for i in range(6):
        for j in range(6):
            D[i, j] = 0.0
        D[i, i] = 2.0 * zeta * sqrt(K[i])


DAMPING = Damping(
    "diagonal",
    "Twice the root of the stiffness",
    "frankaemika/libfranka@155ddac80565975b58f53eb2feeb85b07a6b9e13, examples/cartesian_impedance_control.cpp",
    r"D = 2 \zeta\, \mathrm{diag}(\sqrt{K_i})",
    design,
)
