"""C40 to C43: what three variables of an orientation can and cannot be (Murphy 1988, 2.2, 3.1 and 4)."""

from __future__ import annotations

from bench.experiments.probe_values import variables
from bench.experiments.tables.run import Run
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.amounts import capitalize, count_of
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Evidence, Word, claim, word_of

MATRICES, PAIRS = variables.MATRICES, variables.PAIRS
# Of elements and determinants of order 1: some hundred roundings.
SAME = 1e-12
# Matrices, or singular values, that differ from each other, or from zero, beyond doubt.
APART = 0.01
STEPS = variables.STEPS
# Medians from which on a way is longer, or errors are uneven, by more than a controller leaves.
LONGER = 1.05
UNEVEN = 1.5


@claim("C40")
def c40(run: Run) -> tuple[Word, Evidence]:
    """Divisors of every elimination, and a second rotation with the same elements kept."""
    trios = run.probe("elimination")
    possible = trios[trios["largest_divisor"] > SAME]
    off, left = float(possible["divisor_gap"].max()), float(possible["second_gap"].max())
    apart = float(possible["second_difference"].min())
    divides, is_double = off <= SAME, left <= SAME and apart > APART
    return word_of(divides and not is_double and len(possible) == len(trios), divides and is_double), evidence(
        f"""There are {len(trios)} choices of three elements of n and o, and {len(possible)} of these choices can be
        eliminated. The elimination divides by the determinant of the derivatives of (2.5) with respect to the three
        elements. We call a quarter of this determinant the divisor. At {MATRICES} random orientations, the
        divisor differs from a product of two elements of R by at most {off:.0e}. Therefore the divisor is zero at
        some orientations. For each of these {len(possible)} choices, a second matrix has the same three remaining
        elements and satisfies (2.5) to within {left:.0e}. At the median orientation, the second matrix differs from
        R by at least {apart:.2f} in one element.""",
        MATRICES * len(trios),
        measured=f"""{capitalize(count_of(len(possible), len(trios), "choices"))} of three elements can be
        eliminated. But the three remaining elements do not determine the matrix: a second matrix has the same
        three. At the median orientation, the two matrices differ by {apart:.2f} or more in one element.""",
    )


@claim("C41")
def c41(run: Run) -> tuple[Word, Evidence]:
    """A second set of variables for random orientations, and sets for a degenerate one, of four representations."""
    sets = run.probe("two-sets")
    twice, spread = float(sets["two_sets_gap"].max()), float(sets["many_sets_gap"].max())
    word = word_of(twice <= SAME and spread <= SAME, False)
    return word, evidence(
        f"""We tested these representations: {"; ".join(sets["case"])}. In each representation and at each of
        {MATRICES} orientations, two different sets of values give the same matrix to within
        {twice:.0e}. We also took {MATRICES} sets of values at one degenerate orientation. All of
        these sets give the same matrix to within {spread:.0e}. For Z-Y-X angles and for roll, pitch and
        yaw, the degenerate orientation is a pole (beta = pi/2). For Z-Y-Z angles and for angle and axis, it is zero
        rotation.""",
        2 * len(sets) * MATRICES,
        measured=f"""We tested {len(sets)} representations at {MATRICES} orientations each. In all
        tests, two different sets of values give the same rotation matrix. The elements of the two matrices differ by at
        most {twice:.0e}.""",
    )


@claim("C42")
def c42(run: Run) -> tuple[Word, Evidence]:
    """Smallest singular value of B of every form at two middle angles, and at random ones."""
    rows = run.probe("twelve-forms")
    form = rows["case"].astype(str).str.partition("-")[0]
    forms = form.nunique()
    least, regular = float(rows["least_degenerate_gap"].max()), float(rows["least_regular"].min())
    return word_of(least <= SAME and regular > APART, False), evidence(
        f"""In all {forms} forms of Euler angles, one value of the middle angle makes the smallest singular value
        of B at most {least:.0e}. The other two angles have no influence on this singular value.
        This value of the middle angle is 0 if the first and the last axis of the form are the same, and pi/2 if they
        differ. If the middle angle is 0.8 rad, the smallest singular value of B is at least {regular:.2f}.""",
        len(rows),
        measured=f"""For each of the {forms} forms of Euler angles, the matrix B is singular at some orientation:
        there, the smallest singular value of B is {least:.0e} or less.""",
    )


@claim("C43")
def c43(run: Run) -> tuple[Word, Evidence]:
    """Lengths of straight ways in two sets of coordinates, and how unevenly errors of the angles turn the hand."""
    lines = run.probe("straight-line")
    longer = quantile_estimate(lines["length_ratio"].to_numpy(), 0.5)
    uneven = float(lines["unevenness"].median())
    return word_of(longer.value >= LONGER and uneven >= UNEVEN, False), evidence(
        f"""We took {MATRICES} pairs of random orientations. Between the two orientations of a pair, a
        straight line in Z-Y-X angles is {longer.value:.2f} times as long as the shortest path (median). A straight
        line in the rotation vector from one orientation to the other is the shortest path. A small error in the
        three Z-Y-X angles is a small rotation of the hand. Among error vectors of the same length, the greatest
        rotation is {uneven:.2f} times the smallest rotation (median). Near zero rotation, errors of the same length
        in the rotation vector are rotations by the same angle. C22 to C25 judge compliance.""",
        2 * MATRICES,
        measured=f"""We took {MATRICES} pairs of orientations. Between the two orientations of a pair, a straight
        line in Z-Y-X angles is {longer.value:.2f} times as long as the shortest path. This is the median; its
        95 % interval is {longer.low:.2f} to {longer.high:.2f}.""",
    )
