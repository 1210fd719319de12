"""Contracts over every start set, of the free body and of every arm, under any kernels of the libraries."""

import itertools
import json
import math
import os
import re
import subprocess
import sys

import numpy as np
import pytest

import tasks

ARMS = tasks.arm_names()
ON_BODY, ON_ARM = tasks.start_set_names(), tasks.start_set_names(arm=True)
SAMPLED = [("uniform", ""), ("tumbling", ""), ("goals", "")]
SAMPLED += itertools.product(("clear", "uniform", "tumbling"), ARMS)
every_set = pytest.mark.parametrize(
    ("name", "arm"), [(name, "") for name in ON_BODY] + [*itertools.product(ON_ARM, ARMS)]
)


@every_set
def test_ids_are_unique_words_quaternions_unit_and_elements_plain_floats(name, arm):
    ids = [start.id for start in tasks.start_set(name, arm=arm)]
    assert len(set(ids)) == len(ids)
    assert all(re.fullmatch(r"[a-z0-9][a-z0-9.-]*", word) for word in ids)
    assert not arm or all(word.startswith(name) for word in ids)
    for start in tasks.start_set(name, arm=arm):
        for quat in (start.quat_wxyz, start.goal_wxyz):
            # MuJoCo normalizes no product along the chain of an arm: seven of them, each rounded to 2e-16
            assert math.hypot(*quat) == pytest.approx(1.0, abs=2e-15 if arm else 4e-16)
    for start in tasks.start_set(name, arm=arm)[:40]:
        numbers = (*start.quat_wxyz, *start.omega, *start.goal_wxyz, *start.q, *start.qdot)
        assert len(numbers) == 11 + (2 * tasks.arm(arm).joints if arm else 0)
        assert {type(x) for x in numbers} == {float}
        assert np.isfinite(numbers).all()


@every_set
def test_shorter_set_begins_the_longer_one(name, arm):
    for count in (1, 2, 17, 20, 150):
        whole = tasks.start_set(name, arm=arm)
        assert tasks.start_set(name, min(count, len(whole)), arm=arm) == whole[:count]


@pytest.mark.parametrize(("name", "arm"), SAMPLED)
def test_sampled_set_has_as_many_as_asked_for_and_begins_the_same(name, arm):
    usual = tasks.start_set(name, arm=arm)
    longer = tasks.start_set(name, len(usual) + 5, arm=arm)
    assert len(longer) == len(usual) + 5
    assert longer[: len(usual)] == usual


@pytest.mark.parametrize(("name", "arm"), [*SAMPLED[:3], *zip(ON_ARM, itertools.cycle(ARMS))])
def test_other_seed_gives_other_starts(name, arm):
    count = 6 if arm else 100
    assert tasks.start_set(name, count, seed=1, arm=arm) != tasks.start_set(name, count, seed=0, arm=arm)


SETTINGS = {
    "blas": {"OPENBLAS_CORETYPE": "Prescott"},
    "numpy": {"NPY_DISABLE_CPU_FEATURES": "AVX512F AVX512CD AVX512_SKX AVX512_CLX AVX2 FMA3 X86_V3 X86_V4"},
}

STARTS = """
import json, tasks
from bench.experiments.jacobians.pose_sets import poses

found = {}
for name in ("wrist", "pole", "tumbling"):
    starts = tasks.start_set(name, arm="panda")
    found[name] = [[start.id, *(x.hex() for part in start[1:] for x in part)] for start in starts]
found["poses"] = [[pose.id, *(x.hex() for x in pose.q)] for pose in poses(tasks.arm("ur5e"), 16, 0)]
print(json.dumps(found))
"""


def starts(**variables):
    """What a process of its own finds, in hexadecimal."""
    ran = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", STARTS], env=os.environ | variables, capture_output=True, text=True
    )
    assert ran.returncode == 0, ran.stderr
    return json.loads(ran.stdout)


@pytest.fixture(scope="module")
def here():
    return starts()


@pytest.mark.parametrize("setting", SETTINGS)
def test_starts_are_the_same_bit_for_bit(here, setting):
    there = starts(**SETTINGS[setting])
    assert all(len(found) > 8 for found in here.values())
    assert [name for name in here if here[name] != there[name]] == []
