"""C27 on tables written for it: two later laws, one with memory, beside the paper's three."""

import math

import pandas as pd
import pytest
from support import tables
from support.tables import changed

from bench.findings.claims.verdict import NoEvidence, Word

PAPERS = {
    ("rotation-matrix", ""): (40, 0),
    ("linearized-euler", "zyx-euler"): (33, 3),
    ("feedback-linearized", "zyx-euler"): (51, 3),
}
SHORTEST, HYBRID = ("quaternion-shortest", ""), ("hybrid", "")
LATER = {SHORTEST: (60, 0), HYBRID: (70, 0)}
COUNTED = {("mrp", ""): (80, 1), ("square-root", ""): (79, 0)}
"""Counted and timed, and not run."""

FLOP, CALL = 0.01, 0.6
"""Times of these laws, in those of the kernel: a call takes 60 flops."""

WORDS = {"jacobian": "", "inverse": "", "arm": "", "task": "free-body", "engine": "ideal-rk4", "kp": 100.0, "kv": 20.0}
ANGLES = {"uniform": 2.0, "half-turn": math.pi, "box": 1.0}


def named(law):
    return {"regulator": law[0], "representation": law[1], "contender": "/".join(filter(None, law))}


def start(name, i):
    turned = {"alpha0": 0.5, "beta0": 0.2, "gamma0": 0.3, "angle0_rad": ANGLES[name]}
    goal = dict(zip(("goal_quat_w", "goal_quat_x", "goal_quat_y", "goal_quat_z"), (1.0, 0.0, 0.0, 0.0), strict=True))
    return {"start_set": name, "start_id": f"{name}-{i}", **turned, **goal}


@pytest.fixture
def frames():
    laws = PAPERS | LATER
    ending = {"outcome": "settled", "settling_time_s": 0.6, "path_ratio": 1.0, "converged": "yes"}
    episodes = [{**WORDS, **named(law), **start(name, i), **ending} for law in laws for name in ANGLES for i in (0, 1)]
    costs = [
        {**WORDS, **named(law), "branch": "typical", "stage": stage, "flops": flops, "sin": calls}
        | dict.fromkeys(("cos", "atan2", "acos"), 0)
        for law, (whole, called) in (laws | COUNTED).items()
        for stage, flops, calls in (("total", whole, called), ("goal", 0, 0))
    ]
    noise = [
        {**named(law), "axis": "half-turn-noise", "level": level, "outcome": "settled"}
        for law in LATER
        for level in (0.0, 0.1, 1.0)
    ]
    times = [
        {**named(law), **WORDS, "what": "law", "machine": "m", "ticks": 1, **timed(1.0 + FLOP * flops + CALL * calls)}
        for law, (flops, calls) in (laws | COUNTED).items()
    ]
    spun = [
        {"contender": "/".join(filter(None, law)), "least_speed": 20.0, "most_speed": 20.0, "starts": 10_000}
        | {"settled": 10_000, "unconverged": 0, "lost": 0}
        for law in laws
    ]
    tables = {"episodes": episodes, "costs": costs, "robustness": noise, "timings": times, "counted": spun, "map": []}
    return {name: pd.DataFrame(rows) for name, rows in tables.items()}


def timed(ratio):
    return {"ratio": ratio, "ratio_low": 0.99 * ratio, "ratio_high": 1.01 * ratio}


def of(law, **words):
    def rows(frame):
        chosen = (frame["regulator"] if "regulator" in frame else frame["contender"]) == law[0]
        for column, word in words.items():
            chosen &= frame[column] == word
        return chosen

    return rows


@pytest.fixture
def judged(frames):
    """judged(table, rows, column=value): C27 with some cells changed."""

    def judge(table="episodes", rows=lambda frame: (), **cells):
        return tables.judged("C27", **frames | {table: changed(frames[table], rows(frames[table]), **cells)})

    return judge


def later(**words):
    return lambda frame: (of(SHORTEST, **words)(frame)) | (of(HYBRID, **words)(frame))


def test_question_is_answered_when_a_law_passes_every_test(judged):
    verdict = judged()
    assert verdict.word == Word.ANSWERED
    assert verdict.evidence.parts["answers"].startswith("quaternion-shortest (time 1.14, 60 and 0 flops")
    assert "a call takes 60 flops" in str(verdict.evidence)


