"""What a worker of a cluster does: a chunk's text in, its rows as bytes out. It knows nothing of Dask."""

import importlib
import json
import signal

from bench.running.sandbox.sandbox import Sandbox
from bench.running.wire_format import plan_of


def carry_out(text: str, law_limit_s: float | None = None) -> tuple[dict[str, bytes], list[str]]:
    """Return the rows of each unit of a chunk as bytes, by its key, and what is to be said of a user's laws.

    text: of `wire_format.described`. A unit that is to be tried again, see `Sandbox.again`, has no rows.
    """
    plan = plan_of(json.loads(text))
    with Sandbox(plan, law_limit_s, is_checked=True) as sandbox:
        made = {unit.key: sandbox.packed(unit) for unit in plan.units}
        return {key: content for key, content in made.items() if content is not None}, sandbox.notes


def dask_setup(_: object) -> None:
    """Prepare the main thread of a worker that begins (--preload bench.running.schedulers.worker).

    Ctrl-C is the client's to answer, though a terminal sends it to all; and GLFW can be silenced in this thread only.
    """
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    importlib.import_module("tasks.episode")
