"""The page on other libraries: which functions fail, with the smallest fix, and shipped controllers."""

import functools
from collections.abc import Iterator
from typing import Any

import pandas as pd

from bench.findings.remedy import KEEP, fix_of
from report.figures.kit import html
from report.figures.kit.page import Run, in_run
from report.figures.kit.spelling import listed, power
from report.figures.kit.tables import Table
from report.figures.libraries import answers, as_shipped

OURS = "orientation-bench"
"""Our own laws in results/libraries, asked like the libraries."""

FAULTS = Table("Library | Function | Fault | Smallest fix | Thread")
ORDER = (answers.ZERO, answers.SHEET, answers.LONG_WAY, answers.MISALIGNED, answers.DIGITS)
"""Order of the faults, by what they do to a controller."""


@functools.cache
def lines() -> pd.DataFrame:
    """Return a line a function, idioms and angles among them."""
    return answers.functions(answers.table())


def errors(every: pd.DataFrame, kind: str = "function") -> pd.DataFrame:
    """Return the functions, or the idioms, that are errors along an axis."""
    return every[every["form"].ne(answers.ANGLES) & every["kind"].eq(kind)]


def facts(run: Run) -> dict:
    """Return every number that the text takes, what fails and its fix, and shipped controllers and theirs.

    Ours are not counted among other libraries'.
    """
    rows, every = answers.table(), lines()
    others = every[every["library"] != OURS]
    functions, idioms = errors(others), errors(others, "idiom")
    good = functions[functions["is_right"]]
    single = good["precision"] == "single"
    return {
        "libraries": len(set(answers.origins()) - {OURS}),
        "functions": len(functions),
        "right": len(good),
        "idioms": len(idioms),
        "idioms_wrong": int((~idioms["is_right"]).sum()),
        "count": power(answers.COUNT_RAD),
        "worst_right": power(good[~single]["turn"].max()),
        "passed_names": listed(name for name, _ in passed(every)),
        "single_names": ", ".join(dict.fromkeys(good[single]["library"])),
        "worst_single": power(good[single]["turn"].max()),
        "turns": int(rows.groupby(["library", "function"])["turns"].sum().max()),
        "known": int(functions.loc[~functions["is_right"], "thread"].ne("").sum()),
        **loop_facts(),
        "tab_faults": FAULTS(faults(every)),
        "tab_shipped": in_run(as_shipped.list_fixes, run),
        **(in_run(shipped_facts, run) or {}),
    }


def shipped_facts(run: Run) -> dict:
    """Return what the text says of shipped controllers."""
    own = as_shipped.shipped(run)
    return {
        "shipped": len(own),
        "weak": int(as_shipped.is_weak(own).sum()),
        "shipped_dead": int((own["dead"] > 0).sum()),
        "kept": listed(f"`{name}`" for name in own["shipped"] if fix_of(name).words == KEEP),
    }


def loop_facts() -> dict:
    """Return how many closed loops are run, how many stay at 180°, and how many turn away first."""
    every = answers.responses().query("library != @OURS and kind == 'function'")
    return {
        "loops": len(every),
        "loops_dead": int((every["dead"] == every["at_180"]).sum()),
        "loops_away": int((every["away"] > 0).sum()),
        "axes_180": int(every["at_180"].min()),
    }


def faults(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row for the functions of a library that fail alike and for which the same thread is known."""
    own = errors(every[every["library"] != OURS]).query("not is_right")
    audited = answers.table("verdicts")[["library", "function", "replacement"]]
    own = own.merge(audited, how="left").fillna({"replacement": ""})
    own = own.assign(
        said=own["objections"].map(lambda found: "; ".join(found.values())),
        first=own["objections"].map(lambda found: min(map(ORDER.index, found))),
    )
    own = own.sort_values(["first", "library"], kind="stable")
    for (library, fault, thread), alike in own.groupby(["library", "said", "thread"], sort=False):
        names = ", ".join(f"`{name}`" for name in alike["function"])
        fixes = " or ".join(dict.fromkeys(instead(one, every) for one in alike.itertuples()))
        yield f"{library} {answers.origins()[library]['version']}", names, fault, fixes, as_shipped.reported(thread)


def passed(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a library: its functions that are right and give the rotation vector."""
    kept = errors(every[every["library"] != OURS]).query("is_right")
    for library, own in kept[kept["form"] == answers.VECTOR].groupby("library", sort=False):
        names = dict.fromkeys(name.partition(", of a ")[0] for name in own["function"])
        yield f"{library} {answers.origins()[library]['version']}", ", ".join(f"`{name}`" for name in names)


def instead(one: Any, every: pd.DataFrame) -> str:
    """Return the smallest fix: a change of a line, else a right function of the same library, else one of ours."""
    if one.form == answers.ANGLES or (one.replacement and not one.replacement.startswith("`of_")):
        return one.replacement or html.MISSING
    kept = errors(every).query("is_right")
    alike = kept[(kept["library"] == one.library) & (kept["takes"] == one.takes) & (kept["form"] == answers.VECTOR)]
    return f"`{alike['function'].iloc[0]}`" if len(alike) else f"`of_{one.takes}`"
