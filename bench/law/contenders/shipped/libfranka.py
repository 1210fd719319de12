"""The Cartesian impedance example of libfranka: that of franka_ros without filters; its gains are in the source."""

from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, vector_part

SHIPPED = as_shipped(
    "libfranka",
    "libfranka, Cartesian impedance example",
    "frankaemika/libfranka@155ddac80565975b58f53eb2feeb85b07a6b9e13",
    "examples/cartesian_impedance_control.cpp",
    TORQUE,
    r"e = \operatorname{sgn}(\eta)\,\epsilon",
    vector_part,
    10.0,
    2.0 * 10.0**0.5,
    "in the source; 2√K",
)
