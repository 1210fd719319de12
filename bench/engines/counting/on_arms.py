"""What a whole controller of an arm costs per tick, by stage; what MuJoCo computes (J's joints, D, fg) is not ours.

Counted like a law: the same functions that run, called with counting scalars in object arrays, each call checked
against the plain one bit for bit. The states are those of one arm for each number of joints, for nothing here
depends on anything else of an arm.
"""

import functools
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

import tasks
from bench.engines.arm_episode import buffers
from bench.engines.counting.costs import Cost, CountedCall, checked, cost_of, counted, rows_of, size
from bench.engines.counting.counted import Counts, Tally
from bench.engines.counting.staged import in_stage, law_of, staged
from bench.engines.counting.states import GAINS, goal_of
from bench.law.chain import Chain
from bench.law.contender import Contender
from bench.law.control.resolved_acceleration import Parts, assembly, control, parts_of
from bench.law.inputs import NO_MEMORY, Goal
from bench.law.so3 import Rotation
from tasks.base import Start

ARM_OF = {6: "ur5e", 7: "panda"}
"""The arm whose states are used, by the number of joints."""

TASK = "arm-regulation"
SAMPLED, DIRECTED = {"uniform": 12, "tumbling": 12}, {"pole": 6, "wrist": 6, "half-turn": 4}
UNSEEN = "report"
"""A stage that no table has: what is computed for the record alone."""


class ArmState(NamedTuple):
    """What a controller is called with; `is_sampled` if it counts towards the typical branch."""

    id: str
    chain: Chain
    D: np.ndarray
    fg: np.ndarray
    goal: Goal
    p_d: tuple
    is_sampled: bool


@functools.cache
def arm_states(arm: str) -> tuple[ArmState, ...]:
    """All of them, always the same, the sampled ones first."""
    import mujoco  # takes a moment to import; naming operations must not

    model = mujoco.MjModel.from_xml_string(tasks.task(TASK, arm).xml(1e-3))
    data = mujoco.MjData(model)
    return tuple(
        _state(model, data, start, sizes is SAMPLED)
        for sizes in (SAMPLED, DIRECTED)
        for name, size in sizes.items()
        for start in tasks.start_set(name, size, arm=arm)
    )


def _state(model: Any, data: Any, start: Start, is_sampled: bool) -> ArmState:
    import mujoco

    data.qpos[:], data.qvel[:] = start.q, start.qdot
    mujoco.mj_forward(model, data)
    D = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, D)
    s = data.sensordata
    R = Rotation(tuple(s[0:3]), tuple(s[3:6]), tuple(s[6:9]))
    chain = Chain(model.nv, data.xaxis.copy(), data.xanchor.copy(), data.qvel.copy(), tuple(s[16:19]), R)
    goal = goal_of(start.goal_wxyz)
    return ArmState(start.id, chain, D, data.qfrc_bias - data.qfrc_passive, goal, chain.p, is_sampled)


def cost_on_arm(contender: Contender, arm: str) -> Cost:
    """Count a controller over an arm's states, as `costs.cost`; typical is the median, for an iteration varies."""
    tally = Tally()
    plain = _controller(contender, parts_of(contender, _command(contender, None)), None)
    counting = _controller(contender, _staged_parts(contender, tally), tally)
    with np.errstate(all="ignore"):
        calls = [_call(contender, plain, counting, tally, state) for state in arm_states(arm)]
    return cost_of(contender, calls, median)


def median(counts: list[Counts]) -> Counts:
    """Return the upper median by size."""
    return sorted(counts, key=size)[len(counts) // 2]


def rows_on_arm(contender: Contender, joints: int) -> list[dict]:
    """Rows of costs.parquet of a contender on so many joints."""
    return list(rows_of(cost_on_arm(contender, ARM_OF[joints]), contender.words | {"joints": joints}))


def _command(contender: Contender, tally: Tally | None) -> Any:
    """Return the law as `resolved_acceleration.Parts` takes it; staged if there is a tally."""
    if contender.is_by_coordinates:
        return contender.coordinate_law
    if contender.regulator.law is None and contender.baseline is not None:
        return None
    law = contender.law if tally is None else law_of(contender, tally)
    if contender.regulator.memory is not None:
        return law
    return lambda R, omega, goal, gains, memory: (law(R, omega, goal, gains), memory)


def _staged_parts(contender: Contender, tally: Tally) -> Parts:
    parts = parts_of(contender, _command(contender, tally))
    stages = {
        "command": "regulate",
        "fill": "jacobian",
        "convert": "jacobian" if parts.coordinates is None else "linearize",
        "twist": "measure",
        "bias_acceleration": "linearize",
        "hold": "regulate",
        "report": UNSEEN,
        "assemble": "regulate",
    }
    fields: dict[str, Any] = {
        name: in_stage(tally, stage, function) for name, stage in stages.items() if (function := getattr(parts, name))
    }
    if parts.coordinates is not None:
        fields["coordinates"] = staged(parts.coordinates, tally)
    return parts._replace(**fields)


def _controller(contender: Contender, parts: Parts, tally: Tally | None) -> Callable:
    inverse = contender.inverse
    assert inverse is not None  # parts_of has refused a contender without
    resolve = inverse.resolve if tally is None else in_stage(tally, "invert", inverse.resolve)
    assemble, gives_torque = assembly(parts), int(inverse.gives == "torque")

    def controller(chain: Chain, D: Any, fg: Any, goal: Goal, p_d: Any, memory: Any, gains: Any, dtype: type) -> tuple:
        into = buffers(chain.n, dtype)
        u, memory = control(
            assemble, resolve, gives_torque, contender.rows, chain, D, fg, goal, p_d, gains, memory, into
        )
        return u, memory, tuple(into.tau)

    return controller


def _call(
    contender: Contender, plain: Callable, counting: Callable, tally: Tally, state: ArmState
) -> CountedCall:
    memory = tuple(np.float64(x) for x in (*(contender.regulator.memory or ()), *NO_MEMORY)[: len(NO_MEMORY)])
    given = (state.chain, state.D, state.fg, state.goal, state.p_d, memory, GAINS)
    tally.stage = "linearize"
    return call_on_arm(contender.name, state, tally, given, plain, counting)


def call_on_arm(
    name: str, state: ArmState, tally: Tally, given: tuple, plain: Callable, counting: Callable
) -> CountedCall:
    """Return a counted call of what takes the type of its buffers last."""
    given_counted = counted(given, tally)
    call, _ = checked(name, state, tally, lambda: plain(*given, float), lambda: counting(*given_counted, object))
    return call
