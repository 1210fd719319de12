"""C13: coordinates that are degenerate at zero rotation (Murphy 1988, 2.2)."""

import math

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import claim, word_of
from bench.law.so3 import Rotation
from tasks.sphere import axes

DIRECTIONS = 12
DECADES = (1, 6)
DEGENERATE, SMOOTH = 0.9, 0.01
STEP = 1e-30
"""Of the complex-step derivative, which has no cancellation: any tiny number does."""

ANGLE_AND_AXIS = "angle and axis"
"""The angle, and the polar and azimuth angle of the axis: coordinates that no controller here uses."""


@claim(
    id="C13",
    section="2.2",
    quote="""
        With the Equivalent angle-axis, and the Z-Y-Z Euler angle representations infinite sets of Euler angles
        for a given orientation occurs at zero rotation from the initial reference orientation. ... were not
        appropriate for investigation into orientation control.
    """,
    correction="""
        Angle and axis kept apart are degenerate at zero; their product, the rotation vector, is regular there
        and fit.
    """,
    written="2026-11-21 9072535",
    sentence="""
        Z-Y-Z Euler angles and equivalent angle-axis are degenerate at zero rotation: unfit to regulate
        about it.
    """,
    question="How does the map from coordinate rates to angular velocity behave at rotations of 10^-k rad?",
    criterion=f"""
        Condition number of that map at rotations of 10^-k rad, k = {DECADES[0]} to {DECADES[1]}, about 12
        directions. Degenerate: log10 of the condition number rises by at least {DEGENERATE} per decade.
        Smooth: it is within {SMOOTH:.0%} of 1 throughout. Judged on Z-Y-Z; on angle and axis (angle and
        two angles of a unit axis); and on the rotation vector (axis times angle). It holds if all three
        are degenerate; with a correction if Z-Y-Z is, and exactly one of the other two; otherwise it does
        not hold.
    """,
    open="""
        The paper does not say whether angle-axis means angle and axis kept apart or their product: its
        source has both.
    """,
    readings=(
        "angle and axis kept apart",
        "the rotation vector, axis times angle",
    ),
)
def c13(results):
    """Condition numbers near zero rotation."""
    decades = range(DECADES[0], DECADES[1] + 1)
    tables = [conditions(axis, 10.0**-k) for k in decades for axis in axes(DIRECTIONS)]
    found = {}
    for word in tables[0]:
        numbers = np.array([one[word] for one in tables]).reshape(len(decades), -1)
        rise = np.diff(np.log10(np.median(numbers, axis=1))).min()
        found[word] = (rise >= DEGENERATE, float(rise), float(numbers.max()))
    zyz, axis, vector = found["zyz-euler"], found[ANGLE_AND_AXIS], found["rotation-vector"]
    is_zyz, is_axis, is_vector = zyz[0], axis[0], vector[0]
    word = word_of(is_zyz and is_axis and is_vector, is_zyz and is_axis != is_vector)
    return word, evidence(
        f"""Per decade towards zero rotation the condition number of the rate map rises by {zyz[1]:.3f} decades for
        Z-Y-Z and {axis[1]:.3f} for angle and axis (to {zyz[2]:.1e} and {axis[2]:.1e}); for the rotation vector it is at
        most {vector[2]:.5f}.""",
        3 * len(tables),
        ("experiment",),
    )


def turn(axis, angle):
    """Rodrigues' formula, complex numbers allowed."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


def condition_in(word: str, R: Rotation) -> float:
    """Condition number of B (2.8) of a representation at R."""
    coordinates = representation(word)
    at = coordinates.chart(R)
    columns = [coordinates.angular_velocity(at, tuple(unit)) for unit in np.eye(len(coordinates.symbols)).tolist()]
    return float(np.linalg.cond(np.array(columns).T))


def condition_of_angle_and_axis(E) -> float:
    """The same of angle and axis: column i is vee(dR/dE_i R^T)."""

    def to_matrix(E):
        axis = (np.sin(E[1]) * np.cos(E[2]), np.sin(E[1]) * np.sin(E[2]), np.cos(E[1]))
        return turn(axis, E[0])

    R = to_matrix(E)
    slopes = [to_matrix(E + 1j * STEP * unit).imag / STEP @ R.T for unit in np.eye(3)]
    return float(np.linalg.cond(np.array([(S[2, 1], S[0, 2], S[1, 0]) for S in slopes]).T))


def conditions(axis, angle) -> dict[str, float]:
    """The condition number in three sets of coordinates of one rotation, by their names."""
    x, y, z = axis
    R = Rotation(*(tuple(column) for column in turn(axis, angle).T.tolist()))
    of_axis = condition_of_angle_and_axis(np.array((angle, math.acos(z), math.atan2(y, x))))
    return {
        "zyz-euler": condition_in("zyz-euler", R),
        ANGLE_AND_AXIS: of_axis,
        "rotation-vector": condition_in("rotation-vector", R),
    }
