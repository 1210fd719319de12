"""Rows that are kept: between processes, curves of episodes, and those that rounding decides."""

import numpy as np
import pandas as pd
import pytest
from support.driving import METRICS, settings
from support.user_law import DAMPER, law_text

import tasks
from bench.engines import cache, counting
from bench.engines.curve import NUMBERS, blank_curves
from bench.engines.simulate import run
from bench.experiments import plan as planning
from bench.experiments import starts, traces
from bench.experiments.costs import count_operations
from bench.experiments.episode_rows import judged_columns
from bench.experiments.experiment import rows_of
from bench.experiments.kept_rows import kept
from bench.experiments.request import Request
from bench.experiments.rounding import NUDGE, OUTCOME_NUDGED, ROUNDING_CHANGE, nudged, rerun_nudged
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from bench.law.kinds import UserFile
from tasks.rules import RULES

LAW = find_contender("mrp")
ROW = {"law": "mrp", "branch": "worst", "add": 3}


@pytest.fixture
def made():
    """Every call of what makes rows."""
    return []


@pytest.fixture
def of(tmp_path, made):
    """of(name, sources) -> its rows, from an empty folder that is kept."""

    def make():
        made.append(1)
        return [ROW]

    return lambda name="costs/mrp", sources="": kept(name, make, tmp_path / "cache", sources)


def test_are_made_once(of, made):
    assert [of(name) for name in ("costs/mrp-6", "costs/mrp-7", "costs/mrp-6")] == [[ROW]] * 3
    assert len(made) == 2


def test_of_other_sources_are_made_anew(of, made):
    assert of() == of(sources="0123456789abcdef")
    assert len(made) == 2


def test_without_room_are_made_each_time(of, made, tmp_path):
    (tmp_path / "cache").write_text("a file where the folder should be")
    assert of() == of()
    assert len(made) == 2


def test_what_is_kept_is_what_is_counted_and_a_users_law_is_not_kept():
    own = LAW._replace(regulator=LAW.regulator._replace(name="nobody-s", file=UserFile("nobody_s.py")))
    assert count_operations(own) == counting.rows([own])
    assert not list((cache.FOLDER / "costs").glob("*nobody-s*"))
    assert count_operations(LAW) == counting.rows([LAW])
    one = find_contender("rotation-matrix@geometric+solve")
    assert count_operations(one, 6) == counting.rows_on_arm(one, 6)


@pytest.mark.parametrize("count", [None, 1, 40])
@pytest.mark.parametrize("start_set", ["half-turn", "tumbling"])
def test_starts_on_an_arm_are_the_judges_to_the_bit(start_set, count):
    theirs = tasks.start_set(start_set, count, 3, arm="ur5e")
    for _ in ("as found", "as kept"):
        starts.found.cache_clear()
        assert list(map(repr, starts.on_arm(start_set, count, 3, "ur5e"))) == list(map(repr, theirs))
    assert starts.count_of(start_set, count, 3, "ur5e") == len(theirs)


PAPERS = "rotation-matrix"
HOLD_TICKS = RULES.hold_ticks(1e-3)


@pytest.fixture(scope="module")
def curves():
    return traces.rows(Request(), traces.of_law(find_contender(PAPERS), 5))


def rerun(law, start_set, start_id):
    """Return (samples, columns of the judge) of one episode, run alone."""
    [start] = [one for one in tasks.start_set(start_set) if one.id == start_id]
    samples, chosen = blank_curves(1, 200, 20), settings(horizon_s=20.0, hold_ticks=HOLD_TICKS)
    rows = run("ideal-rk4", find_contender(law), "free-body", [start], chosen, METRICS, curves=samples)
    return samples.samples[0], judged_columns(rows, chosen.dt_s)


def test_suite_follows_the_papers_laws_and_a_users(tmp_path):
    (tmp_path / "mine.py").write_text(law_text(DAMPER))
    names = (PAPERS, "quaternion-unwinding", "feedback-linearized/mrp")
    chosen = [*map(find_contender, names), find_contender("mine", (load_law(tmp_path / "mine.py"),))]
    followed = {
        unit.contender for unit in planning.make(Request("quick", tuple(chosen), experiments=("traces",))).units
    }
    assert followed == {PAPERS, "mine"}


@pytest.mark.parametrize("start_id", ["figure-2.3", "figure-2.5"])
def test_curve_is_the_episode(curves, start_id):
    samples, said = rerun(PAPERS, "paper", start_id)
    samples = samples[~np.isnan(samples[:, 0])]
    own = curves[curves["start_id"] == start_id]
    for name in NUMBERS[:-1]:
        assert own[name].tolist() == samples[:, NUMBERS.index(name)].tolist()
    for name, values in said.items():
        assert own[name].drop_duplicates().tolist() == pytest.approx(list(values), nan_ok=True)


START = tasks.start_set("clear", 1, arm="ur5e")[0]


def row(outcome="settled", effort=1.0, condition=1e4):
    return {"outcome": outcome, "effort": effort, "cond_jacobian_max": condition, "peak_torque_ratio": 0.5}


def judged(first, beside):
    """What is said of one row, given that of the start's neighbour; and which starts were asked for."""
    asked = []

    def again(starts):
        asked.extend(starts)
        return pd.DataFrame([beside])

    [found] = rerun_nudged(pd.DataFrame([first]), [START], again).to_dict("records")
    return found, asked


def test_doubtful_row_is_judged_beside_its_start():
    found, asked = judged(row(), row())
    assert asked == [nudged(START, NUDGE)]
    assert (found[OUTCOME_NUDGED], found[ROUNDING_CHANGE]) == ("", 0.0)


def test_row_far_from_any_singularity_is_not_judged_again():
    found, asked = judged(row(condition=10.0), row("stuck"))
    assert asked == []
    assert found[OUTCOME_NUDGED] == ""
    assert np.isnan(found[ROUNDING_CHANGE])


def test_torque_far_beyond_the_rated_one_is_doubtful_too():
    found, _ = judged(row(condition=10.0) | {"peak_torque_ratio": 1e3}, row("stuck"))
    assert found[OUTCOME_NUDGED] == "stuck"


@pytest.mark.parametrize(
    ("first", "beside", "change"),
    [
        (1.0, 1.0 - 1e-3, pytest.approx(1e-3)),  # relative to the larger
        (1.0, np.nan, np.inf),  # a number that is there on one side alone
        (1e-12, 5e-10, 0.0),  # of the size of rounding
    ],
)
def test_change_is_the_relative_one_of_numbers_above_rounding(first, beside, change):
    assert judged(row(effort=first), row(effort=beside))[0][ROUNDING_CHANGE] == change


def test_run_marks_what_passes_a_singularity_and_nothing_in_the_clear():
    plan = planning.make(
        Request(
            "quick",
            (find_contender("rotation-matrix"),),
            tasks=("arm-regulation",),
            start_sets=("clear", "wrist"),
            engines=("native",),
            arms=("ur5e",),
            jacobians=("geometric",),
            inverses=("solve",),
            count=8,
            horizon_s=3.0,
        )
    )
    found = pd.concat([rows_of(plan.request, unit) for unit in plan.of("arm")])
    doubtful = found[ROUNDING_CHANGE].notna()
    assert not doubtful[found["start_set"] == "clear"].any()
    assert doubtful[found["start_set"] == "wrist"].any()
    assert (found.loc[doubtful & (found[OUTCOME_NUDGED] == ""), ROUNDING_CHANGE] > 0.0).all()
