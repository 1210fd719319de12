"""The loop "one start, three fates": a gripper under three laws, from a 180° rotation and from a smaller one.

Orientations come from the compiled engine tick by tick, as in the episodes of the results (ideal-rk4, half-turn).
"""

import math
from typing import Any, NamedTuple

import numpy as np
from drawing import FRAMES_PER_S, Motion, Theme, draw_row, encode, make_view, save, write_on
from PIL import Image

import tasks
from bench.engines.curve import NUMBERS, blank_curves
from bench.experiments.episodes import rows_from, simulate
from bench.experiments.experiment import Settings, Unit
from bench.experiments.suites import HORIZON

LAWS = {
    "rotation-matrix": "cross product",
    "quaternion-unwinding": "quaternion without sign",
    "mrp-memory": "MRP with memory",
}
STARTS = ("half-turn-x-exact", "half-turn-x-k00")
"""At 180° the cross product vanishes; from the smaller rotation the quaternion without sign turns the longer way."""
LOOP = {"loop_s": 1.0, "slower": 3}  # each start is played in 3 s
SIZE, HEAD, LINE = (216, 204), 30, 24  # pixels of a gripper, of the heading and of a line of words
FATE = {"": ((176, 42, 34), (140, 90, 0), (10, 112, 73)), "-dark": ((255, 143, 133), (242, 191, 78), (79, 216, 160))}
"""The colours of stuck, unwinding and home, on light paper and on dark."""
POSTER_S = 0.2
GRIPPER = """
<geom type="cylinder" size=".1 .12" pos="0 0 -.12" {look}/>
<geom type="box" size=".09 .24 .05" pos="0 0 .05" {look}/>
<geom type="box" size=".05 .03 .16" pos="0 .19 .25" {look}/>
<geom type="box" size=".05 .03 .16" pos="0 -.19 .25" rgba="{finger}"/>
"""


class Fate(NamedTuple):
    """An episode: the rotations of the body tick by tick, and the judge's row."""

    motion: Motion
    row: dict[str, Any]


class Gripper:
    """A gripper that is put into an orientation, and a faint one at the goal."""

    def __init__(self) -> None:
        import mujoco

        def draw(opacity: float) -> str:
            return GRIPPER.format(look=f'rgba=".3 .45 .65 {opacity}"', finger=f".85 .45 .1 {opacity}")

        self.model = mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <visual>
    <global offwidth="800" offheight="800"/>
    <headlight ambient=".45 .45 .45" diffuse=".4 .4 .4" specular="0 0 0"/>
  </visual>
  <asset><texture type="skybox" builtin="flat" rgb1="1 1 1" rgb2="1 1 1" width="8" height="8"/></asset>
  <worldbody>
    <light directional="true" pos="2 -1 2" dir="-.7 .3 -.6" diffuse=".6 .6 .6" castshadow="false"/>
    <body mocap="true">{draw(1.0)}</body>
    <body>{draw(0.16)}</body>
  </worldbody>
</mujoco>""")
        self.data = mujoco.MjData(self.model)

    def follow(self, pose: Any) -> None:
        """Take an orientation, a rotation matrix."""
        import mujoco

        mujoco.mju_mat2Quat(self.data.mocap_quat[0], np.ascontiguousarray(pose).ravel())
        mujoco.mj_forward(self.model, self.data)

    def camera(self) -> Any:
        """Return a camera that looks along the axis of the rotations, a little from above."""
        import mujoco

        camera = mujoco.MjvCamera()
        camera.azimuth, camera.elevation, camera.distance = 165.0, -14.0, 1.3
        return camera


def simulate_fates() -> dict[str, dict[str, Fate]]:
    """Return each start's episodes by law."""
    settings = Settings("media")
    starts = {one.id: one for one in tasks.start_set("half-turn") if one.id in STARTS}
    ticks, horizon_s = round(LOOP["loop_s"] / settings.dt_s), HORIZON["half-turn"]
    columns = NUMBERS.index("n_x")
    found: dict[str, dict[str, Fate]] = {}
    for name in STARTS:
        for law in LAWS:
            unit = Unit("free-body", law, "free-body", "", "ideal-rk4", "half-turn", count=1, horizon_s=horizon_s)
            curves = blank_curves(1, ticks)
            simulate(settings, unit, [starts[name]], horizon_s, curves)
            [kept] = curves.samples
            vectors = kept[~np.isnan(kept[:, 0]), columns : columns + 9]
            motion = Motion(settings.dt_s, vectors.reshape(-1, 3, 3).transpose(0, 2, 1))
            row = rows_from(settings, unit, [starts[name]]).iloc[0].to_dict()
            found.setdefault(name, {})[law] = Fate(motion, row)
    return found


