"""Curves that the compiled loops keep: the samples that metrics see, at the right ticks; rows stay as they are."""

import numpy as np
import pytest
from support.bits import different_rows, same_bits
from support.driving import ARM_METRICS, METRICS, recorder, settings

import tasks
from bench.engines.curve import ARM_NUMBERS, NUMBERS, blank_curves
from bench.engines.episode import TICKS
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm
from bench.law.contenders import combinations
from bench.law.contenders.registry import find_contender

LAW, ARM = "feedback-linearized/zyx-euler", "puma560"
CHOSEN = settings(horizon_s=0.1)


def flat(sample) -> tuple:
    """A sample's numbers in a curve's order."""
    return (sample.time, *sample.R.n, *sample.R.o, *sample.R.a, *sample.omega, *sample.u, sample.haversine)


def free_body(curves, engine="native"):
    """Rows of four starts, into curves."""
    starts = tasks.start_set("uniform", 4)
    return run(engine, find_contender(LAW), "free-body", starts, CHOSEN, METRICS, curves=curves)


@pytest.mark.parametrize("every", [1, 3])
def test_curve_is_what_dm_controls_loop_shows_a_metric_bit_for_bit(every):
    curves = blank_curves(4, 100 // every, every)
    free_body(curves)
    for start, curve in zip(tasks.start_set("uniform", 4), curves.samples, strict=True):
        kept = []
        run("reference", find_contender(LAW), "free-body", [start], CHOSEN, [recorder(kept)])
        assert len(kept) == CHOSEN.ticks
        assert same_bits(curve, [flat(sample) for sample in kept[::every]][: 100 // every])


def test_curve_of_an_arm_is_what_dm_controls_loop_shows_a_metric_bit_for_bit():
    [one] = combinations.on((f"{LAW}@analytic+solve",), {LAW: find_contender(LAW)}, 6)
    starts = tasks.start_set("clear", 2, arm=ARM)
    curves = blank_curves(2, 10, 5, ARM_NUMBERS)
    given = "arm-regulation", ARM, starts, settings(horizon_s=0.05)
    run_arm("native", one, *given, ARM_METRICS, curves=curves)
    kept = []
    run_arm("reference", one, *given, [recorder(kept)])
    expected = []
    for sample in kept[::5]:
        away = np.subtract(sample.p, sample.p_d)
        expected.append((*flat(sample), np.sqrt(away[0] * away[0] + away[1] * away[1] + away[2] * away[2]), *sample.q))
    assert same_bits(curves.samples.reshape(20, -1), expected)


@pytest.mark.parametrize("engine", ["ideal-rk4", "ideal-held", "native"])
def test_rows_are_the_same_with_curves_and_without(engine):
    assert different_rows(free_body(blank_curves(4, 7, 2), engine), free_body(blank_curves(4), engine)) == []


def test_samples_after_the_end_stay_unfilled_and_there_are_no_more_than_there_is_room_for():
    curves = blank_curves(4, 50, 10)
    rows = free_body(curves)
    filled = np.isfinite(curves.samples[:, :, NUMBERS.index("time_s")])
    assert filled.sum(axis=1).tolist() == np.ceil(rows[:, TICKS] / 10).tolist() == [10] * 4
    assert not filled[:, 10:].any()
    curves = blank_curves(4, 3, 2)
    free_body(curves)
    assert curves.samples[:, :, 0].tolist() == [[0.0, 0.002, 0.004]] * 4
