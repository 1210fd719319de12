"""A cluster carries out a plan, by units as JSON, with the bytes that threads make; what it says if it cannot."""

import dataclasses
import json
import os
import signal
import sys
import time
from collections import deque
from pathlib import Path

import distributed
import pytest
from support.unit_kinds import plan_of_all_kinds

from bench.base.errors import BadNumber, BadResults, LostWorkers, MissingTool, UnknownWord
from bench.base.files import read_json
from bench.experiments import plan as planning
from bench.experiments.experiment import experiment_of, known_experiments
from bench.experiments.request import Request
from bench.law.contenders.law_file import load_law
from bench.law.contenders.registry import find_contender
from bench.running import run, wire_format
from bench.running.run import in_running_order
from bench.running.run_folder import begin, part
from bench.running.sandbox.sandbox import Sandbox
from bench.running.schedulers import check_scheduler, cluster, kind, worker
from bench.running.schedulers.cluster import CHUNK_S, MOST_EPISODES, in_batches
from bench.running.wire_format import described


@pytest.fixture(scope="module")
def plan(tmp_path_factory):
    return plan_of_all_kinds(tmp_path_factory.mktemp("own"))


MADE = ("free-body", "arm", "costs", "springs")
"""Experiments whose rows a cluster makes here, and each week those of two more; all units are sent as theirs are."""


@pytest.fixture(scope="module", params=[(), pytest.param(("contact", "robustness"), marks=pytest.mark.weekly)], ids=len)
def few(plan, request):
    return dataclasses.replace(plan, units=plan.of(*MADE, *request.param))


@pytest.fixture(scope="module")
def client():
    """Two processes, asked through their address as any cluster is."""
    with cluster.client_of("local:2") as client:
        assert client.cluster.dashboard_link.startswith("http://127.0.0.1:")
        yield client


@pytest.fixture(scope="module")
def by_threads(few, tmp_path_factory):
    out = tmp_path_factory.mktemp("threads") / "run"
    run.run(few, out, workers=2)
    return tables(out)


def tables(out: Path) -> dict[str, bytes]:
    """The bytes of every table."""
    return {path.name: path.read_bytes() for path in out.glob("*.parquet")}


def test_run_goes_on_with_another_scheduler(few, client, by_threads, tmp_path):
    told = []

    def stop(unit):
        told.append(unit)
        if len(told) == 2:
            raise KeyboardInterrupt

    begin(few, tmp_path)
    chunks = cluster.Chunks(client, Sandbox(few), tmp_path, stop, ahead=1, waiting=deque((unit,) for unit in few.units))
    with pytest.raises(KeyboardInterrupt):
        chunks.carry_out([])
    assert all(part(tmp_path, unit).is_file() for unit in told)
    before = list((tmp_path / "parts").iterdir())
    assert 2 <= len(before) < len(few.units)
    assert run.run(few, tmp_path, workers=1)
    assert tables(tmp_path) == by_threads


def test_worker_of_other_sources_is_refused(plan, client):
    """What it raises comes to the client as it is."""
    text = json.dumps(described(plan, plan.units[:1]) | {"sources": 16 * "0"})
    with pytest.raises(BadResults, match=r"made by the sources 0000000000000000, .*; install the same commit"):
        client.submit(worker.carry_out, text).result()


def test_cluster_makes_the_bytes_that_threads_make_though_a_worker_is_killed(few, client, by_threads, tmp_path):
    pids, told = client.run(os.getpid), []

    def kill_one(unit):
        if not told:
            os.kill(next(iter(pids.values())), signal.SIGKILL)
        told.append(unit)

    run.run(few, tmp_path, scheduler=client.scheduler.address, report=kill_one)
    assert by_threads.keys() == {f"{name}.parquet" for name in few.tables}
    assert tables(tmp_path) == by_threads
    assert sorted(unit.key for unit in told) == sorted(unit.key for unit in few.units)
    assert set(client.run(os.getpid).values()) != set(pids.values())
    said = read_json(tmp_path / "provenance.json")
    assert (said["scheduler"], said["workers"]) == ("tcp", 2)


class Killed:
    """A chunk that lost all its workers."""

    status = "error"

    def result(self):
        raise cluster.distributed.KilledWorker("chunk", None, 3)


def test_chunk_that_lost_all_its_workers_is_taken_apart_and_its_unit_named(plan, tmp_path):
    chunks = cluster.Chunks(None, Sandbox(plan), tmp_path, None)
    future, (first, second) = Killed(), plan.units[:2]
    chunks.given[future] = (first, second)
    chunks.take(future)
    assert list(chunks.waiting) == [(first,), (second,)]
    chunks.given[future] = (second,)
    with pytest.raises(LostWorkers, match=f"unit {second.key}: each of 4 workers that ran it was lost"):
        chunks.take(future)


@pytest.mark.parametrize("losses", [1, cluster.STARTS])
def test_local_cluster_whose_worker_is_killed_at_its_start_is_started_again(losses):
    left = [RuntimeError("Nanny failed to start worker process")] * losses

    def make():
        if left:
            raise left.pop()
        return "cluster"

    if losses < cluster.STARTS:
        assert cluster.start_local(make) == "cluster"
    else:
        with pytest.raises(LostWorkers, match="ended 3 times before it had started"):
            cluster.start_local(make)


