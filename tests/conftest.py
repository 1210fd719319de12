"""A finished run that tests copy and spoil; which files are begun first; less searching for garbage."""

import gc
import shutil

import pytest

from bench.experiments import plan as planning

LONG = (
    *("test_resume", "test_cluster", "test_growing", "test_guard", "test_contact_engines", "test_regress_measured"),
    *("test_every_regulator", "test_every_representation", "test_every_arm_start_set", "test_arm_figures"),
    *("test_arm_response", "test_arm_engines", "test_every_jacobian", "test_command_line", "test_impedances"),
    *("test_report_in_browser", "test_every_inverse", "test_plan_on_arms", "test_cartesian", "test_compare"),
    *("test_every_figure", "test_every_impedance", "test_compiled_cache", "test_own_law", "test_claims"),
    *("test_side_by_side_in_browser", "test_compliance_figures", "test_force", "test_every_task", "test_timing"),
)
"""Files that take longest: begun last, one would be left to a single process while the others wait."""


def pytest_collection_modifyitems(items):
    """The long ones first, longest of all in front."""
    items.sort(key=lambda item: LONG.index(item.path.stem) if item.path.stem in LONG else len(LONG))


@pytest.fixture(scope="session", autouse=True)
def state_of_its_own(tmp_path_factory):
    """Laws that tests run are none of this user's."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("XDG_STATE_HOME", str(tmp_path_factory.mktemp("state")))
        yield


def pytest_collection_finish():
    """What collecting has loaded stays to the end: the search for garbage need not look at it, nor be so frequent."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(20_000, 20, 20)


@pytest.fixture(scope="module")
def run_once(tmp_path_factory):
    """A finished run that tests copy."""
    from bench.contenders.registry import find_contender
    from bench.experiments.choice import Choice
    from bench.running import run as running

    folder = tmp_path_factory.mktemp("run") / "finished"
    plan = planning.make(
        "quick",
        [find_contender("rotation-matrix")],
        Choice(start_sets=("paper",), engines=("reference",), experiments=("free-body",)),
        horizon_s=0.1,
    )
    running.run(plan, folder, workers=1)
    return folder


@pytest.fixture
def finished(run_once, tmp_path):
    return shutil.copytree(run_once, tmp_path / "finished")
