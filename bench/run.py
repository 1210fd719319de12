"""A plan carried out: units run by threads, each written when done, so that a run killed at any moment resumes.

Layout of a run's folder: plan.json first, and laws/ with the user's own; then parts/<unit>.parquet one by one; at the
end the tables, provenance.json last of all, and the parts go.
"""

import contextlib
import functools
import importlib
import shutil
import threading
import time
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from pathlib import Path
from typing import NamedTuple

import pandas as pd

import tasks
from bench import boundary, contact_rows, counting, poses, robustness_rows, traces
from bench.ahead import compiling_ahead
from bench.choice import check_workers
from bench.contact_plan import ContactUnit, poses_of
from bench.discovery import all_contenders, find_compliant, metrics_of
from bench.engines.contact_episode import Conditions
from bench.engines.run import evaluation
from bench.engines.run import run as run_engine
from bench.engines.run_arm import pointers
from bench.engines.run_arm import run as run_on_arm
from bench.errors import BadLaw, BadResults
from bench.plan import Plan, Unit
from bench.provenance import describe
from bench.robustness_plan import RobustnessUnit
from bench.rows import frame, settings_of
from bench.running_order import in_running_order
from bench.store import check, is_leftover, merge, read_json, write_atomically, write_json, write_table

TABLES = ("costs", "traces", "boundaries", "poses", "compliance", "robustness", "episodes")
"""The tables of a finished run."""


AnyUnit = Unit | ContactUnit | RobustnessUnit


class State(NamedTuple):
    """What a results folder holds of a plan."""

    finished: bool
    done: frozenset[str]


class Progress(NamedTuple):
    """Told to the caller after every unit: the unit, and how many episodes of the whole it was."""

    unit: AnyUnit
    episodes: int


def inspect(plan: Plan, out: Path, replace: bool = False) -> State:
    """What is done already in `out`; nothing is touched.

    Errors:
        BadResults: the folder holds another plan, or something that is no run of ours.
    """
    out = Path(out)
    if not _content(out):
        return State(False, frozenset())
    if not (out / "plan.json").is_file():
        raise BadResults(f"{out}: the folder holds something else than a run of ours; choose another with --out")
    found = read_json(out / "plan.json").get("digest")
    if found is None:
        raise BadResults(f"{out}: its plan.json is none of ours; choose another folder with --out")
    if found != plan.digest():
        if replace:
            return State(False, frozenset())
        raise BadResults(
            f"{out}: it holds another plan (other suite, options, rules or sources); add --replace to start over, or "
            "choose another folder with --out"
        )
    finished = (out / "provenance.json").is_file() and all((out / f"{table}.parquet").is_file() for table in TABLES)
    for path in (out / f"{table}.parquet" for table in TABLES) if finished else ():
        check(path, path.stem)
    done = [unit for unit in plan.work if _part(out, unit).is_file()]
    for unit in () if finished else done:
        check(_part(out, unit), unit.table)
    return State(finished, frozenset(unit.key for unit in done))


def _part(out: Path, unit: AnyUnit) -> Path:
    return out / "parts" / f"{unit.key}.parquet"


def _content(out: Path) -> list[Path]:
    """What lies in a folder, leftovers of killed writes apart; nothing if there is no folder yet."""
    try:
        return [path for path in out.iterdir() if not is_leftover(path)]
    except FileNotFoundError:
        return []
    except OSError as error:
        raise BadResults(f"{out}: cannot be used as a folder ({error.strerror}); choose another with --out") from error


