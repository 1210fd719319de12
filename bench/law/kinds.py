"""The records of contenders: a file of bench/law/contenders holds one of them.

    Law            regulators/        Coordinates    representations/
    Jacobian       jacobians/         Inverse        inverses/
    Impedance      impedances/        Spring         springs/
    Stateful, Baseline: a law with a state (compensators/), or one that controls an arm (baselines/)

Shapes: a vector is a tuple of 3 numbers, R a `Rotation`, E a tuple of 3 coordinates (4 of a quaternion). A buffer is an
array A[i, j] or b[i] of numbers: float64, or counting scalars. Base frame, radians, seconds, SI units.

Each has an `attribution`: published, adapted or ours (`bench.law.attribution`).
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, NamedTuple

from bench.law.attribution import OURS, YOURS
from bench.law.display import Display

ON_MATRIX = "rotation-matrix"
"""The coordinates of a law that acts on R itself."""

CONTESTANT, CONTROL, COSTING, ACTUATOR = "contestant", "control", "costing", "actuator"
"""Roles of a law in this benchmark. A contestant is simulated, counted, and compared.

control: A negative control: a law that is wrong on purpose and must fail. It is simulated, and never recommended.
costing: The law only writes another law of the list in a different form. We count its operations and test it, but do
    not simulate it.
actuator: An actuator of MuJoCo computes the command for MuJoCo's free body. The function of the law computes the same.
"""

USERS_ROLES = (CONTESTANT, CONTROL, COSTING)
"""Roles that the law of a user's file may have: MuJoCo's own actuator would run in place of the law."""


class OnCoordinates(NamedTuple):
    """What a `Law` on coordinates of the rotation has in place of a function of R.

    Attributes:
        law_in: law_in(coordinates) returns the law in those coordinates; None if the law is known by
            its rows alone.
        names: The names of the coordinates that the law acts on, or "any".
        relative: True if the coordinates, and the margin to their singularity, are computed from
            R_d^T R; False if they are computed from R.
        coordinate_law_in: For a law that commands Eddot, the second derivatives of the coordinates:
            coordinate_law_in(coordinates) returns law(chart, E_d, Edot, gains) -> u_E. The
            controller with an analytic Jacobian (Murphy 1988, 3.7) uses this law.
    """

    law_in: Callable | None
    names: str | tuple[str, ...]
    relative: bool = False
    coordinate_law_in: Callable | None = None


class UserFile(NamedTuple):
    """The file of a law that a user wrote: its path, and its content if that may be run."""

    path: str = ""
    text: str = ""


FORMER_FIELDS = {"later": "is_beyond_the_paper"}
"""Fields of a `Law` by the names that they had before: a user's file may still write them."""


class LawFields(NamedTuple):
    """The fields of a `Law`."""

    name: str
    title: str
    source: str
    formula: str
    law: Callable | OnCoordinates | None = None
    memory: tuple | None = None
    property: str = "local"
    is_beyond_the_paper: bool = False
    role: str = CONTESTANT
    stiffness: tuple[float, float, float] = (1.0, 1.0, 1.0)
    margin: Callable | None = None
    display: Display = Display()
    attribution: str = YOURS
    file: UserFile = UserFile()


