"""The map of advice: its rows against new episodes, its rule against a second implementation, and `bench advise`."""

import math
import re
import shutil

import numpy as np
import pandas as pd
import pytest
from scipy.stats import binom
from support.command_line import bench, refused
from support.map_rule import map_verdicts

from bench.cli import advised
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.situations import mapped_laws, order_interval, rows, summarize
from bench.experiments.tables.run import Run
from bench.experiments.tables.schema import RESULTS
from bench.experiments.tables.store import read, write_table
from bench.findings.selection.advice import list_unmapped
from bench.findings.selection.nearest import answer
from bench.findings.selection.pairs import compare_laws, read_pairs
from bench.findings.selection.regions import (
    RULE,
    STUDY,
    Rule,
    decide,
    facts_of,
    meets,
    read_map,
    with_words,
)
from bench.findings.selection.sensitivity import bound_slower, count_rejected
from tasks.situation import COORDINATES, NOMINAL, Situation, read_situation

REFERENCE = RESULTS / "reference"
LAWS = sorted(read_map()["contender"].unique())
DRAWN = np.random.default_rng(7).permutation(sorted(read_map()["situation"].unique()))[:30].tolist()
RUN_AGAIN = [word for word in DRAWN if not read_situation(word).spin][:10]
"""Spinning bodies take ten times as many starts."""


@pytest.mark.parametrize("word", RUN_AGAIN[:5])
def test_advise_answers_a_situation_at_any_kp_as_its_rows_do(capsys, word):
    at, kp = read_situation(word), float(10 ** (1.0 + 2.0 * DRAWN.index(word) / len(DRAWN)))
    root = math.sqrt(kp)
    words = {"kp": kp, "kv": 2.0 * at.zeta * root, "delay": at.delay / root, "rate": root / at.period}
    words |= {"spin": at.spin * root, "inertia": at.inertia, "unevenness": at.unevenness}
    words |= {"jump": at.jump / root}
    words |= {"bound": at.bound * kp} if math.isfinite(at.bound) else {}
    said = bench(capsys, "advise", *(f"--{name}={value!r}" for name, value in words.items())).out
    law, unbeaten, *_ = map_verdicts()[tuple(at)]
    if law is None:
        assert "No law: " in said
        return
    assert "It is in the map." in said
    words_of_answer = r"Use ([\w-]+) \(\w+\): 99 % of the starts settle in ([\d.]+) s"
    advised, seconds = re.search(words_of_answer, " ".join(said.split())).groups()
    # The starts are others than the map's.
    assert advised in unbeaten or f"In your situation {law}, the law of the map," in " ".join(said.split())
    row = read_map()[(read_map()["situation"] == word) & (read_map()["contender"] == advised)].iloc[0]
    assert float(seconds) * root == pytest.approx(row["time"], rel=0.05)


@pytest.mark.parametrize("word", RUN_AGAIN)
def test_rows_of_the_map_are_those_of_episodes_run_again(word):
    starts = pd.concat([rows(Request("situations"), Unit("situations", law, selector=word)) for law in LAWS])
    made = with_words(summarize(starts)).set_index("contender")
    kept = read_map()[read_map()["situation"] == word].set_index("contender").loc[made.index]
    counts = ["starts", "lost", "stuck", "trapped", "unwound", "operations"]
    assert made[counts].equals(kept[counts].astype(made[counts].dtypes))
    assert made["time"].to_numpy() == pytest.approx(kept["time"].to_numpy(), abs=0.02)
    assert made["overshoot"].to_numpy() == pytest.approx(kept["overshoot"].to_numpy(), abs=0.05)
    pairs = compare_laws(starts)
    assert decide(made.reset_index(), pairs=pairs).law == map_verdicts()[tuple(read_situation(word))][0]
    both = pairs.merge(read_pairs(STUDY).get(word, pairs.iloc[:0]), on=["law", "other"], suffixes=("", "_kept"))
    assert len(both) == len(pairs)
    finite = both[np.isfinite(both["error"]) & np.isfinite(both["error_kept"])]
    assert finite["log_ratio"].to_numpy() == pytest.approx(finite["log_ratio_kept"].to_numpy(), abs=0.005)


def test_map_has_every_law_of_the_reference_in_every_situation():
    known = {one.name for one in mapped_laws()}
    in_reference = set(Run(REFERENCE).table("costs")["contender"].astype(str))
    assert known & in_reference <= set(LAWS) <= known
    # A law that is newer than both is named.
    assert set(list_unmapped()) == known - set(LAWS)
    assert not read_map().duplicated(["contender", "situation"]).any()
    assert len(read_map()) == len(LAWS) * read_map()["situation"].nunique()


def test_law_that_a_map_lacks_is_named_with_the_cure(tmp_path):
    rows = read(STUDY, "situations")
    write_table(tmp_path / "situations.parquet", rows[rows["regulator"] != "hybrid"], "situations")
    shutil.copy(STUDY / "provenance.json", tmp_path)
    assert set(list_unmapped(tmp_path)) == {"hybrid", *list_unmapped()}
    said = advised._describe_unmapped(["hybrid"])
    assert said.startswith("Not in the map yet: hybrid; --run simulates every law")


def test_map_has_a_pair_for_every_two_laws_of_which_one_settles():
    for word, own in read_map().groupby("situation", observed=True):
        settling, never = np.isfinite(own["time"]).sum(), (~np.isfinite(own["time"])).sum()
        # Of laws with fewer common starts the time over these may be finite where that over all is not.
        pairs = len(read_pairs(STUDY).get(word, ()))
        assert pairs >= settling * (settling - 1) // 2 + settling * never
        assert pairs <= len(own) * (len(own) - 1) // 2


