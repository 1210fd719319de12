"""Advice: what closed forms refuse, what is outside the map, which laws are tried, and which of them is advised."""

import math

import numpy as np
import pandas as pd
import pytest

from bench.cli.advised import describe_least, table
from bench.experiments.situations import CROWD, mapped_laws
from bench.experiments.tables.statistics import quantile
from bench.findings.selection import advice as module
from bench.findings.selection.advice import (
    FIRST,
    HORIZON,
    LEAST,
    MOST,
    Trials,
    advise,
    answer,
    choose,
    find_least_time,
    list_tied,
    look_near_goal,
    shortlist,
)
from bench.findings.selection.checked import summarize_checked
from bench.findings.selection.nearest import find_outside
from bench.findings.selection.regions import RULE, Rule
from bench.findings.theory.time_optimal import certain_least_time
from bench.studies.advice_check import COUNT, SEED, draw
from tasks.situation import COORDINATES, KP, NOMINAL, Situation

BOUNDED = Situation(zeta=0.7, bound=0.075, delay=0.1, period=0.04)
"""README's own example."""


@pytest.mark.parametrize(
    "numbers",
    [
        {"zeta": 1.9, "delay": 0.243, "period": 0.486, "inertia": 0.672, "unevenness": 0.482},
        {"zeta": 0.99, "delay": 0.849, "period": 0.707},  # unstable, outside the map
        {"zeta": 0.025},  # too slow: 174/sqrt(kp) to 2 %
        {"bound": 0.001},  # no law can be there in time
    ],
)
def test_no_law_is_advised_nor_simulated_where_closed_forms_say_that_none_can_settle(numbers):
    found = advise(Situation(**numbers), report=pytest.fail)
    assert found.law is None
    assert found.rows is None
    assert found.near_goal.is_hopeless


@pytest.mark.parametrize("law", ["mrp-memory", "hybrid", "rotation-vector"])
def test_law_loses_every_start_where_its_loop_is_unstable(law):
    at = Situation(zeta=1.9, delay=0.243, period=0.486, inertia=0.672, unevenness=0.482)
    assert not np.isfinite(Trials(at).run(law, 64).times).any()


def test_least_time_from_rest_is_that_of_full_command_one_way_and_then_the_other():
    at = Situation(bound=0.2, inertia=2.0)
    starts = at.starts(FIRST, 7)
    angles = np.array([2.0 * math.acos(min(1.0, abs(start.quat_wxyz[0]))) for start in starts])
    to_stop = 2.0 * np.sqrt(angles / 0.1) * (math.sqrt(1.02) - math.sqrt(0.02))
    assert find_least_time(at, FIRST, 7) == pytest.approx(quantile(to_stop, CROWD), rel=2e-3)


def test_least_time_of_bodies_that_spin_lies_between_its_bound_and_the_times_of_laws():
    at = Situation(bound=0.3, spin=1.0)
    least = find_least_time(at, 256, 3)
    starts = at.starts(256, 3)
    angles = np.array([2.0 * math.acos(min(1.0, abs(start.quat_wxyz[0]))) for start in starts])
    certain = quantile(certain_least_time(angles, 1.0, 0.3), CROWD)
    assert certain < least < 3.0 * certain
    trials = Trials(at, 3)
    for law in ("hybrid", "mrp-memory"):
        assert quantile(trials.run(law, 256).times[:256], CROWD) > least


@pytest.mark.parametrize("numbers", [{}, {"bound": 0.2, "jump": 1.0}, {"bound": 0.2, "unevenness": 0.3}])
def test_least_time_is_unknown_without_a_bound_behind_a_jump_and_of_uneven_bodies(numbers):
    assert math.isnan(find_least_time(Situation(**numbers), 8, 0))


def test_advice_compares_its_law_with_the_fastest_motions():
    found = advise(BOUNDED)
    advised = found.row(found.law)
    # README's promise; no command has an effect before the delay has passed
    assert 1.0 < advised["time"] / (BOUNDED.delay + found.least) < 1.15
    assert advised["overshoot"] < 5.0
    assert found.row("hybrid")["time"] > 2.0 * found.least
    said = describe_least(found, 1.0)
    assert f"in {found.least:.3f} s; {found.law} takes " in said
    assert "over least" in table(found, 1.0)


def test_no_law_is_faster_than_the_least_time_of_its_bound():
    trials = Trials(BOUNDED)
    least = look_near_goal(BOUNDED).least
    for law in ("hybrid", "braking-cascade", "late-braking"):
        assert quantile(trials.run(law, 128).times, CROWD) > least > 0.0
    assert look_near_goal(BOUNDED._replace(spin=1.0)).least == 0.0
    assert look_near_goal(NOMINAL).least == 0.0


def test_numbers_outside_the_map_are_named_with_its_range():
    [outside] = find_outside(Situation(zeta=0.025))
    assert outside == ("zeta", 0.025, 0.5, 2.0)
    assert [number.name for number in find_outside(Situation(bound=0.01, period=0.005))] == ["bound", "period"]
    for name, coordinate in COORDINATES.items():
        for level in coordinate.levels:
            assert not find_outside(NOMINAL._replace(**{name: level}))
    # above the greatest finite bound of the map no law is cut
    assert not find_outside(Situation(bound=50.0))


