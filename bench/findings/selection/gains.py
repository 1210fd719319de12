"""Find the law that the rule advises at other damping ratios, and compare our own law with it.

`python -m bench.findings.selection.gains FOLDER OUT` keeps of a quick suite what the rule reads.
"""

from __future__ import annotations

import functools
import json
import math
import sys
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

from bench.files import read_json
from bench.findings.selection.measured import Measured, measured
from bench.findings.selection.needs import DEFAULT, NEARLY, SURE, TRIED, Need, decide, is_ours
from bench.findings.selection.rule import GENERAL
from bench.findings.start_sets import DIRECTED
from bench.tables.schema import RESULTS
from bench.tables.store import read, write_table

COMMITTED = ("gains/kv-10", "gains/kv-14", "reference", "gains/kv-30")
"""Runs of the same suite and seed at Kp = 100 1/s^2, by rising Kv."""

SITUATIONS = ("matched", "bounded", "slow", "late", "heavy", "spinning")
"""Criteria beside GENERAL by which our law is compared with the one that is advised."""

OTHER_RULES = (
    (Need("no adversary is assumed and laws are compared by the median time", SURE), ("median", *GENERAL[1:])),
    (Need("99.9 % of evenly spread starts suffice, exact 180° rotations aside", (TRIED, NEARLY)), GENERAL),
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
    """The gains with their units and the damping ratio."""
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
    """The runs at the four damping ratios."""
    return tuple(measured(RESULTS / name) for name in COMMITTED)


def by_other_rules(found: Measured) -> list[tuple[str, str | None, tuple[str, ...]]]:
    """What each of OTHER_RULES advises, and the laws that tie with it."""
    every = ((need.words, decide(need, found, general)) for need, general in OTHER_RULES)
    return [(words, one.law, one.tied) for words, one in every]


def ours_in_words(own: str) -> str:
    """Whose law it is, and what the rows do not cover."""
    return (
        f"{own} is ours: 2026, simulation only, not reviewed. It keeps a quaternion from tick to tick: reset it when "
        "the goal jumps, which was not tested here. Its 60° margin against wrong orientations is a theorem for a "
        "fixed goal."
    )


WORDS = {
    "time": "the time in which 99 % settle",
    "worst": "the slowest start",
    "effort": "effort",
    "peak": "peak command",
    "variation": "variation of the command",
    "tick": "time a tick",
    "matched": "time at equal peak command",
    "bounded": "time with weak motors",
    "slow": "time at 20 Hz",
    "late": "time with 20 ms of delay",
    "heavy": "time under twice the model's inertia",
    "spinning": "time from a spin",
}
"""Criteria as part of a sentence that says what a law is better or worse by."""


def compare_at_all_gains(called: Callable[[str], str] = str) -> str:
    """Say in a few sentences how our law compares with the advised one at every committed damping ratio."""
    lines, times = [], []
    for one in committed():
        kp, kv = gains_of(one)
        law, own = decide(DEFAULT, one).law, ours(one)
        if law and own:
            ratio = f"{kv / (2.0 * math.sqrt(kp)):.2g}"
            lines.append((ratio, compare(one, own, law)))
            pair = one.number("time", own), one.number("time", law)
            times.append(f"at {ratio} in {pair[0]:.3f} s against {pair[1]:.3f} s ({called(law)})")
    if not lines:
        return ""
    always = [WORDS[name] for name in WORDS if all(name in its.better for _, its in lines)]
    worse: dict[tuple[str, ...], list[str]] = {}
    for name in WORDS:
        at = tuple(ratio for ratio, its in lines if name in its.worse)
        if at:
            worse.setdefault(at, []).append(WORDS[name])
    price = "; ".join(f"at {' and '.join(at)} by {', '.join(names)}" for at, names in worse.items())
    return (
        f"By damping ratio 99 % of its starts settle {', '.join(times)}. At every ratio it is better by "
        f"{', '.join(always) or 'nothing'}. It is worse {price or 'by nothing'}."
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
