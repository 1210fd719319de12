"""The logarithm of the whole pose: xi = (rho, phi) with X = exp(xi), rho = (I - [phi]x/2 + b [phi]x^2) p.

    f = -K rho        m = -kr phi        b = (1 - (theta/2) cot(theta/2))/theta^2

With K = kr I as a velocity command X(t) = exp(e^(-k t) xi): one screw, whichever point of the hand is its origin; that
point's way is |rho|/|p| times the straight one.

Fails: it is no spring, not with K = k I either; the origin's way is bent, the more the hand has to turn.

Source: Park 1995, Distance metrics on the rigid-body motions with applications to mechanism design (the logarithm).
"""

from bench.law import PoseSpring, cross, dot, kernel, rotation_vector, sqrt, times


@kernel
def logarithm(q, p):
    """(rho, phi); b is its series below 0.01 rad."""
    phi = rotation_vector(q)
    squared = dot(phi, phi)
    b = 1.0 / 12.0 + squared / 720.0
    if squared > 1e-4:
        length = sqrt(q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
        b = (1.0 - 0.5 * sqrt(squared) * q[0] / length) / squared
    c = cross(phi, p)
    d = cross(phi, c)
    rho = (p[0] - 0.5 * c[0] + b * d[0], p[1] - 0.5 * c[1] + b * d[1], p[2] - 0.5 * c[2] + b * d[2])
    return rho, phi


@kernel
def wrench(q, p, K, kr):
    """(-K rho, -kr phi)."""
    rho, phi = logarithm(q, p)
    f = times(K, rho)
    return (-f[0], -f[1], -f[2]), (-kr * phi[0], -kr * phi[1], -kr * phi[2])


POSE_SPRING = PoseSpring("log-pose", "Logarithm of the pose", "Park 1995", r"-K\rho,\ -k_r\phi", wrench)
