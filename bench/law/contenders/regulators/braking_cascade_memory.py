"""The braking cascade on the side of a 180° rotation that it keeps in memory.

    u = Kv (c(theta) k - omega)      theta, k: angle and axis of the turn on the kept side

The rate c is that of `braking_cascade`, and the side that of `bench.law.side`: theta goes up to
227 degrees, so that noise does not hold the body at 180°. Without a bound the law is
`rotation_vector_memory`. The memory outlives the goal: reset it before the first tick and after a
pause. When the goal jumps, a reset shortens the way and saves no time.

Source: ArduPilot's sqrt_controller (read; see `braking_cascade`) and Mayhew, Sanfelice, Teel
2011. The combination is ours.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way. If the body is more inert than its model, it brakes too late, as `braking_cascade` does.
"""

from bench.law import ADAPTED, ANGLE, DELTA, Display, Law, Look, kernel, turn_on_kept_side
from bench.law.contenders.regulators.braking_cascade import turn_at_brakeable_rate


@kernel
def law(R, omega, goal, gains, memory):
    """u = Kv (c(theta) k - omega), theta k on the kept side; memory: the quaternion (w, v) of the last tick."""
    w, v, _ = turn_on_kept_side(R, goal.R, memory, DELTA)
    return turn_at_brakeable_rate(w, v, omega, gains), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="braking-cascade-memory",
    title="Braking cascade with memory",
    source="after ArduPilot's sqrt_controller and Mayhew, Sanfelice, Teel 2011; the share 0.7 of the bound is ours",
    attribution=ADAPTED,
    formula=r"u = K_v\bigl(c(\theta)\,k - \omega\bigr), \quad c = \sqrt{2a(\theta - d/2)}"
    r" \text{ beyond } d = a K_v^2/K_p^2, \quad \theta \le 2\arccos(-\delta)",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    is_beyond_the_paper=True,
    display=Display(
        "braking cascade with memory", Look("sky", "h", "dashed"), "With the bound of the motor", ANGLE
    ),
)
