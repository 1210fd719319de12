"""Timing: the order of the passes, the reference kernel, ratios, rows, a user's law apart. No time is asserted."""

import functools

import numpy as np
import pytest
from scipy.stats import binom
from support.command_line import bench
from support.on_arms import here, named, torques
from support.user_law import spring_text

import tasks
from bench.base.errors import BadLaw
from bench.base.provenance import machine_key
from bench.cli.time import folder_for
from bench.law.contender import Contender
from bench.law.contenders.described_law import described
from bench.law.contenders.registry import contenders_of, find_contender
from bench.law.inputs import PAPERS_GAINS
from bench.law.kinds import Law, UserFile
from bench.law.scalar import kernel, sqrt
from bench.running import timing
from bench.running.timing import benchmarks, controller, law, on_arms, reference_kernel
from bench.running.timing.benchmark import ENGINE, KERNEL, LAW, LOOP, Benchmark
from bench.running.timing.ratios import order_interval, ratio
from bench.running.timing.rows import QUICK_PASSES, frame, measure, order

LAWS = ("rotation-matrix", "linearized-euler/zyx-euler")
CONTENDERS = [find_contender(word) for word in LAWS]


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """A quick run of two laws, on one arm too: its file, and what it told of its samples."""
    told, folder = [], tmp_path_factory.mktemp("timings")
    path = timing.run(CONTENDERS, folder, quick=True, report=told.append, arms=("ur5e",))
    assert [one.name for one in told if one.total == 0] == [*LAWS, "ur5e"]
    return path, [one for one in told if one.total]


def benchmark(name, call=lambda: None, ticks=10):
    regulator = Law(name, "", "", "", law=None)
    return Benchmark(LAW, Contender(regulator), "", ticks, call)


def three(drift):
    """A kernel of 1 and a native loop of 3 s a sample, each pass slowed by its drift."""
    every = [
        Benchmark(KERNEL, None, "", 10, lambda: None),
        benchmark("one")._replace(what=ENGINE, engine="native"),
    ]
    return every, np.outer(drift, (1.0, 3.0))


def test_reference_kernel_is_the_same_arithmetic_as_ever():
    given = reference_kernel.START, reference_kernel.STEPS
    tolerance = {"rel": 0, "abs": reference_kernel.TOLERANCE}
    assert reference_kernel.chain(*given) == pytest.approx(1.599255347080933, **tolerance)
    assert reference_kernel.compiled()(*given) == pytest.approx(reference_kernel.RESULT, **tolerance)


def test_every_pass_visits_everything_once_in_an_order_of_its_own():
    passes = order(9, 5, seed=0)
    assert all(sorted(one) == list(range(9)) for one in passes)
    assert len({tuple(one) for one in passes}) == 5
    assert order(9, 5, seed=0) == passes
    assert order(9, 5, seed=1) != passes


def test_run_visits_everything_in_every_pass(quick):
    _, told = quick
    each = len(told) // QUICK_PASSES
    passes = [[one.name for one in told[k * each : (k + 1) * each]] for k in range(QUICK_PASSES)]
    assert all(sorted(names) == sorted(passes[0]) for names in passes)
    on_arm = len(on_arms.controllers(CONTENDERS, "ur5e")) + len(LAWS)
    assert len(set(passes[0])) == each == 1 + len(LAWS) + 3 * len(LAWS) + 1 + on_arm
    assert len({tuple(names) for names in passes}) > 1
    assert [one.done for one in told] == list(range(1, len(told) + 1))
    assert {one.total for one in told} == {len(told)}


def test_file_is_named_after_the_machine_and_says_where_it_comes_from(quick):
    path, _ = quick
    assert path.name == f"{machine_key()}.parquet"
    about = timing.about(path)
    assert {"commit", "dirty", "versions", "cpu", "date"} <= set(about)
    assert about["quick"] is True


def test_file_has_one_row_of_times_for_everything_timed(quick):
    every = timing.read(quick[0])
    rows = every[every.arm == ""]
    keys = set(zip(rows.what, rows.engine, rows.regulator, rows.representation, strict=True))
    laws = [tuple(f"{word}/".split("/")[:2]) for word in LAWS]
    expected = {(LAW, "", *one) for one in laws} | {(LOOP, "", "", "")}
    expected |= {(ENGINE, engine, *one) for engine in benchmarks.ENGINES for one in laws}
    assert keys == expected
    assert len(rows) == len(keys)
    assert (every[["ns_per_tick", "ns_reference_kernel", "ratio_low", "ticks"]] > 0).all(axis=None)
    assert every.ratio.between(every.ratio_low, every.ratio_high).all()
    assert ((every.passes == QUICK_PASSES) & (every.ns_reference_kernel == every.ns_reference_kernel[0])).all()


def test_tables_have_a_line_for_each_law_one_for_comparison_and_the_arms_apart(quick):
    rows, made = timing.read(quick[0]), dict(timing.tables(quick[0]))
    assert set(made) == {"", "ur5e"}
    assert list(made[""].law) == [*LAWS, "(empty loop)"]
    assert made[""].equals(dict(timing.tables(rows))[""])
    assert all(isinstance(cell, str) for cell in made[""].to_numpy().ravel())
    assert list(made["ur5e"].columns[:2]) == ["law", "native [ns]"]
    assert len(made["ur5e"]) == ((rows.arm == "ur5e") & (rows.engine == "native")).sum()


def test_ratio_is_taken_within_a_pass_whatever_the_machine_does_between():
    rows = frame(*three(drift=(1.0, 5.0, 0.5, 2.0, 3.0, 1.0, 7.0))).set_index("engine")
    assert rows.loc["native", ["ratio", "ratio_low", "ratio_high"]].tolist() == [3.0, 3.0, 3.0]
    assert rows.loc["native", "ns_per_tick"] == 0.6e9  # in the middle one of the passes


