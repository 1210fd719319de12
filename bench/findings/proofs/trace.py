"""A law's own source, read as rational functions: it is called with symbols, once for each path through its branches.

A value is a quotient of polynomials with rational coefficients, reduced by the relations of its symbols (|q| = 1, say).
Decimal constants are taken as they are written: 0.8 is 4/5. A square root that is no polynomial, and an arc tangent,
become symbols of their own, with their relations. A comparison is a decision: each path has its list of them.
"""

import math
from collections.abc import Callable, Iterator, Mapping
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
    """What a path knows of a polynomial: it is "<", ">=", ">" or "==" zero."""

    polynomial: PolyElement
    sign: str


class Path(NamedTuple):
    """answer: what the function returned, in symbols. decisions: under which conditions.

    relations: polynomials that are zero. meanings: what roots and angles stand for. signs: (y, angle) of angles that have
    the sign of y. turns: the angles whose cosines and sines are symbols.
    """

    answer: Any
    decisions: list[Decision]
    relations: list[PolyElement]
    meanings: dict[str, Any]
    signs: list[tuple]
    turns: list["Traced"]


class Symbols:
    """The field of rational functions in which laws are traced, with relations g^2 = polynomial of its symbols.

    constants: float -> the symbol or the fraction that it stands for, of constants that are no short decimals.
    """

    def __init__(
        self, names: tuple[str, ...], positive: tuple[str, ...] = (), constants: Mapping[float, str | Fraction] | None = None
    ) -> None:
        self.field = FracField((*ROOTS, *ANGLES, *COSINES, *SINES, *names), QQ, lex)
        self.of = {str(one): Traced(one, self) for one in self.field.gens}
        self.ring = self.field.ring
        self.positive = [self.of[name].value.numer for name in positive]
        self.constants = dict(constants or {})
        self.relations: list[PolyElement] = []
        self.known_angles: dict[tuple, Traced] = {}
        self.begin([])

    def __getitem__(self, names: tuple[str, ...]) -> tuple:
        return tuple(self.of[name] for name in names)

    def relate(self, square_of: str, polynomial: "Traced") -> None:
        """Let the square of a symbol be a polynomial."""
        self.relations.append((self.of[square_of] ** 2 - polynomial).value.numer)

    def know_angle(self, name: str, y: "Traced", x: "Traced") -> None:
        """Let a symbol be atan2(y, x) on every path."""
        self.known_angles[y, x] = self.of[name]

    def begin(self, script: list[bool]) -> None:
        """Forget the path before, and take the next one's first decisions from a list."""
        self.script, self.taken, self.decisions = script, [], []
        self.own_relations: list[PolyElement] = []
        self.meanings: dict[str, Any] = {}
        self.roots: dict[PolyElement, Traced] = {}
        self.angles: dict[tuple, Traced] = dict(self.known_angles)
        self.turns: list[Traced] = []

    def enter(self, path: Path) -> None:
        """Take up the relations of a path again."""
        self.own_relations = path.relations

    def reduce(self, value: Any) -> Any:
        """Return the normal form of a quotient modulo the relations."""
        relations = self.own_relations + self.relations
        numer, denom = (part.rem(relations) if relations else part for part in (value.numer, value.denom))
        return self.field(numer) / self.field(denom)

    def is_negative(self, value: "Traced") -> bool:
        """Decide whether a value is below zero: by itself if it is a number, else as this path has it."""
        polynomial = value.value.numer * value.value.denom
        for one in self.positive:
            while polynomial and not polynomial.rem([one]):
                polynomial = polynomial.quo(one)
        if polynomial.is_ground:
            return polynomial.LC < 0
        leading = polynomial.LC
        for known, sign in self.decisions:
            if known == polynomial or (known * leading == polynomial * known.LC and leading * known.LC > 0):
                return sign == "<"
        answer = self.script[len(self.taken)] if len(self.taken) < len(self.script) else True
        self.taken.append(answer)
        self.decisions.append(Decision(polynomial, "<" if answer else ">="))
        return answer

    def root_of(self, polynomial: PolyElement) -> "Traced":
        """Return the square root of a polynomial, squares taken out of it by their size."""
        constant, factors = polynomial.factor_list()
        outside, inside = self.number(1), self.ring(1)
        for factor, power in factors:
            outside = outside * abs(Traced(self.field(factor), self)) ** (power // 2) if power > 1 else outside
            if power % 2:
                symbol = self._symbol_of_square(factor)
                if symbol is None:
                    inside = inside * factor
                else:
                    constant, outside = constant * symbol[0], outside * abs(symbol[1])
        if constant < 0:
            constant, inside = -constant, -inside
        ratio = Fraction(int(constant.numerator), int(constant.denominator))
        roots = math.isqrt(ratio.numerator), math.isqrt(ratio.denominator)
        if roots[0] ** 2 == ratio.numerator and roots[1] ** 2 == ratio.denominator:
            outside = outside * self.number(Fraction(*roots))
        else:
            inside = inside * constant
        symbol = self._symbol_of_square(inside)
        if symbol is not None and symbol[0] == 1:
            return outside * abs(symbol[1])
        return outside if inside == 1 else outside * self._root_symbol(inside)

    def _symbol_of_square(self, factor: PolyElement) -> tuple | None:
        """Return (k, g) of a factor k g^2 whose square a relation has replaced."""
        for relation in self.relations:
            square = self.ring(relation.LM and {relation.LM: QQ(1)}) - relation
            if factor * square.LC == square * factor.LC:
                place = relation.LM.index(2)
                return factor.LC / square.LC, Traced(self.field.gens[place], self)
        return None

    def _root_symbol(self, polynomial: PolyElement) -> "Traced":
        if polynomial not in self.roots:
            name = ROOTS[len(self.roots)]
            root = self.roots[polynomial] = self.of[name]
            self.own_relations.append((root**2).value.numer - polynomial)
            self.decisions.append(Decision(root.value.numer, ">="))
            self.meanings[name] = sp.sqrt(polynomial.as_expr())
        return self.roots[polynomial]

    def angle_of(self, y: "Traced", x: "Traced") -> "Traced":
        """Return atan2(y, x) as a symbol, the same for every positive multiple of both."""
        for (y_0, x_0), symbol in self.angles.items():
            if y * x_0 == x * y_0 and not self.is_negative(x * x_0):
                return symbol
        common = y.value.numer.gcd(x.value.numer)
        scale = self.number(0)._with(self.field(common) / self.field(y.value.denom))
        if x.value.denom != y.value.denom:
            scale = self.number(1)
        elif self.is_negative(scale):
            scale = -scale
        name = ANGLES[len(self.angles)]
        of = y / scale, x / scale
        self.angles[of] = self.of[name]
        self.meanings[name] = sp.atan2(*(one.value.as_expr() for one in of))
        return self.angles[of]

    def circle_of(self, angle: "Traced") -> tuple["Traced", "Traced"]:
        """Return (cosine, sine) of an angle as symbols with cosine^2 + sine^2 = 1."""
        if all(angle != one for one in self.turns):
            self.turns.append(angle)
            cosine, sine = self.of[COSINES[len(self.turns) - 1]], self.of[SINES[len(self.turns) - 1]]
            self.own_relations.append((cosine**2 + sine**2 - 1).value.numer)
        place = next(i for i, one in enumerate(self.turns) if one == angle)
        return self.of[COSINES[place]], self.of[SINES[place]]

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
        return Traced(self.reduce(value.value.diff(self.of[name].value)), self)

    def as_function(self, value: "Traced", path: Path) -> Any:
        """Return a value as sympy has it, roots and angles written out."""
        return value.value.as_expr().subs(path.meanings)

    def paths(self, function: Callable[[], Any]) -> Iterator[Path]:
        """Call a function of no arguments once for each path through its decisions."""
        script: list[bool] | None = []
        while script is not None:
            self.begin(script)
            answer = function()
            signs = [(y.value.numer * y.value.denom, one.value.numer) for (y, _), one in self.angles.items()]
            yield Path(answer, list(self.decisions), list(self.own_relations), dict(self.meanings), signs, list(self.turns))
            taken = self.taken
            while taken and not taken[-1]:
                taken = taken[:-1]
            script = [*taken[:-1], False] if taken else None


class Traced:
    """A number of the law dialect, as a rational function; `tally` is what `bench.law.scalar` asks for."""

    tally = None

    def __init__(self, value: Any, symbols: Symbols) -> None:
        self.value, self.symbols = value, symbols

    def _with(self, value: Any) -> "Traced":
        return Traced(self.symbols.reduce(value), self.symbols)

    def _other(self, other: Any) -> Any:
        return self.symbols.number(other).value

    def __add__(self, other: Any) -> "Traced":
        return self._with(self.value + self._other(other))

    def __sub__(self, other: Any) -> "Traced":
        return self._with(self.value - self._other(other))

    def __rsub__(self, other: Any) -> "Traced":
        return self._with(self._other(other) - self.value)

    def __mul__(self, other: Any) -> "Traced":
        return self._with(self.value * self._other(other))

    def __truediv__(self, other: Any) -> "Traced":
        return self._with(self.value / self._other(other))

    def __rtruediv__(self, other: Any) -> "Traced":
        return self._with(self._other(other) / self.value)

    def __neg__(self) -> "Traced":
        return Traced(-self.value, self.symbols)

    def __pow__(self, power: int) -> "Traced":
        return self._with(self.value**power)

    __radd__, __rmul__ = __add__, __mul__

    def __abs__(self) -> "Traced":
        return -self if self.symbols.is_negative(self) else self

    def __lt__(self, other: Any) -> bool:
        return self.symbols.is_negative(self - other)

    def __gt__(self, other: Any) -> bool:
        return self.symbols.is_negative(self.symbols.number(other) - self)

    def __ge__(self, other: Any) -> bool:
        return not self < other

    def __le__(self, other: Any) -> bool:
        return not self > other

    def __eq__(self, other: object) -> bool:
        return not self._with(self.value - self._other(other)).value

    __hash__ = object.__hash__

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
