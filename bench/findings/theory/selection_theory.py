"""Theory of two orders of selection: what a hand exerts where it complies, in two cases.

Of rows that are held (1) and rows that comply (2), with Lambda in blocks, the commanded
acceleration a of what is held and the wrench h to exert, on a hand at rest:

    selected-then-decoupled    W = (Lambda_11 a, Lambda_21 a + h)
    decoupled-then-selected    W = (Lambda_11 a, h)

    motion that happens   A rigid wall without friction lets no row move that complies, and leaves
                          the others free: Lambda_11 xddot_1 = W_1, and W_2 - Lambda_21 xddot_1 is
                          exerted on the wall. Both orders accelerate the hand by a; the first
                          exerts h, the second h - Lambda_21 a.
    motion that is stopped   Nothing moves, and all of W is exerted: h + Lambda_21 a by the first
                          order, h by the second.

The error is what is exerted less h. Units of Lambda: kg, kg m and kg m^2, by the units of its rows.

Limitations: contact that gives way, or that slips and sticks in turns, lies between the two cases.
Source: Khatib 1987, eq. 46, for the first order; the rest follows from xddot = Lambda^-1 (W -
exerted).
"""

from collections.abc import Sequence

import numpy as np

from bench.base.errors import UnknownWord
from bench.law.control.contact_controller import SELECTION_ORDERS
from tasks.arm_model import Arm
from tasks.base import Vector
from tasks.hand_frames import at

HAPPENS, HELD = "motion that happens", "motion that is stopped"
CASES = (HAPPENS, HELD)

SELECTED_FIRST, DECOUPLED_FIRST = SELECTION_ORDERS


def exerted_error(
    order: str,
    case: str,
    Lambda: np.ndarray,
    held: Sequence[float],
    a: Sequence[float],
) -> np.ndarray:
    """Return what the hand exerts less h [N, N m]; one number a row that complies.

    Args:
        order: one of SELECTION_ORDERS. case: one of CASES.
        Lambda: the inertia at the hand, 6 x 6.
        held: 6, above 0 where the row is held.
        a: 6, the commanded acceleration [m/s^2, rad/s^2]; only its rows that are held count.

    Raises:
        UnknownWord: an order or a case that is none of those.
    """
    if order not in SELECTION_ORDERS:
        raise UnknownWord("order of selection", order, sorted(SELECTION_ORDERS))
    if case not in CASES:
        raise UnknownWord("case", case, sorted(CASES))
    is_held = np.array(held) > 0.0
    coupled = Lambda[np.ix_(~is_held, is_held)] @ np.array(a, dtype=float)[is_held]
    if (order == SELECTED_FIRST) == (case == HAPPENS):
        return np.zeros(len(coupled))
    return coupled if order == SELECTED_FIRST else -coupled


def inertia_at(arm: Arm, tip: Vector) -> np.ndarray:
    """Return Lambda = (J D^-1 J^T)^-1 of an arm at home, 6 x 6, base frame.

    tip: the point whose inertia it is, in the wrist's frame [m].
    """
    from tasks.kinematics import Kinematics  # MuJoCo takes a moment to import

    wrist = Kinematics(arm, "wrist")
    place, _ = wrist.pose(arm.home)
    lever = np.array(at(arm, arm.home, tip)) - place
    moved = np.eye(6)
    moved[:3, 3:] = np.cross(np.eye(3), lever).T  # pdot + omega x lever
    mobility = wrist.mobility(arm.home)
    return np.linalg.inv(moved @ mobility @ moved.T)
