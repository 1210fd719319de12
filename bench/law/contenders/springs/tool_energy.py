"""The spring whose stiffness of position turns with the tool, of U = p_b^T K p_b/2 + Kr |phi|^2/2, p_b = R^T p.

    f = -K p_b        m = p_b x K p_b - Kr phi

p_b' = v - omega x p_b, so that the gradient has a moment of its own.

Limitations: jumps at 180 degrees.

Source: Fasse, Broenink 1997, A spatial impedance controller for robotic manipulation (springs that turn with a body).
"""

from bench.law import Spring, cross, dot, from_quaternion, kernel, rotate_back, rotation_vector, times


@kernel
def wrench(q, p, K, Kr):
    """Return (-K p_b, p_b x K p_b - Kr phi)."""
    p_b, phi = rotate_back(from_quaternion(q), p), rotation_vector(q)
    f = times(K, p_b)
    m = cross(p_b, f)
    return (-f[0], -f[1], -f[2]), (m[0] - Kr * phi[0], m[1] - Kr * phi[1], m[2] - Kr * phi[2])


@kernel
def potential(q, p, K, Kr):
    """Return p_b^T K p_b/2 + Kr |phi|^2/2 [J]."""
    p_b, phi = rotate_back(from_quaternion(q), p), rotation_vector(q)
    return 0.5 * dot(p_b, times(K, p_b)) + 0.5 * Kr * dot(phi, phi)


SPRING = Spring(
    "tool-energy",
    "Energy of the position in the tool's axes",
    "Fasse & Broenink 1997",
    r"-K p_b,\ p_b\times K p_b - k_r\phi",
    wrench,
    potential,
)
