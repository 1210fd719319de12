"""A small arm of a user's own, right in every point; tests spoil one point of it."""

JOINTS = (("1", "0 0 1"), ("2", "0 1 0"), ("3", "0 1 0"), ("4", "0 0 1"), ("5", "0 1 0"), ("6", "0 0 1"))


def xml(joints=JOINTS) -> str:
    """The MJCF text of a chain of these joints, (name, axis) from the base on, and links of .2 m and 1 kg."""
    chain = '<site name="tool" pos="0 0 .2"/>\n'
    for name, axis in reversed(joints):
        chain = f"""<body name="link {name}" pos="0 0 .2">
<joint name="joint {name}" axis="{axis}" range="-3 3"/>
<inertial pos="0 0 .1" mass="1" diaginertia=".01 .01 .005"/>
{chain}</body>
"""
    motors = "".join(
        f'<motor name="motor {name}" joint="joint {name}" ctrlrange="-20 20" ctrllimited="false"/>\n'
        for name, _ in joints
    )
    home = " ".join(["0", ".5", "1", ".1", ".8", "0", ".3", "0"][: len(joints)])
    return f"""<mujoco model="own">
<compiler angle="radian"/>
<custom>
<text name="title" data="A small arm"/>
<text name="source" data="Made up for a test"/>
</custom>
<option timestep=".004"/>
<worldbody>
{chain}</worldbody>
<actuator>
{motors}</actuator>
<keyframe>
<key name="home" qpos="{home}"/>
</keyframe>
</mujoco>
"""