def test_line_is_printed_while_there_is_no_worker(capsys):
    with (
        distributed.LocalCluster(n_workers=0, host="127.0.0.1", dashboard_address=None) as made,
        distributed.Client(made, set_as_default=False) as client,
        cluster.print_while_empty(client, every_s=0.01),
    ):
        end, said = time.monotonic() + 60.0, ""
        while not said and time.monotonic() < end:
            time.sleep(0.05)
            said = capsys.readouterr().err
    assert "no worker has joined the scheduler; waiting" in said


def test_missing_dask_is_said_with_the_cure(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    check_scheduler("threads")
    with pytest.raises(MissingTool, match=r"needs Dask, which is not installed \(try: make setup-cluster"):
        check_scheduler("local:2")


def test_address_without_a_scheduler_is_refused_and_nothing_replaced(plan, tmp_path):
    with pytest.raises(MissingTool, match=r"--scheduler tcp://127.0.0.1:1: no Dask scheduler answers there"):
        run.run(plan, tmp_path / "new", scheduler="tcp://127.0.0.1:1")
    assert not (tmp_path / "new").exists()


@pytest.mark.parametrize("word", ["threads", "local:1", "local:256", "tcp://10.0.0.1:8786", "tls://[::1]:8786"])
def test_scheduler_is_known(word):
    check_scheduler(word)
    assert kind(word) in ("threads", "local", "tcp", "tls")


@pytest.mark.parametrize(
    ("error", "says", "words"),
    [
        (
            UnknownWord,
            "local:N, tcp://host:8786",
            ("", "dask", "local", "tcp://host", "tcp://:8786", "http://host:8786"),
        ),
        (BadNumber, "between 1 and 256 processes", ("local:", "local:0", "local:-1", "local:257", "local:two")),
    ],
)
def test_other_word_for_a_scheduler_is_refused(error, says, words):
    for word in words:
        with pytest.raises(error, match=says):
            check_scheduler(word)


def test_batches_keep_every_unit_in_its_order_and_of_little_work_leave_no_worker_idle(plan):
    for workers in (0, 1, 2, 100):
        assert [unit for chunk in in_batches(plan.units, workers) for unit in chunk] == list(plan.units)
    assert in_batches([], 2) == []
    assert len(in_batches(plan.units * 20, 2)) >= 8


@pytest.mark.parametrize("engine", ["ideal-rk4", "native"])
def test_batches_of_much_work_are_of_ten_to_sixty_seconds(engine):
    chunks = in_batches(units_of_much_work(engine), 2)
    lasting = [sum(experiment_of(unit).cost_s(unit) for unit in chunk) for chunk in chunks]
    assert min(lasting[:-1]) > 10.0
    assert max(lasting) <= CHUNK_S


def test_batches_of_fast_episodes_are_of_as_many_as_memory_holds():
    chunks = in_batches(units_of_much_work("ideal-held"), 1)
    assert {sum(unit.episodes for unit in chunk) for chunk in chunks} == {MOST_EPISODES}


def units_of_much_work(engine):
    request = Request(
        "default",
        (find_contender("rotation-matrix"),),
        count=300_000,
        tasks=("free-body",),
        start_sets=("uniform",),
        engines=(engine,),
        experiments=("free-body",),
    )
    return planning.make(request).units


def test_chunk_has_the_units_of_every_kind_and_they_arrive_as_they_were_sent(plan):
    assert {unit.experiment for unit in plan.units} == known_experiments().keys()
    carried = wire_format.plan_of(json.loads(json.dumps(wire_format.described(plan, plan.units))), load_law)
    assert carried.units == plan.units


def test_chunk_of_one_unit_carries_no_law_of_another(plan):
    assert len(wire_format.described(plan, plan.units)["request"]["user_laws"]) == 1
    assert wire_format.described(plan, plan.of("contact"))["request"]["user_laws"] == []


def test_first_unit_of_each_contender_runs_before_the_rest_of_the_one_before_it():
    laws = [find_contender(word) for word in ("rotation-matrix", "linearized-euler/zyx-euler")]
    beside = {"experiments": ("free-body", "contact", "robustness")}
    off_arms = planning.make(Request("quick", tuple(laws), count=4, **beside))
    on_arm = planning.make(Request("quick", tuple(laws), count=4, arms=("ur5e",)))
    units = (*off_arms.units, *on_arm.of("arm"))
    each = {name: [unit for unit in units if unit.contender == name] for name in [unit.contender for unit in units]}
    assert len(each) > 4
    assert all(len(own) > 1 for own in each.values())
    (first, *rest), *others = each.values()
    expected = [first]
    for head, *tail in others:
        expected += [head, *rest]
        rest = tail
    assert in_running_order(units) == [*expected, *rest]
    compiling_none = on_arm.of("costs", "jacobians")
    assert in_running_order((*compiling_none, *units)) == [*expected, *rest, *compiling_none]
