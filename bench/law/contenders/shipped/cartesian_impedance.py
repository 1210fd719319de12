"""The Cartesian-Impedance-Controller of Mayr and Salt-Ducaju: axis times angle by Eigen.

Its source also moves goals and stiffness to their targets by a filter, and limits the change of a torque to 1 N m a
tick; the law here does not.
"""

from bench.law.kinds import TORQUE
from bench.law.shipped import as_shipped, logarithm

SHIPPED = as_shipped(
    "cartesian-impedance",
    "Cartesian-Impedance-Controller (Mayr, Salt-Ducaju)",
    "matthias-mayr/Cartesian-Impedance-Controller@b2a6137e1d14df85251692065c649e438f19076f",
    "src/cartesian_impedance_controller.cpp, src/cartesian_impedance_controller_parameters.yaml",
    TORQUE,
    r"e = \log(R_d R^\top)",
    logarithm,
    20.0,
    2.0 * 20.0**0.5,
    "defaults of the parameters; 2√K",
)