def describe_fate(row: dict[str, Any]) -> str:
    """Return in a few words how an episode ends."""
    angle = math.degrees(row["angle0_rad"])
    if grade(row) == 0:
        return f"{row['outcome']} at {angle:.0f}°"
    verb = "unwinds" if grade(row) == 1 else "turns"
    return f"{verb} {angle * row['path_ratio']:.0f}° in {row['settling_time_s']:.2f} s"


def grade(row: dict[str, Any]) -> int:
    """Return 0 for an episode that does not settle, 1 for one that takes a longer way, 2 for all others."""
    return 0 if math.isnan(row["settling_time_s"]) else 1 if row["path_ratio"] > 1.1 else 2


def describe(fates: dict[str, dict[str, Fate]]) -> dict[str, Any]:
    """Return what the loop shows."""
    numbers = ("angle0_rad", "settling_time_s", "path_ratio")
    episodes = [
        {"contender": law, "start": start, "outcome": str(fate.row["outcome"]), "says": describe_fate(fate.row)}
        | {name: None if math.isnan(fate.row[name]) else float(f"{fate.row[name]:.6g}") for name in numbers}
        for start, by_law in fates.items()
        for law, fate in by_law.items()
    ]
    return {"episodes": episodes, **LOOP}


def draw_scene(view: Any, theme: Theme, place: int, by_law: dict[str, Fate]) -> list[Image.Image]:
    """Return the frames of one start: the heading, each law's name and end, and below them the grippers."""
    [first, *_] = by_law.values()
    heading = f"{place}. From rest, {math.degrees(first.row['angle0_rad']):.0f}° to turn to the faint gripper"
    frames = []
    motions = [one.motion.frames(LOOP["loop_s"], FRAMES_PER_S * LOOP["slower"]) for one in by_law.values()]
    for poses in zip(*motions, strict=True):
        above = HEAD + 2 * LINE
        names = [LAWS[law] for law in by_law]
        image = draw_row([view(pose) for pose in poses], names, above, 0, HEAD + LINE - 6, 18, theme)
        write_on(image, (image.width // 2, HEAD - 8), heading, 20, theme)
        for column, fate in enumerate(by_law.values()):
            x = column * SIZE[0] + SIZE[0] // 2
            in_colour = theme._replace(ink=FATE[theme.suffix][grade(fate.row)])
            write_on(image, (x, above - 6), describe_fate(fate.row), 18, in_colour)
        frames.append(image)
    return frames


def draw(theme: Theme, fates: dict[str, dict[str, Fate]]) -> None:
    """Draw the loop, and both starts as one still."""
    gripper = Gripper()
    view = make_view(gripper, SIZE, theme, gripper.camera())
    scenes = [draw_scene(view, theme, place, by_law) for place, by_law in enumerate(fates.values(), 1)]
    stills = [frames[round(POSTER_S * FRAMES_PER_S * LOOP["slower"])] for frames in scenes]
    encode(f"fates-loop{theme.suffix}", [*scenes[0], *scenes[1]], stills[0])
    save(Image.fromarray(np.vstack(stills)), f"fates{theme.suffix}.png")
