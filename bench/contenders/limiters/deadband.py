"""A band of error per axis within which nothing is commanded.

deoxys has one of 5e-3 on its error, the quaternion's vector part; here it is on the law's error, whatever that is.
The tool stops where each component of the error is inside the band: up to sqrt(3) of it away, 0.5 degrees here.

Fails: from starts so near that what is left is not inside their settling band.
"""

from bench.law import Limiter, kernel

BAND = 5e-3
"""[rad]"""


@kernel
def passed(x, least):
    """x, or 0 within [-least, least]."""
    if -least <= x <= least:
        return 0.0 * x
    return x


@kernel
def limit(omega, K):
    """Each component, or 0 where the error that it is K times of is within BAND."""
    least = BAND * K
    return (passed(omega[0], least), passed(omega[1], least), passed(omega[2], least))


LIMITER = Limiter(
    "deadband",
    "Deadband per axis",
    "UT-Austin-RPL/deoxys_control f2932a0, osc_impedance.cpp",
    r"\omega_i \text{ if } |\omega_i| > K d, \text{ else } 0",
    limit,
)
