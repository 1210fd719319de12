"""A plan: the units of one run, from a suite and what the user narrowed or widened it to."""

import dataclasses
import hashlib
import json
import math
from dataclasses import dataclass

import tasks
from bench.contender import PAPERS_GAINS, Contender, Gains
from bench.errors import BadNumber, Incompatible, UnknownWord
from bench.provenance import source_digest
from bench.suites import ENGINES, HORIZON, SHORT, Slice, suite
from tasks.rules import RULES

INTEGRATORS = ("euler", "implicit", "implicitfast", "rk4")

CHUNK = {"ideal-rk4": 1000, "ideal-held": 1000, "native": 250, "reference": 4}
"""Episodes a unit at most: a few seconds each even if none of them settles, so that Ctrl-C answers soon."""


@dataclass(frozen=True)
class Unit:
    """A piece of work that is done or not done: one contender, engine and stretch of a start set."""

    engine: str
    contender: str
    task: str
    start_set: str
    first: int
    count: int
    total: int
    horizon_s: float

    @property
    def key(self) -> str:
        """A name for a file."""
        law = self.contender.replace("/", "@")
        return f"{self.engine}_{law}_{self.task}_{self.start_set}_{self.first:06d}"


@dataclass(frozen=True)
class Plan:
    """Everything that decides the rows of a run."""

    suite: str
    units: tuple[Unit, ...]
    contenders: tuple[Contender, ...]
    gains: Gains = PAPERS_GAINS
    dt_s: float = 1e-3
    integrator: str = "euler"
    seed: int = 0
    traces: int = 0
    boundary_axes: int = 0

    @property
    def episodes(self) -> int:
        """Number of rows."""
        return sum(unit.count for unit in self.units)

    def contender(self, name: str) -> Contender:
        """The contender of that name."""
        return next(one for one in self.contenders if one.name == name)

    def identity(self) -> dict:
        """What two runs must share for one to continue the other: the plan, the rules and the sources."""
        return {
            "suite": self.suite,
            "units": [dataclasses.astuple(unit) for unit in self.units],
            "laws": {one.name: _text_digest(one.regulator.origin) for one in self.contenders if one.regulator.origin},
            "gains": list(self.gains),
            "dt_s": self.dt_s,
            "integrator": self.integrator,
            "seed": self.seed,
            "traces": self.traces,
            "boundary_axes": self.boundary_axes,
            "rules": list(RULES),
            "sources": source_digest(),
        }

    def digest(self) -> str:
        """Sixteen hex digits of the identity."""
        return hashlib.sha256(json.dumps(self.identity(), sort_keys=True).encode()).hexdigest()[:16]


def _text_digest(path: str) -> str:
    with open(path, "rb") as file:
        return hashlib.sha256(file.read()).hexdigest()[:16]


def make(
    suite_word: str,
    contenders: list[Contender],
    *,
    task_words: tuple[str, ...] = (),
    start_sets: tuple[str, ...] = (),
    engines: tuple[str, ...] = (),
    count: int | None = None,
    dt_s: float = 1e-3,
    horizon_s: float | None = None,
    gains: Gains = PAPERS_GAINS,
    integrator: str = "euler",
    seed: int = 0,
) -> Plan:
    """The plan of a suite, narrowed or widened by what the user named; empty means the suite's own.

    Errors:
        UnknownWord: a name in no list. BadNumber: a number that no episode can be run with.
        Incompatible: no named task, engine and start set go together.
    """
    _check_numbers(dt_s, horizon_s, gains, count, seed)
    chosen = suite(suite_word)
    task_words, start_sets, engines = (tuple(dict.fromkeys(words)) for words in (task_words, start_sets, engines))
    every_task = task_words or tuple(tasks.names())
    for word in every_task:
        _known("task", word, tasks.names())
    for word in start_sets:
        _known("start", word, tasks.start_set_names())
    for word in engines:
        _known("engine", word, list(ENGINES))
    _known("integrator", integrator, list(INTEGRATORS))
    units = tuple(
        unit
        for task in every_task
        for part in _narrowed(chosen.slices, start_sets, engines)
        if part.start_set in tasks.task(task).start_sets and runs_on(part.engine, task)
        for one in contenders
        for unit in _units(part, one.name, task, count, seed, horizon_s)
    )
    if not units:
        raise Incompatible(_nothing_to_run(every_task, _narrowed(chosen.slices, start_sets, engines)))
    return Plan(
        chosen.name,
        units,
        tuple(contenders),
        gains,
        dt_s,
        integrator,
        seed,
        0 if start_sets or engines else chosen.traces,
        0 if start_sets or engines else chosen.boundary_axes,
    )


