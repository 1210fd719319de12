"""Questions to all paths of a law: is there a state with a fault? A law with memory has two sides."""

import functools
from collections.abc import Callable
from fractions import Fraction
from typing import Any

from z3 import Real, substitute

from bench.findings.proofs.body import FreeBody, Tick
from bench.findings.proofs.solver import Lemma, by_algebra
from bench.law.kinds import Law


class Question:
    """The ticks of a law, and what a theorem makes of each: take(body, tick), made once of those with equal answers."""

    def __init__(self, body: FreeBody, law: Law, take: Callable[[FreeBody, Tick], Any]) -> None:
        self.body, self.has_memory, self.ticks = body, law.memory is not None, list[Tick]()
        self.eta = body.solver.of["w"]
        for tick in body.ticks(law):
            mine = tick.u, tick.at_rest, tick.path.meanings
            same = (one.taken for one in self.ticks if (one.u, one.at_rest, one.path.meanings) == mine)
            self.ticks.append(tick._replace(taken=next(same, None) or take(body, tick)))

    def never(self, statement: str, fault: Callable[[Tick], Any], sides: tuple[int, ...] = (1, -1)) -> Lemma:
        """Return the lemma that no tick on some sides has a state with a fault, Z3's condition."""
        seconds = 0.0
        for tick in self.ticks:
            if tick.side in sides:
                self.body.symbols.path = tick.path
                answer, state, lasted = self.body.solver.find(*tick.known, fault(tick))
                seconds += lasted
                if answer != "unsat":
                    return Lemma(statement, False, "Z3", seconds, state)
        return Lemma(statement, True, "Z3", seconds)

    def meets(self, one: Tick, other: Tick) -> bool:
        """Tell whether two paths may have states of the same eta."""
        apart = [(symbol, Real(f"{name}'")) for name, symbol in self.body.solver.of.items() if name != "w"]
        known = [substitute(condition, *apart) for condition in other.known]
        return self.body.solver.find(*one.known, *known)[0] != "unsat"

    @functools.cached_property
    def delta(self) -> Fraction:
        """The least delta, to 0.001, with no side kept at eta < -delta; 1 if a side is kept everywhere."""
        return find_least(lambda end: self.never("", lambda _: self.eta < -float(end), (1,)).is_proved, 1000)

    def changes_of_side(self) -> list[Lemma]:
        """Return the lemmas on where a side is kept and where it changes; none of a law without memory."""
        if not self.has_memory:
            return []
        is_kept = by_algebra("delta > 0", self.delta > 0)
        kept, changed = 0.0 - float(min(self.delta, Fraction(99, 100))), 0.0 - float(self.delta)
        return [
            is_kept,
            self.never(f"a side is kept at eta >= {kept:g} alone", lambda _: self.eta < kept, (1,)),
            self.never(f"a side changes at eta <= {changed:g} alone", lambda _: self.eta > changed, (-1,)),
        ]


def find_least(holds: Callable[[Fraction], bool], steps: int) -> Fraction:
    """Return the least k/steps at which a condition holds that goes on to hold; 1 if it does at none below."""
    low, high = -1, steps
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(Fraction(middle, steps)) else (middle, high)
    return Fraction(high, steps)
