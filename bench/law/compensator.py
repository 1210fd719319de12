"""A law with a state that obeys a differential equation: a filter in place of the measured rate, or an integral."""

from collections.abc import Callable
from typing import NamedTuple


class Compensator(NamedTuple):
    """A dynamic law: (u, state') = law(R, omega, goal, gains, state), from the state begin(R).

    u: commanded angular acceleration in the base frame [rad/s^2]. state: four numbers; state': their rates, which
    whoever runs the law integrates over the control period. A Regulator's memory is carried from tick to tick as it
    is, and needs no period.

    measures_rate: whether the law reads omega. rejects: whether a constant disturbance leaves no error.
    polynomial(kp, kv): of small angles, the coefficients (c2, c1, c0) of s^3 + c2 s^2 + c1 s + c0; None of one
    whose state does nothing.
    bound(kp, kv): what |u| never exceeds [rad/s^2]; None if there is nothing.
    property: what is proved of it, and for which gains.
    """

    name: str
    title: str
    source: str
    formula: str
    law: Callable
    begin: Callable
    polynomial: Callable | None
    measures_rate: bool
    rejects: bool
    property: str
    bound: Callable | None = None
