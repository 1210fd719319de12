"""What takes part: gains, goals, regulators, and a contender made of one and its coordinates.

Shapes: a vector is a tuple of 3 numbers, R a `Rotation`, E a tuple of 3 coordinates (4 of a quaternion). Base frame,
radians, seconds. What a contender needs on an arm is in `resolved_motion`.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.base.errors import Incompatible
from bench.law.equation import Equation
from bench.law.look import Look
from bench.law.representation import Representation
from bench.law.resolved_motion import Inverse, Jacobian
from bench.law.so3 import IDENTITY, Rotation

AT_REST = (0.0, 0.0, 0.0)
NO_MEMORY = (0.0, 0.0, 0.0, 0.0)
"""A law with memory carries four numbers from tick to tick: a quaternion fits."""

ON_MATRIX = "rotation-matrix"
"""The coordinates of a law that acts on R itself."""


class Gains(NamedTuple):
    """Position and velocity gain: for small errors every law is u = kp (rotation vector error) - kv omega.

    kp in 1/s^2, kv in 1/s. The defaults are the paper's (Murphy 1988, 2.3): critically damped at 10 rad/s.
    """

    kp: float = 100.0
    kv: float = 20.0


PAPERS_GAINS = Gains()

OURS = "this benchmark"
"""How the source of a law begins that was made here."""


class Goal(NamedTuple):
    """Desired rotation, and for tracking its angular velocity and acceleration (zero in regulation)."""

    R: Rotation = IDENTITY
    omega: tuple = AT_REST
    alpha: tuple = AT_REST


class Regulator(NamedTuple):
    """A law u = law(R, omega, goal, gains): commanded angular acceleration in the base frame [rad/s^2].

    coordinates: "rotation-matrix" if the law acts on R; otherwise the names of the representations it acts on, or
    "any". Such a regulator gives `law_in(representation)`, which returns the law in those coordinates.
    relative: the coordinates are those of R_d^T R, so their margin is too.
    memory: initial memory of a law with state, law(R, omega, goal, gains, memory) -> (u, memory); else None.
    property: what is proved of it: "local", "almost global", "global with memory", or "none".
    origin: the file of a user's law; empty for ours.
    costing_only: another way to write a law that is listed already: costed and tested, not run.
    later: one that the paper does not have: it runs on the smaller set of starts.
    in_engine: MuJoCo's own actuator makes the command, on the free body in MuJoCo alone; `law` is what it computes,
    which is what is tested and counted.
    stiffness: near the goal, about n_d, o_d and a_d, over kp.
    margin: of a law on R that is singular somewhere: margin(R, R_d) in [0, 1], 0 exactly there; else None.
    coordinate_law_in: of a law that commands Eddot itself: coordinate_law_in(representation) returns
    law(chart, E_d, Edot, gains) -> u_E, what the controller on an analytic Jacobian needs (Murphy 1988, 3.7).
    assemble: of a baseline (contenders/baselines), assemble(chain, goal, p_d, gains, memory, J, a) -> (u, memory)
    in place of (2.2) and (3.7). through: the Jacobian and the inverse of one that acts on the joints; else empty.

    What the book shows, all of it optional:
    short: what it is called beside a curve. look: how it is drawn. family: the title of those it is drawn with.
    papers: its place among the paper's three laws; 0 of another. control: a negative one, here because it must fail.
    equation: of its angle, if it turns a free body about one fixed axis from rest; equation_in(representation) of a
    law in coordinates.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable | None = None
    law_in: Callable | None = None
    coordinates: str | tuple = ON_MATRIX
    relative: bool = False
    memory: tuple | None = None
    property: str = "local"
    origin: str = ""
    costing_only: bool = False
    later: bool = False
    in_engine: bool = False
    stiffness: tuple[float, float, float] = (1.0, 1.0, 1.0)
    margin: Callable | None = None
    coordinate_law_in: Callable | None = None
    assemble: Callable | None = None
    through: tuple[Jacobian, Inverse] | tuple[()] = ()
    short: str = ""
    look: Look | None = None
    family: str = ""
    papers: int = 0
    control: bool = False
    equation: Equation | None = None
    equation_in: Callable[[Representation], Equation | None] | None = None

    def is_ours(self) -> bool:
        """Whether the law was made here and nobody else has reviewed it: its source then begins with OURS."""
        return self.source.startswith(OURS)


