"""What an impedance is: the record that each file of bench/law/contenders/impedances holds."""

from collections.abc import Callable
from typing import NamedTuple

from bench.law.scalar import kernel


@kernel
def driven(m, inertia, spring, kv, omega):
    """Compute the resulting angular acceleration, m/m_o + spring - Kv omega."""
    return (
        m[0] / inertia + spring[0] - kv * omega[0],
        m[1] / inertia + spring[1] - kv * omega[1],
        m[2] / inertia + spring[2] - kv * omega[2],
    )


class Impedance(NamedTuple):
    """A law u = law(R, omega, m, R_d, gains, inertia): the hand's angular acceleration in the base frame [rad/s^2].

    m: the moment on the hand plus the one it is to exert [N m], base frame. inertia: apparent, [kg m^2]. Near the
    goal the stiffness is kp inertia [N m/rad]; of an impedance in coordinates it is that times B^-T B^-1.
    law_in(representation) -> law, of an impedance in coordinates; `law` is then None.
    relative: the coordinates are those of R_d^T R.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable | None = None
    law_in: Callable | None = None
    relative: bool = False
