"""What the episodes of a law say, in words: how many settle, which is lost, and what perturbation breaks it first."""

from __future__ import annotations

import pandas as pd

import tasks
from bench.findings.why.sentences import ENDS, FAILURES, Said, vector
from bench.tables.statistics import quantile

ROBUSTNESS = "16-robustness"
WITHSTOOD = 0.95
"""Share of its starts that a law settles at every level of a perturbation that it withstands."""
DIRECTED = "half-turn"


def settled(rows: pd.DataFrame, declared: str) -> list[Said]:
    """Settled a of b of each start set, and the first start that is lost, with its outcome.

    Args:
        rows: of one law and engine. declared: its `property`; one that is "almost global" may lose half turns.
    """
    is_settled = rows["outcome"] == "settled"
    times = rows.loc[is_settled & (rows["start_set"] == "uniform"), "settling_time_s"].to_numpy()
    took = f"; median from uniform starts {quantile(times, 0.5):.3f} s" if len(times) else ""
    groups = is_settled.groupby(rows["start_set"].astype(str), sort=False)
    each = ", ".join(f"{name} {own.sum():,} of {len(own):,}" for name, own in groups)
    said = [Said(f"Settled: {each}{took}.", ENDS)]
    lost = rows[~is_settled]
    for start_set, own in lost.groupby(lost["start_set"].astype(str), sort=False):
        first, kinds = own.iloc[0], own["outcome"].astype(str).value_counts()
        quat = vector([first[f"quat_{part}"] for part in "wxyz"])
        counts = ", ".join(f"{count:,} {word}" for word, count in kinds.items())
        text = f"Lost {start_set} starts: {counts}, as {first['start_id']} (w x y z = {quat}, {first['outcome']})."
        is_known = declared == "almost global" and start_set == DIRECTED
        said.append(Said(text, FAILURES, "" if is_known else "lost starts"))
    return said


def perturbed(rows: pd.DataFrame) -> list[Said]:
    """Which perturbation breaks it first: the fewest levels from the nominal one."""
    if rows.empty:
        return []
    shares = (rows["outcome"] == "settled").groupby([rows["axis"].astype(str), rows["level"]], sort=False).mean()
    broken = [
        (_levels_off(axis, level), share, axis, level) for (axis, level), share in shares.items() if share < WITHSTOOD
    ]
    names = {axis for axis, _ in shares.index}
    if not broken:
        return [Said(f"It withstands all {len(names)} perturbations.", ROBUSTNESS)]
    _, share, axis, level = min(broken)
    held = len(names - {name for _, _, name, _ in broken})
    text = f"Of {len(names)} perturbations it withstands {held}. What breaks it first is {axis}: at {level:g} "
    return [Said(f"{text}{tasks.axis(axis).unit} it settles {share:.0%} of its starts.", ROBUSTNESS)]


def _levels_off(axis: str, level: float) -> int:
    """How many levels there are between this and the nominal one, or the first."""
    one = tasks.axis(axis)
    nominal = one.levels.index(one.nominal) if one.nominal in one.levels else -1
    return abs(one.levels.index(level) - nominal)
