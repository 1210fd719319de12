"""Tasks in contact: a hand with a force sensor at an arm's wrist, something for it to touch, and its commanded motion.

    D(q) qddot + fg(q, qdot) = tau + J^T F,   F = (f, m): what the surroundings do to the hand

A task's file says what the hand and its surroundings are, and lists its trials. The hand has no mass, so that the
sensor in its wrist reads F and nothing else, and the controller's model of the arm stays perfect. Its frame, the site
"hand", is what is controlled, and where F is taken. How it is drawn on the hand (`Trial.mount_wxyz`) changes nothing
physical; it changes every Euler angle.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from tasks.arm_model import Arm
from tasks.base import AT_REST, IDENTITY, Quat, Vector
from tasks.errors import BadValue

if TYPE_CHECKING:
    import mujoco

AXES = ("x", "y", "z", "about x", "about y", "about z")

# Pushes that may follow each other in a trial: the size of a buffer.
MOST_LEGS = 8


class Specification(NamedTuple):
    """Commands of a controller, along and about the axes of the base frame (Mason 1981; Raibert and Craig 1981).

    selection: of x, y, z and the turns about x, y, z, 1 if it is held at its place and 0 if it complies.
    desired_wrench: the force [N] and moment [N m] that the hand is to exert where it complies; 0 where it is held.
    velocity: of the place at which the hand is held [m/s]; where it complies only an impedance's springs heed it.
    moves_s: until when it moves [s]; then it stands.
    """

    name: str  # what complies, in words for a table: "z, about x and y"
    selection: tuple[int, int, int, int, int, int]
    desired_wrench: tuple[float, ...] = (0.0,) * 6
    velocity: Vector = AT_REST
    moves_s: float = math.inf


class Trial(NamedTuple):
    """One episode: where it begins, what surrounds the hand, and the specification.

    id: unique within its task and arm. pose: what a row of the results is about; trials that share it are measured
    together. goal_wxyz: the orientation to hold, hand to base. mount_wxyz: the hand's frame as the wrist's sees it.
    scene_pos, scene_wxyz: where the body "scene" of the surroundings stands, base frame.
    push: force [N] at the wrist and moment [N m] from outside, base frame, from the first tick on.
    tilt: angle [rad] by which the surroundings differ from what the specification supposes.
    legs: instead of one push, several that follow each other, each for an equal part of the episode.
    """

    id: str
    pose: str
    specification: Specification
    q: tuple[float, ...]
    goal_wxyz: Quat
    mount_wxyz: Quat = IDENTITY
    scene_pos: Vector = AT_REST
    scene_wxyz: Quat = IDENTITY
    push: tuple[float, ...] = (0.0,) * 6
    tilt: float = 0.0
    legs: tuple[tuple[float, ...], ...] = ()

    @property
    def pushes(self) -> tuple[tuple[float, ...], ...]:
        """Return what acts from outside, one after the other for equal times."""
        return self.legs or (self.push,)


class Surroundings(NamedTuple):
    """MJCF of one task on one arm; each geom of the hand that has a name touches each geom of the scene that has one.

    Geoms without a name are for looks, and nothing else touches anything.

    hand: geoms in the wrist's frame, z out of the wrist. tip: where the hand's frame is, in the same frame [m].
    scene: what stands in the body "scene". others: elements of <mujoco> besides (equalities, ...).
    joint: a joint of the scene whose angle is recorded; empty for none.
    """

    hand: str
    tip: Vector
    scene: str = ""
    others: str = ""
    joint: str = ""


class ContactTask(NamedTuple):
    """A task in contact: the constant TASK of a tasks/domains/<name>.py.

    trials(arm, dense): all of them, the same for the same arm; dense: those of the suite `full`.
    rests: whether an episode has an end, and is over once the hand is at rest (contact_rest.py).
    """

    name: str
    title: str
    source: str
    horizon_s: float
    surroundings: Callable[[Arm], Surroundings]
    trials: Callable[..., tuple[Trial, ...]]
    rests: bool = False

    def touches(self, arm: Arm) -> bool:
        """Whether there is something for the hand to touch."""
        around = self.surroundings(arm)
        return bool(around.scene or around.others)


def can_do(task: ContactTask, arm: Arm) -> bool:
    """Tell whether the arm can be set the task: it has a site "wrist"."""
    return wrist_of(ElementTree.fromstring(arm.xml)) is not None


def refuse(task: ContactTask, arm: Arm) -> None:
    """Raise BadValue if the arm cannot be set the task."""
    if not can_do(task, arm):
        raise BadValue(
            f"arm '{arm.name}' has no site 'wrist', where task '{task.name}' mounts the hand and its force sensor "
            '(add <site name="wrist"/> to the last body of its file)'
        )


def leg(count: int, tick: int, ticks: int) -> int:
    """Which of so many pushes acts at a tick of an episode of so many ticks."""
    return tick * count // ticks


def prepare(model: mujoco.MjModel, data: Any, trial: Trial) -> None:
    """Put a model and its data, freshly reset, into the state in which a trial begins; a forward pass must follow."""
    n = len(trial.q)
    data.qpos[:n] = trial.q
    hand = model.site("hand").id
    model.site_quat[hand] = trial.mount_wxyz
    model.site_sameframe[hand] = 0  # mjSAMEFRAME_NONE; else MuJoCo takes the frame it compiled
    data.mocap_pos[0] = trial.scene_pos
    data.mocap_quat[0] = trial.scene_wxyz
    data.xfrc_applied[model.body("hand").id] = trial.pushes[0]


def attribute(numbers: Iterable[float]) -> str:
    """Numbers as an attribute of MJCF, to the last digit."""
    return " ".join(map(repr, numbers))


def wrist_of(root: ElementTree.Element) -> Any:
    """Return (the body, the site "wrist" in it), or None."""
    return next(((body, site) for body in root.iter("body") for site in body.findall("site[@name='wrist']")), None)
