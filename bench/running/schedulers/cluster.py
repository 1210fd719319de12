"""Units carried out by a Dask cluster: of processes of this machine, or one that is there already.

Text travels to a worker (wire_format.py) and rows travel back (packed.py); the client writes them, so that no disk is
shared. A chunk takes a worker 10 to 60 s by what units usually cost: one of less is carried about more than worked on;
of one of more that is lost with its worker, and run again by another, more is done again.

Limitations: a unit that ends every worker that takes it ends the run.
"""

import contextlib
import json
import logging
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import distributed
from dask import config
from tornado.ioloop import PeriodicCallback

from bench.base.errors import LostWorkers, MissingTool
from bench.experiments.experiment import Unit, experiment_of
from bench.running.run_folder import part, write_part
from bench.running.sandbox.sandbox import Sandbox
from bench.running.schedulers import LOCAL, worker
from bench.running.wire_format import described

AHEAD = 2
"""Chunks given to each thread of a worker: one to work on and one that waits. Memory holds no more than their rows."""

GONE = "the scheduler is gone; what is done is kept (start it again and give the same command)"

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
    """Open a client of local:N, a cluster that lives as long as this, or of an address; MissingTool if none answers."""
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
        start_local(lambda: distributed.LocalCluster(n_workers=count, **alone, **quiet)) as cluster,
        distributed.Client(cluster, set_as_default=False) as client,
    ):
        yield client


def start_local(make: Callable[[], distributed.LocalCluster], starts: int = STARTS) -> distributed.LocalCluster:
    """Return a local cluster all of whose workers have started; made again where one was killed meanwhile."""
    try:
        return make()
    except RuntimeError as error:  # Dask's, of a process that ended before it answered
        if starts > 1:
            return start_local(make, starts - 1)
        cure = "free memory, or take fewer processes"
        raise LostWorkers(f"a worker process ended {STARTS} times before it had started ({error}); {cure}") from error


@contextlib.contextmanager
def print_while_empty(client: Any, every_s: float = EMPTY_S) -> Iterator[None]:
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


@dataclass
class Chunks:
    """Chunks on their way to workers and back: as many as keep them busy, and no more.

    sandbox: has the plan and limits, and takes what workers say of a law. done: called for each unit when it
    is written. ahead: how many each thread of a worker is given. threads: the most that were there. waiting: not given.
    """

    client: distributed.Client
    sandbox: Sandbox
    out: Path
    done: Callable[[Unit], None]
    ahead: int = AHEAD
    threads: int = 0
    waiting: deque[tuple[Unit, ...]] = field(default_factory=deque)
    given: dict[distributed.Future, tuple[Unit, ...]] = field(default_factory=dict)

    def carry_out(self, todo: Sequence[Unit]) -> int:
        """Give, take and write until all is done; return the most threads of workers that were there.

        BadResults: a worker has other sources. LostWorkers: a unit ended all that took it, or the scheduler is gone.
        """
        self.waiting.extend(in_batches(todo, self._present()))
        ended = distributed.as_completed(loop=self.client.loop)
        try:
            with print_while_empty(self.client):
                self.give(ended)
                for future in ended:
                    self.take(future)
                    self.give(ended)
        except BaseException:
            for future in [one for one in self.given if one.status == "finished"]:
                self.take(future)
            with contextlib.suppress(OSError):  # the scheduler may be what is lost
                self.client.cancel(list(self.given))
            raise
        return self.threads

    def _present(self) -> int:
        """Threads of the workers that are there now; others may come and go."""
        try:
            present = sum(self.client.nthreads().values())
        except OSError as error:
            raise LostWorkers(GONE) from error
        self.threads = max(self.threads, present)
        return present

    def give(self, ended: distributed.as_completed) -> None:
        """Send chunks as long as there is room; tell `ended` of each."""
        room = self.ahead * max(1, self._present())
        while self.waiting and len(self.given) < room:
            units = self.waiting.popleft()
            text = json.dumps(described(self.sandbox.plan, units))
            future = self.client.submit(worker.carry_out, text, self.sandbox.limit_s, pure=False)
            self.given[future] = units
            ended.add(future)

    def take(self, future: distributed.Future) -> None:
        """Write the rows of a chunk; resubmit a chunk that lost all its workers, unit by unit."""
        units = self.given[future]
        try:
            files, notes = future.result()
        except distributed.KilledWorker as error:
            if len(units) == 1:
                raise LostWorkers(
                    f"unit {units[0].key}: each of {error.allowed_failures + 1} workers that ran it was lost; what is "
                    "done is kept (give the workers more memory, or leave its law away, and run again)"
                ) from error
            self.waiting.extendleft((unit,) for unit in reversed(units))
            del self.given[future]
            return
        except ModuleNotFoundError as error:
            raise MissingTool(
                f"a worker has no {error.name}; install the same commit and lock on every machine of the cluster"
            ) from error
        except distributed.CancelledError as error:
            raise LostWorkers(GONE) from error
        self.sandbox.notes += [text for text in notes if text not in self.sandbox.notes]
        for unit in units:
            if unit.key not in files:
                self.sandbox.again.add(unit.key)
            elif not part(self.out, unit).is_file():  # it is there if Ctrl-C came while the chunk was written
                write_part(self.sandbox.plan, self.out, unit, files[unit.key])
                self.done(unit)
        del self.given[future]


CHUNK_S = 25.0
"""Seconds of a chunk: a unit may take 2.4 times what it usually does, or 0.4 of it, and stay within 10 to 60 s."""

ROUNDS = 4
"""Chunks that each worker has at least, so that none waits long for the last one of another."""

MOST_EPISODES = 50_000
"""Episodes of a chunk: 10 MB of rows, which the worker and then the client hold."""


def in_batches(units: Sequence[Unit], workers: int) -> list[tuple[Unit, ...]]:
    """Cut the units into chunks of at most CHUNK_S, or one longer unit; of little work, into ROUNDS a worker."""
    usual_s = [experiment_of(unit).cost_s(unit) for unit in units]
    most_s = min(CHUNK_S, sum(usual_s) / (ROUNDS * max(1, workers)))
    chunks: list[list[Unit]] = []
    room_s, room = 0.0, 0
    for unit, takes_s in zip(units, usual_s, strict=True):
        if takes_s > room_s or unit.episodes > room:
            chunks.append([])
            room_s, room = most_s, MOST_EPISODES
        chunks[-1].append(unit)
        room_s, room = room_s - takes_s, room - unit.episodes
    return list(map(tuple, chunks))
