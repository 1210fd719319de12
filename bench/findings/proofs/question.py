"""Questions to all paths of a law: is there a state with a fault? A law with memory has two sides."""

import functools
import time
from collections.abc import Callable
from fractions import Fraction
from typing import Any, NoReturn

import numpy as np
from z3 import Real, substitute

from bench.findings.proofs import sampling
from bench.findings.proofs.body import GOAL, QUATERNION, RATES, FreeBody, Tick
from bench.findings.proofs.conditions import CLOSED, PolynomialRelation
from bench.findings.proofs.reasons import LIMITS, DoesNotFit, LemmaFails
from bench.findings.proofs.solver import Lemma, ask, by_algebra, undecided
from bench.findings.proofs.traced_number import are_same
from bench.law.inputs import Gains, Goal
from bench.law.kinds import Law
from bench.law.so3 import Rotation, from_quaternion, rotate_back


class Question:
    """The ticks of a law, and what a theorem makes of each: take(body, tick), made once of those with equal answers."""

    def __init__(self, body: FreeBody, law: Law, take: Callable[[FreeBody, Tick], Any]) -> None:
        self.body, self.has_memory = body, law.memory is not None
        self.ticks: list[Tick] = []
        for tick in body.ticks(law):
            taken = self._taken_before(tick)
            if taken is None:
                body.symbols.path = tick.path
                taken = take(body, tick)
            self.ticks.append(tick._replace(taken=taken))

    def _taken_before(self, tick: Tick) -> Any:
        """Return what was made of a tick with the same answers; None if there is none."""
        for known in self.ticks:
            if (
                known.path.meanings == tick.path.meanings
                and are_same(known.u, tick.u)
                and are_same(known.at_rest, tick.at_rest)
            ):
                return known.taken
        return None

    def refuse_no_ticks(self) -> NoReturn:
        """Refuse a law that answers at no state; with the lemma that its command is finite, if that is why."""
        finite = self.body.finite()
        if finite.is_proved:
            raise DoesNotFit("its source answers at no state")
        raise LemmaFails([finite])

    def never(
        self,
        statement: str,
        faults: Callable[[Tick], list[PolynomialRelation]],
        sides: tuple[int, ...] = (1, -1),
        to_the_edge: bool = False,
        to_180: bool = False,
        where: tuple[PolynomialRelation, ...] = (),
    ) -> Lemma:
        """Return the lemma that no tick on some sides has a state with one of its faults.

        to_the_edge: states at the edge of a path count, too, where its command may differ: a limit is a fault.
        to_180: so do states at eta = 0, where eta is positive on all paths. where: what else holds there.
        """
        if statement:
            LIMITS.asked = statement
        lemma = self._decide(statement, faults, sides, to_the_edge, to_180, where)
        if statement:
            LIMITS.lemmas.append(lemma)
        return lemma

    def _decide(
        self,
        statement: str,
        faults: Callable[[Tick], list[PolynomialRelation]],
        sides: tuple[int, ...],
        to_the_edge: bool,
        to_180: bool,
        where: tuple[PolynomialRelation, ...],
    ) -> Lemma:
        seconds = 0.0
        for tick in self.ticks:
            if tick.side not in sides:
                continue
            self.body.symbols.path = tick.path
            path = _with_edge(tick) if to_the_edge else tick.path
            for possible in faults(tick):
                fault = possible
                if not to_180:  # where eta = 0 counts, it is no factor to be left out
                    fault = PolynomialRelation(
                        self.body.symbols.without_positive(possible.polynomial), possible.relation
                    )
                if fault.answer() is False:
                    continue
                finding = self.body.solver.find(path, *tick.known, *where, fault, to_180=to_180)
                seconds += finding.seconds
                if finding.answer != "unsat":
                    note = undecided(finding.answer, finding.seconds)
                    return Lemma(statement, False, "Z3", seconds, finding.state, note)
        return Lemma(statement, True, "Z3", seconds)

    def meets(self, one: Tick, other: Tick) -> bool:
        """Tell whether two paths may have states of the same eta."""
        solver = self.body.solver
        apart = [(symbol, Real(f"{name}'")) for name, symbol in solver.of.items() if name != "w"]
        formulas = solver.formulas(one.path, *one.known)
        others = [substitute(formula, *apart) for formula in solver.formulas(other.path, *other.known)]
        return ask(*formulas, *others)[0] != "unsat"

    def eta_below(self, end: float) -> PolynomialRelation:
        """Return the condition eta < end."""
        return PolynomialRelation((self.body.eta - self.body.symbols.number(end)).value.numer, "<")

    @functools.cached_property
    def delta(self) -> Fraction:
        """The least delta, to 0.001, with no side kept at eta < -delta; 1 if a side is kept everywhere."""

        def is_never_kept(end: Fraction) -> bool:
            return self.never("", lambda _: [self.eta_below(-float(end))], (1,)).is_proved

        return find_least(is_never_kept, 1000)

    def changes_of_side(self) -> list[Lemma]:
        """Return the lemmas on where a side is kept and where it changes; none of a law without memory."""
        if not self.has_memory:
            return []
        kept, changed = 0.0 - float(min(self.delta, Fraction(99, 100))), 0.0 - float(self.delta)
        is_kept = by_algebra("delta > 0", self.delta > 0)
        above = PolynomialRelation(self.eta_below(changed).polynomial, ">")
        return [
            is_kept,
            self.never(f"a side is kept at eta >= {kept:g} alone", lambda _: [self.eta_below(kept)], (1,)),
            self.never(f"a side changes at eta <= {changed:g} alone", lambda _: [above], (-1,)),
        ]


