"""A plan carried out: units run by a scheduler, each written when done, so that a run killed at any moment resumes."""

import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import NamedTuple

from bench.ahead import compiling_ahead
from bench.choice import check_workers
from bench.engines.run import evaluation
from bench.engines.run_arm import pointers
from bench.finish import finish, own_costs
from bench.journal import begin, held, inspect, sweep, tidy
from bench.plan import AnyUnit, Plan
from bench.running_order import in_running_order
from bench.schedulers import threads


class Progress(NamedTuple):
    """Told to the caller after every unit: the unit, and how many episodes of the whole it was."""

    unit: AnyUnit
    episodes: int


def run(
    plan: Plan, out: Path, *, workers: int = 2, replace: bool = False, told: Callable[[Progress], None] = lambda _: None
) -> bool:
    """Carry out what is not done yet; whether there was anything to do.

    Errors:
        BadNumber: workers. BadResults: the folder cannot be used or written, or another run is at work there.
        KeyboardInterrupt: after the units under way are written.
    """
    check_workers(workers)
    with held(Path(out)):
        return _run(plan, Path(out), workers, replace, told)


def _run(plan: Plan, out: Path, workers: int, replace: bool, told: Callable[[Progress], None]) -> bool:
    """The same in a folder that is held."""
    state = inspect(plan, out, replace)
    if state.finished:
        tidy(out)
        return False
    began = time.time()
    _compile_own_laws(plan)
    costs = own_costs(plan)
    if state.done:
        sweep(out)
    else:
        begin(plan, out)
    todo = [unit for unit in in_running_order(plan.work) if unit.key not in state.done]
    for unit in plan.work:
        if unit.key in state.done:
            told(Progress(unit, unit.count))
    with compiling_ahead(_ours(plan, todo)):
        threads.run(plan, todo, out, workers, lambda unit: told(Progress(unit, unit.count)))
    finish(plan, out, costs, workers, began, resumed=bool(state.done))
    return True


def _ours(plan: Plan, todo: list[AnyUnit]) -> Iterator[str]:
    """Contenders that a user's laws have no part in, in the order in which they run."""
    own = {one.name for one in plan.contenders if one.regulator.origin}
    return (unit.contender for unit in todo if unit.contender not in own)


def _compile_own_laws(plan: Plan) -> None:
    """Compile a user's laws before anything is written: what cannot be compiled is a mistake, not a row."""
    names = [unit.contender for unit in plan.units if unit.engine != "reference"]
    for name in dict.fromkeys((*names, *(unit.contender for unit in plan.troubles))):
        one = plan.contender(name)
        if one.regulator.origin:
            if one.is_on_arm:
                pointers(one)
            else:
                evaluation(one)
