"""The answer in one place: which law to use today, how it was tested, under which condition, and what it costs.

README, the front page, `show`, `advise` and the tables take their words from `find_answer`. Every law in it is the
result of a rule (`selection.regions`, `selection.robots`), every reason and price is read from rows. Where the map of
situations or the run is missing, the words say "not tested".
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

from bench.base.errors import BadResults, NoEvidence, UnknownWord
from bench.findings.amounts import join_words
from bench.findings.claims.adequacy import HELD_RAD, PAPERS
from bench.findings.kept import keep
from bench.findings.selection import regions
from bench.findings.selection.bounded import explain_bounded, find_bounded
from bench.findings.selection.nearest import decide_nearest, find_outside
from bench.findings.selection.regions import (
    OVERSHOOT,
    STUDY,
    Rule,
    RuleVerdict,
    facts_of,
    find_default,
    find_regions,
)
from bench.findings.selection.robots import ROBOTS, RUN, decide_for
from bench.findings.selection.unbeaten import (
    SPOKEN,
    find_bounds,
    find_least_beaten,
    find_population,
    find_price,
    find_runner_up,
    measure_shares,
)
from bench.findings.selection.words import describe_bounds, list_faster_ours, percent, together
from bench.law.contenders.registry import find_contender
from bench.law.inputs import Gains, reads_limits
from tasks.situation import COORDINATES, NOMINAL

NOT_TESTED = "not tested"
ANY_START = "commands torque, any start"


class Need(NamedTuple):
    """A row of the table of advice: what the controller is, the law for it, whose law it is, why, and its price.

    name: a word that stays the same when the sentences change.
    """

    controller: str
    law: str
    attribution: str
    why: str
    price: str
    name: str = "default"


class Answer(NamedTuple):
    """Which law to use.

    attribution: published, adapted or ours. reason: why this law. tested: the set on which it was compared. condition:
    where no law that meets the requirements is faster. price: what it costs. needs: a row a kind of controller, the
    usual one first. Every text is NOT_TESTED where there is no map of situations.
    """

    law: str
    attribution: str
    reason: str
    tested: str
    condition: str
    price: str
    needs: tuple[Need, ...]

    @property
    def is_tested(self) -> bool:
        """Whether there was a map of situations to choose from."""
        return self.law != NOT_TESTED


def find_answer(situations: Path = STUDY, run: Path = RUN) -> Answer:
    """Return which law to use, by the map of situations in a folder, and by a run for robots that the map lacks.

    The answer of what came with the benchmark is kept for the next call: it takes seconds.
    """
    if (situations, run) != (STUDY, RUN) or not run.is_dir():
        return _find(situations, run)
    stored = keep(run, "use-today", lambda: _find(situations, run)._asdict())
    needs = tuple(Need(*need) for need in stored["needs"])
    return Answer(**{**stored, "needs": needs})


def _find(situations: Path, run: Path) -> Answer:
    robots = tuple(_list_robots(run))
    try:
        law = find_default(situations)
    except (BadResults, IndexError):
        # No map, or a map in which no law was drawn at random: nothing was compared.
        nothing = _untested(ANY_START)
        return Answer(
            law=NOT_TESTED,
            attribution=NOT_TESTED,
            reason=NOT_TESTED,
            tested=NOT_TESTED,
            condition=NOT_TESTED,
            price=NOT_TESTED,
            needs=(nothing, *robots),
        )
    needs = (_usual(law, situations), *_list_mapped(law, situations))
    return Answer(
        law,
        attribute(law),
        _reason(law, situations),
        _tested(situations),
        _condition(law, situations),
        _price_of_default(law, situations),
        (*needs, *robots),
    )


def attribute(law: str) -> str:
    """Return whether a law is published, adapted, ours, or yours where this repository does not have it."""
    try:
        return str(find_contender(law).attribution)
    except UnknownWord:
        return "yours"


def _untested(controller: str, name: str = "default") -> Need:
    return Need(controller, NOT_TESTED, NOT_TESTED, NOT_TESTED, NOT_TESTED, name)


def _reason(law: str, folder: Path) -> str:
    shares = measure_shares(law, folder, tie=SPOKEN)
    return (
        f"In {percent(1.0 - shares.failing.value)} of the random situations of gains and motors, "
        "the law meets our requirements: it settles from every start tried, does not first turn "
        f"away from the goal, is not trapped at 180° by a sensor error of {HELD_RAD:g} rad, and "
        f"overshoots by at most {OVERSHOOT:g}° more than the law that overshoots least. "
        f"In {shares.qualified} of the random situations, the law meets the requirements, and no "
        f"other law that meets them is more than {percent(SPOKEN)} faster."
        f"{_name_least_beaten(law, folder, ' Law ', '.')}"
    )


def _name_least_beaten(law: str, folder: Path, before: str, after: str = "") -> str:
    """Name the law that is unbeaten most often, if it is another one, and say why it is not the default."""
    other, share = find_least_beaten(folder)
    if other == law:
        return ""
    limit = ", which must be given the command limit," if reads_limits(find_contender(other).law) else ""
    return (
        f"{before}{other}{limit} does so in {percent(share.value)}, but where laws tie we advise the "
        f"simplest{after}"
    )


def _tested(folder: Path) -> str:
    drawn = sum(map(regions.is_drawn, regions.group_map(folder)))
    population = find_population(folder)
    laws = len(population.qualified) + len(population.excluded)
    return (
        f"{drawn} random situations with {laws} published and adapted laws, in simulations of a "
        "freely turning body. A situation has random gains, command limit, delay, control "
        "period, inertia, spin and jump of the goal"
    )


def _condition(law: str, folder: Path) -> str:
    bounds = describe_bounds(find_bounds(law, folder=folder))
    return (
        "You command torque and cancel the inertia. We changed one number of the nominal situation "
        f"at a time. No other law that meets the requirements is more than {percent(SPOKEN)} "
        f"faster at these values: {bounds}."
    )


def _price_of_default(law: str, folder: Path) -> str:
    """Return what the advised law costs, beside the law of the second widest region; it goes on from the law's name."""
    price, other = find_price(law, folder), find_runner_up(folder)
    costs = join_words(_list_costs(law, folder))
    if other is None:
        return f"{costs}; the median overshoot of the law in the random situations is {price.typical_overshoot:.1f}°"
    beside = find_price(other, folder)
    return (
        f"{costs} (law {other}: {beside.peak:.2g} kp). With gains that give both laws the same peak "
        f"command (peak, in rad/s²), 99 % of the starts settle in {price.at_equal_peak:.1f}/√peak "
        f"seconds ({other}: {beside.at_equal_peak:.1f}/√peak seconds). The median overshoot of "
        f"the law in the random situations is {price.typical_overshoot:.1f}° ({other}: "
        f"{beside.typical_overshoot:.1f}°)"
    )


