"""A plan: the units of one run, from a suite and what the user narrowed or widened it to."""

import dataclasses
import functools
import hashlib
import json
from dataclasses import dataclass

import tasks
from bench.contenders import combinations
from bench.errors import Incompatible
from bench.experiments import contact_plan, robustness_plan
from bench.experiments.choice import EVERYTHING, INTEGRATORS, Choice, check_numbers, check_word
from bench.experiments.contact_plan import ContactUnit
from bench.experiments.robustness_plan import RobustnessUnit
from bench.experiments.suites import HORIZON, NOMINAL, ON_ARM, SHORT, OnArms, Slice, Suite, suite
from bench.law.contender import PAPERS_GAINS, Contender, Gains
from bench.provenance import source_digest
from tasks.rules import RULES

CHUNK = {"ideal-rk4": 1000, "ideal-held": 1000, "native": 250, "reference": 4}
ARM_CHUNK = {"native": 100, "reference": 2}
"""Episodes a unit at most: a few seconds each even if none of them settles, so that Ctrl-C answers soon."""

WITHOUT, IN_CONTACT = "euler", "implicitfast"
"""Integrators if none is named: the default of MuJoCo, and what it recommends for contacts."""


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
    arm: str = ""
    variation: str = NOMINAL

    table = "episodes"

    @property
    def label(self) -> str:
        """Where it is and what it runs, in a few words."""
        return f"{self.arm or self.engine} {self.contender.split('/')[0]}"

    @property
    def key(self) -> str:
        """A name for a file."""
        law, place = self.contender.replace("/", "~"), f"{self.arm or self.task}_{self.variation}"
        return f"{self.engine}_{law}_{place}_{self.start_set}_{self.first:06d}"


AnyUnit = Unit | ContactUnit | RobustnessUnit


@dataclass(frozen=True)
class Plan:
    """Everything that decides the rows of a run."""

    suite: str
    units: tuple[Unit, ...]
    contenders: tuple[Contender, ...]
    gains: Gains = PAPERS_GAINS
    dt_s: float = 1e-3
    integrator: str = WITHOUT
    seed: int = 0
    traces: int = 0
    boundary_axes: int = 0
    arm_traces: int = 0
    poses: int = 0
    contacts: tuple[ContactUnit, ...] = ()
    contact_integrator: str = IN_CONTACT
    troubles: tuple[RobustnessUnit, ...] = ()

    @property
    def work(self) -> tuple[AnyUnit, ...]:
        """All that is to be done."""
        return (*self.units, *self.contacts, *self.troubles)

    @property
    def laws(self) -> tuple[Contender, ...]:
        """The contenders on the free body."""
        return tuple(one for one in self.contenders if not one.is_on_arm)

    @property
    def arms(self) -> tuple[str, ...]:
        """The arms, in their order."""
        return tuple(dict.fromkeys(unit.arm for unit in self.units if unit.arm))

    @property
    def episodes(self) -> int:
        """Number of rows of episodes.parquet."""
        return sum(unit.count for unit in self.units)

    @property
    def trials(self) -> int:
        """Number of episodes in contact."""
        return sum(unit.count for unit in self.contacts)

    @property
    def troubled(self) -> int:
        """Number of episodes in trouble: rows of robustness.parquet, but for levels that a law has no gains for."""
        return sum(unit.count for unit in self.troubles)

    def contender(self, name: str) -> Contender:
        """The contender of that name."""
        return next(one for one in self.contenders if one.name == name)

    def identity(self) -> dict:
        """What two runs must share for one to continue the other: the plan, the rules and the sources."""
        touched = dict.fromkeys((*self.arms, *(unit.arm for unit in self.contacts)))
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
            "arm_traces": self.arm_traces,
            "poses": self.poses,
            "contacts": [dataclasses.astuple(unit) for unit in self.contacts],
            "contact_integrator": self.contact_integrator,
            "troubles": [dataclasses.astuple(unit) for unit in self.troubles],
            "arms": {name: hashlib.sha256(tasks.arm(name).xml.encode()).hexdigest()[:16] for name in touched},
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
    laws: list[Contender],
    choice: Choice = EVERYTHING,
    *,
    count: int | None = None,
    dt_s: float = 1e-3,
    horizon_s: float | None = None,
    gains: Gains = PAPERS_GAINS,
    integrator: str | None = None,
    seed: int = 0,
) -> Plan:
    """The plan of a suite, narrowed or widened by what the user named.

    Args:
        laws: the contenders of the free body; on arms the same laws, by the suite's Jacobians and inverses.
        count: of the starts of each set, and the poses of each task in contact; the suite's numbers if None.
        integrator: everywhere; IN_CONTACT in contact and WITHOUT elsewhere if None.
    Errors:
        UnknownWord: a name in no list. BadNumber: a number that no episode can be run with.
        Incompatible: no named task, engine and start set go together, or no law, Jacobian and inverse.
    """
    check_numbers(dt_s, horizon_s, gains, count, seed)
    if integrator is not None:
        check_word("integrator", integrator, list(INTEGRATORS))
    chosen, choice = suite(suite_word), choice.checked()
    every_task = _tasks(choice, laws)
    placed = _on_free_body(chosen, laws, every_task, choice) + _on_arms(chosen, laws, every_task, choice)
    number = functools.cache(lambda word, size, arm: tasks.start_set_length(word, size, seed, arm))
    units = tuple(
        unit
        for place in placed
        for unit in _units(place, number(place.part.start_set, count or place.part.size, place.arm), horizon_s)
    )
    contacts = contact_plan.units(chosen.in_contact, choice, count, horizon_s)
    troubles = robustness_plan.units(chosen.robustness, laws, choice, count, horizon_s)
    if every_task and not units:
        raise Incompatible(_nothing_to_run(every_task, laws, chosen, choice))
    in_trouble = {unit.contender for unit in troubles}
    named = {place.contender.name: place.contender for place in placed}
    named |= {one.name: one for one in laws if one.name in in_trouble}
    return Plan(
        chosen.name,
        units,
        tuple(named.values()),
        gains,
        dt_s,
        integrator or WITHOUT,
        seed,
        0 if choice.narrows else chosen.traces,
        0 if choice.narrows else chosen.boundary_axes,
        0 if choice.narrows else chosen.on_arms.traced,
        0 if choice.narrows else chosen.on_arms.poses,
        contacts,
        integrator or IN_CONTACT,
        troubles,
    )


