"""Operational-space control of robosuite: half the sum of the columns' cross products, the law of 1980.

Its docstring promises axis times angle, which this is near the goal alone. As delivered, goals are steps of at most
0.5 rad from the present pose, so that a 180° rotation is not asked for. Read in the wheel of the release.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped


@kernel
def error(q):
    """sin(theta) k = 2 eta eps, of either sign of q."""
    return (2.0 * q[0] * q[1], 2.0 * q[0] * q[2], 2.0 * q[0] * q[3])


SHIPPED = as_shipped(
    name="robosuite",
    title="robosuite, OSC_POSE",
    source="ARISE-Initiative/robosuite@v1.5.2",
    path="robosuite/utils/control_utils.py, robosuite/controllers/parts/arm/osc.py, "
    "robosuite/controllers/config/robots/default_panda.json",
    level=TORQUE,
    formula=r"e = \tfrac12 (n \times n_d + o \times o_d + a \times a_d) = \sin\theta\,k",
    error=error,
    stiffness=150.0,
    damping=2.0 * 150.0**0.5,
    set_by="default_panda.json; damping ratio 1",
    shapes_inertia=True,
)
