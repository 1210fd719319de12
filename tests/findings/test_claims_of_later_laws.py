"""C27 on tables written for it: two later laws, one with memory, beside the paper's three."""

import functools
import math

import pandas as pd
import pytest
from support.claim_tables import TABLES, Refused, assert_follows, keep, put

from bench.findings.claims.verdict import Word

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


@functools.cache
def tables():
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
    found = {"episodes": episodes, "costs": costs, "robustness": noise, "timings": times, "counted": spun, "map": []}
    return {name: pd.DataFrame(rows) for name, rows in found.items()}


def timed(ratio):
    return {"ratio": ratio, "ratio_low": 0.99 * ratio, "ratio_high": 1.01 * ratio}


def of(law, **words):
    def rows(frame):
        chosen = (frame["regulator"] if "regulator" in frame else frame["contender"]) == law[0]
        for column, word in words.items():
            chosen &= frame[column] == word
        return chosen

    return rows


def later(**words):
    return lambda frame: (of(SHORTEST, **words)(frame)) | (of(HYBRID, **words)(frame))


def without(table, law):
    return keep(table, lambda frame: ~of(law)(frame))


def none_of(table):
    return lambda frames: {table: frames[table].iloc[:0]}


def native(frames):
    """A law that an engine ran and on which noise was not tried."""
    own = {name: frames[name][of(SHORTEST)(frames[name])] for name in ("episodes", "costs")}
    own = {name: rows.assign(regulator="mine", contender="mine") for name, rows in own.items()}
    own["episodes"] = own["episodes"].assign(engine="native")
    return {name: pd.concat([frames[name], rows]) for name, rows in own.items()}


ANSWERED, SLOW = Word.ANSWERED, {"ratio": 4.0, "ratio_low": 3.9, "ratio_high": 4.1}
LACKING = [
    (put("episodes", later(start_set="uniform"), outcome="stuck"), "(a, c)"),
    (put("episodes", later(start_set="box"), outcome="diverged"), "(b)"),
    (put("counted", later(), lost=20), "(b)"),
    (put("episodes", later(start_set="uniform"), settling_time_s=1.2), "(c)"),
    (put("timings", later(), **SLOW), "(d)"),  # the linearized law takes 1 + 0.33 + 1.8
    (put("costs", later(stage="total"), sin=9), "(h)"),
    (put("episodes", later(start_set="half-turn"), outcome="stuck"), "(e)"),
    (put("episodes", later(start_set="uniform"), path_ratio=1.5), "(g)"),
    (put("robustness", later(level=0.1), outcome="timed-out"), "(f)"),
    (put("robustness", later(level=0.0), outcome="stuck"), "(f)"),
]
EIGHT = "All eight tests: "
CASES = [
    (ANSWERED,),
    (f"{EIGHT}quaternion-shortest (time 1.14, 60 and 0 flops",),
    ("a call takes 60 flops",),
    (ANSWERED, put("episodes", of(SHORTEST, start_set="box"), outcome="stuck")),  # one law is enough
    *((Word.HOLDS, edit) for edit, _ in LACKING),
    *((f"hybrid {lacks}", edit) for edit, lacks in LACKING),
    (ANSWERED, put("robustness", later(level=1.0), outcome="stuck")),  # beyond the stated angle
    # a law that was not timed is judged by operations at the price of a call
    (f"{EIGHT}quaternion-shortest (time not timed, 60 and 0 flops", without("timings", SHORTEST)),
    ("operations decide: quaternion-shortest", without("timings", SHORTEST)),
    (f"{EIGHT}hybrid", without("robustness", SHORTEST)),  # no noise was tried on the other
    (
        f"{EIGHT}mine",
        lambda frames: {name: rows.replace("quaternion-shortest", "mine") for name, rows in frames.items()},
    ),
    ("No sampled engine has rows", native),
    (Refused("bench time"), none_of("timings")),
    (Refused("no episode"), none_of("episodes")),
    (Refused("no episode under"), none_of("robustness")),
    (Refused("no later law"), keep("episodes", lambda frame: ~later()(frame))),
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: str(case[0]))
def test_answer_follows_what_is_planted(monkeypatch, case):
    monkeypatch.setitem(TABLES, "C27", tables)
    assert_follows("C27", *case)