def test_laws_that_are_tried_are_those_of_the_map_and_a_few_at_least():
    found = answer(NOMINAL)
    laws = shortlist(found, RULE)
    assert laws[0] == found.verdict.law
    assert found.verdict.unbeaten & set(laws)
    assert len(set(laws)) == len(laws) >= LEAST
    assert not {"late-braking"} & set(laws)


def test_trial_goes_on_from_the_same_starts():
    trials, whole = Trials(NOMINAL), Trials(NOMINAL)
    trials.run("mrp", 32)
    assert trials.run("mrp", 64).times.tolist() == whole.run("mrp", 64).times.tolist()
    assert trials.run("mrp", 16).times.shape == (64,)
    assert trials.run("hybrid", 64).trapped == 0 < trials.run("mrp").trapped


class MadeUp(Trials):
    """Laws whose times are given, by law, of MOST starts."""

    def __init__(self, times, stuck=()):
        super().__init__(NOMINAL)
        self.made, self.held = times, stuck

    def run(self, law, count=FIRST):
        zeros = np.zeros(count)
        drawn = {"time": self.made[law][:count], "turned_away": zeros, "peak": zeros, "effort": zeros}
        trial = module.LawTrial(
            self.known[law], self.at, {**drawn, "overshoot": zeros}, int(law in self.held), 0
        )
        self.by_law[law] = trial
        return trial


def spread_times(middle, seed=0):
    """Return times that differ by 20 % from start to start."""
    return middle * (1.0 + 0.2 * np.random.default_rng(seed).random(MOST))


def test_law_of_the_map_stays_unless_another_is_faster_start_by_start():
    base = spread_times(6.0)
    laws = ("mrp-memory", "hybrid")
    assert choose(MadeUp({"mrp-memory": base, "hybrid": 0.96 * base}), laws, RULE, "mrp-memory") == "mrp-memory"
    assert choose(MadeUp({"mrp-memory": base, "hybrid": 0.93 * base}), laws, RULE, "mrp-memory") == "hybrid"
    held = MadeUp({"mrp-memory": 0.5 * base, "hybrid": base}, stuck=("mrp-memory",))
    assert choose(held, laws, RULE, "mrp-memory") == "hybrid"


def test_law_that_loses_a_start_of_the_many_is_not_advised():
    base = spread_times(6.0)
    late = 0.5 * base
    late[FIRST + 7] = math.inf
    trials = MadeUp({"mrp-memory": late, "hybrid": base})
    assert choose(trials, ("mrp-memory", "hybrid"), RULE, "mrp-memory") == "hybrid"
    assert choose(MadeUp({"mrp-memory": late}), ("mrp-memory",), RULE, "mrp-memory") is None


def test_law_of_ours_is_never_chosen():
    base = spread_times(6.0)
    trials = MadeUp({"late-braking": 0.5 * base, "hybrid": base})
    assert choose(trials, ("late-braking", "hybrid"), RULE, None) == "hybrid"


def test_ties_are_laws_within_five_percent():
    rows = pd.DataFrame({"contender": ["a", "b", "c", "d"], "time": [1.0, 1.04, 1.06, 0.9]})
    assert list_tied(rows, ["d", "a", "b", "c"], "a") == ("d", "b")


def test_situation_between_those_of_the_map_is_simulated():
    at = Situation(zeta=0.71, bound=0.9, delay=0.03)
    found = advise(at)
    row = found.row(found.law)
    other = Trials(at, seed=5).run(found.law, MOST).row
    assert row["starts"] == MOST
    assert row["time"] == pytest.approx(other["time"], rel=0.05)
    assert found.law in found.qualified
    assert not found.is_whole


def test_rule_without_memory_advises_a_law_without_memory():
    found = advise(NOMINAL, Rule(forgetful=True))
    assert not mapped(found.law).regulator.memory


def mapped(name):
    [law] = [law for law in mapped_laws() if law.name == name]
    return law


def test_horizon_is_that_of_the_episodes():
    assert pytest.approx(5.0 * math.sqrt(KP)) == HORIZON


def test_draw_of_the_check_covers_the_map_and_has_unstable_loops():
    situations = draw(COUNT, SEED)
    assert len(set(situations)) == COUNT
    assert not any(find_outside(at) for at in situations)
    unstable = [at for at in situations if look_near_goal(at).radius >= 1.0]
    assert len(unstable) >= 5
    for name in COORDINATES:
        assert len({getattr(at, name) for at in situations}) > COUNT // 2


def test_shares_of_the_check_are_counted():
    rows = pd.DataFrame(
        {
            "radius": [0.9, 0.9, 1.2, 0.9],
            "advised": ["hybrid", "mrp-memory", "none", "hybrid"],
            "printed": [1.005, 2.0, math.inf, 1.0],
            "large": [1.0, 3.0, math.inf, 1.0],
            "best": ["mrp-memory", "mrp-memory", "none", "none"],
            "best_time": [1.0, 1.9, math.inf, math.inf],
        }
    )
    found = summarize_checked(rows)
    assert (found.of, found.possible, found.unstable, found.missed, found.wrong) == (4, 2, 1, 0, 1)
    assert found.within == pytest.approx(1 / 2)
    assert found.exact == pytest.approx(2 / 3)
