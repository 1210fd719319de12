"""Which law for what a robot takes: the map's rule on made-up rows, and on rows of the reference."""

import functools
import math

import numpy as np
import pandas as pd
import pytest
from support.advised import velocities
from support.user_law import spring_text

from bench.base.errors import NoEvidence
from bench.experiments.experiment import Unit, rows_of
from bench.experiments.request import Request
from bench.experiments.tables.run import Run, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings.selection.jump import jump
from bench.findings.selection.pairs import compare_shares, compare_times
from bench.findings.selection.regions import FACTS, Facts, decide, find_facts
from bench.findings.selection.robots import (
    OF_ARMS,
    OF_FIRST_ORDER,
    ROBOTS,
    VELOCITY,
    compare_for,
    decide_for,
)
from bench.findings.selection.run_rows import (
    OF_RUN,
    Compared,
    compare_arms,
    compare_positions,
    compare_velocities,
    keep_whole,
    tabulate_pairs,
)
from bench.findings.selection.tables import ticks
from bench.findings.selection.words import compare, describe_lacks, together
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender

CHEAP, MIDDLE, DEAR, OURS = "quaternion-shortest", "mrp", "hybrid", "late-braking"
"""The simplest first: the third has memory, and the last is ours."""

OPERATIONS = {CHEAP: 60, MIDDLE: 70, DEAR: 50, OURS: 10}


def made_up(values, by="time", **columns):
    """Laws with these values of each start; columns: of each law, what the requirements count."""
    laws = list(values)
    numbers = {"lost": 0.0, "stuck": 0.0, "unwound": 0.0, "trapped": 0.0, "overshoot": 0.0} | columns
    rows = pd.DataFrame({"contender": laws, "situation": OF_RUN, **numbers})
    rows["operations"] = [OPERATIONS[law] for law in laws]
    rows[by] = [np.max(own) if by == "time" else np.mean(own) for own in values.values()]
    rows[FACTS] = [find_facts(find_contender(law)) for law in laws]
    pairs = compare_times(values) if by == "time" else compare_shares(values)
    return Compared(None, rows, tabulate_pairs(pairs))


def of_times(*times):
    """Times of twenty starts each that a law needs as long for, in the order of the laws."""
    return {law: np.full(20, time) for law, time in zip(OPERATIONS, times, strict=False)}


@pytest.mark.parametrize(
    ("times", "law", "tied"),
    [
        ((3.0, 1.0, 2.0), MIDDLE, ()),
        ((1.04, 1.0, 2.0), CHEAP, (MIDDLE,)),  # within 5 % the simplest
        ((1.06, 1.0, 2.0), MIDDLE, ()),
        ((3.0, 1.0, 1.0), MIDDLE, (DEAR,)),  # no memory before fewer operations
        ((3.0, 1.0, 1.0, 0.5), MIDDLE, (DEAR,)),  # ours is faster, and not advised
    ],
)
def test_law_that_nothing_beats_and_is_simplest_is_advised(times, law, tied):
    compared = made_up(of_times(*times))
    verdict = decide(compared.rows, OF_FIRST_ORDER, compared.pairs)
    assert (verdict.law, verdict.tied) == (law, tied)
    assert verdict.faster == ((OURS,) if len(times) == 4 else ())


@pytest.mark.parametrize("column", ["lost", "stuck", "unwound"])
def test_law_that_fails_a_requirement_is_not_eligible(column):
    values = of_times(1.0, 2.0, 3.0)
    compared = made_up(values, **{column: [1.0, 0.0, 0.0]})
    verdict = decide(compared.rows, OF_FIRST_ORDER, compared.pairs)
    assert (verdict.law, verdict.eligible) == (MIDDLE, 2)


def test_overshoot_counts_for_arms_and_was_not_measured_of_first_order_laws():
    compared = made_up(of_times(1.0, 2.0, 3.0), overshoot=[5.5, 0.0, 0.0])
    assert decide(compared.rows, pairs=compared.pairs).law == MIDDLE
    assert decide(compared.rows.drop(columns="overshoot"), OF_FIRST_ORDER, compared.pairs).law == CHEAP


def test_on_arms_the_share_of_missed_turns_decides_if_it_is_not_by_chance():
    often, rarely = np.array([1.0] * 20 + [0.0] * 20), np.array([1.0] * 10 + [0.0] * 30)
    nearly = np.array([1.0] * 19 + [0.0] * 21)
    apart = made_up({CHEAP: often, MIDDLE: rarely}, by="missed")
    assert decide(apart.rows, OF_ARMS, apart.pairs).law == MIDDLE
    one_start = made_up({CHEAP: often, MIDDLE: nearly}, by="missed")
    assert decide(one_start.rows, OF_ARMS, one_start.pairs).law == CHEAP


def test_law_with_fewer_starts_than_another_is_left_out():
    rows = pd.DataFrame({"contender": ["a", "a", "b"], "start_id": ["x", "y", "x"]})
    assert set(keep_whole(rows)["contender"]) == {"a"}


def test_comparison_says_who_is_faster_and_what_the_law_lacks():
    compared = made_up(of_times(1.0, 2.0, 2.01), unwound=[3.0, 0.0, 0.0], overshoot=[0.0, 7.0, 0.0])
    assert compare(compared, CHEAP, MIDDLE) == (
        f"99 % of the uniform starts settle within 1.000 s with {CHEAP} and within 2.000 s with {MIDDLE}; by our "
        f"rule, {CHEAP} is faster. {CHEAP} lacks what we require: it turns the long way from 3 uniform starts."
    )
    assert f"{MIDDLE} is slower. {MIDDLE} lacks what we require: it overshoots by 7°" in compare(
        compared, MIDDLE, CHEAP
    )
    assert f"the two laws tie. {DEAR} meets our requirements here." in compare(compared, DEAR, MIDDLE)