class Law(LawFields):
    """A law u = law(R, omega, goal, gains), which commands an angular acceleration in the base frame [rad/s^2].

    The law is called with a `Tuning` as gains: gains.kp, gains.kv, and the limits gains.bound and gains.delay.

    Args:
        law: the function of a law on R; `OnCoordinates` of a law on coordinates.
        memory: initial memory of a law with memory; otherwise None. A law with memory is
            law(R, omega, goal, gains, memory) -> (u, memory). The law returns the new memory, and
            the caller passes this memory unchanged to the next control step. A law with memory
            does not need the control period.
        property: what is proved about convergence: "local", "almost global", "global with memory" or
            "none", with the condition where there is one, such as the gains or a start from rest.
        file: the `UserFile` of a law that a user wrote; empty for our laws.
        is_beyond_the_paper: True for a law that is not in the paper. We simulate such a law from
            fewer start sets. The former name `later` is accepted for one more release.
        role: "contestant"; "control", "costing" or "actuator" for the few laws that are here for
            another reason than to be compared.
        stiffness: stiffness near the goal about the axes n_d, o_d and a_d of the goal, divided by kp.
        margin: for a law on R with singular orientations: margin(R, R_d) in [0, 1], which is 0
            exactly at the singular orientations.
        display: what the book shows of the law (see `bench.law.display`).
        attribution: "published", "adapted" or "ours" (see `bench.law.attribution`); "yours" for the
            law of a user.
        law_in, coordinates: another way to write law=OnCoordinates(law_in, coordinates).
    """

    __slots__ = ()

    def __new__(
        cls,
        name: str,
        title: str,
        source: str,
        formula: str,
        law: Callable | OnCoordinates | None = None,
        law_in: Callable | None = None,
        coordinates: str | tuple[str, ...] = ON_MATRIX,
        **fields: Any,
    ) -> "Law":
        """Make a law. law_in and coordinates become one record; former names of fields are accepted."""
        fields = {FORMER_FIELDS.get(field, field): value for field, value in fields.items()}
        if law_in is not None or coordinates != ON_MATRIX:
            law = OnCoordinates(law_in, coordinates)
        return super().__new__(cls, name, title, source, formula, law, **fields)

    def __reduce__(self) -> tuple:
        """Let copies be made of the fields, not of what `__new__` takes."""
        return self._make, (tuple(self),)

    def is_ours(self) -> bool:
        """Whether the law was made here and nobody else has reviewed it: such a law is never advised."""
        return self.attribution == OURS

    @property
    def coordinates(self) -> str | tuple[str, ...]:
        """The names of the coordinates that it acts on, or "any"; "rotation-matrix" of a law on R."""
        return self.law.names if isinstance(self.law, OnCoordinates) else ON_MATRIX

    @property
    def origin(self) -> str:
        """The path of the user's file; empty for our laws."""
        return self.file.path

    @property
    def text(self) -> str:
        """The content of the user's file; empty for our laws."""
        return self.file.text

    @property
    def in_engine(self) -> bool:
        """Whether an actuator of MuJoCo computes the command."""
        return self.role == ACTUATOR

    @property
    def costing_only(self) -> bool:
        """Whether its operations are counted, and it is not simulated."""
        return self.role == COSTING


@dataclass(frozen=True)
class HasLaw:
    """A record that has a law, and is called as its law is."""

    law: Law

    @property
    def name(self) -> str:
        """Name of the law."""
        return self.law.name

    @property
    def title(self) -> str:
        """Title of the law."""
        return self.law.title

    @property
    def source(self) -> str:
        """Source of the law."""
        return self.law.source

    @property
    def attribution(self) -> str:
        """Attribution of the law (`bench.law.attribution`)."""
        return self.law.attribution

    @property
    def property(self) -> str:
        """What is said of the law's convergence."""
        return self.law.property


@dataclass(frozen=True)
class Stateful(HasLaw):
    """A law whose state obeys a differential equation: a filter in place of the measured rate, or an integral.

    Its law is law(R, omega, goal, gains, state) -> (u, rates). The caller integrates the rates of the state over the
    control period.

    Attributes:
        law: The law.
        begin: begin(R) returns the state at the start, four numbers.
        polynomial: polynomial(kp, kv) returns, of small angles, the coefficients (c2, c1, c0) of
            s^3 + c2 s^2 + c1 s + c0; None for a law whose state does nothing.
        measures_rate: Whether the law reads omega.
        rejects: Whether a constant disturbance leaves no error.
        bound: bound(kp, kv) returns what |u| never exceeds [rad/s^2]; None if there is no bound.
    """

    begin: Callable
    polynomial: Callable | None
    measures_rate: bool
    rejects: bool
    bound: Callable | None = None


