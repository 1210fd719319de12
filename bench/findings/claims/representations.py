"""C40 to C43: what three variables of an orientation can and cannot be (Murphy 1988, 2.2, 3.1 and 4).

Oracle: scipy's rotations.
"""

from __future__ import annotations

import itertools

import numpy as np

from bench.base.on_first_use import Turn
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.amounts import capitalize, count_of
from bench.findings.claims.tables import Results, evidence
from bench.findings.claims.verdict import Evidence, Word, claim, read_limits, word_of

LIMIT = read_limits(__file__)


@claim("C40")
def c40(results: Results) -> tuple[Word, Evidence]:
    """Divisors of every elimination, and a second rotation with the same elements kept."""
    R = Turn.random(LIMIT.MATRICES, rng=np.random.default_rng(results.seed)).as_matrix()
    trios = list(itertools.combinations(range(6), 3))
    possible = [trio for trio in trios if np.abs(divisor(R, trio)).max() > LIMIT.SAME]
    off = max(float(np.abs(divisor(R, trio) - product(R, trio)).max()) for trio in possible)
    second = [another(R, trio) for trio in possible]
    both = (other[:, :, :2] for other in second)  # n and o, of which (2.5) says that they are orthonormal
    left = max(float(np.abs(pair.swapaxes(1, 2) @ pair - np.eye(2)).max()) for pair in both)
    apart = min(float(np.median(np.abs(other - R).max(axis=(1, 2)))) for other in second)
    divides, is_double = off <= LIMIT.SAME, left <= LIMIT.SAME and apart > LIMIT.APART
    return word_of(divides and not is_double and len(possible) == len(trios), divides and is_double), evidence(
        f"""There are {len(trios)} choices of three elements of n and o, and {len(possible)} of these choices can be
        eliminated. The elimination divides by the determinant of the derivatives of (2.5) with respect to the three
        elements. We call a quarter of this determinant the divisor. At {LIMIT.MATRICES} random orientations, the
        divisor differs from a product of two elements of R by at most {off:.0e}. Therefore the divisor is zero at
        some orientations. For each of these {len(possible)} choices, a second matrix has the same three remaining
        elements and satisfies (2.5) to within {left:.0e}. At the median orientation, the second matrix differs from
        R by at least {apart:.2f} in one element.""",
        LIMIT.MATRICES * len(trios),
        measured=f"""{capitalize(count_of(len(possible), len(trios), "choices"))} of three elements can be
        eliminated. But the three remaining elements do not determine the matrix: a second matrix has the same
        three. At the median orientation, the two matrices differ by {apart:.2f} or more in one element.""",
    )


