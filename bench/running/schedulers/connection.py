"""The way to a Dask cluster: one of processes of this machine, started here, or one that is there already."""

import contextlib
import logging
import sys
from collections.abc import Callable, Iterator

import distributed
from dask import config
from tornado.ioloop import PeriodicCallback

from bench.base.errors import LostWorkers, MissingTool
from bench.running.schedulers import LOCAL, worker

LOSSES = 3
"""Workers that a chunk may lose before it is taken apart: Dask's default, set on a local cluster too."""

ANSWER_S = 10.0
"""How long a scheduler may take to answer."""

STARTS = 3
"""Times that a local cluster is started before it is given up."""

EMPTY_S = 10.0
"""Between two looks for workers, and two lines while there is none."""

logging.getLogger("distributed").setLevel(logging.CRITICAL)
"""What goes wrong is said by our errors; of a lost worker there is nothing to say, for another takes its chunk."""


@contextlib.contextmanager
def client_of(word: str) -> Iterator[distributed.Client]:
    """Open a client of the cluster that the word names; a local one lives as long as this.

    Args:
        word: local:N, or the address of a scheduler.
    Errors:
        MissingTool: no scheduler answers there.
    """
    if not word.startswith(LOCAL):
        try:
            client = distributed.Client(word, timeout=ANSWER_S, set_as_default=False)
        except OSError as error:
            raise MissingTool(
                f"--scheduler {word}: no Dask scheduler answers there (start one: dask scheduler; or try local:2)"
            ) from error
        with client:
            yield client
        return
    # A worker is a process of one thread: compiling and the making of rows hold Python's lock.
    alone = {"threads_per_worker": 1, "host": "127.0.0.1", "dashboard_address": "127.0.0.1:0", "memory_limit": None}
    quiet = {"silence_logs": logging.CRITICAL, "preload": [worker.__name__]}
    count = int(word.removeprefix(LOCAL))
    with (
        config.set({"distributed.scheduler.allowed-failures": LOSSES}),
        started(lambda: distributed.LocalCluster(n_workers=count, **alone, **quiet)) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


def started(make: Callable[[], distributed.LocalCluster], starts: int = STARTS) -> distributed.LocalCluster:
    """Return a local cluster all of whose workers have started; made again where one was killed meanwhile."""
    try:
        return make()
    except RuntimeError as error:  # Dask's, of a process that ended before it answered
        if starts > 1:
            return started(make, starts - 1)
        raise LostWorkers(
            f"a worker process ended {STARTS} times before it had started ({error}); free memory, or take fewer "
            "processes"
        ) from error


@contextlib.contextmanager
def told_while_empty(client: distributed.Client, every_s: float = EMPTY_S) -> Iterator[None]:
    """Print a line now and then while there is no worker."""

    async def look() -> None:
        with contextlib.suppress(OSError):  # the run says that the scheduler is lost
            if not await client.scheduler.ncores():
                print("no worker has joined the scheduler; waiting (start one: dask worker ADDRESS)", file=sys.stderr)

    looks = PeriodicCallback(look, 1e3 * every_s)
    client.loop.add_callback(looks.start)
    try:
        yield
    finally:
        client.loop.add_callback(looks.stop)
