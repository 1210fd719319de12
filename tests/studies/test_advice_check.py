"""The advice between the situations of the map: the shares of the stored rows, and one row made again."""

import math

import pytest

from bench.findings.selection.advice import look_near_goal
from bench.findings.selection.checked import read_checked, summarize_checked
from bench.findings.selection.nearest import find_outside
from bench.studies.advice_check import COUNT, SEED, check, draw
from tasks.situation import read_situation


def test_rows_are_those_of_the_published_draw():
    assert read_checked()["situation"].tolist() == [at.word for at in draw(COUNT, SEED)]


def test_advice_is_nearly_the_best_and_its_time_is_true():
    found = summarize_checked(read_checked())
    assert found.of == COUNT
    assert found.within >= 0.85
    assert found.exact >= 0.95


def test_no_law_is_advised_where_simulating_all_laws_finds_none():
    assert summarize_checked(read_checked()).wrong == 0


def test_no_law_settles_where_closed_forms_say_that_none_can():
    rows = read_checked()
    for row in rows.to_dict("records"):
        near_goal = look_near_goal(read_situation(row["situation"]))
        assert near_goal.radius == pytest.approx(row["radius"], rel=1e-6)
        assert near_goal.is_hopeless == row["hopeless"]
        assert not find_outside(read_situation(row["situation"]))
    hopeless = rows[rows["hopeless"] == 1]
    assert (hopeless["advised"] == "none").all()
    assert len(rows[rows["radius"] >= 1.0]) >= 5
    assert (rows.loc[rows["radius"] >= 1.0, "best"] == "none").all()


def test_row_is_what_the_code_makes_now():
    rows = read_checked()
    quick = rows[rows["advised"] != "none"].sort_values("cpu").iloc[0]
    made = check(read_situation(quick["situation"]))
    assert (made["advised"], made["best"], made["qualified"]) == (quick["advised"], quick["best"], quick["qualified"])
    assert made["printed"] == pytest.approx(quick["printed"], rel=2e-3)
    assert math.isfinite(made["large"])
