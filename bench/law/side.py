"""The side of a 180° rotation that a law keeps in memory: which of the two quaternions of a turn it acts on.

Every turn has two unit quaternions, (eta, eps) and its opposite. A law of the shorter one jumps at a 180°
rotation, and noise can hold it there. With the hysteresis below it jumps later, and only once: the quaternion
is followed from tick to tick, and its sign changes only where eta has fallen below -delta. No continuous law
without memory is global (Bhat & Bernstein 2000). The memory outlives the goal: reset it before the first tick
and after a pause. When the goal jumps, a reset shortens the way and saves no time.

Source: Mayhew, Sanfelice, Teel 2011. The hysteresis is theirs: a side h changes where
h eta < -delta, here with the quaternion lifted again in every tick. delta = 0.4 is, by all appearance, theirs too: a
public code for example 7.7 of Markley and Crassidis, "the first example" of that paper, has it
(7ganam/attitude-determinatio-and-control-system, ch7/example7_7a.m, at ac4f373d).
"""

from bench.law.scalar import kernel, sqrt
from bench.law.so3 import turn_quaternion

DELTA = 0.4
"""Half the width of the hysteresis, in eta = cos(theta/2): a side is kept for 47 degrees beyond a 180° rotation."""


@kernel
def turn_on_kept_side(R, R_d, memory, delta):
    """(w, v, root): the quaternion of the turn from R to R_d on the kept side, base frame, of length 2 root, root >= 1.

    memory: the quaternion (w, v) that this returned in the last tick, of any length; at first (1, 0, 0, 0).
    """
    w, v, t = turn_quaternion(R, R_d)
    root = sqrt(t)
    kept = memory[0] * w + memory[1] * v[0] + memory[2] * v[1] + memory[3] * v[2]
    if kept < 0.0 and w < 2.0 * delta * root:
        w, v = -w, (-v[0], -v[1], -v[2])
    return w, v, root