def test_comparison_of_a_law_that_never_settles_says_so():
    compared = made_up(of_times(math.inf, 2.0), lost=[20.0, 0.0])
    said = compare(compared, CHEAP, MIDDLE)
    assert f"within no time that was simulated with {CHEAP}" in said
    assert f"by our rule, {CHEAP} is slower. {CHEAP} lacks what we require: it does not settle from 20 uniform" in said


def test_noise_that_was_not_tried_is_said():
    compared = made_up(of_times(1.0, 2.0), trapped=[math.nan, 4.0])
    assert describe_lacks(compared, MIDDLE).endswith("it is trapped at 180° by a sensor error in 4 episodes.")
    assert describe_lacks(compared, CHEAP) == f"{CHEAP} lacks what we require: it was not tried with noise at 180°."


def test_share_of_a_law_is_its_time_over_the_median_whole_controller():
    usual = {"representation": "", "jacobian": "", "inverse": "", "arm": "", "engine": "", "ticks": 10}
    whole = usual | {"what": "controller", "regulator": "rotation-matrix", "jacobian": "geometric", "inverse": "solve"}
    rows = [
        usual | {"what": "law", "regulator": "mrp", "ratio": 1.0},
        usual | {"what": "law", "regulator": "gibbs", "ratio": 4.0, "ticks": 0},
        *(whole | {"arm": arm, "ratio": ratio} for arm, ratio in zip("abc", (40.0, 50.0, 90.0), strict=True)),
        whole | {"regulator": "mrp", "arm": "a", "ratio": 1000.0},
    ]
    assert ticks(Run(None, {"timings": pd.DataFrame(rows)})) == {"mrp": 2.0}
    assert ticks(Run(None, {"timings": pd.DataFrame(rows[:2])})) == {}


def test_names_that_are_many_are_counted():
    assert [together(list("abcde"[:count])) for count in range(1, 6)] == [
        "a",
        "a and b",
        "a, b and c",
        "a, b, c and d",
        "a, b, c and 2 more",
    ]


@pytest.mark.parametrize(
    ("law", "least", "most"),
    [
        ("rotation-matrix", 0.0, 1e-5),
        ("quaternion-shortest", 3.999, 4.001),
        ("rotation-vector", 2 * math.pi - 1e-3, 2 * math.pi + 1e-3),
        ("gibbs", 1e3, math.inf),
        ("hybrid", 0.0, 1e-5),
    ],
)
def test_jump_at_a_half_turn_is_twice_the_spring_there(law, least, most):
    assert least <= jump(find_contender(law)) <= most


def test_jump_of_a_law_on_coordinates_or_of_a_users_is_not_judged_by_half_turns(tmp_path):
    assert math.isnan(jump(find_contender("feedback-linearized/zyx-euler")))
    (tmp_path / "mine.py").write_text(spring_text("return (-x, -y, -z)"))
    [mine] = contenders_of(described(tmp_path / "mine.py"))
    assert math.isnan(jump(mine))
    assert find_facts(mine) == Facts(memory=0, is_continuous=False, is_ours=False)


REFERENCE = RESULTS / "reference"
FASTEST = "mrp"


@functools.cache
def lagging():
    settings, laws = Request("quick"), ("rotation-vector", FASTEST)
    units = [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in laws]
    units += [
        Unit("velocity", f"{law}@geometric+solve", "arm-regulation", "ur5e", count=2, horizon_s=2.5) for law in laws
    ]
    return with_contender(pd.concat([rows_of(settings, unit) for unit in units], ignore_index=True))


def test_position_is_judged_by_servos_that_lag():
    compared = compare_positions(Run(REFERENCE, {"velocity": lagging()}))
    rows = lagging()
    late = rows[(rows["lag_s"] > 0.0) & rows["contender"].astype(str).str.startswith(FASTEST)]
    assert compared.row(FASTEST)["time"] == late["settling_time_s"].max()
    assert set(compared.pairs["starts"]) == {len(late)}


@pytest.mark.parametrize("robot", ROBOTS.values())
def test_robot_has_a_word_of_the_reference(robot):
    assert decide_for(robot, REFERENCE).law


@pytest.mark.parametrize("column", ["lost", "stuck", "unwound"])
def test_counts_of_velocity_laws_are_what_their_rows_say(column):
    rows, expected = compare_for(VELOCITY, REFERENCE).rows.set_index("contender"), velocities().counts
    assert dict(rows[column]) == pytest.approx(dict(expected.loc[rows.index, column]))


def test_law_that_is_dead_and_law_that_unwinds_are_not_eligible():
    eligible = velocities().qualify()
    assert not {"rotation-matrix", "quaternion-unwinding"} & set(eligible)
    assert "rotation-vector" in eligible
    assert decide_for(VELOCITY, REFERENCE).eligible == len(eligible)


def test_run_that_commands_no_robot_by_velocities_is_no_evidence(tmp_path):
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        compare_velocities(Run(tmp_path))
    rows = Run(REFERENCE).table("velocity")
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        compare_velocities(Run(REFERENCE, {"velocity": rows.iloc[:0]}))
    with pytest.raises(NoEvidence, match="servos that lag"):
        compare_positions(Run(REFERENCE, {"velocity": rows[rows["lag_s"] == 0.0]}))


def test_run_without_arms_is_no_evidence_for_them():
    episodes = Run(REFERENCE).table("episodes")
    with pytest.raises(NoEvidence, match="on an arm"):
        compare_arms(Run(REFERENCE, {"episodes": episodes[episodes["arm"] == ""]}))
