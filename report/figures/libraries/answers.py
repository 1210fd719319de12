"""What other libraries answered, as the page reads it: a line a function, and what may be said against it.

Read from results/libraries, which is committed: it does not change with the run that a report is built from.
"""

from __future__ import annotations

import functools
import math

import pandas as pd

from bench.studies.libraries.forms import FORMS
from bench.tables.files import read_json
from bench.tables.schema import RESULTS
from bench.tables.store import read
from report.figures.kit.spelling import power

FOLDER = RESULTS / "libraries"
VECTOR, SINE, ANGLES = "rotation-vector", "sine", "z-y-x"

COUNT_RAD = 2.0 * math.pi / 2**24
"""An error below this is none to a robot: one count of an encoder of 24 bits, 3.7e-7 rad."""
UNDECIDED_RAD = 1e-7
"""Nearer to the half turn than this, the long way round is longer than the short one by less than a count."""

NO_NUMBER, ZERO, LONG_WAY, MISALIGNED, SHEET, DIGITS = "no-number", "zero", "long-way", "misaligned", "sheet", "digits"


@functools.cache
def table() -> pd.DataFrame:
    """Every row of libraries.parquet, words as words."""
    found = read(FOLDER, "libraries")
    return found.astype(dict.fromkeys(found.select_dtypes("category"), str))


def origins() -> dict[str, dict[str, str]]:
    """By library: its version, and with what it was asked."""
    return read_json(FOLDER / "provenance.json")["libraries"]


def functions(rows: pd.DataFrame) -> pd.DataFrame:
    """One line a function, in the table's order.

    Columns: library, function, takes, form; the largest error by its own form over `small` turns, `drawn` ones, those
    `near` the half turn, `at` it and at the `pole`; `off`, the largest error against theta k over drawn turns, and
    `misaligned`, the share of them that it is off the axis; `objections`, a dictionary from kind to words.
    """
    lines = []
    for (library, function), own in rows.groupby(["library", "function"], sort=False):
        first, uniform = own.iloc[0], drawn(own)
        lines.append(
            {
                "library": library,
                "function": function,
                "takes": first["takes"],
                "form": first["form"],
                **{name: part["form_error_rad"].max() for name, part in parts(own).items()},
                "off": uniform["error_rad"].max(),
                "misaligned": uniform[["astray", "long_way"]].sum().sum() / uniform["turns"].sum(),
                "objections": objections(own),
            }
        )
    return pd.DataFrame(lines)


def parts(own: pd.DataFrame) -> dict[str, pd.DataFrame]:
    """A function's rows by where its turns are."""
    return {
        "small": own[own["angle_rad"].notna()],
        "drawn": drawn(own),
        "near": own[own["distance_rad"] > 0.0],
        "at": own[own["distance_rad"] == 0.0],
        "pole": own[own["turn_set"] == "pole"],
    }


def drawn(own: pd.DataFrame) -> pd.DataFrame:
    """The rows of uniform turns."""
    return own[own["turn_set"] == "drawn"]


def objections(own: pd.DataFrame) -> dict[str, str]:
    """What is wrong with a function: kind to words with numbers, empty if nothing is.

    Angles are judged by the turn that they stand for alone; that they are no error along the axis is no fault of the
    function.
    """
    has_axis, at = FORMS[own["form"].iloc[0]].size is not None, parts(own)["at"]
    clear = own[~(own["distance_rad"] <= UNDECIDED_RAD)] if has_axis else own
    found = {}
    silent = own["raised"].sum() + own["not_finite"].sum()
    if silent:
        found[NO_NUMBER] = f"no number for {silent} of {own['turns'].sum()} turns"
    if has_axis and at["nought"].sum():
        found[ZERO] = f"zero at {_of(at, 'nought')} half turns"
    if has_axis and clear["long_way"].sum():
        found[LONG_WAY] = f"the long way round for {_of(clear, 'long_way')} turns"
    if has_axis and own["astray"].sum():
        found[MISALIGNED] = f"another axis for {_of(own, 'astray')} turns"
    if own["other_sheet"].sum():
        found[SHEET] = "the long way round for −q"
    if LONG_WAY not in found:
        found |= wrong(clear)
    return found


def wrong(clear: pd.DataFrame) -> dict[str, str]:
    """Where the error by its own form is largest, and how large; nothing if that is less than a count."""
    usable = clear[(clear["nought"] < clear["turns"]) & clear["form_error_rad"].notna()]
    worst = usable.loc[usable["form_error_rad"].idxmax()]
    if worst["form_error_rad"] <= COUNT_RAD:
        return {}
    return {DIGITS: f"off by {power(worst['form_error_rad'])} rad or more {where(worst)}"}


def where(row: pd.Series) -> str:
    """A set of turns in words."""
    if not math.isnan(row["angle_rad"]):
        return f"on turns of {power(row['angle_rad'])} rad"
    if math.isnan(row["distance_rad"]):
        return "at the poles" if row["turn_set"] == "pole" else "on drawn turns"
    return f"at {power(row['distance_rad'])} rad before the half turn" if row["distance_rad"] else "at half turns"


def _of(rows: pd.DataFrame, name: str) -> str:
    count, every = rows[name].sum(), rows["turns"].sum()
    return "all" if count == every else f"{count} of {every}"
