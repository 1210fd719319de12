"""The timings as tables for the eye: one of the free body and one of each arm, a line a law or controller."""

import math
from collections.abc import Iterator
from pathlib import Path

import pandas as pd

from bench.experiments.tables.read import with_contender
from bench.running.timing.rows import read

NOT_TIMED, EMPTY = "fails", "(empty loop)"


def tables(timings: Path | pd.DataFrame) -> Iterator[tuple[str, pd.DataFrame]]:
    """Yield the arm, empty for the free body, and its table: ns a tick alone and in each engine.

    What is alone has its ratio to the reference kernel too. The empty loop is what the time of every law alone holds.

    Args:
        timings: a machine's file, or its rows.
    """
    every = with_contender(timings if isinstance(timings, pd.DataFrame) else read(timings))
    for arm, rows in every.groupby("arm", observed=True, sort=False):
        lines: dict[str, dict[str, str]] = {}
        for row in rows.itertuples():
            name = str(row.contender) if row.regulator else EMPTY
            line = lines.setdefault(name, {"law": name})
            time = f"{row.ns_per_tick:.1f}" if math.isfinite(row.ns_per_tick) else NOT_TIMED
            line[f"{row.engine or 'alone'} [ns]"] = time
            if not row.engine:
                interval = f"{row.ratio:.3f} [{row.ratio_low:.3f}, {row.ratio_high:.3f}]"
                line["alone / kernel"] = interval if math.isfinite(row.ratio) else NOT_TIMED
        yield str(arm), pd.DataFrame(list(lines.values())).fillna("")
