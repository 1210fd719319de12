"""Contact controllers: what takes part in the tasks of contact."""

from collections.abc import Callable
from typing import NamedTuple

from bench.base.errors import BadNumber, Incompatible
from bench.law.contender import axes_of, bind
from bench.law.contenders.registry import papers_coordinates
from bench.law.control import hybrid as hybrid_control
from bench.law.control.impedance import assembly
from bench.law.control.setpoint import TOUCH, ContactParameters
from bench.law.inputs import PAPERS_GAINS, Gains
from bench.law.kinds import Coordinates, Impedance

FORMS = ("inverse", "projected", "transpose", "selected-then-decoupled", "decoupled-then-selected")
"""Forms of `hybrid.comply`, in the order of its numbers."""

PAPERS_FORM = FORMS[hybrid_control.TRANSPOSE]
ACCELERATION_FORMS = FORMS[: hybrid_control.TRANSPOSE]
"""The paper's force control, and the two that command what complies an acceleration."""

SELECTION_ORDERS = FORMS[hybrid_control.SELECTED_FIRST :]
"""Operational-space force control by its two orders of selection, see `selection_order`."""

ALONG_AXES = {
    "hybrid-base": hybrid_control.in_base,
    "hybrid-rate": hybrid_control.in_base_by_rate,
    "hybrid-hand": hybrid_control.in_hand,
}
HYBRIDS = {
    "hybrid-base": "along axes of the base frame",
    "hybrid-rate": "along axes of the base frame; turns that are held are held by their rate alone",
    "hybrid-hand": "along axes that the hand carries along",
    "hybrid": "along x, y, z and coordinates, on their Jacobian",
    "hybrid-unconverted": "along coordinates, with moments taken for generalized forces: a negative control",
}
"""Laws of hybrid control, and what each holds and complies along."""


class ContactController(NamedTuple):
    """A controller in contact.

    law: one of HYBRIDS, or "impedance-" and the name of an impedance. form: how a hybrid's rows become torques, one of
    FORMS; empty for an impedance.
    """

    law: str
    representation: Coordinates | None = None
    form: str = ""
    impedance: Impedance | None = None

    @property
    def name(self) -> str:
        """`law[/representation][+form]`: the word on the command line."""
        coordinates = f"/{self.representation.name}" if self.representation else ""
        return f"{self.law}{coordinates}{f'+{self.form}' if self.form else ''}"

    @property
    def assemble(self) -> Callable:
        """Its rows: assemble(chain, setpoint, f, m, gains, touch, J, rows)."""
        if self.impedance is not None:
            return assembly(bind(self.impedance, self.representation))
        if self.representation is not None:
            return hybrid_control.in_coordinates(self.representation, self.converts)
        return ALONG_AXES[self.law]

    @property
    def converts(self) -> bool:
        """Whether moments become generalized forces by (3.12); the negative control takes them as they are."""
        return self.law != "hybrid-unconverted"

    def selection(self, specification) -> tuple[float, ...]:
        """Return 1.0 for each row held and 0.0 for each that complies; an impedance holds all, by its springs."""
        if self.impedance is not None:
            return (1.0,) * 6
        turns = specification.selection[3:]
        if self.representation is not None:
            of_coordinate = dict(zip(axes_of(self.representation), turns, strict=True))
            turns = tuple(of_coordinate[k] for k in range(3))
        return tuple(map(float, (*specification.selection[:3], *turns)))


def hybrid(law: str, form: str, representation: Coordinates | None = None) -> ContactController:
    """Return a hybrid controller, or refuse (Incompatible) unknown words, or a representation that does not fit."""
    if law not in HYBRIDS:
        raise Incompatible(f"'{law}' is no hybrid controller; known: {', '.join(HYBRIDS)}")
    if form not in FORMS:
        raise Incompatible(f"'{form}' is no form of hybrid control; known: {', '.join(FORMS)}")
    takes = law in ("hybrid", "hybrid-unconverted")
    if takes and representation is None:
        usual = papers_coordinates().name
        raise Incompatible(f"'{law}' selects along coordinates and needs some (try: {law}/{usual}+{form})")
    if not takes and representation is not None:
        raise Incompatible(f"'{law}' selects along axes and takes no representation (try: {law}+{form})")
    if representation is not None:
        axes_of(representation)
    return ContactController(law, representation, form)


def impedance_controller(one: Impedance, representation: Coordinates | None = None) -> ContactController:
    """Return an impedance controller, or refuse (Incompatible) a representation too many or too few."""
    word = f"impedance-{one.name}"
    if one.law_in is not None and representation is None:
        raise Incompatible(f"'{word}' acts on coordinates and needs some (try: {word}/{papers_coordinates().name})")
    if one.law_in is None and representation is not None:
        raise Incompatible(f"'{word}' takes no representation (omit '{representation.name}')")
    if representation is not None:
        axes_of(representation)
    return ContactController(word, representation, impedance=one)


def check_constants(gains: Gains, touch: ContactParameters) -> None:
    """BadNumber if a gain, an apparent inertia or a damping is none."""
    usual = PAPERS_GAINS._asdict() | TOUCH._asdict()
    units = {"kp": "1/s^2", "kv": "1/s", "m_p": "kg", "m_o": "kg m^2", "kc": "1/s", "kf": "1"}
    for name, value in (gains._asdict() | touch._asdict()).items():
        if not 0.0 < value < float("inf"):
            raise BadNumber(f"{name} = {value} {units[name]}: give a finite number above 0 (try: {usual[name]})")
