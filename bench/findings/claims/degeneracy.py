"""C13 to C16 and C28: where coordinates break down, and what integrates to no orientation (Murphy 1988, 2 and 3.3)."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from bench.base.on_first_use import Turn
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.amounts import join_words
from bench.findings.claims import probes
from bench.findings.claims.probes import at_boundary
from bench.findings.claims.tables import (
    MAIN_ENGINE,
    Results,
    evidence,
    named_interval,
    rounding,
    settled,
    settled_of,
    some,
)
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of
from bench.findings.theory.compliance_theory import matrix_B
from bench.law.contenders.registry import representation
from bench.law.so3 import Rotation
from tasks.haar import axes

LIMIT = read_limits(__file__)


LOOPS_RAD = (0.1, 0.5, 1.0, math.pi / 2)


@claim("C13")
def c13(results: Results) -> tuple[Word, Evidence]:
    """Condition numbers near zero rotation."""
    decades = range(LIMIT.DECADES[0], LIMIT.DECADES[1] + 1)
    tables = [conditions(axis, 10.0**-k) for k in decades for axis in axes(LIMIT.DIRECTIONS)]
    found = {}
    for word in tables[0]:
        numbers = np.array([one[word] for one in tables]).reshape(len(decades), -1)
        rise = np.diff(np.log10(np.median(numbers, axis=1))).min()
        found[word] = (rise >= LIMIT.DEGENERATE, float(rise), float(numbers.max()))
    zyz, axis, vector = found["zyz-euler"], found[LIMIT.ANGLE_AND_AXIS], found["rotation-vector"]
    word = word_of(zyz[0] and axis[0] and vector[0], zyz[0] and axis[0] != vector[0])
    return word, evidence(
        f"""We computed the condition number of the matrix B, which maps the rates of the coordinates to the angular
        velocity. We used smaller and smaller rotations, down to 1e-{decades[-1]} rad. Each time the rotation becomes
        ten times smaller, log10 of the condition number rises by {zyz[1]:.3f} for Z-Y-Z angles, and by {axis[1]:.3f}
        for angle and axis. The largest condition numbers are {zyz[2]:.1e} for Z-Y-Z angles, {axis[2]:.1e} for angle and
        axis, and {vector[2]:.5f} for the rotation vector.""",
        3 * len(tables),
        measured=f"""For rotations between 1e-{decades[-1]} and {10.0 ** -decades[0]:g} rad, the condition number of the
        matrix B reaches {zyz[2]:.1e} for Z-Y-Z angles. For the rotation vector, it is at most {vector[2]:.4f}.""",
    )


def turn(axis: Sequence[float] | np.ndarray, angle: float) -> Any:
    """Rodrigues' formula, complex numbers allowed."""
    x, y, z = axis
    K = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * (K @ K)


def condition_in(word: str, R: Rotation) -> float:
    """Condition number of B (2.8) of a representation at R."""
    return float(np.linalg.cond(matrix_B(representation(word), R)))


def condition_of_angle_and_axis(E: Any) -> float:
    """Compute the condition number for angle and axis: column i is vee(dR/dE_i R^T)."""

    def to_matrix(E: Sequence) -> Any:
        axis = (np.sin(E[1]) * np.cos(E[2]), np.sin(E[1]) * np.sin(E[2]), np.cos(E[1]))
        return turn(axis, E[0])

    R = to_matrix(E)
    slopes = [to_matrix(E + 1j * LIMIT.STEP * unit).imag / LIMIT.STEP @ R.T for unit in np.eye(3)]
    return float(np.linalg.cond(np.array([(S[2, 1], S[0, 2], S[1, 0]) for S in slopes]).T))


def conditions(axis: Sequence[float] | np.ndarray, angle: float) -> dict[str, float]:
    """Return the condition number in three sets of coordinates of one rotation, by their names."""
    x, y, z = axis
    R = Rotation(*(tuple(column) for column in turn(axis, angle).T.tolist()))
    found = {name: condition_in(name, R) for name in ("zyz-euler", "rotation-vector")}
    return found | {
        LIMIT.ANGLE_AND_AXIS: condition_of_angle_and_axis(np.array((angle, math.acos(z), math.atan2(y, x))))
    }


