"""The section on the order of selection: each on a plate, a crank and a peg, and in theory."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

import tasks
from bench.experiments.tables.run import Run
from bench.findings.amounts import join_words
from bench.findings.theory.selection_theory import CASES, exerted_error, inertia_at
from bench.law.control.contact_controller import SELECTION_ORDERS
from report.figures.contact.in_contact import MEASURES, Measure
from report.figures.kit import html
from tasks.domains import surface_alignment
from tasks.rules import RULES

LAW = "hybrid-base"
TASKS = ("surface-alignment", "crank", "peg-in-hole")
ENDS = (
    Measure("force_error_end_n", "force error [N]"),
    Measure("moment_error_end_nm", "moment error [N m]"),
)
RESULT_HEADS = (
    "Result at the end",
    "Hands at rest at the end",
    "Error of the force at the end [N]",
    "Error of the moment at the end [N m]",
)
RESULTS = html.PageTable(
    f"Task | Measured at the end | Order | Episodes | {' | '.join(RESULT_HEADS)}",
    words=("Episodes", *RESULT_HEADS),
)

SIZES = (("force", "N"), ("moment", "N m"))
ARM = "puma560"
ACCELERATION = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
"""1 m/s^2 along x, of the example that theory is computed for."""
CASE_HEADS = [f"Error of the {what}, {case} [{unit}]" for case in CASES for what, unit in SIZES]
THEORY = html.PageTable(f"Order | {' | '.join(CASE_HEADS)}")


def facts(run: Run) -> dict:
    """Return a table of the tasks, what it says of the plate, and a table of theory."""
    return {
        "tasks": RESULTS(compare_orders(run)),
        "finding": describe_plates(run),
        "theory": THEORY(predict_errors()),
        "arm": tasks.arm(ARM).title,
        "acceleration": f"{ACCELERATION[0]:g}",
        "hold_s": f"{RULES.hold_s:g}",
    }


def name_order(order: str) -> str:
    """Return an order of selection in words: "selected, then decoupled"."""
    return order.replace("-then-", ", then ")


def of_order(run: Run, task: str, order: str) -> pd.DataFrame:
    """Return the rows of an order on the axes of the base, maybe none."""
    rows = run.any_rows("compliance", task=task)
    return rows[rows["contender"] == f"{LAW}+{order}"]


def compare_orders(run: Run) -> Iterator[tuple]:
    """Return a row a task and order: its result, how many are at rest, and errors at the end."""
    for task in TASKS:
        for order in SELECTION_ORDERS:
            rows = of_order(run, task, order)
            words = task.replace("-", " "), MEASURES[task].title, name_order(order)
            yield *words, *describe_result(task, rows)


def describe_result(task: str, rows: pd.DataFrame) -> tuple[Any, ...]:
    """Return the cells of a task and order; "not tested" where the run lacks its rows."""
    if rows.empty:
        return (html.UNTESTED,) * (1 + len(RESULT_HEADS))
    at_rest = int((rows["rest"].astype(str) == "at-rest").sum())
    ends = [measure.of(rows) for measure in ENDS]
    return str(len(rows)), MEASURES[task].of(rows), f"{at_rest} of {len(rows)}", *ends


def describe_plates(run: Run) -> str:
    """Say how far the force on the plate is off at the end, by both orders."""
    parts = []
    for order in SELECTION_ORDERS:
        rows = of_order(run, TASKS[0], order)
        if rows.empty:
            return "How well each order presses on the plate is not tested"
        parts.append(f"{ENDS[0].of(rows)} N with the order “{name_order(order)}”")
    return f"At the end, the median error of the force on the plate is {join_words(parts)}"


def predict_errors() -> Iterator[tuple]:
    """Return a row an order: the errors of force and moment in both cases, on the plate."""
    task, arm = surface_alignment.TASK, tasks.arm(ARM)
    held = np.array(task.trials(arm)[0].specification.selection)
    Lambda = inertia_at(arm, surface_alignment.TIP)
    is_force = np.flatnonzero(held == 0) < 3
    for order in SELECTION_ORDERS:
        cells = []
        for case in CASES:
            error = exerted_error(order, case, Lambda, held.tolist(), ACCELERATION)
            cells.append(float(np.linalg.norm(error[is_force])))
            cells.append(float(np.linalg.norm(error[~is_force])))
        yield name_order(order), *cells
