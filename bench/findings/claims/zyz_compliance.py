"""C24: what Z-Y-Z angles make of compliance about x near zero, measured in free space (Murphy 1988, 3.3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims import side_by_side
from bench.findings.claims.euler_jacobian import COORDINATES
from bench.findings.claims.tables import evidence, some
from bench.findings.claims.verdict import Earlier, Word, claim, word_of

if TYPE_CHECKING:
    import pandas as pd

ZYZ, ORDER = "zyz-euler", "about x"

ZERO_RAD, SLACK_DEG = 1e-9, 1e-6
"""What rounding may make of an angle that a pose is named after."""

NEAR_DEG, LITTLE = 15.0, 0.5
"""What 'near zero' is; and the share of the wanted compliance under which something is a problem."""

LEAK = 1.0
"""Rotation about z over that about x from which on a hand turns about another axis than the compliant one."""


@claim(
    id="C24",
    section="3.3",
    quote="""
        Clearly compliance will be a problem if, for example, Z-Y-Z Euler angles are used and rotational
        compliance is desired about the x axis.
    """,
    correction="At some orientations near zero it is none, or Z-Y-X has it too.",
    written="2026-11-23 4af5940",
    earlier=(Earlier("2026-11-21 5b25b22", "Asked of commanded accelerations, and of c_xx alone.", Word.HOLDS),),
    sentence="Z-Y-Z angles are a problem where compliance about x is wanted.",
    question="What does a wrench probe about x see with Z-Y-Z angles at and near zero?",
    criterion=f"""
        wrench-probe in compliance.parquet, order 'about x', every arm and form: hybrid/zyz-euler, whose third angle is
        taken for the turn about x, against hybrid-base. A problem: it is not done, or its rotation about x per moment
        about x, c_xx, is less than {LITTLE:g} of that of hybrid-base, or its rotation about z, c_zx, is greater than
        c_xx in size. As first written, before the paper's form was there, the last was no part of it: by commanded
        accelerations both come together, by the Jacobian transpose c_xx is what is wanted wherever the hand then turns.
        Poses: the identity, and all within
        {NEAR_DEG:g} degrees of it. It holds if there is a problem at all of them, and none with hybrid/zyx-euler; with
        a correction if there is a problem at some of them, or with hybrid/zyx-euler too; if there is none, it does not
        hold. Reported: c_xx over the wanted one, c_zx over c_xx, and the verdict as first written.
        {side_by_side.DECIDES}
    """,
    open="""
        Where is not said; zero is where 2.2 has the degeneracy. No Z-Y-Z angle is one about
        x: that the third stands for it is our choice, and with the first it would be the base's z at every orientation.
    """,
)
def c24(results):
    """Z-Y-Z and Z-Y-X angles about x, by both ways to control forces."""
    return side_by_side.by_papers_form(_near_zero, results)


def _near_zero(results, forms):
    """Rotation about x and z per moment about x with Z-Y-Z and with Z-Y-X angles, over what is wanted."""
    zyz, zyx = (_about_x(results, coordinates, forms) for coordinates in (ZYZ, COORDINATES))
    at_zero = some(zyz[zyz["from_zero"] <= ZERO_RAD], f"pose of {side_by_side.PROBE} by hybrid/{ZYZ} at zero rotation")
    near = some(zyz[zyz["from_zero"] > ZERO_RAD], f"pose of {side_by_side.PROBE} by hybrid/{ZYZ} near zero rotation")
    word, first = (
        word_of(zyz[fact].all() and not zyx[fact].any(), zyz[fact].any()) for fact in ("problem", "yields_little")
    )
    done = near[near["outcome"] == "done"]
    ends = ", ".join(sorted(set(at_zero["outcome"].astype(str))))
    return word, evidence(
        f"""Z-Y-Z is a problem at {int(at_zero["problem"].sum())} of {len(at_zero)} poses at zero ({ends}) and at
        {int(near["problem"].sum())} of {len(near)} within {NEAR_DEG:g} degrees: about x it yields
        {done["yields"].min():.1e} to {done["yields"].max():.1e} of what is wanted, and about z
        {done["leak"].min():.1f} to {done["leak"].max():.1f} times as much as about x. Z-Y-X is one at
        {int(zyx["problem"].sum())} of {len(zyx)}, where it yields {zyx["yields"].min():.3f} or more. As first written:
        {first}.""",
        len(zyz) + len(zyx),
        ("compliance",),
    )


def _about_x(results, coordinates: str, forms: tuple[str, ...]) -> pd.DataFrame:
    """Poses near zero, order 'about x': c_xx over that of hybrid-base, |c_zx / c_xx|, and whether it is a problem."""
    rows = side_by_side.beside_base(results, coordinates, (ORDER,), forms)
    rows = rows[np.degrees(rows["from_zero"]) <= NEAR_DEG + SLACK_DEG].reset_index(drop=True)
    C, base = side_by_side.compliances(rows), side_by_side.compliances(rows, "_base")
    yields, leak = C[:, 0, 0] / base[:, 0, 0], np.abs(C[:, 2, 0] / C[:, 0, 0])
    little = ~(yields >= LITTLE)
    return rows.assign(yields=yields, leak=leak, yields_little=little, problem=little | (leak > LEAK))
