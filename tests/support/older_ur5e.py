"""The UR5e as MuJoCo Menagerie has it, with the older UR5's masses: what referees measured before ours was mended."""

import xml.etree.ElementTree as ElementTree

import tasks
from tasks.arm_model import Arm

BODIES = {
    "shoulder": ("0 0 .163", {"pos": "0 0 0", "mass": "3.7", "diaginertia": ".0102675 .0102675 .00666"}),
    "upper arm": ("0 .138 0", {"pos": "0 0 .2125", "mass": "8.393", "diaginertia": ".133886 .133886 .0151074"}),
    "forearm": ("0 -.131 .425", {"pos": "0 0 .196", "mass": "2.275", "diaginertia": ".0311796 .0311796 .004095"}),
    "wrist 1": ("0 0 .392", {"pos": "0 .127 0", "mass": "1.219", "diaginertia": ".0025599 .0025599 .0021942"}),
    "wrist 2": ("0 .127 0", {"pos": "0 0 .1", "mass": "1.219", "diaginertia": ".0025599 .0025599 .0021942"}),
    "wrist 3": (
        "0 0 .1",
        {
            "pos": "0 .0771683 0",
            "quat": "1 0 0 1",
            "mass": ".1889",
            "diaginertia": ".000132134 9.90863e-05 9.90863e-05",
        },
    ),
}


def older_ur5e() -> Arm:
    """The arm with those inertias, and lengths in whole millimetres."""
    ours = tasks.arm("ur5e")
    root = ElementTree.fromstring(ours.xml)
    for body in root.iter("body"):
        if body.get("name") == "tool":
            body.set("pos", "0 .1 0")
        else:
            place, inertial = BODIES[str(body.get("name"))]
            body.set("pos", place)
            element = body.find("inertial")
            assert element is not None
            element.attrib.clear()
            element.attrib.update(inertial)
    return ours._replace(xml=ElementTree.tostring(root, encoding="unicode"))
