"""C18 to C20 and C26 on tables as theory has them: word, text or refusal after something is planted there."""

import math

import numpy as np
import pandas as pd
import pytest
from support.claim_tables import Refused, assert_follows, bent, keep, planted, put
from support.tables import decided

from bench.findings.claims.controller_costs import BY_COMMON, BY_EULER, ON_MATRIX, words
from bench.findings.claims.euler_jacobian import WELL_CONDITIONED
from bench.findings.claims.verdict import Word

HOLDS, CORRECTED, FAILS = Word.HOLDS, Word.CORRECTED, Word.FAILS


@pytest.mark.parametrize(("id", "word"), [("C18", CORRECTED), ("C19", HOLDS), ("C20", HOLDS), ("C26", HOLDS)])
def test_claim_is_decided_by_the_theory(id, word):
    assert decided(planted(id), word)


def bend(**cells):
    """An edit of the table of poses: a column times a function of the row, or a number, where rows are chosen."""
    return lambda frames: {"poses": frames["poses"].assign(**cells)}


def pose(**words):
    return lambda t: np.logical_and.reduce([t[name] == word for name, word in words.items()])


def near_in_one_family(t):
    return (t["pose_set"] == "pole") & (t["margin"] < 2e-4) & one_family(t)


def one_family(t):
    return t["pose_id"].str.startswith("1-minus")


def between(low, high, gap):
    return lambda t: (t["margin"] > low) & (t["margin"] < high) & t[gap].notna()


GAPS = ("derivation_gap", "difference_gap")
OTHER = {"representation": "mrp", "condition_analytic": 8.0, "largest": 1.0, "det_gap": 1.0, "derivation_gap": 1.0}
SIX = pose(arm="six", pose_set="random")
OF_JACOBIANS = [
    ("C18", HOLDS, put("poses", SIX, largest=0.0)),  # the matrix itself is zero somewhere
    ("C18", FAILS, bend(condition_analytic=8.0, largest=1.0)),  # nothing grows
    ("C18", FAILS, put("poses", near_in_one_family, largest=1e2)),
    ("C18", FAILS, bend(condition_analytic=lambda t: t["condition_analytic"] ** 0.8)),  # growth of another order
    ("C18", FAILS, bend(largest=lambda t: t["largest"] ** 0.8)),
    ("C18", FAILS, bend(largest=lambda t: t["largest"] / 1e3)),  # below the bound
    ("C18", CORRECTED, bend(det_gap=lambda t: t["det_gap"] * 50 / t["margin"])),  # rounding over the margin
    ("C18", CORRECTED, put("poses", SIX, det_gap=1e-17)),
    ("C18", FAILS, put("poses", SIX, det_gap=1e-12)),
    ("C18", FAILS, put("poses", one_family, largest=1.0)),
    ("C18", CORRECTED, put("poses", one_family, largest=1.0, condition=2 * WELL_CONDITIONED)),  # the arm is to blame
    ("C18", "2 families on ", put("poses", one_family, largest=1.0, condition=2 * WELL_CONDITIONED)),
    ("C18", "3 families on ", keep("poses", lambda t: ~pose(arm="six", pose_id="0-plus-1e-05")(t))),  # a distance lacks
    *(("C19", CORRECTED, put("poses", between(1e-6, 1e-3, gap), **{gap: 0.1})) for gap in GAPS),
    *(("C19", FAILS, put("poses", between(1e-3, 1.0, gap), **{gap: 0.1})) for gap in GAPS),
    *(("C19", HOLDS, put("poses", lambda t: t["margin"] < 0.9e-6, **{gap: 0.1})) for gap in GAPS),
    ("C19", FAILS, put("poses", pose(pose_id="0003"), derivation_gap=math.nan)),
    ("C19", HOLDS, put("poses", pose(pose_id="0003"), difference_gap=math.nan)),
    ("C19", "a difference: 2.", put("poses", pose(pose_id="0003"), difference_gap=math.nan)),
]
OF_JACOBIANS += [
    *((id, Refused("no pose"), keep("poses", lambda t: t["arm"] == "")) for id in ("C18", "C19")),
    ("C18", Refused("seven"), keep("poses", lambda t: (t["arm"] == "six") | (t["pose_set"] != "pole"))),
    ("C18", Refused("six joints"), bend(det_gap=math.nan)),
    *(("C19", Refused(f"{gap}.*seven"), put("poses", pose(arm="seven"), **{gap: math.nan})) for gap in GAPS),
]


