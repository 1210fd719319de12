"""The page on other libraries: which functions fail, with the smallest fix, and shipped controllers.

Read from results/libraries, which is committed: it does not change with the run that a report is built from.
"""

import functools
import math
import re
from collections.abc import Iterator
from typing import Any

import pandas as pd

from bench.audit.examined import COUNT_RAD
from bench.base.files import read_json
from bench.experiments.tables.run import Run
from bench.experiments.tables.store import read
from bench.findings.amounts import capitalize, count_of, join_words
from bench.findings.libraries import SINGLE_RAD, STUDY, WRONG_AXIS_RAD
from bench.findings.remedy import KEEP, fix_of
from report.figures.kit import html, spelling
from report.figures.kit.page import in_run
from report.figures.kit.spelling import power
from report.figures.libraries import as_shipped

VECTOR, SINE, ANGLES = "rotation-vector", "sine", "z-y-x"

NO_NUMBER, ZERO, LONG_WAY, MISALIGNED, SHEET, DIGITS = "no-number", "zero", "long-way", "misaligned", "sheet", "digits"

OURS = "orientation-bench"
"""Our own laws in results/libraries, asked like the libraries."""

FAULTS = html.PageTable("Library | Function | Fault | Smallest fix | Public discussion")
FORMULAS = html.PageTable("Library | Formula | Fault | Right function, or change of the formula")
FIX_WORDS = (
    (re.compile(r"^`-q` where `q.w < 0`, between the two$"), "negate q between the two calls if `q.w < 0`"),
    (re.compile(r"^`-q` where `?([\w.()]+) < 0`?(?:, before it)?$"), r"negate q first if `\1 < 0`"),
    (re.compile(r"^(`[^`]+`) for (`[^`]+`)$"), r"\1 instead of \2"),
    (re.compile(r"^(`[^`]+`) of it$"), r"\1 of the quaternion"),
)
"""What verdicts.parquet has for a fix, and the words of a page for it."""
ORDER = (ZERO, SHEET, LONG_WAY, MISALIGNED, DIGITS)
"""Order of the faults, by what they do to a controller."""


@functools.cache
def table(name: str = "libraries") -> pd.DataFrame:
    """Return every row of a table of the study, words as words."""
    found = read(STUDY, name)
    return found.astype(dict.fromkeys(found.select_dtypes("category"), str))


def origins() -> dict[str, dict[str, str]]:
    """Return by library its version and the packages that it was tested with."""
    return read_json(STUDY / "provenance.json")["libraries"]


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
    has_axis = own["form"].iloc[0] != ANGLES
    at = own[own["distance_rad"] == 0.0]
    found = {}
    silent = own["raised"].sum() + own["not_finite"].sum()
    if silent:
        found[NO_NUMBER] = f"no number for {say_count(silent, own['turns'].sum(), 'rotations')}"
    if has_axis and at["nought"].sum():
        found[ZERO] = f"the error is zero for {count_column(at, 'nought', 'rotations by 180°')}"
    # Next to 180° the other axis is almost the same turn: what is left of it counts as digits.
    long = own.assign(long_way=own["long_way"].where(own["turn_error_rad"] > WRONG_AXIS_RAD, 0))
    if has_axis and long["long_way"].sum():
        found[LONG_WAY] = f"unwinding for {count_column(long, 'long_way', 'rotations')}"
    if has_axis and own["astray"].sum():
        found[MISALIGNED] = f"wrong axis for {count_column(own, 'astray', 'rotations')}"
    if own["other_sheet"].sum():
        found[SHEET] = "unwinding if the function gets −q instead of q"
    return found if LONG_WAY in found else found | wrong(own[own["nought"] == 0] if ZERO in found else own)


def wrong(own: pd.DataFrame) -> dict[str, str]:
    """Return where the error is largest, and how large; nothing if that is less than the library's precision."""
    worst = own.loc[own["turn_error_rad"].idxmax()]
    if worst["turn_error_rad"] <= (SINGLE_RAD if worst["precision"] == "single" else COUNT_RAD):
        return {}
    return {DIGITS: f"error of {power(worst['turn_error_rad'])} rad {where(worst)}"}


def where(row: pd.Series) -> str:
    """Return a set of turns in words."""
    if not math.isnan(row["angle_rad"]):
        return f"for rotations by {power(row['angle_rad'])} rad"
    if math.isnan(row["distance_rad"]):
        return "at the poles" if row["turn_set"] == "pole" else "for random rotations"
    return f"at a distance of {power(row['distance_rad'])} rad from 180°" if row["distance_rad"] else "at 180°"


def count_column(rows: pd.DataFrame, name: str, nouns: str) -> str:
    """Say for how many of the rotations of some rows a column counts a fault."""
    return say_count(rows[name].sum(), rows["turns"].sum(), nouns)


def say_count(part: int, whole: int, nouns: str) -> str:
    """Say how many of a group, in the number style of a page: 48 of the 6 316 rotations."""
    return spelling.typeset(count_of(int(part), int(whole), nouns))


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


@functools.cache
def lines() -> pd.DataFrame:
    """Return a line a function, idioms and angles among them."""
    return functions(table())


def errors(every: pd.DataFrame, kind: str = "function") -> pd.DataFrame:
    """Return the functions, or the idioms, that are errors along an axis."""
    return every[every["form"].ne(ANGLES) & every["kind"].eq(kind)]


