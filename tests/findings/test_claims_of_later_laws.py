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
    ending = {"outcome": "settled", "converged": "yes", "settling_time_s": 0.6, "path_ratio": 1.0}
    episodes = [{**WORDS, **named(law), **start(name, i), **ending} for law in laws for name in ANGLES for i in (0, 1)]
    costs = [
        {**WORDS, **named(law), "branch": "typical", "stage": stage, "flops": flops, "sin": calls}
        | dict.fromkeys(("cos", "atan2", "acos"), 0)
        for law, (whole, called) in laws.items()
        for stage, flops, calls in (("total", whole, called), ("goal", 0, 0))
    ]
    noise = [
        {**named(law), "axis": "half-turn-noise", "level": level, "outcome": "settled"}
        for law in LATER
        for level in (0.0, 0.1, 1.0)
    ]
    spinning = [
        {**dict.fromkeys(("jacobian", "inverse"), ""), **named(law), "row": "cell", "least_speed": speed}
        | {"most_speed": speed, "starts": 10_000, "settled": 10_000, "unconverged": 0}
        for law in laws
        for speed in (0.0, 20.0)
    ]
    tables = (("episodes", episodes), ("costs", costs), ("robustness", noise), ("map", spinning))
    return {name: pd.DataFrame(rows) for name, rows in tables}


def of(law, **words):
    def rows(frame):
        chosen = frame["regulator"] == law[0]
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
    assert verdict.word == Word.FAILS
    assert verdict.evidence.parts["answers"].startswith("quaternion-shortest (60 flops")


def test_one_law_is_enough(judged):
    assert judged(rows=of(SHORTEST, start_set="box"), outcome="stuck").word == Word.FAILS


@pytest.mark.parametrize(
    ("table", "words", "cells", "word"),
    [
        # half answered: every law misses one of the further tests
        ("episodes", {"start_set": "half-turn"}, {"outcome": "stuck"}, Word.CORRECTED),
        ("episodes", {"start_set": "uniform"}, {"path_ratio": 1.5}, Word.CORRECTED),
        ("robustness", {"level": 0.1}, {"outcome": "timed-out"}, Word.CORRECTED),
        ("robustness", {"level": 0.0}, {"outcome": "stuck"}, Word.CORRECTED),
        ("costs", {"stage": "total"}, {"flops": 73}, Word.CORRECTED),
        # open: every law misses one of C17's tests
        ("episodes", {"start_set": "uniform"}, {"outcome": "stuck"}, Word.HOLDS),
        ("episodes", {"start_set": "box"}, {"outcome": "diverged"}, Word.HOLDS),
        ("map", {"most_speed": 20.0}, {"settled": 9_980}, Word.HOLDS),
        ("map", {"most_speed": 20.0}, {"settled": 9_980, "unconverged": 20}, Word.HOLDS),
        ("episodes", {"start_set": "uniform"}, {"settling_time_s": 1.2}, Word.HOLDS),
        ("costs", {"stage": "total"}, {"flops": 81}, Word.HOLDS),
        # noise beyond the stated angle does not count
        ("robustness", {"level": 1.0}, {"outcome": "stuck"}, Word.FAILS),
    ],
)
def test_question_is_answered_half_answered_or_open_by_what_every_law_misses(judged, table, words, cells, word):
    assert judged(table, later(**words), **cells).word == word


def test_law_that_no_noise_was_tried_on_is_no_answer(frames):
    noise = frames["robustness"]
    untried = noise[noise["regulator"] != "quaternion-shortest"]
    verdict = tables.judged("C27", **frames | {"robustness": untried})
    assert verdict.evidence.parts["answers"].startswith("hybrid")


def test_price_from_which_a_law_is_affordable_is_reported(judged):
    # at 1 flop a call the linearized law costs 36, so 72 is allowed; 73 is from (73/2 - 33)/3 = 1.17 on
    verdict = judged("costs", of(SHORTEST, stage="total"), flops=73)
    assert "(h)" in str(verdict.evidence)
    assert "from 1.17 flops a call on" in verdict.evidence.parts["nearly"]


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
