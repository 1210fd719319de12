"""A user's laws on the free body, in processes of their own: all there is to say of them, and the nearest laws."""

import dataclasses
from collections import defaultdict
from collections.abc import Callable, Iterable
from typing import Any

import pandas as pd

from bench.experiments import plan as planning
from bench.experiments.experiment import Unit
from bench.experiments.plan import Plan
from bench.experiments.request import Request
from bench.experiments.tables.run import Run, with_contender
from bench.experiments.tables.schema import RESULTS
from bench.findings import why
from bench.findings.judgement import Judgement
from bench.findings.raised import find_exception
from bench.law.contender import Contender
from bench.law.contenders.registry import contenders_of
from bench.law.kinds import Law
from bench.running.sandbox.sandbox import LOST, Sandbox
from tasks.verdict import CRASHED, OUTCOMES

ENGINE = "ideal-rk4"
START_SETS = ("uniform", "half-turn", "tumbling", "goals")
LIMIT_S = 5.0
"""Seconds of processor time for a unit or a stretch of one, ten times what a law of ours takes for a unit."""

Parts = dict[tuple[str, str], list[pd.DataFrame]]
"""Rows by law and experiment."""


def judge_laws(
    regulators: Iterable[Law], limit_s: float = LIMIT_S, report: Callable[[Unit], object] = bool
) -> list[Judgement]:
    """Return the judgement of every law; 25 starts are hung after limit_s of processor time. BadLaw: a file is no law.

    report: is called with each unit that is run.
    """
    laws = contenders_of(*regulators)
    plan = plan_of(laws)
    parts: Parts = defaultdict(list)
    with Sandbox(plan, limit_s) as sandbox:
        look_at_commands(plan, sandbox, parts, report)
        explained = {one.name for one in laws if find_cause(one, parts)}
        rest = dataclasses.replace(plan, units=without(plan.units, explained))
        run_episodes(rest, sandbox, parts, report)
        is_lost, reasons = bool(sandbox.notes), sandbox.reasons
    return [describe_law(one, parts, is_lost, reasons.get(one.name, "")) for one in laws]


def look_at_commands(plan: Plan, sandbox: Sandbox, parts: Parts, report: Callable[[Unit], object]) -> None:
    """Add the command field of every law, which takes seconds: a fault that explains all shows there."""
    fields = plan.of("command-field")
    sandbox.check(fields)
    for unit in fields:
        report(unit)
        parts[unit.contender, unit.experiment].append(sandbox.rows(unit).to_pandas())


def run_episodes(plan: Plan, sandbox: Sandbox, parts: Parts, report: Callable[[Unit], object]) -> None:
    """Add the episodes of laws, then those under perturbations: not of a law that hangs, nor if no start settles."""
    sandbox.check(plan.of("free-body"))
    hanging = set()  # the rest of a law that hangs would take minutes more
    for unit in plan.of("free-body"):
        if unit.contender in hanging:
            continue
        report(unit)
        made = sandbox.rows(unit).to_pandas()
        parts[unit.contender, unit.experiment].append(made)
        if sandbox.notes and made["outcome"].isin(LOST).all():
            hanging.add(unit.contender)
    if sandbox.notes:
        return
    settling = {law for (law, name), own in parts.items() if name == "free-body" and any(map(why.is_settling, own))}
    perturbed = [unit for unit in plan.of("robustness") if unit.contender in settling]
    sandbox.check(perturbed)
    for unit in perturbed:
        report(unit)
        parts[unit.contender, unit.experiment].append(sandbox.rows(unit).to_pandas())


def find_cause(one: Contender, parts: Parts) -> str:
    """Return the word of the fault of a law that explains all its episodes; empty if there is none."""
    [field] = parts[one.name, "command-field"]
    return why.find_cause(field, one.regulator.memory is not None)


def without(units: Iterable[Unit], laws: set[str]) -> tuple[Unit, ...]:
    """Return the units of all laws but these."""
    return tuple(unit for unit in units if unit.contender not in laws)


def find_reason(one: Contender, episodes: pd.DataFrame) -> str:
    """Return the exception that the law raises at the first of its crashed starts."""
    crashed = episodes[episodes["outcome"] == OUTCOMES[CRASHED]] if len(episodes) else episodes
    return find_exception(one.regulator, crashed) if len(crashed) else ""


def plan_of(laws: list[Contender]) -> Plan:
    """Return the command field, the episodes and the perturbations of some laws."""
    every = Request("quick", tuple(laws))
    episodes = dataclasses.replace(
        every,
        tasks=("free-body",),
        start_sets=START_SETS,
        engines=(ENGINE,),
        experiments=("free-body", "command-field"),
    )
    first = planning.make(episodes)
    second = planning.make(dataclasses.replace(every, experiments=("robustness",)))
    return dataclasses.replace(first, units=first.units + second.units)


def describe_law(
    one: Contender, parts: Parts, is_lost: bool = False, reason: str = ""
) -> Judgement:
    """Return what its rows say of a law; reason: why its process gave no rows, the first time."""
    field, episodes, perturbed = (
        pd.concat([pd.DataFrame(), *parts[one.name, name]], ignore_index=True)
        for name in ("command-field", "free-body", "robustness")
    )
    declared = one.regulator.property
    moves = why.ends(episodes, declared) if len(episodes) else []
    robust = [] if is_lost else why.perturbed(perturbed)  # the first loss ends them: the rest was not tried
    cause = why.find_cause(field, one.regulator.memory is not None)
    skipped = why.not_run(cause, episodes, is_lost)
    of_command = why.sentences(field, declared, cause, one.regulator.stiffness)
    sentences = (*of_command, *moves, *robust, *skipped)
    if any(sentence.fault == why.FAULTS["crashed"] for sentence in sentences):
        # Where the law raises an error, its command is no number: that is one fault, not two.
        sentences = tuple(sentence for sentence in sentences if sentence.fault != "no number")
    heading = why.describe_lost_starts(one.name, episodes, reason or find_reason(one, episodes))
    return Judgement(one.name, sentences, _beside(field, episodes), is_lost, heading)


def _beside(field: pd.DataFrame, episodes: pd.DataFrame) -> tuple[dict[str, Any], ...]:
    if field.empty or episodes.empty:
        return ()
    reference = RESULTS / "reference"
    whole = Run(reference)
    run = whole.table("episodes")
    run = run[(run["arm"] == "") & (run["engine"] == ENGINE) & run["start_set"].isin(START_SETS)]
    fields = whole.table("command-field")
    lines = why.beside(field, with_contender(episodes), fields, run).to_dict("records")
    return tuple({key: None if value != value else value for key, value in line.items()} for line in lines)
