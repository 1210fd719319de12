"""Arms: the manipulators of tasks/arms, found, checked and made into the judge's model.

    <name>.xml     MJCF, all in this one text (no meshes, no includes)
    <name>.py      a function xml() -> str that writes it

An arm is six or seven hinges in one chain with a site "tool", a keyframe "home", one motor a joint whose ctrlrange
is the rated torque, and texts "title" and "source". Nothing else may act on it (viscous damping may), so that

    D qddot = tau - fg,   fg = qfrc_bias - qfrc_passive

is exact: the controller's model is perfect. `arm_check.py` holds a file to this. A folder is read at the time of the
call, and what was made of a text is kept by the text, not by the name.
"""

from __future__ import annotations

import re
import types
import xml.etree.ElementTree as ElementTree
from functools import lru_cache
from pathlib import Path
from typing import NamedTuple

from tasks.base import BadArm, UnknownName, sensor_xml

ARMS = Path(__file__).parent / "arms"
WORD = re.compile(r"[a-z][a-z0-9]*(-[a-z0-9]+)*")

# The same light and white sky for every arm, and the base axes; the arm's file has the camera "view".
LOOK = """<mujoco>
  <visual>
    <global offwidth="1600" offheight="1200"/>
    <rgba haze="1 1 1 1"/>
    <headlight ambient=".35 .35 .35" diffuse=".45 .45 .45" specular=".1 .1 .1"/>
  </visual>
  <asset>
    <texture type="skybox" builtin="flat" rgb1="1 1 1" rgb2="1 1 1" width="8" height="8"/>
  </asset>
  <worldbody>
    <light directional="true" pos="1 -1 2" dir="-.4 .4 -.8" diffuse=".7 .7 .7" castshadow="false"/>
    <geom type="capsule" size=".004" mass="0" fromto="0 0 0 .4 0 0" rgba=".8 .25 .2 .5"/>
    <geom type="capsule" size=".004" mass="0" fromto="0 0 0 0 .4 0" rgba=".2 .6 .25 .5"/>
    <geom type="capsule" size=".004" mass="0" fromto="0 0 0 0 0 .4" rgba=".2 .35 .85 .5"/>
  </worldbody>
</mujoco>"""


class Arm(NamedTuple):
    """A manipulator with torque motors; joints in order from the base, SI units and radians."""

    name: str  # of the file, with dashes: "ur5e"
    title: str
    source: str
    xml: str  # the complete MJCF text, as its file has it
    home: tuple[float, ...]  # the keyframe "home"
    lower: tuple[float, ...]  # ends of the joint ranges, -inf and inf where there are none
    upper: tuple[float, ...]
    rated: tuple[float, ...]  # rated torque [N m]: a rule's business, the plant never clips
    poses: tuple[tuple[str, tuple[float, ...]], ...] = ()  # every keyframe: (name, joint angles)

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


def arm_names(folder: Path = ARMS) -> list[str]:
    """Names of all arms, sorted: of the files as they lie there, unread, so a broken one is among them."""
    return sorted(_files(folder))


def arm(name: str, folder: Path = ARMS) -> Arm:
    """The arm of this name, checked.

    Errors:
        UnknownName: there is no such file.
        BadArm: the file is not an arm; what is wrong, and the cure.
    """
    files = _files(folder)
    if name not in files:
        raise UnknownName(
            f"arm '{name}' is not in tasks/arms; known: {', '.join(sorted(files))} (use one, or add a file there)"
        )
    if len(files[name]) > 1:
        raise BadArm(f"arm '{name}' has several files, {_listed(files[name])} (keep one)")
    if not WORD.fullmatch(name):
        raise BadArm(f"arm '{name}': its file name is no word of a-z, 0-9 and _ (rename it, as in my_arm.xml)")
    path = files[name][0]
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise BadArm(f"arm '{name}': {path.name} cannot be read ({error}) (save it as UTF-8 text)") from error
    return _checked(name, _xml_of(name, path.name, text) if path.suffix == ".py" else text)


def arms(folder: Path = ARMS) -> dict[str, Arm | BadArm]:
    """Every arm by name; of a broken file its refusal."""
    found: dict[str, Arm | BadArm] = {}
    for name in arm_names(folder):
        try:
            found[name] = arm(name, folder)
        except BadArm as refusal:
            found[name] = refusal
    return found


def model_xml(arm: Arm, dt: float) -> str:
    """The judge's MJCF model of an arm with integration step dt [s].

    Gravity as on Earth; no contacts, joint limits or automatic reset. Sensors of the site "tool": those of
    tasks.base.SENSORS, then its position p [m].
    """
    root = ElementTree.fromstring(arm.xml)
    # Later options override those of the file, and its sensors (arm_check.py allows none) would come first.
    option = ElementTree.SubElement(root, "option", timestep=repr(dt), gravity="0 0 -9.81")
    ElementTree.SubElement(option, "flag", contact="disable", limit="disable", autoreset="disable", gravity="enable")
    sensors = ElementTree.fromstring(sensor_xml("tool"))
    ElementTree.SubElement(sensors, "framepos", name="p", objtype="site", objname="tool")
    root.extend([*ElementTree.fromstring(LOOK), sensors])
    return ElementTree.tostring(root, encoding="unicode")


def _files(folder: Path) -> dict[str, list[Path]]:
    """{name: its files}; a package's own __init__.py is none."""
    found: dict[str, list[Path]] = {}
    for path in sorted(folder.iterdir()):
        if path.suffix in (".xml", ".py") and not path.name.startswith("_") and path.is_file():
            found.setdefault(path.stem.replace("_", "-"), []).append(path)
    return found


def _listed(paths: list[Path]) -> str:
    return " and ".join(path.name for path in paths)


@lru_cache(maxsize=64)
def _xml_of(name: str, file: str, text: str) -> str:
    """What xml() of a Python file returns; run from its text, because Python's own cache goes by the clock."""
    module = types.ModuleType(f"tasks.arms.{Path(file).stem}")
    try:
        exec(compile(text, file, "exec"), module.__dict__)
        written = module.xml()
    except (Exception, SystemExit) as error:
        reason = " ".join(f"{type(error).__name__}: {error}".split())
        raise BadArm(f"arm '{name}': xml() of {file} does not work ({reason}) (mend the file)") from error
    if not isinstance(written, str):
        raise BadArm(f"arm '{name}': xml() of {file} returns {type(written).__name__} (return the MJCF text, a str)")
    return written


@lru_cache(maxsize=64)
def _checked(name: str, xml: str) -> Arm:
    from tasks.arm_check import checked  # MuJoCo takes a moment to import; listing names must not

    return checked(name, xml)
