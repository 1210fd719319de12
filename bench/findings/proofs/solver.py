"""Inequalities of polynomials, decided by Z3: a claim holds where what contradicts it has no solution."""

import time
from fractions import Fraction
from typing import Any, NamedTuple

import z3
from sympy.polys.rings import PolyElement

from bench.findings.proofs.trace import Path, Symbols, Traced
from bench.law.inputs import PAPERS_GAINS

PATIENCE_S = 60
"""After which Z3 gives up on one inequality."""


class Lemma(NamedTuple):
    """One statement. counterexample: symbol -> number, where it is false; None where it is proved, or not decided."""

    statement: str
    is_proved: bool
    by: str
    seconds: float
    counterexample: dict[str, float] | None = None


def ask(*conditions: Any) -> tuple[str, Any, float]:
    """Return Z3's answer to some conditions, a model if it has one, and its seconds."""
    solver, began = z3.Solver(), time.perf_counter()
    solver.set("timeout", 1000 * PATIENCE_S)
    solver.add(*conditions)
    answer = solver.check()
    return str(answer), solver.model() if answer == z3.sat else None, time.perf_counter() - began


def decide(statement: str, known: list[Any], fault: Any) -> Lemma:
    """Return the lemma that no numbers for which something is known have a fault."""
    answer, _, seconds = ask(*known, fault)
    return Lemma(statement, answer == "unsat", "Z3", seconds)


def by_algebra(statement: str, holds: Any) -> Lemma:
    """Return a lemma on exact numbers: that something holds, or that expressions are zero in normal form."""
    parts = holds if isinstance(holds, tuple | list) else (holds,)
    return Lemma(statement, all(part is True or (part is not False and part == 0) for part in parts), "algebra", 0.0)


class Solver:
    """Z3, which knows the relations of a trace's symbols."""

    def __init__(self, symbols: Symbols) -> None:
        self.symbols = symbols
        self.of = {str(one): z3.Real(str(one)) for one in symbols.field.gens}
        self.given: list[Any] = [self.of[str(one)] > 0 for one in symbols.positive]

    def term(self, polynomial: PolyElement) -> Any:
        """Return a polynomial as Z3 has it."""
        names = [str(one) for one in self.symbols.field.gens]
        terms = []
        for powers, coefficient in polynomial.terms():
            factors = [self.of[name] for name, power in zip(names, powers, strict=True) for _ in range(power)]
            ratio = Fraction(int(coefficient.numerator), int(coefficient.denominator))
            terms.append(z3.Product(z3.RealVal(str(ratio)), *factors))
        return z3.Sum(terms) if terms else z3.RealVal(0)

    def sign(self, value: Traced) -> Any:
        """Return a term that has the sign of a value."""
        return self.term(value.value.numer * value.value.denom)

    def is_below(self, value: Traced, strictly: bool = True) -> Any:
        """Return Z3's condition that a value is below zero, or at most zero."""
        return self.sign(value) < 0 if strictly else self.sign(value) <= 0

    def is_zero(self, *polynomials: PolyElement) -> Any:
        """Return Z3's condition that one of some polynomials is zero."""
        return z3.Or(*(self.term(one) == 0 for one in polynomials))

    def condition(self, path: Path) -> list[Any]:
        """Return what a path knows, the relations of its symbols, and that atan2(y, x) has the sign of y."""
        known = [self.term(one) == 0 for one in [*self.symbols.relations, *path.relations]]
        known += [self.term(one) < 0 if is_negative else self.term(one) >= 0 for one, is_negative in path.decisions]
        for (y, _), angle in path.angles.items():
            known += [z3.Implies(self.sign(one * y) > 0, self.sign(one * angle) > 0) for one in (1, -1)]
        return known

    def find(self, *contradictions: Any) -> tuple[str, dict[str, float] | None, float]:
        """Return ("unsat", None, s), ("sat", a solution, s) or ("unknown", None, s)."""
        answer, model, seconds = ask(*self.given, *contradictions)
        if model is not None:  # one with the paper's gains, if there is one
            papers = [
                self.of[name] == z3.RealVal(value) for name, value in PAPERS_GAINS._asdict().items() if name in self.of
            ]
            model = ask(*self.given, *contradictions, *papers)[1] or model
            return (
                answer,
                {name: _number(model.eval(one, model_completion=True)) for name, one in self.of.items()},
                seconds,
            )
        return answer, None, seconds


def _number(value: Any) -> float:
    if z3.is_algebraic_value(value):
        value = value.approx(20)
    return float(value.as_fraction())
