"""Timing on arms: what is timed, the rows. No time is asserted."""

import numpy as np
import pytest
from support.on_arms import here, named, torques

import tasks
from bench.law.contenders.registry import find_contender
from bench.law.inputs import PAPERS_GAINS
from bench.running import timing
from bench.running.timing import controller, on_arms
from bench.running.timing.benchmark import ENGINE
from bench.running.timing.rows import QUICK_PASSES

LAWS = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]


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
    assert (own.passes == QUICK_PASSES).all()


def test_controller_alone_commands_the_torques_of_the_equations():
    one, start = named("ur5e", "rotation-matrix@geometric+standard"), tasks.start_set("clear", 8, arm="ur5e")[-1]
    benchmark = controller.controller(on_arms.TASK, "ur5e", one, start)
    _, world, _ = benchmark.call()
    last = controller.states(start)[-1]
    at = here("ur5e", last[:6], last[6:12])
    expected, _ = torques(one, at, last[12:], at.chain.p, PAPERS_GAINS)
    np.testing.assert_allclose(world.work.buffers.tau, expected, rtol=1e-9)
    assert benchmark.ticks == controller.SWEEPS * controller.STATES


def test_tables_keep_the_free_body_and_the_arms_apart(quick):
    made = dict(timing.tables(quick))
    assert list(made[""].law) == [*(one.name for one in LAWS), "(empty loop)"]
    assert set(made) == {"", "ur5e"}
    assert list(made["ur5e"].columns[:2]) == ["law", "native [ns]"]
    assert len(made["ur5e"]) == ((quick.arm == "ur5e") & (quick.engine == "native")).sum()


def test_controller_that_fails_at_once_is_a_row_without_a_time():
    one, start = named("jaco", "rotation-matrix@geometric+transpose"), tasks.start_set("wrist", arm="jaco")[0]
    assert on_arms.native("jaco", one, start=start, fewest=10**6).ticks == 0
