"""The page on survival: killed runs, full disks and laws that break. Read from results/survival, which is committed."""

from __future__ import annotations

import functools
from collections import Counter
from typing import Any

from bench.files import read_json
from report.figures.kit import html
from report.figures.kit.page import Run, given
from report.figures.kit.tables import Table

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
KILLS = Table("Killed | Goes on | Kills | Before the first unit | Among units | Among tables | Went on | Same files")


@functools.cache
def study(run: Run) -> dict[str, Any]:
    """All that was found; the parts are empty if it has not been run."""
    path = run.studies / "survival" / "survival.json"
    return read_json(path) if path.is_file() else {"kills": [], "disks": [], "laws": [], "units": 0, "tables": 0}


def files_done(one: dict[str, Any], units: int) -> int:
    """Units and tables that were finished at a kill; tables come after the units, whose files then go."""
    return units + one["tables_done"] if one["tables_done"] else one["units_done"]


def facts(run: Run) -> dict:
    """The result in one sentence, what was run, and a paragraph each on full disks and on laws that break."""
    found = study(run)
    return {
        "lead": given(found["kills"], lambda _: lead(found)),
        "said": given(found["kills"], lambda _: about(found)),
        "disks": given(found["disks"], lambda rows: disks(rows, found["units"])),
        "laws": given(found["laws"], laws),
    }


def lead(found: dict[str, Any]) -> str:
    """The result in one sentence."""
    same = sum(one["same"] for one in found["kills"])
    return f"Of {len(found['kills'])} runs killed at random moments {same} ended with the files of the undisturbed run."


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


def tables(run: Run) -> dict:
    """Kills."""
    return {"tab_kills": KILLS(kills(study(run)))}


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


def disks(rows: list[dict[str, Any]], units: int) -> str:
    """What full disks kept, what they left behind, and what the same command made of it with room again."""
    room, kept = ([one[name] for one in rows] for name in ("left_kb", "units_kept"))
    return (
        f"With {min(room)} to {max(room)} kB left, {min(kept)} to {max(kept)} of {units} units were kept, and "
        f"{sum(one['leftovers'] for one in rows)} temporary files stayed. With room again "
        f"{sum(one['same'] for one in rows)} of {len(rows)} runs ended with the files of the undisturbed one."
    )


def laws(rows: list[dict[str, Any]]) -> str:
    """The ways to break, the outcomes of such laws' own episodes, and whether all other rows are untouched."""
    ways = dict.fromkeys(one["law"].partition(",")[0] for one in rows)
    outcomes: Counter = sum((Counter(one["outcomes"]) for one in rows), Counter())
    counted = ", ".join(f"{count} {outcome}" for outcome, count in sorted(outcomes.items()))
    same = sum(one["others_same"] for one in rows)
    return (
        f"{len(rows)} such laws, compiled or in Python: in some states the law {', '.join(ways)}. Their own episodes: "
        f"{counted}. Beside {same} of the {len(rows)} all other rows are unchanged."
    )