def facts(run: Run) -> dict:
    """Return every number that the text takes, what fails and its fix, and shipped controllers, without ours."""
    rows, every = table(), lines()
    others = every[every["library"] != OURS]
    functions, idioms = errors(others), errors(others, "idiom")
    good = functions[functions["is_right"]]
    single = good["precision"] == "single"
    return {
        "libraries": len(set(origins()) - {OURS}),
        "functions": len(functions),
        "right": len(good),
        "idioms": len(idioms),
        "idioms_wrong": int((~idioms["is_right"]).sum()),
        "count": power(COUNT_RAD),
        "worst_right": power(good[~single]["turn"].max()),
        "passed_names": ", ".join(name for name, _ in passed(every)) + ".",
        "single_names": ", ".join(dict.fromkeys(good[single]["library"])),
        "worst_single": power(good[single]["turn"].max()),
        "turns": int(rows.groupby(["library", "function"])["turns"].sum().max()),
        "known": int(functions.loc[~functions["is_right"], "thread"].ne("").sum()),
        **loop_facts(),
        "tab_faults": FAULTS(faults(every)),
        "tab_formulas": FORMULAS(formulas(every)),
        **(in_run(shipped_facts, run) or {}),
    }


def shipped_facts(run: Run) -> dict:
    """Return what the text says of shipped controllers, and a row for each that a small fix helps."""
    own = as_shipped.shipped(run)
    fixed = [row for row in own.itertuples() if fix_of(row.shipped).words != KEEP]
    weak = count_of(int(as_shipped.is_weak(own).sum()), len(own), "controllers")
    dead = count_of(int((own["dead"] > 0).sum()), len(own), "controllers")
    return {
        "tab_shipped": as_shipped.FIXES(map(as_shipped.describe_fix, fixed)),
        "shipped": len(own),
        "weak": f"{capitalize(weak)} apply",
        "shipped_dead": f"{capitalize(dead)} never move",
        "fixable": capitalize(count_of(len(fixed), len(own), "controllers")),
        "kept": join_words(f"`{name}`" for name in own["shipped"] if fix_of(name).words == KEEP),
    }


def loop_facts() -> dict:
    """Return how many closed loops are run, how many stay at 180°, and how many turn away first."""
    every = responses().query("library != @OURS and kind == 'function'")
    return {
        "loops": len(every),
        "loops_dead": int((every["dead"] == every["at_180"]).sum()),
        "loops_away": int((every["away"] > 0).sum()),
        "axes_180": int(every["at_180"].min()),
    }


def faults(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row for the functions of a library that fail alike and for which the same thread is known."""
    own = errors(every[every["library"] != OURS]).query("not is_right")
    audited = table("verdicts")[["library", "function", "replacement"]]
    own = own.merge(audited, how="left").fillna({"replacement": ""})
    own = own.assign(
        said=own["objections"].map(lambda found: "; ".join(found.values())),
        first=own["objections"].map(lambda found: min(map(ORDER.index, found))),
    )
    own = own.sort_values(["first", "library"], kind="stable")
    for (library, fault, thread), alike in own.groupby(["library", "said", "thread"], sort=False):
        names = ", ".join(f"`{name}`" for name in alike["function"])
        fixes = " or ".join(dict.fromkeys(spell_fix(instead(row, every)) for row in alike.itertuples()))
        yield name_version(library), names, fault, fixes, as_shipped.reported(thread)


def name_version(library: str) -> str:
    """Return a library with the version that was tested."""
    return f"{library} {origins()[library]['version']}"


def formulas(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row for the formulas of a library that fail, which users build from functions for other purposes."""
    audited = table("verdicts")[["library", "function", "replacement"]]
    failing = errors(every[every["library"] != OURS], "idiom").query("not is_right").merge(audited, how="left")
    for row in failing.fillna({"replacement": ""}).itertuples():
        fault = "; ".join(row.objections.values())
        yield name_version(row.library), name_formula(row.function), fault, spell_fix(row.replacement) or html.MISSING


def name_formula(name: str) -> str:
    """Return a formula of users in words, from the short form in verdicts.parquet."""
    doubled = re.fullmatch(r"2 (.*), vector part", name)
    if doubled:
        return f"twice the vector part of `{doubled[1]}`"
    source, _, factors = name.partition(": ")
    first, _, second = factors.partition(" * ")
    return f"`{first}` times `{second}` of `{source}`"


def spell_fix(text: str) -> str:
    """Return a fix in words, from the short form in verdicts.parquet."""
    for short, words in FIX_WORDS:
        if short.match(text):
            return short.sub(words, text)
    return text


def passed(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a library: its functions that are right and give the rotation vector."""
    kept = errors(every[every["library"] != OURS]).query("is_right")
    for library, own in kept[kept["form"] == VECTOR].groupby("library", sort=False):
        names = dict.fromkeys(name.partition(", of a ")[0] for name in own["function"])
        yield f"{library} {origins()[library]['version']}", ", ".join(f"`{name}`" for name in names)


def instead(one: Any, every: pd.DataFrame) -> str:
    """Return the smallest fix: a change of a line, else a right function of the same library, else one of ours."""
    if one.form == ANGLES or (one.replacement and not one.replacement.startswith("`of_")):
        return one.replacement or html.MISSING
    kept = errors(every).query("is_right")
    alike = kept[(kept["library"] == one.library) & (kept["takes"] == one.takes) & (kept["form"] == VECTOR)]
    return f"`{alike['function'].iloc[0]}`" if len(alike) else f"`of_{one.takes}`"
