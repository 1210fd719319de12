"""What the page on provenance shows: the run, its files with links to take them."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pyarrow.parquet as pq

from bench.base.provenance import ROOT
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import all_tables
from bench.findings.amounts import join_words
from report.figures.cost.cost import timings
from report.figures.kit import html
from report.figures.kit.offered import OFFERED_BYTES, SITE_DATA

CITATION = ROOT / "CITATION.cff"
FACTS = html.PageTable("Property of the run | Value")
FILES = html.PageTable(
    "File | Number of rows | Size [kB]", {"Size [kB]": lambda size: html.number(round(size))}
)
EPISODES = {
    "episodes": "Episodes of a free body or an arm",
    "trials": "Episodes in contact",
    "troubled": "Episodes with a perturbation",
}
"""Kinds of episodes in provenance.json; `bench show` prints their sum."""
LABELS = {
    "command": "Command",
    "suite": "Suite",
    **EPISODES,
    "lost": "Episodes in which a law of the user crashed or hung",
    "seed": "Seed of the random starts",
    "commit": "Commit",
    "dirty": "Changes that were not committed",
    "sources": "Digest of the source code",
    "judge": "Digest of the code that judges the episodes",
    "plan": "Digest of the plan of the run",
    "lock": "Digest of the lock file",
    "finished": "Finished (UTC)",
    "wall_s": "Duration [s]",
    "resumed": "Interrupted and continued",
    "scheduler": "Scheduler",
    "workers": "Number of workers",
    "cores": "Number of cores",
    "cpu": "Processor",
    "vectors": "Vector instructions of the processor",
    "platform": "Platform",
    "arithmetic": "Settings of the arithmetic",
    "added table": "Table that was added to the run later",
    "added command": "Command that made this table",
    "added commit": "Commit of this table",
    "added sources": "Digest of the source code of this table",
    "added finished": "This table was finished (UTC)",
}
"""Facts of provenance.json as a reader calls them, in this order; others follow by their own names."""
VERSION, SETTING = "versions ", "arithmetic "
TAKEN_BY_CODE = re.compile(r"[`|\\\n]|^$")
"""What would end a piece of code, or a cell, early."""
CODE = ("command", "commit", "sources", "judge", "plan", "lock")


def facts(run: Run) -> dict[str, Any]:
    """Return the title and the version that are cited, with its date; the run and its files."""
    said = cited()
    version = f"{said['version']} ({said['date-released']})" if "date-released" in said else said["version"]
    files = FILES(map(describe_file, list_files(run)))
    given = run.provenance()
    return {
        "title": said["title"],
        "version": version,
        "episodes": html.number(count_episodes(given)),
        "kinds": join_words(f"{html.number(given.get(key, 0))} {label.lower()}" for key, label in EPISODES.items()),
        "run": describe_run(given),
        "tables": files,
    }


def count_episodes(given: dict[str, Any]) -> int:
    """Count the episodes of a run of all kinds, as `bench show` does."""
    counts = [given.get(key) for key in EPISODES]
    return sum(number for number in counts if isinstance(number, int))


def cited() -> dict[str, str]:
    """Return title, version and date of CITATION.cff."""
    text = CITATION.read_text(encoding="utf-8")
    return dict(re.findall(r"^(title|version|date-released): *[\"']?([^\"'\n]+)", text, re.MULTILINE))


def describe_run(given: dict[str, Any]) -> html.Markdown | None:
    """Return the facts of provenance.json, which may come from anywhere, as a table."""
    facts = pd.json_normalize(given, sep=" ").iloc[0].to_dict()
    known = [name for name in LABELS if name in facts]
    others = [name for name in facts if name not in LABELS]
    return FACTS(
        (html.escape_untrusted(label_fact(name)), describe_fact(name, facts[name]))
        for name in [*known, *others]
    )


def label_fact(name: str) -> str:
    """Return what a reader calls a fact of provenance.json."""
    for prefix, words in ((VERSION, "Version of"), (SETTING, "Setting of the arithmetic,")):
        if name.startswith(prefix):
            return f"{words} {name.removeprefix(prefix)}"
    return LABELS.get(name, name)


def describe_fact(name: str, value: Any) -> str:
    """Return the value of a fact: yes, no and none as words, a command as code that can be pasted."""
    if isinstance(value, list | dict):
        value = ", ".join(map(str, value)) or "none"
    if isinstance(value, bool | np.bool_):
        return "yes" if value else "no"
    if name in EPISODES and isinstance(value, int | np.integer):
        return html.number(int(value))
    if name in CODE and not TAKEN_BY_CODE.search(str(value)):
        return f"`{value}`"
    return html.escape_untrusted(value)


def list_files(run: Run) -> list[Path]:
    """Return the files of the run, tables first, then every machine's timings."""
    names = [*(f"{name}.parquet" for name in sorted(all_tables())), "provenance.json", "plan.json"]
    return [*(path for path in (run.folder / name for name in names) if path.is_file()), *timings(run)]


def describe_file(path: Path) -> tuple:
    """Return a link to a file, or its name where it is too large to offer; its rows and size."""
    rows = pq.read_metadata(path).num_rows if path.suffix == ".parquet" else None
    name = f"timings/{path.name}" if path.parent.name == "timings" else path.name
    is_large = path.stat().st_size > OFFERED_BYTES
    link = f"`{name}` (too large for this site)" if is_large else f'<a href="{SITE_DATA}/{name}" download>{name}</a>'
    return link, rows, path.stat().st_size / 1e3