@pytest.mark.parametrize("id", ["C18", "C19"])
def test_other_coordinates_are_not_looked_at(id):
    def both(frames):
        return {"poses": pd.concat([frames["poses"], frames["poses"].assign(**OTHER)])}

    assert str(planted(id, both).evidence) == str(planted(id).evidence)


def of(controller, joints=6, **also):
    return pose(**words(controller, joints), **also)


def is_euler(t):
    return (t["start_id"] == "pole-1") & (t["regulator"] == "feedback-linearized")


def cost(controller, stage, flops):
    return put("costs", of(controller, stage=stage), flops=flops)


def anywhere(t):
    return t["kp"] > 0.0


SETTLED = put("episodes", anywhere, outcome="settled")
OF_CONTROLLERS = [
    ("C20", CORRECTED, bent(second=5e-3)),
    ("C20", FAILS, bent(second=5e-2)),
    ("C20", FAILS, bent(second=math.nan)),
    ("C20", CORRECTED, bent(bend=1e-6, second=1e-4)),  # not the integrator's bend, however small
    ("C20", CORRECTED, bent(drift=5e-3)),
    ("C20", CORRECTED, SETTLED),  # no start at the pole fails
    ("C20", CORRECTED, put("episodes", pose(arm="panda"), outcome="settled")),  # on one arm none fails
    ("C20", CORRECTED, put("episodes", of(BY_EULER, start_id="clear-2"), outcome="diverged")),
    ("C20", CORRECTED, put("episodes", pose(start_set="pole"), outcome="saturated")),  # both fail
    ("C20", HOLDS, SETTLED, bent(beside="singular")),  # a start on the pole itself
    ("C20", CORRECTED, SETTLED, put("episodes", is_euler, peak_tau_nm=299.0)),
    ("C20", HOLDS, SETTLED, put("episodes", is_euler, peak_tau_nm=301.0)),  # hammered
    ("C20", FAILS, SETTLED, put("costs", of(BY_EULER), flops=100)),  # it neither fails nor hides
    ("C20", CORRECTED, cost(BY_EULER, "regulate", 60)),  # nothing is hidden
    ("C20", CORRECTED, cost(BY_EULER, "total", 700)),
    ("C26", FAILS, cost(BY_EULER, "total", 829)),  # calls are the same in both: one flop less contradicts
    ("C26", HOLDS, cost(BY_EULER, "total", 831)),
    ("C26", FAILS, cost(ON_MATRIX, "total", 910)),  # 3 calls more and 10 flops less: columns differ
    ("C26", "dearer in both columns in 4 of 4 pairs"),
    ("C26", "not timed"),
]
OF_CONTROLLERS += [
    *(
        ("C20", Refused("no "), lambda frames, name=name: {name: frames[name].iloc[:0]})
        for name in ("episodes", "poses", "costs")
    ),
    ("C26", Refused("no "), lambda frames: {"costs": frames["costs"].iloc[:0]}),
    *(
        (id, Refused(f"on {joints} joints"), keep("costs", lambda t, joints=joints: t["joints"] != joints))
        for id in ("C20", "C26")
        for joints in (6, 7)
    ),
    ("C20", Refused("rotation-matrix@geometric on ur5e"), keep("episodes", lambda t: ~of(ON_MATRIX)(t))),
]


def test_c20_leaves_out_plants_that_differ_from_the_model():
    def both(frames):
        other = frames["episodes"].assign(variation="mass-130", outcome="diverged")
        return {"episodes": pd.concat([frames["episodes"], other], ignore_index=True)}

    assert str(planted("C20", both).evidence) == str(planted("C20").evidence)


@pytest.mark.parametrize("euler", [3000.0, 1000.0])
def test_no_time_changes_the_word_of_c26(euler):
    times = {BY_COMMON: 2000.0, ON_MATRIX: 1800.0, BY_EULER: euler}
    where = {"what": "engine", "engine": "native", "arm": "ur5e", "machine": "m", "ticks": 1, "ns_per_tick": 1.0}
    rows = [
        {**words(one, 6), **where, "ratio": time, "ratio_low": time - 50.0, "ratio_high": time + 50.0}
        for one, time in times.items()
    ]
    verdict = planted("C26", {"timings": pd.DataFrame(rows)})
    assert verdict.word == HOLDS
    assert "times part 2 of them" in str(verdict.evidence)


@pytest.mark.parametrize("case", [*OF_JACOBIANS, *OF_CONTROLLERS], ids=lambda case: f"{case[0]}-{case[1]}")
def test_verdict_follows_what_is_planted(case):
    assert_follows(*case)
