"""The tracking form of any law, from its form for a goal at rest.

    u = alpha_d + omega_d x (omega - omega_d) + law(R, omega - omega_d, R_d)

Seen from the goal the body is at R_d^T R and turns at R_d^T (omega - omega_d). With this u a law that looks at nothing
else makes that motion the one it would make towards a goal at rest, exactly: rotation after rotation, linear where it
is linear, global where it is global. A law on coordinates of R itself is not such a law; for it the form is a
feed-forward that is right at the goal.
"""

from bench.law.scalar import kernel
from bench.law.so3 import cross


@kernel
def carried_along(u, omega, omega_d, alpha_d):
    """alpha_d + omega_d x (omega - omega_d) + u [rad/s^2], base frame, u the law's command."""
    x, y, z = cross(omega_d, omega)
    return (alpha_d[0] + x + u[0], alpha_d[1] + y + u[1], alpha_d[2] + z + u[2])