def _tasks(choice: Choice, laws: list[Contender]) -> tuple[str, ...]:
    """The tasks without contact that are meant; none along an axis, whose starts are its own."""
    if choice.axes:
        return ()
    if choice.is_contact_alone:
        own = [one.regulator.name for one in laws if one.regulator.origin]
        if own:
            raise Incompatible(f"tasks in contact take controllers, not the regulator '{own[0]}' (leave --law away)")
        return ()
    named = tuple(word for word in choice.tasks if word in tasks.names())
    every = tuple(word for word in tasks.names() if tasks.is_for_arms(word) or not choice.is_about_arms)
    return named or every


@dataclass(frozen=True)
class Place:
    """A contender on a slice of a task: what is cut into units."""

    part: Slice
    contender: Contender
    task: str
    arm: str = ""
    variation: str = NOMINAL


def runs_on(engine: str, task: str, one: Contender) -> bool:
    """Whether an engine can run a task: the ideal plant is the free body's alone, and has no actuators of MuJoCo."""
    return not engine.startswith("ideal") or (task == "free-body" and not one.regulator.in_engine)


def slices_of(chosen: Suite, one: Contender) -> tuple[Slice, ...]:
    """The slices of a suite on the free body that a contender runs on."""
    if one.regulator.in_engine:
        return chosen.in_engine
    return chosen.beyond if one.is_beyond_the_paper else chosen.slices


def _on_free_body(chosen: Suite, laws, every_task, choice: Choice) -> list[Place]:
    return [
        Place(part, one, task)
        for task in every_task
        if not tasks.is_for_arms(task)
        for one in laws
        for part in _narrowed(slices_of(chosen, one), choice)
        if part.start_set in tasks.task(task).start_sets and runs_on(part.engine, task, one)
    ]


