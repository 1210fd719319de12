"""The page on regressions: its rule, what the study of it found (results/regress), and the history of builds."""

from __future__ import annotations

import functools
from typing import Any

import pandas as pd

from bench.base.files import read_json
from bench.regression.history import read_history
from bench.regression.revisions import timing
from report.figures.kit import html, laws, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run
from report.figures.kit.tables import Table

FAULTS = Table("Planted | In | Caught by | In the words")


def read_rows(run: Run, name: str) -> list[dict[str, Any]]:
    """Return the rows of same_code or faults; none if that was not run."""
    path = run.studies / "regress" / f"{name}.json"
    return read_json(path)["rows"] if path.is_file() else []


@functools.cache
def read_builds(run: Run) -> pd.DataFrame:
    """Return the history of this checkout."""
    return read_history(run.studies / "history")


def facts(run: Run) -> dict:
    """Return the rule's numbers, what the same code looked like, faults that were caught, and the history's size."""
    same, builds = pd.DataFrame(read_rows(run, "same_code")), read_builds(run)
    planted = [one["caught"] and one["named"] for one in read_rows(run, "faults") if one["law"]]
    return {
        "p": timing.P,
        "ratio": f"{timing.RATIO:.2f}",
        "rounds": timing.ROUNDS,
        "planted": len(planted) or None,
        "caught": sum(planted) if planted else None,
        "noise": describe_noise(same) if len(same) else None,
        "builds": builds["commit"].nunique() if len(builds) else None,
        "benchmarks": builds["name"].nunique() if len(builds) else None,
    }


def describe_noise(rows: pd.DataFrame) -> str:
    """Return how far apart the same code was, and what each condition of the rule took away."""
    least, largest = rows["least_ratio"].min(), rows["largest_ratio"].max()
    by_chance, doubted, alarmed = (
        rows["least_p"] < timing.P,
        *(rows[name].map(len) > 0 for name in ("doubted", "alarms")),
    )
    return (
        f"{len(rows)} comparisons of {rows['benchmarks'].max()} benchmarks: ratios from {least:.2f} to {largest:.2f}. "
        f"By $p$ alone {by_chance.sum()} comparisons would have alarmed; both conditions held in {doubted.sum()}, "
        f"and the second run confirmed {alarmed.sum()}: false alarms."
    )


def tables(run: Run) -> dict:
    """Return what was planted, which gates caught it, and in what words."""
    return {"tab_faults": FAULTS(map(write_fault, read_rows(run, "faults")))}


def write_fault(one: dict[str, Any]) -> tuple:
    """Return a line of the table of faults."""
    words = html.foreign(one["says"][0]) if one["says"] else html.MISSING
    return one["fault"], one["law"] or html.MISSING, ", ".join(one["gates"]) or "nothing", words


def figures(run: Run) -> dict:
    """Return times over the builds."""
    return {"history": draw_history(read_builds(run)) if len(read_builds(run)) else None}


@responsive_picture
def draw_history(rows: pd.DataFrame, *, narrow=False):
    """Draw the time of a tick of each law over the builds, on the machine with most builds."""
    machine = rows.groupby("machine")["commit"].nunique().idxmax()
    own = rows[(rows["machine"] == machine) & (rows["what"] == "law")]
    places = {commit: place for place, commit in enumerate(own["commit"].unique(), 1)}
    figure, axes = style.panels(height=4.4 if narrow else 3.6, narrow=narrow)
    for name, each in own.groupby("name"):
        look = style.look(name)
        axes.plot(
            each["commit"].map(places),
            each["kernel_steps"],
            "o-",
            color=look.colour,
            markersize=3,
            label=laws.title(name),
        )
    axes.set_yscale("log")
    axes.set_xticks(list(places.values()), [commit[:7] for commit in places], rotation=90)
    axes.set_ylabel("Time of a tick [steps of the reference kernel]")
    ends = own.groupby("name")["kernel_steps"].last().sort_values()
    words = "; ".join(f"{laws.title(name)} {steps:.2f}" for name, steps in ends.items())
    return figure, f"Time of a tick over {len(places)} builds on {machine}; in the newest: {words}."
