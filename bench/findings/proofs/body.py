"""A free body under a law, in symbols: the quaternion q of the turn from R to R_d, omega, gains, and any goal R_d.

    q = (eta, eps) = (w, (x, y, z)),   E(q) = R_d R^T
    eta' = (1/2) eps . omega,   eps' = -(1/2)(eta omega + eps x omega),   omega' = u

A law is called with R = E^T R_d. Where its answer, in normal form, does not mention the goal, a proof holds for every
goal.
"""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

from bench.findings.proofs import dialect
from bench.findings.proofs.conditions import PolynomialRelation
from bench.findings.proofs.paths import Path
from bench.findings.proofs.reasons import DoesNotFit, LemmaFails
from bench.findings.proofs.solver import Lemma, Solver, is_below, undecided
from bench.findings.proofs.trace import Symbols
from bench.findings.proofs.traced_number import Traced
from bench.law.inputs import Gains, Goal
from bench.law.kinds import Law
from bench.law.so3 import Rotation, cross, dot, from_quaternion, rotate, rotate_back

QUATERNION, RATES, GOAL = ("w", "x", "y", "z"), ("omega_x", "omega_y", "omega_z"), ("a", "b", "c", "d")

IS_FINITE = "the command is finite"
STAYS_PARALLEL = "the memory stays a multiple of q, and is never zero"
KEEPS_LENGTH = "the memory's length does not depend on its last length, or is the same"
"""A length that grows or shrinks from tick to tick is lost in floats: a tenth each, and after 324 ticks it is zero."""
RESTS = "the goal is a point of rest"


class Tick(NamedTuple):
    """A law's answer on one path and side.

    Attributes:
        at_rest: The command for omega = 0.
        u: The command.
        kept: Where the new memory is kept q; None of a law without memory.
        path: The path.
        side: 1 where the law acts on q after the tick, -1 where it acts on -q.
        known: The conditions of the side, and that the body is not at the goal.
        taken: What a theorem makes of the tick.
    """

    at_rest: tuple
    u: tuple
    kept: Traced | None
    path: Path
    side: int = 1
    known: tuple[PolynomialRelation, ...] = ()
    taken: Any = None


