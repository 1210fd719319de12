"""What a controller in contact costs per tick: its rows, and what `hybrid.comply` makes torques of.

Counted as on an arm, on the same states, with a wrench on the hand; see `on_arms`. The stage "regulate" is the rows: J,
Jdot qdot, the law, and the wrench in its frame. "invert" is y and the torques.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np

from bench.engines.contact_episode import room, rows
from bench.engines.counting.costs import Cost, CountedCall, cost_of, rows_of
from bench.engines.counting.counted import Tally
from bench.engines.counting.on_arms import ARM_OF, ArmState, arm_states, call_on_arm, median
from bench.engines.counting.states import GAINS
from bench.law.chain import Chain
from bench.law.control.contact_controller import FORMS, ContactController
from bench.law.control.hybrid import INVERSE, comply
from bench.law.control.setpoint import TOUCH, Setpoint
from tasks.contact import Specification

TILTING = Specification("about x and y", (1, 1, 1, 0, 0, 1))
"""Two compliant turns, the paper's case. What complies costs five operations, what is held one; of the projected form
what is held costs a pseudo-inverse of so many rows."""

SEED = 61


def cost_in_contact(controller: ContactController, specification: Specification = TILTING, joints: int = 6) -> Cost:
    """Count a controller over all states of an arm of six or seven joints, as `costs.cost`; typical is the median."""
    held, draw = controller.selection(specification), np.random.default_rng(SEED)
    with np.errstate(all="ignore"):
        calls = [_call(controller, held, state, draw) for state in arm_states(ARM_OF[joints])]
    return cost_of(controller, calls, median)


def rows_in_contact(controller: ContactController) -> Iterator[dict]:
    """Return a line for each branch and stage of a controller's cost."""
    return rows_of(cost_in_contact(controller), {"controller": controller.name}, ("regulate", "invert"))


def _call(
    controller: ContactController, held: Any, state: ArmState, draw: np.random.Generator
) -> CountedCall:
    f, m, v_d, f_d, m_d = (tuple(three) for three in draw.normal(size=(5, 3)))
    setpoint = Setpoint(state.goal.R, state.p_d, v_d, f_d, m_d)
    given, tally = (state.chain, setpoint, f, m, GAINS, TOUCH, state.D, state.fg), Tally()

    def torques(
        chain: Chain, setpoint: Setpoint, f: Any, m: Any, gains: Any, touch: Any, D: Any, fg: Any, dtype: Any
    ) -> tuple:
        J, tau, into = np.zeros((6, chain.n), dtype), np.zeros(chain.n, dtype), rows(dtype)
        tally.stage = "regulate"
        controller.assemble(chain, setpoint, f, m, gains, touch, J, into)
        tally.stage = "invert"
        form = FORMS.index(controller.form) if controller.form else INVERSE
        comply(form, held, chain, D, fg, J, into, gains, touch, room(dtype), tau)
        return tuple(tau)

    return call_on_arm(controller.name, state, tally, given, torques, torques)
