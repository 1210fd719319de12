"""The Cartesian controller of crisp_controllers: the logarithm, each component clipped in the base frame.

Its source also moves the goal to its target by slerp, smooths joint states and torques, limits the change of a torque
to 0.5 N m a tick, and cancels the inertia on request; the law here does none of this, so that its response is faster.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, clipped, logarithm

CLIP_RAD = 0.5


@kernel
def error(q):
    """log(R_d R^T), each component in [-CLIP_RAD, CLIP_RAD]."""
    return clipped(logarithm(q), CLIP_RAD)


SHIPPED = as_shipped(
    "crisp",
    "crisp_controllers, Cartesian controller",
    "utiasDSL/crisp_controllers@2b33ab777caf3d3e5d0d3ff39b8ba036a75e9e68",
    "src/cartesian_controller.cpp, src/cartesian_controller.yaml",
    TORQUE,
    r"e_i = \operatorname{clip}(\log(R_d R^\top)_i,\, 0.5)",
    error,
    30.0,
    2.0 * 30.0**0.5,
    "defaults of the parameters; 2√K",
    unbounded=logarithm,
    bound=CLIP_RAD,
)
