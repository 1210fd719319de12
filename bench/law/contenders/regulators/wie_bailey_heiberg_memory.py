"""Wie, Bailey and Heiberg's cascade on the side of a 180° rotation that it keeps in memory.

    u = Kv (c e - omega)      c = min(2 (Kp/Kv) |eps|, sqrt(4 a |eps|)),   e = eps/|eps|

Here (eta, eps) is the quaternion on the side that `bench.law.side` keeps, so that noise does not
hold the body at 180°. Without a bound the law is `hybrid`. The memory outlives the goal: reset it
before the first tick and after a pause. When the goal jumps, a reset shortens the way and saves
no time.

Source: Wie, Bailey, Heiberg 2002 (see `wie_bailey_heiberg`) and Mayhew, Sanfelice, Teel 2011. The
combination is ours.

Limitations: up to 2 asin(DELTA), 47 degrees, beyond a 180° rotation it keeps turning the longer
way. It can pass the goal, as `wie_bailey_heiberg` does.
"""

from bench.law import ADAPTED, CHORD, DELTA, Display, Law, Look, kernel, turn_on_kept_side
from bench.law.contenders.regulators.wie_bailey_heiberg import turn_at_lesser_rate


@kernel
def law(R, omega, goal, gains, memory):
    """u = Kv (c e - omega), eps on the kept side; memory: the quaternion (w, v) of the last tick."""
    w, v, root = turn_on_kept_side(R, goal.R, memory, DELTA)
    return turn_at_lesser_rate(v, root, omega, gains), (w, v[0], v[1], v[2])


REGULATOR = Law(
    name="wie-bailey-heiberg-memory",
    title="Wie, Bailey and Heiberg's cascade with memory",
    source=(
        "after Wie, Bailey, Heiberg 2002 (we read later reports, not the paper) and Mayhew, Sanfelice, Teel 2011; "
        "the share 0.7 of the bound is ours"
    ),
    attribution=ADAPTED,
    formula=r"u = K_v\Bigl(\min\bigl(2 \tfrac{K_p}{K_v}|\epsilon|,\, \sqrt{4 a |\epsilon|}\bigr)"
    r"\,\tfrac{h\,\epsilon}{|\epsilon|} - \omega\Bigr), \quad h^+ = -h \text{ where } h\,\eta < -\delta",
    law=law,
    memory=(1.0, 0.0, 0.0, 0.0),
    is_beyond_the_paper=True,
    display=Display(
        "Wie, Bailey, Heiberg with memory", Look("sky", "<", "dotted"), "With the bound of the motor", CHORD
    ),
)
