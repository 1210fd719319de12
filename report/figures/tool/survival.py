"""The page on survival: killed runs, full disks and laws that break. Read from results/survival, which is committed."""

from __future__ import annotations

import functools
from collections import Counter
from typing import Any

from matplotlib.ticker import MaxNLocator

from bench.tables.schema import RESULTS, TABLES
from bench.tables.store import read_json
from report.figures.kit import html, style
from report.figures.kit.inline import responsive_picture
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table

FILE = RESULTS / "survival" / "survival.json"
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
COLOUR = "#0072b2"

KILLS = Table("Killed | Goes on | Kills | Before the first unit | Among units | Among tables | Went on | Same files")
DISKS = Table("Room [kB] | Could not be written | Units kept | Temporary files left | With room again")
LAWS = Table("In some states the law | Law is | Its episodes | All other rows")


@functools.cache
def study() -> dict[str, Any]:
    """All that was found; the parts are empty if it has not been run."""
    return read_json(FILE) if FILE.is_file() else {"kills": [], "disks": [], "laws": [], "units": 0, "tables": 0}


def files_done(one: dict[str, Any], units: int) -> int:
    """Units and tables that were finished at a kill; tables come after the units, whose files then go."""
    return units + one["tables_done"] if one["tables_done"] else one["units_done"]


def facts(_: Run) -> dict:
    """The result in one sentence; and what was run."""
    found = study()
    return {"lead": lead(found), "said": about(found)} if found["kills"] else {}


def lead(found: dict[str, Any]) -> str:
    """The result in one sentence."""
    same = sum(one["same"] for one in found["kills"])
    words = f"Of {len(found['kills'])} runs killed at random moments {same} ended with the files of the undisturbed run"
    if found["disks"]:
        words += f", and so did {sum(one['same'] for one in found['disks'])} of {len(found['disks'])} on full disks"
    return f"{words}."


def about(found: dict[str, Any]) -> str:
    """What was run, where, how long it took, and what killed runs left behind."""
    machine = found["provenance"]
    words = (
        f"The plan has {found['units']} units, on the free body, on an arm and in contact, on three engines, and "
        f"{found['tables']} tables. All took {machine['wall_s'] / 60.0:.0f} minutes ({html.foreign(machine['cpu'])}, "
        f"{machine['cores']} cores; commit {html.foreign(machine['commit'][:12])})."
    )
    left = [one["left_s"] for one in found["kills"] if one["left_s"] is not None]
    if left:
        words += (
            " When a run on processes is killed, its workers are orphans, and end of themselves: in each of the "
            f"{len(left)} kills within {max(left):.1f} s."
        )
    return words


def tables(_: Run) -> dict:
    """Kills, disks and laws."""
    found = study()
    return {"tab_kills": KILLS(kills(found)), "tab_disks": DISKS(disks(found)), "tab_laws": LAWS(laws(found))}


def kills(found: dict[str, Any]) -> list[tuple]:
    """A row for what was killed, and what went on: how many, how far they had come, and what they ended with."""
    units, rows = found["units"], []
    for what, killed in KILLED.items():
        for by, words in GOES_ON.items():
            some = [one for one in found["kills"] if (one["killed"], one["goes_on_by"]) == (what, by)]
            if some:
                done = [files_done(one, units) for one in some]
                when = (sum(k == 0 for k in done), sum(0 < k < units for k in done), sum(k >= units for k in done))
                ended = (sum(one["went_on"] for one in some), sum(one["same"] for one in some))
                rows.append((killed, words, len(some), *when, *ended))
    return rows


def disks(found: dict[str, Any]) -> list[tuple]:
    """A row for a disk: its room, what could not be written, what was kept, and what the run ended with."""
    return [
        (
            one["left_kb"],
            called(one["failed_at"]),
            one["units_kept"],
            one["leftovers"],
            "same files" if one["same"] else "other files",
        )
        for one in found["disks"]
    ]


def called(name: str) -> str:
    """A file or folder of a run, as a reader calls it; a unit's name is long."""
    if not name:
        return "nothing: there was room"
    if name in {"plan.json", "provenance.json", *(f"{table}.parquet" for table in TABLES)}:
        return f"<code>{name}</code>"
    return "rows of a unit" if name.endswith(".parquet") else "a new file"


def laws(found: dict[str, Any]) -> list[tuple]:
    """A row for a way to break: the outcomes of the law's own episodes, and whether all other rows are untouched."""
    return [
        (
            one["law"].partition(",")[0],
            ENGINES[one["engine"]],
            ", ".join(f"{count} {outcome}" for outcome, count in sorted(one["outcomes"].items())),
            "same" if one["others_same"] else "changed",
        )
        for one in found["laws"]
    ]


def figures(_: Run) -> dict:
    """How far killed runs had come."""
    found = study()
    return {"survival-moments": given(found["kills"], lambda _: moments(found))}


@responsive_picture
def moments(found: dict[str, Any], *, narrow=False):
    """Bars of the kills at each count of finished units and tables, a panel for what was killed."""
    units, count = found["units"], found["tables"]
    figure, panels = style.beside(3, 2.4, 5.2, narrow, sharex=True)
    words = []
    for axes, (what, title) in zip(panels, KILLED.items(), strict=True):
        done = [files_done(one, units) for one in found["kills"] if one["killed"] == what]
        counts = Counter(done)
        axes.bar(list(counts), list(counts.values()), width=0.8, color=COLOUR)
        axes.axvline(units - 0.5, color=style.MUTED, linewidth=1.0, linestyle=style.DASHED)
        axes.set_title(title)
        axes.set_xlim(-0.8, units + count + 0.8)
        axes.xaxis.set_major_locator(MaxNLocator(5, integer=True))
        axes.yaxis.set_major_locator(MaxNLocator(4, integer=True))
        axes.grid(visible=False, axis="x")
        among = sum(0 < k < units for k in done)
        words.append(f"{title}: {len(done)} kills, {among} of them after the first unit and before the last")
    (panels[-1] if narrow else panels[1]).set_xlabel("Files finished before the kill")
    (panels[1] if narrow else panels[0]).set_ylabel("Kills")
    return figure, f"{'; '.join(words)}. Of {units} units and {count} tables."
