"""C24: Z-Y-Z angles where compliance about x is wanted (Murphy 1988, 3.3)."""

import numpy as np
import pandas as pd

from bench.findings.claims import side_by_side
from bench.findings.claims.compliance import ONE_AXIS, SLACK_DEG, ZERO_RAD
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import Word, claim

ZYZ = "zyz-euler"

NEAR_DEG, LITTLE = 15.0, 0.5
"""What 'near zero' is; and the share of the wanted compliance under which something is a problem."""

C24 = claim(
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
    if zyz["problem"].all() and not zyx["problem"].any():
        word = Word.HOLDS
    else:
        word = Word.CORRECTED if zyz["problem"].any() else Word.FAILS
    done = near[near["outcome"] == "done"]
    misaligned = (done["c_zx"] / done["c_xx"]).abs()
    return word, evidence(
        """Z-Y-Z is a problem at {zero_k} of {zero_n} poses at zero ({ends}) and at {near_k} of {near_n} within
        {near_deg:g} degrees: about x it yields {least:.1e} to {most:.1e} of what is wanted, and about z
        {misaligned:.1f} to {farthest:.1f} times that. Z-Y-X is one at {zyx_k} of {zyx_n}, where it
        yields {zyx_least:.3f} or more.""",
        len(zyz) + len(zyx),
        ("compliance",),
        zero_k=int(at_zero["problem"].sum()),
        zero_n=len(at_zero),
        ends=", ".join(sorted(set(at_zero["outcome"].astype(str)))),
        near_k=int(near["problem"].sum()),
        near_n=len(near),
        near_deg=NEAR_DEG,
        least=done["yields"].min(),
        most=done["yields"].max(),
        misaligned=misaligned.min(),
        farthest=misaligned.max(),
        zyx_k=int(zyx["problem"].sum()),
        zyx_n=len(zyx),
        zyx_least=zyx["yields"].min(),
    )


def _about_x(results, coordinates: str) -> pd.DataFrame:
    """Poses near zero, order 'about x': c_xx over that of hybrid-base, and whether it is a problem."""
    rows = side_by_side.beside_base(results, coordinates, ONE_AXIS[:1])
    rows = rows[np.degrees(rows["from_zero"]) <= NEAR_DEG + SLACK_DEG].reset_index(drop=True)
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    yields = C[:, 0, 0] / base[:, 0, 0]
    return rows.assign(yields=yields, problem=~(yields >= LITTLE))


CLAIMS = (C24.judged_by(c24),)
