"""What the page says of other libraries, in numbers and names."""

from __future__ import annotations

import pandas as pd

from bench.figures import libraries_tables
from bench.figures.libraries_rows import (
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
    VECTOR,
)
from bench.figures.spelling import power


def said(rows: pd.DataFrame, lines: pd.DataFrame) -> dict[str, str | int]:
    """Every number and list of names that the page's text takes; ours are not counted among other libraries'."""
    others = lines[(lines["library"] != OURS) & (lines["form"] != ANGLES)]
    kinds = others["objections"].map(set)
    digits = kinds.map(lambda found: bool(found & {DIGITS, ASTRAY, LONG_WAY, NO_NUMBER}))
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    return {
        "libraries": others["library"].nunique(),
        "functions": len(others),
        "right": len(libraries_tables.right(others)),
        "count": power(COUNT_RAD),
        "sines": int((others["form"] == SINE).sum()),
        "sine_names": names(others[others["form"] == SINE]),
        "vectors": int((others["form"] == VECTOR).sum()),
        "dead": names(others[kinds.map(lambda found: NOUGHT in found) & (others["form"] != SINE)]),
        "sheets": int(kinds.map(lambda found: SHEET in found).sum()),
        "sheet_names": names(others[kinds.map(lambda found: SHEET in found)]),
        "digits": int(digits.sum()),
        "long_names": names(others[kinds.map(lambda found: LONG_WAY in found)]),
        "worst_right": power(libraries_tables.right(others)["largest"].max()),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "least_astray": f"{100 * lines[lines['form'] == ANGLES]['astray'].min():.0f}",
    }


def names(lines: pd.DataFrame) -> str:
    """`library's function, function; library's ...` as words, or none."""
    by_library = lines.groupby("library", sort=False)["function"].agg(lambda found: ", ".join(dict.fromkeys(found)))
    return "; ".join(f"{library}: {found}" for library, found in by_library.items()) or "none"
