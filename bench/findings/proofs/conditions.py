"""Conditions on polynomials: what a path of a law knows, and what a question asks."""

from typing import NamedTuple

from sympy.polys.rings import PolyElement

OPPOSITE = {"<": ">=", ">=": "<", "<=": ">", ">": "<=", "=": "!=", "!=": "="}
CLOSED = {"<": "<=", ">": ">=", "<=": "<=", ">=": ">=", "=": "="}
"""The relation that also holds on the edge of the set where a relation holds."""
TURNED = {"<": ">", ">": "<", "<=": ">=", ">=": "<=", "=": "=", "!=": "!="}
"""The relation of -p to zero, where p has a relation to zero."""


class PolynomialRelation(NamedTuple):
    """A polynomial's relation to zero: <, <=, >, >=, = or !=."""

    polynomial: PolyElement
    relation: str

    def opposite(self) -> "PolynomialRelation":
        """Return the condition that holds where this one does not."""
        return PolynomialRelation(self.polynomial, OPPOSITE[self.relation])

    def normal(self) -> "PolynomialRelation":
        """Return the same condition on a polynomial whose leading coefficient is 1."""
        leading = self.polynomial.LC
        if not leading:
            return self
        relation = self.relation if leading > 0 else TURNED[self.relation]
        return PolynomialRelation(self.polynomial.quo_ground(leading), relation)

    def answer(self) -> bool | None:
        """Return whether it holds, if its polynomial is a number; else None."""
        if not self.polynomial.is_ground:
            return None
        number = self.polynomial.LC
        holds = {
            "<": number < 0,
            "<=": number <= 0,
            ">": number > 0,
            ">=": number >= 0,
            "=": number == 0,
            "!=": number != 0,
        }
        return bool(holds[self.relation])


IMPLIED = {
    "<": {"<": True, "<=": True, "!=": True, ">": False, ">=": False, "=": False},
    ">": {">": True, ">=": True, "!=": True, "<": False, "<=": False, "=": False},
    "=": {"=": True, "<=": True, ">=": True, "!=": False, "<": False, ">": False},
    "<=": {"<=": True, ">": False},
    ">=": {">=": True, "<": False},
    "!=": {"!=": True, "=": False},
}
"""What one relation of a polynomial to zero says of another: known -> asked -> whether it holds."""


def find_answer(known: list[PolynomialRelation], asked: PolynomialRelation) -> bool | None:
    """Return whether a condition holds by what is known of the same polynomial; None: that does not say.

    All are in normal form.
    """
    for fact in known:
        if fact.polynomial == asked.polynomial:
            answer = IMPLIED[fact.relation].get(asked.relation)
            if answer is not None:
                return answer
    return None