def _with_edge(tick: Tick) -> Any:
    """Return a tick's path with its edge: what excludes the edge is left out."""
    decisions = [
        PolynomialRelation(condition.polynomial, CLOSED[condition.relation])
        for condition in tick.path.decisions
        if condition.relation in CLOSED
    ]
    path = type(tick.path)(tick.path.script)
    path.decisions = decisions
    path.relations, path.meanings = tick.path.relations, tick.path.meanings
    path.definitions, path.angles = tick.path.definitions, tick.path.angles
    return path


AGREES = "the law's numbers are those of its trace, at states drawn at random"
STATES_A_PATH, TOLERANCE = 8, 1e-6
"""Drawn states on each path, and the difference of commands over the largest, several digits above rounding."""


def agreement_lemma(body: FreeBody, law: Law, ask: Question) -> Lemma:
    """Compare the law, called with numbers, with its trace: a check of the trace, and of what rounding does.

    Where most states of a path differ the lemma is false; single ones may be on the other side of a comparison.
    """
    began = time.perf_counter()
    values = sampling.draw_states(body.symbols, np.random.default_rng(11), 3000)
    for tick in ask.ticks:
        states = sampling.states_on(body.symbols, tick.path, [*tick.path.decisions, *tick.known], values, STATES_A_PATH)
        wrong = [state for state in states if not agrees(body, law, tick, state)]
        if 2 * len(wrong) > len(states):
            seconds = time.perf_counter() - began
            return Lemma(AGREES, False, "drawn states", seconds, wrong[0], "its numbers differ from exact arithmetic")
    return Lemma(AGREES, True, "drawn states", time.perf_counter() - began)


def agrees(body: FreeBody, law: Law, tick: Tick, state: dict[str, float]) -> bool:
    """Tell whether a law answers at a state as its trace does."""
    expected = [float(sampling.evaluate_ratio(body.symbols, part, state)) for part in tick.u]
    number = np.float64
    q, goal = (tuple(number(state[name]) for name in names) for names in (QUATERNION, GOAL))
    omega = tuple(number(state[name]) for name in RATES)
    E, R_d = from_quaternion(q), from_quaternion(goal)
    R = Rotation(*(rotate_back(E, column) for column in R_d))
    memory = () if law.memory is None else (tuple(number(state["size"]) * part for part in q),)
    evaluate: Any = law.law
    with np.errstate(all="ignore"):
        answer = evaluate(R, omega, Goal(R_d), Gains(number(state["kp"]), number(state["kv"])), *memory)
    u = answer[0] if memory else answer
    scale = max(1e-9, *map(abs, expected), state["kv"] * max(map(abs, omega)))
    return all(abs(float(part) - other) <= TOLERANCE * scale for part, other in zip(u, expected, strict=True))


def find_least(holds: Callable[[Fraction], bool], steps: int) -> Fraction:
    """Return the least k/steps at which a condition holds that goes on to hold; 1 if it does at none below."""
    low, high = -1, steps
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(Fraction(middle, steps)) else (middle, high)
    return Fraction(high, steps)
