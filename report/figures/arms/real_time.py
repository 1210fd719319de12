"""Laws as exported C++ in real time, against the simulated loop and theory; read from results/real-loop."""

import functools

import numpy as np
import pandas as pd

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from bench.findings.theory.late_torques import find_greatest_kv
from report.figures.arms import arm_rows
from report.figures.kit import families, html
from report.figures.kit.page import Run

STEPS = 8
STUDY = RESULTS / "real-loop"
LOOPS = html.Table(
    "Arm | Law | Settled; simulated; same end | Delay, median; 99 %; longest [ms] | Largest Kv [1/s]:.0f "
    "| Kv predicted [1/s]:.0f"
)


@functools.cache
def rows() -> pd.DataFrame:
    """Return a row an arm and law."""
    return read(STUDY, "real_loop").astype({"arm": str, "regulator": str})


def facts(_: Run) -> dict:
    """Return what it was measured on, what the loops did, and how far the simulated loop and theory are off."""
    about, found = read_json(STUDY / "provenance.json"), rows()
    gaps = (found["kv_predicted"] / found["kv_measured"] - 1.0).abs()
    return {
        "machine": f"{about['cpu']}, {about['cores']} cores",
        "agreeing": f"{found['agreeing'].sum()} of {found['starts'].sum()}",
        "apart_ms": f"{1e3 * found['time_difference_s'].max():.0f}",
        "gap": f"{100 * gaps.max():.1g}",
        **{name: predict(late) for name, late in (("undelayed", 0), ("eighth", 1), ("half", 4))},
        "loops": LOOPS(describe(row) for _, row in found.iterrows()),
    }


def predict(late: int) -> str:
    """Return the greatest stable Kv of a loop whose torques all come so many eighths of a period late."""
    answered = (np.arange(STEPS * 2000) - late) // STEPS + 1
    return f"{find_greatest_kv(answered, STEPS, 1e-3):.0f}"


def describe(row: pd.Series) -> tuple:
    """Return the cells of a row."""
    late = (f"{1e3 * row[f'delay_{one}_s']:.3g}" for one in ("median", "p99", "max"))
    return (
        arm_rows.name_arm(row["arm"]),
        families.word(row["regulator"]),
        f"{row['settled']}; {row['simulated']}; {row['agreeing']} of {row['starts']}",
        "; ".join(late),
        row["kv_measured"],
        row["kv_predicted"],
    )