def run(
    plan: Plan, out: Path, *, workers: int = 2, replace: bool = False, told: Callable[[Progress], None] = lambda _: None
) -> bool:
    """Carry out what is not done yet; whether there was anything to do.

    Errors:
        BadNumber: workers. BadResults: the folder cannot be used. KeyboardInterrupt: after the units under way are
        written.
    """
    check_workers(workers)
    out = Path(out)
    state = inspect(plan, out, replace)
    if state.finished:
        _tidy(out)
        return False
    began = time.time()
    _compile_own_laws(plan)
    costs = _own_costs(plan)
    if not state.done:
        _clear(out)
        write_json(out / "plan.json", {"digest": plan.digest(), **plan.identity()})
        _keep_own_laws(plan, out)
    todo = [unit for unit in in_running_order(plan.work) if unit.key not in state.done]
    for unit in plan.work:
        if unit.key in state.done:
            told(Progress(unit, unit.count))
    with compiling_ahead(_ours(plan, todo)):
        _run_units(plan, todo, out, workers, told)
    _finish(plan, out, costs, workers, began, resumed=bool(state.done))
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


def _keep_own_laws(plan: Plan, out: Path) -> None:
    """Copy a user's laws into the run, so that its rows can be read, and its report written, with what made them."""
    for origin, name in {one.regulator.origin: one.regulator.name for one in plan.contenders}.items():
        if origin:
            copy = out / "laws" / f"{name.replace('-', '_')}.py"
            write_atomically(copy, functools.partial(shutil.copyfile, origin))


def _law_costs(plan: Plan) -> list[dict]:
    """Operations of every law of ours, run or not."""
    return _counted(plan, ((one, functools.partial(counting.rows, [one])) for one in all_contenders()))


def _own_costs(plan: Plan) -> list[dict]:
    """Operations of a user's laws, counted first: what cannot be counted is a mistake, and nothing is written."""
    own = (one for one in plan.laws if one.regulator.origin)
    return _counted(plan, ((one, functools.partial(counting.rows, [one])) for one in own))


def _arm_costs(plan: Plan) -> list[dict]:
    """Operations of every controller that runs on an arm."""
    on_arms = dict.fromkeys((unit.contender, tasks.arm(unit.arm).joints) for unit in plan.units if unit.arm)
    pairs = ((plan.contender(name), joints) for name, joints in on_arms)
    return _counted(plan, ((one, functools.partial(counting.rows_on_arm, one, joints)) for one, joints in pairs))


def _counted(plan: Plan, jobs) -> list[dict]:
    """The rows of all jobs; none of a user's law beyond the dialect, if only `reference` runs it."""
    only_reference = all(unit.engine == "reference" for unit in plan.units)
    rows = []
    for one, count in jobs:
        try:
            rows += count()
        except BadLaw:
            if not (one.regulator.origin and only_reference):
                raise
    return rows


def _clear(out: Path) -> None:
    """Remove an earlier run of ours, plan.json last, so that a kill in between leaves a folder we recognise."""
    if not out.is_dir():
        return
    with _removing(out):
        (out / "provenance.json").unlink(missing_ok=True)
        for name in TABLES:
            (out / f"{name}.parquet").unlink(missing_ok=True)
        if (out / "laws").is_dir():
            shutil.rmtree(out / "laws")
        _tidy(out)
        (out / "plan.json").unlink(missing_ok=True)


def _tidy(out: Path) -> None:
    """Remove what only an unfinished run needs: its parts, and the temporary files of killed writes."""
    with _removing(out):
        if (out / "parts").is_dir():
            shutil.rmtree(out / "parts")
        for path in [path for path in out.iterdir() if is_leftover(path)]:
            path.unlink(missing_ok=True)


@contextlib.contextmanager
def _removing(out: Path):
    try:
        yield
    except OSError as error:
        raise BadResults(
            f"{out}: cannot be emptied ({error.strerror}); mend its rights, or choose another folder with --out"
        ) from error


def _run_units(plan: Plan, todo: list[AnyUnit], out: Path, workers: int, told) -> None:
    stop = threading.Event()

    def work(unit: AnyUnit) -> AnyUnit | None:
        if stop.is_set():
            return None
        write_table(_part(out, unit), _rows(plan, unit), unit.table)
        return unit

    if any(isinstance(unit, Unit) and unit.engine == "reference" for unit in todo):
        importlib.import_module("tasks.episode")  # it silences GLFW's import, which works in the main thread only
    with ThreadPoolExecutor(workers) as pool:
        pending = {pool.submit(work, unit) for unit in todo}
        try:
            while pending:
                done, pending = wait(pending, return_when=FIRST_COMPLETED)
                for future in done:
                    unit = future.result()
                    if unit is not None:
                        told(Progress(unit, unit.count))
        except BaseException:
            stop.set()
            raise


