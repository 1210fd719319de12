"""Pictures of the tasks in contact for the report: a still of each, and a loop on the tilted plate.

An episode's record holds the hand's place and orientation tick by tick; the joint angles follow from them, by Newton's
method from one frame to the next, and the scene's joint is in the record.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from drawing import FRAMES_PER_S, HALF, LINE, encode, save, sheet, side_by_side, written

ARM = "puma560"
SHOWN = {
    "surface-alignment": ("tilt 20 about 120, beta+0", 0.5),
    "peg-in-hole": ("tilt 8 about 120, beta+0", 0.32),
    "crank": ("", 0.6),
    "force-on-plane": ("tilt 10 about 35, beta+0", 0.55),
}
"""Task -> the trial of its still, the first one where none is named, and from how far [m] it is seen."""
BY = "hybrid-base+inverse"
STILL_AT_S = 1.5  # the hand is busy then, on every task
PLATE, TILTED = "surface-alignment", "tilt 20 about 0, beta+75"
CONTROLLERS = {"hybrid-base+inverse": "Cartesian", "hybrid/zyx-euler+inverse": "Euler, β = 75°"}
LOOP_S, SLOWER = 2.4, 1.2
NEWTON_STEPS = 6  # from one frame to the next the hand moves by centimetres at most, and each step squares what is left


class Seen(NamedTuple):
    """An episode as a picture needs it: its trial, time step [s], outcome and record."""

    trial: Any
    dt_s: float
    outcome: str
    record: Any

    def tick(self, time_s: float) -> int:
        """The record's line at a time; the last one once it has ended."""
        return min(round(time_s / self.dt_s), len(self.record) - 1)


def seen(task: str, trial: str, controller: str) -> Seen:
    """One episode by the compiled engine."""
    import tasks
    from bench.control.registry import find_compliant
    from bench.engines.contact_episode import USUAL
    from bench.engines.run_contact import run

    arm, about = tasks.arm(ARM), tasks.contact_task(task)
    one = next(each for each in about.trials(arm) if each.id == trial or not trial)
    ended = next(run("native", find_compliant(controller), about, arm, (one,)))
    return Seen(one, USUAL.dt_s, ended.outcome, ended.record)


class Puppet:
    """A task on the arm, moved to where a record has the hand."""

    def __init__(self, task: str):
        import mujoco

        import tasks
        from bench.engines.contact_episode import USUAL
        from tasks.contact_model import model_xml

        self.joints = tasks.arm(ARM).joints
        xml = model_xml(tasks.contact_task(task), tasks.arm(ARM), USUAL.dt_s)
        self.model = mujoco.MjModel.from_xml_string(xml)
        self.data = mujoco.MjData(self.model)

    def begin(self, trial) -> None:
        """Put the scene, the hand's frame and the joints where the trial has them."""
        import mujoco

        from tasks.contact import prepare

        mujoco.mj_resetData(self.model, self.data)
        prepare(self.model, self.data, trial)
        mujoco.mj_forward(self.model, self.data)

    def follow(self, line) -> None:
        """Move the joints so that the hand is where a line of the record has it."""
        import mujoco
        import numpy as np

        from bench.engines.contact_episode import TURNED, P, R

        model, data, n = self.model, self.data, self.joints
        site = model.site("hand").id
        goal, J = line[R : R + 9].reshape(3, 3).T, np.zeros((6, model.nv))
        if model.nv > n:
            data.qpos[n:] = line[TURNED]
        for _ in range(NEWTON_STEPS):
            mujoco.mj_forward(model, data)
            mujoco.mj_jacSite(model, data, J[:3], J[3:], site)
            turn = goal @ data.site_xmat[site].reshape(3, 3).T
            vee = 0.5 * np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
            missing = np.concatenate((line[P : P + 3] - data.site_xpos[site], vee))
            data.qpos[:n] += np.linalg.solve(J[:, :n], missing)
        mujoco.mj_forward(model, data)


class Stage:
    """A puppet before a camera that looks at where its hand begins."""

    def __init__(self, puppet: Puppet, azimuth: float, elevation: float, distance: float):
        import mujoco

        self.puppet, model = puppet, puppet.model
        of_scene = model.body_rootid[model.geom_bodyid] == model.body("scene").id
        # capsules of the arm are axes of its frames
        model.geom_rgba[(model.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE) & ~of_scene, 3] = 0.0
        self.renderer = mujoco.Renderer(model, HALF[1], HALF[0])
        self.camera = mujoco.MjvCamera()
        self.camera.azimuth, self.camera.elevation, self.camera.distance = azimuth, elevation, distance
        self.camera.lookat[:] = puppet.data.site("hand").xpos

    def __enter__(self) -> Stage:
        return self

    def __exit__(self, *_) -> None:
        self.renderer.close()

    def picture(self, line):
        """A PIL image of a line of the record."""
        from PIL import Image

        self.puppet.follow(line)
        self.renderer.update_scene(self.puppet.data, camera=self.camera)
        return Image.fromarray(self.renderer.render())


def put(task: str, one: Seen) -> Puppet:
    """A puppet at the beginning of an episode."""
    puppet = Puppet(task)
    puppet.begin(one.trial)
    return puppet


def along(one: Seen, until_s: float, frames_per_s: float):
    """Lines of the record, frame by frame."""
    for number in range(round(until_s * frames_per_s)):
        yield one.record[one.tick(number / frames_per_s)]


def tasks_in_contact() -> None:
    """The strip of stills, one a task."""
    width, height = HALF
    strip = sheet(width * len(SHOWN), height + LINE)
    for place, (task, (trial, distance)) in enumerate(SHOWN.items()):
        one = seen(task, trial, BY)
        with Stage(put(task, one), 160.0, -14.0, distance) as stage:
            for line in along(one, STILL_AT_S, FRAMES_PER_S):
                stage.puppet.follow(line)
            strip.paste(stage.picture(line), (place * width, 0))
        written(strip, (place * width + width // 2, height + LINE - 12), task.replace("-", " "), 24, anchor="ms")
    save(strip, "contact-tasks.png")


def on_the_plate() -> None:
    """The loop: Cartesian and Euler compliance on the same plate, at equal times."""
    halves = []
    for controller in CONTROLLERS:
        one = seen(PLATE, TILTED, controller)
        with Stage(put(PLATE, one), 172.0, -5.0, 0.5) as stage:
            halves.append([stage.picture(line) for line in along(one, LOOP_S, FRAMES_PER_S * SLOWER)])
    images = [
        side_by_side(list(both), list(CONTROLLERS.values()), f"{number / FRAMES_PER_S / SLOWER:.2f} s")
        for number, both in enumerate(zip(*halves, strict=True))
    ]
    encode(images, "plate-loop", len(images) - 1)


def facts() -> dict:
    """What the files show."""
    return {
        "arm": ARM,
        "stills": {task: trial for task, (trial, _) in SHOWN.items()},
        "by": BY,
        "plate": {"task": PLATE, "trial": TILTED, "controllers": list(CONTROLLERS), "loop_s": LOOP_S, "slower": SLOWER},
    }
