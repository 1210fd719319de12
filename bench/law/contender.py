"""What takes part: gains, goals, representations, regulators, and a contender made of them.

Shapes: a vector is a tuple of 3 numbers, R a `Rotation`, E a tuple of 3 coordinates (4 of a quaternion). Base frame,
radians, seconds. What a contender needs on an arm is in `resolved_motion`.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.errors import Incompatible
from bench.law.resolved_motion import Inverse, Jacobian
from bench.law.so3 import IDENTITY, Rotation

AT_REST = (0.0, 0.0, 0.0)
NO_MEMORY = (0.0, 0.0, 0.0, 0.0)
"""A law with memory carries four numbers from tick to tick: a quaternion fits."""


class Gains(NamedTuple):
    """Position and velocity gain: for small errors every law is u = kp (rotation vector error) - kv omega.

    kp in 1/s^2, kv in 1/s. The defaults are the paper's (Murphy 1988, 2.3): critically damped at 10 rad/s.
    """

    kp: float = 100.0
    kv: float = 20.0


PAPERS_GAINS = Gains()


class Goal(NamedTuple):
    """Desired rotation, and for tracking its angular velocity and acceleration (zero in regulation)."""

    R: Rotation = IDENTITY
    omega: tuple = AT_REST
    alpha: tuple = AT_REST


class Representation(NamedTuple):
    """Coordinates E of a rotation, with omega = B(E) Edot (Murphy 1988, 2.8): three, or four of a quaternion.

    A `chart` is E together with what its extraction has computed already (sines and cosines, say), so that nothing is
    computed twice in a tick; `chart.E` is E.

    chart(R) -> chart
    chart_of(E) -> chart
    to_matrix(E) -> R
    rates(chart, omega) -> Edot = B^-1 omega                     (2.9)
    accelerate(chart, Edot, Eddot) -> B Eddot + Bdot Edot        (2.10 solved for u = omegadot)
    angular_velocity(chart, Edot) -> B Edot                      (2.8)
    generalized(chart, m) -> B^T m                               (3.12, rotational part)
    margin(R) -> number in [0, 1], 0 exactly on the singular set

    Of an extraction that can be differentiated element by element, as (3.5) does (else None):
    differentiate(R, Rdot) -> Edot                               dE/dR along Rdot, Rdot by columns
    differentiate_twice(R, Rdot, Rddot) -> Eddot

    about: which coordinate a user takes for the turn about x, about y and about z; None if there is no such choice.
    """

    name: str
    title: str
    source: str
    formula: str
    symbols: tuple
    chart: Callable
    chart_of: Callable
    to_matrix: Callable
    rates: Callable
    accelerate: Callable
    angular_velocity: Callable
    generalized: Callable
    margin: Callable
    differentiate: Callable | None = None
    differentiate_twice: Callable | None = None
    about: tuple[int, int, int] | None = (0, 1, 2)

    @property
    def goal_chart(self) -> Callable:
        """The chart again, for the goal: a name of its own, so that its cost is a stage of its own."""
        return self.chart


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
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable | None = None
    law_in: Callable | None = None
    coordinates: str | tuple = "rotation-matrix"
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
        other = self.representation is not None and self.representation.name != "zyx-euler"
        return (other or self.regulator.later) and not self.regulator.origin

    @property
    def is_on_arm(self) -> bool:
        """Whether it controls an arm (and not the free body)."""
        return self.jacobian is not None

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


def acts_on(regulator: Regulator, representation_name: str) -> bool:
    """Whether the regulator has a law in that representation."""
    allowed = regulator.coordinates
    return allowed == "any" or (allowed != "rotation-matrix" and representation_name in allowed)


def on_arm(one: Contender, jacobian: Jacobian, inverse: Inverse, joints: int = 6) -> Contender:
    """A contender on an arm of so many joints, or refuse with the reason.

    Errors:
        Incompatible: the law, the Jacobian, the inverse and the number of joints do not go together.
    """
    wanted = one._replace(jacobian=jacobian, inverse=inverse)
    reason = refusal(wanted, joints)
    if reason:
        raise Incompatible(f"'{wanted.name}' on {joints} joints: {reason}")
    return wanted


def refusal(one: Contender, joints: int) -> str:
    """Why a contender cannot control an arm of so many joints; empty if it can."""
    jacobian, inverse, representation = one.jacobian, one.inverse, one.representation
    if one.regulator.in_engine:
        return (
            f"regulator '{one.regulator.name}' is an actuator of MuJoCo and turns the free body alone "
            "(try: rotation-vector, the same law)"
        )
    if jacobian is None or inverse is None:
        return "an arm needs a Jacobian and an inverse (try: @geometric+pseudo-inverse)"
    if jacobian.takes == "coordinates":
        if one.regulator.coordinate_law_in is None or representation is None:
            return (
                f"the Jacobian '{jacobian.name}' takes an acceleration of coordinates, and regulator "
                f"'{one.regulator.name}' commands an angular acceleration (try: the Jacobian geometric, or the "
                "regulator feedback-linearized)"
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
    if regulator.coordinates == "rotation-matrix":
        if representation is not None:
            raise Incompatible(
                f"regulator '{regulator.name}' acts on the rotation matrix and takes no representation "
                f"(given '{representation.name}'); leave the representation away"
            )
        return Contender(regulator)
    allowed = "any representation" if regulator.coordinates == "any" else ", ".join(regulator.coordinates)
    if representation is None:
        raise Incompatible(f"regulator '{regulator.name}' acts on coordinates and needs one of: {allowed}")
    if not acts_on(regulator, representation.name):
        raise Incompatible(
            f"regulator '{regulator.name}' acts on {allowed}, not on '{representation.name}': "
            "its gains are permuted for those coordinates"
        )
    return Contender(regulator, representation)
