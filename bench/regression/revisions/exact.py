"""Two runs, row by row, in words: what differs, of which law, and whether that is a regression.

A regression is an outcome that got worse (settled or done, and no longer so; or stuck, which is a new dead point), a
basin that shrank, a row, contender or column that is gone, more of any operation, a settling time beyond the
tolerance of bench/regression/rows, or effort, peak or change at rest of the command beyond LARGER_IS_WORSE. Everything
else that differs is a change, or an improvement if it is one of these undone. Where the judge changed that is all that
is said.
"""

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from bench.counting import OPERATIONS as OPERATION_NAMES
from bench.counting import TOTAL
from bench.regression.revisions.comparison import CHANGE, EXACT, IMPROVEMENT, OPERATIONS, REGRESSION, Finding
from bench.regression.rows.difference import CHANGED, COLUMN, JUDGE, MISSING, NEW, Difference
from bench.tables.files import read_json
from bench.tables.read import with_contender
from bench.tables.store import read

GOOD = ("settled", "done")
STUCK = "stuck"
SMALLER_IS_WORSE = ("fails_from_rad", "settled_to_rad")
"""Of boundaries: nothing fails up to there."""
LARGER_IS_WORSE = {"effort": (1.25, 0.0), "peak_u": (1.25, 0.0), "rest_change": (2.0, 1.0)}
"""Of episodes: how many times as much is a regression, and what is too little to count: in rad/s^2 a change at rest of
a hundredth of Kp times a radian."""


def findings(differences: Iterable[Difference]) -> list[Finding]:
    """What differs, one finding for each law, kind of change and verdict; regressions first."""
    groups: dict[tuple, list[Difference]] = {}
    differences = list(differences)
    totals = {_law(one.row) for one in differences if _is_total(one)}
    for one in differences:
        if one.table == "costs" and one.kind == CHANGED and not _is_total(one) and _law(one.row) in totals:
            continue  # a stage of what the total says
        if one.column != "flops":  # the sum of what is said already
            groups.setdefault((one.table, _law(one.row), _what(one), _verdict(one)), []).append(one)
    found = [_finding(name, what, verdict, group) for (_, name, what, verdict), group in groups.items()]
    order = (REGRESSION, CHANGE, IMPROVEMENT)
    return sorted(found, key=lambda one: order.index(one.verdict))


def basins(base: Path, head: Path) -> list[Finding]:
    """Laws that settle from a smaller share of all orientations, by engine: of uniform starts that both runs have."""
    was, now = (_settled(Path(folder)) for folder in (base, head))
    found = []
    for (law, engine), old in was.groupby(level=[0, 1]):
        both = old.index.intersection(now.index)
        before, after = old.loc[both].mean(), now.loc[both].mean()
        if after < before:
            says = (
                f"{law} settles from {after:.1%} of all orientations, before from {before:.1%} "
                f"({len(both)} uniform starts, {engine}): lost basin"
            )
            found.append(Finding(EXACT, REGRESSION, law, "basin", f"{before:.4f}", f"{after:.4f}", says, len(both)))
    return found


def _settled(folder: Path) -> pd.Series:
    """Whether each episode of the free body from a uniform start settled; by law, engine and start."""
    rows = with_contender(read(folder, "episodes"))
    rows = rows[(rows["start_set"] == "uniform") & (rows["arm"] == "")]
    index = pd.MultiIndex.from_frame(rows[["contender", "engine", "start_id"]].astype(str))
    return pd.Series((rows["outcome"] == "settled").to_numpy(), index=index)


def _law(row: dict[str, str]) -> str:
    """The law, or the controller in contact; empty for a table."""
    name = row.get("regulator") or row.get("controller") or ""
    return f"{name}/{row['representation']}" if row.get("representation") else name


def _is_total(one: Difference) -> bool:
    return one.table == "costs" and one.kind == CHANGED and one.row["stage"] == TOTAL


