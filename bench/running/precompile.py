"""Compile in a process of its own what a run needs last, while the run itself begins with what it needs first.

The compiler holds Python's lock, so that threads compile one after the other. What another process compiles goes to the
cache on disk, where the run finds it; so do the operations of laws, which it counts then, for the run's end.
"""

import contextlib
import functools
import os
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator

WORTH = 8
"""Contenders from which on a process more is worth its start of some seconds."""

LIFE = 56
"""Contenders after which a new process goes on: what is compiled stays in memory, some 6 MB of each."""

COUNT = "count:"
"""Before a law's name: count its operations."""


@contextlib.contextmanager
def compiling_ahead(contenders: Iterable[str]) -> Iterator[subprocess.Popen | None]:
    """While inside, another process compiles these contenders, the last one first; it is stopped at the end.

    Of fewer than WORTH there is none.

    Args:
        contenders: names of laws, of controllers of arms (with `@`) and of controllers in contact.
    """
    from bench.law.contenders.registry import all_contenders

    names = list(dict.fromkeys(contenders))
    if len(names) < WORTH:
        yield None
        return
    quiet = subprocess.DEVNULL
    counted = {one.name for one in all_contenders()}.intersection(names)
    work = [*reversed(names), *(COUNT + name for name in reversed(names) if name in counted)]
    words = [sys.executable, "-m", __name__, str(os.getpid()), *work]
    with subprocess.Popen(words, stdin=quiet, stdout=quiet, stderr=quiet, start_new_session=True) as process:
        try:
            yield process
        finally:
            process.terminate()


def compiler_of(name: str) -> Callable[[], object]:
    """Return what compiles a contender of ours into the cache.

    Errors:
        UnknownWord: there is none of this name.
    """
    from bench.engines import simulate_arms, simulate_contact
    from bench.engines.simulate import evaluation
    from bench.law.contenders.registry import find_contender
    from bench.law.control.registry import all_controllers

    touching = {one.name: one for one in all_controllers()}
    if name in touching:
        return functools.partial(simulate_contact.pointer, touching[name])
    return functools.partial(simulate_arms.pointers if "@" in name else evaluation, find_contender(name))


def main(parent: int, work: list[str]) -> None:
    """Compile, or count, one after the other, as long as the process that asked for it lives.

    After LIFE of them a new program takes this process over, with the rest.
    """
    threading.Thread(target=_end_without, args=(parent,), daemon=True).start()
    for word in work[:LIFE]:
        if word.startswith(COUNT):
            count_one(word.removeprefix(COUNT))
        else:
            compiler_of(word)()
    if rest := work[LIFE:]:
        os.execv(sys.executable, [sys.executable, "-m", "bench.running.precompile", str(parent), *rest])


def count_one(name: str) -> None:
    """Count the operations of a law of ours, and keep them."""
    from bench.experiments.costs import count_operations
    from bench.law.contenders.registry import find_contender

    count_operations(find_contender(name))


def _end_without(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(0.2)
    os._exit(1)  # in the middle of a compilation; a file of the cache is there whole or not at all


if __name__ == "__main__":
    main(int(sys.argv[1]), sys.argv[2:])
