"""Episodes of the body that turns freely: every law, from the suite's start sets, on each of its engines."""

from __future__ import annotations

import functools
from dataclasses import replace

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.experiments import arm, episodes
from bench.experiments.episode_rows import TABLE
from bench.experiments.experiment import OF_EPISODES, Experiment, Unit
from bench.experiments.request import Request
from bench.experiments.slices import narrow, read_slices
from bench.law.contender import Contender

MOST = {"ideal-rk4": 1000, "ideal-held": 1000, "native": 250, "reference": 4}
"""Episodes a unit at most: a few seconds each even if none of them settles, so that Ctrl-C answers soon."""

EPISODE_S = {"ideal-rk4": 4e-4, "ideal-held": 2e-4, "native": 3e-3, "reference": 0.06}
"""Median CPU seconds an episode, of six units of each kind on a core of 2026, to one digit; compiling is extra."""

PARTS = ("slices", "beyond", "in_engine")
"""Keys of the suite's section: of the paper's laws and the user's, of other laws, and of MuJoCo's own actuator."""


@functools.lru_cache(maxsize=8)
def units(request: Request) -> tuple[Unit, ...]:
    """Return the units of a suite's slices; Incompatible where no named task, engine and start set go together."""
    section = request.section("free-body")
    slices = {part: narrow(read_slices(section[part]), request) for part in PARTS}
    whole = []
    for task in episodes.tasks_of(request):
        if tasks.is_for_arms(task):
            continue
        start_sets = tasks.task(task).start_sets
        for contender in request.laws:
            for part in slices[part_of(contender)]:
                if part.selector in start_sets and episodes.runs_on(part.engine, task, contender):
                    whole.append(replace(part, experiment="free-body", contender=contender.name, task=task))
    found = tuple(episodes.split_into_units(whole, request, MOST))
    if not (found or arm.units(request)):
        refuse_if_named(request)
    return found


def part_of(contender: Contender) -> str:
    """Return the part of the suite's section that has the slices of a contender."""
    if contender.regulator.in_engine:
        return "in_engine"
    return "beyond" if contender.is_beyond_the_paper else "slices"


def refuse_if_named(request: Request) -> None:
    """Say why no task, engine and start set go together, if a task is meant."""
    every_task = episodes.tasks_of(request)
    if not every_task:
        return
    reasons = []
    for task in every_task:
        is_for_arms = tasks.is_for_arms(task)
        allowed = tasks.start_set_names(arm=True) if is_for_arms else tasks.task(task).start_sets
        of_body = read_slices(request.section("free-body")["slices"])
        slices = arm.slices_of(request) if is_for_arms else narrow(of_body, request)
        refused = [
            part.engine
            for part in slices
            if not any(episodes.runs_on(part.engine, task, contender) for contender in request.laws)
        ]
        if refused:
            what = f"free-body alone, not '{task}'" if task != "free-body" else "no actuator of MuJoCo"
            reasons.append(f"{', '.join(dict.fromkeys(refused))} simulates {what}")
        foreign = [part.selector for part in slices if part.selector not in allowed]
        if foreign:
            reasons.append(
                f"task '{task}' takes the starts {', '.join(allowed)}, not {', '.join(dict.fromkeys(foreign))}"
            )
    raise Incompatible(f"nothing to run: {'; '.join(reasons)} (choose another --task, --engine or --starts)")


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit."""
    return episodes.rows_from(request, unit, episodes.starts_of(request, unit))


EXPERIMENT = Experiment.of(
    globals(),
    "laws on the body that turns freely",
    table=TABLE,
    takes=OF_EPISODES,
    cost_s=lambda unit: unit.count * EPISODE_S[unit.engine],
    prepare=episodes.prepare,
    lost=episodes.lost,
    is_divisible=True,
    rank=0,
)