def divisor(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Compute the determinant of the derivatives of (2.5) by three of n_x, n_y, n_z, o_x, o_y, o_z, over 4."""
    n, o = R[:, :, 0], R[:, :, 1]
    zero = np.zeros_like(n)
    slopes = np.stack([np.hstack([2 * n, zero]), np.hstack([zero, 2 * o]), np.hstack([o, n])], axis=1)
    return np.linalg.det(slopes[:, :, list(trio)]) / 4


def product(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Compute the same by theory: an element of the column with one eliminated, times one of a = n x o."""
    of_n, of_o = [i for i in trio if i < 3], [i - 3 for i in trio if i >= 3]
    alone, pair = (of_o, of_n) if len(of_n) == 2 else (of_n, of_o)
    third = 3 - sum(pair)
    sign = -1.0 if third != 1 else 1.0
    return sign * R[:, alone[0], 1 if alone is of_o else 0] * R[:, third, 2]


def another(R: np.ndarray, trio: tuple[int, ...]) -> np.ndarray:
    """Return rotations with the same three elements left: two of one column reflected about the other column's two."""
    of_n = [i for i in trio if i < 3]
    column, pair = (0, of_n) if len(of_n) == 2 else (1, [i - 3 for i in trio if i >= 3])
    other = R.copy()
    along = R[:, pair, 1 - column] / np.linalg.norm(R[:, pair, 1 - column], axis=1)[:, None]
    part = R[:, pair, column]
    other[:, pair, column] = 2 * (part * along).sum(axis=1)[:, None] * along - part
    other[:, :, 2] = np.cross(other[:, :, 0], other[:, :, 1])
    return other


@claim("C41")
def c41(results: Results) -> tuple[Word, Evidence]:
    """A second set of variables for random orientations, and sets for a degenerate one, of four representations."""
    rng = np.random.default_rng(results.seed)
    sets = rng.uniform(0.1, 1.4, (LIMIT.MATRICES, 3))
    flipped = (sets + np.array((np.pi, 0.0, np.pi))) * np.array((1.0, -1.0, 1.0))
    mirrored = flipped + np.array((0.0, np.pi, 0.0))
    angle, axis = sets[:, :1], sets / np.linalg.norm(sets, axis=1)[:, None]
    pairs = {
        "Z-Y-X": (_of("ZYX", sets), _of("ZYX", mirrored)),
        "Z-Y-Z": (_of("ZYZ", sets), _of("ZYZ", flipped)),
        "roll, pitch and yaw": (_of("xyz", sets[:, ::-1]), _of("xyz", mirrored[:, ::-1])),
        "angle and axis": (_about(axis, angle), _about(-axis, -angle)),
    }
    twice = {name: float(np.abs(one - other).max()) for name, (one, other) in pairs.items()}
    shifts = rng.uniform(-3.0, 3.0, (LIMIT.MATRICES, 1))
    pole, zero = np.full_like(shifts, np.pi / 2), np.zeros_like(shifts)
    many = {
        "Z-Y-X": _of("ZYX", np.hstack([shifts, pole, shifts])),
        "Z-Y-Z": _of("ZYZ", np.hstack([shifts, zero, -shifts])),
        "roll, pitch and yaw": _of("xyz", np.hstack([shifts, pole, shifts])),
        "angle and axis": _about(axis, zero),
    }
    spread = {name: float(np.abs(R - R[0]).max()) for name, R in many.items()}
    word = word_of(max(twice.values()) <= LIMIT.SAME and max(spread.values()) <= LIMIT.SAME, False)
    return word, evidence(
        f"""We tested these representations: {"; ".join(pairs)}. In each representation and at each of
        {LIMIT.MATRICES} orientations, two different sets of values give the same matrix to within
        {max(twice.values()):.0e}. We also took {LIMIT.MATRICES} sets of values at one degenerate orientation. All of
        these sets give the same matrix to within {max(spread.values()):.0e}. For Z-Y-X angles and for roll, pitch and
        yaw, the degenerate orientation is a pole (beta = pi/2). For Z-Y-Z angles and for angle and axis, it is zero
        rotation.""",
        2 * len(pairs) * LIMIT.MATRICES,
        measured=f"""We tested {len(pairs)} representations at {LIMIT.MATRICES} orientations each. In all
        tests, two different sets of values give the same rotation matrix. The elements of the two matrices differ by at
        most {max(twice.values()):.0e}.""",
    )


def _of(sequence: str, angles: np.ndarray) -> np.ndarray:
    with np.errstate(all="ignore"):
        return Turn.from_euler(sequence, angles).as_matrix()


def _about(axis: np.ndarray, angle: np.ndarray) -> np.ndarray:
    return Turn.from_rotvec(axis * angle).as_matrix()


FORMS = tuple("".join(axes) for axes in itertools.product("XYZ", repeat=3) if axes[0] != axes[1] != axes[2])
"""The twelve forms of Euler angles, each turn about an axis of the body."""


@claim("C42")
def c42(results: Results) -> tuple[Word, Evidence]:
    """Smallest singular value of B of every form at two middle angles, and at random ones."""
    outer = np.random.default_rng(results.seed).uniform(-3.0, 3.0, (LIMIT.PAIRS, 2)).tolist()
    least = {
        form: max(least_of(form, (one, 0.0 if form[0] == form[2] else np.pi / 2, two)) for one, two in outer)
        for form in FORMS
    }
    regular = min(least_of(form, (one, 0.8, two)) for form in FORMS for one, two in outer)
    return word_of(max(least.values()) <= LIMIT.SAME and regular > LIMIT.APART, False), evidence(
        f"""In all {len(FORMS)} forms of Euler angles, one value of the middle angle makes the smallest singular value
        of B at most {max(least.values()):.0e}. The other two angles have no influence on this singular value.
        This value of the middle angle is 0 if the first and the last axis of the form are the same, and pi/2 if they
        differ. If the middle angle is 0.8 rad, the smallest singular value of B is at least {regular:.2f}.""",
        2 * len(FORMS) * LIMIT.PAIRS,
        measured=f"""For each of the {len(FORMS)} forms of Euler angles, the matrix B is singular at some orientation:
        there, the smallest singular value of B is {max(least.values()):.0e} or less.""",
    )


def least_of(form: str, angles: tuple[float, float, float]) -> float:
    """Compute the smallest singular value of B: its columns are the axes of the three turns in the base."""
    axes = np.eye(3)[["XYZ".index(letter) for letter in form]]
    first = Turn.from_euler(form[0], angles[0])
    second = first * Turn.from_euler(form[1], angles[1])
    B = np.array([axes[0], first.apply(axes[1]), second.apply(axes[2])]).T
    return float(np.linalg.svd(B, compute_uv=False)[-1])


@claim("C43")
def c43(results: Results) -> tuple[Word, Evidence]:
    """Lengths of straight ways in two sets of coordinates, and how unevenly errors of the angles turn the hand."""
    rng = np.random.default_rng(results.seed)
    start, end = (Turn.random(LIMIT.MATRICES, rng=rng) for _ in range(2))
    shortest = (end * start.inv()).magnitude()
    first, last = (one.as_euler("ZYX") for one in (start, end))
    steps = np.linspace(0.0, 1.0, LIMIT.STEPS)
    ways = [Turn.from_euler("ZYX", first + s * (last - first)) for s in steps]
    length = np.sum([(after * before.inv()).magnitude() for before, after in itertools.pairwise(ways)], axis=0)
    longer = quantile_estimate(length / shortest, 0.5)
    tilts = np.abs(np.sin(first[:, 1]))
    uneven = float(np.median(np.sqrt((1 + tilts) / (1 - tilts))))  # singular values of B: 1 and sqrt(1 -+ |sin beta|)
    return word_of(longer.value >= LIMIT.LONGER and uneven >= LIMIT.UNEVEN, False), evidence(
        f"""We took {LIMIT.MATRICES} pairs of random orientations. Between the two orientations of a pair, a
        straight line in Z-Y-X angles is {longer.value:.2f} times as long as the shortest path (median). A straight
        line in the rotation vector from one orientation to the other is the shortest path. A small error in the
        three Z-Y-X angles is a small rotation of the hand. Among error vectors of the same length, the greatest
        rotation is {uneven:.2f} times the smallest rotation (median). Near zero rotation, errors of the same length
        in the rotation vector are rotations by the same angle. C22 to C25 judge compliance.""",
        2 * LIMIT.MATRICES,
        measured=f"""We took {LIMIT.MATRICES} pairs of orientations. Between the two orientations of a pair, a straight
        line in Z-Y-X angles is {longer.value:.2f} times as long as the shortest path. This is the median; its
        95 % interval is {longer.low:.2f} to {longer.high:.2f}.""",
    )
