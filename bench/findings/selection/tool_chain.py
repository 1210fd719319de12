"""Load the joints that move an end effector: of an arm of ours, of MJCF or of URDF.

Only the joints between the base and the end effector count; the others, as those of fingers, are
locked where the file puts them. Actuators, contacts, equalities, friction and joint damping do not
enter. MuJoCo reads every file; of URDF the shapes are dropped first, because their meshes are often
elsewhere and the inertia is in <inertial>.

Limitations: hinges and slides alone. A URDF has no sites, so a body is the end effector there.
"""

from __future__ import annotations

import math
import xml.etree.ElementTree as ElementTree
from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import mujoco
import numpy as np

import tasks
from bench.base.errors import BadModel, Incompatible
from tasks.arm_model import model_xml

AS_IT_IS = "nominal"
"""The variation of our arms: with the hand and the usual motor inertia of their files."""

SHOWN = 12
"""Names that an error lists."""

FEWEST_HINGES = 3
"""Hinges without which nothing turns about every axis."""


class ToolChain(NamedTuple):
    """The joints that move an end effector.

    title: name for a reader. effector: the site or body, in words. body: its number. point: place
    of the site in that body [m]. joints: numbers of its joints, from the base. dofs: their places
    in the velocities, and angles in the positions. motors: least, usual and greatest motor inertia
    of an arm of ours [kg m^2]; empty if none is stated.
    """

    title: str
    effector: str
    model: mujoco.MjModel
    body: int
    point: tuple[float, float, float]
    joints: tuple[int, ...]
    motors: tuple[float, ...] = ()

    @property
    def dofs(self) -> np.ndarray:
        """Return the places of the joints in the vector of velocities."""
        return self.model.jnt_dofadr[list(self.joints)]

    @property
    def angles(self) -> np.ndarray:
        """Return the places of the joints in the vector of positions."""
        return self.model.jnt_qposadr[list(self.joints)]

    @property
    def has_motor_inertia(self) -> bool:
        """Tell whether every joint has a reflected motor inertia (armature)."""
        return bool(self.model.dof_armature[self.dofs].all())

    @property
    def is_rubbed(self) -> bool:
        """Tell whether a joint has damping or friction, which the answer leaves out."""
        return bool(
            self.model.dof_damping[self.dofs].any() or self.model.dof_frictionloss[self.dofs].any()
        )

    def ranges(self) -> tuple[np.ndarray, np.ndarray]:
        """Return both ends of the joint ranges [rad, m]; of a hinge without ends -pi and pi."""
        joints = list(self.joints)
        limited = self.model.jnt_limited[joints].astype(bool)
        low, high = self.model.jnt_range[joints].T
        return np.where(limited, low, -math.pi), np.where(limited, high, math.pi)


def load_arm(name: str, variation: str = AS_IT_IS) -> ToolChain:
    """Return an arm of this repository with its site "tool"; UnknownName lists the arms."""
    arm = tasks.arm(name)
    model = mujoco.MjModel.from_xml_string(model_xml(arm, 1e-3))
    tasks.variation(variation).apply(model, arm.rated)
    chain = _follow(arm.title, model, _find_site(model, "tool", name))
    return chain._replace(motors=arm.motors)


def load_mjcf(path: Path, site: str | None = None, body: str | None = None) -> ToolChain:
    """Return the chain of MJCF to a site or a body; BadModel says what is wrong."""
    model = _compile(path, lambda: mujoco.MjModel.from_xml_path(str(path)))
    if body is not None:
        return _follow(path.name, model, _find_body(model, body, path.name))
    return _follow(path.name, model, _find_site(model, site, path.name))


def load_urdf(path: Path, body: str | None = None) -> ToolChain:
    """Return the chain of a URDF to a link, by default the last; BadModel says what is wrong."""
    text = _without_shapes(path)
    model = _compile(path, lambda: mujoco.MjModel.from_xml_string(text))
    name = model.body(model.nbody - 1).name if body is None else body
    return _follow(path.name, model, _find_body(model, name, path.name))


def _compile(path: Path, load: Callable[[], mujoco.MjModel]) -> mujoco.MjModel:
    """Return the model of a file; BadModel with MuJoCo's reason."""
    if not path.is_file():
        raise BadModel(f"'{path}' is no file (give the path of a robot's MJCF or URDF)")
    try:
        return load()
    except (ValueError, OSError) as error:
        reason = " ".join(str(error).split())
        cure = "correct the file, or run MuJoCo's `compile` on it"
        raise BadModel(f"MuJoCo cannot load '{path}': {reason} ({cure})") from error


