"""C25 on tables written for it: holds, holds with a correction, fails, and refuses what says nothing."""

import itertools
import math

import pandas as pd
import pytest
from support import tables
from support.tables import changed

from bench.control.contact_controller import FORMS, PAPERS_FORM
from bench.findings.claims.contact import FLOORS, PERFORMANCE
from bench.findings.claims.verdict import NoEvidence, Word

TASKS = {"surface-alignment": "z, about x and y", "peg-in-hole": "z, about x and y", "force-on-plane": "z"}
CONTROLLERS = (("hybrid-base", ""), ("hybrid", "zyx-euler"))
LARGE = {column: 100 * FLOORS[unit] for column, unit in PERFORMANCE.items()}
"""Numbers far above their floors."""


def rows():
    for task, arm, (controller, representation), form, beta in itertools.product(
        TASKS, ("puma560", "ur5e"), CONTROLLERS, FORMS, (0, 45, 75)
    ):
        is_off = representation and beta == 75 and "about" in TASKS[task]
        yield {
            **{"task": task, "arm": arm, "controller": controller, "representation": representation, "form": form},
            **{"pose": f"tilt 10, beta{beta:+d}", "complies": TASKS[task], "beta": math.radians(beta)},
            **{"outcome": "done", **LARGE, "alignment_error_rad": (3.0 if is_off else 1.0) * 0.1},
        }


@pytest.fixture
def table():
    """Where two turns comply Euler is three times off at 75 degrees, on both arms in every form."""
    free = {"task": "wrench-probe", "complies": "about x and y", "arm": "ur5e", "form": PAPERS_FORM, "pose": "beta+75"}
    free |= {"beta": math.radians(75), **dict.fromkeys(PERFORMANCE, math.nan)}
    probes = [
        {**free, "controller": one, "representation": coordinates, "outcome": "singular" if coordinates else "done"}
        for one, coordinates in CONTROLLERS
    ]
    probes += [{**one, "form": "inverse"} for one in probes]
    return pd.DataFrame([*rows(), *probes])


@pytest.fixture
def alike(table):
    """No pair parts."""
    return changed(table, euler(table, 75), alignment_error_rad=0.1)


def judged(frame):
    return tables.judged("C25", compliance=frame)


def euler(frame, beta, **words):
    chosen = (frame["representation"] == "zyx-euler") & (frame["beta"].round(6) == round(math.radians(beta), 6))
    for column, word in words.items():
        chosen &= frame[column] == word
    return chosen


def test_c25_holds_when_every_task_depends_on_the_jacobian(table):
    verdict = judged(table)
    assert verdict.word == Word.HOLDS
    assert verdict.rows == 54
    assert "2 of 2 tasks" in str(verdict.evidence)
    assert "Euler is the worse in 4 of 4." in str(verdict.evidence)
    assert "Euler is the worse in 8 of 8;" in str(verdict.evidence)


@pytest.mark.parametrize(
    ("kept", "says"),
    [
        (lambda table: table["task"] == "nothing", None),
        (lambda table: table["task"] == "wrench-probe", "with contact"),
        (lambda table: table["task"].isin(["force-on-plane", "wrench-probe"]), "two turns"),
        (lambda table: table["beta"] > 0.0, "peg-in-hole on puma560"),
        (lambda table: table["beta"] == 0.0, "peg-in-hole on puma560"),
        (lambda table: table["form"] == "inverse", "transpose"),
        (lambda table: table["form"] != "projected", "projected"),
    ],
)
def test_c25_is_refused_without_all_kinds_of_rows(table, kept, says):
    with pytest.raises(NoEvidence, match=says):
        judged(table[kept(table)])


def test_c25_fails_when_no_pair_parts(alike):
    assert judged(alike).word == Word.FAILS


@pytest.mark.parametrize("words", [{"task": "peg-in-hole"}, {"arm": "ur5e"}])
def test_c25_is_corrected_when_it_depends_on_task_or_arm(table, words):
    alike = changed(table, euler(table, 75, **words), alignment_error_rad=0.1)
    assert judged(alike).word == Word.CORRECTED


@pytest.mark.parametrize(("form", "word"), [(PAPERS_FORM, Word.FAILS), ("inverse", Word.HOLDS)])
def test_c25_is_decided_by_the_papers_force_control(table, form, word):
    alike = changed(table, euler(table, 75, form=form), alignment_error_rad=0.1)
    assert judged(alike).word == word
    others = Word.HOLDS if form == PAPERS_FORM else Word.CORRECTED
    assert f"By commanded accelerations, {others}:" in str(judged(alike).evidence)


def test_c25_takes_a_difference_with_straight_frames_for_dependence(table):
    straight = euler(table, 0, task="peg-in-hole", arm="ur5e", form=PAPERS_FORM)
    assert judged(changed(table, straight, outcome="saturated")).word == Word.HOLDS


@pytest.mark.parametrize(("factor", "word"), [(1.99, Word.FAILS), (2.01, Word.HOLDS), (1 / 2.01, Word.HOLDS)])
@pytest.mark.parametrize("column", PERFORMANCE)
def test_c25_parts_by_a_factor_of_two_in_any_number(alike, column, factor, word):
    off = euler(alike, 45) & alike["complies"].str.contains("about")
    number = factor * alike.loc[off, column]
    assert judged(changed(alike, off, **{column: number})).word == word


@pytest.mark.parametrize("column", PERFORMANCE)
def test_c25_compares_nothing_with_almost_nothing(alike, column):
    touching = alike["task"] != "wrench-probe"
    tiny = changed(alike, touching, **{column: 1e-9})
    tiny = changed(tiny, touching & euler(tiny, 75), **{column: 1.9 * FLOORS[PERFORMANCE[column]]})
    assert judged(tiny).word == Word.FAILS


def test_c25_takes_a_shallower_peg_for_the_worse(alike):
    shallow = euler(alike, 75) & alike["complies"].str.contains("about")
    deep = changed(alike, shallow, insertion_depth_m=3 * LARGE["insertion_depth_m"])
    shallow = changed(alike, shallow, insertion_depth_m=LARGE["insertion_depth_m"] / 3)
    assert "worse in 4 of 4." in str(judged(shallow).evidence)
    assert "worse in 0 of 4." in str(judged(deep).evidence)


@pytest.mark.parametrize("column", PERFORMANCE)
def test_c25_parts_where_only_one_has_a_number(alike, column):
    missing = euler(alike, 75) & alike["complies"].str.contains("about")
    assert judged(changed(alike, missing, **{column: math.nan})).word == Word.HOLDS
    nowhere = changed(alike, alike["task"] != "force-on-plane", **{column: math.nan})
    assert judged(nowhere).word == Word.FAILS


def test_c25_parts_by_outcome_and_says_who_failed(alike):
    turned = (alike["beta"] > 1.0) & alike["complies"].str.contains("about") & (alike["task"] != "wrench-probe")
    base = turned & (alike["controller"] == "hybrid-base")
    found = judged(changed(alike, base, outcome="diverged"))
    assert found.word == Word.HOLDS
    assert "worse in 0 of 4." in str(found.evidence)
    assert judged(changed(alike, turned, outcome="diverged")).word == Word.FAILS  # both fail alike: nothing to compare


def test_c25_leaves_tasks_with_fewer_turns_out(table):
    simple = changed(table, euler(table, 75, task="force-on-plane"), outcome="saturated")
    found = judged(simple)
    assert found.word == Word.HOLDS
    assert "Where fewer turns comply 2 of 6 pairs part" in str(found.evidence)
