"""Table of tests that are too long for every test run: many episodes, processes, killed runs, other processors."""

from __future__ import annotations

from typing import Any

import pandas as pd

from bench.base.files import read_json
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table

TESTED = Table("Test | Command | Result | Measured on")
STUDIES = {"scale": "scale", "kills": "survival", "settings": "settings"}
"""Study -> its folder, and its file's name, in results."""
FEW, MANY = 10**4, 10**6
"""Episodes of the two runs that are compared."""


def tables(run: Run) -> dict:
    """Return the one table, with the rows of each study that is in the results."""
    files = {name: run.studies / word / f"{word}.json" for name, word in STUDIES.items()}
    read = {name: read_json(path) for name, path in files.items() if path.is_file()}
    writers = {"scale": describe_scale, "kills": describe_kills, "settings": describe_settings}
    rows = [row for name, found in read.items() for row in writers[name](found)]
    return {"studies": TESTED(rows) if rows else None}


def describe_scale(found: dict[str, Any]) -> list[tuple]:
    """Return a row on the cost of many episodes, and one on processes."""
    command, sizes = "`python -m bench.studies.scale`", pd.DataFrame(found["sizes"])
    by_size = sizes.assign(each_us=1e6 * sizes["cpu_s"] / sizes["episodes"]).groupby("episodes")
    cost, peak = by_size["each_us"].median(), by_size["peak_bytes"].median() / 1e6
    spread = by_size["each_us"].agg(["min", "max"]).loc[FEW]
    runs = pd.DataFrame(found["schedulers"]).set_index("scheduler")
    efficiency = 100.0 * runs.loc["threads", "wall_s"] / (2.0 * runs.loc["local:2", "wall_s"])
    return [
        (
            f"A run of {power(MANY)} episodes instead of {power(FEW)}, continuous plant, one thread",
            command,
            f"{cost[MANY]:.0f} µs of CPU an episode instead of {cost[FEW]:.0f} ({spread['min']:.0f} to "
            f"{spread['max']:.0f} over runs); at most {peak[MANY]:.0f} MB of memory instead of {peak[FEW]:.0f}",
            describe_machine(found["provenance"]["sizes"]),
        ),
        (
            f"{power(int(runs.loc['local:2', 'episodes']))} episodes by two processes instead of one thread",
            command,
            f"{'the same rows' if runs['rows'].nunique() == 1 else '**other rows**'}; one thread's time is "
            f"{efficiency:.0f} % of the time of both processes",
            describe_machine(found["provenance"]["schedulers"]),
        ),
    ]


def describe_kills(found: dict[str, Any]) -> list[tuple]:
    """Return a row on runs that were killed at random moments and started again."""
    kills = found["kills"]
    left = max((one["left_s"] for one in kills if one["left_s"] is not None), default=None)
    ends = "" if left is None else f"; workers of a killed run end within {left:.1f} s"
    return [
        (
            f"{len(kills)} runs of {found['units']} units killed at random moments (on threads, on two processes, and "
            "one of two processes), then the same command again",
            "`PYTHONPATH=tests python tests/studies/kill_study.py`",
            f"{sum(one['same'] for one in kills)} ended with the files of an undisturbed run{ends}",
            describe_machine(found["provenance"]),
        )
    ]


def describe_settings(found: dict[str, Any]) -> list[tuple]:
    """Return a row on the quick suite under settings that round as other processors do."""
    runs = [one for machine in found.values() for one in machine.values()]
    tables = [table for one in runs for table in one["tables"].values()]
    total = sum(table["rows"] for table in tables)
    return [
        (
            f"The quick suite under {len(runs)} settings of libraries and compiler that round as on other processors",
            "`python -m bench.studies.settings`",
            f"{html.number(sum(table['differ'] for table in tables))} of {html.number(total)} rows differ in some bit "
            f"from the published ones, {sum(table['outcomes'] for table in tables)} in the outcome, "
            f"{sum(one['gate'] for one in runs)} by more than the gate allows",
            ", ".join(dict.fromkeys(html.foreign(one["made_on"].partition(",")[0]) for one in runs)),
        )
    ]


def describe_machine(provenance: dict[str, Any]) -> str:
    """Return the processor and the number of its cores."""
    return f"{html.foreign(provenance['cpu'])}, {provenance['cores']} cores"
