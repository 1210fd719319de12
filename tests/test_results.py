"""What the report and the claims read: rows named as the command line names their contenders."""

import pandas as pd

from bench import results
from bench.cli.show import outcome_table, summary

LAWS = pd.DataFrame(
    {
        "regulator": ["rotation-matrix", "feedback-linearized", "feedback-linearized"],
        "representation": ["", "mrp", "zyx-euler"],
        "jacobian": ["", "", "analytic"],
        "inverse": ["", "", "solve"],
        "start_set": "uniform",
        "outcome": ["settled", "settled", "diverged"],
        "settling_time_s": [1.0, 2.0, float("nan")],
    }
)
NAMES = ["rotation-matrix", "feedback-linearized/mrp", "feedback-linearized/zyx-euler@analytic+solve"]


def test_contender_is_the_word_of_the_command_line():
    assert list(results.with_contender(LAWS)["contender"]) == NAMES


def test_contender_of_a_table_of_times_is_the_law():
    assert list(results.with_contender(LAWS[["regulator", "representation"]])["contender"])[2] == NAMES[2].split("@")[0]


def test_free_body_has_no_jacobian():
    assert list(results.chosen(LAWS, results.FREE_BODY)["regulator"]) == ["rotation-matrix", "feedback-linearized"]


def test_summary_keeps_a_law_on_an_arm_apart():
    assert list(summary(LAWS)["law"]) == NAMES
    assert list(summary(LAWS)["worst s"]) == ["1.000", "2.000", "never"]


def test_outcomes_keep_a_law_on_an_arm_apart():
    table = outcome_table(LAWS).set_index("law")
    assert (table.at[NAMES[2], "diverged"], table.at[NAMES[1], "diverged"]) == (1, 0)