@claim("C14")
def c14(results: Results) -> tuple[Word, Evidence]:
    """B at half and quarter turns about Y, and what a simulation from there does."""
    least = {degrees: probes.least_of_B(quat) for degrees, quat in probes.ABOUT_Y.items()}
    turns = results.episodes("feedback-linearized", MAIN_ENGINE, "half-turn", "poles")
    about_y = some(turns[turns["start_id"] == "half-turn-y-exact"], "exact 180° rotation about y")
    poles = at_boundary(turns[turns["start_set"] == "poles"], "pole", "exact pole")
    word = word_of(least[180] < LIMIT.ON_POLE, max(least[90], least[-90]) < LIMIT.ON_POLE)
    so = "The equations of the paper do not correct section 2.2"
    if word == Word.CORRECTED:
        so = "Section 2.3 and the equations of the paper are right, and section 2.2 is wrong"
    return word, evidence(
        f"""The smallest singular value of the matrix B is {least[180]:.3f} at a rotation by 180 degrees about Y,
        {rounding(least[90])} at +90 degrees, and {rounding(least[-90])} at -90 degrees. In the simulation, feedback
        linearization {"settles" if settled(about_y).all() else "does not settle"} from the exact 180° rotation about
        Y. It settles from {settled_of(poles, "starts exactly on a pole")} (beta = +-90 degrees). {so}.""",
        len(least) + len(about_y) + len(poles),
        measured=f"""The smallest singular value of the matrix B is {least[180]:.3g} at a rotation by 180° about Y, and
        {rounding(least[90])} at a rotation by 90° about Y.""",
    )


@claim("C15")
def c15(results: Results) -> tuple[Word, Evidence]:
    """R at both poles as alpha and gamma move against and with each other."""
    to_matrix = representation("zyx-euler").to_matrix
    grid = np.linspace(-3.0, 3.0, 8).tolist()
    moved = {}
    for sign, (word, direction) in itertools.product((1, -1), (("sum", -1), ("difference", 1))):
        beta = sign * math.pi / 2
        apart = [
            np.subtract(to_matrix((a, beta, g)), to_matrix((a + LIMIT.SHIFT, beta, g + direction * LIMIT.SHIFT)))
            for a, g in itertools.product(grid, repeat=2)
        ]
        moved[sign, word] = np.abs(apart).max()
    by_sum = [moved[sign, "sum"] <= LIMIT.SAME < moved[sign, "difference"] for sign in (1, -1)]
    sums = [pole for pole, is_sum in zip(("+90", "-90"), by_sum, strict=True) if is_sum]
    verdict = {2: Word.HOLDS, 1: Word.CORRECTED, 0: Word.FAILS}[sum(by_sum)]
    where = f"at beta = {' and '.join(sums)} degrees" if sums else "at neither pole"
    so = f"R determines the sum of alpha and gamma, and only this sum, {where}"
    return verdict, evidence(
        f"""If alpha and gamma change and their sum stays the same, elements of the rotation matrix R change by up to
        {moved[1, "sum"]:.1g} at beta = +90 degrees, and by up to {moved[-1, "sum"]:.0e} at beta = -90 degrees. If alpha
        and gamma change and their difference stays the same, elements of R change by up to
        {moved[1, "difference"]:.0e} at beta = +90 degrees, and by up to {moved[-1, "difference"]:.1g} at beta = -90
        degrees. {so}.""",
        4 * len(grid) ** 2,
        measured=f"""If alpha and gamma change and their sum stays the same, elements of the rotation matrix R change by
        up to {moved[1, "sum"]:.1g} at beta = +90°, and by up to {moved[-1, "sum"]:.0e} (rounding) at beta = -90°.""",
    )


