"""Operational-space control of deoxys: the vector part without factor 2, its components zero within a deadband.

D = 2 sqrt(K) is critical for K; half of K is felt, so that the damping ratio is sqrt(2). Its source also takes goals as
steps from the present pose and interpolates them, adds residual masses to the model, pulls the elbow to a posture and
repels joints from their limits; the law here does not.
"""

from bench.law import kernel
from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, vector_part

DEADBAND = 5e-3


@kernel
def without(x):
    """x, or 0 within the deadband."""
    if -DEADBAND < x < DEADBAND:
        return 0.0 * x
    return x


@kernel
def error(q):
    """sgn(eta) eps, its components within DEADBAND set to 0."""
    e = vector_part(q)
    return (without(e[0]), without(e[1]), without(e[2]))


SHIPPED = as_shipped(
    name="deoxys",
    title="deoxys_control, OSC_POSE",
    source="UT-Austin-RPL/deoxys_control@49e63283db98c2217294a788404474192cc151eb",
    path="deoxys/franka-interface/src/controllers/osc_impedance.cpp, deoxys/config/osc-pose-controller.yml",
    level=TORQUE,
    formula=r"e_i = \operatorname{sgn}(\eta)\,\epsilon_i \text{ or } 0 \text{ within } 0.005",
    error=error,
    stiffness=250.0,
    damping=2.0 * 250.0**0.5,
    set_by="osc-pose-controller.yml; 2√K",
    shapes_inertia=True,
    thread="UT-Austin-RPL/deoxys_control#40",
)
