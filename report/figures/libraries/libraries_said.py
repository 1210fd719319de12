"""What the page says of other libraries, in numbers and names."""

from __future__ import annotations

import pandas as pd

from report.figures.kit.spelling import power
from report.figures.libraries import libraries_tables
from report.figures.libraries.libraries_rows import (
    ANGLES,
    ASTRAY,
    COUNT_RAD,
    DIGITS,
    LONG_WAY,
    NO_NUMBER,
    NOUGHT,
    OURS,
    SHEET,
    SINE,
    UNDECIDED_RAD,
)

EVERYWHERE = ["small", "drawn", "near", "at", "pole"]


def said(rows: pd.DataFrame, lines: pd.DataFrame) -> dict[str, str | int]:
    """Every number and list of names that the page's text takes; ours are not counted among other libraries'."""
    others = lines[(lines["library"] != OURS) & (lines["form"] != ANGLES)]
    kinds = others["objections"].map(set)
    digits = kinds.map(lambda found: bool(found & {DIGITS, ASTRAY, NO_NUMBER}))
    dead = others[kinds.map(lambda found: NOUGHT in found) & (others["form"] != SINE)]
    sines, angles = others[others["form"] == SINE], lines[lines["form"] == ANGLES]
    exact = angles["objections"].map(len) == 0
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    return {
        "libraries": others["library"].nunique(),
        "functions": len(others),
        "right": len(libraries_tables.right(others)),
        "count": power(COUNT_RAD),
        "sines": len(sines),
        "sine_names": names(sines),
        "sine_error": power(sines[EVERYWHERE].to_numpy().max()),
        "dead": names(dead),
        "dead_else": power(dead[["small", "drawn", "near", "pole"]].to_numpy().max()) if len(dead) else "0",
        "sheets": int(kinds.map(lambda found: SHEET in found).sum()),
        "sheet_names": names(others[kinds.map(lambda found: SHEET in found)]),
        "digits": int(digits.sum()),
        "long_names": names(others[kinds.map(lambda found: found == {LONG_WAY})]),
        "worst_right": power(libraries_tables.right(others)["largest"].max()),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "undecided": power(UNDECIDED_RAD),
        "least_astray": f"{100 * angles['astray'].min():.0f}",
        "angle_functions": len(angles),
        "angles_exact": int(exact.sum()),
        "angles_wrong": names(angles[~exact]),
    }


def names(lines: pd.DataFrame) -> str:
    """`library's function, function; library's ...` as words, or none."""
    by_library = lines.groupby("library", sort=False)["function"].agg(lambda found: ", ".join(dict.fromkeys(found)))
    return "; ".join(f"{library}: {found}" for library, found in by_library.items()) or "none"
