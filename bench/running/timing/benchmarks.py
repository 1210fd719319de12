"""All that is timed: the reference kernel, every law, every law in every compiled engine, and the arms.

An engine runs its real loop, all metrics on, from fixed starts, with no early stop.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import mujoco
import numpy as np

import tasks
from bench.engines.binding import command_of, memory_of
from bench.engines.episode import blank
from bench.engines.metrics.registry import metrics_of
from bench.engines.native.libmujoco import model_of
from bench.engines.plants import free_body
from bench.engines.simulate import compiled_loop, evaluation
from bench.engines.simulated import compiled_view
from bench.experiments.experiment import Settings
from bench.law.contender import Contender
from bench.law.inputs import Gains
from bench.running.timing import law, on_arms, reference_kernel
from bench.running.timing.benchmark import KERNEL, LAW, LOOP, NEVER, Benchmark, closed_loop

ENGINES = ("ideal-held", "ideal-rk4", "native")

SETTINGS = Settings().limits(0.4)._replace(hold_ticks=NEVER)
"""400 ticks of 1 ms: from rest through the fastest part of a response; a tick costs the same at any time."""

STARTS = {"ideal-held": 128, "ideal-rk4": 128, "native": 8}
"""Uniform starts; a sample takes from three milliseconds to twenty, 0.05 ms of them to hand the loop its arguments."""


class Progress(NamedTuple):
    """After every sample: what was timed, and how many of how many; with a total of 0, the law being compiled."""

    name: str
    done: int
    total: int


def benchmarks(
    contenders: list[Contender], report: Callable = lambda _: None, arms: tuple[str, ...] = ()
) -> list[Benchmark]:
    """Return the reference kernel first, then everything else, arms with the controllers that have these laws too.

    All is compiled and has run once. MuJoCo's own actuator is left out: no law of ours runs there.
    """
    contenders = [one for one in contenders if not one.regulator.in_engine]
    loops, laws = [], []
    for one in contenders:
        report(Progress(one.name, 0, 0))
        if not one.regulator.costing_only:  # before the law alone: this refuses, in a line, what does not compile
            loops += [_engine(engine, one) for engine in ENGINES]
        laws.append(_law(LAW, one))
    empty = _law(LOOP, Contender(law.EMPTY))._replace(contender=None)
    chain, given = reference_kernel.compiled(), (reference_kernel.START, reference_kernel.STEPS)
    found = [Benchmark(KERNEL, None, "", reference_kernel.STEPS, lambda: chain(*given)), *laws, *loops, empty]
    for arm in arms:
        report(Progress(arm, 0, 0))
        found += on_arms.of_arm(arm, [one for one in contenders if not one.regulator.costing_only])
    return found


def _law(what: str, one: Contender) -> Benchmark:
    loop = law.loop_of(command_of(one), memory_of(one), cache=not one.regulator.origin)
    states, gains = law.states(), Gains()

    def call() -> Any:
        return loop(states, gains.kp, gains.kv, law.SWEEPS)

    return Benchmark(what, one, "", law.SWEEPS * law.STATES if call() == 0.0 else 0, call)


def _engine(engine: str, one: Contender) -> Benchmark:
    metrics = metrics_of(on_arm=False)
    loop, kept, world = compiled_loop(engine, metrics), None, None
    starts = tasks.start_set("uniform", STARTS[engine])
    if engine == "native":
        task = tasks.task("free-body")
        model = model_of(task.xml(SETTINGS.dt_s), "euler")
        kept = mujoco.MjData(model), np.array([[*qpos, *qvel] for qpos, qvel in map(task.state, starts)])
        world = free_body.World(compiled_view(model, kept[0]), 0, kept[1])
    fresh = blank(len(starts), metrics)
    return closed_loop(engine, one, loop, (evaluation(one),), world, starts, SETTINGS, fresh, kept=kept)
