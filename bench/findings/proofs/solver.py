"""Inequalities of polynomials, decided by Z3: a claim holds where what contradicts it has no solution."""

import time
from collections.abc import Iterable
from fractions import Fraction
from typing import Any, NamedTuple

import z3
from sympy.polys.rings import PolyElement

from bench.findings.proofs import sampling
from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.paths import Path
from bench.findings.proofs.reasons import LIMITS
from bench.findings.proofs.trace import Symbols
from bench.findings.proofs.traced_number import Traced, is_zero
from bench.law.inputs import PAPERS_GAINS

FIRST_TRY_S = 3.0
"""How long Z3 is asked before states are drawn. Nearly every question is answered in less than 0.1 s."""
CONFIRMING_S = 2.0
"""How long Z3 may take to confirm a state that was drawn, all its numbers but one fixed."""


class Lemma(NamedTuple):
    """One statement of a proof.

    Attributes:
        statement: What is said.
        is_proved: Whether it is proved.
        by: "Z3", "algebra" or "drawn states" (with which it can be refuted alone).
        seconds: How long that took.
        counterexample: Symbol -> number, where it is false; None where it is proved, or not decided.
        note: Why it is not proved, where no state says so.
        is_basic: Whether every theorem needs it.
    """

    statement: str
    is_proved: bool
    by: str
    seconds: float
    counterexample: dict[str, float] | None = None
    note: str = ""
    is_basic: bool = False


class SolverAnswer(NamedTuple):
    """What was found on some conditions: "unsat", "sat" with a state, or "unknown"."""

    answer: str
    state: dict[str, float] | None
    seconds: float


def ask(*conditions: Any, limit_s: float | None = None) -> tuple[str, Any, float]:
    """Return Z3's answer to some conditions, a model if it has one, and its seconds.

    Errors:
        TimeIsUp: the time for the law is over.
    """
    limit_s = min(LIMITS.question_s if limit_s is None else limit_s, LIMITS.left_s())
    solver, began = z3.Solver(), time.perf_counter()
    solver.set("timeout", max(1, round(1000 * limit_s)))
    solver.add(*conditions)
    answer = solver.check()
    return str(answer), solver.model() if answer == z3.sat else None, time.perf_counter() - began


def decide(statement: str, known: list[Any], fault: Any) -> Lemma:
    """Return the lemma that no numbers for which something is known have a fault."""
    answer, _, seconds = ask(*known, fault)
    return Lemma(statement, answer == "unsat", "Z3", seconds, note=undecided(answer, seconds))


def undecided(answer: str, seconds: float) -> str:
    """Return the note on a question that was not decided; nothing of one that was."""
    return f"Z3 did not decide it in {seconds:.0f} s (--lemma-limit)" if answer == "unknown" else ""


def by_algebra(statement: str, holds: Any) -> Lemma:
    """Return a lemma on exact numbers: that something holds, or that expressions are zero in normal form."""
    parts = holds if isinstance(holds, tuple | list) else (holds,)
    is_proved = all(map(_holds, parts))
    return Lemma(statement, is_proved, "algebra", 0.0, note="" if is_proved else "it does not hold")


def _holds(part: Any) -> bool:
    if isinstance(part, bool):
        return part
    return is_zero(part) if isinstance(part, Traced) else bool(part == 0)


