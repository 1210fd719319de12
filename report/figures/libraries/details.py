"""The appendix on other libraries: every fault with its closed loop, how it was tested, and questions of users."""

from __future__ import annotations

from collections.abc import Iterator

import pandas as pd

from bench.findings.questions import QUESTIONS, Question
from report.figures.kit import html
from report.figures.kit.page import Run
from report.figures.kit.spelling import power
from report.figures.kit.tables import Table
from report.figures.libraries import answers, loops
from report.figures.libraries.libraries import OURS, asked, errors, instead, lines, reported, right, said, with_fixes

WELD = "<weld>, by default"

FAULTS = Table("Function | Kind | Fault | In closed loop | Smallest fix | Thread")
ASKED = Table("Question | Cause | Cure | Measured | Without the cure:.3g | With it:.3g")


def facts(_: Run) -> dict:
    """Return how the functions were tested, and what the text says of angles and of controllers."""
    rows, every = answers.table(), lines()
    functions = errors(every[every["library"] != OURS])
    angles = every[every["form"] == answers.ANGLES]
    small, near = (rows[rows[name] > 0.0] for name in ("angle_rad", "distance_rad"))
    run = loops.responses().query("library != @OURS and kind == 'controller'")
    (weld,) = run[run["function"] == WELD].itertuples()
    return {
        "count": power(answers.COUNT_RAD),
        "single_count": power(answers.SINGLE_RAD),
        "sines": int((functions["form"] == answers.SINE).sum()),
        "axes": int(near["turns"].max()),
        "drawn": int(rows[rows["turn_set"] == "drawn"]["turns"].max()),
        "smallest": power(small["angle_rad"].min()),
        "nearest": power(near["distance_rad"].min()),
        "angle_functions": len(angles),
        "angles_exact": len(right(angles)),
        "controllers": len(run),
        "fixed": int((loops.verdicts()["fixed"] != "").sum()),
        "weld_loop": loops.in_words(weld),
    }


def tables(_: Run) -> dict:
    """Return what fails and its fix, and questions of users."""
    return {"tab_faults": FAULTS(faults(lines())), "asked": ASKED(map(describe_question, QUESTIONS))}


def faults(every: pd.DataFrame) -> Iterator[tuple]:
    """Return a row a function that fails: errors along an axis, idioms, and angles, which drive no loop."""
    found = with_fixes(every).merge(loops.responses(), on=["library", "function", "kind"], how="left")
    for one in found.sort_values("kind", kind="stable").itertuples():
        is_angles = one.form == answers.ANGLES
        kind = "angles" if is_angles else one.kind
        driven = html.MISSING if is_angles else loops.in_words(one)
        threads = html.MISSING if kind == "idiom" else reported(one.thread)
        yield asked(one), kind, said(one), driven, instead(one, every), threads


def describe_question(one: Question) -> tuple:
    """Return a question's row; what is no more than rounding is 0."""
    links = ", ".join(reported(thread, thread.partition("/")[2]) for thread in one.threads)
    measured = (value if abs(value) > 1e-12 else 0.0 for value in one.measure())
    return f"{one.title} ({links})", one.cause, one.cure, f"{one.quantity}; right: {one.right:g}", *measured
