"""What an arm is, and the judge's MJCF model of one."""

from __future__ import annotations

import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import NamedTuple

from tasks.errors import UnknownName
from tasks.sensors import sensor_xml

# The same light and white sky for every arm, and the base axes; the arm's file has the camera "view".
LOOK = Path(__file__).with_name("look.xml").read_text(encoding="utf-8")


class Arm(NamedTuple):
    """A manipulator with torque motors; joints in order from the base, SI units and radians."""

    name: str  # of the file, with dashes: "ur5e"
    title: str
    source: str
    xml: str  # the complete MJCF text, as its file has it
    home: tuple[float, ...]  # the keyframe "home"
    lower: tuple[float, ...]  # ends of the joint ranges, -inf and inf where there are none
    upper: tuple[float, ...]
    rated: tuple[float, ...]  # rated torque [N m], at which motors are cut but in the variation ideal-motors
    poses: tuple[tuple[str, tuple[float, ...]], ...] = ()  # every keyframe: (name, joint angles)
    motors: tuple[float, ...] = ()  # least, usual and greatest motor inertia [kg m^2]; none: it is known, and in xml
    torque_rate: tuple[float, ...] = ()  # greatest change of a torque [N m/s]; none: its maker states none
    gains: tuple[float, ...] = ()  # kp [1/s^2] and damping ratio of a controller that is shipped for it; none: unknown

    @property
    def joints(self) -> int:
        """Number of joints."""
        return len(self.home)

    def pose(self, name: str) -> tuple[float, ...]:
        """Joint angles of a keyframe."""
        known = dict(self.poses)
        if name not in known:
            raise UnknownName(
                f"arm '{self.name}' has no keyframe '{name}'; known: {', '.join(known)} (use one, or add a <key>)"
            )
        return known[name]


def model_xml(arm: Arm, dt: float) -> str:
    """Return the judge's MJCF model of an arm with integration step dt [s].

    Gravity as on Earth; no contacts, joint limits or automatic reset. Sensors of the site "tool": those of
    tasks.sensors.SENSORS, then its position p [m].
    """
    root = ElementTree.fromstring(arm.xml)
    # Later options override those of the file, and its sensors (arm_check.py allows none) would come first.
    option = ElementTree.SubElement(root, "option", timestep=repr(dt), gravity="0 0 -9.81")
    ElementTree.SubElement(option, "flag", contact="disable", limit="disable", autoreset="disable", gravity="enable")
    sensors = ElementTree.fromstring(sensor_xml("tool"))
    ElementTree.SubElement(sensors, "framepos", name="p", objtype="site", objname="tool")
    root.extend([*ElementTree.fromstring(LOOK), sensors])
    return ElementTree.tostring(root, encoding="unicode")
