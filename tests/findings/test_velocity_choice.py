"""Which law where a robot takes velocities: by the rule, on rows of the reference's laws made here."""

import functools

import pandas as pd
import pytest

from bench.contenders.registry import find_contender
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.findings.claims.tables import Results
from bench.findings.claims.verdict import NoEvidence
from bench.findings.selection.needs import advise, has_all
from bench.findings.selection.robot_rows import measure_velocities as measure
from bench.findings.selection.robots import VELOCITIES, VELOCITY
from bench.findings.selection.rule import dominates
from bench.tables.read import with_contender
from bench.tables.schema import RESULTS

SIMPLEST, LOGARITHM, SINE, NO_SIGN, EASED = (
    *("quaternion-shortest", "rotation-vector", "rotation-matrix", "quaternion-unwinding", "late-braking"),
)


@functools.cache
def found():
    settings = Settings("quick")
    units = [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in (SIMPLEST, LOGARITHM, SINE)]
    units += [Unit("velocity", law, "free-body", count=24, horizon_s=2.5) for law in (NO_SIGN, EASED)]
    units += [
        Unit("velocity", f"{law}@geometric+solve", "arm-regulation", "ur5e", count=2, horizon_s=2.5)
        for law in (SIMPLEST, LOGARITHM)
    ]
    rows = with_contender(pd.concat([rows_of(settings, unit) for unit in units], ignore_index=True))
    return measure(Results(RESULTS / "reference", {"velocity": rows}))


def test_laws_are_those_that_were_told_the_simplest_first():
    assert set(found().laws) == {SIMPLEST, LOGARITHM, SINE, NO_SIGN, EASED}
    assert found().laws.index(SIMPLEST) < found().laws.index(EASED)


def test_advised_law_has_the_facts_and_nothing_dominates_it():
    advice, by = advise(found(), VELOCITY, VELOCITIES.needs), ("time", "worst", "peak", "tick")
    assert advice.default.law == SIMPLEST
    assert has_all(found(), SIMPLEST, VELOCITY.facts)
    assert not any(dominates(found(), law, SIMPLEST, by) for law in advice.default.asked)


def test_law_that_is_dead_and_law_that_unwinds_are_not_asked():
    asked = advise(found(), VELOCITY, VELOCITIES.needs).default.asked
    assert SINE not in asked
    assert NO_SIGN not in asked
    assert found().number("lost", SINE) == found().number("lost", SIMPLEST) + len(found().tables.directed) / 5


def test_fastest_is_the_logarithm_and_no_law_of_ours_is_advised():
    advice = advise(found(), VELOCITY, VELOCITIES.needs)
    laws = {one.need.words: one.law for one in (*advice.exceptions, *advice.others)}
    assert laws["the fastest, at equal gain near the goal"] == LOGARITHM
    assert EASED not in laws.values()


def test_law_that_was_not_told_on_arms_is_no_answer_there():
    advice = advise(found(), VELOCITY, VELOCITIES.needs)
    [on_arm] = (one for one in (*advice.exceptions, *advice.others) if one.need.by == ("arms",))
    assert set(on_arm.asked) == {SIMPLEST, LOGARITHM}


def test_memory_counts_as_ever():
    assert found().number("memory", EASED) == len(find_contender(EASED).regulator.memory)


def test_run_that_tells_no_robot_velocities_is_no_evidence(tmp_path):
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure(Results(tmp_path))
    rows = found().tables.uniform.iloc[:0]
    with pytest.raises(NoEvidence, match="commanded by velocities"):
        measure(Results(RESULTS / "reference", {"velocity": rows}))
