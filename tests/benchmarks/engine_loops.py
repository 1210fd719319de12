"""A law in the compiled loop of an engine, on the free body.

It is the real loop, with all metrics on and no early stop.
"""

import mujoco
import numpy as np

import tasks
from bench.engines.episode import blank
from bench.engines.metrics.registry import metrics_of
from bench.engines.mujoco_view import compiled_view
from bench.engines.native.libmujoco import model_of
from bench.engines.plants import free_body
from bench.engines.simulate import compiled_loop, evaluation
from bench.experiments.request import Request
from bench.law.contender import Contender
from benchmarks.subject import NEVER, Episodes, Subject, time_episodes

STARTS = {"ideal-held": 128, "ideal-rk4": 128, "native": 8}
"""Engines and their uniform starts; of the 3 to 20 ms of a call, 0.05 ms hand over arguments."""

SETTINGS = Request().limits(0.4)._replace(hold_ticks=NEVER)
"""400 ticks of 1 ms: from rest through the fastest part of a response."""


def engine_loop(engine: str, contender: Contender) -> Subject:
    """Return the subject of a law in an engine of STARTS."""
    metrics = metrics_of(on_arm=False)
    starts = tasks.start_set("uniform", STARTS[engine])
    owners, world = None, None
    if engine == "native":
        owners, world = _make_body(starts)
    episodes = Episodes(
        loop=compiled_loop(engine, metrics),
        laws=(evaluation(contender),),
        world=world,
        starts=starts,
        settings=SETTINGS,
        blank_rows=blank(len(starts), metrics),
        owners=owners,
    )
    return time_episodes(contender, episodes, engine)


def _make_body(starts: list) -> tuple[tuple, free_body.FreeBodyWorld]:
    """Return MuJoCo's free body at the starts: what owns its memory, and the world of the loop."""
    task = tasks.task("free-body")
    model = model_of(task.xml(SETTINGS.dt_s), "euler")
    data = mujoco.MjData(model)
    states = []
    for start in starts:
        qpos, qvel = task.state(start)
        states.append([*qpos, *qvel])
    table = np.array(states)
    return (data, table), free_body.FreeBodyWorld(compiled_view(model, data), 0, table)
