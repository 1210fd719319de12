"""Tables that a test has written or changed, and claims judged on them."""

from pathlib import Path

import numpy as np
import pandas as pd

from bench.experiments.tables.schema import RESULTS
from bench.findings import claims
from bench.findings.claims.tables import Results

NO_TIMINGS = Path("no-such-folder")


def judged(id: str, experiments=None, **tables: pd.DataFrame):
    """The verdict on these tables, and experiments if they are given; nothing was timed but what is among them."""
    return claims.judge(id, Results(None, tables, NO_TIMINGS, experiments=experiments))


def decided(verdict, word) -> bool:
    """Whether that is the verdict, on some rows and with a number for evidence."""
    return verdict.word == word and verdict.rows > 0 and any(map(str.isdigit, str(verdict.evidence)))


def changed(frame: pd.DataFrame, rows, **cells) -> pd.DataFrame:
    """The frame with some cells of some rows set, or turned by a function."""
    frame = frame.copy()
    for name, value in cells.items():
        if isinstance(frame[name].dtype, pd.CategoricalDtype):
            frame[name] = frame[name].astype(str)
        frame.loc[rows, name] = value(frame.loc[rows, name]) if callable(value) else value
    return frame


def table(name, folder="reference"):
    """Return a table of results with plain words and `law`."""
    found = pd.read_parquet(RESULTS / folder / f"{name}.parquet")
    found = found.astype(dict.fromkeys(found.select_dtypes("category").columns, str))
    if "regulator" in found:
        found["law"] = found["regulator"] + np.where(found["representation"] == "", "", "/") + found["representation"]
    return found
