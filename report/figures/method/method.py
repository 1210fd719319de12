"""What the page on method shows: what there is, read from the code, and whether engines agree and steps are fine."""

from __future__ import annotations

import functools
import inspect
import re
from collections.abc import Iterator

import pandas as pd

import bench.engines
import tasks
from bench.engines.counting import RULES as COUNT_RULES
from bench.engines.metrics.registry import known_metrics
from bench.findings.selection.needs import CHATTER
from bench.law.contenders.registry import contenders
from bench.law.kinds import Inverse, Jacobian
from report.figures.kit import families, html
from report.figures.kit.page import Run
from report.figures.kit.rows import small_error_settling_s
from report.figures.kit.spelling import power, prose
from report.figures.kit.tables import Table
from report.figures.method import engines, steps
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
HELD = Table("What | Value | Paper")
JUDGES = Table("Rule | Value | Why")
METRICS = Table("Column | Metric | Unit")
JACOBIANS = Table("Jacobian | Formula | For | Source")
INVERSES = Table("Inverse | Formula | Source")
STARTS = Table("Set | What it holds | Starts | Horizon [s]")
ENGINES = Table("Engine | What it is | Episodes")
halved = functools.cache(steps.errors)


@functools.cache
def episodes(run: Run) -> pd.DataFrame:
    """Return the episodes of the free body."""
    return run.rows("episodes", task="free-body")


def facts(run: Run) -> dict:
    """Whether engines agree, how right the step is, and the rules of counting."""
    both, equal = engines.agreement(episodes(run), "reference", "native")
    orders = steps.orders(halved())
    rk4 = halved()[halved()["engine"] == "ideal-rk4"]
    asked = convergence(run)
    return {
        "both": both,
        "equal": equal,
        "order": f"{orders['ideal-rk4'].min():.1f}",
        "order_held": f"{orders['ideal-held'].median():.1f}",
        "order_native": f"{orders['native'].median():.1f}",
        "rk4_error": power(float(rk4.loc[rk4["dt_s"] == 1e-3, "error_rad"].max())),
        "at_s": steps.AT_S,
        "finest_ms": 1e3 * steps.FINEST_S,
        "asked": len(asked),
        "shorter": int((asked["step_s"] < asked["dt_s"]).sum()),
        "unconverged": int((asked["converged"] == "no").sum()),
        "engines": episodes(run)["engine"].nunique(),
        "gains": describe_gains(episodes(run)),
        "small": f"{small_error_settling_s(episodes(run)):.3f}",
        "later_ms": between(engines.later_ms(episodes(run), "native")),
        "hold_s": f"{RULES.hold_s:g}",
        "chatter": f"{CHATTER:g}",
        "count_rules": "\n".join(f"1. {prose(rule)}" for rule in COUNT_RULES),
    }


def describe_gains(runs: pd.DataFrame) -> str:
    """List the pairs of gains that the episodes ran with."""
    pairs = sorted(set(zip(runs["kp"], runs["kv"], strict=True)))
    return " and ".join(f"kp = {kp:g} 1/s², kv = {kv:g} 1/s" for kp, kv in pairs)


def between(late: pd.Series) -> str:
    """Return the least and the greatest of how much later laws settle, with the law of each."""
    ends = late.idxmin(), late.idxmax()
    return " and ".join(f"{html.cell(float(late[law]), '+.1f')} ms ({families.word(law)})" for law in ends)


def tables(run: Run) -> dict:
    """Return the judge's rules, metrics, Jacobians, inverses, start sets and engines."""
    runs = episodes(run)
    counts = runs["engine"].value_counts()
    listed = LISTED.findall(bench.engines.__doc__ or "")
    return {
        "rules": JUDGES((f"`{name}`", value(name), prose(why)) for name, why in reasons().items()),
        "metrics": METRICS((f"`{one.column}`", one.title, prose(one.unit)) for one in known_metrics().values()),
        "jacobians": JACOBIANS(
            (word(one), lines(one.formula), used(one), prose(one.source)) for one in contenders("jacobians").values()
        ),
        "inverses": INVERSES(
            (word(one), lines(one.formula), prose(one.source)) for one in contenders("inverses").values()
        ),
        "held": HELD(held(runs)),
        "starts": STARTS(start_sets(runs)),
        "tab_engines": ENGINES((f"`{name}`", prose(text), int(counts.get(name, 0)) or None) for name, text in listed),
    }


def convergence(run: Run) -> pd.DataFrame:
    """Return the episodes that are run until half the step moves their end no more."""
    runs = episodes(run)
    return runs[runs["converged"] != ""]


def start_sets(runs: pd.DataFrame) -> Iterator[tuple]:
    """Every start set of the judge, and how many starts of it a law met in this run on the continuous plant."""
    for name in tasks.start_set_names():
        mine = runs[(runs["start_set"] == name) & (runs["engine"] == "ideal-rk4")]
        horizon = mine["horizon_s"].max() if len(mine) else None
        yield f"`{name}`", prose(tasks.start_set_title(name)), mine["start_id"].nunique(), horizon


def value(name: str) -> str:
    """Return a number of the rules with its unit: in full, or as a power of ten."""
    found = getattr(RULES, name)
    text = power(found) if "e" in f"{found:g}" else f"{found:g}"
    return f"{text}\N{NO-BREAK SPACE}{UNITS.get(name, '')}".strip()


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


def word(one: Jacobian | Inverse) -> str:
    """Its title, and below it its word on the command line."""
    return f"{one.title}<br>{html.together(f'`{one.name}`')}"


def used(one: Jacobian) -> str:
    """Return the paper's controller that uses it."""
    return "(2.2)" if one.takes == "angular-acceleration" else "(3.7)"


def lines(formula: str) -> str:
    """Return a formula, each of its equations on a line."""
    return "<br>".join(f"${equation}$" for equation in formula.split(r", \quad "))


def held(episodes: pd.DataFrame) -> list[tuple]:
    """Return gains, step, horizon, band: every value that occurs in the run, and whether the paper states it."""
    horizons = [f"{value:g}" for value in sorted(episodes["horizon_s"].unique())]
    return [
        ("Position gain $K_p$", values(episodes, "kp", "1/s²"), "yes, but for regulator 1"),
        ("Velocity gain $K_v$, $K_d$", values(episodes, "kv", "1/s"), "yes, but for regulator 1"),
        ("Inertia", "identity", "yes"),
        ("Control period and step", values(episodes, "dt_s", "s"), "no: ours"),
        ("Horizon", f"{' or '.join(horizons)} s, by start set", "no: ours"),
        ("Settling band", f"{values(episodes, 'tolerance', '')} of the initial angle", "no: ours"),
        ("Engines", ", ".join(f"`{name}`" for name in sorted(episodes["engine"].unique())), "one: Simnon"),
        ("Orientations", f"{html.number(starts(episodes))} starts a law", "no: ours"),
    ]


def values(episodes: pd.DataFrame, column: str, unit: str) -> str:
    """Every value of a column, with its unit."""
    return f"{', '.join(f'{value:g}' for value in sorted(episodes[column].unique()))} {unit}".strip()


def starts(episodes: pd.DataFrame) -> int:
    """Different starts of the continuous plant."""
    return len(episodes.loc[episodes["engine"] == "ideal-rk4", ["start_set", "start_id"]].drop_duplicates())
