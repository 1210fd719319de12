"""The logarithm of the whole pose: xi = (rho, phi) with X = exp(xi), rho = (I - [phi]x/2 + b [phi]x^2) p.

    f = -K rho        m = -Kr phi        b = (1 - (theta/2) cot(theta/2))/theta^2

With K = Kr I as a velocity command X(t) = exp(e^(-k t) xi): one screw, whichever point of the hand is its origin; the
path of that point is |rho|/|p| times the straight one.

Limitations: it is no spring, not with K = k I either; the origin's path is bent, the more the hand has to turn.

Source: Park 1995, Distance metrics on the rigid-body motions with applications to mechanism design (the logarithm).
"""

from bench.law import Spring, divide_by_left_jacobian, kernel, rotation_vector, times


@kernel
def wrench(q, p, K, Kr):
    """Return (-K rho, -Kr phi)."""
    phi = rotation_vector(q)
    f = times(K, divide_by_left_jacobian(q, phi, p))
    return (-f[0], -f[1], -f[2]), (-Kr * phi[0], -Kr * phi[1], -Kr * phi[2])


SPRING = Spring("log-pose", "Logarithm of the pose", "Park 1995", r"-K\rho,\ -k_r\phi", wrench)
