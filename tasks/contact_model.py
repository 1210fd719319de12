"""MuJoCo's model of a hand in contact: the arm, the hand, what surrounds it, and how soft contacts are."""

from __future__ import annotations

import functools
import itertools
import xml.etree.ElementTree as ElementTree
from typing import NamedTuple

from tasks.arm_model import LOOK, Arm
from tasks.contact import ContactTask, Surroundings, attribute, refuse, wrist_of
from tasks.sensors import sensor_xml


class ContactModel(NamedTuple):
    """MuJoCo's model of a contact, with elliptic friction cones; what is welded to the hand is as soft.

    The constants are stable at a control period of 1 ms.

    stiffness [N/m], damping [N s/m]: of each point that touches, the same on every arm: a force-controlled hand and a
    steel plate, with 20 ms between force and damped force. At rest force = stiffness * depth where dmin = dmax.
    dmin, dmax, width [m]: of solimp. Constant, so that at rest force and depth are in proportion. While it touches, a
    point resists acceleration too, like a mass dmax/((1 - dmax) A), A the hand's mobility (`softness`). What
    controllers cancel is the force of the tick before, and this share of the mistake returns in the next tick's force.
    friction: its coefficient; machined steel.
    slip [s]: time constant in which friction ends a slip it can hold. MuJoCo's convex friction pushes what slips at a
    speed v off a surface with the acceleration 2 friction v/(dmax slip); with a time constant as short as that of the
    normal force a tip that slides at 5 cm/s under 15 N would be thrown off and hop.
    impratio: how much harder friction is than the normal force.
    noslip: iterations of MuJoCo's second solver, which makes friction dry. Without it friction is a damper below its
    bound, and a jammed peg creeps on into its hole at 0.1 to 0.9 mm/s, at any impratio.
    """

    stiffness: float = 2e5
    damping: float = 4e3
    dmin: float = 0.8
    dmax: float = 0.8
    width: float = 0.001
    friction: float = 0.2
    slip: float = 0.1
    impratio: float = 10.0
    noslip: int = 5


STANDARD = ContactModel()


def softness(contact: ContactModel, mobility: float) -> dict[str, str]:
    """solref and solimp of a contact, or weld, of this stiffness and damping.

    MuJoCo's constraint force is (aref - a)/R with R = (1 - d)/d A and, of a negative solref, aref = -(b/dmax) v -
    (k d/dmax^2) r: at d = dmax the stiffness is k/((1 - d) A). A is MuJoCo's estimate of an arm's mobility, so that the
    same solref is another stiffness on another arm; here it is divided out. mobility: A [1/kg], the sum of both bodies'
    body_invweight0. Source: MuJoCo's documentation, "Computation: constraint model", "Modeling: solver parameters".
    """
    scale = -(1.0 - contact.dmax) * mobility
    return {
        "solref": f"{scale * contact.stiffness!r} {scale * contact.damping!r}",
        "solimp": f"{contact.dmin!r} {contact.dmax!r} {contact.width!r}",
    }


def model_xml(task: ContactTask, arm: Arm, dt: float, contact: ContactModel = STANDARD) -> str:
    """Return the judge's MJCF model of a task on an arm that can be set it, with integration step dt [s].

    Sensors of the site "hand": those of tasks.sensors.SENSORS, its position p [m], then force [N] and moment [N m] in
    the hand's frame as MuJoCo gives them, if anything can touch the gap at the deepest contact [m] (at most 0, and 0
    where there is no contact), and the joint of the scene [rad] if there is one.
    """
    refuse(task, arm)
    root = _model(task, arm, dt, contact)
    mobile = mobilities(task, arm)
    for pair in root.iter("pair"):
        pair.attrib.update(softness(contact, mobile["hand"]))  # the scene stands still
    for weld in root.iter("weld"):
        weld.attrib.update(softness(contact, mobile[weld.attrib["body1"]] + mobile[weld.attrib["body2"]]))
    return ElementTree.tostring(root, encoding="unicode")


@functools.lru_cache(maxsize=64)
def mobilities(task: ContactTask, arm: Arm) -> dict[str, float]:
    """body_invweight0 [1/kg] of translation, by body: the mean over directions of J D^-1 J^T at the joints' zero."""
    import mujoco  # takes a moment, and listing names must not

    model = mujoco.MjModel.from_xml_string(ElementTree.tostring(_model(task, arm, 1e-3, STANDARD), encoding="unicode"))
    return {model.body(i).name: float(model.body_invweight0[i, 0]) for i in range(model.nbody)}


def _model(task: ContactTask, arm: Arm, dt: float, contact: ContactModel) -> ElementTree.Element:
    """Return the model, its contacts as soft as MuJoCo's own."""
    around = task.surroundings(arm)
    root = ElementTree.fromstring(arm.xml)
    option = ElementTree.SubElement(root, "option", timestep=repr(dt), gravity="0 0 -9.81", cone="elliptic")
    option.set("impratio", repr(contact.impratio))
    option.set("noslip_iterations", repr(contact.noslip))
    ElementTree.SubElement(option, "flag", contact="enable", limit="disable", autoreset="disable", gravity="enable")
    link, wrist = wrist_of(root)
    for axis in link.findall("geom[@class='axis']"):
        link.remove(axis)  # the arms draw their tool's frame, which would stick out of the hand
    place = {key: wrist.attrib[key] for key in ("pos", "quat", "euler") if key in wrist.attrib}
    hand = ElementTree.SubElement(link, "body", name="hand", **place)
    ElementTree.SubElement(hand, "site", name="hand", pos=attribute(around.tip), size=".002")
    hand.extend(_elements(around.hand))
    world = root.find("worldbody")
    assert world is not None
    scene = ElementTree.SubElement(world, "body", name="scene", mocap="true", pos="0 0 -10")  # until a trial places it
    scene.extend(_elements(around.scene))
    pairs = ElementTree.Element("contact")
    friction = {"friction": f"{contact.friction!r} {contact.friction!r} 0 0 0", "solreffriction": f"{contact.slip!r} 1"}
    for one, other in itertools.product(hand.findall(".//geom[@name]"), scene.findall(".//geom[@name]")):
        names = {"geom1": one.attrib["name"], "geom2": other.attrib["name"]}
        ElementTree.SubElement(pairs, "pair", names, condim="3", **friction)
    root.extend([*_elements(around.others), pairs, *ElementTree.fromstring(LOOK), _sensors(around, len(pairs) > 0)])
    for geom in root.iter("geom"):
        geom.attrib.update(contype="0", conaffinity="0")  # pairs are what touches
    return root


def _elements(xml: str) -> list[ElementTree.Element]:
    return list(ElementTree.fromstring(f"<some>{xml}</some>"))


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
