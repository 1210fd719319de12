"""What there is, as tables: representations, start sets, rules, engines. Read from the code, so new files appear."""

from __future__ import annotations

import inspect
import re
import sys

import pandas as pd

import bench.engines
import tasks
from bench.contenders.registry import contenders_of, known_regulators, known_representations
from bench.metrics.registry import known_metrics
from bench.tables import read
from report.figures.kit import html
from report.figures.kit.spelling import power, prose
from tasks.rules import RULES, Rules

LISTED = re.compile(r"^(\S+)  +(\S.*)$", re.MULTILINE)
FIELD = re.compile(r"^\s+(\w+): float = ")
COMMENT = re.compile(r"^\s+# ?(.*)$")
UNITS = {
    "floor_rad": "rad",
    "at_goal_rad": "rad",
    "hold_s": "s",
    "command_limit": "rad/s²",
    "speed_limit": "rad/s",
    "rest_speed": "rad/s",
    "rest_command": "rad/s²",
}


def representations() -> html.Markdown:
    """Title, definition, where it is singular, source."""
    rows = [
        {
            "Coordinates": one.title,
            "Definition": f"${one.formula}$",
            "Where it breaks": prose(where_it_breaks(one)),
            "Source": one.source,
        }
        for one in known_representations().values()
    ]
    return html.table(pd.DataFrame(rows))


def where_it_breaks(one) -> str:
    """What the module's docstring says after its first paragraph."""
    text = sys.modules[one.chart.__module__].__doc__ or ""
    return " ".join(text.partition("\n\n")[2].split())


def start_sets(episodes: pd.DataFrame) -> html.Markdown:
    """Every start set of the judge, and how many starts of it a law met in this run on the continuous plant."""
    rows = []
    for name in tasks.start_set_names():
        mine = episodes[(episodes["start_set"] == name) & (episodes["engine"] == "ideal-rk4")]
        starts = mine["start_id"].nunique()
        horizon = mine["horizon_s"].max() if len(mine) else None
        title = tasks.start_set_title(name)
        rows.append({"Set": f"`{name}`", "What it holds": prose(title), "Starts": starts, "Horizon [s]": horizon})
    return html.table(pd.DataFrame(rows))


def rules() -> html.Markdown:
    """The judge's numbers with the reason that stands above each in tasks/rules.py."""
    rows = [
        {
            "Rule": f"`{name}`",
            "Value": f"{said(getattr(RULES, name))}\N{NO-BREAK SPACE}{UNITS.get(name, '')}".strip(),
            "Why": prose(why),
        }
        for name, why in reasons().items()
    ]
    return html.table(pd.DataFrame(rows))


def said(value: float) -> str:
    """A value of the rules: in full, or as a power of ten."""
    return power(value) if "e" in f"{value:g}" else f"{value:g}"


def reasons() -> dict[str, str]:
    """Field of the rules -> the comment above it; a comment that runs on over two fields is split between them."""
    found: dict[str, str] = {}
    said: list[str] = []
    for line in inspect.getsource(Rules).splitlines():
        if comment := COMMENT.match(line):
            said.append(comment[1])
        elif field := FIELD.match(line):
            found[field[1]] = " ".join(said)
            said = []
    return found


def engines(episodes: pd.DataFrame) -> html.Markdown:
    """Every engine as its package describes it, with its episodes in this run."""
    listed = dict(LISTED.findall(bench.engines.__doc__ or ""))
    counts = episodes["engine"].value_counts()
    rows = [
        {"Engine": f"`{name}`", "What it is": prose(text), "Episodes": int(counts.get(name, 0)) or None}
        for name, text in listed.items()
    ]
    return html.table(pd.DataFrame(rows))


def metrics() -> html.Markdown:
    """Every metric: its column, what it is, its unit."""
    rows = [
        {"Column": f"`{one.column}`", "Metric": one.title, "Unit": prose(one.unit)} for one in known_metrics().values()
    ]
    return html.table(pd.DataFrame(rows))


def titles() -> dict[str, str]:
    """contender -> the title of its law, with its coordinates where it has several."""
    named = {}
    for regulator in (*known_regulators().values(), *read.own_laws()):
        several = contenders_of(regulator)
        for one in several:
            coordinates = f", {one.representation.name}" if one.representation and len(several) > 1 else ""
            named[one.name] = regulator.title + coordinates
    return named
