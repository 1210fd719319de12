"""Rows of compliance.parquet by two controllers side by side, and how far measured compliances are apart."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bench.findings.claims.tables import some

if TYPE_CHECKING:
    import pandas as pd

PROBE, BASE = "wrench-probe", "hybrid-base"
MEASURED = tuple(f"c_{i}{j}" for i in "xyz" for j in "xyz")
PAIRED = ("task", "arm", "form", "pose", "complies")
"""What two controllers' rows have in common: the same arm, scene, frame of the hand, order and way to the joints."""


def beside_base(results, representation: str, orders: tuple[str, ...]) -> pd.DataFrame:
    """Rows of wrench-probe of a hybrid controller in coordinates, with those of hybrid-base (suffix `_base`).

    Returns:
        a row each arm, form, pose and order that both have; cos_beta and from_zero (the angle of R) [rad] are added.
    Errors:
        NoEvidence: there is none of one of the orders.
    """
    from scipy.spatial.transform import Rotation as Turn

    both = paired(results, representation, task=PROBE)
    for order in orders:
        some(both[both["complies"] == order], f"pose of {PROBE} by hybrid/{representation} and {BASE}, {order}")
    both = both[both["complies"].isin(orders)].reset_index(drop=True)
    angles = both[["alpha", "beta", "gamma"]].to_numpy()
    from_zero = Turn.from_euler("ZYX", angles).magnitude()
    return both.assign(cos_beta=np.cos(both["beta"]), from_zero=from_zero)


def paired(results, representation: str, **words: str) -> pd.DataFrame:
    """Rows of a hybrid controller in coordinates, with those of hybrid-base (suffix `_base`)."""
    own = results.table("compliance", controller="hybrid", representation=representation, **words)
    base = results.table("compliance", controller=BASE, **words)
    return _in_words(own).merge(_in_words(base), on=list(PAIRED), suffixes=("", "_base"))


def _in_words(frame: pd.DataFrame) -> pd.DataFrame:
    return frame.assign(**{name: frame[name].astype(str) for name in PAIRED})


def compliances(rows: pd.DataFrame, suffix: str = "") -> np.ndarray:
    """C, n x 3 x 3 [rad/(N m)]: measured rotation (row) per moment (column); NaN of a row that is not done."""
    C = rows[[name + suffix for name in MEASURED]].to_numpy(float).reshape(-1, 3, 3)
    return np.where((rows[f"outcome{suffix}"] == "done").to_numpy()[:, None, None], C, np.nan)


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