@pytest.mark.parametrize("passes", [6, 7, 20, 31, 61, 400])
def test_interval_of_the_median_covers_95_percent_and_no_more_than_needed(passes):
    low, high = order_interval(passes, 0.5)
    assert low + high == passes - 1
    assert 1 - 2 * binom.cdf(low, passes, 0.5) >= 0.95
    assert 1 - 2 * binom.cdf(low + 1, passes, 0.5) < 0.95
    assert ratio(np.array([3.0, 1.0, 2.0]), np.ones(3)) == (2.0, 1.0, 3.0)  # of few passes the whole range


def test_law_is_timed_on_rotations_with_a_goal_of_their_own():
    states = law.states()
    R, R_d = states[:, :9].reshape(-1, 3, 3), states[:, 12:].reshape(-1, 3, 3)
    identity = np.broadcast_to(np.eye(3), R.shape)
    np.testing.assert_allclose(R @ R.transpose(0, 2, 1), identity, rtol=0, atol=1e-14)
    np.testing.assert_allclose(R_d @ R_d.transpose(0, 2, 1), identity, rtol=0, atol=1e-14)
    assert len(np.unique(states, axis=0)) == law.STATES


@kernel
def not_a_number(R, omega, goal, gains):
    return (sqrt(-1.0 - R.n[0] * R.n[0]), omega[1], omega[2])


def test_law_without_a_finite_command_is_a_row_without_a_time():
    failing = Contender(Law("failing", "", "", "", law=not_a_number, file=UserFile(__file__)))
    one = benchmarks._law(LAW, failing)
    assert one.ticks == 0
    every, seconds = three(drift=np.ones(7))
    rows = frame([*every, one], np.column_stack((seconds, np.ones(7))))
    assert rows[["ns_per_tick", "ratio"]].iloc[-1].isna().all()
    assert dict(timing.tables(rows))[""].iloc[-1]["alone [ns]"] == "fails"


def test_measuring_calls_each_for_two_rounds_on_end_in_every_pass():
    called = []
    seconds = measure([benchmark(name, functools.partial(called.append, name)) for name in "abc"], passes=3)
    assert called[::2] == called[1::2] == ["abc"[at] for row in order(3, 3) for at in row]
    assert seconds.shape == (3, 3)
    assert np.isfinite(seconds).all()


def test_only_a_whole_run_writes_unasked_where_files_are_tracked():
    found = [folder_for((), (), quick).name for quick in (False, True)] + [folder_for((), ("gibbs",), False).name]
    assert found == ["timings", "timings-partial", "timings-partial"]


def test_timings_go_into_the_folder_that_is_named(capsys, tmp_path):
    words = ("--quick", "--regulator", "gibbs", "--arm", "ur5e", "--out", tmp_path / "mine")
    assert bench(capsys, "time", *words).code == 0
    assert len(list((tmp_path / "mine").glob("*.parquet"))) == 1


def contenders(tmp_path, *lines):
    """A law of ours, and one of a user's with these lines."""
    path = tmp_path / "own.py"
    path.write_text(spring_text(*lines))
    return [find_contender("rotation-matrix"), *contenders_of(described(path))]


def test_law_of_a_user_is_timed_beside_ours(tmp_path):
    told = []
    path = timing.run_apart(contenders(tmp_path), tmp_path / "timings", quick=True, report=told.append)
    rows = timing.read(path)
    assert {"mine", "rotation-matrix"} <= set(rows["regulator"].astype(str))
    assert {one.name for one in told if one.total == 0} == {"mine", "rotation-matrix"}
    assert told[-1].done == told[-1].total > 0


def test_law_that_ends_its_process_is_refused(tmp_path):
    made = contenders(tmp_path, "if R.n[0] < 2.0 and omega[0] == omega[0]: os._exit(0)")
    with pytest.raises(BadLaw, match=r"own\.py"):
        timing.run_apart(made, tmp_path / "timings", quick=True)
    assert not (tmp_path / "timings").exists()


def test_every_controller_of_the_default_suite_with_these_laws_is_timed_on_the_arm(quick):
    rows = timing.read(quick[0])
    timed = rows[(rows.arm == "ur5e") & (rows.what == ENGINE) & (rows.engine == "native")]
    names = set(zip(timed.regulator, timed.jacobian, timed.inverse, strict=True))
    assert names == {(one.regulator.name, *one.way) for one in on_arms.controllers(CONTENDERS, "ur5e")}
    assert {("rotation-matrix", "geometric", "solve"), ("linearized-euler", "geometric", "solve")} < names


def test_controller_alone_commands_the_torques_of_the_equations():
    one, start = named("ur5e", "rotation-matrix@geometric+standard"), tasks.start_set("clear", 8, arm="ur5e")[-1]
    benchmark = controller.controller(on_arms.TASK, "ur5e", one, start)
    _, world, _ = benchmark.call()
    last = controller.states(start)[-1]
    at = here("ur5e", last[:6], last[6:12])
    expected, _ = torques(one, at, last[12:], at.chain.p, PAPERS_GAINS)
    np.testing.assert_allclose(world.work.buffers.tau, expected, rtol=1e-9)
    assert benchmark.ticks == controller.SWEEPS * controller.STATES


def test_controller_that_fails_at_once_is_a_row_without_a_time():
    one, start = named("jaco", "rotation-matrix@geometric+transpose"), tasks.start_set("wrist", arm="jaco")[0]
    assert on_arms.native("jaco", one, start=start, fewest=10**6).ticks == 0
