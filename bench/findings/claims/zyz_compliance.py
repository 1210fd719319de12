"""C24: Z-Y-Z angles where compliance about x is wanted (Murphy 1988, 3.3)."""

import numpy as np
import pandas as pd

from bench.findings.claims import side_by_side
from bench.findings.claims.compliance import ONE_AXIS, SLACK_DEG, ZERO_RAD
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import claim, word_of

ZYZ = "zyz-euler"

NEAR_DEG, LITTLE = 15.0, 0.5
"""What 'near zero' is; and the share of the wanted compliance under which something is a problem."""


@claim(
    id="C24",
    section="3.3",
    sentence="Z-Y-Z angles are a problem where compliance about x is wanted.",
    question="What does a wrench probe about x see with Z-Y-Z angles at and near zero?",
    criterion=f"""
        wrench-probe in compliance.parquet, order 'about x', every arm and form: hybrid/zyz-euler, whose third angle is
        taken for the turn about x, against hybrid-base. A problem: it is not done, or its rotation about x per moment
        about x, c_xx, is less than {LITTLE:g} of that of hybrid-base. Poses: the identity, and all within
        {NEAR_DEG:g} degrees of it. It holds if there is a problem at all of them, and none with hybrid/zyx-euler; with
        a correction if there is a problem at some of them, or with hybrid/zyx-euler too; if there is none, it does not
        hold. Reported: c_xx over the wanted one, and c_zx, the rotation about z, over c_xx.
    """,
    open="""
        "Clearly compliance will be a problem if, for example, Z-Y-Z Euler angles are used and rotational compliance is
        desired about the x axis." Where is not said; zero is where 2.2 has the degeneracy. No Z-Y-Z angle is one about
        x: that the third stands for it is our choice, and with the first it would be the base's z at every orientation.
    """,
)
def c24(results):
    """Rotation about x per moment about x with Z-Y-Z and with Z-Y-X angles, over what is wanted."""
    zyz, zyx = (_about_x(results, coordinates) for coordinates in (ZYZ, COORDINATES))
    at_zero = some(zyz[zyz["from_zero"] <= ZERO_RAD], f"pose of {side_by_side.PROBE} by hybrid/{ZYZ} at zero rotation")
    near = some(zyz[zyz["from_zero"] > ZERO_RAD], f"pose of {side_by_side.PROBE} by hybrid/{ZYZ} near zero rotation")
    word = word_of(zyz["problem"].all() and not zyx["problem"].any(), zyz["problem"].any())
    done = near[near["outcome"] == "done"]
    misaligned = (done["c_zx"] / done["c_xx"]).abs()
    ends = ", ".join(sorted(set(at_zero["outcome"].astype(str))))
    return word, evidence(
        f"""Z-Y-Z is a problem at {int(at_zero["problem"].sum())} of {len(at_zero)} poses at zero ({ends}) and at
        {int(near["problem"].sum())} of {len(near)} within {NEAR_DEG:g} degrees: about x it yields
        {done["yields"].min():.1e} to {done["yields"].max():.1e} of what is wanted, and about z {misaligned.min():.1f}
        to {misaligned.max():.1f} times that. Z-Y-X is one at {int(zyx["problem"].sum())} of {len(zyx)}, where it yields
        {zyx["yields"].min():.3f} or more.""",
        len(zyz) + len(zyx),
        ("compliance",),
    )


def _about_x(results, coordinates: str) -> pd.DataFrame:
    """Poses near zero, order 'about x': c_xx over that of hybrid-base, and whether it is a problem."""
    rows = side_by_side.beside_base(results, coordinates, ONE_AXIS[:1])
    rows = rows[np.degrees(rows["from_zero"]) <= NEAR_DEG + SLACK_DEG].reset_index(drop=True)
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    yields = C[:, 0, 0] / base[:, 0, 0]
    return rows.assign(yields=yields, problem=~(yields >= LITTLE))
