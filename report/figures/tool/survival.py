"""The kill study as its page reads it: results/survival, which is committed; where it is not there, that is said.

Killed runs by what was killed, full disks, and laws that break, a table each.
"""

from __future__ import annotations

from typing import Any

import pandas as pd

from bench.tables.schema import RESULTS, TABLES
from bench.tables.store import read_json
from report.figures.kit import html

FILE = RESULTS / "survival" / "survival.json"
NOT_RUN = "This study has not been run yet: make kill-study"
KILLED = {
    "threads": "a run on threads",
    "local:2": "a run on two processes",
    "worker": "one of its two processes",
}
GOES_ON = {
    "threads": "the same command, on threads",
    "local:2": "the same command, on processes",
    "itself": "the run itself",
}
ENGINES = {"reference": "Python", "ideal-rk4": "compiled"}


def study() -> dict[str, Any]:
    """All that was found; the parts are empty if it has not been run."""
    return read_json(FILE) if FILE.is_file() else {"kills": [], "disks": [], "laws": [], "units": 0, "tables": 0}


def files_done(one: dict[str, Any], units: int) -> int:
    """Units and tables that were finished at a kill; tables come after the units, whose files then go."""
    return units + one["tables_done"] if one["tables_done"] else one["units_done"]


def kills(found: dict[str, Any]) -> html.Markdown:
    """A row for what was killed, and what went on: how many, how far they had come, and what they ended with."""
    units, rows = found["units"], []
    for what, killed in KILLED.items():
        for by, words in GOES_ON.items():
            some = [one for one in found["kills"] if (one["killed"], one["goes_on_by"]) == (what, by)]
            if some:
                done = [files_done(one, units) for one in some]
                rows.append(
                    {
                        "Killed": killed,
                        "Goes on": words,
                        "Kills": len(some),
                        "Before the first unit": sum(k == 0 for k in done),
                        "Among units": sum(0 < k < units for k in done),
                        "Among tables": sum(k >= units for k in done),
                        "Went on": sum(one["went_on"] for one in some),
                        "Same files": sum(one["same"] for one in some),
                    }
                )
    return html.table(pd.DataFrame(rows or [{"Killed": NOT_RUN}]))


def disks(found: dict[str, Any]) -> html.Markdown:
    """A row for a disk: its room, what could not be written, what was kept, and what the run ended with."""
    rows = [
        {
            "Room [kB]": one["left_kb"],
            "Could not be written": called(one["failed_at"]),
            "Units kept": one["units_kept"],
            "Temporary files left": one["leftovers"],
            "With room again": "same files" if one["same"] else "other files",
        }
        for one in found["disks"]
    ]
    return html.table(pd.DataFrame(rows or [{"Room [kB]": NOT_RUN}]))


def called(name: str) -> str:
    """A file or folder of a run, as a reader calls it; a unit's name is long."""
    if not name:
        return "nothing: there was room"
    known = {"plan.json", "provenance.json", *(f"{table}.parquet" for table in TABLES)}
    if name in known:
        return f"<code>{name}</code>"
    return "rows of a unit" if name.endswith(".parquet") else "a new file"


def laws(found: dict[str, Any]) -> html.Markdown:
    """A row for a way to break: the outcomes of the law's own episodes, and whether all other rows are untouched."""
    rows = [
        {
            "In some states the law": one["law"].partition(",")[0],
            "Law is": ENGINES[one["engine"]],
            "Its episodes": ", ".join(f"{count} {outcome}" for outcome, count in sorted(one["outcomes"].items())),
            "All other rows": "same" if one["others_same"] else "changed",
        }
        for one in found["laws"]
    ]
    return html.table(pd.DataFrame(rows or [{"In some states the law": NOT_RUN}]))


def lead(found: dict[str, Any]) -> html.Markdown:
    """The result in one sentence."""
    if not found["kills"]:
        return html.Markdown(f"{NOT_RUN}.")
    same = sum(one["same"] for one in found["kills"])
    said = f"Of {len(found['kills'])} runs killed at random moments {same} ended with the files of the undisturbed run"
    if found["disks"]:
        said += f", and so did {sum(one['same'] for one in found['disks'])} of {len(found['disks'])} on full disks"
    return html.Markdown(f"{said}.")


def said(found: dict[str, Any]) -> html.Markdown:
    """What was run, where, how long it took, and what killed runs left behind."""
    if not found["kills"]:
        return html.Markdown(f"{NOT_RUN}.")
    about = found["provenance"]
    text = (
        f"The plan has {found['units']} units, on the free body, on an arm and in contact, on three engines, and "
        f"{found['tables']} tables. All took {about['wall_s'] / 60.0:.0f} minutes ({html.foreign(about['cpu'])}, "
        f"{about['cores']} cores; commit {html.foreign(about['commit'][:12])})."
    )
    left = [one["left_s"] for one in found["kills"] if one["left_s"] is not None]
    if left:
        text += (
            " When a run on processes is killed, its workers are orphans, and end of themselves: in each of the "
            f"{len(left)} kills within {max(left):.1f} s."
        )
    return html.Markdown(text)
