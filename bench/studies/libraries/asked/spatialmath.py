"""Spatial Maths for Python: logarithms, the difference tr2delta, and roll, pitch and yaw."""

import numpy as np
from spatialmath import SO3, UnitQuaternion, base

from bench.studies.libraries.library import MATRIX, QUATERNION, Function, Library


def tr2delta(R) -> np.ndarray:
    """The angular part of tr2delta from the identity to a pose without translation."""
    return base.tr2delta(np.eye(4), base.r2t(R))[3:]


def angvec(found) -> np.ndarray:
    """Angle times axis of what has a method angvec."""
    theta, axis = found.angvec()
    return theta * axis


LIBRARY = Library(
    "spatialmath",
    "spatialmath-python",
    (
        Function("base.trlog", MATRIX, lambda R: base.trlog(R, twist=True)),
        Function("SO3.angvec", MATRIX, lambda R: angvec(SO3(R))),
        Function("UnitQuaternion.angvec", QUATERNION, lambda q: angvec(UnitQuaternion(q))),
        Function("base.tr2delta", MATRIX, tr2delta, "sine"),
        Function('base.tr2rpy(order="zyx")', MATRIX, lambda R: base.tr2rpy(R, order="zyx"), "z-y-x"),
    ),
)
