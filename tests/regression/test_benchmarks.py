"""What the benchmarks time is what they say: the kernel's arithmetic, states, torques; and two processes take turns."""

import socket
import threading

import numpy as np
import pytest
from benchmarks import arm_loops, controller_alone, law_alone, reference_kernel
from benchmarks.turns import OTHER_ENDED, Turns
from scipy.stats import binom
from support.on_arms import here, named, torques

import tasks
from bench.experiments.tables.statistics import order_interval
from bench.law.contender import Contender
from bench.law.inputs import PAPERS_GAINS
from bench.law.kinds import Law, UserFile
from bench.law.scalar import kernel, sqrt


def test_reference_kernel_is_the_same_arithmetic_as_ever():
    plain = reference_kernel.chain(reference_kernel.START, reference_kernel.STEPS)
    tolerance = {"rel": 0, "abs": reference_kernel.TOLERANCE}
    assert plain == pytest.approx(1.599255347080933, **tolerance)
    assert reference_kernel.run() == pytest.approx(reference_kernel.RESULT, **tolerance)


def test_law_is_timed_on_rotations_with_a_goal_of_their_own():
    states = law_alone.states()
    R = states[:, :9].reshape(-1, 3, 3)
    R_d = states[:, 12:].reshape(-1, 3, 3)
    identity = np.broadcast_to(np.eye(3), R.shape)
    np.testing.assert_allclose(R @ R.transpose(0, 2, 1), identity, rtol=0, atol=1e-14)
    np.testing.assert_allclose(R_d @ R_d.transpose(0, 2, 1), identity, rtol=0, atol=1e-14)
    assert len(np.unique(states, axis=0)) == law_alone.STATES


def test_round_has_every_state_in_each_block_in_an_order_that_its_number_decides():
    def shuffled(number):
        law_alone.shuffle(number)
        return law_alone.shared_rows().copy()

    first = shuffled(1)
    blocks = first.reshape(law_alone.BLOCKS, law_alone.STATES, -1)
    for columns in (slice(0, law_alone.GOAL), slice(law_alone.GOAL, None)):
        expected = np.unique(law_alone.states()[:, columns], axis=0)
        for block in blocks:
            np.testing.assert_array_equal(np.unique(block[:, columns], axis=0), expected)
    assert (first != shuffled(2)).any()
    np.testing.assert_array_equal(first, shuffled(1))


@kernel
def not_a_number(R, omega, goal, gains):
    return (sqrt(-1.0 - R.n[0] * R.n[0]), omega[1], omega[2])


def test_law_without_a_finite_command_has_no_ticks():
    failing = Contender(Law("failing", "", "", "", law=not_a_number, file=UserFile(__file__)))
    assert law_alone.law_alone(failing).ticks == 0


def test_controller_alone_commands_the_torques_of_the_equations():
    law = named("ur5e", "rotation-matrix@geometric+standard")
    start = tasks.start_set("clear", 8, arm="ur5e")[-1]
    subject = controller_alone.controller_alone(arm_loops.TASK, "ur5e", law, start)
    _, world, _ = subject.call()
    last = controller_alone.states(start)[-1]
    at = here("ur5e", last[:6], last[6:12])
    expected, _ = torques(law, at, last[12:], at.chain.p, PAPERS_GAINS)
    np.testing.assert_allclose(world.work.buffers.tau, expected, rtol=1e-9)
    assert subject.ticks == controller_alone.SWEEPS * controller_alone.STATES


def test_controller_that_fails_at_once_has_no_ticks():
    law = named("jaco", "rotation-matrix@geometric+transpose")
    start = tasks.start_set("wrist", arm="jaco")[0]
    assert arm_loops.arm_loop("jaco", law, start=start, fewest_ticks=10**6).ticks == 0


def test_ratio_is_taken_within_a_round_whatever_the_machine_does_between():
    drift = np.array([1.0, 5.0, 0.5, 2.0, 3.0, 1.0, 7.0])
    compared = reference_kernel.compare(3e-8 * drift, 1e-8 * drift)
    assert compared["kernel_steps"] == pytest.approx([3.0, 3.0, 3.0])
    assert compared["kernel_ns"] == pytest.approx(20.0)


@pytest.mark.parametrize("rounds", [6, 7, 20, 31, 61, 400])
def test_interval_of_the_median_covers_95_percent_and_no_more_than_needed(rounds):
    low, high = order_interval(rounds, 0.5)
    assert low + high == rounds - 1
    assert 1 - 2 * binom.cdf(low, rounds, 0.5) >= 0.95
    assert 1 - 2 * binom.cdf(low + 1, rounds, 0.5) < 0.95


@pytest.fixture
def both():
    """The turns of two processes, the first one's first."""
    ends = socket.socketpair()
    made = [Turns(end.detach(), is_first=at == 0) for at, end in enumerate(ends)]
    yield made
    for turns in made:
        turns.line.close()


def test_two_processes_take_turns_in_each_benchmark_and_end_with_an_empty_line(both):
    worked = []

    def work(name, turns):
        for benchmark in range(3):
            assert turns.exchange([name]) != [name]
            turns.begin()
            for _ in range(4):
                turns.wait()
                worked.append((benchmark, name))
                turns.give()
            turns.end()

    thread = threading.Thread(target=work, args=("second", both[1]))
    thread.start()
    work("first", both[0])
    thread.join(60)
    expected = []
    for benchmark in range(3):
        expected += [(benchmark, "first"), (benchmark, "second")] * 4
    assert worked == expected


def test_process_that_lost_the_other_one_ends_with_a_code_of_its_own(both):
    turns, other = both
    other.line.close()
    with pytest.raises(pytest.exit.Exception) as caught:
        turns.exchange([1])
    assert caught.value.returncode == OTHER_ENDED
    with pytest.raises(pytest.exit.Exception):
        turns.wait()


def test_process_that_is_alone_always_has_the_turn():
    turns = Turns(None, is_first=False)
    assert turns.is_alone
    assert turns.exchange([True]) == [True]
    turns.begin()
    turns.wait()
    turns.give()
    turns.end()
