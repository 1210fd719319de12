"""Say in words what differs between two runs: of which law, what, and whether it is a regression.

A regression is an outcome that got worse, a row or column that is gone, more of any operation, a settling time beyond
the tolerance of bench/regression/rows, or effort, peak or change at rest of the command beyond LARGER_IS_WORSE. The
reverse of one of these is an improvement, all else a change. Where the judge changed, only that is said.
"""

from pathlib import Path

from bench.base.provenance import read_provenance
from bench.engines.counting import OPERATIONS as OPERATION_NAMES
from bench.engines.counting import TOTAL
from bench.regression.revisions.summary import CHANGE, IMPROVEMENT, REGRESSION, Finding
from bench.regression.rows import describe_skipped, find_differences
from bench.regression.rows.difference import CHANGED, COLUMN, JUDGE, MISSING, NEW, Difference

EXACT, OPERATIONS, OF_LAW = "exact", "operations", ("regulator", "representation")
GOOD, STUCK = ("settled", "done"), "stuck"
SMALLER_IS_WORSE = ("fails_from_rad", "settled_to_rad")  # of boundaries: nothing fails up to there
LARGER_IS_WORSE = {"effort": (1.25, 0.0), "peak_u": (1.25, 0.0), "rest_change": (2.0, 1.0)}
"""Columns of episodes: the factor of a regression, and what is too little: Kp/100 [rad/s^2] of a change at rest."""
LEADING = ("outcome", "settling_time_s", "effort", "peak_u")
FEW = 3  # other columns of a law that have a line each; more are folded into one


def compare_runs(base: Path, head: Path) -> list[Finding]:
    """Return all findings between two runs' folders; first what head's run says of a law that crashed or hung."""
    found = sort_findings(find_differences(base, head))  # first, for it refuses a folder without a finished run
    lost = [Finding(EXACT, REGRESSION, "", note) for note in read_provenance(head).get("lost", [])]
    return [*lost, *found, *(Finding(EXACT, CHANGE, "", note) for note in describe_skipped(base))]


def sort_findings(differences: list[Difference]) -> list[Finding]:
    """Return one finding for each law, kind of change and verdict; regressions first."""
    groups: dict[tuple, list[Difference]] = {}
    others: dict[str, list[Finding]] = {}
    totals = {_name_law(one.row) for one in differences if _is_total(one)}
    for one in differences:
        is_stage = one.table == "costs" and one.kind == CHANGED and not _is_total(one)
        if one.column == "flops" or (is_stage and _name_law(one.row) in totals):
            continue  # the sum of other differences, or a part of one
        what = (one.was, one.now) if one.column == "outcome" else one.row.get("branch")
        column = "" if one.table == "traces" and one.kind == CHANGED else one.column  # a curve is one finding
        groups.setdefault((_judge(one), one.table, _name_law(one.row), one.kind, column, what), []).append(one)
    found: list[Finding] = []
    for (verdict, _, name, kind, column, _), group in groups.items():
        made = _make_finding(name, verdict, group)
        is_other = verdict == CHANGE and kind == CHANGED and column not in LEADING
        (others.setdefault(name, []) if is_other else found).append(made)
    for name, own in others.items():
        more = tuple(one.says for one in own)
        folded = Finding(own[0].gate, CHANGE, name, f"{name}: {len(own)} other columns moved", more)
        found += [folded] if len(own) > FEW else own
    return sorted(found, key=lambda one: (REGRESSION, CHANGE, IMPROVEMENT).index(one.verdict))


def _name_law(row: dict[str, str]) -> str:
    """Return the law, or the controller in contact; empty for a table."""
    name = row.get("regulator") or row.get("controller") or ""
    return f"{name}/{row['representation']}" if row.get("representation") else name


def _is_total(one: Difference) -> bool:
    return one.table == "costs" and one.kind == CHANGED and one.row["stage"] == TOTAL


def _judge(one: Difference) -> str:
    """Return whether a difference is a regression, a change or an improvement."""
    if one.kind != CHANGED:
        return CHANGE if one.kind == NEW else REGRESSION
    if one.column == "outcome":
        return REGRESSION if one.was in GOOD or one.now == STUCK else IMPROVEMENT if one.now in GOOD else CHANGE
    times, least = LARGER_IS_WORSE.get(one.column, (1.0, 0.0)) if one.table == "episodes" else (1.0, 0.0)
    if times == 1.0 and not _is_total(one) and one.column not in (*SMALLER_IS_WORSE, "settling_time_s"):
        return CHANGE
    was, now = (float("inf") if word == "nan" else float(word) for word in (one.was, one.now))
    if one.column in SMALLER_IS_WORSE:
        was, now = now, was
    return REGRESSION if now > times * max(was, least) else IMPROVEMENT if was > times * max(now, least) else CHANGE


def _make_finding(name: str, verdict: str, group: list[Difference]) -> Finding:
    one, more = group[0], f", and {len(group) - 1} rows more" if len(group) > 1 else ""
    gate = OPERATIONS if one.table == "costs" and one.column in OPERATION_NAMES else EXACT
    if one.kind in (COLUMN, JUDGE):
        return Finding(gate, verdict, name, one.says)
    where = _describe_place(one.row)
    what = name or one.table
    if one.kind in (MISSING, NEW):
        said = f"{what}: {'gone from' if one.kind == MISSING else 'new in'} {one.table}"
    elif one.column == "outcome" and one.now == STUCK:
        said = f"{name} is stuck, was {one.was}: new dead point"
    else:
        said = f"{what}: {one.column or one.says} {one.was} -> {one.now}{' a tick' if one.table == 'costs' else ''}"
    return Finding(gate, verdict, name, f"{said}: {where}{more}")


def _describe_place(row: dict[str, str]) -> str:
    """Return where a row is: of an episode its engine, arm, plant and start, of others the words of its key."""
    words = {key: word for key, word in row.items() if word not in ("", "0", "nominal") and key not in OF_LAW}
    if "start_id" not in words or "engine" not in words:
        return " ".join(words.values())
    places = (("by", "engine"), ("on", "arm"), ("with", "variation"), ("from", "start_id"))
    return " ".join(f"{before} {words[key]}" for before, key in places if key in words)
