"""The committed study of robustness: all laws and levels, shares to five points, and rows that its code makes now."""

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.experiments.experiment import Settings, Unit, rows_of
from bench.experiments.robustness import HORIZON_S
from bench.experiments.tables.read import table, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings.maps import lost_share
from bench.findings.perturbed import by_level, studied
from bench.law.contenders.registry import find_contender
from bench.studies.robustness import STARTS
from tasks.condition import condition_at


def test_study_has_every_level_of_every_perturbation_for_every_law():
    found = studied().groupby("axis", observed=True)
    assert set(found.groups) == set(table(RESULTS / "reference", "robustness")["axis"])
    laws = set(studied()["contender"])
    assert {"late-braking", "rotation-matrix", "feedback-linearized/zyx-euler"} < laws
    for name, rows in found:
        if condition_at(tasks.axis(name), 1.0).peak:  # not every law has gains for every peak
            continue
        levels = rows.groupby("contender", observed=True)["level"].agg(set)
        assert set(levels.index) == laws
        assert all(each == set(tasks.axis(name).levels) for each in levels)


def test_every_share_is_known_to_five_points():
    for good, starts in studied()[["good", "starts"]].drop_duplicates().itertuples(index=False):
        one = lost_share(int(good), int(starts))
        assert max(one.high - one.value, one.value - one.low) <= 0.0505
    assert set(studied()["starts"]) == {STARTS}


@pytest.mark.parametrize("law", ["rotation-matrix", "late-braking"])
def test_study_is_what_the_code_makes_now(law):
    unit = Unit("robustness", law, selector="saturation", count=STARTS, total=STARTS, horizon_s=HORIZON_S)
    now = with_contender(by_level(rows_of(Settings("default"), unit)))
    kept = studied()[(studied()["axis"] == "saturation") & (studied()["contender"] == find_contender(law).name)]
    assert now["good"].tolist() == kept["good"].tolist()
    np.testing.assert_allclose(now["median_s"], kept["median_s"], atol=1e-3)


def test_median_counts_what_never_settles_and_the_longest_does_not():
    rows = pd.DataFrame(
        {
            "axis": "delay",
            "regulator": "mine",
            "level": 0.01,
            "outcome": ["settled", "settled", "timed-out"],
            "settling_time_s": [0.5, 0.7, np.nan],
            "tail_rms_rad": 0.0,
        }
    )
    [one] = by_level(rows).to_dict("records")
    assert (one["starts"], one["good"], one["median_s"], one["longest_s"]) == (3, 2, 0.7, 0.7)
    assert by_level(rows.assign(outcome="timed-out"))["median_s"].tolist() == [np.inf]
