"""C18 and C19 on tables written for them: they hold, hold with a correction, fail, and refuse what says nothing."""

import math

import numpy as np
import pandas as pd
import pytest
from support import tables

from bench.findings.claims.euler_jacobian import EPS, WELL_CONDITIONED
from bench.findings.claims.verdict import NoEvidence, Word


def row(arm, pose_set, pose_id, margin, **cells):
    """A pose whose Jacobian is as theory has it: cond J is 8, that of J_E up to 16/cos(beta)."""
    exact = {
        "arm": arm,
        "pose_set": pose_set,
        "pose_id": pose_id,
        "representation": "zyx-euler",
        "margin": margin,
        "condition": 8.0,
        "condition_analytic": 8.0 * (1 + math.sqrt(1 - margin**2)) / margin,
        "largest": 1 / margin,
        "det_gap": EPS,
        "derivation_gap": EPS,
        "difference_gap": 1e-11 / margin,
    }
    return exact | cells


@pytest.fixture
def table():
    """Two arms, of each two families towards the pole, ten poses at random and four of a slice."""
    rows = []
    for arm in ("six", "seven"):
        own = {"det_gap": math.nan} if arm == "seven" else {}
        for name in ("0-plus", "1-minus"):
            distances = [(f"1e-{k:02d}", math.sin(10.0**-k)) for k in range(1, 13)] + [("exact", 1e-16)]
            rows += [row(arm, "pole", f"{name}-{text}", margin, **own) for text, margin in distances]
        rows += [row(arm, "random", f"{i:04d}", margin, **own) for i, margin in enumerate(np.linspace(0.05, 1, 10))]
        rows += [row(arm, "slice", f"q2-q5-{i:02d}-00", 0.5, difference_gap=math.nan, **own) for i in range(4)]
    return pd.DataFrame(rows)


def judged(id, frame):
    return tables.judged(id, poses=frame)


def near(frame):
    """The poses from 10^-4 on towards the pole."""
    return (frame["pose_set"] == "pole") & (frame["margin"] < 2e-4)


def of_one_family(rows, frame):
    return rows & frame["pose_id"].str.startswith("1-minus")


@pytest.mark.parametrize(("id", "word"), [("C18", Word.CORRECTED), ("C19", Word.HOLDS)])
def test_claim_is_decided_on_the_theory(table, id, word):
    assert tables.decided(judged(id, table), word)


def test_c18_holds_where_the_matrix_itself_is_zero_somewhere(table):
    first = (table["arm"] == "six") & (table["pose_set"] == "random")
    assert judged("C18", table.assign(largest=table["largest"].where(~first, 0.0))).word == Word.HOLDS


@pytest.mark.parametrize("id", ["C18", "C19"])
def test_claim_is_refused_without_rows(table, id):
    with pytest.raises(NoEvidence):
        judged(id, table.iloc[:0])


@pytest.mark.parametrize("id", ["C18", "C19"])
def test_other_coordinates_are_not_looked_at(table, id):
    other = table.assign(representation="mrp", condition_analytic=8.0, largest=1.0, det_gap=1.0, derivation_gap=1.0)
    assert str(judged(id, pd.concat([table, other])).evidence) == str(judged(id, table).evidence)


@pytest.mark.parametrize(
    ("edit", "word"),
    [
        (lambda table: {"condition_analytic": 8.0, "largest": 1.0}, Word.FAILS),
        (lambda table: {"largest": table["largest"].where(~of_one_family(near(table), table), 1e2)}, Word.FAILS),
        (lambda table: {name: table[name] ** 0.8 for name in ("condition_analytic", "largest")}, Word.FAILS),
        (lambda table: {"largest": table["largest"] / 1e3}, Word.FAILS),
        (lambda table: {"det_gap": table["det_gap"] * 50 / table["margin"]}, Word.CORRECTED),
    ],
    ids=["nothing grows", "one family stops", "growth of another order", "below the bound", "rounding over the margin"],
)
def test_c18_follows_the_table(table, edit, word):
    assert judged("C18", table.assign(**edit(table))).word == word


@pytest.mark.parametrize(("gap", "word"), [(1e-17, Word.CORRECTED), (1e-12, Word.FAILS)])
def test_c18_looks_at_the_determinant(table, gap, word):
    off = (table["arm"] == "six") & (table["pose_set"] == "random")
    assert judged("C18", table.assign(det_gap=table["det_gap"].where(~off, gap))).word == word


def test_c18_leaves_out_families_where_the_arm_is_to_blame(table):
    bent = table["pose_id"].str.startswith("1-minus")
    spoilt = table.assign(largest=table["largest"].where(~bent, 1.0))
    assert judged("C18", spoilt).word == Word.FAILS
    to_blame = spoilt.assign(condition=spoilt["condition"].where(~bent, 2 * WELL_CONDITIONED))
    verdict = judged("C18", to_blame)
    assert verdict.word == Word.CORRECTED
    assert str(verdict.evidence).startswith("2 families on ")


def test_c18_is_refused_when_an_arm_has_no_family(table):
    with pytest.raises(NoEvidence, match="seven"):
        judged("C18", table[(table["arm"] == "six") | (table["pose_set"] != "pole")])


def test_c18_is_refused_when_no_arm_has_a_determinant(table):
    with pytest.raises(NoEvidence, match="six joints"):
        judged("C18", table.assign(det_gap=math.nan))


def test_c18_takes_a_family_that_misses_a_distance_for_none(table):
    missing = (table["arm"] == "six") & (table["pose_id"] == "0-plus-1e-05")
    assert str(judged("C18", table[~missing]).evidence).startswith("3 families on ")


@pytest.mark.parametrize("gap", ["derivation_gap", "difference_gap"])
@pytest.mark.parametrize(("margins", "word"), [((1e-6, 1e-3), Word.CORRECTED), ((1e-3, 1.0), Word.FAILS)])
def test_c19_looks_at_both_gaps_where_they_are(table, gap, margins, word):
    at = (table["margin"] > margins[0]) & (table["margin"] < margins[1]) & table[gap].notna()
    assert judged("C19", table.assign(**{gap: table[gap].where(~at, 0.1)})).word == word


@pytest.mark.parametrize("gap", ["derivation_gap", "difference_gap"])
def test_c19_does_not_look_closer_than_it_says(table, gap):
    there = table["margin"] < 0.9e-6
    assert judged("C19", table.assign(**{gap: table[gap].where(~there, 0.1)})).word == Word.HOLDS


@pytest.mark.parametrize("gap", ["derivation_gap", "difference_gap"])
def test_c19_is_refused_when_an_arm_has_no_gap(table, gap):
    with pytest.raises(NoEvidence, match=f"{gap}.*seven"):
        judged("C19", table.assign(**{gap: table[gap].where(table["arm"] == "six")}))


def test_c19_takes_a_derivation_that_is_no_number_for_a_failure(table):
    at = table["pose_id"] == "0003"
    verdict = judged("C19", table.assign(derivation_gap=table["derivation_gap"].where(~at)))
    assert verdict.word == Word.FAILS


def test_c19_counts_the_jumps_it_leaves_out(table):
    at = table["pose_id"] == "0003"
    verdict = judged("C19", table.assign(difference_gap=table["difference_gap"].where(~at)))
    assert verdict.word == Word.HOLDS
    assert str(verdict.evidence).endswith("a difference: 2.")
