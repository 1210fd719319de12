"""C18, C19: the Euler Jacobian J_E, its singularities and its two derivations (Murphy 1988, 3.1-3.5)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.tables import evidence, share, some
from bench.findings.claims.verdict import MISPRINTS, Earlier, NoEvidence, Word, claim, word_of

if TYPE_CHECKING:
    import pandas as pd

COORDINATES = "zyx-euler"

WELL_CONDITIONED = 50.0
"""Condition number of J, in metres and radians, up to which the manipulator is not to blame: six times the 7.9 of the
PUMA's stock pose; a milliradian off a wrist singularity it is in the thousands."""

SLOPE, SLOPE_TIGHT = 1.0, 0.05
"""Decades a decade. cond B = (1 + |sin beta|)/cos beta is 2/d to a relative d^2 at a distance d; the constant between
it and J_E, at most cond J, bends the first decade or two. 5 % of a fit over 8 decades is a factor of 2.5 in all."""

DECADES = 8
"""Decades that the slopes are of; beyond them cos(beta) is known to less than 1e-8."""

UNBOUNDED, NEAREST = 1e10, 12
"""Largest element at 10^-12 from the pole: 1/d, less a factor 100 for J's own elements."""

EPS = 2.0**-52
ROUNDINGS = 100.0
"""A determinant or a product of 6 x 6 sums 36 rounded terms; R itself is orthonormal to a few eps only. What is
divided by cos(beta) errs by as many eps over the margin."""

AWAY, NEAR = 1e-3, 1e-6
"""The margin cos(beta) from which on agreement is required for a correction (AWAY) and to hold (NEAR)."""

DIFFERENCED = EPS ** (2 / 3)
"""What a central difference keeps: with a step of eps^(1/3) times the margin, truncation (step/margin)^2/3 and
rounding eps/step are both about eps^(2/3), over the margin."""


@claim(
    id="C18",
    section="3.1",
    equation="(3.3)",
    quote="""
        it has the property of being zero at points in the workspace as well as being undefined, or having
        elements values approaching infinity, at other points in the workspace.
    """,
    correction="Zero there is its determinant: the matrix is singular, and not zero.",
    written="2026-11-24 fb18d38",
    sentence="The Euler Jacobian adds singularities of its own, with unbounded elements, to those of the manipulator.",
    question="Does J_E grow without bound where J is well conditioned, and is it singular wherever J is?",
    criterion=f"""
        poses.parquet, Z-Y-X angles, every arm. A family is one arm posture brought to distances 10^-k from beta =
        +-pi/2; it speaks if J's condition number (metres, radians) is at most {WELL_CONDITIONED:g} at every k. (a) Own
        singularities: over k = 1 to {DECADES}, the least-squares slopes of log10 of J_E's condition number and of its
        largest element (orientation rows) are {SLOPE:g} +- {SLOPE_TIGHT:.0%} decades a decade. (b) Unbounded: at k =
        {NEAREST} the largest element is {UNBOUNDED:g} or more. (c) The manipulator's: on six joints, at every pose with
        cos(beta) >= {NEAR:g}, det J_E = -det J / cos(beta) to {ROUNDINGS:g} eps / cos(beta) of the product of J_E's row
        norms, so that det J_E is zero exactly where det J is. (d) Zero: at some pose every element of J_E is at most
        {ROUNDINGS:g} eps. It holds if all four pass; with a correction if every family of every arm passes (a) and (b)
        and every pose (c): zero is then the determinant, not the matrix; otherwise it does not hold. {MISPRINTS} An arm
        without a family is no evidence.
    """,
    open="""
        "... it has the property of being zero at points in the workspace as well as being undefined, or having elements
        values approaching infinity, at other points in the workspace." No matrix of an arm with hinges is zero; the
        smallest value that the largest element takes over all poses is reported. Families, arms and distances are ours.
    """,
    readings=(
        "'zero' of every element, as it is written (d)",
        "'zero' of the determinant: singular (c)",
    ),
    earlier=(
        Earlier(
            "2026-11-21 9b9e874",
            """
            Zero was read of the determinant, and the sentence held; but the errata list the same words as a slip
            (E10), and such a slip makes a correction.
            """,
            Word.HOLDS,
        ),
    ),
)
def c18(results):
    """Slopes towards the pole by family, the largest element on arrival, and the determinants' identity."""
    rows = some(results.table("poses", representation=COORDINATES), "pose of an arm")
    ways = _families(rows)
    silent = sorted(set(rows["arm"]) - set(ways["arm"]))
    if silent:
        raise NoEvidence(f"no well-conditioned family of poses towards the pole on {', '.join(silent)}")
    square = some(rows[rows["det_gap"].notna() & (rows["margin"] >= NEAR)], "pose of an arm with six joints")
    slopes = ways[["condition_analytic", "largest"]].to_numpy()
    errors = square["det_gap"] * square["margin"] / EPS
    tight = abs(slopes - SLOPE).max() <= SLOPE_TIGHT * SLOPE and (ways["nearest"] >= UNBOUNDED).all()
    has_own = tight and (errors <= ROUNDINGS).all()
    word = word_of(has_own and rows["largest"].min() <= ROUNDINGS * EPS, has_own)
    well = some(rows[(rows["pose_set"] == "random") & (rows["condition"] <= WELL_CONDITIONED)], "random pose")
    worse = share(well["condition_analytic"] > 10 * well["condition"])
    return word, evidence(
        f"""{len(ways)} families on {rows["arm"].nunique()} arms, J's condition number at most
        {ways["condition"].max():.0f}: towards the pole J_E's grows by {slopes[:, 0].min():.3f} to
        {slopes[:, 0].max():.3f} decades a decade, its largest element by {slopes[:, 1].min():.3f} to
        {slopes[:, 1].max():.3f}, to {ways["nearest"].min():.1e} or more at 1e-{NEAREST}. det J_E = -det J /
        cos(beta) at {len(square):,} poses, to {errors.max():.1f} eps / cos(beta). Of the random poses with J well
        conditioned, J_E has ten times its condition number at {worse}. Its largest element is nowhere below
        {rows["largest"].min():.2f}: only its determinant is ever zero.""",
        len(rows),
        ("poses",),
    )


