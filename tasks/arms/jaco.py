"""Kinova Jaco, from dm_control: the arm that nobody here typed.

Kinematics, masses, ranges, viscous damping and reflected motor inertia are those of dm_control's
third_party/kinova/jaco_arm.xml; link inertias are what MuJoCo makes of its meshes. The model is compiled once, and
written out again without the meshes; what changes:

- Dry friction (frictionloss 2 and 1 N m) is left out: no model of it is perfect.
- Each joint has a torque motor; dm_control's are velocity servos. Rated torques are the peaks of Kinova's actuators
  KA-75+ and KA-58 as dm_control states them, 30.5 and 6.8 N m.
- The tool is dm_control's wrist site, where its hand would be mounted. There is no hand.
- It has no home pose there, and at Kinova's own the Jacobian's condition number is 19. Ours has the elbow up and the
  hand 30 degrees from straight down; of such poses, in steps of 15 degrees, J is best conditioned here (10).

Its reflected motor inertias, 4 and 2 kg m^2, are guesses of dm_control's that dominate everything: the links add a few
per cent, so this arm is nearly six decoupled integrators in joint space.
"""

from __future__ import annotations

import math
from importlib.resources import files
from typing import Any

import mujoco

RATED = (30.5, 30.5, 30.5, 6.8, 6.8, 6.8)
HOME_DEG = (180.0, 200.0, 90.0, 315.0, 60.0, 225.0)

# What to draw of each body: capsules (from, to, radius) in its frame, and the radius of the ring about its joint.
SHAPES: dict[str, tuple[list[tuple], float]] = {
    "b_base": ([((0, 0, 0.0), (0, 0, 0.12), 0.042)], 0.0),
    "b_1": ([((0, 0, -0.02), (0, 0, -0.11), 0.042)], 0.044),
    "b_2": ([((0, -0.01, -0.025), (0, -0.40, -0.025), 0.036)], 0.044),
    "b_3": ([((0, 0.01, -0.018), (0, 0.19, -0.0114), 0.033)], 0.044),
    "b_4": ([((0, 0, -0.02), (0, -0.012, -0.045), 0.031), ((0, -0.012, -0.045), (0, -0.037, -0.064), 0.031)], 0.035),
    "b_5": ([((0, 0, -0.02), (0, -0.012, -0.045), 0.031), ((0, -0.012, -0.045), (0, -0.037, -0.064), 0.031)], 0.035),
    "b_6": ([], 0.035),
}


def xml() -> str:
    """Return the MJCF text."""
    model = mujoco.MjModel.from_xml_path(str(files("dm_control") / "third_party" / "kinova" / "jaco_arm.xml"))
    motors = "\n".join(
        f'    <motor joint="{model.joint(i).name}" ctrlrange="-{rated} {rated}"/>' for i, rated in enumerate(RATED)
    )
    return f"""<mujoco model="jaco">
  <compiler angle="radian" autolimits="true"/>
  <custom>
    <text name="title" data="Kinova Jaco"/>
    <text name="source" data="dm_control's third_party/kinova: its kinematics, masses, damping and reflected motor
      inertia, link inertias from its meshes; dry friction left out; Kinova's peak torques"/>
  </custom>
  <default>
    <geom contype="0" conaffinity="0" mass="0" type="capsule" rgba=".24 .25 .28 1"/>
    <motor ctrllimited="false"/>
    <default class="ring"><geom type="cylinder" rgba=".78 .80 .83 1"/></default>
    <default class="axis"><geom size=".006"/></default>
  </default>
  <worldbody>
    <camera name="view" pos="1.250 -1.018 .820" xyaxes=".689 .725 0 -.178 .169 .969" fovy="40"/>
{_body(model, 1)}
  </worldbody>
  <actuator>
{motors}
  </actuator>
  <keyframe>
    <key name="home" qpos="{_numbers(map(math.radians, HOME_DEG))}"/>
  </keyframe>
</mujoco>
"""


def _body(model: mujoco.MjModel, i: int) -> str:
    """Body i and those it carries: one each, so the last body is the last number."""
    body = model.body(i)
    capsules, ring = SHAPES[body.name]
    parts = [
        f'<inertial pos="{_numbers(body.ipos)}" quat="{_numbers(body.iquat)}" mass="{float(body.mass[0])!r}" '
        f'diaginertia="{_numbers(body.inertia)}"/>'
    ]
    for j in range(body.jntadr[0], body.jntadr[0] + body.jntnum[0]):
        joint = model.joint(j)
        limits = f' range="{_numbers(joint.range)}"' if model.jnt_limited[j] else ""
        parts.append(
            f'<joint name="{joint.name}" pos="{_numbers(joint.pos)}" axis="{_numbers(joint.axis)}" '
            f'armature="{float(joint.armature[0])!r}" damping="{float(joint.damping[0])!r}"{limits}/>'
        )
    for start, end, radius in capsules:
        parts.append(f'<geom fromto="{_numbers(start)} {_numbers(end)}" size="{radius}"/>')
    if ring:
        parts.append(f'<geom class="ring" size="{ring} .009"/>')
    parts.append(_tool(model) if i == model.nbody - 1 else _body(model, i + 1))
    lines = "\n".join(parts)
    return f'<body name="{body.name}" pos="{_numbers(body.pos)}" quat="{_numbers(body.quat)}">\n{lines}\n</body>'


def _tool(model: mujoco.MjModel) -> str:
    """Return the wrist site as the tool, with its axes n, o, a."""
    site = model.site("wristsite")
    return f"""<body name="tool" pos="{_numbers(site.pos)}" quat="{_numbers(site.quat)}">
  <site name="tool" size=".002"/>
  <geom class="axis" fromto="0 0 0 .12 0 0" rgba=".8 .25 .2 1"/>
  <geom class="axis" fromto="0 0 0 0 .12 0" rgba=".2 .6 .25 1"/>
  <geom class="axis" fromto="0 0 0 0 0 .12" rgba=".2 .35 .85 1"/>
</body>"""


def _numbers(values: Any) -> str:
    """To the last digit."""
    return " ".join(repr(float(value)) for value in values)
