"""Maps: every start is counted once, in its cell; lost ones are lost when run by themselves; stretches add up."""

import dataclasses
import math

import numpy as np
import pandas as pd
import pytest

from bench.cli import main
from bench.experiments.experiment import rows_of
from bench.experiments.map import MOST_LOST, cells, fold, plan_of
from bench.experiments.tables.schema import table_of
from bench.experiments.tables.store import as_table, read
from bench.findings.maps import by_law, counted, lost_between, lost_share
from bench.law.contenders.registry import find_contender
from bench.running import run
from tasks.random_starts import BLOCK, block
from tasks.truth import angle

LAW = find_contender("rotation-matrix")


def part_of(plan, first, count):
    [unit] = plan.units
    return rows_of(plan.request, dataclasses.replace(unit, first=first, count=count))


@pytest.fixture(scope="module")
def plan():
    """Two blocks and a bit, so short that most starts are lost."""
    return plan_of([LAW], 2 * BLOCK + 500, seed=11, horizon_s=1.2, dt_s=5e-3)


@pytest.fixture(scope="module")
def whole(plan):
    return rows_of(plan.request, plan.units[0])


def test_every_start_is_in_one_cell(plan, whole):
    found = whole[whole["row"] == "cell"]
    assert found["starts"].sum() == plan.units[0].total
    assert not found.duplicated(["ring_deg", "band", "azimuth"]).any()
    assert 0 < found["settled"].sum() < plan.units[0].total
    quats = block(0, seed=11)[0][:50]
    for quat, ring in zip(quats.tolist(), cells(quats)[0], strict=True):
        assert ring <= math.degrees(angle(quat, (1.0, 0.0, 0.0, 0.0))) < ring + 5


def test_stretches_add_up_to_the_whole(plan, whole):
    parts = [part_of(plan, *stretch) for stretch in ((0, BLOCK), (BLOCK, BLOCK), (2 * BLOCK, 500))]
    for made in (fold(fold(*parts[:2]), parts[2]), fold(parts[0], fold(*parts[1:]))):
        assert as_table(made, table_of("map")).equals(as_table(whole, table_of("map")))


def test_first_lost_starts_are_kept_and_the_slowest_of_each_ring(plan, whole):
    lost, slowest = (whole[whole["row"] == row] for row in ("lost", "slowest"))
    assert len(lost) == MOST_LOST
    assert (lost["outcome"] != "settled").all()
    first = part_of(plan, 0, int(lost["start"].max()) + 1)
    counted = first[first["row"] == "cell"]
    assert counted["starts"].sum() - counted["settled"].sum() == MOST_LOST
    latest = whole[whole["row"] == "cell"].groupby("ring_deg")["settling_time_s"].max().dropna()
    pd.testing.assert_series_equal(slowest.set_index("ring_deg")["settling_time_s"].sort_index(), latest)


def test_command_goes_on_and_says_the_share(tmp_path, capsys):
    words = ["map", "--regulator", "gibbs", "--starts", "300", "--horizon", "2", "--dt", "0.005", "--spin", "20"]
    assert main([*words, "--out", str(tmp_path / "map")]) == 0
    first = capsys.readouterr().out
    assert "gibbs" in first
    assert [path.name for path in (tmp_path / "map").glob("*.parquet")] == ["map.parquet"]
    [line] = by_law(read(tmp_path / "map", "map")).to_dict("records")
    assert (line["law"], line["starts"], line["speed [rad/s]"]) == ("gibbs", 300, "0 to 20")
    assert main([*words, "--out", str(tmp_path / "map")]) == 0
    assert not run.run(
        plan_of([find_contender("gibbs")], 300, speeds=((0.0, 20.0),), horizon_s=2.0, dt_s=5e-3), tmp_path / "map"
    )


def test_stated_speed_is_the_speed_of_every_start(tmp_path, capsys):
    """Half a time constant is too short for any start to settle, so no coarser run agrees by chance."""
    words = ["map", "--regulator", "gibbs", "--starts", "50", "--horizon", "0.05", "--speed", "5", "--speed", "20"]
    assert main([*words, "--out", str(tmp_path / "map")]) == 0
    capsys.readouterr()
    kept = read(tmp_path / "map", "map")
    found = kept[kept["row"] == "lost"].groupby("most_speed")[["omega0_x", "omega0_y", "omega0_z"]]
    speeds = {speed: np.linalg.norm(own, axis=1) for speed, own in found}
    assert {speed: len(own) for speed, own in speeds.items()} == {5.0: 50, 20.0: 50}
    for speed, own in speeds.items():
        np.testing.assert_allclose(own, speed, rtol=1e-14)
    assert set(counted(kept)["lost"] + counted(kept)["unconverged"]) == {50}


def test_stated_speeds_and_a_range_exclude_each_other(capsys):
    assert main(["map", "--regulator", "gibbs", "--spin", "3", "--speed", "5"]) == 2
    assert "give one of the two" in capsys.readouterr().err


def test_share_is_exact_and_starts_that_do_not_converge_widen_its_interval():
    """3 lost and 2 that may be: the lower end is that of 3 of 1,000, the upper one that of 5."""
    found = lost_between(3, 2, 1000)
    assert found.value == pytest.approx(3 / 998)
    assert (found.low, found.high) == (lost_share(3, 1000).low, lost_share(5, 1000).high)
    # Clopper-Pearson of none of n: the upper end is 1 - 0.025^(1/n)
    np.testing.assert_allclose(lost_share(0, 1000), (0.0, 0.0, 1.0 - 0.025 ** (1.0 / 1000)), rtol=1e-9)
