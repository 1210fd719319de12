"""The impedance controller of serl_franka: the vector part without factor 2, each component clipped, and an integral.

The clip bounds the torque at K times 0.05 about each axis. The integral adds up the clipped error tick by tick, without
dt; its gain is 0 as delivered, so that there is none here. Its source also filters gains and goals.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, clipped, vector_part

CLIP = 0.05


@kernel
def error(q):
    """sgn(eta) eps, each component in [-CLIP, CLIP], in the base frame."""
    return clipped(vector_part(q), CLIP)


SHIPPED = as_shipped(
    "serl-franka",
    "serl_franka_controllers, Cartesian impedance",
    "rail-berkeley/serl_franka_controllers@5576ce172b9e1414b078ddf8582aafccd741f3c7",
    "src/cartesian_impedance_controller.cpp, cfg/compliance_param.cfg",
    TORQUE,
    r"e_i = \operatorname{clip}(\operatorname{sgn}(\eta)\,\epsilon_i,\, 0.05)",
    error,
    150.0,
    7.0,
    "defaults of two parameters",
    unbounded=vector_part,
    bound=CLIP,
)
