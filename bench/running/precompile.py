"""Compile a run's contenders in a process of its own, in the order in which the run needs them.

The compiler holds Python's lock and never frees its memory: a law that is compiled takes 6 MB or more, one that is
loaded from the cache on disk 2 MB. So the run waits for a contender until it is in the cache, and loads it. The
operations of laws are counted after that, for the run's end.
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

LIFE = 40
"""Contenders after which a new process goes on, which begins without the memory of the one before."""

COUNT = "count:"
"""Before a law's name: count its operations."""


class Ahead:
    """The process that compiles, and which contenders it has compiled."""

    def __init__(self, process: subprocess.Popen, names: Iterable[str]) -> None:
        self.process = process
        self._compiled = {name: threading.Event() for name in names}
        threading.Thread(target=self._follow, daemon=True).start()

    def wait_for(self, name: str, stop: threading.Event) -> None:
        """Wait until a contender is compiled, the process has ended, or `stop` is set."""
        compiled = self._compiled.get(name)
        while compiled and not stop.is_set() and not compiled.wait(0.2):
            pass

    def _follow(self) -> None:
        assert self.process.stdout
        for line in self.process.stdout:
            if compiled := self._compiled.get(line.rstrip("\n")):
                compiled.set()
        for compiled in self._compiled.values():
            compiled.set()


@contextlib.contextmanager
def compiling_ahead(contenders: Iterable[str]) -> Iterator[Ahead | None]:
    """While inside, another process compiles these contenders; it is stopped at the end.

    There is none for fewer than WORTH.

    Args:
        contenders: names of laws, of controllers of arms (with `@`) and of controllers in contact.
    """
    from bench.law.contenders.registry import all_contenders

    names = list(dict.fromkeys(contenders))
    if len(names) < WORTH:
        yield None
        return
    counted = {one.name for one in all_contenders()}.intersection(names)
    work = [*names, *(COUNT + name for name in reversed(names) if name in counted)]
    words, quiet = [sys.executable, "-m", __name__, str(os.getpid()), *work], subprocess.DEVNULL
    with subprocess.Popen(
        words, stdin=quiet, stdout=subprocess.PIPE, stderr=quiet, text=True, start_new_session=True
    ) as process:
        try:
            yield Ahead(process, names)
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
    """Compile or count one after the other, and print the name of each, as long as the parent lives.

    After LIFE of them a new program takes this process over, with the rest.
    """
    threading.Thread(target=_end_without, args=(parent,), daemon=True).start()
    for word in work[:LIFE]:
        if word.startswith(COUNT):
            count_one(word.removeprefix(COUNT))
        else:
            compiler_of(word)()
        print(word, flush=True)
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