class Solver:
    """Z3, which knows the relations of a trace's symbols."""

    def __init__(self, symbols: Symbols) -> None:
        self.symbols = symbols
        self.of = {str(generator): z3.Real(str(generator)) for generator in symbols.field.gens}
        self.names = list(self.of)
        self.given: list[Any] = [self.of[str(symbol)] > 0 for symbol in symbols.positive]
        self._terms: dict[PolyElement, Any] = {}

    def term(self, polynomial: PolyElement) -> Any:
        """Return a polynomial as Z3 has it."""
        if polynomial not in self._terms:
            self._terms[polynomial] = self._make_term(polynomial)
        return self._terms[polynomial]

    def _make_term(self, polynomial: PolyElement) -> Any:
        terms = []
        for powers, coefficient in polynomial.terms():
            ratio = Fraction(int(coefficient.numerator), int(coefficient.denominator))
            factors = [z3.RealVal(str(ratio))]
            for name, power in zip(self.names, powers, strict=True):
                factors += [self.of[name]] * power
            terms.append(z3.Product(*factors))
        return z3.Sum(terms) if terms else z3.RealVal(0)

    def formula(self, condition: PolynomialRelation) -> Any:
        """Return a condition as Z3 has it."""
        term = self.term(condition.polynomial)
        formulas = {
            "<": term < 0,
            "<=": term <= 0,
            ">": term > 0,
            ">=": term >= 0,
            "=": term == 0,
            "!=": term != 0,
        }
        return formulas[condition.relation]

    def sign(self, value: Traced) -> Any:
        """Return a term that has the sign of a value."""
        return self.term(sign_of(value))

    def is_below(self, value: Traced, strictly: bool = True) -> Any:
        """Return Z3's condition that a value is below zero, or at most zero."""
        return self.sign(value) < 0 if strictly else self.sign(value) <= 0

    def facts(self, path: Path) -> list[Any]:
        """Return what Z3 knows on every path: the relations of the symbols, and what an arc tangent's sign is."""
        facts = [self.term(relation) == 0 for relation in path.relations]
        for angle in path.angles:
            y, x, symbol = self.sign(angle.y), self.sign(angle.x), self.sign(angle.symbol)
            facts += [
                z3.Implies(y > 0, symbol > 0),
                z3.Implies(y < 0, symbol < 0),
                z3.Implies(z3.And(y == 0, x > 0), symbol == 0),
                # a little more than pi
                symbol * 1000 < 3142,
                symbol * 1000 > -3142,
            ]
        return facts

    def formulas(
        self, path: Path, *conditions: PolynomialRelation, to_180: bool = False
    ) -> list[Any]:
        """Return all that Z3 is given of a path and some conditions; to_180: eta may be zero where it is positive."""
        mentioned = [*path.decisions, *conditions]
        polynomials = [condition.polynomial for condition in mentioned] + path.relations
        polynomials += [sign_of(value) for angle in path.angles for value in (angle.y, angle.x)]
        relations = [relation for relation in self.symbols.relations if _shares(relation, polynomials)]
        formulas = [self.term(relation) == 0 for relation in relations]
        formulas += [self.formula(condition) for condition in mentioned]
        given = self.given
        if to_180:
            names = [str(symbol) for symbol in self.symbols.positive]
            given = [self.of[name] >= 0 if name == "w" else self.of[name] > 0 for name in names]
        return [*given, *formulas, *self.facts(path)]

    def find(
        self,
        path: Path,
        *conditions: PolynomialRelation,
        limit_s: float | None = None,
        to_180: bool = False,
    ) -> SolverAnswer:
        """Find a state on a path that meets conditions: first Z3 is asked, then states are drawn, then Z3 again.

        limit_s: seconds for Z3; then nothing is drawn.
        """
        formulas = self.formulas(path, *conditions, to_180=to_180)
        first_s = FIRST_TRY_S if limit_s is None else limit_s
        answer, model, seconds = ask(*formulas, limit_s=first_s)
        if answer == "sat":
            return SolverAnswer(answer, self._with_papers_gains(formulas, model), seconds)
        if answer == "unsat" or limit_s is not None:
            return SolverAnswer(answer, None, seconds)
        began = time.perf_counter()
        for state in sampling.search(self.symbols, path, conditions):
            confirmed = self._confirm(formulas, state)
            if confirmed:
                return SolverAnswer("sat", confirmed, seconds + time.perf_counter() - began)
        answer, model, _ = ask(*formulas)
        seconds = time.perf_counter() - began + seconds
        return SolverAnswer(answer, self._state(model) if model is not None else None, seconds)

    def _with_papers_gains(self, formulas: list[Any], model: Any) -> dict[str, float]:
        """Return a state of a model, one with the paper's gains if there is one."""
        gains = PAPERS_GAINS._asdict().items()
        papers = [self.of[name] == z3.RealVal(value) for name, value in gains if name in self.of]
        better = ask(*formulas, *papers, limit_s=FIRST_TRY_S)[1] if papers else None
        return self._state(better or model)

    def _confirm(self, formulas: list[Any], state: dict[str, float]) -> dict[str, float] | None:
        """Return a drawn state as Z3 confirms it, one number of each unit quaternion left to Z3; None: it does not."""
        fixed = []
        for name, value in state.items():
            if name in sampling.LEFT_OPEN:
                fixed.append(self.of[name] >= 0 if value >= 0 else self.of[name] <= 0)
            else:
                exact = Fraction(value).limit_denominator(10**12)
                fixed.append(self.of[name] == z3.RealVal(str(exact)))
        model = ask(*formulas, *fixed, limit_s=CONFIRMING_S)[1]
        return self._state(model) if model is not None else None

    def _state(self, model: Any) -> dict[str, float]:
        return {name: _number(model.eval(symbol, model_completion=True)) for name, symbol in self.of.items()}


def sign_of(value: Traced) -> PolyElement:
    """Return a polynomial that has the sign of a value."""
    return value.value.numer * value.value.denom


def is_below(value: Traced, strictly: bool = True) -> PolynomialRelation:
    """Return the condition that a value is below zero, or at most zero."""
    return PolynomialRelation(sign_of(value), "<" if strictly else "<=")


def _shares(relation: PolyElement, polynomials: Iterable[PolyElement]) -> bool:
    """Tell whether a relation has a symbol of some polynomials: one that has none constrains none of them."""
    mentioned = _places(relation)
    return any(mentioned & _places(polynomial) for polynomial in polynomials)


def _places(polynomial: PolyElement) -> set[int]:
    """Return the places of the symbols that a polynomial has."""
    return {place for powers in polynomial.monoms() for place, power in enumerate(powers) if power}


def _number(value: Any) -> float:
    if z3.is_algebraic_value(value):
        value = value.approx(20)
    return float(value.as_fraction())
