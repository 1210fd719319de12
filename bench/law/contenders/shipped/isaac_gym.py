"""The idiom of Isaac Gym's Franka examples: the vector part times the sign of the scalar, which is 0 at 0.

Read in a public copy of the Preview 4 package, whose own repository is not public; NVIDIA's public IsaacGymEnvs takes
the sign of zero alike (commit aeed2986, isaacgymenvs/tasks/factory/factory_control.py, line 363). Its source computes
in single precision; the law here in double.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped


@kernel
def error(q):
    """sign(eta) eps, sign(0) = 0."""
    if q[0] > 0.0:
        return (q[1], q[2], q[3])
    if q[0] < 0.0:
        return (-q[1], -q[2], -q[3])
    return (0.0 * q[1], 0.0 * q[2], 0.0 * q[3])


SHIPPED = as_shipped(
    name="isaac-gym",
    title="Isaac Gym Preview 4, Franka OSC example",
    source="notAnyrobot/isaacgym@87649bb8d53cd085594c0255d146e3570c9b750c",
    path="python/examples/franka_cube_ik_osc.py",
    level=TORQUE,
    formula=r"e = \operatorname{sign}(\eta)\,\epsilon,\ \operatorname{sign}(0) = 0",
    error=error,
    stiffness=150.0,
    damping=2.0 * 150.0**0.5,
    set_by="in the source; 2√K",
    shapes_inertia=True,
)
