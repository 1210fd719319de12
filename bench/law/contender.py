"""A contender: a law and its coordinates, and on an arm the Jacobian and the inverse that it is resolved by."""

from collections.abc import Callable
from typing import NamedTuple

from bench.base.errors import Incompatible
from bench.law.attribution import ADAPTED, PUBLISHED
from bench.law.display import Equation
from bench.law.kinds import ON_MATRIX, Baseline, Coordinates, Impedance, Inverse, Jacobian, Law, OnCoordinates


class Contender(NamedTuple):
    """A regulator in the coordinates it acts on, and on an arm its Jacobian and inverse: what one row is about.

    baseline: the record whose law the regulator is, where a baseline of arms controls in its place.
    """

    regulator: Law
    representation: Coordinates | None = None
    jacobian: Jacobian | None = None
    inverse: Inverse | None = None
    baseline: Baseline | None = None

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
    def words(self) -> dict[str, str]:
        """Return the names of its parts, by the columns of tables that name a contender; empty where it has none."""
        parts = zip(self._fields, self[:4], strict=False)  # all but the baseline
        return {kind: part.name if part else "" for kind, part in parts}

    @property
    def way(self) -> tuple[str, str]:
        """Names of the Jacobian and the inverse; empty on the free body."""
        return self.words["jacobian"], self.words["inverse"]

    @property
    def is_beyond_the_paper(self) -> bool:
        """Whether it is a later law of ours, or one on coordinates that the paper sets aside (Murphy 1988, 2.2)."""
        is_beyond = self.uses_nonpaper_coordinates or self.regulator.is_beyond_the_paper
        return is_beyond and not self.regulator.origin

    @property
    def uses_nonpaper_coordinates(self) -> bool:
        """Whether it acts on coordinates that the paper sets aside (Murphy 1988, 2.2)."""
        return self.representation is not None and not self.representation.is_in_paper

    @property
    def attribution(self) -> str:
        """Attribution (`bench.law.attribution`): a published law in coordinates that its work has not is adapted."""
        if self.uses_nonpaper_coordinates and self.regulator.attribution == PUBLISHED:
            return ADAPTED
        return self.regulator.attribution

    @property
    def short(self) -> str:
        """What it is called beside a curve: the law, or of one in several coordinates where it is."""
        if not self.regulator.display.short:
            return self.on_free_body
        if self.representation is None or not self._is_abroad:
            return self.regulator.display.short
        return f"in {self.representation.display.short or self.representation.name}"

    @property
    def family(self) -> str:
        """The title of those it is drawn with; another one for a law in others than the paper's coordinates."""
        short, family = self.regulator.display.short, self.regulator.display.family
        return f"{short[:1].upper()}{short[1:]} elsewhere" if short and self._is_abroad else family

    @property
    def _is_abroad(self) -> bool:
        coordinates = self.regulator.coordinates
        return self.uses_nonpaper_coordinates and (coordinates == "any" or len(coordinates) > 1)

    @property
    def equation(self) -> Equation | None:
        """Return the equation of motion of its angle, if it turns a free body about one fixed axis from rest."""
        equation = self.regulator.display.equation
        return equation(self.representation) if callable(equation) else equation

    @property
    def is_by_coordinates(self) -> bool:
        """Whether its Jacobian takes an acceleration of coordinates (Murphy 1988, 3.7)."""
        return self.jacobian is not None and self.jacobian.takes == "coordinates"

    @property
    def rows(self) -> int:
        """Rows of the Jacobian: three of position, and one a coordinate of orientation."""
        return 3 + len(self.representation.symbols) if self.is_by_coordinates and self.representation else 6

    @property
    def law(self) -> Callable:
        """The law with its coordinates filled in."""
        return bind(self.regulator, self.representation)

    @property
    def coordinate_law(self) -> Callable:
        """The law that commands the coordinates' acceleration; see `OnCoordinates`."""
        if self.coordinate_law_in is None or self.representation is None:
            raise Incompatible(f"'{self.on_free_body}' commands no acceleration of coordinates")
        return self.coordinate_law_in(self.representation)

    @property
    def coordinate_law_in(self) -> Callable | None:
        """What makes the law that commands the coordinates' acceleration; None if the law commands none."""
        law = self.regulator.law
        return law.coordinate_law_in if isinstance(law, OnCoordinates) else None


def bind(one: Law | Impedance, representation: Coordinates | None) -> Callable:
    """Return the law of a regulator or an impedance, in a representation if it acts on one."""
    law = one.law
    law_in = one.law_in if isinstance(one, Impedance) else None
    if isinstance(law, OnCoordinates):
        law_in = law.law_in
        law = None
    if representation is not None and law_in is not None:
        return law_in(representation)
    if law is None:
        raise Incompatible(f"'{one.name}' has neither law nor law_in for the coordinates it names")
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
        if one.coordinate_law_in is None or representation is None:
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


def contender(regulator: Law, representation: Coordinates | None = None) -> Contender:
    """Put the two together, or refuse (Incompatible): a representation too many or too few."""
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


def axes_of(representation: Coordinates) -> tuple[int, int, int]:
    """Return which coordinate is the one about x, about y and about z, near E = 0; Incompatible: some axis has none."""
    if representation.about is None:
        raise Incompatible(
            f"'{representation.name}' has no coordinate for each of the axes x, y and z to be held or to comply "
            "(try: zyx-euler)"
        )
    return representation.about
