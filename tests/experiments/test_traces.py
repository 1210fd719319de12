"""Curves that a run keeps: of the paper's laws from its starts and uniform ones, to the last bit."""

import numpy as np
import pytest
from support.driving import settings
from support.user_law import DAMPER, law_text

import tasks
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import run
from bench.experiments import plan, traces
from bench.experiments.episode_rows import judged_columns
from bench.experiments.experiment import Settings
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from tasks.rules import RULES

PAPERS = "rotation-matrix"
HOLD_TICKS = RULES.hold_ticks(1e-3)


@pytest.fixture(scope="module")
def kept():
    return traces.rows(Settings(), traces.of_law(find_contender(PAPERS), 5))


def rerun(law, start_set, start_id, horizon_s=20.0):
    """(samples, columns of the judge) of one episode, run by itself."""
    [start] = [one for one in tasks.start_set(start_set) if one.id == start_id]
    curves, chosen = blank_curves(1, 200, 20), settings(horizon_s=horizon_s, hold_ticks=HOLD_TICKS)
    rows = run("ideal-rk4", find_contender(law), "free-body", [start], chosen, metrics_of(False), curves=curves)
    return curves.samples[0], judged_columns(rows, chosen.dt_s)


def test_suite_follows_the_papers_laws_and_a_users(tmp_path):
    (tmp_path / "mine.py").write_text(law_text(DAMPER))
    names = (PAPERS, "quaternion-unwinding", "feedback-linearized/mrp")
    chosen = [*map(find_contender, names), find_contender("mine", (load_law(tmp_path / "mine.py"),))]
    followed = {unit.contender for unit in plan.make("quick", chosen).units if unit.experiment == "traces"}
    assert followed == {PAPERS, "mine"}


@pytest.mark.parametrize("start_id", ["figure-2.3", "figure-2.5"])
def test_curve_is_the_episode(kept, start_id):
    samples, said = rerun(PAPERS, "paper", start_id)
    samples = samples[~np.isnan(samples[:, 0])]
    own = kept[kept["start_id"] == start_id]
    for name in NUMBERS[:-1]:
        assert own[name].tolist() == samples[:, NUMBERS.index(name)].tolist()
    for name, values in said.items():
        assert own[name].drop_duplicates().tolist() == pytest.approx(list(values), nan_ok=True)
