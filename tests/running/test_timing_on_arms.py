"""Timing on arms: what is timed, the loop in numpy against ours, the rows. No time is asserted."""

import numpy as np
import pytest
from support.bits import EPS
from support.on_arms import ARMS, here, named, torques

import tasks
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS
from bench.running import timing
from bench.running.timing import controller, dm_control_loop, on_arms, threads
from bench.running.timing.benchmark import DM_CONTROL, ENGINE, KERNEL, ROLLOUT, THREADS, Benchmark
from bench.running.timing.rows import QUICK_PASSES, frame

LAWS = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]


@pytest.mark.parametrize("arm", ARMS)
def test_loop_in_numpy_commands_the_torques_of_the_controller_it_stands_for(arm):
    start = tasks.start_set("tumbling", 3, arm=arm)[2]
    environment = tasks.load(on_arms.TASK, start=start, arm=arm)
    environment.reset()
    controller = dm_control_loop.Controller(environment.physics, start, PAPERS_GAINS)
    given = controller.torques()
    at = here(arm, start.q, start.qdot)
    expected, _ = torques(named(arm, on_arms.IN_NUMPY), at, start.goal_wxyz, at.chain.p, PAPERS_GAINS)
    # two solutions of J x = a, one of them by the normal equations on seven joints
    condition = np.linalg.cond(at.J) ** (2 if at.n > 6 else 1)
    allowed = 100 * at.n**2 * EPS * condition * np.abs(expected).max()
    np.testing.assert_allclose(given, expected, rtol=0.0, atol=allowed)


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """A quick run of two laws on one arm: its rows."""
    folder = tmp_path_factory.mktemp("timings")
    return timing.read(timing.run(LAWS, folder, quick=True, arms=("ur5e",)))


def test_every_controller_of_the_default_suite_with_these_laws_is_timed_on_the_arm(quick):
    own = quick[(quick.arm == "ur5e") & (quick.what == ENGINE)]
    timed = own[own.engine == "native"]
    names = set(zip(timed.regulator, timed.jacobian, timed.inverse, strict=True))
    assert names == {(one.regulator.name, *one.way) for one in on_arms.controllers(LAWS, "ur5e")}
    assert {("rotation-matrix", "geometric", "solve"), ("linearized-euler", "geometric", "solve")} < names
    assert (own.engine == ROLLOUT).sum() == (own.engine == DM_CONTROL).sum() == 1
    assert (own.passes == QUICK_PASSES).all()


def test_controller_alone_commands_the_torques_of_the_equations():
    one, start = named("ur5e", on_arms.IN_NUMPY), tasks.start_set("clear", 8, arm="ur5e")[-1]
    benchmark = controller.controller(on_arms.TASK, "ur5e", one, start)
    _, world, _ = benchmark.call()
    last = controller.states(start)[-1]
    at = here("ur5e", last[:6], last[6:12])
    expected, _ = torques(one, at, last[12:], at.chain.p, PAPERS_GAINS)
    np.testing.assert_allclose(world.work.buffers.tau, expected, rtol=1e-9)
    assert benchmark.ticks == controller.SWEEPS * controller.STATES


def test_ratios_are_where_there_is_something_to_compare_with(quick):
    timed = quick.ticks > 0
    loops = (quick.what == ENGINE) & quick.engine.isin(["native", DM_CONTROL]) & timed
    assert (quick.ratio_rollout.notna() == loops).all()
    assert (quick.speedup.notna() == ((quick.engine == DM_CONTROL) | (quick.what == THREADS))).all()


def test_two_threads_are_a_row_of_their_own(quick):
    [row] = quick[quick.what == THREADS].itertuples()
    assert (row.arm, row.regulator, row.engine) == (threads.ARM, "rotation-matrix", "native")
    assert row.passes == threads.QUICK_REPETITIONS
    assert row.speedup_low <= row.speedup <= row.speedup_high


def test_tables_keep_the_free_body_and_the_arms_apart(quick):
    laws, arms = timing.table(quick), timing.arm_table(quick)
    assert list(laws.law) == [*(one.name for one in LAWS), "(empty loop)", "(mujoco.rollout)"]
    assert set(arms.arm) == {"ur5e"}
    assert len(arms) == (quick.arm == "ur5e").sum()
    assert all(isinstance(cell, str) for cell in arms.to_numpy().ravel())


def test_speed_up_is_taken_within_a_pass_over_the_same_controller_of_the_same_arm():
    one, other = named("ur5e", "rotation-matrix@geometric+solve"), named("ur5e", "rotation-matrix@geometric+transpose")
    benchmarks = [Benchmark(KERNEL, None, "", 10, print), Benchmark(ENGINE, None, ROLLOUT, 10, print)]
    seconds = [1.0, 2.0]
    for arm, factor in (("ur5e", 1.0), ("puma560", 10.0)):
        benchmarks += [
            Benchmark(ENGINE, None, ROLLOUT, 10, print, arm),
            *(Benchmark(ENGINE, each, "native", 10, print, arm) for each in (one, other)),
            Benchmark(ENGINE, one, DM_CONTROL, 10, print, arm),
        ]
        seconds += [factor * x for x in (3.0, 4.5, 4.0, 90.0)]
    rows = frame(benchmarks, np.outer((1.0, 5.0, 0.5, 2.0, 3.0, 1.0, 7.0), seconds))
    for arm in ("ur5e", "puma560"):
        own = rows[rows.arm == arm].set_index(["engine", "inverse"])
        assert own.loc[("native", "solve"), "ratio_rollout"] == pytest.approx(1.5)
        assert own.loc[(DM_CONTROL, "solve"), "ratio_rollout"] == pytest.approx(30.0)
        assert own.loc[(DM_CONTROL, "solve"), ["speedup", "speedup_low", "speedup_high"]].tolist() == [20.0] * 3


def test_controller_that_fails_at_once_is_a_row_without_a_time():
    one, start = named("jaco", "rotation-matrix@geometric+transpose"), tasks.start_set("wrist", arm="jaco")[0]
    assert on_arms.native("jaco", one, start=start, fewest=10**6).ticks == 0
