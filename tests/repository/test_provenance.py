"""The digest of the sources: it is over all that decides a row, and over nothing that has gone."""

import subprocess
import sys
from pathlib import Path

import pytest

from bench.base.provenance import DECIDING, ROOT

READ_ONLY = {"bench/__init__.py"}
MODULES = """
import sys
from bench.experiments.experiment import known_experiments
from bench.experiments.jacobians import pose_sets
from bench.engines import simulate, simulate_arms, simulate_contact, simulate_bodies
from bench.experiments.tables import store
known_experiments()
from bench.engines.counting import in_contact, on_arms
for name, module in list(sys.modules.items()):
    if name.partition(".")[0] in ("bench", "tasks"):
        print(module.__file__)
"""


@pytest.mark.parametrize("name", DECIDING)
def test_what_decides_rows_is_there(name):
    assert (ROOT / name).exists()


def test_digest_is_over_every_module_that_makes_rows():
    told = subprocess.run([sys.executable, "-c", MODULES], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    files = {Path(line).relative_to(ROOT) for line in told.splitlines()}
    left = {one.as_posix() for one in files if not any(one.is_relative_to(name) for name in DECIDING)}
    assert left <= READ_ONLY
