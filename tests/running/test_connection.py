"""A local cluster that does not start, and a cluster without workers."""

import threading

import pytest

from bench.base.errors import LostWorkers
from bench.running.schedulers import connection


@pytest.mark.parametrize("losses", [1, connection.STARTS])
def test_local_cluster_whose_worker_is_killed_at_its_start_is_started_again(losses):
    left = [RuntimeError("Nanny failed to start worker process")] * losses

    def make():
        if left:
            raise left.pop()
        return "cluster"

    if losses < connection.STARTS:
        assert connection.started(make) == "cluster"
    else:
        with pytest.raises(LostWorkers, match="ended 3 times before it had started"):
            connection.started(make)


def test_line_is_printed_while_there_is_no_worker(capsys):
    looks, seen = iter([1, 0]), threading.Event()

    def count():
        found = next(looks, None)
        if found is None:
            seen.set()
            raise OSError
        return found

    with connection.told_while_empty(count, every_s=0.001):
        assert seen.wait(60.0)
    assert capsys.readouterr().err.count("no worker has joined the scheduler; waiting") == 1