def _rows(plan: Plan, unit: AnyUnit) -> pd.DataFrame:
    """The rows of a unit."""
    if isinstance(unit, ContactUnit):
        return _in_contact(plan, unit)
    return _in_trouble(plan, unit) if isinstance(unit, RobustnessUnit) else _episodes(plan, unit)


def _episodes(plan: Plan, unit: Unit) -> pd.DataFrame:
    """The rows of a unit without contact."""
    starts = starts_of(unit.start_set, unit.total, plan.seed, unit.arm)[unit.first : unit.first + unit.count]
    one, settings = plan.contender(unit.contender), settings_of(plan, unit.horizon_s)
    metrics = metrics_of(on_arm=one.is_on_arm)
    if one.is_on_arm:
        given = (unit.task, unit.arm, starts, settings, metrics, plan.integrator, unit.variation)
        numbers = run_on_arm(unit.engine, one, *given)
    else:
        numbers = run_engine(unit.engine, one, unit.task, starts, settings, metrics, plan.integrator)
    return frame(plan, unit, one, starts, numbers, metrics)


def _in_contact(plan: Plan, unit: ContactUnit) -> pd.DataFrame:
    """The rows of a unit in contact."""
    one, arm = find_compliant(unit.contender), tasks.arm(unit.arm)
    task = tasks.contact_task(unit.task)
    some = poses_of(one, task, arm, unit.dense)[unit.first : unit.first + unit.poses]
    conditions = Conditions(plan.gains, dt_s=plan.dt_s, integrator=plan.contact_integrator)
    return contact_rows.frame(plan.suite, one, task._replace(horizon_s=unit.horizon_s), arm, some, conditions)


def _in_trouble(plan: Plan, unit: RobustnessUnit) -> pd.DataFrame:
    """The rows of a unit along an axis."""
    one, axis = plan.contender(unit.contender), tasks.axis(unit.axis)
    return robustness_rows.frame(plan.suite, one, axis, unit.starts, unit.horizon_s, plan.gains, plan.seed)


starts_of = functools.lru_cache(maxsize=16)(tasks.start_set)
"""A start set is built once for all its units."""


def _finish(plan: Plan, out: Path, own_costs: list[dict], workers: int, began: float, resumed: bool) -> None:
    with ThreadPoolExecutor(workers) as pool:
        others = pool.submit(_write_all_but_boundaries, plan, out, own_costs)
        write_table(out / "boundaries.parquet", boundary.run(plan, pool), "boundaries")
        rows = others.result()
    write_json(
        out / "provenance.json",
        {
            **describe(),
            "suite": plan.suite,
            "plan": plan.digest(),
            "episodes": rows,
            "trials": plan.trials,
            "troubled": plan.troubled,
            "seed": plan.seed,
            "workers": workers,
            "finished": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime()),
            "wall_s": round(time.time() - began, 1),
            "resumed": resumed,
        },
    )
    _tidy(out)


def _write_all_but_boundaries(plan: Plan, out: Path, own_costs: list[dict]) -> int:
    """One table after the other, each let go before the next; the number of episodes.

    All of it holds Python's lock, so that a second thread for it would be none the faster; boundaries do not.
    """
    write_table(out / "traces.parquet", traces.run(plan), "traces")
    write_table(out / "poses.parquet", poses.run(plan), "poses")
    costs = _law_costs(plan) + own_costs + _arm_costs(plan)
    write_table(out / "costs.parquet", pd.DataFrame(costs), "costs")
    merge(out / "compliance.parquet", [_part(out, unit) for unit in plan.contacts], "compliance")
    merge(out / "robustness.parquet", [_part(out, unit) for unit in plan.troubles], "robustness")
    return merge(out / "episodes.parquet", [_part(out, unit) for unit in plan.units], "episodes")
