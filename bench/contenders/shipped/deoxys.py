"""Operational-space control of deoxys: the bare vector part, each component of it zero within a deadband.

Kv = 2 sqrt(Kp) is critical of a stiffness that is not felt: half of Kp is, so the damping ratio is sqrt(2).
"""

from bench.law import kernel
from bench.law.shipped import TORQUE, Shipped, vector_part

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


SHIPPED = Shipped(
    "deoxys",
    "deoxys_control, OSC_POSE",
    "UT-Austin-RPL/deoxys_control@49e63283db98c2217294a788404474192cc151eb",
    "deoxys/franka-interface/src/controllers/osc_impedance.cpp, deoxys/config/osc-pose-controller.yml",
    TORQUE,
    r"e_i = \operatorname{sgn}(\eta)\,\epsilon_i \text{ or } 0 \text{ within } 0.005",
    error,
    250.0,
    2.0 * 250.0**0.5,
    "osc-pose-controller.yml; 2√K",
    shapes_inertia=True,
    besides="adds residual masses to the model, and repels joints from their limits",
)
