"""What the report and the claims read: rows named as the command line names their contenders."""

import pandas as pd

from bench.cli.details import contact
from bench.cli.details.episodes import outcome_table, summarize_laws
from bench.experiments.tables import read
from bench.law.control.registry import find_controller

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
    assert list(read.with_contender(LAWS)["contender"]) == NAMES


def test_contender_of_a_table_of_times_is_the_law():
    assert list(read.with_contender(LAWS[["regulator", "representation"]])["contender"])[2] == NAMES[2].split("@")[0]


def test_free_body_has_no_jacobian():
    assert list(read.chosen(LAWS, read.FREE_BODY)["regulator"]) == ["rotation-matrix", "feedback-linearized"]


def test_summary_keeps_a_law_on_an_arm_apart():
    assert list(summarize_laws(LAWS)["law"]) == NAMES
    assert list(summarize_laws(LAWS)["worst s"]) == ["1.000", "2.000", "never"]


def test_outcomes_keep_a_law_on_an_arm_apart():
    table = outcome_table(LAWS).set_index("law")
    assert (table.at[NAMES[2], "diverged"], table.at[NAMES[1], "diverged"]) == (1, 0)


IN_CONTACT = pd.DataFrame(
    {
        "controller": ["hybrid-base", "hybrid", "hybrid", "hybrid", "impedance-geometric"],
        "representation": ["", "zyx-euler", "zyx-euler", "zyx-euler", ""],
        "form": ["inverse", "projected", "projected", "projected", ""],
        "outcome": ["done", "done", "done", "singular", "done"],
        "rest": ["", "at-rest", "creeping", "", ""],
        "leakage_ratio": [0.0, 1.0, 3.0, 50.0, float("nan")],
        "misalignment_rad": [0.0, 0.5, 1.0, float("nan"), 0.0],
        "alignment_error_rad": float("nan"),
    }
)
CONTROLLERS = ["hybrid-base+inverse", "hybrid/zyx-euler+projected", "impedance-geometric"]


def test_contender_in_contact_is_the_word_of_the_command_line():
    names = read.with_controller(IN_CONTACT)["contender"]
    assert list(names.drop_duplicates()) == CONTROLLERS
    assert [find_controller(name).name for name in CONTROLLERS] == CONTROLLERS


def test_summary_in_contact_is_of_the_poses_that_are_done():
    table = contact.summary(IN_CONTACT).set_index("controller")
    assert list(table.index) == CONTROLLERS
    assert list(table["done"]) == ["1/1", "2/3", "1/1"]
    assert table["at rest"].str.endswith(("0/0", "1/2")).all()
    assert (table["at rest"] == "1/2").sum() == 1
    assert list(table["leakage"]) == ["0.000  0.000", "2.000  3.000", ""]
    assert table.at[CONTROLLERS[1], "misaligned deg"] == "42.972  57.296"
    assert set(table["off the plate deg"]) == {""}
