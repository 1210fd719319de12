"""No limit: the robot gets the command of the law.

Fails: nowhere; far from the goal it may ask for more than a robot turns.
"""

from bench.law import Limiter, kernel


@kernel
def limit(omega, K):
    """Omega as it is."""
    return omega


LIMITER = Limiter("none", "None", "", r"\omega", limit)
