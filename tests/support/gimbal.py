"""A gimbal whose tool has the same inertia about every axis in every pose, as MJCF and as URDF."""

INERTIA = 0.02
"""Inertia of the tool [kg m^2], a ball on the point where three axes meet; rings weigh next to nothing."""

MJCF = f"""
<mujoco>
  <compiler angle="radian" autolimits="true"/>
  <worldbody>
    <body name="base" pos="0 0 1">
      <inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/>
      <joint name="yaw" axis="0 0 1" range="-2 2"/>
      <body name="ring">
        <inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/>
        <joint name="pitch" axis="0 1 0" range="-1 1"/>
        <body name="ball">
          <inertial pos="0 0 0" mass="5" diaginertia="{INERTIA} {INERTIA} {INERTIA}"/>
          <joint name="roll" axis="1 0 0"/>
          <site name="grip" pos=".1 0 0"/>
          <body name="finger" pos=".1 0 0">
            <inertial pos="0 0 0" mass="1e-6" diaginertia="1e-9 1e-9 1e-9"/>
            <joint name="squeeze" type="slide" axis="0 1 0" range="0 .05"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""

LIGHT = (
    """<inertial><mass value="1e-6"/><inertia ixx="1e-9" iyy="1e-9" izz="1e-9" ixy="0" ixz="0" iyz="0"/></inertial>"""
)
BALL = f"""<inertial><mass value="5"/>
  <inertia ixx="{INERTIA}" iyy="{INERTIA}" izz="{INERTIA}" ixy="0" ixz="0" iyz="0"/></inertial>"""
SHAPE = """<visual><geometry><mesh filename="package://nowhere/ball.stl"/></geometry></visual>"""
LIMIT = """<limit lower="-1" upper="1" effort="1" velocity="1"/>"""

URDF = f"""
<robot name="gimbal">
  <link name="ground"/>
  <link name="base">{LIGHT}</link>
  <link name="ring">{LIGHT}</link>
  <link name="ball">{BALL}{SHAPE}</link>
  <link name="grip"/>
  <joint name="yaw" type="revolute"><parent link="ground"/><child link="base"/><axis xyz="0 0 1"/>{LIMIT}</joint>
  <joint name="pitch" type="revolute"><parent link="base"/><child link="ring"/><axis xyz="0 1 0"/>{LIMIT}</joint>
  <joint name="roll" type="continuous"><parent link="ring"/><child link="ball"/><axis xyz="1 0 0"/></joint>
  <joint name="mount" type="fixed"><parent link="ball"/><child link="grip"/><origin xyz=".1 0 0"/></joint>
</robot>
"""
