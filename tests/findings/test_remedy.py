"""Smallest fixes and cures of users' questions: what they do, and that no bound is removed."""

import math
import re

import numpy as np
import pytest

from bench.findings import remedy
from bench.findings.questions import QUESTIONS
from bench.law.contenders.registry import contenders
from bench.law.shipped import VELOCITY, clipped, vector_part

COMMANDED = [one for one in contenders("shipped").values() if one.level != VELOCITY]


@pytest.mark.parametrize(
    ("name", "says", "before", "after"),
    [
        ("libfranka", "by 2", 10.0, 20.0),
        ("isaac-gym", "copysign", 150.0, 300.0),
        ("serl-franka", "before the clip", 7.5, 7.5),
        ("crisp", "clip the vector's length at 0.5", 15.0, 15.0),
        ("robosuite", "to a length of at most 1", 150.0, 150.0),
        ("fzi-motion", remedy.KEEP, 200.0, 200.0),
        ("mjctrl-opspace", remedy.KEEP, 47.5 * math.pi, 47.5 * math.pi),
        ("frankapy", remedy.KEEP, 50.0 * math.pi, 50.0 * math.pi),
    ],
)
def test_fix_and_greatest_command_are_those_of_the_formula(name, says, before, after):
    fix = remedy.fix_of(name)
    assert says in fix.words
    assert (fix.before, fix.after) == pytest.approx((before, after), rel=1e-6)


@pytest.mark.parametrize("one", COMMANDED)
def test_fix_exceeds_no_bound_and_raises_a_command_by_its_factor_alone(one):
    fix = remedy.smallest_fix(one)
    assert fix.after <= one.gains.kp * one.bound
    assert fix.after <= fix.before * (2.0 if "by 2" in fix.words else 1.0) * (1.0 + 1e-9)


def test_bound_of_each_component_is_found_and_one_of_the_length_is_kept():
    assert remedy.is_bent(lambda q: clipped(vector_part(q), 0.3))
    assert not remedy.is_bent(vector_part)
    assert remedy.fix_of("moveit-servo").words == remedy.KEEP


def test_bounds_are_those_of_the_errors():
    for one in contenders("shipped").values():
        if one.unbounded is not None:
            most = max(np.abs(one.error(remedy.about(k, math.pi))).max() for k in remedy.DIRECTIONS)
            assert most == pytest.approx(one.bound)


@pytest.mark.parametrize("one", QUESTIONS, ids=lambda one: one.threads[0])
def test_symptom_shows_and_cure_cures(one):
    before, after = one.measure()
    assert abs(before - one.right) > max(one.tolerance, 0.05)
    assert abs(after - one.right) <= one.tolerance


def test_threads_are_addresses_and_each_is_there_once():
    threads = [thread for one in QUESTIONS for thread in one.threads]
    assert all(re.fullmatch(r"[\w.-]+/[\w.-]+#\d+", thread) for thread in threads)
    assert len(set(threads)) == len(threads)
