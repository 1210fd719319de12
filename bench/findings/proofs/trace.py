"""A law's own source, read as rational functions: it is called with symbols, once for each path through its branches.

A value is a quotient of polynomials with rational coefficients, in normal form by relations g^2 = polynomial of its
symbols (|q| = 1, say). Decimal constants are taken as they are written: 0.8 is 4/5. A square root that is no
polynomial, an arc tangent, a cosine and a sine become symbols. A comparison is a decision: a path has a list of them.
"""

import math
import operator
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any, NamedTuple

import sympy as sp
from sympy.polys.domains import QQ
from sympy.polys.fields import FracField
from sympy.polys.orderings import lex
from sympy.polys.rings import PolyElement

ROOTS = tuple(f"root{i}" for i in range(4))
ANGLES, COSINES, SINES = (tuple(f"{word}{i}" for i in range(2)) for word in ("angle", "cosine", "sine"))


class Decision(NamedTuple):
    """What a path knows: a polynomial is below zero, or it is not."""

    polynomial: PolyElement
    is_negative: bool


@dataclass
class Path:
    """One way through a function's branches: what it answered, and under which conditions.

    script, taken: the decisions it had to begin with, and all that were made. relations: polynomials that are zero.
    meanings: what the symbols of roots and angles stand for. angles: (y, x) -> atan2(y, x). turns: angles of cosines.
    """

    script: list[bool]
    answer: Any = None
    taken: list[bool] = field(default_factory=list)
    decisions: list[Decision] = field(default_factory=list)
    relations: list[PolyElement] = field(default_factory=list)
    meanings: dict[str, Any] = field(default_factory=dict)
    angles: dict[tuple, "Traced"] = field(default_factory=dict)
    turns: list["Traced"] = field(default_factory=list)


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
        self.of = {str(one): Traced(one, self) for one in self.field.gens}
        self.positive = [self.of[name].value.numer for name in positive]
        self.constants = dict(constants or {})
        self.relations: list[PolyElement] = []
        self.angles: dict[tuple, Traced] = {}
        """(y, x) -> symbol: angles that are known on every path."""
        self.path = Path([])

    def __getitem__(self, names: tuple[str, ...]) -> Any:
        return tuple(self.of[name] for name in names)

    def relate(self, square_of: str, polynomial: "Traced") -> None:
        """Let the square of a symbol be a polynomial of symbols that come later."""
        self.relations.append((self.of[square_of] ** 2 - polynomial).value.numer)

    def paths(self, function: Callable[[], Any]) -> Iterator[Path]:
        """Call a function of no arguments once for each path through its decisions."""
        script: list[bool] | None = []
        while script is not None:
            self.path = Path(script, angles=dict(self.angles))
            self.path.answer = function()
            yield self.path
            taken = self.path.taken
            while taken and not taken[-1]:
                taken = taken[:-1]
            script = [*taken[:-1], False] if taken else None

    def reduce(self, value: Any) -> "Traced":
        """Return a quotient in normal form; the leading terms are squares of different symbols, a Groebner basis."""
        relations = self.path.relations + self.relations
        numer, denom = (part.rem(relations) if relations else part for part in (value.numer, value.denom))
        return Traced(self.field(numer) / self.field(denom), self)

    def number(self, value: Any) -> "Traced":
        """Return a number as a value: a float as the decimal that it is written as."""
        if isinstance(value, Traced):
            return value
        value = self.constants.get(value, value)
        if isinstance(value, str):
            return self.of[value]
        exact = Fraction(repr(value)) if isinstance(value, float) else Fraction(value)
        return Traced(self.field(QQ(exact.numerator, exact.denominator)), self)

    def derivative(self, value: "Traced", name: str) -> "Traced":
        """Return the partial derivative by a symbol; roots and angles count as constants."""
        return self.reduce(value.value.diff(self.of[name].value))

    def is_negative(self, value: "Traced") -> bool:
        """Decide whether a value is below zero: a number has a sign, else the path decides."""
        polynomial = value.value.numer * value.value.denom
        for one in self.positive:
            while polynomial and not polynomial.rem([one]):
                polynomial = polynomial.quo(one)
        if polynomial.is_ground:
            return polynomial.LC < 0
        path, leading = self.path, polynomial.LC
        for known, answer in path.decisions:
            if known * leading == polynomial * known.LC and leading * known.LC > 0:
                return answer
        answer = path.script[len(path.taken)] if len(path.taken) < len(path.script) else True
        path.taken.append(answer)
        path.decisions.append(Decision(polynomial, answer))
        return answer

    def root_of(self, polynomial: PolyElement) -> "Traced":
        """Return the square root of a polynomial, squares taken out of it by their size."""
        constant, factors = polynomial.factor_list()
        outside, inside = self.number(1), polynomial.ring(1)
        for factor, power in factors:
            if power > 1:
                outside = outside * abs(Traced(self.field(factor), self)) ** (power // 2)
            k, root, rest = self._take_square(factor ** (power % 2))
            constant, outside, inside = constant * k, outside * root, inside * rest
        k, root, inside = self._take_square(inside if constant > 0 else -inside)
        ratio, outside = Fraction(str(abs(constant) * k)), outside * root
        exact = Fraction(math.isqrt(ratio.numerator), math.isqrt(ratio.denominator))
        if exact**2 == ratio:
            outside = outside * self.number(exact)
        else:
            inside = inside * QQ(ratio.numerator, ratio.denominator)
        return outside if inside == 1 else outside * self._root_symbol(inside)

    def _take_square(self, factor: PolyElement) -> tuple:
        """Return (k, |g|, 1) of a factor k g^2 whose square a relation has replaced, else (1, 1, factor)."""
        for relation in self.relations:
            square = relation.ring({relation.LM: QQ(1)}) - relation
            if not factor.is_ground and factor * square.LC == square * factor.LC:
                symbol = Traced(self.field.gens[relation.LM.index(2)], self)
                return factor.LC / square.LC, abs(symbol), factor.ring(1)
        return QQ(1), self.number(1), factor

    def _root_symbol(self, polynomial: PolyElement) -> "Traced":
        path, meaning = self.path, sp.sqrt(polynomial.as_expr())
        known = next((name for name, one in path.meanings.items() if one == meaning), None)
        if known is None:
            known = ROOTS[sum(name in ROOTS for name in path.meanings)]
            path.meanings[known] = meaning
            path.relations.append((self.of[known] ** 2).value.numer - polynomial)
            path.decisions.append(Decision(self.of[known].value.numer, False))
        return self.of[known]

    def angle_of(self, y: "Traced", x: "Traced") -> "Traced":
        """Return atan2(y, x) as a symbol, the same for every positive multiple of both."""
        for (y_0, x_0), symbol in self.path.angles.items():
            if y * x_0 == x * y_0 and not self.is_negative(x * x_0):
                return symbol
        scale = self.number(1)
        if y.value.denom == x.value.denom:
            scale = abs(self.reduce(self.field(y.value.numer.gcd(x.value.numer)) / self.field(y.value.denom)))
        name, (y, x) = ANGLES[len(self.path.angles)], (y / scale, x / scale)
        self.path.angles[y, x] = self.of[name]
        self.path.meanings[name] = sp.atan2(y.value.as_expr(), x.value.as_expr())
        return self.of[name]

    def circle_of(self, angle: "Traced") -> tuple["Traced", "Traced"]:
        """Return (cosine, sine) of an angle as symbols with cosine^2 + sine^2 = 1."""
        turns = self.path.turns
        place = next((i for i, one in enumerate(turns) if one == angle), len(turns))
        cosine, sine = self.of[COSINES[place]], self.of[SINES[place]]
        if place == len(turns):
            turns.append(angle)
            self.path.relations.append((cosine**2 + sine**2 - 1).value.numer)
        return cosine, sine


def _operation(compute: Callable[[Any, Any], Any], is_reflected: bool = False) -> Callable[..., "Traced"]:
    def apply(self: "Traced", other: Any) -> "Traced":
        pair = self.value, self.symbols.number(other).value
        return self.symbols.reduce(compute(*(pair[::-1] if is_reflected else pair)))

    return apply


class Traced:
    """A number of the law dialect, as a rational function; `tally` is what `bench.law.scalar` asks for."""

    tally = None
    __add__ = __radd__ = _operation(operator.add)
    __mul__ = __rmul__ = _operation(operator.mul)
    __sub__, __rsub__ = _operation(operator.sub), _operation(operator.sub, True)
    __truediv__, __rtruediv__ = _operation(operator.truediv), _operation(operator.truediv, True)
    __hash__ = object.__hash__

    def __init__(self, value: Any, symbols: Symbols) -> None:
        self.value, self.symbols = value, symbols

    def __neg__(self) -> "Traced":
        return Traced(-self.value, self.symbols)

    def __pow__(self, power: int) -> "Traced":
        return self.symbols.reduce(self.value**power)

    def __abs__(self) -> "Traced":
        return -self if self.symbols.is_negative(self) else self

    def __eq__(self, other: object) -> bool:
        return not (self - other).value

    def __lt__(self, other: Any) -> bool:
        return self.symbols.is_negative(self - other)

    def __gt__(self, other: Any) -> bool:
        return self.symbols.is_negative(other - self)

    def __ge__(self, other: Any) -> bool:
        return not self < other

    def __le__(self, other: Any) -> bool:
        return not self > other

    def __repr__(self) -> str:
        return str(self.value)

    def sqrt(self) -> "Traced":
        """Return the square root, of numerator and denominator."""
        return self.symbols.root_of(self.value.numer) / self.symbols.root_of(self.value.denom)

    def cos(self) -> "Traced":
        """Return the cosine as a symbol."""
        return self.symbols.circle_of(self)[0]

    def sin(self) -> "Traced":
        """Return the sine as a symbol."""
        return self.symbols.circle_of(self)[1]

    def atan2(self, x: Any) -> "Traced":
        """Return the angle of the point (x, self)."""
        return self.symbols.angle_of(self, self.symbols.number(x))
