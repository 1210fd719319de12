"""Episodes of arms: laws by a Jacobian and its inverse, on the model they know and on plants that differ from it."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.experiments import episodes
from bench.experiments.episode_rows import TABLE
from bench.experiments.experiment import ON_ARMS, Experiment, Unit
from bench.experiments.request import Request
from bench.experiments.rounding import rerun_nudged
from bench.experiments.slices import narrow, read_on_arms
from bench.experiments.suites import AT_INVERSES, BY_WORD_ALONE, IDEAL_MOTORS, NOMINAL, SLOW
from bench.law.contender import Contender
from bench.law.contenders import combinations
from bench.law.inputs import Gains
from tasks.arm_model import Arm

MOST = {"native": 100, "reference": 2}
"""Episodes a unit at most, as on the free body."""

EPISODE_S = {"native": 0.01, "reference": 0.3}
"""CPU seconds an episode, as on the free body; a guess for the reference engine, which the default suite omits."""


@functools.lru_cache(maxsize=8)
def units(request: Request) -> tuple[Unit, ...]:
    """Return the units on every arm; Incompatible where no named law, Jacobian and inverse go together on any."""
    whole: list[Unit] = []
    every_task = episodes.tasks_of(request)
    for task in filter(tasks.is_for_arms, every_task):
        start_sets = tasks.described(task).start_sets
        if not any(part.selector in start_sets for part in slices_of(request)):
            continue  # before MuJoCo reads an arm
        for name in request.arms or tasks.arm_names():
            for part, contender in _on_arm(request, tasks.arm(name)):
                if part.selector not in start_sets or not episodes.runs_on(part.engine, task, contender):
                    continue
                # only joint-space baselines need the goal's joints
                if contender.baseline is None or tasks.knows_joints(part.selector):
                    whole.append(replace(part, experiment="arm", contender=contender.name, task=task, arm=name))
    if every_task and not whole and request.is_about_arms:
        _check_combinations(request)
    return tuple(episodes.split_into_units(whole, request, MOST))


def slices_of(request: Request) -> tuple[Unit, ...]:
    """Return the slices of contenders with ideal motors, as they are narrowed."""
    return narrow(read_on_arms(request.section("arm")["sizes"]), request)


def on_real_motors(section: Mapping[str, Any]) -> tuple[str, ...]:
    """Return the contenders that a suite's section runs on arms as they are."""
    return tuple(f"{name}@geometric+standard" for name in section["on_real_motors"]["laws"])


def _on_arm(request: Request, arm: Arm) -> Iterator[tuple[Unit, Contender]]:
    """Yield the slices of everything on one arm, with their variations and gains, each with its contender."""
    section, joints = request.section("arm"), arm.joints
    laws = {contender.name: contender for contender in request.laws}
    slices = slices_of(request)
    is_by_suite = not (request.variations or request.jacobians or request.inverses)
    is_whole = is_by_suite and not request.changes_starts_or_engines
    variations = request.variations or (IDEAL_MOTORS if is_whole else NOMINAL,)
    at_few_starts = _at_few_starts(section, laws, joints) if is_whole else set()
    ways = request.jacobians, request.inverses
    contenders = combinations.chosen(section["words"], laws, joints, *ways, BY_WORD_ALONE)
    if contenders and is_by_suite and not request.names_laws:
        contenders += combinations.baselines(joints)
    for contender in contenders:
        for part in slices:
            if contender not in at_few_starts or part.selector in AT_INVERSES:
                yield from _varied(part, contender, variations)
    if is_whole:
        yield from _as_it_is(request, laws, arm)
        yield from _operational(section["operational"], laws, joints)
        yield from _with_wrong_model(section["with_wrong_model"], laws, arm)


def _varied(part: Unit, contender: Contender, variations: Iterable[str]) -> Iterator[tuple[Unit, Contender]]:
    """Yield a slice on each variation of the plant."""
    for variation in variations:
        yield replace(part, variation=variation), contender


