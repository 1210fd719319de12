"""A law's own source, read as rational functions: it is called with symbols, once for each path through its branches.

A value is a quotient of polynomials with rational coefficients, in normal form by relations g^2 = polynomial of its
symbols (|q| = 1, say). Decimal constants are taken as they are written: 0.8 is 4/5. A square root that is no
polynomial, an arc tangent, a cosine and a sine become symbols.

Every comparison, `==` and the truth of a number among them, is a decision: a path has a list of them, and both ways are
followed. Before a division, a root, an inverse cosine and an arc tangent the solver is asked whether a state on the
path makes it undefined, and before anything is cancelled: x/x is a fault where x may be 0. Such a state is a `Doubt`;
the path then goes on without it.
"""

import math
import sys
from collections.abc import Callable, Iterator, Mapping
from fractions import Fraction
from pathlib import Path as File
from types import FrameType
from typing import Any

import numpy as np
import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.fields import FracField
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement

from bench.findings.proofs.conditions import PolynomialRelation, find_answer
from bench.findings.proofs.paths import Angle, Definition, Doubt, Oracle, Path, PathEnds
from bench.findings.proofs.reasons import LIMITS, TimeIsUp, Untraceable, describe_error, is_of_a_law
from bench.findings.proofs.traced_number import Traced, is_same

ROOTS = tuple(f"root{i}" for i in range(4))
ANGLES = tuple(f"angle{i}" for i in range(2))
COSINES = tuple(f"cosine{i}" for i in range(2))
SINES = tuple(f"sine{i}" for i in range(2))

MOST_PATHS = 3000
"""Paths of one law that are followed: the shipped laws have up to 100."""
PRUNING_S = 2.0
"""Seconds in which Z3 may show that a branch is never taken; later than that, it is followed."""


