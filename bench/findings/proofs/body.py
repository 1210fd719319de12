"""A free body under a law, in symbols: the quaternion q of the turn from R to R_d, omega, gains, and any goal R_d.

    q = (eta, eps) = (w, (x, y, z)),   E(q) = R_d R^T
    eta' = (1/2) eps . omega,   eps' = -(1/2)(eta omega + eps x omega),   omega' = u

A law is called with R = E^T R_d. Where its answer, in normal form, does not mention the goal, a proof holds for every
goal.
"""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from bench.findings.proofs.solver import Solver
from bench.findings.proofs.theorem import DoesNotFit
from bench.findings.proofs.trace import Path, Symbols, Traced
from bench.law.inputs import Gains, Goal
from bench.law.kinds import ON_MATRIX, Law
from bench.law.so3 import Rotation, cross, dot, from_quaternion, rotate, rotate_back

QUATERNION, RATES, GOAL = ("w", "x", "y", "z"), ("omega_x", "omega_y", "omega_z"), ("a", "b", "c", "d")


class Tick(NamedTuple):
    """A law's answer on one path: u for omega = 0, u, and kept, where its new memory, if it has one, is kept q.

    side: 1 where the law acts on q after the tick, -1 where it acts on -q. known: Z3's conditions of path and side.
    taken: what a theorem makes of the tick.
    """

    at_rest: tuple
    u: tuple
    kept: Traced | None
    path: Path
    side: int = 1
    known: Sequence[Any] = ()
    taken: Any = None


class FreeBody:
    """The symbols of a body and its goal.

    more: symbols of a law's own state. goal_frame: q, rates and answers are in the goal's axes, where R = R_d X.
    """

    def __init__(
        self,
        positive: tuple[str, ...] = (),
        more: tuple[str, ...] = (),
        constants: Mapping[float, Any] | None = None,
        goal_frame: bool = False,
    ) -> None:
        names = ("x", "w", "y", "z", *RATES, "kp", "kv", *GOAL, "size", *more)
        self.symbols = Symbols(names, ("kp", "kv", "size", *positive), constants)
        symbol = self.symbols.of
        self.symbols.relate("x", 1 - symbol["w"] ** 2 - symbol["y"] ** 2 - symbol["z"] ** 2)
        self.symbols.relate("a", 1 - symbol["b"] ** 2 - symbol["c"] ** 2 - symbol["d"] ** 2)
        self.q, self.omega = self.symbols[QUATERNION], self.symbols[RATES]
        self.eta, self.eps, self.gains = self.q[0], self.q[1:], Gains(*self.symbols["kp", "kv"])
        self.R_d, E = from_quaternion(self.symbols[GOAL]), from_quaternion(self.q)
        self.goal_frame, self.goal = goal_frame, Goal(self.R_d)
        if goal_frame:
            back = Rotation(*(tuple(row) for row in zip(*E, strict=True)))
            self.R = Rotation(*(rotate(self.R_d, column) for column in back))
        else:
            self.R = Rotation(*(rotate_back(E, column) for column in self.R_d))
        self.solver = Solver(self.symbols)

    def command(self, law: Law, rates: tuple, *memory: Any) -> Any:
        """Call a law at this body's orientation, with rates that are given in the frame of q; so is its command."""
        evaluate: Any = law.law
        answer = evaluate(self.R, rotate(self.R_d, rates) if self.goal_frame else rates, self.goal, self.gains, *memory)
        if not self.goal_frame:
            return answer
        return (rotate_back(self.R_d, answer[0]), answer[1]) if memory else rotate_back(self.R_d, answer)

    def ticks(self, law: Law) -> Iterator[Tick]:
        """Yield what a law on R answers on every path and side on which Z3 finds a state away from the goal.

        A memory is a quaternion on q's side. DoesNotFit: the law acts on coordinates, has a state, or another memory.
        """
        if law.law is None or law.state is not None or law.coordinates != ON_MATRIX:
            raise DoesNotFit("it is no law on the rotation matrix without a state")
        given = () if law.memory is None else (tuple(self.symbols.of["size"] * one for one in self.q),)
        rest = tuple(self.symbols.number(0) for _ in range(3))

        def call() -> tuple:
            return self.command(law, rest, *given), self.command(law, self.omega, *given)

        is_turned = self.solver.of["w"] * self.solver.of["w"] < 1
        for path in self.symbols.paths(call):
            still, moving = path.answer
            known = [*self.solver.condition(path), is_turned]
            if law.memory is None:
                ends = [Tick(still, moving, None, path, 1, known)]
            else:
                kept = moving[1][0] / self.eta
                if any(one != kept * other for one, other in zip(moving[1], self.q, strict=True)):
                    raise DoesNotFit("its memory is not the quaternion of the turn")
                sides = ((side, [*known, self.solver.is_below(-side * kept)]) for side in (1, -1))
                ends = [Tick(still[0], moving[0], kept, path, *end) for end in sides]
            yield from (one for one in ends if self.solver.find(*one.known)[0] != "unsat")

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
        """Tell whether a value depends on any of these symbols."""
        return any(self.symbols.derivative(value, name) != 0 for name in names)