class FreeBody:
    """The symbols of a body and its goal.

    positive: symbols that are above zero, besides the gains. more: symbols of a law's own state. goal_frame: q, rates
    and answers are in the goal's axes, where R = R_d X. at_180: eta is the number 0.
    """

    def __init__(
        self,
        positive: tuple[str, ...] = (),
        more: tuple[str, ...] = (),
        constants: Mapping[float, Any] | None = None,
        goal_frame: bool = False,
        at_180: bool = False,
    ) -> None:
        names = ("x", "w", "y", "z", *RATES, "kp", "kv", *GOAL, "size", *more)
        self.symbols = Symbols(names, ("kp", "kv", "size", *positive), constants)
        symbol = self.symbols.of
        self.eta = self.symbols.number(0) if at_180 else symbol["w"]
        self.symbols.relate("x", 1 - self.eta**2 - symbol["y"] ** 2 - symbol["z"] ** 2)
        self.symbols.relate("a", 1 - symbol["b"] ** 2 - symbol["c"] ** 2 - symbol["d"] ** 2)
        self.eps, self.omega = self.symbols[QUATERNION[1:]], self.symbols[RATES]
        self.q = (self.eta, *self.eps)
        self.gains = Gains(*self.symbols["kp", "kv"])
        self.R_d, E = from_quaternion(self.symbols[GOAL]), from_quaternion(self.q)
        self.goal_frame, self.goal = goal_frame, Goal(self.R_d)
        if goal_frame:
            back = Rotation(*(tuple(row) for row in zip(*E, strict=True)))
            self.R = Rotation(*(rotate(self.R_d, column) for column in back))
        else:
            self.R = Rotation(*(rotate_back(E, column) for column in self.R_d))
        self.solver = Solver(self.symbols)
        self.symbols.oracle = self.solver

    def command(self, law: Law, rates: tuple, *memory: Any) -> Any:
        """Call a law at this body's orientation, with rates that are given in the frame of q; so is its command."""
        evaluate: Any = law.law
        answer = evaluate(self.R, rotate(self.R_d, rates) if self.goal_frame else rates, self.goal, self.gains, *memory)
        if not self.goal_frame:
            return answer
        return (rotate_back(self.R_d, answer[0]), answer[1]) if memory else rotate_back(self.R_d, answer)

    def commands(self, law: Law, *memory: Any) -> Iterator[Path]:
        """Yield the paths of a law: the answers are those for omega = 0, and for omega.

        Errors:
            DoesNotFit: the law acts on coordinates, has a state, or commands no acceleration of a free body.
            Untraceable: its source is not of the dialect, or cannot be called with symbols.
        """
        check_kind(law)
        dialect.check(law)
        rest = tuple(self.symbols.number(0) for _ in range(3))

        def call() -> tuple:
            at_rest = self._checked(self.command(law, rest, *memory))
            return at_rest, self._checked(self.command(law, self.omega, *memory))

        yield from self.symbols.paths(call)

    def _checked(self, answer: Any) -> Any:
        """Return a law's answer with numbers as values; what is no number is refused."""
        if isinstance(answer, tuple) and len(answer) == 2:
            return self._numbers(answer[0], 3), self._numbers(answer[1], 4)
        return self._numbers(answer, 3)

    def _numbers(self, values: Any, count: int) -> tuple:
        if not isinstance(values, tuple) or len(values) != count:
            raise DoesNotFit(f"its source does not return {count} numbers")
        return tuple(self.symbols.number(value) for value in values)

    def ticks(self, law: Law) -> Iterator[Tick]:
        """Yield what a law on R answers on every path and side on which there may be a state away from the goal.

        A memory is a multiple of q, which `memory` proves.

        Errors:
            LemmaFails: a memory does not stay a multiple of q.
        """
        memory = () if law.memory is None else (tuple(self.symbols.of["size"] * part for part in self.q),)
        is_turned = PolynomialRelation((self.eta**2 - 1).value.numer, "<")
        for path in self.commands(law, *memory):
            still, moving = path.answer
            if law.memory is None:
                sides: list[tuple[int, Traced | None, tuple[PolynomialRelation, ...]]] = [
                    (1, None, (is_turned,))
                ]
                u_at_rest, u = still, moving
            else:
                multiple = self.find_multiple(path, moving[1], STAYS_PARALLEL)
                self._require_same_length(path, multiple)
                sides = [(side, multiple, (is_turned, is_below(-side * multiple))) for side in (1, -1)]
                u_at_rest, u = still[0], moving[0]
            self._require_rest(path, u_at_rest)
            for side, kept, known in sides:
                if self.solver.find(path, *known).answer != "unsat":
                    yield Tick(u_at_rest, u, kept, path, side, known)

    def find_multiple(self, path: Path, memory: tuple, statement: str) -> Traced:
        """Return k of a memory k q, which is zero at no state on a path.

        Errors:
            LemmaFails: the memory is no multiple of q, or may be zero.
        """
        kept = dot(memory[1:], self.eps) + memory[0] * self.eta
        for part, other in zip(memory, self.q, strict=True):
            self._never(
                path, PolynomialRelation((part - kept * other).value.numer, "!="), statement
            )
        self._never(path, PolynomialRelation(kept.value.numer, "="), statement)
        return kept

    def _require_same_length(self, path: Path, multiple: Traced) -> None:
        """Raise LemmaFails if a memory grows or shrinks from tick to tick."""
        if self.mentions(multiple, "size"):
            size = self.symbols.of["size"]
            self._never(
                path, PolynomialRelation((multiple**2 - size**2).value.numer, "!="), KEEPS_LENGTH
            )

    def _require_rest(self, path: Path, u_at_rest: tuple) -> None:
        """Raise LemmaFails if a body that is at rest at the goal is driven."""
        at_goal = PolynomialRelation((self.eta**2 - 1).value.numer, "=")
        for part in u_at_rest:
            self._never(path, PolynomialRelation(part.value.numer, "!="), RESTS, at_goal)

    def _never(
        self, path: Path, fault: PolynomialRelation, statement: str, *where: PolynomialRelation
    ) -> None:
        """Raise LemmaFails unless no state on a path, where other conditions hold, has a fault."""
        if fault.answer() is False:
            return
        finding = self.solver.find(path, *where, fault)
        if finding.answer != "unsat":
            note = undecided(finding.answer, finding.seconds)
            raise LemmaFails([Lemma(statement, False, "Z3", finding.seconds, finding.state, note, True)])

    def finite(self, statement: str = IS_FINITE) -> Lemma:
        """Return the lemma that every root, division and arc tangent of all commands so far is defined."""
        doubts, seconds = self.symbols.doubts, self.symbols.question_s
        if not doubts:
            return Lemma(statement, True, "Z3", seconds)
        doubt = next((doubt for doubt in doubts if doubt.state), doubts[0])
        note = doubt.words if doubt.state else f"{doubt.words}: {undecided('unknown', doubt.seconds)}"
        return Lemma(statement, False, "Z3", seconds, doubt.state, note, True)

    def derive(self, value: Traced, u: tuple, more: Mapping[str, Traced] | None = None) -> Traced:
        """Return the derivative of a function of q and omega (and of `more`, by their derivatives) along the motion."""
        half = self.symbols.number(0.5)
        turned = cross(self.eps, self.omega)
        rates = {
            "w": half * dot(self.eps, self.omega),
            **{name: -half * (self.eta * self.omega[i] + turned[i]) for i, name in enumerate(QUATERNION[1:])},
            **dict(zip(RATES, u, strict=True)),
            **(more or {}),
        }
        terms = (self.symbols.derivative(value, name) * rate for name, rate in rates.items())
        return sum(terms, self.symbols.number(0))

    def mentions(self, value: Traced, *names: str) -> bool:
        """Tell whether a value depends on any of these symbols, through a root or an angle too."""
        meanings = self.symbols.path.meanings
        waiting = {str(symbol) for symbol in value.value.as_expr().free_symbols}
        mentioned: set[str] = set()
        while waiting:
            name = waiting.pop()
            mentioned.add(name)
            if name in meanings:
                waiting |= {str(symbol) for symbol in meanings[name].free_symbols} - mentioned
        return bool(mentioned & set(names))


def check_kind(law: Law) -> None:
    """Refuse a law of which no theorem on a free body speaks."""
    if not callable(law.law):
        raise DoesNotFit("it is no law on the rotation matrix without a state")
