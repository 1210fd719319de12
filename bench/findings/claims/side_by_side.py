"""Rows of compliance.parquet by two controllers side by side, and how far measured compliances are apart.

The paper's force control, by the Jacobian transpose, decides; what comes of the two forms that command accelerations
is said beside it, by the same criterion.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from typing import Any

import numpy as np

from bench.base.on_first_use import pd
from bench.experiments.tables.run import Run, require_rows
from bench.findings.claims.once import once_a_run
from bench.findings.claims.places import turns_of
from bench.findings.claims.tables import evidence
from bench.findings.claims.verdict import Evidence, Word
from bench.law.control.contact_controller import ACCELERATION_FORMS, PAPERS_FORM, hybrid
from bench.law.control.setpoint import ContactParameters
from bench.law.inputs import Gains

PROBE, BASE = "wrench-probe", "hybrid-base"
MEASURED = tuple(f"c_{i}{j}" for i in "xyz" for j in "xyz")
PAIRED = ("task", "arm", "form", "pose", "complies")
"""What two controllers' rows have in common: the same arm, scene, frame of the hand, order and form."""

OF_POSES = (*Gains._fields, *ContactParameters._fields, "horizon_s", "alpha", "beta", "gamma", "outcome", *MEASURED)
"""Columns that measured compliances are compared by, with each other and with their closed form."""

DECIDES = f"""
    We simulated several variants of force control (the column `form` of compliance.parquet). The verdict comes from the
    variant '{PAPERS_FORM}', because this variant is the paper's force control ("converted to joint torques by the
    Jacobian transpose", 3.3). Our first verdict came from the variants
    {" and ".join(f"'{form}'" for form in ACCELERATION_FORMS)}, which command accelerations. We still report the results
    of these variants, judged by the same criterion.
    """


def by_either_form(decide: Callable[..., tuple[Word, Evidence]]) -> Callable[..., tuple[Word, Evidence]]:
    """Wrap a judging function of (run, forms): if both ways to control forces give one word, that is the word.

    Else it depends on how it is read, for the paper's sentence says of neither that it is meant.
    """

    @functools.wraps(decide)
    def judge(run: Run) -> Any:
        word, papers = decide(run, (PAPERS_FORM,))
        other, ours = decide(run, ACCELERATION_FORMS)
        instead = (
            f"With commanded accelerations, the claim {other}. {ours.instead} "
            f"With forces by the Jacobian transpose, the claim {word}. "
        )
        return word if word == other else Word.READING, evidence(
            f"""With forces by the Jacobian transpose, the claim {word}. {papers}
            With commanded accelerations, the claim {other}. {ours}""",
            papers.rows + ours.rows,
            papers.tables,
            instead + papers.instead if word != other else "",
            f"With forces by J^T: {papers.measured} With commanded accelerations: {ours.measured}",
        )

    return judge


def by_papers_form(decide: Callable[..., tuple[Word, Evidence]]) -> Callable[..., tuple[Word, Evidence]]:
    """Wrap a judging function of (run, forms) to ask the paper's force control, then commanded accelerations."""

    @functools.wraps(decide)
    def judge(run: Run) -> Any:
        word, papers = decide(run, (PAPERS_FORM,))
        other, ours = decide(run, ACCELERATION_FORMS)
        return word, evidence(
            f"""With forces by the Jacobian transpose, the claim {word}. {papers}
            With commanded accelerations, the claim {other}. {ours}""",
            papers.rows + ours.rows,
            papers.tables,
            measured=papers.measured,
        )

    return judge


def beside_base(run: Run, representation: str, orders: tuple[str, ...], forms: tuple[str, ...]) -> pd.DataFrame:
    """Return rows of wrench-probe of a hybrid controller in coordinates, with those of hybrid-base (suffix `_base`).

    A row each arm, form, pose and order that both have; cos_beta and from_zero (the angle of R) [rad] are added.
    """
    both = paired(run, representation, forms, OF_POSES, PROBE)
    for order in orders:
        require_rows(
            both[both["complies"] == order],
            f"pose of {PROBE} by hybrid/{representation} and {BASE}, +{' or +'.join(forms)}, {order}",
        )
    both = both[both["complies"].isin(orders)].reset_index(drop=True)
    angles = both[["alpha", "beta", "gamma"]].to_numpy()
    return both.assign(cos_beta=np.cos(both["beta"]), from_zero=turns_of(angles))


