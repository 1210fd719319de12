"""The section on the order of selection: what it shows of rows that are there, and of a run that lacks them."""

import pandas as pd
import pytest
from support.pages import RUN

from report.figures.contact import selection_orders

FIRST, SECOND = "hybrid-base+selected-then-decoupled", "hybrid-base+decoupled-then-selected"
NARROW = "\N{NO-BREAK SPACE}"


class Made:
    """A run that holds made-up rows."""

    def __init__(self, rows):
        self.frame = pd.DataFrame(rows)

    def any_rows(self, table, task):
        assert table == "compliance"
        return self.frame[self.frame["task"] == task]


def episode(task, contender, force, rest="at-rest", **measured):
    """A made-up row."""
    blank = {"alignment_error_rad": None, "crank_angle_rad": None, "jam": None}
    ends = {"force_error_end_n": force, "moment_error_end_nm": force / 10.0}
    return {"task": task, "contender": contender, "rest": rest, **blank, **ends, **measured}


ROWS = [
    episode("surface-alignment", FIRST, 1.0, alignment_error_rad=0.5),
    episode("surface-alignment", FIRST, 3.0, rest="creeping", alignment_error_rad=0.1),
    episode("surface-alignment", FIRST, 2.0, alignment_error_rad=0.1),
    episode("surface-alignment", SECOND, 0.25, alignment_error_rad=0.0),
    episode("crank", FIRST, 0.5, crank_angle_rad=1.0),
    episode("surface-alignment", "hybrid-base+transpose", 9.0, alignment_error_rad=0.0),
]


def lines_of(run) -> list[list[str]]:
    table = str(selection_orders.facts(run)["tasks"]).replace(NARROW, " ")
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in table.splitlines()[2:]]


def test_a_row_a_task_and_order_has_medians_and_says_what_was_not_tested():
    lines = lines_of(Made(ROWS))
    assert len(lines) == len(selection_orders.TASKS) * 2
    assert lines[0][0] == "surface alignment"
    assert lines[0][2:] == ["selected, then decoupled", "3", "5.7", "2 of 3", "2", "0.2"]
    assert lines[1][2:] == ["decoupled, then selected", "1", "0", "1 of 1", "0.25", "0.025"]
    assert lines[2][2:] == ["selected, then decoupled", "1", "57", "1 of 1", "0.5", "0.05"]
    for line in lines[3:]:
        assert line[3:] == ["not tested"] * 5


def test_finding_is_about_the_plate_and_both_orders():
    found = selection_orders.describe_plates(Made(ROWS))
    assert found == (
        "At the end, the median error of the force on the plate is 2 N with the order “selected, then decoupled” "
        "and 0.25 N with the order “decoupled, then selected”"
    )
    lacks = selection_orders.describe_plates(Made([row for row in ROWS if row["contender"] != SECOND]))
    assert lacks == "How well each order presses on the plate is not tested"


def test_a_run_of_before_has_a_table_that_says_not_tested():
    """The published run without the rows of both orders, and without the columns of the errors at the end."""
    rows = RUN.table("compliance")
    rows = rows[~rows["form"].isin(selection_orders.SELECTION_ORDERS)]
    older = Made(rows.drop(columns=["force_error_end_n", "moment_error_end_nm"], errors="ignore"))
    assert {cell for line in lines_of(older) for cell in line[3:]} == {"not tested"}


def test_theory_has_an_error_in_one_case_for_each_order_of_the_same_size():
    (_, *first), (_, *second) = selection_orders.predict_errors()
    assert first[:2] == second[2:] == [0.0, 0.0]
    assert first[2:] == pytest.approx(second[:2])
    assert min(first[2:]) > 0.01
