"""What takes part: gains, goals, representations, regulators, and a contender made of them.

Shapes: a vector is a tuple of 3 numbers, R a `Rotation`, E a tuple of 3 coordinates. Base frame, radians, seconds.
"""

from collections.abc import Callable
from typing import NamedTuple

from bench.errors import Incompatible
from bench.so3 import IDENTITY, Rotation

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
    """Three coordinates E of a rotation, with omega = B(E) Edot (Murphy 1988, 2.8).

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


class Contender(NamedTuple):
    """A regulator in the coordinates it acts on: what one row of the results is about."""

    regulator: Regulator
    representation: Representation | None = None

    @property
    def name(self) -> str:
        """`regulator` or `regulator/representation`: the word on the command line."""
        if self.representation is None:
            return self.regulator.name
        return f"{self.regulator.name}/{self.representation.name}"

    @property
    def law(self) -> Callable:
        """The law with its coordinates filled in."""
        return bind(self.regulator, self.representation)


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
