"""Rows of compliance.parquet: one a pose, the worst of its trials, numbers where there are any, and no record kept."""

import weakref

import numpy as np
import pandas as pd
import pytest

import tasks
from bench.engines.contact_episode import OUTCOMES, WIDTH, Conditions, EndedEpisode
from bench.engines.metrics.contact_metric import Pose, response
from bench.engines.metrics.measured_compliance import compliance
from bench.engines.simulate_contact import run_contact as run
from bench.experiments.contact import WORST_LAST, frame, poses_of
from bench.law.control.registry import find_controller
from bench.law.control.setpoint import TOUCH

ARM = tasks.arm("ur5e")
PROBE = tasks.contact_task("wrench-probe")._replace(horizon_s=0.05)
EULER = find_controller("hybrid/zyx-euler+inverse")
POSES = poses_of(EULER, PROBE, ARM, dense=False)
CONDITIONS = Conditions()
C = [f"c_{i}{j}" for i in "xyz" for j in "xyz"]


@pytest.fixture(scope="module")
def rows():
    """The first three poses of wrench-probe."""
    return frame("mine", EULER, PROBE, ARM, POSES[:3], CONDITIONS)


def of_records(*ended: EndedEpisode) -> pd.Series:
    """The row of a pose whose trials ended so."""
    given = POSES[0][: len(ended)]
    [row] = frame("mine", EULER, PROBE, ARM, (given,), CONDITIONS, lambda *_: iter(ended)).to_dict("records")
    return pd.Series(row)


def record(ticks: int, value: float = 0.0) -> np.ndarray:
    """A record of a hand that does not move, every number but its orientation the same."""
    made = np.full((ticks, WIDTH), value)
    made[:, 1:10] = np.eye(3).ravel()
    return made


def test_one_row_a_pose_says_whose_it_is_and_of_what(rows):
    assert list(rows["pose"]) == [pose[0].pose for pose in POSES[:3]]
    assert list(rows["complies"]) == [pose[0].specification.name for pose in POSES[:3]]
    assert list(rows["trials"]) == [6, 6, 6]
    whose = rows[["suite", "task", "arm", "controller", "representation", "form"]].drop_duplicates()
    assert whose.to_numpy().tolist() == [["mine", "wrench-probe", "ur5e", "hybrid", "zyx-euler", "inverse"]]
    assert rows.loc[0, ["m_p", "m_o", "kc", "kf"]].tolist() == list(TOUCH)
    assert rows.loc[0, ["kp", "kv", "dt_s", "horizon_s"]].tolist() == [100.0, 20.0, 1e-3, 0.05]
    assert set(rows["integrator"]) == {"implicitfast"}


def test_angles_are_the_goals():
    at = [pose for pose in POSES if "alpha+35 beta+45 gamma-20" in pose[0].pose][:1]
    rows = frame("mine", find_controller("hybrid-base+inverse"), PROBE, ARM, tuple(at), CONDITIONS)
    angles = rows.loc[0, ["alpha", "beta", "gamma"]].to_numpy(float)
    assert np.degrees(angles) == pytest.approx([35.0, 45.0, -20.0])


def test_measured_rotation_is_that_of_the_poses_records(rows):
    ended = list(run("native", EULER, PROBE, ARM, POSES[0], CONDITIONS))
    pose = Pose(PROBE, ARM, EULER, tuple(map(response, POSES[0], ended)))
    assert rows.loc[0, C].to_numpy(float).tolist() == compliance(pose).ravel().tolist()
    assert np.isfinite(compliance(pose)).all()


def test_every_outcome_has_its_rank():
    assert sorted(WORST_LAST) == sorted(OUTCOMES.values())
    assert WORST_LAST == ("done", "singular", "saturated", "diverged", "broken")


def test_row_has_the_worst_outcome_and_the_time_at_which_its_first_trial_failed():
    ended = (
        EndedEpisode("done", record(50)),
        EndedEpisode("singular", record(3)),
        EndedEpisode("diverged", record(20)),
    )
    row = of_records(*ended, EndedEpisode("diverged", record(11)))
    assert row["outcome"] == "diverged"
    assert row["failure_time_s"] == pytest.approx(0.011)
    assert row["trials"] == 4


@pytest.mark.parametrize("ticks", [0, 1, 7])
@pytest.mark.parametrize("value", [np.nan, np.inf, 1e200])
@pytest.mark.parametrize("outcome", ["broken", "diverged"])
def test_trial_that_broke_is_a_row_with_no_measured_rotation(outcome, ticks, value):
    ended = [EndedEpisode("done", record(50))] * 5 + [
        EndedEpisode(outcome, record(ticks, value), "Nan, Inf or huge value in QACC")
    ]
    row = of_records(*ended)
    assert row["outcome"] == outcome
    assert row[C].isna().all()


def test_contact_that_explodes_is_a_row():
    """A controller of the wrong sign, as a metric sees it: torques far beyond the rated ones at once."""
    wild = EULER._replace(law="hybrid-unconverted")
    pole = [pose for pose in POSES if "beta+89 " in pose[0].pose]
    rows = frame("mine", wild, PROBE._replace(horizon_s=0.5), ARM, tuple(pole), CONDITIONS)
    assert set(rows["outcome"]) & {"saturated", "diverged", "broken"}
    failed = rows["outcome"] != "done"
    assert rows.loc[failed, "failure_time_s"].between(0.0, 0.5).all()


def test_records_are_dropped_with_their_pose():
    alive: list = []
    most = 0

    def counting(*_):
        nonlocal most
        for _ in range(sum(map(len, POSES[:8]))):
            made = record(50)
            alive.append(weakref.ref(made))
            most = max(most, sum(one() is not None for one in alive))
            yield EndedEpisode("done", made)

    assert len(frame("mine", EULER, PROBE, ARM, POSES[:8], CONDITIONS, counting)) == 8
    assert most <= 2 * len(POSES[0])