def _without_shapes(path: Path) -> str:
    """Return a URDF without shapes, whose links at the end of fixed joints remain bodies."""
    if not path.is_file():
        raise BadModel(f"'{path}' is no file (give the path of a robot's URDF)")
    try:
        robot = ElementTree.fromstring(path.read_text(encoding="utf-8"))
    except (ElementTree.ParseError, UnicodeDecodeError, OSError) as error:
        raise BadModel(f"'{path}' is not XML: {error} (expand a xacro file first)") from error
    if robot.tag != "robot":
        raise BadModel(f"'{path}' begins with <{robot.tag}> and is no URDF (MJCF: use --mjcf)")
    for link in robot.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            link.remove(shape)
    extension = robot.find("mujoco")
    if extension is None:
        extension = ElementTree.SubElement(robot, "mujoco")
    compiler = extension.find("compiler")
    if compiler is None:
        compiler = ElementTree.SubElement(extension, "compiler")
    compiler.set("fusestatic", "false")
    return ElementTree.tostring(robot, encoding="unicode")


def _list_names(model: mujoco.MjModel, kind: str) -> str:
    """Return the names of all sites or bodies that are not the world, the first SHOWN of many."""
    if kind == "site":
        names = [model.site(place).name for place in range(model.nsite)]
    else:
        names = [model.body(place).name for place in range(1, model.nbody)]
    names = [name for name in names if name]
    more = f" and {len(names) - SHOWN} more" if len(names) > SHOWN else ""
    return ", ".join(names[:SHOWN]) + more if names else "none"


class _Effector(NamedTuple):
    """The end effector: its words, its body, and where it is in that body [m]."""

    words: str
    body: int
    point: tuple[float, float, float]


def _find_site(model: mujoco.MjModel, name: str | None, file: str) -> _Effector:
    """Return the effector of a site; BadModel lists the sites."""
    sites = _list_names(model, "site")
    cure = "try: --site NAME" if model.nsite else "it has no sites; try: --body NAME"
    known = f"its sites: {sites}; its bodies: {_list_names(model, 'body')} ({cure})"
    if name is None:
        raise BadModel(f"{file}: which site is the end effector? {known}")
    place = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, name)
    if place < 0:
        raise BadModel(f"{file} has no site '{name}'; {known}")
    x, y, z = model.site_pos[place].tolist()
    return _Effector(f"site {name}", int(model.site_bodyid[place]), (x, y, z))


def _find_body(model: mujoco.MjModel, name: str, file: str) -> _Effector:
    """Return the effector of a body; BadModel lists the bodies."""
    place = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    if place < 0:
        known = _list_names(model, "body")
        raise BadModel(f"{file} has no body '{name}'; its bodies: {known} (try: --body NAME)")
    return _Effector(f"body {name}", place, (0.0, 0.0, 0.0))


def _follow(title: str, model: mujoco.MjModel, effector: _Effector) -> ToolChain:
    """Return the chain from the base to an effector; Incompatible if its joints are no arm's."""
    joints: list[int] = []
    body = effector.body
    while body:
        first = int(model.body_jntadr[body])
        joints = [*range(first, first + int(model.body_jntnum[body])), *joints]
        body = int(model.body_parentid[body])
    _check_joints(title, model, effector, joints)
    return ToolChain(title, effector.words, model, effector.body, effector.point, tuple(joints))


def _check_joints(
    title: str, model: mujoco.MjModel, effector: _Effector, joints: list[int]
) -> None:
    """Refuse a chain that cannot turn its end about every axis, or has joints of other kinds."""
    hinge, slide = mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE
    kinds = [int(model.jnt_type[joint]) for joint in joints]
    for joint, kind in zip(joints, kinds, strict=True):
        name = model.joint(joint).name or f"number {joint}"
        if kind not in (hinge, slide):
            raise Incompatible(
                f"{title}: joint '{name}' is a ball or free joint, and an arm here has hinges and "
                "slides on a fixed base (fix the base, or write a ball joint as three hinges)"
            )
        if kind == slide and not model.jnt_limited[joint]:
            raise Incompatible(
                f"{title}: slide '{name}' has no range, from which poses are drawn (give it one)"
            )
    if kinds.count(hinge) < FEWEST_HINGES:
        raise Incompatible(
            f"{title}: {kinds.count(hinge)} hinges move {effector.words}, and it takes at least "
            f"{FEWEST_HINGES} to turn it about every axis (name an end effector farther from the base)"
        )