def _families(rows: pd.DataFrame) -> pd.DataFrame:
    """Each family that speaks: slopes over the first decades, the largest element at the last, J's worst condition."""
    import pandas as pd

    pole = rows[rows["pose_set"] == "pole"]
    ids = pole["pose_id"].astype(str).str.extract(r"^(?P<family>.+)-1e-(?P<k>\d+)$")
    found = []
    for (arm, _), way in pole.assign(**ids).dropna(subset="k").groupby(["arm", "family"], observed=True):
        k = way["k"].astype(int)
        if way["condition"].max() > WELL_CONDITIONED or not {*range(1, DECADES + 1), NEAREST} <= set(k):
            continue
        near = way[k <= DECADES]
        decades = -np.log10(near["margin"])
        slopes = {name: np.polyfit(decades, np.log10(near[name]), 1)[0] for name in ("condition_analytic", "largest")}
        nearest, condition = float(way.loc[k == NEAREST, "largest"].iloc[0]), way["condition"].max()
        found.append({"arm": str(arm), **slopes, "nearest": nearest, "condition": condition})
    return pd.DataFrame(found, columns=["arm", "condition_analytic", "largest", "nearest", "condition"])


@claim(
    id="C19",
    section="3.1",
    equation="(3.3), (3.5)",
    quote="""
        The function is differentiated with respect to the joint angles and the resultant matrix is the
        manipulator Jacobian with respect to Euler angles. ... This Jacobian has the same properties as that
        presented in the previous section
    """,
    correction="The two part near the pole.",
    written="2026-11-21 f52a15d",
    sentence="Its two derivations agree: diag(I, B^-1) J, and the derivative of the forward kinematics.",
    question="Are (3.3) and (3.5) the same matrix, and that of the differentiated forward kinematics?",
    criterion=f"""
        poses.parquet, Z-Y-X angles, every arm, every pose with cos(beta) >= {NEAR:g}. The gap of two matrices is the
        largest difference of elements over the largest element. (a) Derivations: the gap between (3.3) and (3.5), the
        extraction differentiated element by element, is at most {ROUNDINGS:g} eps / cos(beta). (b) Differentiation: the
        gap between (3.3) and central differences of the judge's forward kinematics is at most {ROUNDINGS:g} eps^(2/3) /
        cos(beta). It holds if every pose passes both; with a correction if every pose with cos(beta) >= {AWAY:g} does:
        they part near the pole; otherwise it does not hold.
    """,
    open="""
        "The function is differentiated with respect to the joint angles and the resultant matrix is the manipulator
        Jacobian with respect to Euler angles." and "This Jacobian has the same properties as that presented in the
        previous section". The paper states the equality and does not show it; tolerances are ours.
    """,
)
def c19(results):
    """Both gaps at every pose away from the pole, in the units of what rounding leaves."""
    rows = some(results.table("poses", representation=COORDINATES), "pose of an arm")
    rows = some(rows[rows["margin"] >= NEAR], f"pose with cos(beta) of {NEAR:g} or more")
    differenced = rows[rows["pose_set"] != "slice"]
    for name, found in (("derivation_gap", rows), ("difference_gap", differenced)):
        silent = sorted(set(rows["arm"]) - set(found.loc[found[name].notna(), "arm"]))
        if silent:
            raise NoEvidence(f"no {name} of any pose of {', '.join(silent)}")
    kept = differenced[differenced["difference_gap"].notna()]
    derived = (rows["derivation_gap"] * rows["margin"] / EPS).fillna(np.inf)
    measured = kept["difference_gap"] * kept["margin"] / DIFFERENCED
    away = derived[rows["margin"] >= AWAY], measured[kept["margin"] >= AWAY]
    everywhere = derived.max() <= ROUNDINGS and measured.max() <= ROUNDINGS
    word = word_of(everywhere, all((part <= ROUNDINGS).all() for part in away))
    return word, evidence(
        f"""{len(rows):,} poses of {rows["arm"].nunique()} arms: (3.3) and (3.5) differ by at most {derived.max():.1f}
        eps / cos(beta), relatively; (3.3) and central differences of the forward kinematics, at {len(kept):,} of them,
        by at most {measured.max():.1f} eps^(2/3) / cos(beta). Left out, a jump of an angle between both ends of a
        difference: {len(differenced) - len(kept)}.""",
        len(rows),
        ("poses",),
    )
