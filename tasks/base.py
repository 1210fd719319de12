"""Define starts, start sets and tasks of both kinds."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

from tasks.errors import BadValue
from tasks.truth import angle as angle
from tasks.truth import haversine as haversine

if TYPE_CHECKING:
    from tasks.arm_model import Arm

Quat = tuple[float, float, float, float]
Vector = tuple[float, float, float]
State = tuple[tuple[float, ...], tuple[float, ...]]

IDENTITY: Quat = (1.0, 0.0, 0.0, 0.0)
AT_REST: Vector = (0.0, 0.0, 0.0)


class Start(NamedTuple):
    """The state in which an episode begins and its goal.

    On an arm q and qdot are the state, and quat_wxyz and omega are the tool's, by MuJoCo's forward kinematics.
    """

    id: str  # unique within its set, stable and readable: "half-turn-x-k06"
    quat_wxyz: Quat  # unit quaternion, body to base
    omega: Vector = AT_REST  # angular velocity, base frame [rad/s]
    goal_wxyz: Quat = IDENTITY  # desired orientation: unit quaternion, desired body to base
    q: tuple[float, ...] = ()  # joint angles [rad]
    qdot: tuple[float, ...] = ()  # joint rates [rad/s]
    goal_p: tuple[float, ...] = ()  # goal position of the tool [m]; empty: where it starts
    goal_q: tuple[float, ...] = ()  # joint angles at which it is at its goal [rad]; empty: none that the set knows


class StartSet(NamedTuple):
    """A named family of starts: the constant STARTS of every tasks/starts/<name>.py, which gives one of two functions.

    fixed(seed): all starts of a fixed set. between(first, end, seed): those starts alone of a sampled set, which has
    any number, without those before.
    """

    name: str
    title: str
    size: int  # number of starts by default; a fixed set has no more
    fixed: Callable[[int], list[Start]] | None = None
    between: Callable[[int, int, int], list[Start]] | None = None

    def build(self, count: int, seed: int) -> list[Start]:
        """Return the first starts; of a fixed set all."""
        return self.between(0, count, seed) if self.between else self.fixed(seed) if self.fixed else []


class ArmStartSet(NamedTuple):
    """A named family of starts that any arm has: the constant STARTS of every tasks/arm_starts/<name>.py."""

    name: str
    title: str
    size: int  # number of starts by default; an arm that cannot do so many has fewer
    build: Callable[[Arm, int, int], list[Start]]  # build(arm, count, seed); may return more than count
    knows_joints: bool = False  # whether its starts have a goal_q


class Task(NamedTuple):
    """A plant whose orientation is to be regulated: the constant TASK of a tasks/domains/<name>.py.

    Its model carries the sensors of tasks/sensors.py in this order, so that sensordata[0:12] is what a contestant may
    see and sensordata[12:16] is the judge's ground truth.
    """

    name: str  # of the file, with dashes: "free-body"
    title: str
    source: str
    xml: Callable[[float], str]  # xml(dt): the MJCF text with integration step dt [s]
    state: Callable[[Start], State]  # (qpos, qvel) in MuJoCo's own conventions
    start_sets: tuple[str, ...]  # the sets that make sense for it
    arm: str = ""  # name of the arm; empty on the free body
    servo_xml: Callable[[float, float, float], str] | None = None  # servo_xml(dt, kp, kv): see `with_servo`

    def with_servo(self, kp: float, kv: float) -> Task:
        """Return this plant driven by MuJoCo's own <orientation> actuator with gains kp [N m/rad], kv [N m s/rad].

        Its ctrl is the goal, a quaternion wxyz.
        """
        servo_xml = self.servo_xml
        if servo_xml is None:
            raise BadValue(f"task '{self.name}' has no model with an <orientation> actuator (try: free-body)")
        return self._replace(xml=lambda dt: servo_xml(dt, kp, kv))


class ArmTask(NamedTuple):
    """A task that every arm can be set: the constant TASK of a tasks/domains/<name>.py instead."""

    name: str
    title: str
    source: str
    on: Callable[[Arm], Task]  # the task on one arm, always the same Task for the same Arm
    start_sets: tuple[str, ...]  # of tasks/arm_starts
