"""Curves that a run keeps: of every law from every telling start, exact for claims, to 22 bits for figures."""

import numpy as np
import pandas as pd
import pytest
from support.driving import settings

import tasks
from bench.contenders import combinations
from bench.contenders.registry import find_contender
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.run import run
from bench.experiments import traces
from bench.experiments.experiment import Settings
from bench.experiments.rows.episodes import judged_columns
from bench.metrics.registry import metrics_of
from tasks.rules import RULES

PAPERS, LATER = "rotation-matrix", "quaternion-unwinding"
HOLD_TICKS = RULES.hold_ticks(1e-3)


@pytest.fixture(scope="module")
def kept():
    laws = map(find_contender, (PAPERS, LATER))
    return pd.concat([traces.rows(Settings(), traces.of_law(one, 5)) for one in laws])


def rerun(law, start_set, start_id, horizon_s=20.0):
    """(samples, columns of the judge) of one episode, run by itself."""
    [start] = [one for one in tasks.start_set(start_set) if one.id == start_id]
    curves, chosen = blank_curves(1, 200, 20), settings(horizon_s=horizon_s, hold_ticks=HOLD_TICKS)
    rows = run("ideal-rk4", find_contender(law), "free-body", [start], chosen, metrics_of(False), curves=curves)
    return curves.samples[0], judged_columns(rows, chosen.dt_s)


@pytest.mark.parametrize("law", [PAPERS, LATER])
def test_every_law_is_followed_from_every_telling_start(kept, law):
    own = kept[kept["regulator"] == law]
    for start_set, ids in traces.TELLING.items():
        assert set(own.loc[own["start_set"] == start_set, "start_id"]) == set(ids)
    assert set(own.loc[own["start_set"] == "paper", "start_id"]) == {one.id for one in tasks.start_set("paper")}


@pytest.mark.parametrize(("law", "count"), [(PAPERS, 5), (LATER, traces.FEW)])
def test_papers_laws_are_followed_from_the_plans_uniform_starts_and_later_ones_from_a_few(kept, law, count):
    own = kept[(kept["regulator"] == law) & (kept["start_set"] == "uniform")]
    assert own["start_id"].unique().tolist() == [one.id for one in tasks.start_set("uniform", count)]


@pytest.mark.parametrize(
    ("law", "start_set", "start_id", "bits"),
    [
        (PAPERS, "paper", "figure-2.3", 53),
        (PAPERS, "tumbling", "tumbling-0002", traces.KEPT_BITS),
        (LATER, "paper", "figure-2.3", traces.KEPT_BITS),
    ],
)
def test_curve_is_the_episode_to_the_bits_it_is_kept_to(kept, law, start_set, start_id, bits):
    samples, _ = rerun(law, start_set, start_id)
    samples = samples[~np.isnan(samples[:, 0])]
    own = kept[(kept["regulator"] == law) & (kept["start_id"] == start_id)]
    assert own["time_s"].tolist() == samples[:, 0].tolist()
    for name in NUMBERS[1:-1]:
        exact, found = samples[:, NUMBERS.index(name)], own[name].to_numpy()
        assert (np.abs(found - exact) <= 2.0**-bits * np.abs(exact)).all()


@pytest.mark.parametrize("start_id", ["half-turn-random0-k02", "half-turn-x-exact"])
def test_curve_says_how_its_episode_ended(kept, start_id):
    own = kept[(kept["regulator"] == PAPERS) & (kept["start_id"] == start_id)]
    _, said = rerun(PAPERS, "half-turn", start_id)
    for name, values in said.items():
        assert own[name].drop_duplicates().tolist() == pytest.approx(list(values), nan_ok=True)


def test_two_neighbours_at_the_kept_bits_are_one_to_the_gate():
    from bench.regression.rows.tables import RELATIVE

    assert 2.0 ** (1 - traces.KEPT_BITS) < RELATIVE


def test_curves_on_an_arm_share_the_table_and_name_no_outcome():
    [one] = combinations.on((f"{PAPERS}@geometric+solve",), {PAPERS: find_contender(PAPERS)}, 6)
    kept = traces.rows(Settings(), traces.of_arm(one.name, "arm-regulation", "puma560", 1))
    assert set(kept["start_set"]) == set(traces.ARM_SETS)
    assert set(kept["outcome"]) == {""}
