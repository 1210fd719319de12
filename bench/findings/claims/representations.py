"""C13 to C16: where coordinates of a rotation break down (Murphy 1988, 2.2, 2.3 and 3.3)."""

import math

import numpy as np

from bench.contenders.registry import representation
from bench.findings.claims import probes
from bench.findings.claims.tables import MAIN_ENGINE, evidence, settled, some
from bench.findings.claims.verdict import Word, claim, word_of
from bench.law.so3 import Rotation, from_quaternion
from tasks.sphere import axes

DIRECTIONS = 12
SHIFT = 0.7
"""rad: any amount that no symmetry of the angles shares."""


DECADES = (1, 6)
DEGENERATE, SMOOTH = 0.9, 0.01
ON_POLE, OFF_POLE, SAME = 1e-12, 0.99, 1e-12

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


def _least(R) -> float:
    return float(np.linalg.svd(probes.euler_B(R), compute_uv=False)[-1])


@claim(
    id="C14",
    section="2.2 against 2.3",
    quote="With Z-Y-X Euler angles and Roll-Pitch-Yaw angles this occurs at 180° rotation about the Y, or Pitch axis.",
    value="180°",
    written="2026-11-21 9072535",
    sentence="With Z-Y-X angles the degeneracy is at a rotation of 180 degrees about Y.",
    question="Is the degenerate rotation about Y one of 180 degrees, or of 90 as the equations have it?",
    criterion=f"""
        Smallest singular value of B (2.8) at rotations of 180, 90 and -90 degrees about Y. It holds if it
        is below {ON_POLE:g} at 180 degrees; it does not hold if it is below that at both +-90 degrees and
        above {OFF_POLE} at 180; in any other case it holds with a correction. The exact half turn about y
        of the set half-turn and the exact poles say the same from simulation: whether the
        feedback-linearized law settles from them is reported.
    """,
    open="Nothing.",
)
def c14(results):
    """B at half and quarter turns about Y, and what a simulation from there does."""
    quats = {180: (0.0, 0.0, 1.0, 0.0), 90: (1.0, 0.0, 1.0, 0.0), -90: (1.0, 0.0, -1.0, 0.0)}
    half = math.sqrt(0.5)
    least = {
        degrees: _least(from_quaternion(tuple(x if degrees == 180 else half * x for x in quat)))
        for degrees, quat in quats.items()
    }
    turns = results.free_body("episodes", task="free-body", regulator="feedback-linearized", engine=MAIN_ENGINE)
    about_y = some(turns[turns["start_id"] == "half-turn-y-exact"], "exact half turn about y")
    poles = turns[turns["start_set"] == "poles"]
    poles = some(poles[probes.boundary_distance(poles)["pole"] <= probes.EXACT_RAD], "exact pole")
    at_quarter = least[90] < ON_POLE and least[-90] < ON_POLE
    if least[180] < ON_POLE:
        word = Word.HOLDS
    else:
        word = Word.FAILS if at_quarter and least[180] > OFF_POLE else Word.CORRECTED
    so = "2.3 and the equations are right, 2.2 is not" if word == Word.FAILS else "2.2 is not refuted"
    return word, evidence(
        f"""Smallest singular value of B: {least[180]:.3f} at 180 degrees about Y, {least[90]:.0e} and {least[-90]:.0e}
        at +-90. The feedback-linearized law settles from {int(settled(about_y).sum())} of {len(about_y)} exact half
        turns about y and from {int(settled(poles).sum())} of {len(poles)} exact poles. {so}.""",
        len(least) + len(about_y) + len(poles),
        ("experiment", "episodes"),
    )


def _change(to_matrix, E, other) -> float:
    return float(np.abs(np.subtract(to_matrix(E), to_matrix(other))).max())


