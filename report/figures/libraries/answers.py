"""What other libraries answered, and how they do in closed loop, as the page reads it: a line a function.

Read from results/libraries, which is committed: it does not change with the run that a report is built from.
"""

import functools
import math

import pandas as pd

from bench.base.files import read_json
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read
from bench.studies.libraries.judge import COUNT_RAD, FORMS, SINGLE_RAD, WRONG_AXIS_RAD
from report.figures.kit.spelling import power

FOLDER = RESULTS / "libraries"
VECTOR, SINE, ANGLES = "rotation-vector", "sine", "z-y-x"

NO_NUMBER, ZERO, LONG_WAY, MISALIGNED, SHEET, DIGITS = "no-number", "zero", "long-way", "misaligned", "sheet", "digits"


@functools.cache
def table(name: str = "libraries") -> pd.DataFrame:
    """Return every row of a table of the study, words as words."""
    found = read(FOLDER, name)
    return found.astype(dict.fromkeys(found.select_dtypes("category"), str))


def origins() -> dict[str, dict[str, str]]:
    """Return by library its version and the packages that it was tested with."""
    return read_json(FOLDER / "provenance.json")["libraries"]


def functions(rows: pd.DataFrame) -> pd.DataFrame:
    """One line a function, in the table's order.

    Columns: library, function, kind, takes, form, precision, thread; `turn`, the largest error of the turn that an
    answer stands for; `objections`, the verdict: a dictionary from kind to words; `is_right`: it is empty.
    """
    words = ["library", "function", "kind", "takes", "form", "precision", "thread"]
    lines = [
        {**own.iloc[0][words], "turn": own["turn_error_rad"].max(), "objections": objections(own)}
        for _, own in rows.groupby(["library", "function"], sort=False)
    ]
    return pd.DataFrame(lines).assign(is_right=lambda every: ~every["objections"].map(bool))


def objections(own: pd.DataFrame) -> dict[str, str]:
    """Return what is wrong with a function: kind to words with numbers, empty if nothing is.

    Every function is judged by the turn that its answer stands for; that angles are no error along the axis is no fault
    of the function. This is the only verdict on a function that the page has.
    """
    has_axis, at = FORMS[own["form"].iloc[0]].size is not None, own[own["distance_rad"] == 0.0]
    found = {}
    silent = own["raised"].sum() + own["not_finite"].sum()
    if silent:
        found[NO_NUMBER] = f"no number for {silent} of {own['turns'].sum()} turns"
    if has_axis and at["nought"].sum():
        found[ZERO] = f"zero at {_of(at, 'nought')} 180° rotations"
    # Next to 180° the other axis is almost the same turn: what is left of it counts as digits.
    long = own.assign(long_way=own["long_way"].where(own["turn_error_rad"] > WRONG_AXIS_RAD, 0))
    if has_axis and long["long_way"].sum():
        found[LONG_WAY] = f"unwinding for {_of(long, 'long_way')} rotations"
    if has_axis and own["astray"].sum():
        found[MISALIGNED] = f"another axis for {_of(own, 'astray')} rotations"
    if own["other_sheet"].sum():
        found[SHEET] = "unwinding for −q"
    return found if LONG_WAY in found else found | wrong(own[own["nought"] == 0] if ZERO in found else own)


def wrong(own: pd.DataFrame) -> dict[str, str]:
    """Return where the error is largest, and how large; nothing if that is less than the library's precision."""
    worst = own.loc[own["turn_error_rad"].idxmax()]
    if worst["turn_error_rad"] <= (SINGLE_RAD if worst["precision"] == "single" else COUNT_RAD):
        return {}
    return {DIGITS: f"off by {power(worst['turn_error_rad'])} rad {where(worst)}"}


def where(row: pd.Series) -> str:
    """Return a set of turns in words."""
    if not math.isnan(row["angle_rad"]):
        return f"for rotations of {power(row['angle_rad'])} rad"
    if math.isnan(row["distance_rad"]):
        return "at the poles" if row["turn_set"] == "pole" else "for drawn rotations"
    return f"at {power(row['distance_rad'])} rad before 180°" if row["distance_rad"] else "at 180°"


def _of(rows: pd.DataFrame, name: str) -> str:
    count, every = rows[name].sum(), rows["turns"].sum()
    return "all" if count == every else f"{count} of {every}"


@functools.cache
def responses() -> pd.DataFrame:
    """Return a row a function or controller: its starts below 180° and at it.

    Columns: library, function, kind; unsettled, away: of the starts below 180°; at_180, dead: of the starts at 180°,
    how many and how many of them never move.
    """
    rows = table("closed_loop")
    is_at = rows["angle_deg"] == 180.0
    below, at = (rows[chosen].groupby(["library", "function", "kind"], sort=False) for chosen in (~is_at, is_at))
    counts = {
        "unsettled": below[["dead", "lost", "failed"]].sum().sum(axis=1),
        "away": below["away"].sum(),
        "at_180": at["starts"].sum(),
        "dead": at["dead"].sum(),
    }
    return pd.DataFrame(counts).reset_index()
