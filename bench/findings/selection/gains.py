"""Find the law that the rule advises at other damping ratios, and compare our own law with it.

`python -P -m bench.findings.selection.gains FOLDER OUT` keeps of a quick suite what the rule reads.
"""

from __future__ import annotations

import functools
import json
import math
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import NamedTuple

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read, write_table
from bench.findings.selection.measured import GENERAL, Measured, measured
from bench.findings.selection.needs import DEFAULT, NEARLY, SURE, TRIED, Need, decide, is_ours
from bench.findings.selection.words import together
from bench.findings.start_sets import DIRECTED

COMMITTED = ("gains/kv-10", "gains/kv-14", "reference", "gains/kv-30")
"""Runs of the same suite and seed at Kp = 100 1/s^2, by rising Kv."""

SITUATIONS = ("matched", "bounded", "slow", "late", "heavy", "spinning")
"""Criteria beside GENERAL by which our law is compared with the one that is advised."""

OTHER_RULES = (
    (Need("no adversary is assumed and median time decides", SURE), ("median", *GENERAL[1:])),
    (Need("99.9 % of the uniform starts suffice", (TRIED, NEARLY)), GENERAL),
)
"""Rules that a critic would choose: the facts, and the criteria that decide."""


KEPT = ("episodes", "robustness", "costs")
"""Tables that the rule reads; the others are written without rows, so that every command can read the folder."""


class Beside(NamedTuple):
    """The criteria by which our law is better, worse and tied, compared with another law."""

    better: tuple[str, ...]
    worse: tuple[str, ...]
    tied: tuple[str, ...]


def gains_of(found: Measured) -> tuple[float, float]:
    """Kp [1/s^2] and Kv [1/s] of the free body's uniform starts."""
    row = found.tables.uniform.iloc[0]
    return float(row["kp"]), float(row["kv"])


def gains_in_words(found: Measured) -> str:
    """Return the gains with their units and the damping ratio."""
    kp, kv = gains_of(found)
    return f"kp = {kp:g} 1/s², kv = {kv:g} 1/s (damping ratio {kv / (2.0 * math.sqrt(kp)):.2g})"


def ours(found: Measured) -> str | None:
    """Our own law of a run, if it has one."""
    return next((law for law in found.laws if is_ours(found, law)), None)


def compare(found: Measured, law: str, other: str) -> Beside:
    """Compare a law with another by every criterion that both were measured by."""
    both = [one for one in (*GENERAL, *SITUATIONS) if {law, other} <= set(found.values[one])]
    better = tuple(one for one in both if found.beats(one, law, other))
    worse = tuple(one for one in both if found.beats(one, other, law))
    return Beside(better, worse, tuple(one for one in both if one not in better + worse))


@functools.cache
def committed() -> tuple[Measured, ...]:
    """Return the runs at the four damping ratios."""
    return tuple(measured(RESULTS / name) for name in COMMITTED)


def by_other_rules(found: Measured) -> list[tuple[str, str | None, tuple[str, ...]]]:
    """Return what each of OTHER_RULES advises, and the laws that tie with it."""
    every = ((need.words, decide(need, found, general)) for need, general in OTHER_RULES)
    return [(words, one.law, one.tied) for words, one in every]


def ours_in_words(own: str) -> str:
    """Return the sentences on our own law: its origin, and what the rows do not cover."""
    return (
        f"{own} is ours: 2026, simulation only, not reviewed. No orientation error below 60° holds it at 180° "
        "(proved for a fixed goal). Reset its memory when the goal jumps (not tested)."
    )


WORDS = {"effort": "effort", "peak": "peak command", "variation": "variation", "tick": "time a tick"}
TIMES = {
    "time": "99 %",
    "worst": "slowest",
    "matched": "equal peak",
    "bounded": "weak motors",
    "slow": "20 Hz",
    "late": "20 ms late",
    "heavy": "double inertia",
    "spinning": "spin",
}
"""Criteria, and in TIMES settling times, as a list of what a law is better or worse by has them."""


def name_criteria(names: Sequence[str]) -> str:
    """List criteria, the settling times among them in brackets."""
    words = [word for name, word in WORDS.items() if name in names]
    times = [word for name, word in TIMES.items() if name in names]
    return ", ".join([*words, *([f"settling time ({', '.join(times)})"] if times else [])]) or "nothing"


def compare_at_all_gains(called: Callable[[str], str] = str) -> str:
    """Say in a few sentences how our law compares with the advised one at every committed damping ratio."""
    lines: list[tuple[str, Beside]] = []
    times: list[str] = []
    before = ""
    for one in committed():
        kp, kv = gains_of(one)
        law, own = decide(DEFAULT, one).law, ours(one)
        if law and own:
            ratio = f"{kv / (2.0 * math.sqrt(kp)):.2g}"
            lines.append((ratio, compare(one, own, law)))
            pair = one.number("time", own), one.number("time", law)
            named = "" if law == before else f" ({called(law)})"
            where = ratio if times else f"damping ratio {ratio}"
            times.append(f"{pair[0]:.3f} against {pair[1]:.3f} s{named} at {where}")
            before = law
    if not lines:
        return ""
    always = [name for name in (*GENERAL, *SITUATIONS) if all(name in its.better for _, its in lines)]
    worse: dict[tuple[str, ...], list[str]] = {}
    for name in (*GENERAL, *SITUATIONS):
        at = tuple(ratio for ratio, its in lines if name in its.worse)
        if at:
            worse.setdefault(at, []).append(name)
    price = "; ".join(f"at {together(at)} by {name_criteria(names)}" for at, names in worse.items())
    return (
        f"99 % of its starts settle in {', '.join(times)}. It is better at every ratio by "
        f"{name_criteria(always)}; worse {price or 'by nothing'}."
    )


def narrow(source: Path, target: Path) -> None:
    """Write the rows of a run that the rule reads."""
    target.mkdir(parents=True, exist_ok=True)
    for path in sorted(source.glob("*.parquet")):
        name = path.stem
        rows = read(source, name)
        if name not in KEPT:
            rows = rows.iloc[:0]
        if name == "episodes":
            is_free = rows["start_set"].isin(("uniform", *DIRECTED)) & (rows["engine"] != "reference")
            is_free &= (rows["engine"] == "ideal-rk4") | (rows["regulator"] == "in-engine")
            is_free &= rows["task"] == "free-body"
            is_arm = (rows["task"] == "arm-regulation") & (rows["start_set"] == "uniform")
            is_arm &= (rows["variation"] == "nominal") & (rows["jacobian"] == "geometric")
            rows = rows[is_free | is_arm]
        write_table(target / f"{name}.parquet", rows.reset_index(drop=True), name)
    (target / "provenance.json").write_text(json.dumps(read_json(source / "provenance.json"), indent=1) + "\n")


if __name__ == "__main__":
    narrow(Path(sys.argv[1]), Path(sys.argv[2]))
