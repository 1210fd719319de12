"""What the pages on compliance read of compliance.parquet: rows of a task, of a controller, and of a frame."""

import functools

import numpy as np
import pandas as pd

from report.figures.kit.page import Run

CARTESIAN, EULER = "hybrid-base+inverse", "hybrid/zyx-euler+inverse"
PAPERS, PAPERS_EULER = "hybrid-base+transpose", "hybrid/zyx-euler+transpose"
WORDS = ("task", "arm", "contender", "complies", "pose", "outcome", "rest", "form")


@functools.cache
def of_task(run: Run, task: str) -> pd.DataFrame:
    """Return rows of one task, with plain words and the goal's angles [deg]."""
    found = run.rows("compliance", task=task)
    found = found.assign(**{word: found[word].astype(str) for word in WORDS})
    angles = ("alpha", "beta", "gamma", "tilt")
    return found.assign(**{f"{name}_deg": np.degrees(found[name]).round(6) + 0.0 for name in angles})


def of(rows: pd.DataFrame, contender: str, complies: str = "") -> pd.DataFrame:
    """Rows of one controller, and of one order if it is named."""
    own = rows[rows["contender"] == contender]
    return own[own["complies"] == complies] if complies else own


def level(rows: pd.DataFrame) -> pd.DataFrame:
    """Return the rows whose goal has no alpha and no gamma, by beta."""
    return rows[(rows["alpha_deg"] == 0.0) & (rows["gamma_deg"] == 0.0)].sort_values("beta_deg", kind="stable")
