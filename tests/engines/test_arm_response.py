"""With a perfect model and J far from singular, the tool turns as the free body does, to the integration error.

The arm's plant is (2.6)-(2.7) by (2.3), so that a law, a start and a goal give one response in continuous time.
MuJoCo's Euler takes steps in the joints here and in the body's own coordinates there, and a step's error is of second
order in dt: the two responses are within a few ticks of each other, half as much at half the dt, and both tend to the
response of the ideal plant. Starts are clear of singularities of J and of the Z-Y-X angles.
"""

import functools
import math

import numpy as np
import pytest
from support.driving import ARM_METRICS, METRICS, settings
from support.on_arms import ARMS, LAWS, named

import tasks
from bench.engines.episode import FINAL_ANGLE, SETTLING_TICK
from bench.engines.simulate import run
from bench.engines.simulate_arms import run_arm

DT = 1e-3
LONG = 3.0
"""[s]: all settle well before it."""

TICKS, SETTLING_TICKS = 4.0, 8
"""How far apart the responses may be, in what an angle changes in a tick at its fastest: 2.4 was the most that was
seen, of a law whose coordinates magnify by 4. At the band's edge the same difference of angle takes longer."""

SECOND_ORDER = 0.05
"""What is left of an error by extrapolating it from dt and dt/2, over the error: 1 % in most responses here."""

TIMES = (0.1, 0.2, 0.3, 0.45)
"""[s]: a response of the double pole at -10/s is at 74, 41, 20 and 6 per cent of its start then."""

SMOOTH = [
    *(law for law in LAWS.values() if law.representation is None and not law.regulator.in_engine),
    LAWS["feedback-linearized/zyx-euler"],
]
"""Laws whose response from these starts is smooth."""

# Arms and Jacobians take turns. `test_arm_engines` has every law on every arm.
CASES = [
    pytest.param(arm, law, by, id=f"{arm}-{law.name}-{by}")
    for k, law in enumerate(law for law in SMOOTH if law.regulator.property != "none")
    for by in (("geometric", "analytic") if law.coordinate_law_in else ("geometric",))
    for arm in (ARMS[k % len(ARMS)],)
]


@functools.cache
def starts(arm: str) -> tuple:
    return tuple(tasks.start_set("clear", 4, arm=arm))


def on_body(arm: str, law, engine: str, dt: float, at: float) -> np.ndarray:
    """Rows of the free body at that time."""
    return run(engine, law, "free-body", starts(arm), settings(dt_s=dt, horizon_s=at), METRICS)


def angles_on_body(arm: str, law, engine: str, dt: float, ticks: int = 0) -> np.ndarray:
    """A row a time, so many ticks later; a column a start."""
    return np.array([on_body(arm, law, engine, dt, at + ticks * dt)[:, FINAL_ANGLE] for at in TIMES])


def on_arm(arm: str, one, dt: float, at: float) -> np.ndarray:
    """Rows of the arm at that time, by motors without a limit: the Jaco's are too weak for some of its turns."""
    chosen = settings(dt_s=dt, horizon_s=at, torque_limit=math.inf)
    return run_arm("native", one, "arm-regulation", arm, starts(arm), chosen, ARM_METRICS)


@pytest.mark.parametrize(("arm", "law", "by"), CASES)
def test_arm_turns_as_the_free_body_does_to_the_integration_error(arm, law, by):
    one, exact = named(arm, f"{law.name}@{by}+standard"), angles_on_body(arm, law, "ideal-rk4", DT)
    apart, errors = [], []
    for dt in (DT, DT / 2.0):
        tool = np.array([on_arm(arm, one, dt, at)[:, FINAL_ANGLE] for at in TIMES])
        before, body, after = (angles_on_body(arm, law, "native", dt, k) for k in (-1, 0, 1))
        tick = np.abs(after - before).max(axis=0) / 2.0
        assert (np.abs(tool - body).max(axis=0) <= TICKS * tick).all()
        apart.append(np.abs(tool - body).max())
        errors.append(tool - exact)
    assert 0.45 < apart[1] / apart[0] < 0.55  # half the dt, half the difference
    left = np.abs(2.0 * errors[1] - errors[0]).max()  # and extrapolated to dt = 0 both are the ideal plant's
    assert left <= SECOND_ORDER * np.abs(errors[0]).max()
    settled, settled_there = (
        rows[:, SETTLING_TICK] for rows in (on_arm(arm, one, DT, LONG), on_body(arm, law, "native", DT, LONG))
    )
    assert (np.abs(settled - settled_there) <= SETTLING_TICKS).all()