def _on_arms(chosen: Suite, laws, every_task, choice: Choice) -> list[Place]:
    places = []
    for task in filter(tasks.is_for_arms, every_task):
        for arm in choice.arms or tasks.arm_names():
            fitting = tasks.task(task, arm).start_sets
            for part, one, variation in _on_arm(chosen.on_arms, laws, tasks.arm(arm).joints, choice):
                if part.start_set in fitting and runs_on(part.engine, task, one):
                    places.append(Place(part, one, task, arm, variation))
    if every_task and not places and choice.is_about_arms:
        _check_combinations(chosen.on_arms, laws, choice)
    return places


def _on_arm(on_arms: OnArms, laws, joints: int, choice: Choice):
    """(slice, contender, variation) of everything on one arm."""
    by_name = {one.name: one for one in laws}
    slices = _narrowed(on_arms.slices, choice)
    variations = choice.variations or (NOMINAL,)
    for one in combinations.chosen(on_arms.words, by_name, joints, choice.jacobians, choice.inverses):
        for part in slices:
            for variation in variations:
                yield part, one, variation
    if on_arms.varied and not (choice.narrows or choice.variations or choice.jacobians or choice.inverses):
        for one in combinations.on(on_arms.varied, by_name, joints):
            for part in on_arms.varied_slices:
                for variation in tasks.variation_names():
                    if variation != NOMINAL:
                        yield part, one, variation


def _check_combinations(on_arms: OnArms, laws, choice: Choice) -> None:
    """Refuse if no law, Jacobian and inverse that were named go together on any arm that was named; say why."""
    by_name, named = {one.name: one for one in laws}, (choice.jacobians, choice.inverses)
    counts = dict.fromkeys(tasks.arm(arm).joints for arm in choice.arms or tasks.arm_names())
    if not any(combinations.chosen(on_arms.words, by_name, joints, *named) for joints in counts):
        reasons = [reason for joints in counts for reason in combinations.refusals(laws, joints, *named)]
        raise Incompatible(f"nothing to run: {combinations.shown(reasons)}")


def _nothing_to_run(every_task, laws: list[Contender], chosen: Suite, choice: Choice) -> str:
    """Why no task, engine and start set go together."""
    reasons = []
    for task in every_task:
        is_for_arms = tasks.is_for_arms(task)
        allowed = tasks.start_set_names(arm=True) if is_for_arms else tasks.task(task).start_sets
        slices = _narrowed(chosen.on_arms.slices if is_for_arms else chosen.slices, choice)
        refused = [part.engine for part in slices if not any(runs_on(part.engine, task, one) for one in laws)]
        if refused:
            what = f"free-body alone, not '{task}'" if task != "free-body" else "no actuator of MuJoCo"
            reasons.append(f"{', '.join(dict.fromkeys(refused))} simulates {what}")
        foreign = [part.start_set for part in slices if part.start_set not in allowed]
        if foreign:
            reasons.append(
                f"task '{task}' takes the starts {', '.join(allowed)}, not {', '.join(dict.fromkeys(foreign))}"
            )
    return f"nothing to run: {'; '.join(reasons)} (choose another --task, --engine or --starts)"


def _narrowed(slices, choice: Choice):
    if not choice.narrows:
        return slices
    sizes = {(part.engine, part.start_set): part for part in slices}
    wanted_engines = choice.engines or tuple(dict.fromkeys(part.engine for part in slices))
    wanted_sets = choice.start_sets or tuple(dict.fromkeys(part.start_set for part in slices))
    horizons = dict.fromkeys((part.start_set for part in slices if part.horizon_s == ON_ARM), ON_ARM)
    return tuple(
        sizes.get((engine, name)) or Slice(engine, name, None, horizons.get(name) or HORIZON.get(name, SHORT))
        for engine in wanted_engines
        for name in wanted_sets
        if not (engine == "reference" and not choice.engines and (engine, name) not in sizes)
    )


def _units(place: Place, total: int, horizon_s):
    part = place.part
    step = (ARM_CHUNK if place.arm else CHUNK)[part.engine]
    for first in range(0, total, step):
        yield Unit(
            part.engine,
            place.contender.name,
            place.task,
            part.start_set,
            first,
            min(step, total - first),
            total,
            horizon_s or part.horizon_s,
            place.arm,
            place.variation,
        )