def test_one_law_is_enough(judged):
    assert judged(rows=of(SHORTEST, start_set="box"), outcome="stuck").word == Word.ANSWERED


SLOW = {"ratio": 4.0, "ratio_low": 3.9, "ratio_high": 4.1}


@pytest.mark.parametrize(
    ("table", "words", "cells", "lacks"),
    [
        ("episodes", {"start_set": "uniform"}, {"outcome": "stuck"}, "(a, c)"),
        ("episodes", {"start_set": "box"}, {"outcome": "diverged"}, "(b)"),
        ("counted", {}, {"lost": 20}, "(b)"),
        ("episodes", {"start_set": "uniform"}, {"settling_time_s": 1.2}, "(c)"),
        ("timings", {}, SLOW, "(d)"),  # the linearized law takes 1 + 0.33 + 1.8
        ("costs", {"stage": "total"}, {"sin": 9}, "(h)"),
        ("episodes", {"start_set": "half-turn"}, {"outcome": "stuck"}, "(e)"),
        ("episodes", {"start_set": "uniform"}, {"path_ratio": 1.5}, "(g)"),
        ("robustness", {"level": 0.1}, {"outcome": "timed-out"}, "(f)"),
        ("robustness", {"level": 0.0}, {"outcome": "stuck"}, "(f)"),
    ],
)
def test_question_is_open_where_every_law_misses_a_test(judged, table, words, cells, lacks):
    verdict = judged(table, later(**words), **cells)
    assert verdict.word == Word.HOLDS
    assert f"hybrid {lacks}" in str(verdict.evidence)


def test_noise_beyond_the_stated_angle_does_not_count(judged):
    assert judged("robustness", later(level=1.0), outcome="stuck").word == Word.ANSWERED


def test_law_that_was_not_timed_is_judged_by_operations_at_the_price_of_a_call(frames):
    times = frames["timings"]
    verdict = tables.judged("C27", **frames | {"timings": times[times["regulator"] != "quaternion-shortest"]})
    assert verdict.evidence.parts["answers"].startswith("quaternion-shortest (time not timed, 60 and 0 flops")
    assert "operations decide: quaternion-shortest" in str(verdict.evidence)


def test_nothing_is_said_of_cost_where_nothing_was_timed(frames):
    with pytest.raises(NoEvidence, match="bench time"):
        tables.judged("C27", **frames | {"timings": frames["timings"].iloc[:0]})


def test_law_that_no_noise_was_tried_on_is_no_answer(frames):
    noise = frames["robustness"]
    untried = noise[noise["regulator"] != "quaternion-shortest"]
    verdict = tables.judged("C27", **frames | {"robustness": untried})
    assert verdict.evidence.parts["answers"].startswith("hybrid")


@pytest.mark.parametrize("table", ["episodes", "robustness"])
def test_no_verdict_without_rows(frames, table):
    with pytest.raises(NoEvidence):
        tables.judged("C27", **frames | {table: frames[table].iloc[:0]})


def test_no_verdict_on_the_papers_laws_alone(frames):
    episodes = frames["episodes"]
    papers = episodes[~later()(episodes)]
    with pytest.raises(NoEvidence, match="no later law"):
        tables.judged("C27", **frames | {"episodes": papers})


def test_user_law_is_asked_too(frames):
    own = {name: frame.replace("quaternion-shortest", "mine") for name, frame in frames.items()}
    assert tables.judged("C27", **own).evidence.parts["answers"].startswith("mine")


def test_engine_that_ran_no_law_on_which_noise_was_tried_is_not_asked(frames):
    episodes = frames["episodes"]
    native = episodes[of(SHORTEST)(episodes)].assign(engine="native", regulator="mine", contender="mine")
    costs = frames["costs"]
    own = costs[of(SHORTEST)(costs)].assign(regulator="mine", contender="mine")
    both = {"episodes": pd.concat([episodes, native]), "costs": pd.concat([costs, own])}
    verdict = tables.judged("C27", **frames | both)
    assert "No sampled engine has rows" in str(verdict.evidence)