def _at_few_starts(section: Mapping[str, Any], laws: dict[str, Contender], joints: int) -> set[Contender]:
    """Return the contenders that run from AT_INVERSES alone: on seven joints some are the same as other ones."""
    few = section["at_few_starts"]
    usual = tuple(word for word in section["words"] if word not in few)
    return {*combinations.on(few, laws, joints)} - {*combinations.on(usual, laws, joints)}


def _operational(
    section: Mapping[str, Any], laws: dict[str, Contender], joints: int
) -> Iterator[tuple[Unit, Contender]]:
    """Yield the slices of contenders that run with ideal motors and on the arm as it is."""
    for contender in combinations.on(section["words"], laws, joints):
        for part in read_on_arms(section["sizes"]):
            yield from _varied(part, contender, (IDEAL_MOTORS, NOMINAL))


def _with_wrong_model(
    section: Mapping[str, Any], laws: dict[str, Contender], arm: Arm
) -> Iterator[tuple[Unit, Contender]]:
    """Yield the slices of the study of model errors, on every variation that is not the controller's model."""
    slices = read_on_arms({"clear": section["starts"]}, section["horizon_s"])
    variations = [name for name in tasks.variation_names(arm.name) if tasks.variation(name).believed]
    for contender in combinations.on(section["words"], laws, arm.joints):
        for part in slices:
            yield from _varied(part, contender, variations)


def _as_it_is(request: Request, laws: dict[str, Contender], arm: Arm) -> Iterator[tuple[Unit, Contender]]:
    """Yield the slices of the compared laws, the user's and the baselines, on the arm as it is."""
    section = request.section("arm")
    real = section["on_real_motors"]
    of_user = tuple(f"{name}@geometric+standard" for name, law in laws.items() if law.regulator.origin)
    contenders = combinations.on((*on_real_motors(section), *of_user), laws, arm.joints)
    if contenders and not request.names_laws:
        contenders += combinations.baselines(arm.joints)
    levels = []
    for kp, zeta in filter(None, (SLOW, arm.gains)):
        if kp != request.gains.kp:
            levels.append(Gains(kp, 2.0 * zeta * math.sqrt(kp)))
    known = [name for name in tasks.variation_names(arm.name) if not tasks.variation(name).believed]
    motors = [name for name in known if name not in (NOMINAL, IDEAL_MOTORS)]
    for contender in contenders:
        for part in read_on_arms(real["sizes"]):
            yield part, contender
        for part in read_on_arms(real["sizes_at_other_gains"]):
            for gains in levels:
                yield replace(part, kp=gains.kp, kv=gains.kv), contender
            yield from _varied(part, contender, motors)


def _check_combinations(request: Request) -> None:
    """Refuse if no law, Jacobian and inverse that were named go together on any arm that was named; say why."""
    laws = {contender.name: contender for contender in request.laws}
    words, ways = request.section("arm")["words"], (request.jacobians, request.inverses)
    counts = dict.fromkeys(tasks.arm(name).joints for name in request.arms or tasks.arm_names())
    if not any(combinations.chosen(words, laws, joints, *ways) for joints in counts):
        reasons = []
        for joints in counts:
            reasons += combinations.refusals(list(request.laws), joints, *ways)
        raise Incompatible(f"nothing to run: {combinations.shown(reasons)}")


def rows(request: Request, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit; each doubtful episode is also run from a start 1e-12 rad away."""
    starts = episodes.starts_of(request, unit)
    simulate = functools.partial(episodes.rows_from, request, unit)
    return rerun_nudged(simulate(starts), starts, simulate)


EXPERIMENT = Experiment.of(
    globals(),
    "laws on arms, by a Jacobian and its inverse",
    table=TABLE,
    takes=ON_ARMS,
    cost_s=lambda unit: unit.count * EPISODE_S[unit.engine],
    prepare=episodes.prepare,
    lost=episodes.lost,
    is_divisible=True,
    rank=1,
)