def _what(one: Difference) -> str:
    """What of a law, as a finding names it."""
    if one.kind in (MISSING, NEW):
        return f"row of {one.table} {'gone' if one.kind == MISSING else 'new'}"
    if one.kind != CHANGED:
        return f"{one.table}.{one.column}" if one.column else f"{one.table}: row twice"
    if one.column == "outcome":
        return f"outcome {one.was} -> {one.now}"
    if one.table == "traces":
        return "curve"  # the columns of a curve are one finding
    return f"{one.column} ({one.row['branch']})" if one.table == "costs" else f"{one.table}.{one.column}"


def _verdict(one: Difference) -> str:
    if one.kind == NEW:
        return CHANGE
    if one.kind != CHANGED:
        return REGRESSION
    if one.column == "outcome":
        worse = one.was in GOOD or one.now == STUCK
        return REGRESSION if worse else IMPROVEMENT if one.now in GOOD else CHANGE
    if one.column in SMALLER_IS_WORSE:
        return REGRESSION if _number(one.now) < _number(one.was) else IMPROVEMENT
    if _is_total(one) or one.column == "settling_time_s":
        return REGRESSION if _number(one.now) > _number(one.was) else IMPROVEMENT
    if one.table == "episodes" and one.column in LARGER_IS_WORSE:
        return _grown(_number(one.was), _number(one.now), *LARGER_IS_WORSE[one.column])
    return CHANGE


def _grown(was: float, now: float, times: float, least: float) -> str:
    """Whether a number has grown or shrunk beyond a factor, to or from more than what counts."""
    if now > times * max(was, least):
        return REGRESSION
    return IMPROVEMENT if was > times * max(now, least) else CHANGE


def _number(word: str) -> float:
    """Nowhere is as far as can be."""
    return float("inf") if word == "nan" else float(word)


def _finding(name: str, what: str, verdict: str, group: list[Difference]) -> Finding:
    first = group[0]
    gate = OPERATIONS if first.table == "costs" and first.column in OPERATION_NAMES else EXACT
    return Finding(gate, verdict, name, what, first.was, first.now, _says(name, first, len(group)), len(group))


def _says(name: str, one: Difference, count: int) -> str:
    """All of it in words; of several rows the first is named."""
    more = f", and {count - 1} rows more" if count > 1 else ""
    if one.kind in (COLUMN, JUDGE):
        return one.says
    where = " ".join(word for key, word in one.row.items() if word and key not in ("regulator", "representation"))
    if one.kind == MISSING:
        return f"{name or one.table}: gone from {one.table}: {where}{more}"
    if one.kind == NEW:
        return f"{name or one.table}: new in {one.table}: {where}{more}"
    if one.column == "outcome" and one.now == STUCK:
        return f"{name} is stuck, was {one.was}: new dead point: {where}{more}"
    if one.column == "outcome":
        return f"{name}: outcome {one.was} -> {one.now}: {where}{more}"
    if one.table == "costs":
        return f"{name}: {one.column} {one.was} -> {one.now} a tick: {where}{more}"
    return f"{name or one.table}: {one.column or one.says} {one.was} -> {one.now}: {where}{more}"


def lost(head: Path) -> list[Finding]:
    """What head's run says of a user's law that crashed or hung."""
    notes = read_json(head / "provenance.json").get("lost", [])
    return [Finding(EXACT, REGRESSION, "", "lost", "", "", note) for note in notes]


def removed(differences: Iterable[Difference], head: Path) -> list[Finding]:
    """Laws of which head's run has no episode at all any more."""
    gone = {_law(one.row): one for one in differences if one.kind == MISSING and one.table == "episodes"}
    left = set(with_contender(read(head, "episodes"))["contender"].astype(str).str.partition("@")[0]) if gone else set()
    return [
        Finding(EXACT, REGRESSION, name, "contender", "there", "gone", f"{name} is gone: a removed contender")
        for name in gone
        if name not in left
    ]
