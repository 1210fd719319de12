"""The page on regressions: its rule, the planted faults that it catches (results/regress), the history of builds."""

from __future__ import annotations

from typing import Any

import pandas as pd
from matplotlib.figure import Figure

from bench.base.files import read_json
from bench.regression.history import read_history
from bench.regression.revisions import timing
from report.figures.kit import laws, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run


def read_rows(run: Run, name: str) -> list[dict[str, Any]]:
    """Return the rows of same_code or faults; none if that was not run."""
    path = run.studies / "regress" / f"{name}.json"
    return read_json(path)["rows"] if path.is_file() else []


def facts(run: Run) -> dict[str, Any]:
    """Return the rule's numbers, false alarms and faults that were caught in the study, and the history's size."""
    same, builds = read_rows(run, "same_code"), read_history(run.studies / "history")
    planted = [one["caught"] and one["named"] for one in read_rows(run, "faults") if one["law"]]
    return {
        "p": timing.P,
        "ratio": f"{timing.RATIO:.2f}",
        "rounds": timing.ROUNDS,
        "planted": len(planted) or None,
        "caught": sum(planted) if planted else None,
        "same": len(same) or None,
        "alarms": sum(bool(one["alarms"]) for one in same) if same else None,
        "builds": builds["commit"].nunique() if len(builds) else None,
        "benchmarks": builds["name"].nunique() if len(builds) else None,
    }


def figures(run: Run) -> dict[str, Any]:
    """Return times over the builds."""
    rows = read_history(run.studies / "history")
    return {"history": draw_history(rows) if len(rows) else None}


@responsive_picture
def draw_history(rows: pd.DataFrame, *, narrow: bool = False) -> tuple[Figure, str]:
    """Draw the time of a tick of each law over the builds, on the machine with most builds."""
    machine = rows.groupby("machine")["commit"].nunique().idxmax()
    own = rows[(rows["machine"] == machine) & (rows["what"] == "law")]
    steps = own.pivot(index="commit", columns="name", values="kernel_steps").loc[own["commit"].unique()]
    figure, axes = style.panels(height=4.4 if narrow else 3.6, narrow=narrow)
    for name in steps:
        axes.plot(range(len(steps)), steps[name], "o-", color=style.look(name).colour, markersize=3)
    axes.set(yscale="log", ylabel="Time of a tick [steps of the reference kernel]")
    axes.set_xticks(range(len(steps)), [commit[:7] for commit in steps.index], rotation=90)
    words = "; ".join(f"{laws.title(name)} {value:.2f}" for name, value in steps.iloc[-1].sort_values().items())
    return figure, f"Time of a tick over {len(steps)} builds on {machine}; in the newest: {words}."