def _usual(law: str, folder: Path) -> Need:
    shares = measure_shares(law, folder, tie=SPOKEN)
    why = (
        f"in {percent(shares.qualified.value)} of {shares.qualified.of} random situations the law "
        "meets our requirements, and no other law that meets them is more than "
        f"{percent(SPOKEN)} faster"
        f"{_name_least_beaten(law, folder, '; ')}"
    )
    return Need(ANY_START, law, attribute(law), why, join_words(_list_costs(law, folder)))


def _list_mapped(default: str, folder: Path) -> Iterator[Need]:
    """Yield what the map advises where a number or a requirement is another one."""
    bounded = find_bounded(default, folder)
    if bounded:
        bound = COORDINATES["bound"].text
        limits = f"{bounded.low:g} to {bound.format(bounded.high)}"
        if bounded.low == bounded.high:
            limits = bound.format(bounded.low)
        controller = f"{ANY_START}; motors limit the command to {limits}"
        why = explain_bounded(bounded, default)
        yield _by_map("weak-motors", controller, bounded.law, default, folder, why)
    for name, controller, laws, rule in (
        (
            "no-memory",
            "commands torque; the law must need no memory",
            "without memory",
            Rule(forgetful=True),
        ),
        (
            "continuous",
            "commands torque; the command must be continuous",
            "with continuous commands",
            Rule(continuous=True),
        ),
    ):
        law, others = find_default(folder, rule), find_regions(folder, rule)
        share = percent(others[0].advised)
        why = f"of the laws {laws}, this law is advised most often: in {share} of the random situations"
        yield _by_map(name, controller, law, default, folder, why)


def _by_map(name: str, controller: str, law: str, default: str, folder: Path, why: str) -> Need:
    costs = _list_costs(law, folder)
    slower = find_price(law, folder).time / find_price(default, folder).time
    if slower > 1.0 + SPOKEN:
        costs.append(f"takes, if not limited, {slower:.1f} times as long as {default}")
    return Need(controller, law, attribute(law), why, join_words(costs), name)


def _list_costs(law: str, folder: Path) -> list[str]:
    """Return what a law costs in the nominal situation: numbers kept, greatest command, starts that it does not leave.

    From the law's row of the map.
    """
    rows = regions.read_map(folder)
    [row] = rows[(rows["situation"] == NOMINAL.word) & (rows["contender"] == law)].to_dict(
        "records"
    )
    memory = facts_of(law).memory
    costs = [f"stores {memory} numbers"] if memory else []
    costs.append(f"gives commands up to {row['peak']:.2g} kp")
    if row["stuck"]:
        costs.append("is stuck at exactly 180°")
    elif row["trapped"]:
        costs.append(f"can be trapped at 180° by a sensor error of {HELD_RAD:g} rad")
    if row["lost"]:
        costs.append("never settles from some starts")
    return costs


