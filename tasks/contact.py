"""Tasks in contact: a hand with a force sensor at an arm's wrist, something for it to touch, and what it is told to do.

    D(q) qddot + fg(q, qdot) = tau + J^T F,   F = (f, m): what the surroundings do to the hand

A task's file says what the hand and its surroundings are, and lists its trials. The hand has no mass, so that the
sensor in its wrist reads F and nothing else, and the controller's model of the arm stays perfect. Its frame, the site
"hand", is what is controlled, and where F is taken.

How the hand's frame is drawn on the hand changes nothing physical; it changes every Euler angle. A trial's
`mount_wxyz` draws it.

An arm takes part if it has six joints and a site "wrist" that moves with the last one.
"""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, NamedTuple

from tasks.arm_model import LOOK, Arm
from tasks.base import AT_REST, IDENTITY, BadValue, Quat, Vector, sensor_xml

if TYPE_CHECKING:
    import mujoco

AXES = ("x", "y", "z", "about x", "about y", "about z")

# mujoco.mjtSameFrame.mjSAMEFRAME_NONE; importing MuJoCo takes a moment, and listing names must not.
OWN_FRAME = 0

# Pushes that may follow each other in a trial: the size of a buffer.
MOST_LEGS = 8


class Order(NamedTuple):
    """What a controller is told; along and about the axes of the base frame.

    held: of x, y, z and the turns about x, y, z, 1 if it is held at its place and 0 if it complies.
    exerts: the force [N] and moment [N m] that the hand shall exert where it complies; 0 where it is held.
    velocity: of the place at which the hand is held [m/s]; where it complies only an impedance's springs heed it.
    """

    name: str  # what complies, in words for a table: "z, about x and y"
    held: tuple[int, int, int, int, int, int]
    exerts: tuple[float, ...] = (0.0,) * 6
    velocity: Vector = AT_REST


