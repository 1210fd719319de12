"""C13 to C16 and C28: where coordinates break down, and what integrates to no orientation (Murphy 1988, 2 and 3.3)."""

from __future__ import annotations

import numpy as np

from bench.experiments.probe_values import variables
from bench.experiments.probe_values.coordinates import ANGLE_AND_AXIS, DECADES
from bench.experiments.tables.run import MAIN_ENGINE, Run, require_rows
from bench.experiments.tables.statistics import quantile_estimate
from bench.findings.amounts import join_words
from bench.findings.claims.places import at_boundary
from bench.findings.claims.tables import (
    episodes_of,
    evidence,
    named_interval,
    rounding,
    settled,
    settled_of,
)
from bench.findings.claims.verdict import Evidence, Word, claim, word_of

DEGENERATE = 0.9
SMOOTH = 0.01
ON_POLE = 1e-12
SAME = 1e-12
# Two integrals that are not the same; two orientations that are, to rounding.
APART_RAD = 1e-3
SAME_RAD = 1e-12
# Share of angle^2 by which four turns about x, y, -x, -y must miss at least: by Campbell, Baker and Hausdorff they
# miss by angle^2 about z, less terms of third order.
COMMUTATOR = 0.5
WAYS, LEGS = variables.WAYS, variables.LEGS




@claim("C13")
def c13(run: Run) -> tuple[Word, Evidence]:
    """Condition numbers near zero rotation."""
    rows = run.probe("near-zero")
    found = {}
    for word, own in rows.groupby("representation", observed=True):
        typical = own.groupby("at")["condition"].median().sort_index(ascending=False)
        rise = float(np.diff(np.log10(typical)).min())
        found[str(word)] = (rise >= DEGENERATE, rise, float(own["condition"].max()))
    zyz, axis, vector = found["zyz-euler"], found[ANGLE_AND_AXIS], found["rotation-vector"]
    word = word_of(zyz[0] and axis[0] and vector[0], zyz[0] and axis[0] != vector[0])
    return word, evidence(
        f"""We computed the condition number of the matrix B, which maps the rates of the coordinates to the angular
        velocity. We used smaller and smaller rotations, down to 1e-{DECADES[1]} rad. Each time the rotation becomes
        ten times smaller, log10 of the condition number rises by {zyz[1]:.3f} for Z-Y-Z angles, and by {axis[1]:.3f}
        for angle and axis. The largest condition numbers are {zyz[2]:.1e} for Z-Y-Z angles, {axis[2]:.1e} for angle and
        axis, and {vector[2]:.5f} for the rotation vector.""",
        len(rows),
        measured=f"""For rotations between 1e-{DECADES[1]} and {10.0 ** -DECADES[0]:g} rad, the condition number of the
        matrix B reaches {zyz[2]:.1e} for Z-Y-Z angles. For the rotation vector, it is at most {vector[2]:.4f}.""",
    )


@claim("C14")
def c14(run: Run) -> tuple[Word, Evidence]:
    """B at half and quarter turns about Y, and what a simulation from there does."""
    least = run.probe("about-y").set_index("at")["least_of_B"]
    turns = episodes_of(run, "feedback-linearized", MAIN_ENGINE, "half-turn", "poles")
    is_about_y = turns["start_id"] == "half-turn-y-exact"
    about_y = require_rows(turns[is_about_y], "exact 180° rotation about y")
    poles = at_boundary(turns[turns["start_set"] == "poles"], "pole", "exact pole")
    word = word_of(least[180] < ON_POLE, max(least[90], least[-90]) < ON_POLE)
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
def c15(run: Run) -> tuple[Word, Evidence]:
    """R at both poles as alpha and gamma move against and with each other."""
    rows = run.probe("moved-angles")
    what = rows["case"].astype(str).str.partition("-")[0]
    most = rows["change_of_R"].groupby([rows["at"], what]).max()
    moved = {(sign, word): most[90.0 * sign, word] for sign in (1, -1) for word in ("sum", "difference")}
    by_sum = [moved[sign, "sum"] <= SAME < moved[sign, "difference"] for sign in (1, -1)]
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
        len(rows),
        measured=f"""If alpha and gamma change and their sum stays the same, elements of the rotation matrix R change by
        up to {moved[1, "sum"]:.1g} at beta = +90°, and by up to {moved[-1, "sum"]:.0e} (rounding) at beta = -90°.""",
    )


@claim("C16")
def c16(run: Run) -> tuple[Word, Evidence]:
    """B at the run's orientations and at both poles."""
    frame = episodes_of(run, "feedback-linearized", MAIN_ENGINE).drop_duplicates(["start_set", "start_id"])
    at_poles = at_boundary(frame, "pole", "exact pole")
    matrices = run.probe("largest-B")
    matrices = require_rows(matrices[matrices["case"].isin(set(frame["start_id"]))], "B of a start")
    on_pole = require_rows(matrices[matrices["case"].isin(set(at_poles["start_id"]))], "B of an exact pole")
    largest, least = float(matrices["largest_of_B"].max()), float(on_pole["least_of_B"].max())
    lacks_inverse = np.isfinite(matrices["largest_of_B"]).all() and least < ON_POLE
    word = word_of(not np.isfinite(on_pole["largest_of_B"]).all(), lacks_inverse)
    zero = rounding(least)
    so = "The results do not confirm section 3.3"
    if lacks_inverse:
        so = "B exists at all orientations, as section 3.3 says, but B^-1 does not exist at the poles"
    return word, evidence(
        f"""At {len(frame):,} orientations, no element of the matrix B is larger than {largest:.3f}. Of these
        orientations, {len(at_poles)} are exact poles (beta = +-pi/2). At these poles, the smallest
        singular value of B is {zero if zero == "0" else f"at most {zero}"}, and the second smallest singular value is
        {on_pole["second_of_B"].min():.2f} or more. {so}.""",
        len(frame),
        measured=f"""At {len(frame):,} orientations, no element of the matrix B is larger than {largest:.3g}. Of these
        orientations, {len(at_poles)} are exact poles, where the inverse B^-1 does not exist.""",
    )


@claim("C28")
def c28(run: Run) -> tuple[Word, Evidence]:
    """Ways with the same ends, a loop of zero integral, and turns about one axis."""
    rows = run.probe("ways")
    ends = rows["way_difference_rad"].dropna().to_numpy()
    looped = rows[rows["left_after_loop_rad"].notna()]
    loops = looped["left_after_loop_rad"].to_numpy()
    plane = float(rows["one_axis_gap"].max())
    is_none = ends.min() >= APART_RAD and all(
        missed >= COMMUTATOR * a * a for a, missed in zip(looped["at"], loops, strict=True)
    )
    word = word_of(is_none and plane <= SAME_RAD, is_none)
    missed = join_words(f"{angle:.3f} rad for a = {a:.3g} rad" for a, angle in zip(looped["at"], loops, strict=True))
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
