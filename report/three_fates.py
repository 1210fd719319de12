"""The loop "one start, three fates": a gripper under three laws, from a 180° rotation and from a smaller one.

Orientations come from the compiled engine tick by tick, as in the episodes of the results (ideal-rk4, half-turn).
"""

import itertools
import math
from typing import Any

import numpy as np
from drawing import FRAMES_PER_S, Motion, Theme, draw_row, encode, make_view, save, write_on
from PIL import Image

import tasks
from bench.engines.curve import NUMBERS, blank_curves
from bench.experiments.episodes import rows_from, simulate
from bench.experiments.experiment import Unit
from bench.experiments.request import Request
from bench.experiments.suites import HORIZON
from tasks.base import Start

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
SETTINGS = Request("media")
Fate = tuple[Motion, dict[str, Any]]
"""An episode: the rotations of the body tick by tick, and the judge's row."""
GRIPPER = """
<geom type="cylinder" size=".1 .12" pos="0 0 -.12" {look}/>
<geom type="box" size=".09 .24 .05" pos="0 0 .05" {look}/>
<geom type="box" size=".05 .03 .16" pos="0 .19 .25" {look}/>
<geom type="box" size=".05 .03 .16" pos="0 -.19 .25" rgba="{finger}"/>
"""


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


def simulate_one(unit: Unit, start: Start, loop_s: float, names: tuple[str, ...]) -> tuple[np.ndarray, dict[str, Any]]:
    """Return the numbers of an episode tick by tick, as long as the loop, and the judge's row."""
    curves = blank_curves(1, round(loop_s / SETTINGS.dt_s), numbers=names)
    simulate(SETTINGS, unit, [start], unit.horizon_s, curves)
    [ticks] = curves.samples
    return ticks[~np.isnan(ticks[:, 0])], rows_from(SETTINGS, unit, [start]).iloc[0].to_dict()


def simulate_fates() -> dict[str, dict[str, Fate]]:
    """Return each start's episodes by law."""
    starts, columns = {one.id: one for one in tasks.start_set("half-turn")}, NUMBERS.index("n_x")
    where, horizon_s = ("free-body", "", "ideal-rk4", "half-turn"), HORIZON["half-turn"]
    found: dict[str, dict[str, Fate]] = {}
    for name, law in itertools.product(STARTS, LAWS):
        unit = Unit("free-body", law, *where, count=1, horizon_s=horizon_s)
        ticks, row = simulate_one(unit, starts[name], LOOP["loop_s"], NUMBERS)
        vectors = ticks[:, columns : columns + 9].reshape(-1, 3, 3).transpose(0, 2, 1)
        found.setdefault(name, {})[law] = Motion(SETTINGS.dt_s, vectors), row
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
        {"contender": law, "start": start, **describe_row(row, numbers, says=describe_fate(row))}
        for start, by_law in fates.items()
        for law, (_, row) in by_law.items()
    ]
    return {"episodes": episodes, **LOOP}


def describe_row(row: dict[str, Any], numbers: tuple[str, ...], **words: str) -> dict[str, Any]:
    """Return the outcome of an episode, these words, and numbers of its row to six figures."""
    rounded = {name: None if math.isnan(row[name]) else float(f"{row[name]:.6g}") for name in numbers}
    return {"outcome": str(row["outcome"]), **words, **rounded}


def draw_scene(view: Any, theme: Theme, place: int, by_law: dict[str, Fate]) -> list[Image.Image]:
    """Return the frames of one start: the heading, each law's name and end, and below them the grippers."""
    [(_, first), *_] = by_law.values()
    heading = f"{place}. From rest, {math.degrees(first['angle0_rad']):.0f}° to turn to the faint gripper"
    frames = []
    motions = [motion.frames(LOOP["loop_s"], FRAMES_PER_S * LOOP["slower"]) for motion, _ in by_law.values()]
    for poses in zip(*motions, strict=True):
        above = HEAD + 2 * LINE
        names = [LAWS[law] for law in by_law]
        image = draw_row([view(pose) for pose in poses], names, above, 0, HEAD + LINE - 6, 18, theme)
        write_on(image, (image.width // 2, HEAD - 8), heading, 20, theme)
        for column, (_, row) in enumerate(by_law.values()):
            x = column * SIZE[0] + SIZE[0] // 2
            in_colour = theme._replace(ink=FATE[theme.suffix][grade(row)])
            write_on(image, (x, above - 6), describe_fate(row), 18, in_colour)
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
