"""Starts are the same, bit for bit, whichever kernels the libraries choose for a processor."""

import json
import os
import subprocess
import sys

import pytest

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