@claim(
    id="C15",
    section="2.2",
    equation="(2.8)",
    quote="""
        It is important to note that when beta = +-pi/2 only the sum of alpha and gamma may be determined from
        the rotation matrix.
    """,
    correction="At beta = +pi/2 it is the difference, at -pi/2 the sum.",
    written="2026-11-21 9072535",
    sentence="At beta = +-pi/2 only the sum of alpha and gamma is determined.",
    question="Is it the sum at both poles?",
    criterion=f"""
        At each pole, over 64 pairs (alpha, gamma): R is the same (to {SAME:g}) if alpha grows and gamma
        falls by one amount (the sum kept), and differs if both grow. It holds if so at both poles; with a
        correction if at exactly one (the difference at the other); otherwise it does not hold.
    """,
    open="Nothing; it follows from the convention of (2.8).",
)
def c15(results):
    """R at both poles as alpha and gamma move against and with each other."""
    to_matrix = representation("zyx-euler").to_matrix
    grid = np.linspace(-3.0, 3.0, 8).tolist()
    moved = {}
    for sign in (1, -1):
        for word, direction in (("sum", -1), ("difference", 1)):
            moved[sign, word] = max(
                _change(to_matrix, (a, sign * math.pi / 2, g), (a + SHIFT, sign * math.pi / 2, g + direction * SHIFT))
                for a in grid
                for g in grid
            )
    by_sum = [moved[sign, "sum"] <= SAME < moved[sign, "difference"] for sign in (1, -1)]
    sums = [pole for pole, is_sum in zip(("+90", "-90"), by_sum, strict=True) if is_sum]
    word = {2: Word.HOLDS, 1: Word.CORRECTED, 0: Word.FAILS}[sum(by_sum)]
    so = f"Only the sum is determined at {' and '.join(sums) or 'neither pole'}"
    return word, evidence(
        f"""With the sum kept R changes by {moved[1, "sum"]:.1g} at +90 and {moved[-1, "sum"]:.0e} at -90 degrees, with
        the difference kept by {moved[1, "difference"]:.0e} and {moved[-1, "difference"]:.1g}. {so}.""",
        4 * len(grid) ** 2,
        ("experiment",),
    )


@claim(
    id="C16",
    section="2.2 against 3.3",
    equation="(2.8), (2.9)",
    quote="The matrix B does not exist whenever beta = +-pi/2 and no model is available at that point.",
    written="2026-11-21 9072535",
    sentence="B does not exist at beta = +-pi/2 (2.2); B always exists (3.3).",
    question="Which of the two sentences do B and its inverse support?",
    criterion=f"""
        B (2.8) over the run's orientations and the exact poles. The sentence of 2.2 holds if an element
        of B is not finite at a pole; it holds with a correction if B is finite at every orientation
        (elements at most 1) but of rank 2 at both poles (smallest singular value below {ON_POLE:g}), so
        that B^-1 is what does not exist and 3.3 is right; it does not hold if B is finite and of rank 3
        at a pole.
    """,
    open="Nothing.",
)
def c16(results):
    """B at the run's orientations and at both poles."""
    frame = results.episodes("feedback-linearized", MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    is_pole = (probes.boundary_distance(frame)["pole"] <= probes.EXACT_RAD).to_numpy()
    matrices = np.array([probes.euler_B(R) for R in probes.rotations(frame)])
    at_poles = some(frame[is_pole], "exact pole")
    values = np.linalg.svd(matrices[is_pole], compute_uv=False)
    largest = float(np.abs(matrices).max())
    word = word_of(not np.isfinite(matrices[is_pole]).all(), largest <= 1 + SAME and values[:, 2].max() < ON_POLE)
    so = "B exists everywhere, as 3.3 says; B^-1 does not" if word == Word.CORRECTED else "3.3 is not confirmed"
    return word, evidence(
        f"""B is finite at all {len(frame):,} orientations (elements at most {largest:.3f}); at {len(at_poles)} exact
        poles its smallest singular value is at most {float(values[:, 2].max()):.0e} and the next
        {float(values[:, 1].min()):.2f}. {so}.""",
        len(frame),
        ("episodes", "experiment"),
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
