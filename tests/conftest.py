"""A finished run that tests copy and spoil."""

import shutil

import pytest

from bench import plan as planning


@pytest.fixture(scope="module")
def run_once(tmp_path_factory):
    """A finished run that tests copy."""
    from bench import run as running
    from bench.choice import Choice
    from bench.discovery import find_contender

    folder = tmp_path_factory.mktemp("run") / "finished"
    plan = planning.make(
        "quick",
        [find_contender("rotation-matrix")],
        Choice(start_sets=("paper",), engines=("reference",)),
        horizon_s=0.1,
    )
    running.run(plan, folder, workers=1)
    return folder


@pytest.fixture
def finished(run_once, tmp_path):
    return shutil.copytree(run_once, tmp_path / "finished")