class Contender(NamedTuple):
    """A regulator in the coordinates it acts on, and on an arm its Jacobian and inverse: what one row is about."""

    regulator: Regulator
    representation: Representation | None = None
    jacobian: Jacobian | None = None
    inverse: Inverse | None = None

    @property
    def name(self) -> str:
        """`regulator[/representation][@jacobian+inverse]`: the word on the command line."""
        law = self.on_free_body
        return f"{law}@{self.jacobian.name}+{self.inverse.name}" if self.jacobian and self.inverse else law

    @property
    def on_free_body(self) -> str:
        """`regulator[/representation]`: the law alone."""
        return f"{self.regulator.name}/{self.representation.name}" if self.representation else self.regulator.name

    @property
    def way(self) -> tuple[str, str]:
        """Names of the Jacobian and the inverse; empty on the free body."""
        return (self.jacobian.name if self.jacobian else "", self.inverse.name if self.inverse else "")

    @property
    def is_beyond_the_paper(self) -> bool:
        """Whether it is a later law of ours, or one on coordinates that the paper sets aside (Murphy 1988, 2.2)."""
        return (self.is_elsewhere or self.regulator.later) and not self.regulator.origin

    @property
    def is_elsewhere(self) -> bool:
        """Whether it acts on coordinates that the paper sets aside (Murphy 1988, 2.2)."""
        return self.representation is not None and not self.representation.papers

    @property
    def short(self) -> str:
        """What it is called beside a curve: the law, or of one in several coordinates where it is."""
        if not self.regulator.short:
            return self.on_free_body
        if self.representation is None or not self._is_abroad:
            return self.regulator.short
        return f"in {self.representation.short or self.representation.name}"

    @property
    def family(self) -> str:
        """The title of those it is drawn with; another one for a law in others than the paper's coordinates."""
        if self.regulator.short and self._is_abroad:
            return f"{self.regulator.short[:1].upper()}{self.regulator.short[1:]} elsewhere"
        return self.regulator.family

    @property
    def _is_abroad(self) -> bool:
        return self.is_elsewhere and (self.regulator.coordinates == "any" or len(self.regulator.coordinates) > 1)

    @property
    def equation(self) -> Equation | None:
        """Return the equation of motion of its angle, if it turns a free body about one fixed axis from rest."""
        equation_in = self.regulator.equation_in
        return equation_in(self.representation) if equation_in and self.representation else self.regulator.equation

    @property
    def rows(self) -> int:
        """Rows of the Jacobian: three of position, and one a coordinate of orientation."""
        by_coordinates = self.jacobian is not None and self.jacobian.takes == "coordinates"
        return 3 + len(self.representation.symbols) if by_coordinates and self.representation else 6

    @property
    def law(self) -> Callable:
        """The law with its coordinates filled in."""
        return bind(self.regulator, self.representation)

    @property
    def coordinate_law(self) -> Callable:
        """The law that commands the coordinates' acceleration; see `Regulator.coordinate_law_in`."""
        law_in = self.regulator.coordinate_law_in
        if law_in is None or self.representation is None:
            raise Incompatible(f"'{self.on_free_body}' commands no acceleration of coordinates")
        return law_in(self.representation)


def bind(regulator: Regulator, representation: Representation | None) -> Callable:
    """The law of a regulator, in a representation if it acts on one."""
    law = regulator.law
    if representation is not None and regulator.law_in is not None:
        law = regulator.law_in(representation)
    if law is None:
        raise Incompatible(f"regulator '{regulator.name}' has neither law nor law_in for the coordinates it names")
    return law


def refusal(one: Contender, joints: int) -> str:
    """Why a contender cannot control an arm of so many joints; empty if it can."""
    jacobian, inverse, representation = one.jacobian, one.inverse, one.representation
    if one.regulator.in_engine:
        return (
            f"regulator '{one.regulator.name}' is an actuator of MuJoCo and turns the free body alone "
            "(try: a law in Python that commands the same)"
        )
    if jacobian is None or inverse is None:
        return "an arm needs a Jacobian and an inverse (try: @geometric+pseudo-inverse)"
    if jacobian.takes == "coordinates":
        if one.regulator.coordinate_law_in is None or representation is None:
            return (
                f"the Jacobian '{jacobian.name}' takes an acceleration of coordinates, and regulator "
                f"'{one.regulator.name}' commands an angular acceleration (try: the Jacobian geometric)"
            )
        if jacobian.needs_derivatives and representation.differentiate is None:
            return (
                f"the Jacobian '{jacobian.name}' differentiates the coordinates' extraction, which "
                f"'{representation.name}' does not give (try: the Jacobian analytic, which is equal)"
            )
    return inverse.refuses(one.rows, joints)


def contender(regulator: Regulator, representation: Representation | None = None) -> Contender:
    """Put the two together, or refuse with the reason.

    Errors:
        Incompatible: the regulator acts on R and a representation was given, or the other way about.
    """
    if regulator.coordinates == ON_MATRIX:
        if representation is not None:
            raise Incompatible(
                f"regulator '{regulator.name}' acts on the rotation matrix and takes no representation "
                f"(given '{representation.name}'); omit the representation"
            )
        return Contender(regulator)
    allowed = "any representation" if regulator.coordinates == "any" else ", ".join(regulator.coordinates)
    if representation is None:
        raise Incompatible(f"regulator '{regulator.name}' acts on coordinates and needs one of: {allowed}")
    if regulator.coordinates != "any" and representation.name not in regulator.coordinates:
        raise Incompatible(
            f"regulator '{regulator.name}' acts on {allowed}, not on '{representation.name}': "
            "its gains are permuted for those coordinates"
        )
    return Contender(regulator, representation)
