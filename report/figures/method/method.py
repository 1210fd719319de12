"""What the page on method says: whether engines agree, how operations are counted, whose the laws are."""

from typing import Any

import pandas as pd

from bench.engines.counting import RULES as COUNT_RULES
from bench.experiments.tables.run import Run
from bench.findings.amounts import count, count_of, join_words
from bench.findings.theory.closed_form import linear_settling
from bench.findings.why import CHATTER
from bench.law.attribution import ADAPTED, OURS, PUBLISHED
from bench.law.contenders.registry import contenders
from report.figures.kit import families, html
from report.figures.kit.spelling import prose
from tasks.rules import RULES

KEY = ["contender", "start_set", "start_id"]
JUDGED = ["outcome", "settling_time_s", "failure_time_s", "final_angle_rad", "effort", "path_ratio", "peak_u", "ticks"]


def facts(run: Run) -> dict[str, Any]:
    """Return whether engines agree, how many episodes asked for shorter steps, the gains, and the rules of counting."""
    runs = run.rows("episodes", task="free-body")
    (both, equal), late = count_equal(runs, "reference", "native"), compute_lateness_ms(runs, "native")
    asked, pairs = runs[runs["converged"] != ""], sorted(set(zip(runs["kp"], runs["kv"], strict=True)))
    return {
        "both": both,
        "equal": count_of(equal, both, "episodes"),
        "asked": len(asked),
        "shorter": int((asked["step_s"] < asked["dt_s"]).sum()),
        "unconverged": count(int((asked["converged"] == "no").sum()), "episode"),
        "engines": runs["engine"].nunique(),
        "gains": " and ".join(f"kp = {kp:g} 1/s², kv = {kv:g} 1/s" for kp, kv in pairs),
        "small": f"{linear_settling(*runs[['kp', 'kv', 'tolerance']].iloc[0]):.3f}",
        "later_ms": " and ".join(
            f"{html.cell(float(late[law]), '.1f')} ms ({families.word(law).replace(',', '')})"
            for law in (late.idxmin(), late.idxmax())
        ),
        "hold_s": f"{RULES.hold_s:g}",
        "chatter": f"{CHATTER:g}",
        **count_attributions(),
        "count_rules": "\n".join(f"1. {prose(rule)}" for rule in COUNT_RULES),
    }


def count_attributions() -> dict[str, Any]:
    """Return how many laws of the catalogue are published, adapted and ours, and the names of the last two."""
    laws = contenders("regulators")
    groups: dict[str, list[str]] = {PUBLISHED: [], ADAPTED: [], OURS: []}
    for law in laws.values():
        groups[law.attribution].append((law.display.short or law.name).replace(",", ""))
    counts = {word: len(names) for word, names in groups.items()}
    return {
        "laws": len(laws),
        **counts,
        "adapted_laws": join_words(groups[ADAPTED]),
        "ours_laws": join_words(groups[OURS]),
    }


def count_equal(runs: pd.DataFrame, one: str, other: str) -> tuple[int, int]:
    """Return how many episodes both engines ran, and in how many of them all judged numbers are equal bit for bit."""
    first, second = (runs[runs["engine"] == engine].set_index(KEY)[JUDGED] for engine in (one, other))
    both = first.index.intersection(second.index)
    first, second = first.loc[both].astype({"outcome": str}), second.loc[both].astype({"outcome": str})
    equal = (first == second) | (first.isna() & second.isna())
    return len(both), int(equal.all(axis=1).sum())


def compute_lateness_ms(runs: pd.DataFrame, other: str) -> pd.Series:
    """Compute how much later than on the continuous plant each law settles, on average of uniform starts [ms]."""
    uniform = runs[runs["start_set"] == "uniform"]
    times = uniform.pivot_table(index=KEY, columns="engine", values="settling_time_s", observed=True)
    return 1e3 * (times[other] - times["ideal-rk4"]).groupby("contender", observed=True).mean()