def runs_on(engine: str, task: str) -> bool:
    """Whether an engine can run a task: the ideal plant is the free body's alone."""
    return task == "free-body" or not engine.startswith("ideal")


def _nothing_to_run(task_words, slices) -> str:
    """Why no task, engine and start set go together."""
    reasons = []
    for task in task_words:
        allowed = tasks.task(task).start_sets
        refused = [part.engine for part in slices if not runs_on(part.engine, task)]
        if refused:
            reasons.append(f"{', '.join(dict.fromkeys(refused))} simulates free-body alone, not '{task}'")
        foreign = [part.start_set for part in slices if part.start_set not in allowed]
        if foreign:
            reasons.append(
                f"task '{task}' takes the starts {', '.join(allowed)}, not {', '.join(dict.fromkeys(foreign))}"
            )
    return f"nothing to run: {'; '.join(reasons)} (choose another --task, --engine or --starts)"


def _narrowed(slices, start_sets, engines):
    if not start_sets and not engines:
        return slices
    sizes = {(part.engine, part.start_set): part for part in slices}
    wanted_engines = engines or tuple(dict.fromkeys(part.engine for part in slices))
    wanted_sets = start_sets or tuple(dict.fromkeys(part.start_set for part in slices))
    return tuple(
        sizes.get((engine, name)) or Slice(engine, name, None, HORIZON.get(name, SHORT))
        for engine in wanted_engines
        for name in wanted_sets
        if not (engine == "reference" and not engines and (engine, name) not in sizes)
    )


def _units(part: Slice, contender: str, task: str, count, seed, horizon_s):
    total = len(tasks.start_set(part.start_set, count or part.size, seed))
    step = CHUNK[part.engine]
    for first in range(0, total, step):
        yield Unit(
            part.engine,
            contender,
            task,
            part.start_set,
            first,
            min(step, total - first),
            total,
            horizon_s or part.horizon_s,
        )


def _known(kind: str, word: str, known: list[str]) -> None:
    if word not in known:
        raise UnknownWord(kind, word, sorted(known))


def check_workers(workers: int) -> None:
    """Refuse a number of threads that cannot work."""
    if not 1 <= workers <= 256:
        raise BadNumber(f"--workers {workers}: give between 1 and 256 threads (the number of cores is best)")


SHORTEST_DT_S, LONGEST_DT_S = 1e-6, 0.1
"""The default gains' time constant is 0.1 s; a microsecond makes ten million ticks of the shorter horizon."""


def _check_numbers(dt_s, horizon_s, gains, count, seed) -> None:
    if not SHORTEST_DT_S <= dt_s <= LONGEST_DT_S:
        raise BadNumber(
            f"--dt {dt_s}: the control period must lie between {SHORTEST_DT_S} and {LONGEST_DT_S} s (try: --dt 0.001)"
        )
    if horizon_s is not None and not (math.isfinite(horizon_s) and dt_s <= horizon_s <= 1000.0):
        raise BadNumber(
            f"--horizon {horizon_s}: it must lie between one tick ({dt_s} s) and 1000 s (try: --horizon 10)"
        )
    for name, value in zip(("--kp", "--kv"), gains, strict=True):
        if not (math.isfinite(value) and 0.0 < value <= 1e6):
            raise BadNumber(f"{name} {value}: a gain must lie in (0, 1e6] (the paper's: --kp 100 --kv 20)")
    if count is not None and not 1 <= count <= 1_000_000:
        raise BadNumber(f"--count {count}: give between 1 and 1000000 starts of each set")
    if not 0 <= seed < 2**32:
        raise BadNumber(f"--seed {seed}: give a whole number from 0 to 4294967295")