def test_intervals_of_pairs_hold_their_ratios():
    for pairs in read_pairs(STUDY).values():
        assert (pairs["low"] <= pairs["log_ratio"]).all()
        assert (pairs["log_ratio"] <= pairs["high"]).all()
        assert (pairs["law"] < pairs["other"]).all()


def test_linear_law_settles_as_the_linear_system_does():
    # (1 + t) exp(-t) = 0.02 for a double pole at -1: t = 5.8339
    [own] = read_map().query("contender == 'rotation-vector' and situation == @NOMINAL.word").to_dict("records")
    assert own["time"] == pytest.approx(5.8339, abs=0.011)
    assert own["peak"] == pytest.approx(math.pi, abs=0.01)


def test_rule_that_is_changed_changes_the_advice_as_it_says():
    own = read_map()[read_map()["situation"] == NOMINAL.word]
    assert facts_of(decide(own, Rule(forgetful=True)).law).memory == 0
    assert facts_of(decide(own, Rule(continuous=True)).law).is_continuous
    pairs = read_pairs(STUDY)[NOMINAL.word]
    assert decide(own, Rule(tie=0.5), pairs).unbeaten > decide(own, RULE, pairs).unbeaten
    assert not any(facts_of(law).is_ours for law in decide(own).unbeaten)
    assert decide(own.assign(lost=1)).law is None


def test_interval_of_a_quantile_covers_it_as_often_as_it_says():
    low, high = order_interval(512, 0.99)
    # the quantile lies between two ordered values if as many lie below it
    covered = binom.cdf(high, 512, 0.99) - binom.cdf(low, 512, 0.99)
    assert 0.95 <= covered < 0.99


def test_nearest_situation_answers_what_lies_between():
    found = answer(Situation(zeta=0.71, bound=0.21, delay=0.003))
    assert (found.at.zeta, found.at.bound) == (0.7, 0.2)
    assert found.distance > 0.0


def test_coordinates_are_scaled_to_the_unit_interval():
    for one in COORDINATES.values():
        places = [one.scale(level) for level in one.levels]
        assert (min(places), sorted(places)) == (0.0, places)
        assert max(place for place, level in zip(places, one.levels, strict=True) if math.isfinite(level)) == 1.0


def test_holm_rejects_step_by_step():
    # 0.01 <= 0.05/4, 0.013 <= 0.05/3, 0.03 > 0.05/2: the third and all after it are kept
    assert count_rejected(np.array([0.04, 0.01, 0.03, 0.013])) == 2
    assert count_rejected(np.array([0.01])) == 1


def test_slowest_of_59_starts_is_exceeded_by_5_percent_at_most():
    assert bound_slower(59) == pytest.approx(0.05, abs=1e-3)


@pytest.mark.parametrize(
    ("words", "named"),
    [
        (("--delay", "5 minutes"), "5ms"),
        (("--kp", "-1"), "kp"),
        (("--unevenness", "0.7"), "0.5"),
        (("--kp", "nan"), "kp"),
        (("--spin", "inf"), "spin"),
        (("--unevenness", "nan"), "unevenness"),
        (("--robot", "x"), "torque"),
    ],
)
def test_number_that_cannot_be_is_refused_with_the_cure(capsys, words, named):
    assert named in refused(capsys, "advise", *words)


@pytest.mark.parametrize("robot", ["velocity", "position"])
def test_robot_that_takes_no_torque_is_advised_by_the_reference(capsys, robot):
    said = bench(capsys, "advise", "--robot", robot)
    assert said.code == 0
    assert said.out.startswith("Which law    Use ")


def test_simulating_every_law_gives_the_answer_of_the_shortlist(capsys):
    shortlist, whole = (bench(capsys, "advise", "--kv", "14", *more).out for more in ((), ("--run",)))
    laws = [re.search(r"Use ([\w-]+) \(\w+\): ", said)[1] for said in (shortlist, whole)]
    assert laws[0] == laws[1]
    assert f"All {len(LAWS) + len(list_unmapped())} laws were simulated now" in whole


def plant(law, overshoot, **others):
    """Return a row of a map that meets every requirement but, maybe, that of the overshoot."""
    row = {"contender": law, "situation": "a", "overshoot": overshoot, "time": 5.0}
    return row | dict.fromkeys(("lost", "stuck", "unwound", "trapped"), 0) | others


def test_law_overshoots_too_much_beside_the_least_of_the_published_laws_that_meet_the_rest():
    rows = pd.DataFrame(
        [
            plant("hybrid", 10.0),
            plant("mrp-memory", 15.0),
            plant("rotation-vector-memory", 15.1),
            # the least, but of a law that loses starts, and of one of ours
            plant("sliding-memory", 0.0, lost=1),
            plant("late-braking", 1.0),
        ]
    )
    assert meets(rows).tolist() == [True, True, False, False, True]
    assert meets(rows, Rule(overshoot=4.0)).tolist() == [True, False, False, False, True]
    assert meets(rows, Rule(overshoot=math.inf)).tolist() == [True, True, True, False, True]


def test_overshoot_is_compared_within_one_situation():
    rows = pd.DataFrame([plant("hybrid", 0.0), plant("mrp-memory", 50.0) | {"situation": "b"}])
    assert meets(rows).tolist() == [True, True]


def test_nothing_overshoots_where_no_published_law_meets_the_rest():
    rows = pd.DataFrame([plant("hybrid", 90.0, lost=1), plant("late-braking", 90.0)])
    assert meets(rows).tolist() == [False, True]
