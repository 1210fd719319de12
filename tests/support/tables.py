"""Tables that a test has written or changed, claims judged on them, and the edits of planted_claims.toml."""

import functools
import math
from pathlib import Path

import numpy as np
import pandas as pd

from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.findings.claims.euler_jacobian import EPS, WELL_CONDITIONED
from support.claim_tables import YIELDS

NO_TIMINGS = Path("no-such-folder")


def judged(id: str, others=None, **tables: pd.DataFrame):
    """The verdict on these tables, and runs at other gains; nothing was timed but what is among them."""
    return claims.judge(id, Run(None, tables, NO_TIMINGS, others=others))


def decided(verdict, word) -> bool:
    """Whether that is the verdict, on some rows and with a number for evidence."""
    texts = str(verdict.evidence), verdict.evidence.measured
    have_numbers = all(any(map(str.isdigit, text)) for text in texts)
    return verdict.word == word and verdict.rows > 0 and have_numbers


def changed(frame: pd.DataFrame, rows, **cells) -> pd.DataFrame:
    """The frame with some cells of some rows set, or turned by a function."""
    frame = frame.copy()
    for name, value in cells.items():
        if isinstance(frame[name].dtype, pd.CategoricalDtype):
            frame[name] = frame[name].astype(str)
        frame.loc[rows, name] = value(frame.loc[rows, name]) if callable(value) else value
    return frame


def table(name, folder="reference"):
    """Return a table of results with plain words and `law`; read once, and what is changed is the caller's alone."""
    return _read(name, folder).copy(deep=False)


@functools.cache
def _read(name, folder):
    found = pd.read_parquet(RESULTS / folder / f"{name}.parquet")
    found = found.astype(dict.fromkeys(found.select_dtypes("category").columns, str))
    if "regulator" in found:
        found["law"] = found["regulator"] + np.where(found["representation"] == "", "", "/") + found["representation"]
    return found


OTHER_ARM = {"puma560": "ur5e", "ur5e": "puma560"}
NAMES = {"EPS": EPS, "YIELDS": YIELDS, "WELL_CONDITIONED": WELL_CONDITIONED}
NAMES |= {"nan": math.nan, "inf": math.inf, "pi": math.pi, "OTHER_ARM": OTHER_ARM}
"""What expressions name by @."""


def look_up(frame, text):
    """Return the value of an expression over the columns and a few more."""
    more = {"number": np.arange(len(frame))}
    if "contender" in frame or "regulator" in frame:
        own = frame if "representation" in frame else frame.assign(regulator=frame["contender"], representation="")
        form = own["representation"].astype(str)
        more["law"] = own["regulator"].astype(str) + np.where(form == "", "", "/") + form
    if {"alpha", "beta", "gamma"} <= {*frame}:
        degrees = np.degrees(frame[["alpha", "beta", "gamma"]]).round().astype(int).astype(str)
        more["at"] = degrees.agg(" ".join, axis=1)
    if "beta" in frame:
        more["lean"] = np.degrees(frame["beta"]).round(6)
    return frame.assign(**more).eval(text, engine="python", local_dict=NAMES)
