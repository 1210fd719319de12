"""Episodes of arms: laws by a Jacobian and its inverse, on the model they know and on plants that differ from it."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterator

import tasks
from bench.base.errors import Incompatible
from bench.base.on_first_use import pd
from bench.experiments import episodes
from bench.experiments.episode_rows import TABLE
from bench.experiments.experiment import ON_ARMS, Asked, Experiment, Settings, Unit
from bench.experiments.rounding import rerun_nudged
from bench.experiments.suites import AT_INVERSES, BY_WORD_ALONE, IDEAL_MOTORS, NOMINAL, SLOW
from bench.law.contender import Contender
from bench.law.contenders import combinations
from tasks.arm_model import Arm

MOST = {"native": 100, "reference": 2}
"""Episodes a unit at most, as on the free body."""

EPISODE_S = {"native": 0.01, "reference": 0.3}
"""CPU seconds an episode, as on the free body; a guess for the reference engine, which the default suite omits."""


@functools.lru_cache(maxsize=8)
def units(asked: Asked) -> tuple[Unit, ...]:
    """Return the units on every arm; Incompatible where no named law, Jacobian and inverse go together on any."""
    places, every_task = [], episodes.tasks_of(asked)
    slices = episodes.narrowed(asked.suite.on_arms.slices, asked.choice)
    for task in filter(tasks.is_for_arms, every_task):
        fitting = tasks.described(task).start_sets
        is_meant = any(part.start_set in fitting for part in slices)
        for arm in (asked.choice.arms or tasks.arm_names()) if is_meant else ():  # one is read by MuJoCo
            for part, one, *way in _on_arm(asked, tasks.arm(arm)):
                # only joint-space baselines need the goal's joints
                is_known = one.baseline is None or tasks.knows_joints(part.start_set)
                if part.start_set in fitting and is_known and episodes.runs_on(part.engine, task, one):
                    places.append(episodes.Place(part, one, task, arm, *way))
    if every_task and not places and asked.choice.is_about_arms:
        _check_combinations(asked)
    return tuple(episodes.cut("arm", places, asked, MOST))


def _on_arm(asked: Asked, arm: Arm) -> Iterator[tuple]:
    """(slice, contender, variation, gains if not the settings') of everything on one arm."""
    on_arms, choice, joints = asked.suite.on_arms, asked.choice, arm.joints
    by_name = {one.name: one for one in asked.laws}
    slices = episodes.narrowed(on_arms.slices, choice)
    is_by_suite = not (choice.variations or choice.jacobians or choice.inverses)
    is_whole = is_by_suite and not choice.narrows
    variations = choice.variations or (IDEAL_MOTORS if is_whole else NOMINAL,)
    few: set[Contender] = set()
    if is_whole:
        usual = tuple(word for word in on_arms.words if word not in on_arms.few)  # on seven joints some are the same
        few = {*combinations.on(on_arms.few, by_name, joints)} - {*combinations.on(usual, by_name, joints)}
    every = combinations.chosen(on_arms.words, by_name, joints, choice.jacobians, choice.inverses, BY_WORD_ALONE)
    if every and is_by_suite and not choice.is_of_some_laws:
        every += combinations.baselines(joints)
    for one in every:
        for part in slices:
            for variation in variations if one not in few or part.start_set in AT_INVERSES else ():
                yield part, one, variation
    if is_whole:
        yield from _as_it_is(asked, by_name, arm)
        for one in combinations.on(on_arms.operational, by_name, joints):
            yield from ((part, one, name) for part in on_arms.operational_slices for name in (IDEAL_MOTORS, NOMINAL))
        for one in combinations.on(on_arms.varied, by_name, joints):
            for part in on_arms.varied_slices:
                for variation in tasks.variation_names(arm.name):
                    if tasks.variation(variation).believed:
                        yield part, one, variation


def _as_it_is(asked: Asked, by_name: dict[str, Contender], arm: Arm) -> Iterator[tuple]:
    """(slice, contender, variation, gains) of the compared laws, the user's and the baselines, on the arm as it is."""
    own = tuple(f"{name}@geometric+standard" for name, one in by_name.items() if one.regulator.origin)
    levels = [(kp, 2.0 * zeta * math.sqrt(kp)) for kp, zeta in filter(None, (SLOW, arm.gains)) if kp != asked.gains.kp]
    known = [name for name in tasks.variation_names(arm.name) if not tasks.variation(name).believed]
    motors, on_arms = [name for name in known if name not in (NOMINAL, IDEAL_MOTORS)], asked.suite.on_arms
    laws = combinations.on((*on_arms.compared, *own), by_name, arm.joints)
    for one in (*laws, *(combinations.baselines(arm.joints) if laws and not asked.choice.is_of_some_laws else ())):
        for part in on_arms.compared_slices:
            yield part, one, NOMINAL
        for part in on_arms.other_slices:
            yield from ((part, one, NOMINAL, gains) for gains in levels)
            yield from ((part, one, name) for name in motors)


def _check_combinations(asked: Asked) -> None:
    """Refuse if no law, Jacobian and inverse that were named go together on any arm that was named; say why."""
    choice, laws = asked.choice, list(asked.laws)
    by_name, named = {one.name: one for one in laws}, (choice.jacobians, choice.inverses)
    counts = dict.fromkeys(tasks.arm(arm).joints for arm in choice.arms or tasks.arm_names())
    if not any(combinations.chosen(asked.suite.on_arms.words, by_name, joints, *named) for joints in counts):
        reasons = [reason for joints in counts for reason in combinations.refusals(laws, joints, *named)]
        raise Incompatible(f"nothing to run: {combinations.shown(reasons)}")


def rows(settings: Settings, unit: Unit) -> pd.DataFrame:
    """Return the rows of a unit; each doubtful episode is also run from a start 1e-12 rad away."""
    starts = episodes.starts_of(settings, unit)
    simulate = functools.partial(episodes.rows_from, settings, unit)
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
