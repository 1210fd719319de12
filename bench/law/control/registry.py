"""Every controller in contact there is: hybrids in every form, and the impedances that were found."""

from bench.base.errors import Incompatible, UnknownWord
from bench.law.contenders.registry import contenders, representation
from bench.law.control.contact_controller import (
    ALONG_AXES,
    FORMS,
    HYBRIDS,
    ContactController,
    hybrid,
    impedance_controller,
)


def all_controllers() -> list[ContactController]:
    """Every hybrid controller in every form, then every impedance; each in every representation that it takes."""
    along = [one for one in contenders("representations").values() if one.about is not None]
    found = []
    for law in HYBRIDS:
        for one in (None,) if law in ALONG_AXES else along:
            found += [hybrid(law, form, one) for form in FORMS]
    for impedance in contenders("impedances").values():
        found += [impedance_controller(impedance, one) for one in (along if impedance.law_in else (None,))]
    return found


def find_controller(word: str) -> ContactController:
    """Return the controller in contact of `law[/representation][+form]`, as the command line writes it."""
    rest, plus, form = word.partition("+")
    law, _, coordinates = rest.partition("/")
    springs = {f"impedance-{name}": one for name, one in contenders("impedances").items()}
    if law not in (*HYBRIDS, *springs):
        raise UnknownWord("controller", law, sorted((*HYBRIDS, *springs)))
    along = representation(coordinates) if coordinates else None
    if law in HYBRIDS:
        one = hybrid(law, form or FORMS[0], along)
        if not form:
            raise Incompatible(f"'{word}' lacks its form (try: {', or '.join(f'{rest}+{one}' for one in FORMS)})")
        return one
    if plus:
        raise Incompatible(f"'{word}': an impedance has one way to the joints (omit '+{form}')")
    return impedance_controller(springs[law], along)