@claim("C16")
def c16(results: Results) -> tuple[Word, Evidence]:
    """B at the run's orientations and at both poles."""
    frame = results.episodes("feedback-linearized", MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    at_poles = at_boundary(frame, "pole", "exact pole")
    is_pole = frame.index.isin(at_poles.index)
    matrices = np.array([probes.euler_B(R) for R in probes.rotations(frame)])
    values = np.linalg.svd(matrices[is_pole], compute_uv=False)
    largest = float(np.abs(matrices).max())
    lacks_inverse = np.isfinite(matrices).all() and values[:, 2].max() < LIMIT.ON_POLE
    word = word_of(not np.isfinite(matrices[is_pole]).all(), lacks_inverse)
    zero = rounding(float(values[:, 2].max()))
    so = "The results do not confirm section 3.3"
    if lacks_inverse:
        so = "B exists at all orientations, as section 3.3 says, but B^-1 does not exist at the poles"
    return word, evidence(
        f"""At {len(frame):,} orientations, no element of the matrix B is larger than {largest:.3f}. Of these
        orientations, {len(at_poles)} are exact poles (beta = +-pi/2). At these poles, the smallest
        singular value of B is {zero if zero == "0" else f"at most {zero}"}, and the second smallest singular value is
        {float(values[:, 1].min()):.2f} or more. {so}.""",
        len(frame),
        measured=f"""At {len(frame):,} orientations, no element of the matrix B is larger than {largest:.3g}. Of these
        orientations, {len(at_poles)} are exact poles, where the inverse B^-1 does not exist.""",
    )


@claim("C28")
def c28(results: Results) -> tuple[Word, Evidence]:
    """Ways with the same ends, a loop of zero integral, and turns about one axis."""
    ends, loops, plane = results.found_by(ways, results.seed)
    is_none = ends.min() >= LIMIT.APART_RAD and all(
        missed >= LIMIT.COMMUTATOR * a * a for a, missed in zip(LOOPS_RAD, loops, strict=True)
    )
    word = word_of(is_none and plane <= LIMIT.SAME_RAD, is_none)
    missed = join_words(f"{angle:.3f} rad for a = {a:.3g} rad" for a, angle in zip(LOOPS_RAD, loops, strict=True))
    return word, evidence(
        f"""We used {len(ends)} pairs of paths. Both paths of a pair lead to the same orientation, but their
        integrals differ by {ends.min():.2f} to {ends.max():.2f} rad. A body turned about x, y, -x and -y, by the
        angle a each time. The integrals of the four turns sum to zero. But after the four turns, the angle of the
        body's rotation was {missed}. If all turns of a path are about one axis, the integral gives the rotation,
        with an error of at most {plane:.0e} rad.""",
        2 * len(ends) + len(loops),
        measured=f"""Along two paths to the same orientation, the integrals of the angular velocity
        differ by {named_interval(quantile_estimate(ends, 0.5), ".2f", " rad")}. This is the median
        of {len(ends)} pairs of paths.""",
    )


def ways(seed: int) -> tuple[np.ndarray, list[float], float]:
    """Distances of the integrals of two ways with the same ends, what closed loops leave, what a plane does."""
    rng = np.random.default_rng(seed)
    end, between = Turn.random(LIMIT.WAYS, rng=rng), Turn.random(LIMIT.WAYS, rng=rng)
    by_way = between.as_rotvec() + (end * between.inv()).as_rotvec()
    ends = np.linalg.norm(end.as_rotvec() - by_way, axis=1)
    x, y = np.eye(3)[:2]
    loops = [float(_after([a * x, a * y, -a * x, -a * y]).magnitude()) for a in LOOPS_RAD]
    axes = rng.normal(size=(LIMIT.WAYS, 3))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    turns = [
        angles[:, None] * axis for axis, angles in zip(axes, rng.uniform(-3, 3, (LIMIT.WAYS, LIMIT.LEGS)), strict=True)
    ]
    plane = max(float((Turn.from_rotvec(legs.sum(axis=0)).inv() * _after(legs)).magnitude()) for legs in turns)
    return ends, loops, plane


def _after(legs: Sequence) -> Turn:
    """Compute the orientation after turns in the base frame, one after the other."""
    return functools.reduce(lambda at, leg: Turn.from_rotvec(leg) * at, legs, Turn.identity())