class Coordinates(NamedTuple):
    """Coordinates E of a rotation, with omega = B(E) Edot (Murphy 1988, 2.8): three numbers, or four for a quaternion.

    A `chart` is E together with other values of its computation (for example sines and cosines), so that nothing is
    computed twice in a control step; `chart.E` is E.

    chart(R) -> chart
    chart_of(E) -> chart
    to_matrix(E) -> R
    rates(chart, omega) -> Edot = B^-1 omega                     (2.9)
    accelerate(chart, Edot, Eddot) -> B Eddot + Bdot Edot        (2.10 solved for u = omegadot)
    angular_velocity(chart, Edot) -> B Edot                      (2.8)
    generalized(chart, m) -> B^T m                               (3.12, rotational part)
    margin(R) -> number in [0, 1], 0 exactly at the singular orientations

    Some coordinates can be differentiated element by element, as in (3.5). For other coordinates, the
    following two functions are None:
    differentiate(R, Rdot) -> Edot                               dE/dR along Rdot, Rdot by columns
    differentiate_twice(R, Rdot, Rddot) -> Eddot

    about: the indices of the coordinates that are angles about x, y and z; None if there are no such coordinates.
    is_in_paper: whether the paper uses these coordinates (Murphy 1988, 2.2).
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
    is_in_paper: bool = False
    display: Display = Display()
    attribution: str = YOURS

    @property
    def goal_chart(self) -> Callable:
        """Return `chart` by a second name, so that its operations are counted as their own stage."""
        return self.chart


def functions_of(module: dict[str, Any]) -> dict[str, Any]:
    """Return the functions of coordinates, chart to margin, that the globals of a file have by their names."""
    first, last = (Coordinates._fields.index(name) for name in ("chart", "margin"))
    return {name: module[name] for name in Coordinates._fields[first : last + 1] if name in module}


class Jacobian(NamedTuple):
    """Which motion of the tool the joint rates are mapped to: xdot = J qdot, of 6 or 7 rows, the linear ones first.

    takes: "angular-acceleration" if the controller commands omegadot (Murphy 1988, 2.2), "coordinates" if it commands
    Eddot (3.7).

    An "angular-acceleration" Jacobian gives kernels_in(None) -> (fill, express):
        fill(J, chain)          writes rows 0 to 5
        express(chain, a)       the six numbers of a base-frame acceleration, in the frame of J
    A "coordinates" Jacobian gives kernels_in(coordinates) -> (fill, drift):
        fill(J, chain, at)                   writes its rows; `at` is the coordinates' chart of chain.R
        drift(chain, at, Edot, omega, bias)  Jdot qdot as a tuple of its rows; `bias` is that of the geometric one
    needs_derivatives: whether the coordinates must give `differentiate` and `differentiate_twice`.
    """

    name: str
    title: str
    source: str
    formula: str
    takes: str
    kernels_in: Callable
    needs_derivatives: bool = False
    attribution: str = YOURS


class Inverse(NamedTuple):
    """How a commanded acceleration a of the tool becomes one of the joints, or joint torques.

    resolve(J, a, D, x, rows, n, scratch): from J (rows x n), a (rows) and the inertia matrix D (n x n) writes x (n).
    J, a and D are left as they are.
    gives: "acceleration" if J x = a, up to the inverse's own error; "torque" if x is the torque for it; "joint-torque"
    of a baseline on the joints, if it is what gravity leaves to be added.
    refuses(rows, n) -> why it cannot be used with a Jacobian of that shape; empty if it can, as any can by default.
    uses_inertia: whether resolve reads D; robots that are commanded velocities take no such inverse.
    """

    name: str
    title: str
    source: str
    formula: str
    resolve: Callable
    gives: str = "acceleration"
    refuses: Callable[[int, int], str] = lambda rows, n: ""
    uses_inertia: bool = False
    attribution: str = YOURS


@dataclass(frozen=True)
class Baseline(HasLaw):
    """A controller of an arm that laws are compared with; its law is None where it commands no orientation.

    Attributes:
        law: The words of the controller, and the law that it commands the tool by.
        assemble: assemble(chain, goal, p_d, gains, memory, J, a) -> (u, memory) replaces equations
            (2.2) and (3.7).
        resolution: For a baseline that commands joints: the Jacobian, and the method that inverts
            it. Empty for every other baseline.
    """

    assemble: Callable
    resolution: tuple[Jacobian, Inverse] | tuple[()] = ()


class Impedance(NamedTuple):
    """A law u = law(R, omega, m, R_d, gains, inertia): the hand's angular acceleration in the base frame [rad/s^2].

    m: the moment on the hand plus the one it is to exert [N m], base frame. inertia: apparent, [kg m^2]. Near the
    goal the stiffness is kp inertia [N m/rad]; of an impedance in coordinates it is that times B^-T B^-1.
    law_in(coordinates) -> law, of an impedance in coordinates; `law` is then None.
    relative: the coordinates are those of R_d^T R.
    design(K, Lambda, zeta, D, scratch): of one that shapes no inertia, in place of a law: write the damping D (6 x 6)
    [N s/m, N m s/rad], base frame; from six stiffnesses K [N/m, N m/rad], the hand's inertia Lambda at the pose (6 x 6,
    both halves) and the desired damping ratio zeta. Neither K nor Lambda is changed.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable | None = None
    law_in: Callable | None = None
    relative: bool = False
    design: Callable | Any = None
    attribution: str = YOURS


class Spring(NamedTuple):
    """moment(q, K) -> m: the moment [N m] on the hand in the hand's axes.

    q: the unit quaternion (w, x, y, z), w >= 0, of R_d^T R. K: the stiffness [N m/rad], a symmetric matrix by rows.
    potential(q, K) -> [J]; None if there is none for every K. formula: of the moment, in TeX. frames: the axes in which
    the moment may be taken, "tool" or "goal"; base axes are the goal's, turned by a constant. stiffness: the share of K
    that is felt at the goal.
    """

    name: str
    title: str
    source: str
    formula: str
    moment: Callable
    potential: Callable | None = None
    frames: tuple[str, ...] = ("tool",)
    stiffness: float = 1.0
    attribution: str = YOURS