class Trial(NamedTuple):
    """One episode: where it begins, what surrounds the hand, and the order.

    id: unique within its task and arm. pose: what a row of the results is about; trials that share it are measured
    together. goal_wxyz: the orientation to hold, hand to base. mount_wxyz: the hand's frame as the wrist's sees it.
    scene_pos, scene_wxyz: where the body "scene" of the surroundings stands, base frame.
    push: force [N] at the wrist and moment [N m] from outside, base frame, from the first tick on.
    tilt: angle [rad] by which the surroundings differ from what the order supposes.
    legs: instead of one push, several that follow each other, each for an equal part of the episode.
    """

    id: str
    pose: str
    order: Order
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
        """What acts from outside, one after the other for equal times; at most MOST_LEGS."""
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

    trials(arm): all of them, the same for the same arm. dense(arm): those of the suite `full`; the same if None.
    """

    name: str
    title: str
    source: str
    horizon_s: float
    surroundings: Callable[[Arm], Surroundings]
    trials: Callable[[Arm], tuple[Trial, ...]]
    dense: Callable[[Arm], tuple[Trial, ...]] | None = None


class ContactModel(NamedTuple):
    """MuJoCo's model of a contact, with elliptic friction cones; what is welded to the hand is as soft.

    The constants are stable at a control period of 1 ms.

    timeconst [s], dampratio: of solref. Ten periods, critically damped: what strikes at 5 cm/s goes 0.2 mm deep.
    dmin, dmax, width [m]: of solimp. Constant, so that at rest force and depth are in proportion. What
    controllers cancel is the force of the tick before, and this share of the mistake returns in the next tick's force.
    friction: its coefficient; machined steel.
    slip [s]: time constant in which friction ends a slip it can hold. MuJoCo's convex friction pushes what slips at a
    speed v off a surface with the acceleration 2 friction v/(dmax slip); with a time constant as short as that of the
    normal force a tip that slides at 5 cm/s under 15 N would be thrown off and hop.
    impratio: how much harder friction is than the normal force. At 1 a jammed peg creeps on into its hole; at 100 peg
    and hole blow rounding errors up to micrometres.
    """

    timeconst: float = 0.01
    dampratio: float = 1.0
    dmin: float = 0.8
    dmax: float = 0.8
    width: float = 0.001
    friction: float = 0.2
    slip: float = 0.1
    impratio: float = 10.0


STANDARD = ContactModel()


def model_xml(task: ContactTask, arm: Arm, dt: float, contact: ContactModel = STANDARD) -> str:
    """The judge's MJCF model of a task on an arm, with integration step dt [s].

    Sensors of the site "hand": those of tasks.base.SENSORS, its position p [m], then force [N] and moment [N m] in the
    hand's frame as MuJoCo gives them, if anything can touch the gap at the deepest contact [m] (at most 0, and 0 where
    there is no contact), and the joint of the scene [rad] if there is one.

    Errors:
        BadValue: the arm has no six joints, or no site "wrist".
    """
    refuse(task, arm)
    around = task.surroundings(arm)
    root = ElementTree.fromstring(arm.xml)
    option = ElementTree.SubElement(root, "option", timestep=repr(dt), gravity="0 0 -9.81", cone="elliptic")
    option.set("impratio", repr(contact.impratio))
    ElementTree.SubElement(option, "flag", contact="enable", limit="disable", autoreset="disable", gravity="enable")
    link, wrist = _wrist(root)
    for axis in link.findall("geom[@class='axis']"):
        link.remove(axis)  # the arms draw their tool's frame, which would stick out of the hand
    place = {key: wrist.attrib[key] for key in ("pos", "quat", "euler") if key in wrist.attrib}
    hand = ElementTree.SubElement(link, "body", name="hand", **place)
    ElementTree.SubElement(hand, "site", name="hand", pos=_numbers(around.tip), size=".002")
    hand.extend(_elements(around.hand))
    world = root.find("worldbody")
    assert world is not None
    scene = ElementTree.SubElement(world, "body", name="scene", mocap="true", pos="0 0 -10")  # until a trial places it
    scene.extend(_elements(around.scene))
    pairs = _pairs(hand, scene, contact)
    root.extend([*_elements(around.others), pairs, *ElementTree.fromstring(LOOK), _sensors(around, len(pairs) > 0)])
    for geom in root.iter("geom"):
        geom.attrib.update(contype="0", conaffinity="0")  # pairs are what touches
    for weld in root.iter("weld"):
        weld.attrib.update(_softness(contact))
    return ElementTree.tostring(root, encoding="unicode")


def refuse(task: ContactTask, arm: Arm) -> None:
    """BadValue if the arm cannot be set the task."""
    if arm.joints != 6:
        raise BadValue(
            f"task '{task.name}' needs an arm of six joints, and '{arm.name}' has {arm.joints} "
            "(choose another: what a seventh does by itself would be measured too)"
        )
    if _wrist(ElementTree.fromstring(arm.xml)) is None:
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
    model.site_sameframe[hand] = OWN_FRAME  # else MuJoCo takes the frame it compiled
    data.mocap_pos[0] = trial.scene_pos
    data.mocap_quat[0] = trial.scene_wxyz
    data.xfrc_applied[model.body("hand").id] = trial.pushes[0]


def _wrist(root: ElementTree.Element) -> Any:
    """(the body, the site "wrist" in it), or None."""
    return next(((body, site) for body in root.iter("body") for site in body.findall("site[@name='wrist']")), None)


def _elements(xml: str) -> list[ElementTree.Element]:
    return list(ElementTree.fromstring(f"<some>{xml}</some>"))


def _pairs(hand: ElementTree.Element, scene: ElementTree.Element, contact: ContactModel) -> ElementTree.Element:
    pairs = ElementTree.Element("contact")
    for one in hand.findall(".//geom[@name]"):
        for other in scene.findall(".//geom[@name]"):
            ElementTree.SubElement(
                pairs,
                "pair",
                geom1=one.attrib["name"],
                geom2=other.attrib["name"],
                condim="3",
                friction=f"{contact.friction!r} {contact.friction!r} 0 0 0",
                solreffriction=f"{contact.slip!r} 1",
            ).attrib.update(_softness(contact))
    return pairs


def _softness(contact: ContactModel) -> dict[str, str]:
    return {
        "solref": f"{contact.timeconst!r} {contact.dampratio!r}",
        "solimp": f"{contact.dmin!r} {contact.dmax!r} {contact.width!r}",
    }


def _sensors(around: Surroundings, touches: bool) -> ElementTree.Element:
    sensors = ElementTree.fromstring(sensor_xml("hand"))
    ElementTree.SubElement(sensors, "framepos", name="p", objtype="site", objname="hand")
    ElementTree.SubElement(sensors, "force", name="force", site="hand")
    ElementTree.SubElement(sensors, "torque", name="moment", site="hand")
    if touches:
        # of what collision found anyway; the distance sensor looks at every pair of geoms, which costs more than a step
        ElementTree.SubElement(
            sensors, "contact", name="gap", body1="hand", body2="scene", data="dist", reduce="mindist", num="1"
        )
    if around.joint:
        ElementTree.SubElement(sensors, "jointpos", name="turned", joint=around.joint)
    return sensors


def _numbers(values: Vector) -> str:
    return " ".join(map(repr, values))
