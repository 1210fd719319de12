"""The page on other libraries: which functions are right, which are not and where, idioms, and Euler angles."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any

import pandas as pd

from bench.findings.questions import QUESTIONS, Question
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from report.figures.libraries import answers, loops

OURS = "orientation-bench"
"""Our own laws in results/libraries, asked like the libraries."""
HOST = "https://github.com"
WELD = "<weld>, by default"

TO_USE = Table("Library | From a matrix | From a quaternion")
FAULTS = Table("Function | Kind | Fault | In closed loop | Smallest fix | Reported")

ASKED = Table("Question | Cause | Cure | Measured | Without the cure:.3g | With it:.3g")

TAKES = ("matrix", "quaternion")


@functools.cache
def lines() -> pd.DataFrame:
    """Return a line a function, idioms and angles among them."""
    return answers.functions(answers.table())


def errors(every: pd.DataFrame, kind: str = "function") -> pd.DataFrame:
    """Return the functions, or the idioms, that are errors along an axis."""
    return every[every["form"].ne(answers.ANGLES) & every["kind"].eq(kind)]


def right(every: pd.DataFrame) -> pd.DataFrame:
    """Return those against which nothing is said."""
    return every[every["objections"].map(len).eq(0)]


def faulty(every: pd.DataFrame) -> pd.DataFrame:
    """Return those against which something is said."""
    return every[every["objections"].map(len).gt(0)]


def facts(_: Run) -> dict:
    """Return every number and list of names that the text takes; ours are not counted among other libraries'."""
    rows, every = answers.table(), lines()
    others = every[every["library"] != OURS]
    functions, idioms = errors(others), errors(others, "idiom")
    sines, angles = functions[functions["form"] == answers.SINE], every[every["form"] == answers.ANGLES]
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    good = right(functions)
    single = good["precision"] == "single"
    return {
        "libraries": len(set(answers.origins()) - {OURS}),
        "functions": len(functions),
        "right": len(good),
        "idioms": len(idioms),
        "idioms_wrong": len(faulty(idioms)),
        "count": power(answers.COUNT_RAD),
        "single_count": power(answers.SINGLE_RAD),
        "single_names": ", ".join(dict.fromkeys(good[single]["library"])),
        "kinds": "; ".join(
            f"{kind} {n}" for kind, n in functions["objections"].map(list).explode().value_counts().items()
        ),
        "sines": len(sines),
        "worst_right": power(good[~single]["turn"].max()),
        "worst_single": power(good[single]["turn"].max()),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "angle_functions": len(angles),
        "angles_exact": len(right(angles)),
        "known": int(faulty(functions)["thread"].ne("").sum()),
        **loop_facts(),
    }


def loop_facts() -> dict:
    """Return what the text says of closed loops: how many are run, how many stay at 180° or turn away; the weld's."""
    every = loops.responses()[loops.responses()["library"] != OURS]
    functions, run = (every[every["kind"] == kind] for kind in ("function", "controller"))
    (weld,) = run[run["function"] == WELD].itertuples()
    return {
        "loops": len(functions),
        "controllers": len(run),
        "loops_dead": int((functions["dead"] == functions["at_180"]).sum()),
        "loops_away": int((functions["away"] > 0).sum()),
        "axes_180": int(functions["at_180"].min()),
        "fixed": int((loops.verdicts()["fixed"] != "").sum()),
        "weld_loop": loops.in_words(weld),
    }


def tables(_: Run) -> dict:
    """Return what to use, what fails and its fix, and questions of users."""
    every = lines()
    return {
        "tab_to_use": TO_USE(to_use(every)),
        "tab_faults": FAULTS(faults(every)),
        "asked": ASKED(map(describe_question, QUESTIONS)),
    }


def faults(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a function that fails: errors along an axis, idioms, and angles, which drive no loop."""
    keys = ["library", "function"]
    fixes = loops.verdicts()[[*keys, "replacement"]]
    found = faulty(every).merge(fixes, on=keys, how="left").merge(loops.responses(), on=[*keys, "kind"], how="left")
    for one in found.fillna({"replacement": ""}).sort_values("kind", kind="stable").itertuples():
        is_angles = one.form == answers.ANGLES
        kind = "angles" if is_angles else one.kind
        driven = html.MISSING if is_angles else loops.in_words(one)
        threads = html.MISSING if kind == "idiom" else reported(one.thread)
        yield asked(one), kind, said(one), driven, instead(one, every), threads


def to_use(every: pd.DataFrame) -> list[tuple]:
    """Return a row a library: its functions that are right and give the rotation vector, by what they take."""
    kept = right(errors(every))
    kept = kept[kept["form"] == answers.VECTOR]
    return [
        (f"`{library}`", *(_named(kept[(kept["library"] == library) & (kept["takes"] == what)]) for what in TAKES))
        for library in dict.fromkeys(kept["library"])
        if library != OURS
    ]


def _named(own: pd.DataFrame) -> str:
    """Return names as code, without what the column says already."""
    return "<br>".join(f"`{name.partition(', of a ')[0]}`" for name in own["function"]) or html.MISSING


def instead(one: Any, every: pd.DataFrame) -> str:
    """Return the smallest fix: a change of a line, else a right function of the same library, else one of ours."""
    if one.form == answers.ANGLES or (one.replacement and not one.replacement.startswith("`of_")):
        return one.replacement or html.MISSING
    kept = right(errors(every))
    alike = kept[(kept["library"] == one.library) & (kept["takes"] == one.takes) & (kept["form"] == answers.VECTOR)]
    return f"`{alike['function'].iloc[0]}`" if len(alike) else f"`of_{one.takes}`"


def said(one: Any) -> str:
    """Return the verdict on a line's function."""
    return "; ".join(one.objections.values()) or loops.RIGHT


def reported(thread: str, words: str = "") -> str:
    """Return a thread upstream, owner/repository#number, as a link; pull requests are found under it too."""
    repository, _, number = thread.partition("#")
    return f"[{words or f'#{number}'}]({HOST}/{repository}/issues/{number})" if thread else "not found"


def asked(one: Any) -> str:
    """Return a line's library and function."""
    return f"{one.library} `{one.function}`"


def describe_question(one: Question) -> tuple:
    """Return a question's row; what is no more than rounding is 0."""
    links = ", ".join(reported(thread, thread.partition("/")[2]) for thread in one.threads)
    measured = (value if abs(value) > 1e-12 else 0.0 for value in one.measure())
    return f"{one.title} ({links})", one.cause, one.cure, f"{one.quantity}; right: {one.right:g}", *measured