class Symbols:
    """The field of rational functions in which a law is traced, and the path on which it is.

    constants: float -> the symbol or the fraction that it stands for, of constants that are no short decimals.
    """

    def __init__(
        self,
        names: tuple[str, ...],
        positive: tuple[str, ...] = (),
        constants: Mapping[float, str | Fraction] | None = None,
    ) -> None:
        self.field = FracField((*ROOTS, *ANGLES, *COSINES, *SINES, *names), QQ, lex)
        self.of = {str(generator): Traced(generator, self) for generator in self.field.gens}
        self.positive = [self.of[name].value.numer for name in positive]
        self.constants = dict(constants or {})
        self.relations: list[PolyElement] = []
        self.angles: list[Angle] = []
        """Angles that are known on every path."""
        self.path = Path([])
        self.is_tracing = False
        """Whether a law runs: only then is a comparison a decision, and a division a question."""
        self.oracle: Oracle | None = None
        self.doubts: list[Doubt] = []
        self.requirements: list[PolynomialRelation] = []
        """What must not hold, where there is no oracle to ask."""
        self.questions = 0
        self.question_s = 0.0
        self._answers: dict[tuple, Any] = {}
        self._results: dict[tuple, Any] = {}

    def __getitem__(self, names: tuple[str, ...]) -> Any:
        return tuple(self.of[name] for name in names)

    def relate(self, square_of: str, polynomial: Traced) -> None:
        """Let the square of a symbol be a polynomial of symbols that come later."""
        self.relations.append((self.of[square_of] ** 2 - polynomial).value.numer)

    def paths(self, function: Callable[[], Any]) -> Iterator[Path]:
        """Call a function of no arguments once for each path through its decisions.

        Errors:
            Untraceable: it cannot be called with symbols, or has too many paths.
        """
        script: list[bool] | None = []
        count = 0
        while script is not None:
            LIMITS.left_s()
            count += 1
            if count > MOST_PATHS:
                raise Untraceable(f"its source has more than {MOST_PATHS} paths")
            path = Path(script, angles=list(self.angles))
            self._follow(path, function)
            if not path.is_over:
                yield path
            script = _next_script(path.taken)

    def _follow(self, path: Path, function: Callable[[], Any]) -> None:
        """Call a function on a path, and keep its answer there."""
        self.path = path
        self.is_tracing = True
        try:
            path.answer = function()
        except PathEnds:
            path.is_over = True
        except (Untraceable, TimeIsUp):
            raise
        except Exception as error:
            raise Untraceable(f"its source cannot be called with symbols ({describe_error(error)})") from error
        finally:
            self.is_tracing = False

    def reduce(self, value: Any) -> Traced:
        """Return a quotient in normal form; the leading terms are squares of different symbols, a Groebner basis."""
        relations = self.path.relations + self.relations
        numer, denom = value.numer, value.denom
        if relations:
            numer, denom = numer.rem(relations), denom.rem(relations)
        if not denom:
            raise Untraceable("it divides by an expression that is zero by the relations of its roots")
        return Traced(self.field(numer) / self.field(denom), self)

    def compute(self, operation: Callable[[Any, Any], Any], left: Any, right: Any) -> Traced:
        """Return the result of an operation in normal form: each is made once, for paths begin alike."""
        key = (operation, left, right, tuple(self.path.relations))
        result = self._results.get(key)
        if result is None:
            result = self._results[key] = self.reduce(operation(left, right)).value
        return Traced(result, self)

    def number(self, value: Any) -> Traced:
        """Return a number as a value: a float as the decimal that it is written as."""
        if isinstance(value, Traced):
            return value
        if isinstance(value, np.floating):
            value = float(value)
        if not isinstance(value, int | float | Fraction):
            raise Untraceable(f"it computes with {value!r}, which is no number")
        if isinstance(value, float) and not math.isfinite(value):
            raise Untraceable(f"it computes with {value!r}, which is no finite number")
        meaning: Any = self.constants.get(float(value), value)
        if isinstance(meaning, str):
            return self.of[meaning]
        exact = Fraction(repr(meaning)) if isinstance(meaning, float) else Fraction(meaning)
        return Traced(self.field(QQ(exact.numerator, exact.denominator)), self)

    def derivative(self, value: Traced, name: str) -> Traced:
        """Return the partial derivative by a symbol; roots and angles count as constants."""
        return self.reduce(value.value.diff(self.of[name].value))

    # decisions

    def decide(self, value: Traced, relation: str) -> bool:
        """Decide whether a value has a relation to zero: a number has it or not, else the path decides."""
        if not self.is_tracing:
            raise RuntimeError("a comparison of symbols outside a law's source: use is_zero or is_same")
        condition = PolynomialRelation(
            self.without_positive(value.value.numer * value.value.denom), relation
        ).normal()
        known = condition.answer()
        if known is None:
            known = find_answer(self.path.decisions, condition)
        if known is not None:
            return known
        return self._branch(condition)

    def _branch(self, condition: PolynomialRelation) -> bool:
        """Follow the way that the path's script says, or a new one: the first that may have a state."""
        path = self.path
        place = len(path.taken)
        is_new = place >= len(path.script)
        answer = True if is_new else path.script[place]
        if is_new and self._is_impossible(condition):
            answer = False
        elif not answer and place == len(path.script) - 1 and self._is_impossible(condition.opposite()):
            path.taken.append(answer)
            raise PathEnds
        path.taken.append(answer)
        path.decisions.append(condition if answer else condition.opposite())
        return answer

    def choose(self) -> bool:
        """Decide what no number of the trace decides: both ways are followed, without a condition."""
        path = self.path
        place = len(path.taken)
        answer = path.script[place] if place < len(path.script) else True
        path.taken.append(answer)
        return answer

    def is_negative(self, value: Traced) -> bool:
        """Decide whether a value is below zero."""
        return self.decide(value, "<")

    def without_positive(self, polynomial: PolyElement) -> PolyElement:
        """Return a polynomial without the factors that are positive."""
        for factor in self.positive:
            while polynomial and not polynomial.rem([factor]):
                polynomial = polynomial.quo(factor)
        return polynomial

    def _is_impossible(self, condition: PolynomialRelation) -> bool:
        """Tell whether Z3 shows that no state on the path meets a condition."""
        if self.oracle is None:
            return False
        return self._ask(condition, PRUNING_S).answer == "unsat"

    def _ask(self, condition: PolynomialRelation, limit_s: float | None = None) -> Any:
        """Return the oracle's finding on the path and a condition; each question is asked once."""
        assert self.oracle is not None
        key = (self.path.key(), condition, limit_s)
        if key not in self._answers:
            self._answers[key] = self.oracle.find(self.path, condition, limit_s=limit_s)
        return self._answers[key]

    # domains

    def require_not(self, fault: PolynomialRelation, words: str) -> None:
        """Ask whether a state on the path has a fault, before an operation that is undefined there."""
        if not self.is_tracing:
            return
        fault = PolynomialRelation(self.without_positive(fault.polynomial), fault.relation).normal()
        is_certain = fault.answer()
        if is_certain is None:
            is_certain = find_answer(self.path.decisions, fault)
        if is_certain is False:
            return
        if self.oracle is None:
            self.requirements.append(fault)
            return
        finding = self._ask(fault)
        self.questions += 1
        self.question_s += finding.seconds
        if finding.answer != "unsat":
            self.doubts.append(Doubt(f"{words}{find_place()}", finding.state, finding.seconds))
        if is_certain:
            raise PathEnds
        self.path.decisions.append(fault.opposite())

    def require_divisor(self, divisor: Traced) -> None:
        """Ask whether a divisor may be zero."""
        numer = divisor.value.numer
        if len(numer.terms()) > 1 or numer.is_ground:
            self.require_not(PolynomialRelation(numer, "="), "a division by zero")
            return
        # a product of symbols is zero where one of them is
        for place, power in enumerate(numer.LM):
            if power:
                factor = self.field.gens[place].numer
                self.require_not(PolynomialRelation(factor, "="), "a division by zero")

    # functions

    def root_of(self, polynomial: PolyElement) -> Traced:
        """Return the square root of a polynomial, squares taken out of it by their size."""
        if polynomial.is_ground and not polynomial:
            return self.number(0)
        constant, factors = polynomial.factor_list()
        outside, inside = self.number(1), polynomial.ring(1)
        for factor, power in factors:
            if power > 1:
                outside = outside * abs(Traced(self.field(factor), self)) ** (power // 2)
            k, root, rest = self._take_square(factor ** (power % 2))
            constant, outside, inside = constant * k, outside * root, inside * rest
        k, root, inside = self._take_square(inside if constant > 0 else -inside)
        if inside == -1 or k < 0:
            # minus a square: it has a root where the square is zero, so that nothing may be taken out
            return self._root_symbol(polynomial)
        ratio, outside = Fraction(str(abs(constant) * k)), outside * root
        exact = Fraction(math.isqrt(ratio.numerator), math.isqrt(ratio.denominator))
        if exact**2 == ratio:
            outside = outside * self.number(exact)
        else:
            inside = inside * QQ(ratio.numerator, ratio.denominator)
        if inside == 1:
            return outside
        # where a square that was taken out is zero, the rest may be below zero, and the root is defined
        # all the same
        self.require_not(
            PolynomialRelation(inside, "<"), "a square root of zero times a number below zero"
        )
        return outside * self._root_symbol(inside)

    def _take_square(self, factor: PolyElement) -> tuple:
        """Return (k, |g|, 1) of a factor k g^2 whose square a relation has replaced, else (1, 1, factor)."""
        for relation in self.relations:
            square = relation.ring({relation.LM: QQ(1)}) - relation
            if not factor.is_ground and factor * square.LC == square * factor.LC:
                symbol = Traced(self.field.gens[relation.LM.index(2)], self)
                return factor.LC / square.LC, abs(symbol), factor.ring(1)
        return QQ(1), self.number(1), factor

    def _root_symbol(self, polynomial: PolyElement) -> Traced:
        """Return the symbol of the root of a polynomial: a new one, unless the path has it."""
        path, meaning = self.path, sp.sqrt(polynomial.as_expr())
        for name, known in path.meanings.items():
            if known == meaning:
                return self.of[name]
        used = sum(name in ROOTS for name in path.meanings)
        if used == len(ROOTS):
            raise Untraceable(f"its source has more than {len(ROOTS)} square roots on one path")
        name = ROOTS[used]
        symbol = self.of[name]
        path.meanings[name] = meaning
        path.definitions.append(Definition(name, "root", (Traced(self.field(polynomial), self),)))
        path.relations.append((symbol**2).value.numer - polynomial)
        path.decisions.append(PolynomialRelation(symbol.value.numer, ">="))
        return symbol

    def angle_of(self, y: Traced, x: Traced) -> Traced:
        """Return atan2(y, x) as a symbol, the same for every positive multiple of both."""
        self._require_point(y, x)
        for known in self.path.angles:
            if is_same(y * known.x, x * known.y):
                # (y, x) is k (y_0, x_0), and this has the sign of k
                multiple = x * known.x + y * known.y
                if self.decide(multiple, ">"):
                    return known.symbol
        scale = self.number(1)
        if y.value.denom == x.value.denom:
            common = y.value.numer.gcd(x.value.numer)
            if not common.is_ground:
                scale = abs(Traced(self.field(common), self))
        if len(self.path.angles) == len(ANGLES):
            raise Untraceable(f"its source has more than {len(ANGLES)} arc tangents on one path")
        name = ANGLES[len(self.path.angles)]
        symbol = self.of[name]
        self.path.definitions.append(Definition(name, "angle", (y, x)))
        y, x = self._without_tracing(lambda: (y / scale, x / scale))
        self.path.angles.append(Angle(y, x, symbol))
        self.path.meanings[name] = sp.atan2(y.value.as_expr(), x.value.as_expr())
        return symbol

    def _require_point(self, y: Traced, x: Traced) -> None:
        """Ask whether both arguments of an arc tangent may be zero."""
        if not self.is_tracing:
            return
        size = self._without_tracing(lambda: y * y + x * x)
        self.require_not(PolynomialRelation(size.value.numer, "="), "an arc tangent of (0, 0)")

    def _without_tracing(self, compute: Callable[[], Any]) -> Any:
        """Compute something that the law does not compute."""
        self.is_tracing = False
        try:
            return compute()
        finally:
            self.is_tracing = True

    def circle_of(self, angle: Traced) -> tuple[Traced, Traced]:
        """Return (cosine, sine) of an angle as symbols with cosine^2 + sine^2 = 1."""
        turns = self.path.turns
        place = next((i for i, turn in enumerate(turns) if is_same(turn, angle)), len(turns))
        if place == len(COSINES):
            raise Untraceable(f"its source has cosines of more than {len(COSINES)} angles on one path")
        cosine, sine = self.of[COSINES[place]], self.of[SINES[place]]
        if place == len(turns):
            turns.append(angle)
            self.path.relations.append((cosine**2 + sine**2 - 1).value.numer)
            self.path.definitions.append(Definition(COSINES[place], "cosine", (angle,)))
            self.path.definitions.append(Definition(SINES[place], "sine", (angle,)))
        return cosine, sine


def _next_script(taken: list[bool]) -> list[bool] | None:
    """Return the decisions of the next path: the last one that was true is false; None: there is no next path."""
    while taken and not taken[-1]:
        taken = taken[:-1]
    return [*taken[:-1], False] if taken else None


def find_place() -> str:
    """Return the file and the line of the law that runs; nothing if no file of a law is on the stack."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        if is_of_a_law(frame.f_code.co_filename) and not frame.f_code.co_filename.endswith("law/scalar.py"):
            return f" ({File(frame.f_code.co_filename).name}, line {frame.f_lineno})"
        frame = frame.f_back
    return ""