def _list_robots(run: Path) -> Iterator[Need]:
    """Yield what a run advises for robots beside those of the map."""
    for name, robot in ROBOTS.items():
        controller = _CONTROLLERS[name]
        try:
            verdict = decide_for(robot, run)
        except BadResults:
            verdict = None
        if verdict is None or verdict.law is None:
            yield _untested(controller, name)
            continue
        why, price = _describe_verdict(verdict), _price_on_robot(verdict.law, run)
        yield Need(controller, verdict.law, attribute(verdict.law), why, price, name)


_CONTROLLERS = {
    "arm": "controls an arm; no goal is exactly 180° away",
    "velocity": "commands velocities",
    "position": "commands positions, which the robot follows with a lag",
}


def _describe_verdict(verdict: RuleVerdict) -> str:
    if verdict.eligible == 1:
        return "no other law that was tried meets the requirements"
    if verdict.tied:
        is_pair = len(verdict.tied) == 1
        others = f"{' and' if is_pair else ','} {together(verdict.tied)}"
        simplest = "simpler" if is_pair else "the simplest of these"
        return (
            f"{verdict.eligible} laws meet the requirements; no published or adapted law of these is better than this "
            f"law{others}; this law is {simplest}"
        )
    return f"{verdict.eligible} laws meet the requirements; no other published or adapted law of these is better"


def _price_on_robot(law: str, run: Path) -> str:
    """Return what a law costs there: numbers kept, and where the free body of the run fails or is slow with it."""
    memory = facts_of(law).memory
    costs = [f"stores {memory} numbers" if memory else "needs no memory"]
    return join_words([*costs, *_list_weak_places(law, run)])


def _list_weak_places(law: str, run: Path) -> Iterator[str]:
    """Yield where a law fails from rest, where it is slow, and what noise traps it; nothing that was not tried."""
    # They read rows, which the answer of the map does not need.
    from bench.experiments.tables.run import Run
    from bench.findings.claims.adequacy import SLOW
    from bench.findings.failure_places import (
        HALF_TURN,
        describe_failures,
        least_trapping_noise,
        slowness_near_half_turn,
    )
    from bench.findings.replication import starts_at_rest

    try:
        results = Run(run)
        rows = starts_at_rest(results)
        rows = rows[rows["contender"].astype(str) == law]
        noise = least_trapping_noise(results, law)
    except (BadResults, NoEvidence):
        return
    places = describe_failures(rows)
    for place in places:
        yield "is stuck at exactly 180°" if place == HALF_TURN else f"fails at {place}"
    slowness = slowness_near_half_turn(rows)
    if slowness is not None and slowness > SLOW:
        yield f"near 180° takes up to {slowness:.0f} times its median time"
    if noise is not None and math.isfinite(noise):
        yield f"can be trapped at 180° by a sensor error of {noise:g} rad"


def advise_gains(gains: Gains, situations: Path = STUDY) -> str:
    """Say which law the map of situations advises at the damping ratio of some gains; every kp gives the same motion.

    Beyond the map nothing was tested.
    """
    wanted = NOMINAL._replace(zeta=gains.kv / (2.0 * math.sqrt(gains.kp)))
    own = f"kp = {gains.kp:g}, kv = {gains.kv:g} (damping ratio {wanted.zeta:.2g})"
    ask = f"bench advise --kp {gains.kp:g} --kv {gains.kv:g}"
    outside = find_outside(wanted)
    if outside:
        return f"{own}: {NOT_TESTED} in the map (damping ratios {outside[0].low:g} to {outside[0].high:g}); {ask}"
    try:
        nearest, verdict = decide_nearest(wanted, folder=situations)
    except BadResults:
        return f"{own}: {NOT_TESTED}, there is no map of situations; {ask}"
    if verdict.law is None:
        return f"{own}: no law of the map meets the requirements; {ask}"
    is_same = math.isclose(nearest.zeta, wanted.zeta, rel_tol=1e-6)
    near = "" if is_same else f", tested at damping ratio {nearest.zeta:g}"
    return f"{own}: {verdict.law} ({attribute(verdict.law)}){near}; motors, delay: {ask}"


LATER = 6
"""Laws since 1988 that a table beside the paper's three has, at most."""


def list_later_laws() -> list[str]:
    """Return the later laws that matter: those that are advised for some controller, and ours that beats them most."""
    laws = [need.law for need in find_answer().needs if need.law not in (*PAPERS, NOT_TESTED)]
    if find_answer().is_tested:
        ours = keep(STUDY, "faster-laws-of-ours", lambda: {"laws": list_faster_ours()})["laws"]
        laws = [*dict.fromkeys(laws)][: LATER - len(ours[:1])] + ours[:1]
    return [*dict.fromkeys(laws)]
