"""With a perfect model and J far from singular, the tool turns as the free body does, to the integration error.

The arm's plant is (2.6)-(2.7) by (2.3), so that a law, a start and a goal give one response in continuous time.
MuJoCo's Euler takes steps in the joints here and in the body's own coordinates there, and a step's error is of second
order in dt: the two responses are within a few ticks of each other, half as much at half the dt, and both tend to the
response of the ideal plant.
"""

import functools
import math

import numpy as np
import pytest
from support.driving import settings
from support.on_arms import ARMS, LAWS, named

import tasks
from bench.engines.arm_episode import POSE
from bench.engines.episode import FINAL_ANGLE, FIRST_METRIC, OUTCOME, SETTLING_TICK
from bench.engines.metrics.registry import metrics_of
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm
from bench.law.so3 import from_quaternion
from tasks.cause import NEAR_CONDITION
from tasks.kinematics import kinematics
from tasks.verdict import SETTLED

ON_BODY, ON_ARM = metrics_of(on_arm=False), metrics_of(on_arm=True)
MIN_MARGIN = FIRST_METRIC + [metric.column for metric in ON_BODY].index("min_margin")

DT = 1e-3
LONG = 3.0
"""[s]: all settle well before it."""

TICKS, SETTLING_TICKS = 4.0, 8
"""How far apart the responses may be, in what an angle changes in a tick at its fastest: 2.4 was the most that was
seen, of a law whose coordinates magnify by 4. At the band's edge the same difference of angle takes longer."""

SECOND_ORDER = 0.05
"""What is left of an error by extrapolating it from dt and dt/2, over the error: 1 % in most responses here."""

JUMP = 0.1
"""[rad]: ten times as far as an integration error throws a response over a jump that it would have missed."""

TIMES = (0.1, 0.2, 0.3, 0.45)
"""[s]: a response of the double pole at -10/s is at 74, 41, 20 and 6 per cent of its start then."""

AWAY = 0.25
"""Margin of the coordinates along the whole response: rates are up to four times the tool's, errors up to 16 times."""


def ways(law) -> tuple:
    """Jacobians that the law can be run by."""
    return ("geometric",) if law.regulator.coordinate_law_in is None else ("geometric", "analytic")


# Every law on an arm, the paper's on two; Jacobians take turns. `test_arm_engines` has every law on every arm.
CASES = [
    pytest.param(arm, law, by, id=f"{arm}-{law.name}-{by}")
    for a, arm in enumerate(ARMS)
    for k, law in enumerate(LAWS.values())
    for by in (ways(law)[(a + k) % len(ways(law))],)
    # one that claims nothing has no response to compare, and MuJoCo's actuator turns the free body alone
    if law.regulator.property != "none"
    and not law.regulator.in_engine
    and (a - k) % len(ARMS) in ((0,) if law.is_beyond_the_paper else (0, 2))
]


@functools.cache
def starts(arm: str) -> tuple:
    """`clear` was chosen to be so along the geodesic and the straight line in Z-Y-X angles."""
    return tuple(tasks.start_set("clear", 4, arm=arm))


@functools.cache
def on_body(arm: str, law, engine: str, dt: float, at: float) -> np.ndarray:
    """Rows of the free body at that time."""
    return run(engine, law, "free-body", starts(arm), settings(dt_s=dt, horizon_s=at), ON_BODY)


def angles_on_body(arm: str, law, engine: str, dt: float, ticks: int = 0) -> np.ndarray:
    """A row a time, so many ticks later; a column a start."""
    return np.array([on_body(arm, law, engine, dt, at + ticks * dt)[:, FINAL_ANGLE] for at in TIMES])


@functools.cache
def on_arm(arm: str, one, dt: float, at: float) -> np.ndarray:
    """Rows of the arm at that time, by motors without a limit: the Jaco's are too weak for some of its turns."""
    chosen = settings(dt_s=dt, horizon_s=at, torque_limit=math.inf)
    return run_arm("native", one, "arm-regulation", arm, starts(arm), chosen, ON_ARM)


def regular(arm: str, law, one) -> np.ndarray:
    """Starts whose response is smooth, on the free body and in the arm.

    Both ends are off the jumps of the coordinates, and so is the straight line between them; the free body settles,
    its margin is kept, and its own error is of first order in dt; the arm's J is well conditioned all the way.
    """
    smooth = [all(off_jumps(law, quat) for quat in (one.quat_wxyz, one.goal_wxyz)) for one in starts(arm)]
    body = on_body(arm, law, "ideal-rk4", DT, LONG)
    coarse, fine = (angles_on_body(arm, law, "native", dt) - exact_angles(arm, law) for dt in (DT, DT / 2.0))
    first_order = np.abs(2.0 * fine - coarse).max(axis=0) <= SECOND_ORDER * np.abs(coarse).max(axis=0)
    poses = on_arm(arm, one, DT, LONG)[:, POSE + 1 :][:, : tasks.arm(arm).joints]
    conditions = np.array([kinematics(tasks.arm(arm)).condition(q) if np.isfinite(q).all() else np.inf for q in poses])
    kept = (body[:, OUTCOME] == SETTLED) & ~(body[:, MIN_MARGIN] < AWAY)
    return np.array(smooth) & kept & first_order & (conditions < NEAR_CONDITION)


def off_jumps(law, quat_wxyz) -> bool:
    """Whether the coordinates are JUMP from where they jump: Euler angles at +-pi, the others at a half turn."""
    coordinates = law.representation
    if coordinates is None or law.regulator.relative:
        return True
    if coordinates.differentiate is not None:
        return max(map(abs, coordinates.chart(from_quaternion(quat_wxyz)).E)) < math.pi - JUMP
    return 2.0 * math.acos(min(1.0, abs(quat_wxyz[0]))) < math.pi - JUMP


def exact_angles(arm: str, law) -> np.ndarray:
    """Return the angles of the ideal plant by Runge-Kutta, exact to 1e-5 of a response."""
    return angles_on_body(arm, law, "ideal-rk4", DT)


@pytest.mark.parametrize(("arm", "law", "by"), CASES)
def test_arm_turns_as_the_free_body_does_to_the_integration_error(arm, law, by):
    one = named(arm, f"{law.name}@{by}+standard")
    chosen = regular(arm, law, one)
    assert chosen.any()
    exact = exact_angles(arm, law)[:, chosen]
    apart, errors = [], []
    for dt in (DT, DT / 2.0):
        tool = np.array([on_arm(arm, one, dt, at)[:, FINAL_ANGLE] for at in TIMES])[:, chosen]
        before, body, after = (angles_on_body(arm, law, "native", dt, k)[:, chosen] for k in (-1, 0, 1))
        tick = np.abs(after - before).max(axis=0) / 2.0
        assert (np.abs(tool - body).max(axis=0) <= TICKS * tick).all()
        apart.append(np.abs(tool - body).max())
        errors.append(tool - exact)
    assert 0.45 < apart[1] / apart[0] < 0.55  # half the dt, half the difference
    left = np.abs(2.0 * errors[1] - errors[0]).max()  # and extrapolated to dt = 0 both are the ideal plant's
    assert left <= SECOND_ORDER * np.abs(errors[0]).max()
    settled, settled_there = (
        rows[chosen, SETTLING_TICK] for rows in (on_arm(arm, one, DT, LONG), on_body(arm, law, "native", DT, LONG))
    )
    assert (np.abs(settled - settled_there) <= SETTLING_TICKS).all()
