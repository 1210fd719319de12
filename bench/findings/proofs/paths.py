"""One way through the branches of a law: its decisions, relations, and the symbols that it introduced."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, NamedTuple, Protocol

from sympy.polys.rings import PolyElement

from bench.findings.proofs.conditions import PolynomialRelation

if TYPE_CHECKING:
    from bench.findings.proofs.traced_number import Traced


class PathEnds(Exception):
    """No state is on this path, or its next operation is defined at none."""


class Oracle(Protocol):
    """Who answers whether conditions have a solution: `bench.findings.proofs.solver.Solver`."""

    def find(
        self, path: Path, *conditions: PolynomialRelation, limit_s: float | None = None
    ) -> Any:
        """Return a finding with `answer` ("unsat", "sat", "unknown"), `state` and `seconds`."""


class Doubt(NamedTuple):
    """An operation that is not shown to be defined.

    words: what may be undefined, and in which line. state: where it is undefined; None if Z3 did not decide.
    """

    words: str
    state: dict[str, float] | None
    seconds: float


class Angle(NamedTuple):
    """An arc tangent atan2(y, x) that became a symbol."""

    y: Traced
    x: Traced
    symbol: Traced


class Definition(NamedTuple):
    """How a symbol that a path introduced is computed: "root", "angle", "cosine" or "sine" of some values."""

    name: str
    kind: str
    of: tuple[Traced, ...]


@dataclass
class Path:
    """One way through a function's branches: what it answered, and under which conditions.

    Attributes:
        script: The decisions it had to begin with.
        answer: What the function returned; None if no state is on the path.
        taken: All decisions that were made.
        decisions: What they say, and that roots are not negative.
        relations: Polynomials that are zero.
        meanings: What the symbols of roots and angles stand for.
        definitions: The same, to compute them with numbers.
        angles: Arc tangents.
        turns: Angles of cosines.
    """

    script: list[bool]
    answer: Any = None
    is_over: bool = False
    taken: list[bool] = field(default_factory=list)
    decisions: list[PolynomialRelation] = field(default_factory=list)
    relations: list[PolyElement] = field(default_factory=list)
    meanings: dict[str, Any] = field(default_factory=dict)
    definitions: list[Definition] = field(default_factory=list)
    angles: list[Angle] = field(default_factory=list)
    turns: list[Traced] = field(default_factory=list)

    def key(self) -> tuple:
        """Return what its conditions depend on."""
        angles = tuple((angle.y.value, angle.x.value) for angle in self.angles)
        return tuple(self.decisions), tuple(self.relations), angles
