"""Four ways to run the same episode, all by the loop of `loop`.

reference   dm_control's Environment with the plain Python law: slow, and the truth
native      MuJoCo stepped from compiled code, the reference's numbers bit for bit
ideal-rk4   (2.6)-(2.7) without MuJoCo, continuous: Runge-Kutta on the columns of R
ideal-held  the same plant sampled, the command held over each tick
"""

from bench.engines import cache  # first of all: it chooses where numba keeps compiled code

__all__ = ["cache"]
