"""The comparison of laws: which rows it takes, what its tables say of made-up rows, and the springs against the run."""

import math

import pandas as pd
import pytest

pytest.importorskip("matplotlib", reason="the report extra is not installed (cure: make setup)")

from bench.experiments.tables import read
from bench.experiments.tables.schema import RESULTS
from bench.findings.theory.isotropic import EQUATIONS, LEAST_RAD, NEAREST_RAD, settling
from report.figures.comparison import cells, comparison
from report.figures.kit import families
from report.figures.kit.page import Run, run_in


@pytest.fixture(autouse=True)
def reference(monkeypatch):
    monkeypatch.setenv(read.VARIABLE, str(RESULTS / "reference"))


RUN = run_in(RESULTS / "reference")
EXACT_RAD = 1e-13
"""Between the nearest of the near starts (1e-12 rad) and what rounding leaves of an exact one (4e-16 rad)."""


def rows():
    return comparison.uniform(RUN)


def episode(contender, start, outcome="settled", time=1.0, **more):
    """A made-up row of a uniform start."""
    usual = {"arm": "", "start_set": "uniform", "kp": 100.0, "kv": 20.0, "angle0_rad": 1.0, "path_ratio": 1.0}
    turn = {"quat_w": 0.8, "quat_x": 0.6, "quat_y": 0.0, "quat_z": 0.0}
    return {**usual, **turn, "contender": contender, "start_id": start, "outcome": outcome} | {
        "settling_time_s": time if outcome == "settled" else math.nan,
        **more,
    }


def test_common_keeps_the_starts_that_every_law_ran():
    made = [episode("square-root", one) for one in "ab"] + [episode("rotation-matrix", one) for one in "abc"]
    kept = cells.common(pd.DataFrame(made))
    assert list(kept["contender"]) == ["rotation-matrix"] * 2 + ["square-root"] * 2
    assert list(kept["start_id"]) == ["a", "b"] * 2


def test_costs_of_starts_that_do_not_settle_are_infinite():
    made = [episode("gibbs", "a", "stuck", effort=3.0), episode("gibbs", "b", effort=5.0)]
    table = cells.costs(pd.DataFrame(made).astype({"contender": "category"}), "effort")
    assert table["gibbs"].tolist() == [math.inf, 5.0]


def test_worst_start_is_the_nearest_that_fails_and_else_the_slowest():
    made = [episode("gibbs", "a", time=2.0), episode("gibbs", "b", angle0_rad=0.5), episode("gibbs", "c")]
    assert cells.worst(pd.DataFrame(made)) == "2.00 s from 57°"
    failing = [episode("gibbs", "d", "stuck", angle0_rad=3.0), episode("gibbs", "e", "stuck", angle0_rad=2.0)]
    assert cells.worst(pd.DataFrame(made + failing)) == "fails from 115°"


def test_interval_is_left_away_where_it_is_the_number():
    write = "{:.3f}".format
    assert cells.spelled((0.5, 0.5, 0.5001), write) == "0.500"
    assert "(0.400 to never)" in cells.spelled((0.5, 0.4, math.inf), write)


def test_law_of_no_family_comes_last_under_its_own_name():
    found = families.present(["my-law", "hybrid"])
    assert [one.title for one in found] == ["On the quaternion", families.OTHERS]
    assert found[-1].laws == {"my-law": "my-law"}


def test_measured_times_are_within_a_tick_after_the_equations():
    found = rows()
    kp, kv, tolerance, tick = (float(found[column].iloc[0]) for column in ("kp", "kv", "tolerance", "dt_s"))
    laws = set(found["contender"]) & set(EQUATIONS)
    assert laws
    for name in laws:
        own = found[(found["contender"] == name) & (found["outcome"] == "settled")]
        within = own[own["angle0_rad"].between(LEAST_RAD, math.pi - NEAREST_RAD)]
        for one in within.iloc[:: max(1, len(within) // 12)].itertuples():
            expected = settling(EQUATIONS[name], one.angle0_rad, kp, kv, tolerance)
            assert -1e-6 < one.settling_time_s - expected < tick + 1e-6


def test_dead_points_are_where_the_laws_are_known_to_fail():
    found = cells.directed_starts(comparison.ideal(RUN))
    lost = found[found["outcome"] != "settled"].set_index("contender")
    on_half_turn, on_pole = math.pi - lost["angle0_rad"] < EXACT_RAD, math.pi / 2.0 - lost["beta0"].abs() < EXACT_RAD
    assert on_half_turn["rotation-matrix"].all()
    assert on_pole["feedback-linearized/zyx-euler"].all()


def test_an_orientation_counts_once_whatever_the_sign_of_its_quaternion():
    turns = pd.DataFrame([(0.6, 0.8, 0.0, 0.0), (-0.6, -0.8, 0.0, 0.0)], columns=[f"quat_{one}" for one in "wxyz"])
    assert len(cells.orientation(turns).drop_duplicates()) == 1


def test_negative_controls_fail_as_they_must():
    found = rows()
    literal, unwinding = (found[found["contender"] == name] for name in families.CONTROLS)
    assert not (literal["outcome"] == "settled").any()
    if len(unwinding):  # not in a run from before it was written
        is_near = unwinding["angle0_rad"] < 2.0 * math.pi / (1.0 + 1.5)
        assert (unwinding.loc[is_near, "path_ratio"] > 1.5).all()


class Unperturbed(Run):
    """A run without a row on perturbations."""

    def any_rows(self, table, **words):
        return super().any_rows(table, **words).iloc[: 0 if table == "robustness" else None]


def test_page_says_so_where_there_are_no_rows_at_equal_peak():
    run = Unperturbed(RESULTS / "reference")
    assert comparison.tables(run)["at_peak"] is None
    assert "peak_starts" not in comparison.facts(run)