@once_a_run
def paired(
    run: Run, representation: str, forms: tuple[str, ...], columns: tuple[str, ...], task: str = ""
) -> pd.DataFrame:
    """Rows of a hybrid controller in coordinates, with those of hybrid-base (suffix `_base`), of some forms.

    columns: what is compared, beside PAIRED. task: the only one whose rows are compared; all if it is empty.
    """
    words = {"task": task} if task else {}
    own = run.table("compliance", controller="hybrid", representation=representation, **words)
    base = run.table("compliance", controller=BASE, **words)
    own, base = (_columns_of(rows, forms, columns) for rows in (own, base))
    return own.merge(base, on=list(PAIRED), suffixes=("", "_base"))


def _columns_of(rows: pd.DataFrame, forms: tuple[str, ...], columns: tuple[str, ...]) -> pd.DataFrame:
    """Return some columns of the rows of some forms, and PAIRED as plain words, which two frames are merged by."""
    chosen = rows.loc[rows["form"].isin(forms).to_numpy(), [*PAIRED, *columns]]
    return chosen.assign(**{name: chosen[name].astype(object) for name in PAIRED})


def compliances(rows: pd.DataFrame, suffix: str = "") -> np.ndarray:
    """C, n x 3 x 3 [rad/(N m)]: measured rotation (row) per moment (column); NaN of a row that is not done."""
    C = rows[[name + suffix for name in MEASURED]].to_numpy(float).reshape(-1, 3, 3)
    return np.where((rows[f"outcome{suffix}"] == "done").to_numpy()[:, None, None], C, np.nan)


def predicted(rows: pd.DataFrame, representation: str = "") -> np.ndarray:
    """C in closed form, n x 3 x 3: of hybrid control in coordinates, or of hybrid-base, in the form of each row."""
    import tasks
    from bench.findings.theory.compliance_theory import compliance
    from bench.law.contenders.registry import contenders
    from bench.law.so3 import from_quaternion
    from tasks.domains.wrench_probe import SPECIFICATIONS
    from tasks.rotations import zyx

    along, law = contenders("representations").get(representation), "hybrid" if representation else BASE
    told = {one.name: one for one in SPECIFICATIONS}
    arms = {name: tasks.arm(name) for name in rows["arm"].unique()}
    found = np.empty((len(rows), 3, 3))
    for k, row in enumerate(rows.to_dict("records")):
        gains = Gains(*(row[name] for name in Gains._fields))
        touch = ContactParameters(*(row[name] for name in ContactParameters._fields))
        goal = from_quaternion(zyx(row["alpha"], row["beta"], row["gamma"]))
        one = hybrid(law, row["form"], along)
        found[k] = compliance(one, told[row["complies"]], goal, row["horizon_s"], gains, touch, arms[row["arm"]])
    return found


def apart(C: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """|C - C'| / |C'|, n; NaN where one of them was not measured."""
    return np.linalg.norm(C - reference, axis=(1, 2)) / np.linalg.norm(reference, axis=(1, 2))


def turned(C: np.ndarray, Q: np.ndarray) -> np.ndarray:
    """Q C Q^T: the compliance of the same thing, turned."""
    return Q @ C @ Q.transpose(0, 2, 1)


def planes_apart(C: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Angle between the planes in which the hand turns most [rad], n: of the two greater singular values."""
    found = np.full(len(C), np.nan)
    measured = np.isfinite(C).all(axis=(1, 2)) & np.isfinite(reference).all(axis=(1, 2))
    if measured.any():
        one, other = (np.linalg.svd(each[measured])[0][:, :, 2] for each in (C, reference))  # normals of the planes
        sine = np.linalg.norm(np.cross(one, other), axis=1)
        found[measured] = np.arctan2(sine, np.abs(np.sum(one * other, axis=1)))
    return found
