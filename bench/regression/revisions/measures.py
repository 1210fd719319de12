"""What a comparison of a user's law leads with: how its episodes end, how fast, at what cost, and how stiff it is."""

import contextlib
from pathlib import Path

import pandas as pd

from bench.experiments.tables.read import table

ENGINE = "ideal-rk4"
MEDIANS = {
    "settling_time_s": "settling time, median [s]",
    "effort": "effort, median",
    "peak_u": "peak command, median [rad/s²]",
}
STIFFNESS = "stiffness near the goal [kp]"


def compare_measures(base: Path, head: Path) -> list[dict[str, str]]:
    """Return a line for each law and measure on the free body: base, head, and the change where it is a number."""
    was, now = _measure(base), _measure(head)
    both = {key: (was.get(key, "none"), now.get(key, "none")) for key in (now | was)}
    return [
        {"law": law, "": what, "base": before, "head": after, "change": _change(before, after)}
        for (law, what), (before, after) in both.items()
    ]


def _measure(folder: Path) -> dict[tuple[str, str], str]:
    """Return the measures of every law by its name and theirs, as text."""
    episodes, field = (table(folder, name) for name in ("episodes", "command-field"))
    episodes = episodes[(episodes["arm"] == "") & (episodes["engine"] == ENGINE)]
    stiffness = field[field["finding"] == "stiffness"]
    found = {}
    for law, rows in episodes.groupby(episodes["contender"].astype(str), sort=False):
        settled = rows[rows["outcome"] == "settled"]
        for outcome, count in rows["outcome"].astype(str).value_counts().items():
            found[law, str(outcome)] = f"{count} of {len(rows)}"
        for column, name in MEDIANS.items():
            found[law, name] = _write(settled[column].median())
        for value in stiffness.loc[stiffness["contender"].astype(str) == law, "value"]:
            found[law, STIFFNESS] = _write(value)
    return found


def _write(value: float) -> str:
    return "none" if pd.isna(value) else f"{value:.4g}"


def _change(before: str, after: str) -> str:
    """Return by how many percent a number changed; empty where it did not, or where there is none."""
    with contextlib.suppress(ValueError, ZeroDivisionError):
        return f"{float(after) / float(before) - 1.0:+.1%}" if before != after else ""
    return ""
