"""Murphy's rotational system: a body whose angular acceleration is commanded (Murphy 1988, 2.6 and 2.7).

    omegadot = u,   Rdot = [omega]x R,   all in the base frame

A ball joint about the centre of mass, inertia I = 1 kg m^2 times the identity, no gravity and no contact.
With such an inertia omega x I omega vanishes, and three motors along the base axes (`jointinparent`) make the
command the angular acceleration. Under MuJoCo's Euler integrator one tick is

    omega' = omega + dt u,   R' = exp(dt [omega']x) R

Its RK4 averages rates of the body frame over a tick and is of second order here, not fourth (one tick errs by
about dt^3 |omega|^2 |u| / 12), unless the axis stays fixed.
"""

from __future__ import annotations

from pathlib import Path

from tasks.base import Start, Task
from tasks.rotations import to_body
from tasks.sensors import sensor_xml

MOTORS = """<motor name="u_x" jointinparent="ball" gear="1 0 0 0 0 0"/>
    <motor name="u_y" jointinparent="ball" gear="0 1 0 0 0 0"/>
    <motor name="u_z" jointinparent="ball" gear="0 0 1 0 0 0"/>"""


def xml(dt: float) -> str:
    """Return the MJCF model with integration step dt [s]; ctrl is u in the base frame [rad/s^2]."""
    return _xml(dt, MOTORS)


def servo_xml(dt: float, kp: float, kv: float) -> str:
    """Return the body's XML with MuJoCo's <orientation> actuator on the ball joint instead of motors.

    ctrl is the goal, a quaternion wxyz of any length; the torque is kp log(R^T R_d) - kv R^T omega in the body frame.
    """
    return _xml(dt, f'<orientation name="goal" joint="ball" input="quat" kp="{kp!r}" kv="{kv!r}"/>')


def _xml(dt: float, actuators: str) -> str:
    """Return the model with these elements in <actuator>.

    The motors' ctrlrange [rad/s^2] is for agents to draw from, and cuts nothing: commands of the paper's gains stay
    within it (944, tasks/rules.py).
    """
    text = Path(__file__).with_suffix(".xml").read_text(encoding="utf-8")
    for word, value in {"TIMESTEP": repr(dt), "ACTUATORS": actuators, "SENSORS": sensor_xml("tool")}.items():
        text = text.replace(word, value)
    return text


def state(start: Start) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the state of the ball joint: qpos = quat_wxyz, and qvel = R^T omega, in the body frame."""
    return start.quat_wxyz, to_body(start.quat_wxyz, start.omega)


TASK = Task(
    name="free-body",
    title="Rotational system of the paper",
    source="Murphy 1988, equations 2.6 and 2.7",
    xml=xml,
    state=state,
    start_sets=("paper", "uniform", "half-turn", "poles", "wraps", "box", "tumbling", "goals"),
    servo_xml=servo_xml,
)
